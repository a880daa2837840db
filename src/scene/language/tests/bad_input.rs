//! Bad input: each kind has its own message, with the place and what to do. The table is in `bad_input.txt`.

use super::errors;
use crate::scene::{MAX_FILE_BYTES, ReadError, ReadOptions, read, read_file};

#[test]
fn every_mistake_has_its_message() {
    let table = include_str!("bad_input.txt");
    let mut seen = 0;
    for block in table.split("\n\n").filter(|block| block.starts_with('>')) {
        let (text, expected) = block.split_once('\n').expect("an answer below the text");
        let text = text[1..].trim_start();
        assert_eq!(errors(text), expected.trim_end(), "{text}");
        seen += 1;
    }
    assert!(seen > 100, "only {seen} cases were found");
}

#[test]
fn files_that_are_no_text() {
    let answer =
        |bytes: &[u8]| read("test", bytes, &ReadOptions::default()).map_err(|errors| errors.to_string());
    assert_eq!(
        answer(b"cube(1);\ncube(\xff);"),
        Err("test: error: the file is not text: byte 14, in line 2, is not UTF-8\n  help: the scene language is UTF-8 text"
            .into())
    );
    assert_eq!(
        answer(b"cube(1);\0"),
        Err("test: error: the file is not text: byte 8, in line 1, is 0\n  help: the scene language is UTF-8 text"
            .into())
    );
}

#[test]
fn files_that_are_too_large() {
    let bytes = vec![0; MAX_FILE_BYTES as usize + 1];
    let errors = read("test", &bytes, &ReadOptions::default()).expect_err("too large");
    let expected = "test: error: the file is larger than 256 MiB\n  \
         help: split the scene, or leave detail out where it was exported";
    assert_eq!(errors.to_string(), expected);
}

#[test]
fn files_that_can_not_be_read() {
    let missing = std::path::Path::new("no/such/file.scene");
    match read_file(missing, &ReadOptions::default()) {
        Err(ReadError::File { path, cause }) => {
            assert_eq!((path.as_path(), cause.kind()), (missing, std::io::ErrorKind::NotFound));
        }
        other => panic!("{other:?}"),
    }
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(matches!(read_file(folder, &ReadOptions::default()), Err(ReadError::File { .. })));
}

#[test]
fn nesting_deeper_than_2000() {
    let nested = |depth: usize| format!("{}cube(1);{}", "difference() {".repeat(depth), "}".repeat(depth));
    assert!(read("test", nested(2000).as_bytes(), &ReadOptions::default()).is_ok());
    let expected = "test:1:28014: error: nested deeper than 2000 levels: one level too many\n  \
         help: put parts side by side, not inside each other";
    assert_eq!(errors(&nested(2001)), expected);
    for opener in ["translate([0, 0, 1]) ", "cube([", "cube(", "union() ", "{", "!", "-"] {
        // Any answer will do, as long as there is one.
        let _ = read("test", opener.repeat(1 << 16).as_bytes(), &ReadOptions::default());
    }
}

#[test]
fn stops_after_twenty_errors() {
    let errors =
        read("test", "nix();".repeat(1000).as_bytes(), &ReadOptions::default()).expect_err("bad words");
    assert_eq!((errors.list.len(), errors.stopped), (20, true));
    assert!(errors.to_string().ends_with("reading stopped after 20 errors"));
}

#[test]
fn unsupported_words_can_be_left_out() {
    let skipping = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
    let text = b"cube(1);\nroof() { cube(1); nonsense(); }\ndifference() { cube(1); roof() square(3); }";
    let scene = read("test", text, &skipping).expect("the rest is a scene");
    assert_eq!(scene.objects.len(), 2);
    assert_eq!(
        scene.notes,
        [
            "line 2: `roof` is left out: only OpenSCAD can work its shape out (2 times, in lines 2 and 3)",
            "line 3: a hole of `difference` stays filled: what cuts it is left out"
        ]
    );
    // What is drilled into something unknown is not shown, and neither is what only meets something unknown.
    let text =
        b"cube(9); difference() { roof() cube(1); cube(2); } intersection() { roof() cube(1); sphere(2); }";
    let scene = read("test", text, &skipping).expect("a scene");
    assert_eq!(scene.objects.len(), 1);
    let nothing = read("test", b"roof() cube(1);", &skipping).expect_err("nothing is left").to_string();
    assert!(nothing.contains("the scene is empty") && nothing.contains("`roof` is left out"), "{nothing}");
}

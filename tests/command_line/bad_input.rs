//! Scenes that are no scenes.

use std::fs;

use super::{BALL, fails, run, scene, text};

#[test]
fn has_exit_code_2_and_a_place() {
    let cases = [
        ("word", "sphere(1);\nsphera(2);\n", "sphere"),
        ("argument", "sphere(1);\nsphere(radius = 2);\n", ":2:"),
        ("braces", "sphere(1);\nunion() { sphere(2);\n", ":2:"),
        ("singular", "sphere(1);\nscale([1, 0, 1]) sphere(2);\n", ":2:"),
        ("empty", "", "error"),
    ];
    for (name, contents, says) in cases {
        let (folder, file) = scene(&format!("bad_{name}"), contents);
        let out = folder.join("out.txt");
        let message = fails(&run(&["render", &file, "-o", out.to_str().unwrap()]), 2);
        assert!(message.contains(says), "{name}: {says} is not in\n{message}");
        assert!(!out.exists(), "{name}: a file was left behind");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "{name}: something was left behind");
        fails(&run(&["check", &file]), 2);
        fails(&run(&[&file]), 2);
    }
}

#[test]
fn is_also_a_file_that_is_not_there_or_no_text() {
    let (folder, _) = scene("no_file", BALL);
    fails(&run(&["check", folder.join("nothing.scene").to_str().unwrap()]), 2);
    fails(&run(&["check", folder.to_str().unwrap()]), 2);
    let message = fails(&run(&["check", "hanjang"]), 2);
    assert!(message.contains("hanyang"), "the embedded scenes are not named: {message}");
    let bytes = folder.join("bytes.scene");
    fs::write(&bytes, b"sphere(1);\xff\xfe").unwrap();
    let message = fails(&run(&["check", bytes.to_str().unwrap()]), 2);
    assert!(message.contains("the scene language is UTF-8 text"), "{message}");
    fs::write(&bytes, b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").unwrap();
    let message = fails(&run(&["check", bytes.to_str().unwrap()]), 2);
    assert!(message.contains("this is a PNG picture, not a scene"), "{message}");
}

#[test]
fn is_deep_nesting_without_a_crash() {
    let deep = format!("{}sphere(1);{}", "union() { ".repeat(100_000), "}".repeat(100_000));
    let (_, file) = scene("deep", &deep);
    fails(&run(&["check", &file]), 2);
}

#[test]
fn can_be_skipped_where_openscad_is_larger_than_ray13() {
    let (_, file) = scene("skip", "sphere(1);\nroof() { cube(1); sphere(1); }\n");
    assert!(fails(&run(&["render", &file, "--format", "txt"]), 2).contains("roof"));
    let skipped = run(&["render", &file, "--format", "txt", "--skip-unsupported"]);
    assert!(skipped.status.success());
    assert!(!skipped.stdout.is_empty());
    assert!(text(&skipped.stderr).contains("roof"), "what was left out is not said");
}

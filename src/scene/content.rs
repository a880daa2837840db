//! What bytes are by their content: known before any of them is taken for text.

/// A binary format that is no scene: what to call it, and how it is told by its bytes.
struct Binary {
    name: &'static str,
    is: fn(&[u8]) -> bool,
}

/// Binary files that are given in place of a scene, by the bytes that each format begins with.
const BINARY: [Binary; 8] = [
    Binary { name: "a PNG picture", is: |bytes| bytes.starts_with(b"\x89PNG\r\n\x1a\n") },
    Binary { name: "a JPEG picture", is: |bytes| bytes.starts_with(b"\xff\xd8\xff") },
    Binary { name: "a PDF document", is: |bytes| bytes.starts_with(b"%PDF-") },
    Binary { name: "a gzip archive", is: |bytes| bytes.starts_with(b"\x1f\x8b") },
    Binary {
        name: "a ZIP archive without a model in it, or cut off",
        is: |bytes| bytes.starts_with(b"PK\x03\x04"),
    },
    Binary { name: "an ELF program", is: |bytes| bytes.starts_with(b"\x7fELF") },
    Binary { name: "UTF-16 text", is: |bytes| bytes.starts_with(b"\xff\xfe") },
    Binary { name: "UTF-16 text", is: |bytes| bytes.starts_with(b"\xfe\xff") },
];

/// What the bytes are, where they are of a binary format that is known and no scene.
pub fn binary(bytes: &[u8]) -> Option<&'static str> {
    BINARY.iter().find(|format| (format.is)(bytes)).map(|format| format.name)
}

/// Whether the bytes begin as a file of NFF does, whatever its name: behind comments, with the word of an
/// entity and, for all but a view, a number.
pub fn is_nff(bytes: &[u8]) -> bool {
    let lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let Some(first) = lines.into_iter().find(|line| !line.is_empty() && line[0] != b'#') else {
        return false;
    };
    let mut words = first.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let number = |word: &[u8]| std::str::from_utf8(word).is_ok_and(|word| word.parse::<f64>().is_ok());
    match words.next() {
        Some(b"v") => words.next().is_none_or(|word| word == b"from"),
        Some(b"b" | b"l" | b"f" | b"s" | b"p" | b"pp") => words.next().is_some_and(number),
        Some(b"c") => words.next().is_none_or(number),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binary_files_are_known_by_their_first_bytes() {
        assert_eq!(binary(b"\x89PNG\r\n\x1a\n\0\0"), Some("a PNG picture"));
        assert_eq!(binary(b"\x1f\x8b\x08\0"), Some("a gzip archive"));
        assert_eq!(binary(b"PK\x03\x04\x14\0"), Some("a ZIP archive without a model in it, or cut off"));
        assert_eq!(binary(b"\x7fELF\x02"), Some("an ELF program"));
        assert_eq!(binary(b"\xff\xfes\0"), Some("UTF-16 text"));
        let text: [&[u8]; 4] = [b"", b"sphere(1);", b"PNG", "cube(1); // \u{e4}".as_bytes()];
        for text in text {
            assert_eq!(binary(text), None);
        }
    }

    #[test]
    fn nff_is_known_by_its_first_entity() {
        let nff: [&[u8]; 5] =
            [b"v\nfrom 0 0 0", b"# balls\n\n  v from 1 2 3", b"s 0 0 0 1", b"b .1 .2 .3\r\n", b"c\n0 0 0 1"];
        for text in nff {
            assert!(is_nff(text), "{}", text.escape_ascii());
        }
        let other: [&[u8]; 6] = [b"", b"sphere(1);", b"s(1);", b"v 0 0 1\nf 1 2 3", b"# only", b"f a b"];
        for text in other {
            assert!(!is_nff(text), "{}", text.escape_ascii());
        }
    }
}

//! `docs/scene-language.md` says what the reader does.

use crate::scene::{ReadOptions, read, reference};

const DOCUMENT: &str = include_str!("../../../../docs/scene-language.md");

#[test]
fn holds_the_table_of_words() {
    let reference = reference();
    for (expected, found) in
        reference.lines().zip(DOCUMENT.lines().skip_while(|line| *line != "### Primitives"))
    {
        assert_eq!(
            found, expected,
            "replace the tables in docs/scene-language.md by ray13::scene::reference()"
        );
    }
    assert!(DOCUMENT.contains(reference.trim_end()));
}

#[test]
fn its_examples_read() {
    let mut seen = 0;
    for part in DOCUMENT.split("```openscad\n").skip(1) {
        let text = part.split("```").next().unwrap_or_default();
        if let Err(errors) = read("example", text.as_bytes(), &ReadOptions::default()) {
            panic!("{text}\n{errors}");
        }
        seen += 1;
    }
    assert!(seen > 3, "only {seen} examples were found");
}

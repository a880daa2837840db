//! Finds public types that share a name.

use std::collections::BTreeMap;

use super::tokens::{tokens, without_tests};

/// The public types of a file: `pub struct`, `enum`, `trait`, `type` and `union`, without those of
/// `pub(crate)` and the like, and without tests.
pub fn public_types(text: &str) -> Vec<String> {
    let all = tokens(text);
    let tokens = without_tests(&all);
    let is_type = |word: &str| matches!(word, "struct" | "enum" | "trait" | "type" | "union");
    let types = tokens.windows(3).filter(|w| w[0].text == "pub" && is_type(w[1].text));
    types.map(|w| w[2].text.to_owned()).collect()
}

/// The names that several public types have, each with the files of these; `files` are paths and texts.
pub fn shared_names(files: &[(String, String)]) -> BTreeMap<String, Vec<&str>> {
    let mut found = BTreeMap::<String, Vec<&str>>::new();
    for (path, text) in files {
        for name in public_types(text) {
            found.entry(name).or_default().push(path);
        }
    }
    found.retain(|_, paths| paths.len() > 1);
    found
}

mod the_finder_itself {
    use super::*;

    #[test]
    fn finds_public_types_only() {
        let text = "pub struct A; pub(crate) enum B {} enum C {} pub trait D {} /* pub struct E; */\n\
                    pub type F<'a> = &'a str; pub fn g() {} #[cfg(test)] mod t { pub struct H; }";
        assert_eq!(public_types(text), ["A", "D", "F"]);
    }

    #[test]
    fn finds_names_that_are_shared() {
        let files = [("a.rs", "pub struct A; pub enum B {}"), ("b.rs", "pub trait A {}")];
        let files = files.map(|(path, text)| (path.to_owned(), text.to_owned()));
        assert_eq!(shared_names(&files), BTreeMap::from([("A".to_owned(), vec!["a.rs", "b.rs"])]));
    }
}

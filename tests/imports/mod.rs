//! Finds the rooms that a source file names, by `crate::` and by `super::`, anywhere in its code.

pub mod circles;
pub mod names;
mod tokens;

use tokens::{Token, tokens};

/// One room named in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Import {
    /// Counted from 1.
    pub line: usize,
    /// The first name after `crate::`; `*` for a glob.
    pub room: String,
}

/// A file below `src/`, cut into words and signs, without comments and strings.
pub struct Source<'a> {
    name: &'a str,
    tokens: Vec<Token<'a>>,
}

/// The `mod` lines of lib.rs, in their order.
pub fn rooms_of(lib: &str) -> Vec<String> {
    let source = Source::new("lib.rs", lib);
    let words = source.tokens.windows(3);
    words.filter(|w| w[0].text == "mod" && w[2].text == ";").map(|w| w[1].text.to_owned()).collect()
}

/// A sentence for each import of a room that stands below the file's own room in `rooms`.
pub fn upward_imports(source: &Source, rooms: &[String]) -> Vec<String> {
    let place = |room: &str| rooms.iter().position(|r| r == room);
    let home = source.room();
    let Some(floor) = place(home) else {
        return vec![format!("{}: the room `{home}` is not in src/lib.rs", source.name)];
    };
    source
        .imports()
        .iter()
        .filter_map(|Import { line, room }| match place(room) {
            Some(other) if other <= floor => None,
            Some(_) => {
                Some(format!("src/{}:{line}: `{home}` imports `{room}`, which comes after it", source.name))
            }
            // A name re-exported by lib.rs would hide which room it is from.
            None => Some(format!(
                "src/{}:{line}: `{home}` imports `crate::{room}`, which is no room",
                source.name
            )),
        })
        .collect()
}

impl<'a> Source<'a> {
    /// Takes a file's path below `src/`, with `/` between its parts, and its text.
    pub fn new(name: &'a str, text: &'a str) -> Self {
        Self { name, tokens: tokens(text) }
    }

    /// The folder or file directly below `src/`.
    fn room(&self) -> &'a str {
        self.name.split('/').next().unwrap_or_default().trim_end_matches(".rs")
    }

    /// How many `super` lead from the file's own module to the crate's root.
    fn depth(&self) -> usize {
        let parts = self.name.split('/').count();
        if self.name.ends_with("/mod.rs") { parts - 1 } else { parts }
    }

    /// Every room that the file names, in order.
    pub fn imports(&self) -> Vec<Import> {
        let mut found = Vec::new();
        let mut braces = 0_usize;
        let mut inline_modules = Vec::new();
        for (i, token) in self.tokens.iter().enumerate() {
            match token.text {
                "{" => {
                    if i >= 2 && self.tokens[i - 2].text == "mod" {
                        inline_modules.push(braces);
                    }
                    braces += 1;
                }
                "}" => {
                    braces = braces.saturating_sub(1);
                    if inline_modules.last() == Some(&braces) {
                        inline_modules.pop();
                    }
                }
                "crate" if self.text(i + 1) == "::" => self.names(i + 2, &mut found),
                "super" if i == 0 || self.text(i - 1) != "::" => {
                    let depth = self.depth() + inline_modules.len();
                    let supers = (0..=depth).take_while(|n| self.text(i + 2 * n) == "super").count();
                    if supers == depth && self.text(i + 2 * supers - 1) == "::" {
                        self.names(i + 2 * supers, &mut found);
                    }
                }
                _ => {}
            }
        }
        found
    }

    fn text(&self, i: usize) -> &'a str {
        self.tokens.get(i).map_or("", |token| token.text)
    }

    /// The first names of the path, or of each path in braces, that begins at a token.
    fn names(&self, at: usize, found: &mut Vec<Import>) {
        let mut name = |i: usize| {
            if let Some(token) = self.tokens.get(i) {
                found.push(Import { line: token.line, room: token.text.trim_start_matches("r#").to_owned() });
            }
        };
        if self.text(at) != "{" {
            return name(at);
        }
        let mut depth = 0_usize;
        for i in at..self.tokens.len() {
            match self.text(i) {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return;
            }
            let begins = matches!(self.text(i), "{" | ",");
            if depth == 1 && begins && !matches!(self.text(i + 1), "}" | "self") {
                name(i + 1);
            }
        }
    }
}

mod the_finder_itself {
    use super::*;

    fn named(file: &str, text: &str) -> Vec<(usize, String)> {
        Source::new(file, text).imports().into_iter().map(|i| (i.line, i.room)).collect()
    }

    fn rooms() -> Vec<String> {
        ["math", "scene", "view", "frame"].map(str::to_owned).to_vec()
    }

    #[test]
    fn finds_use_lines_braces_and_inline_paths() {
        let text = "use crate::math::DVec3;\nuse crate::{scene, view::{Camera, Ray}, };\n\
                    fn f() -> crate::frame::Frame { crate :: math::zero() }\n\
                    use crate::{\n  scene::{self, Solid},\n  view as v,\n};";
        let expected =
            [(1, "math"), (2, "scene"), (2, "view"), (3, "frame"), (3, "math"), (5, "scene"), (6, "view")];
        assert_eq!(named("view/mod.rs", text), expected.map(|(line, room)| (line, room.to_owned())));
    }

    #[test]
    fn counts_the_supers_that_leave_a_room() {
        assert_eq!(named("view/mod.rs", "use super::frame::Frame;"), [(1, "frame".to_owned())]);
        assert_eq!(named("view/ray.rs", "use super::frame::Frame;"), []);
        assert_eq!(named("view/ray.rs", "use super::super::{frame, math};").len(), 2);
        assert_eq!(named("stage.rs", "use super::frame;"), [(1, "frame".to_owned())]);
        let nested = "mod tests { use super::*; use super::super::super::frame; } use super::super::math;";
        assert_eq!(named("view/ray.rs", nested), [(1, "frame".to_owned()), (1, "math".to_owned())]);
    }

    #[test]
    fn passes_over_comments_and_strings() {
        let text = "//! [`crate::frame`]\n/* crate::frame /* nested */ crate::frame */\n\
                    let a = \"crate::frame \\\" crate::frame\"; let b = r#\"crate::frame \" \"#; let c = b\"crate::frame\";\n\
                    let q = '\"'; let e = '\\''; fn f<'a>(x: &'a str) -> crate::math::X {}";
        assert_eq!(named("view/mod.rs", text), [(4, "math".to_owned())]);
    }

    #[test]
    fn an_import_of_a_later_room_is_a_fault_in_tests_too() {
        let text = "use crate::math::A;\n#[cfg(test)]\nmod tests {\n    use crate::frame::Frame;\n}\n";
        let faults = upward_imports(&Source::new("view/ray.rs", text), &rooms());
        assert_eq!(faults, ["src/view/ray.rs:4: `view` imports `frame`, which comes after it"]);
        assert!(upward_imports(&Source::new("frame/mod.rs", text), &rooms()).is_empty());
    }

    #[test]
    fn a_name_that_is_no_room_is_a_fault() {
        let fault = |text: &str| upward_imports(&Source::new("view/mod.rs", text), &rooms()).len();
        assert_eq!(fault("use crate::Frame;"), 1);
        assert_eq!(fault("use crate::*;"), 1);
        assert_eq!(fault("use crate::view::Ray;"), 0);
        assert_eq!(upward_imports(&Source::new("cellar/mod.rs", ""), &rooms()).len(), 1);
    }

    #[test]
    fn reads_the_order_of_the_rooms() {
        let lib = "//! pub mod nothing;\npub mod math;\n#[cfg(feature = \"app\")]\npub mod app;\nmod cli;";
        assert_eq!(rooms_of(lib), ["math", "app", "cli"]);
    }
}

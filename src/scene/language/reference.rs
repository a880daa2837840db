//! The words of the language as tables, for people: what `docs/scene-language.md` shows.

use std::fmt::Write;

use super::vocabulary::{Meaning, Word};
use super::words::{UNSUPPORTED, WORDS};

/// Every word with its arguments, what they take and their defaults, in Markdown.
///
/// `docs/scene-language.md` holds this text as it is.
pub fn reference() -> String {
    let mut text = String::new();
    let section = |title: &str, belongs: fn(Meaning) -> bool, text: &mut String| {
        // Writing to a `String` does not fail.
        let _ = writeln!(text, "### {title}\n");
        for word in WORDS.iter().filter(|word| belongs(word.meaning)) {
            describe(word, text);
        }
    };
    section("Primitives", |meaning| matches!(meaning, Meaning::Solid(_) | Meaning::Import), &mut text);
    section("Plane figures", |meaning| matches!(meaning, Meaning::Figure(_)), &mut text);
    section("Forms", |meaning| matches!(meaning, Meaning::Form(_)), &mut text);
    section("Operators", |meaning| matches!(meaning, Meaning::Operator(_)), &mut text);
    section("Maps", |meaning| matches!(meaning, Meaning::Map(_)), &mut text);
    let surface = |meaning| matches!(meaning, Meaning::Color | Meaning::Material | Meaning::Object);
    section("Surfaces and objects", surface, &mut text);
    let world = |meaning| matches!(meaning, Meaning::Camera | Meaning::Light | Meaning::World);
    section("Views, lights, world", world, &mut text);
    text.push_str("### Words of OpenSCAD that can not be shown\n\n| word | why |\n|---|---|\n");
    for (word, why) in UNSUPPORTED {
        let _ = writeln!(text, "| `{word}` | {why} |");
    }
    text
}

fn describe(word: &Word, text: &mut String) {
    let _ = writeln!(text, "**`{}`** {}\n", word.name, word.summary);
    if word.arguments.is_empty() {
        return;
    }
    text.push_str("| argument | takes | default | |\n|---|---|---|---|\n");
    for parameter in word.arguments {
        let name = if parameter.by_position {
            format!("`{}`", parameter.name)
        } else {
            format!("`{} =`", parameter.name)
        };
        let takes = parameter.takes.describe();
        let _ = writeln!(text, "| {name} | {takes} | {} | {} |", parameter.default, parameter.summary);
    }
    text.push('\n');
}

//! Looks words up in the table of [`super::words`].

use super::nearest::nearest;
use super::vocabulary::Word;
use super::words::{UNSUPPORTED, WORDS};

/// What a name in the text is.
pub enum Known {
    /// A word of the language.
    Word(&'static Word),
    /// A word of OpenSCAD that has no solid here, and why.
    Unsupported(&'static str),
    /// No word.
    Unknown,
}

/// Looks a name up.
pub fn look_up(name: &str) -> Known {
    if let Some(word) = WORDS.iter().find(|word| word.name == name) {
        return Known::Word(word);
    }
    if let Some((_, why)) = UNSUPPORTED.iter().find(|(word, _)| *word == name) {
        return Known::Unsupported(why);
    }
    Known::Unknown
}

/// The word nearest to a name that is none.
pub fn nearest_word(name: &str) -> Option<&'static str> {
    nearest(name, WORDS.iter().map(|word| word.name))
}

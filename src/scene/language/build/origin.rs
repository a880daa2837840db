//! Where something was made.

use crate::scene::language::syntax::{Call, TextSpan};
use crate::scene::language::vocabulary::Word;

/// The call that something was made of: where its mistakes are.
#[derive(Clone, Copy, Debug)]
pub struct Origin {
    pub word: &'static Word,
    /// The place of its word.
    pub name: TextSpan,
    /// Where its arguments end.
    pub end: u32,
}

impl Origin {
    pub fn of(word: &'static Word, call: &Call<'_>) -> Self {
        Self { word, name: call.name.span, end: call.parentheses.end }
    }
}

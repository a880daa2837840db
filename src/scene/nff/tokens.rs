//! NFF text as a stream of words: what stands between blanks, `#` comments left out. Lines mean nothing else.

use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};

/// One word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// The word itself.
    pub word: &'a str,
    /// Where it begins, in bytes.
    pub start: usize,
}

impl Token<'_> {
    /// The bytes that it takes.
    pub fn span(&self) -> std::ops::Range<usize> {
        self.start..self.start + self.word.len()
    }

    /// Whether it is written as a number, be it a good one or not.
    fn looks_like_a_number(&self) -> bool {
        self.word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
    }
}

/// The words of a text, from the first.
#[derive(Clone, Debug)]
pub struct Tokens<'a> {
    text: &'a str,
    at: usize,
    next: Option<Token<'a>>,
}

impl<'a> Tokens<'a> {
    /// The words of `text`.
    pub fn new(text: &'a str) -> Self {
        // Some editors begin a file with a byte order mark; it is no word.
        let at = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let mut tokens = Self { text, at, next: None };
        tokens.next = tokens.scan();
        tokens
    }

    /// The next word, which stays the next.
    pub fn peek(&self) -> Option<Token<'a>> {
        self.next
    }

    /// Takes the next word.
    pub fn take(&mut self) -> Option<Token<'a>> {
        let token = self.next;
        self.next = self.scan();
        token
    }

    /// Whether a number comes next.
    pub fn number_is_next(&self) -> bool {
        self.next.is_some_and(|token| token.looks_like_a_number())
    }

    /// Takes a finite number, or says what stands in its place; a word that belongs to something else stays.
    #[inline]
    pub fn number(&mut self, sink: &mut Sink, within: &Within) -> Result<(f64, Token<'a>), Reported> {
        let Some(token) = self.next else { return Err(self.cut_off(sink, within)) };
        match token.word.parse::<f64>() {
            Ok(number) if number.is_finite() && token.looks_like_a_number() => {
                self.next = self.scan();
                Ok((number, token))
            }
            Ok(_) if token.looks_like_a_number() => {
                self.take();
                let error = Diagnostic::error(token.span(), "a number is not finite");
                Err(sink.report(error.label(format!("`{}` is beyond the largest number", shown(token.word)))))
            }
            _ => {
                let error = Diagnostic::error(token.span(), format!("{within} ends too early"));
                let label = format!("here a number belongs: {}", within.missing);
                let label = format!("{label}; this is `{}`", shown(token.word));
                Err(sink.report(error.label(label)))
            }
        }
    }

    /// Reports that the text ends here.
    pub fn cut_off(&self, sink: &mut Sink, within: &Within) -> Reported {
        let error = Diagnostic::error(within.keyword.span(), format!("the file ends within {within}"));
        sink.report(error.label(format!("of this, {} is missing", within.missing)).help("the file is cut off"))
    }

    fn scan(&mut self) -> Option<Token<'a>> {
        let bytes = self.text.as_bytes();
        let mut at = self.at;
        loop {
            while bytes.get(at).is_some_and(u8::is_ascii_whitespace) {
                at += 1;
            }
            if bytes.get(at) != Some(&b'#') {
                break;
            }
            while bytes.get(at).is_some_and(|&byte| byte != b'\n') {
                at += 1;
            }
        }
        let start = at;
        while bytes.get(at).is_some_and(|byte| !byte.is_ascii_whitespace()) {
            at += 1;
        }
        self.at = at;
        // Blanks are ASCII: both ends are on character boundaries.
        self.text.get(start..at).filter(|word| !word.is_empty()).map(|word| Token { word, start })
    }
}

/// What is being read, for messages.
#[derive(Clone, Copy, Debug)]
pub struct Within<'a> {
    /// The word that began it.
    pub keyword: Token<'a>,
    /// What comes next in it.
    pub missing: Missing,
}

impl std::fmt::Display for Within<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "`{}`", self.keyword.word)
    }
}

/// The part of an entity that is read.
#[derive(Clone, Copy, Debug)]
pub enum Missing {
    /// One of its numbers, by its name.
    Named(&'static str),
    /// A corner of a polygon, from 1, of so many.
    Corner(u64, u64),
}

impl std::fmt::Display for Missing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Named(name) => f.write_str(name),
            Self::Corner(number, count) => write!(f, "corner {number} of {count}"),
        }
    }
}

/// A word as far as a message has room for it.
pub fn shown(word: &str) -> &str {
    const ROOM: usize = 40;
    &word[..word.floor_char_boundary(ROOM)]
}

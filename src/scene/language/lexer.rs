//! Text to tokens, one at a time; blanks and comments are passed over.

use super::syntax::TextSpan;

/// A token and its place.
#[derive(Clone, Copy, Debug)]
pub struct Token<'a> {
    pub kind: TokenKind,
    /// As it is written.
    pub text: &'a str,
    pub span: TextSpan,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TokenKind {
    /// A name; names may start with `$`.
    Word,
    /// A number; infinite where it is too large for f64.
    Number(f64),
    /// A number with letters at its end, such as `2mm`.
    NumberWithUnit,
    /// A text with its quotes, escapes not yet resolved.
    Text,
    /// One of `( ) [ ] { } , ; =` and of the characters of arithmetic.
    Sign(char),
    /// A text without its closing quote.
    OpenText,
    /// A `/*` without its `*/`.
    OpenComment,
    /// Any other character.
    Stray(char),
    /// The end of the text.
    End,
}

/// The place reached in a text. Copies are cheap: looking ahead is lexing on a copy.
#[derive(Clone, Copy, Debug)]
pub struct Lexer<'a> {
    source: &'a str,
    at: usize,
}

const SIGNS: &str = "()[]{},;=*!#%+-/<>?:.&|^";

impl<'a> Lexer<'a> {
    /// A lexer at the start of `source`.
    pub fn new(source: &'a str) -> Self {
        // Editors on Windows start files with a byte order mark; it means nothing in UTF-8.
        Self { source, at: if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 } }
    }

    /// The next token; [`TokenKind::End`] for ever after the last.
    pub fn next(&mut self) -> Token<'a> {
        if let Err(open_comment) = self.skip_blanks() {
            return open_comment;
        }
        let start = self.at;
        let rest = &self.source[start..];
        let Some(first) = rest.chars().next() else { return self.token(start, TokenKind::End) };
        let second = rest[first.len_utf8()..].chars().next().unwrap_or(' ');
        if first.is_ascii_digit() || (first == '.' && second.is_ascii_digit()) {
            return self.number();
        }
        if is_word_start(first) {
            self.at += rest.find(|c| !is_word_part(c) && c != '$').unwrap_or(rest.len());
            return self.token(start, TokenKind::Word);
        }
        if first == '"' {
            return self.text();
        }
        self.at += first.len_utf8();
        let kind = if SIGNS.contains(first) { TokenKind::Sign(first) } else { TokenKind::Stray(first) };
        self.token(start, kind)
    }

    fn token(&self, start: usize, kind: TokenKind) -> Token<'a> {
        let span = TextSpan { start: start as u32, end: self.at as u32 };
        Token { kind, text: &self.source[start..self.at], span }
    }

    /// Passes over blanks and comments; an open comment is a token, because it is an error.
    fn skip_blanks(&mut self) -> Result<(), Token<'a>> {
        loop {
            let rest = &self.source[self.at..];
            let blank = rest.len() - rest.trim_start().len();
            self.at += blank;
            let rest = &rest[blank..];
            if rest.starts_with("//") {
                self.at += rest.find('\n').unwrap_or(rest.len());
            } else if let Some(comment) = rest.strip_prefix("/*") {
                let Some(length) = comment.find("*/") else {
                    let start = self.at;
                    self.at += 2;
                    let token = self.token(start, TokenKind::OpenComment);
                    self.at = self.source.len();
                    return Err(token);
                };
                self.at += length + "/**/".len();
            } else {
                return Ok(());
            }
        }
    }

    fn number(&mut self) -> Token<'a> {
        let start = self.at;
        self.skip_digits();
        if self.byte(0) == Some(b'.') {
            self.at += 1;
            self.skip_digits();
        }
        if matches!(self.byte(0), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(self.byte(1), Some(b'+' | b'-')));
            if self.byte(1 + sign).is_some_and(|byte| byte.is_ascii_digit()) {
                self.at += 1 + sign;
                self.skip_digits();
            }
        }
        // The grammar above is within that of Rust's own parser, so that it does not fail.
        let number = self.source[start..self.at].parse().unwrap_or(f64::INFINITY);
        let rest = &self.source[self.at..];
        let unit = rest.find(|c: char| !is_word_part(c)).unwrap_or(rest.len());
        self.at += unit;
        self.token(start, if unit > 0 { TokenKind::NumberWithUnit } else { TokenKind::Number(number) })
    }

    fn text(&mut self) -> Token<'a> {
        let start = self.at;
        let mut escaped = false;
        for (offset, c) in self.source[start + 1..].char_indices() {
            match c {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => {
                    self.at = start + 1 + offset + 1;
                    return self.token(start, TokenKind::Text);
                }
                _ => {}
            }
        }
        self.at += 1;
        let token = self.token(start, TokenKind::OpenText);
        self.at = self.source.len();
        token
    }

    fn byte(&self, ahead: usize) -> Option<u8> {
        self.source.as_bytes().get(self.at + ahead).copied()
    }

    fn skip_digits(&mut self) {
        while self.byte(0).is_some_and(|byte| byte.is_ascii_digit()) {
            self.at += 1;
        }
    }
}

fn is_word_start(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_' || c == '$'
}

fn is_word_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

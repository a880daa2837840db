//! The words of a text of lines, which need not be UTF-8: names and comments may be in any encoding.

use std::ops::Range;

use super::fault::{MeshError, MeshFault};

/// A word, and where it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshWord<'a> {
    /// Its bytes; at least one.
    pub bytes: &'a [u8],
    /// The byte of the file where it begins.
    pub start: usize,
}

impl MeshWord<'_> {
    /// Its place in the file.
    pub fn span(&self) -> Range<usize> {
        self.start..self.start + self.bytes.len()
    }

    /// Whether it is this word, in capitals or not.
    pub fn is(&self, word: &str) -> bool {
        self.bytes.eq_ignore_ascii_case(word.as_bytes())
    }

    /// The finite number that it is; `what` is what messages call it.
    pub fn number(&self, what: &str) -> Result<f64, MeshError> {
        let text = std::str::from_utf8(self.bytes).ok();
        match text.and_then(|text| text.parse::<f64>().ok()) {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(MeshFault::NotFinite(what.to_owned()).at(self.span())),
            None => Err(MeshFault::NoNumber(what.to_owned()).at(self.span())),
        }
    }

    /// The whole number that it is.
    pub fn integer(&self, what: &str) -> Result<i64, MeshError> {
        let text = std::str::from_utf8(self.bytes).ok();
        let number = text.and_then(|text| text.parse().ok());
        number.ok_or_else(|| MeshFault::NoNumber(what.to_owned()).at(self.span()))
    }

    /// The count that it is.
    pub fn count(&self, what: &str) -> Result<u64, MeshError> {
        let text = std::str::from_utf8(self.bytes).ok();
        let number = text.and_then(|text| text.parse().ok());
        number.ok_or_else(|| MeshFault::Unexpected(what.to_owned()).at(self.span()))
    }
}

/// The words of a part of a file, one after the other, whatever lines they are in.
#[derive(Clone, Debug)]
pub struct MeshWords<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
}

impl<'a> MeshWords<'a> {
    /// Those of a range of the file.
    pub fn new(bytes: &'a [u8], range: Range<usize>) -> Self {
        Self { bytes, at: range.start, end: range.end }
    }

    /// Where the last character of the range is: the place of what is missing at the end.
    pub fn end(&self) -> Range<usize> {
        let inside = self.bytes[..self.end].trim_ascii_end().len().min(self.end);
        inside.saturating_sub(1)..inside
    }

    /// Where the last character that was taken is.
    pub fn before(&self) -> Range<usize> {
        self.at.saturating_sub(1)..self.at
    }

    /// The next word; an error where there is none. `what` is what it should be.
    pub fn expect(&mut self, what: &str) -> Result<MeshWord<'a>, MeshError> {
        self.next().ok_or_else(|| {
            let is_last = self.bytes[self.end..].trim_ascii().is_empty();
            let fault = if is_last { MeshFault::CutOff } else { MeshFault::Unexpected };
            fault(what.to_owned()).at(self.end())
        })
    }

    /// The rest of the line, without blanks around it; the words go on behind it.
    pub fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..self.end];
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += length;
        rest[..length].trim_ascii()
    }
}

impl<'a> Iterator for MeshWords<'a> {
    type Item = MeshWord<'a>;

    fn next(&mut self) -> Option<MeshWord<'a>> {
        let rest = &self.bytes[self.at..self.end];
        let skipped = rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        let rest = &rest[skipped..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let start = self.at + skipped;
        self.at = start + length;
        Some(MeshWord { bytes: &rest[..length], start })
    }
}

/// The lines of a text that have words, without comments, which begin with `#`.
#[derive(Clone, Debug)]
pub struct MeshLines<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether a line that ends in `\` goes on in the next.
    continued: bool,
}

impl<'a> MeshLines<'a> {
    /// Those of a file.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, continued: false }
    }

    /// Those of a file whose lines go on behind a `\` at their ends.
    pub fn continued(bytes: &'a [u8]) -> Self {
        Self { continued: true, ..Self::new(bytes) }
    }

    /// Where the last character of the file is.
    pub fn end(&self) -> Range<usize> {
        MeshWords::new(self.bytes, 0..self.bytes.len()).end()
    }

    /// The next line; an error where there is none.
    pub fn expect(&mut self, what: &str) -> Result<MeshWords<'a>, MeshError> {
        self.next().ok_or_else(|| MeshFault::CutOff(what.to_owned()).at(self.end()))
    }

    fn line(&mut self) -> Option<Range<usize>> {
        if self.at >= self.bytes.len() {
            return None;
        }
        let start = self.at;
        loop {
            let rest = &self.bytes[self.at..];
            let length = rest.iter().position(|&byte| byte == b'\n');
            let end = self.at + length.unwrap_or(rest.len());
            self.at = end + 1;
            let goes_on = self.continued && self.bytes[start..end].trim_ascii_end().ends_with(b"\\");
            if length.is_none() || !goes_on {
                return Some(start..end);
            }
        }
    }
}

impl<'a> Iterator for MeshLines<'a> {
    type Item = MeshWords<'a>;

    fn next(&mut self) -> Option<MeshWords<'a>> {
        loop {
            let line = self.line()?;
            let text = &self.bytes[line.clone()];
            let length = text.iter().position(|&byte| byte == b'#').unwrap_or(text.len());
            let words = MeshWords::new(self.bytes, line.start..line.start + length);
            if words.clone().next().is_some() {
                return Some(words);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str, continued: bool) -> Vec<Vec<&str>> {
        let lines = MeshLines { continued, ..MeshLines::new(text.as_bytes()) };
        lines.map(|words| words.map(|word| std::str::from_utf8(word.bytes).unwrap()).collect()).collect()
    }

    #[test]
    fn lines_have_words_and_no_comments() {
        assert_eq!(lines("a b\r\n\n# c\n  d\te # f\ng", false), [vec!["a", "b"], vec!["d", "e"], vec!["g"]]);
        assert_eq!(lines("a \\\nb\nc", true), [vec!["a", "\\", "b"], vec!["c"]]);
        assert_eq!(lines("a \\", true), [vec!["a", "\\"]]);
        assert!(lines("", true).is_empty());
    }

    #[test]
    fn numbers_are_finite() {
        let word = |bytes| MeshWord { bytes, start: 3 };
        assert_eq!(word(b"-1.5e3").number("x"), Ok(-1500.0));
        let text = [&b"nan"[..], b"inf", b"1e999", b"-infinity"];
        for bytes in text {
            assert_eq!(word(bytes).number("x"), Err(MeshFault::NotFinite("x".into()).at(3..3 + bytes.len())));
        }
        for bytes in [&b"1,5"[..], b"x", b"\xff"] {
            assert_eq!(word(bytes).number("x"), Err(MeshFault::NoNumber("x".into()).at(3..3 + bytes.len())));
        }
    }

    #[test]
    fn what_is_missing_is_missing_behind_the_last_character() {
        let mut words = MeshWords::new(b"a b \n", 0..5);
        assert_eq!(words.next().map(|word| word.span()), Some(0..1));
        assert_eq!(words.rest_of_line(), b"b");
        assert_eq!(words.expect("c"), Err(MeshFault::CutOff("c".into()).at(2..3)));
        assert_eq!(MeshWords::new(b"", 0..0).end(), 0..0);
    }
}

//! NFF text as a stream of words: what stands between blanks, without `#` comments. Lines mean nothing else.

use std::ops::Range;

/// One word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// The word itself, never empty.
    pub word: &'a str,
    /// Where it begins, in bytes.
    pub start: usize,
}

impl Token<'_> {
    /// The bytes that it takes.
    pub fn span(&self) -> Range<usize> {
        self.start..self.start + self.word.len()
    }

    /// Whether it is written as a number, be it a good one or not.
    pub fn begins_a_number(&self) -> bool {
        self.word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
    }

    /// The word as far as a message has room for it.
    pub fn shown(&self) -> String {
        const ROOM: usize = 40;
        self.word.chars().take(ROOM).collect()
    }
}

/// The words of a stretch of text, from the first.
#[derive(Clone, Debug)]
pub struct Tokens<'a> {
    text: &'a str,
    /// Where the search for the word behind `next` begins.
    at: usize,
    next: Option<Token<'a>>,
}

impl<'a> Tokens<'a> {
    /// The words of a stretch of `text` that neither begins nor ends within a word or a comment.
    pub fn new(text: &'a str, stretch: Range<usize>) -> Self {
        // Some editors begin a file with a byte order mark; it is no word.
        let is_marked = stretch.start == 0 && text.starts_with('\u{feff}');
        let at = if is_marked { '\u{feff}'.len_utf8() } else { stretch.start };
        let mut tokens = Self { text: &text[..stretch.end], at, next: None };
        tokens.take();
        tokens
    }

    /// The next word, which stays the next.
    #[inline]
    pub fn peek(&self) -> Option<Token<'a>> {
        self.next
    }

    /// Takes the next word.
    #[inline]
    pub fn take(&mut self) -> Option<Token<'a>> {
        let token = self.next;
        self.next = self.scan();
        token
    }

    /// Bytes of the stretch from the next word on.
    pub fn bytes_left(&self) -> usize {
        self.next.map_or(0, |token| self.text.len() - token.start)
    }

    fn scan(&mut self) -> Option<Token<'a>> {
        let bytes = self.text.as_bytes();
        let until = |from: usize, stop: fn(&u8) -> bool| {
            bytes[from..].iter().position(stop).map_or(bytes.len(), |length| from + length)
        };
        let mut start = until(self.at, |byte| !byte.is_ascii_whitespace());
        while bytes.get(start) == Some(&b'#') {
            let line_end = until(start, |&byte| byte == b'\n');
            start = until(line_end, |byte| !byte.is_ascii_whitespace());
        }
        self.at = until(start, u8::is_ascii_whitespace);
        // Blanks are ASCII, so both ends are on character boundaries.
        (start < self.at).then(|| Token { word: &self.text[start..self.at], start })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_between_blanks_and_comments_are_none() {
        let text = "\u{feff}# a\nb  .1 -2e3\r\n#p 3\n\tö#x # last";
        let mut tokens = Tokens::new(text, 0..text.len());
        let words: Vec<_> = std::iter::from_fn(|| tokens.take()).collect();
        assert_eq!(words.iter().map(|t| t.word).collect::<Vec<_>>(), ["b", ".1", "-2e3", "ö#x"]);
        assert!(words.iter().all(|t| &text[t.span()] == t.word));
        assert_eq!((tokens.peek(), tokens.bytes_left()), (None, 0));
    }
}

//! NFF text as a stream of words: what stands between blanks, without `#` comments. Lines mean nothing else.

use std::ops::Range;

/// One word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NffToken<'a> {
    /// The word itself, never empty.
    pub word: &'a str,
    /// Where it begins, in bytes.
    pub start: usize,
}

impl NffToken<'_> {
    /// The bytes that it takes.
    pub fn span(&self) -> Range<usize> {
        self.start..self.start + self.word.len()
    }

    /// Whether it is written as a number, be it a good one or not.
    pub fn begins_a_number(&self) -> bool {
        self.word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
    }

    /// The number that the word writes, as [`f64::from_str`](std::str::FromStr) reads it.
    #[inline]
    pub fn number(&self) -> Option<f64> {
        plain_decimal(self.word.as_bytes()).or_else(|| self.word.parse().ok())
    }

    /// The word as far as a message has room for it.
    pub fn shown(&self) -> String {
        const ROOM: usize = 40;
        self.word.chars().take(ROOM).collect()
    }
}

/// A decimal of up to 15 digits without an exponent, which are most of all words: its digits as a whole
/// number and the power of ten below them are both exact, so their quotient is rounded once (Clinger: How to
/// read floating point numbers accurately, PLDI 1990). `None` for every other word.
#[inline]
fn plain_decimal(word: &[u8]) -> Option<f64> {
    /// A whole number of so many digits is below 2^53.
    const DIGITS: usize = 15;
    /// By their exponents; up to 22 they are exact.
    const POWERS_OF_TEN: [f64; DIGITS + 1] =
        [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let (is_negative, size) = match word {
        [b'-', size @ ..] => (true, size),
        size => (false, size),
    };
    let point = size.iter().position(|&byte| byte == b'.');
    let digits = size.len() - usize::from(point.is_some());
    if digits == 0 || digits > DIGITS {
        return None;
    }
    let mut whole = 0_u64;
    for (place, byte) in size.iter().enumerate() {
        match byte {
            b'0'..=b'9' => whole = 10 * whole + u64::from(byte - b'0'),
            _ if point == Some(place) => {}
            _ => return None,
        }
    }
    let number = whole as f64 / POWERS_OF_TEN[point.map_or(0, |point| size.len() - point - 1)];
    Some(if is_negative { -number } else { number })
}

/// The words of a stretch of text, from the first.
#[derive(Clone, Debug)]
pub struct Tokens<'a> {
    text: &'a str,
    /// Where the search for the word behind `next` begins.
    at: usize,
    next: Option<NffToken<'a>>,
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
    pub fn peek(&self) -> Option<NffToken<'a>> {
        self.next
    }

    /// The next word, if no line ends between it and a place before it, in bytes.
    pub fn peek_on_line(&self, after: usize) -> Option<NffToken<'a>> {
        self.next.filter(|token| !self.text[after..token.start].contains('\n'))
    }

    /// Takes the next word.
    #[inline]
    pub fn take(&mut self) -> Option<NffToken<'a>> {
        let token = self.next;
        self.next = self.scan();
        token
    }

    /// Bytes of the stretch from the next word on.
    pub fn bytes_left(&self) -> usize {
        self.next.map_or(0, |token| self.text.len() - token.start)
    }

    fn scan(&mut self) -> Option<NffToken<'a>> {
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
        (start < self.at).then(|| NffToken { word: &self.text[start..self.at], start })
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

    #[test]
    fn numbers_are_those_that_rust_reads() {
        let agrees = |word: &str| {
            let read = NffToken { word, start: 0 }.number().map(f64::to_bits);
            assert_eq!(read, word.parse::<f64>().ok().map(f64::to_bits), "{word}");
        };
        // All words of up to four of these.
        let mut words = vec![String::new()];
        for _ in 0..4 {
            let longer = words.iter().flat_map(|word| "-+.e017".chars().map(move |c| format!("{word}{c}")));
            words = longer.chain([String::new()]).collect();
            for word in &words {
                agrees(word);
            }
        }
        // Digits of ⅓, π and of what lies in the middle between two numbers, with the point at every place.
        for digits in ["333333333333333333", "314159265358979323", "900719925474099399", "000000000000000001"]
        {
            for length in 1..=digits.len() {
                for point in 0..=length {
                    let word = format!("{}.{}", &digits[..point], &digits[point..length]);
                    agrees(&word);
                    agrees(&format!("-{word}"));
                }
            }
        }
    }
}

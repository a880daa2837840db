//! Numbers and words in the values of SVG attributes.

/// What is left of a value.
#[derive(Clone, Copy, Debug)]
pub struct TextScan<'a> {
    rest: &'a str,
}

impl<'a> TextScan<'a> {
    /// All of a value.
    pub fn of(value: &'a str) -> Self {
        Self { rest: value.trim_ascii_start() }
    }

    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// The first few letters of what is left, to be shown.
    pub fn shown(&self) -> String {
        self.rest.chars().take(20).collect()
    }

    /// Passes over blanks, and one comma among them.
    fn pass_separator(&mut self) {
        self.rest = self.rest.trim_ascii_start();
        self.rest = self.rest.strip_prefix(',').unwrap_or(self.rest).trim_ascii_start();
    }

    /// The next letter, where it is one that `is_wanted`.
    pub fn letter(&mut self, is_wanted: impl Fn(char) -> bool) -> Option<char> {
        let letter = self.rest.chars().next().filter(|&letter| is_wanted(letter))?;
        self.rest = &self.rest[letter.len_utf8()..];
        self.pass_separator();
        Some(letter)
    }

    /// The letters up to the next that is none.
    pub fn word(&mut self) -> &'a str {
        let end = self.rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(self.rest.len());
        let word;
        (word, self.rest) = self.rest.split_at(end);
        self.rest = self.rest.trim_ascii_start();
        word
    }

    /// The next number, where there is one; it may not be finite. `1.5.5` are two, and so are `1-1`.
    pub fn number(&mut self) -> Option<f64> {
        let bytes = self.rest.as_bytes();
        let digits =
            |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
        let whole = digits(sign(0));
        let mut end = if bytes.get(whole) == Some(&b'.') { digits(whole + 1) } else { whole };
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let exponent = sign(end + 1);
            // Without digits the letter is the beginning of a unit, such as `em`.
            end = if digits(exponent) > exponent { digits(exponent) } else { end };
        }
        let number = self.rest[..end].parse().ok()?;
        self.rest = &self.rest[end..];
        self.pass_separator();
        Some(number)
    }

    /// The next flag of an arc, 0 or 1, which needs nothing between it and what follows.
    pub fn flag(&mut self) -> Option<bool> {
        self.letter(|letter| matches!(letter, '0' | '1')).map(|letter| letter == '1')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_the_next_begins() {
        let numbers = |value: &str| {
            let mut scan = TextScan::of(value);
            let found: Vec<f64> = std::iter::from_fn(|| scan.number()).collect();
            (found, scan.shown())
        };
        assert_eq!(numbers(" 1.5.5-1e1,2 , +3."), (vec![1.5, 0.5, -10.0, 2.0, 3.0], String::new()));
        assert_eq!(numbers("4mm"), (vec![4.0], "mm".to_owned()));
        assert_eq!(numbers("4em"), (vec![4.0], "em".to_owned()));
        assert_eq!(numbers("1,,2"), (vec![1.0], ",2".to_owned()));
        assert_eq!(numbers("1e999").0, [f64::INFINITY]);
        for none in ["", ".", "-", "e5", "nan", "inf", "−1"] {
            assert!(numbers(none).0.is_empty(), "{none}");
        }
        let mut arc = TextScan::of("113 4");
        assert_eq!(
            (arc.flag(), arc.flag(), arc.number(), arc.flag()),
            (Some(true), Some(true), Some(3.0), None)
        );
    }
}

//! A DXF file as what it is: pairs of lines, a code that says what comes, and its value.

use std::borrow::Cow;

use crate::scene::drawing::DrawingFault;

/// A code and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct DxfGroup<'a> {
    /// What the value is.
    pub code: i64,
    /// The value, without blanks around it.
    pub value: Cow<'a, str>,
    /// The line of the value, from 1.
    pub line: usize,
}

/// The pairs of a file.
pub struct DxfGroups<'a> {
    lines: std::slice::Split<'a, u8, fn(&u8) -> bool>,
    line: usize,
}

impl<'a> DxfGroups<'a> {
    /// Those of a file.
    pub fn of(bytes: &'a [u8]) -> Self {
        let is_end: fn(&u8) -> bool = |&byte| byte == b'\n';
        Self { lines: bytes.split(is_end), line: 0 }
    }

    fn next_line(&mut self) -> Option<Cow<'a, str>> {
        self.line += 1;
        self.lines.next().map(|line| String::from_utf8_lossy(line.trim_ascii()))
    }
}

impl<'a> Iterator for DxfGroups<'a> {
    type Item = Result<DxfGroup<'a>, DrawingFault>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let code = self.next_line()?;
            let at = self.line;
            let value = self.next_line();
            if code.is_empty() && value.as_ref().is_none_or(|value| value.is_empty()) {
                // Empty lines at the end, of which the last that is split off is always one.
                continue;
            }
            let Ok(code) = code.parse() else {
                let message =
                    "a group code is expected here, a whole number: this is no DXF file, or is damaged";
                return Some(Err(DrawingFault::at(at, message)));
            };
            return Some(match value {
                Some(value) => Ok(DxfGroup { code, value, line: self.line }),
                None => Err(DrawingFault::at(at, "the file is cut off: a value is missing after this code")),
            });
        }
    }
}

impl DxfGroup<'_> {
    /// The value as a finite number.
    pub fn number(&self) -> Result<f64, DrawingFault> {
        match self.value.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(DrawingFault::at(self.line, "this is not a finite number")),
            Err(_) => Err(DrawingFault::at(self.line, "a number is expected here")),
        }
    }
}

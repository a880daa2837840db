//! The 13 levels of a picture as text, one character a dot: the form to keep in a test. Written, and read
//! again.

use std::io::{self, Write};

use thiserror::Error;

use crate::math::{Grid, Size};
use crate::tone::Level;

/// One character per dot, `0` to `9`, `A`, `B`, `C`; one line per row of dots.
pub fn levels(levels: &Grid<Level>, out: &mut impl Write) -> io::Result<()> {
    let mut line = String::new();
    for row in levels.rows() {
        line.clear();
        line.extend(row.iter().map(|level| level.digit()));
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// Why a text is no picture of levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum LevelsError {
    /// It has no dots.
    #[error("it has no dots")]
    Empty,
    /// A character that stands for no level.
    #[error("line {line}, column {column}: {found:?} is no level, which are 0 to 9 and A to C")]
    Character {
        /// From 1.
        line: usize,
        /// From 1, in bytes.
        column: usize,
        /// The byte, as a character where it is one of ASCII.
        found: char,
    },
    /// A row of another length than the first.
    #[error("line {line} has {dots} dots, the first has {first}")]
    Ragged {
        /// From 1.
        line: usize,
        /// Its dots.
        dots: usize,
        /// Those of the first line.
        first: usize,
    },
    /// More dots than 32 bits count.
    #[error("it has more dots than a picture can have")]
    TooLarge,
}

/// The picture that [`levels`] wrote. Lines may end as on Windows, the last may lack its end.
///
/// # Errors
/// The text is none: no dots, a character that is no level, or rows of different lengths.
pub fn read_levels(text: &[u8]) -> Result<Grid<Level>, LevelsError> {
    let text = text.strip_suffix(b"\n").unwrap_or(text);
    let mut values = Vec::with_capacity(text.len());
    let mut first = None;
    let mut rows = 0;
    for (number, line) in text.split(|&byte| byte == b'\n').enumerate() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        for (place, &byte) in line.iter().enumerate() {
            let level = char::from(byte).to_digit(13).filter(|_| !byte.is_ascii_lowercase());
            let level = level.and_then(|digit| Level::new(digit as u8)).ok_or(LevelsError::Character {
                line: number + 1,
                column: place + 1,
                found: if byte.is_ascii() { char::from(byte) } else { char::REPLACEMENT_CHARACTER },
            })?;
            values.push(level);
        }
        let first = *first.get_or_insert(line.len());
        if line.len() != first {
            return Err(LevelsError::Ragged { line: number + 1, dots: line.len(), first });
        }
        rows += 1;
    }
    let columns = first.unwrap_or(0);
    if columns == 0 {
        return Err(LevelsError::Empty);
    }
    let side = |n: usize| u32::try_from(n).map_err(|_| LevelsError::TooLarge);
    Ok(Grid::from_values(Size::new(side(columns)?, side(rows)?), values))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_levels() -> Grid<Level> {
        Grid::from_values(Size::new(13, 1), Level::all().collect())
    }

    #[test]
    fn levels_are_one_character_each() {
        let mut out = Vec::new();
        levels(&all_levels(), &mut out).expect("a vector takes every byte");
        assert_eq!(out, b"0123456789ABC\n");
    }

    #[test]
    fn what_is_written_is_read_again() {
        assert_eq!(read_levels(b"0123456789ABC\n"), Ok(all_levels()));
        assert_eq!(read_levels(b"01\r\nAB"), read_levels(b"01\nAB\n"));
    }

    #[test]
    fn what_is_no_picture_says_where() {
        let character = |line, column, found| Err(LevelsError::Character { line, column, found });
        for (text, expected) in [
            (&b""[..], Err(LevelsError::Empty)),
            (b"\n\n", Err(LevelsError::Empty)),
            (b"01\n0D\n", character(2, 2, 'D')),
            (b"0a\n", character(1, 2, 'a')),
            (b"0\xff\n", character(1, 2, char::REPLACEMENT_CHARACTER)),
            (b"012\n01\n", Err(LevelsError::Ragged { line: 2, dots: 2, first: 3 })),
            (b"01\n\n01\n", Err(LevelsError::Ragged { line: 2, dots: 0, first: 2 })),
        ] {
            assert_eq!(read_levels(text), expected, "{text:?}");
        }
    }
}

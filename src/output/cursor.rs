//! How the cursor gets from one place to another.

use std::fmt::Write as _;

/// A place on the screen: column and row, from 0.
pub type Place = (u32, u32);

/// A way of the cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hop {
    /// None: it is there.
    Stay,
    /// So many columns to the right (CUF).
    Right(u32),
    /// To the first column some rows below (CR, LF), and so many columns to the right.
    Lines(u32, u32),
    /// To a place (CUP).
    To(Place),
}

impl Hop {
    /// The shortest way. Where the cursor is may be unknown: behind the last column, and behind what may be
    /// two columns wide.
    pub fn shortest(from: Option<Place>, to: Place) -> Self {
        let absolute = Self::To(to);
        match from {
            Some(from) if from == to => Self::Stay,
            Some((x, y)) if y == to.1 && x < to.0 => Self::Right(to.0 - x),
            Some((_, y)) if y < to.1 => {
                let lines = Self::Lines(to.1 - y, to.0);
                if lines.bytes() < absolute.bytes() { lines } else { absolute }
            }
            _ => absolute,
        }
    }

    /// How many bytes it takes.
    pub fn bytes(self) -> u32 {
        match self {
            Self::Stay | Self::Right(0) => 0,
            Self::Right(1) | Self::To((0, 0)) => 3,
            Self::Right(columns) => 3 + digits(columns),
            Self::Lines(rows, columns) => 1 + rows + Self::Right(columns).bytes(),
            Self::To((0, y)) => 3 + digits(y + 1),
            Self::To((x, y)) => 4 + digits(x + 1) + digits(y + 1),
        }
    }

    /// Appends it.
    pub fn put(self, line: &mut String) {
        // A string takes every character.
        let _ = match self {
            Self::Stay | Self::Right(0) => Ok(()),
            Self::Right(1) => line.write_str("\x1b[C"),
            Self::Right(columns) => write!(line, "\x1b[{columns}C"),
            Self::Lines(rows, columns) => {
                line.push('\r');
                line.extend((0..rows).map(|_| '\n'));
                return Self::Right(columns).put(line);
            }
            Self::To((0, 0)) => line.write_str("\x1b[H"),
            Self::To((0, y)) => write!(line, "\x1b[{}H", y + 1),
            Self::To((x, y)) => write!(line, "\x1b[{};{}H", y + 1, x + 1),
        };
    }
}

/// The digits of a number above 0.
const fn digits(number: u32) -> u32 {
    number.ilog10() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(from: Option<Place>, to: Place) -> String {
        let hop = Hop::shortest(from, to);
        let mut line = String::new();
        hop.put(&mut line);
        assert_eq!(line.len(), hop.bytes() as usize, "{hop:?}");
        line
    }

    #[test]
    fn the_shortest_way_is_taken() {
        assert_eq!(way(None, (0, 0)), "\x1b[H");
        assert_eq!(way(None, (0, 9)), "\x1b[10H");
        assert_eq!(way(None, (8, 9)), "\x1b[10;9H");
        assert_eq!(way(Some((8, 9)), (8, 9)), "");
        assert_eq!(way(Some((8, 9)), (9, 9)), "\x1b[C");
        assert_eq!(way(Some((8, 9)), (18, 9)), "\x1b[10C");
        assert_eq!(way(Some((8, 9)), (7, 9)), "\x1b[10;8H", "none goes back");
        assert_eq!(way(Some((8, 9)), (0, 11)), "\r\n\n");
        assert_eq!(way(Some((8, 9)), (20, 10)), "\r\n\x1b[20C");
        assert_eq!(way(Some((8, 9)), (20, 13)), "\x1b[14;21H");
        assert_eq!(way(Some((8, 9)), (0, 4)), "\x1b[5H");
    }
}

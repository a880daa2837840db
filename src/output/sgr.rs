//! Colours and attributes as a terminal is told them: SGR sequences, and the shortest way from one to
//! another.

use std::fmt::Write as _;

use crate::glyph::Paint;

/// A colour that a terminal can be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Color {
    /// The terminal's own ink or paper.
    Terminal,
    /// One of the 16 attributes of a PC's text screen, below 16.
    Attribute(u8),
    /// One of the 256 of xterm.
    Indexed(u8),
    /// Red, green and blue.
    Rgb([u8; 3]),
}

impl From<Paint> for Color {
    fn from(paint: Paint) -> Self {
        match paint {
            Paint::Terminal => Self::Terminal,
            Paint::Black => Self::Attribute(0),
            Paint::DarkGray => Self::Attribute(8),
            Paint::LightGray => Self::Attribute(7),
            Paint::White => Self::Attribute(15),
            Paint::Indexed(index) => Self::Indexed(index),
            Paint::Rgb(rgb) => Self::Rgb(rgb),
        }
    }
}

/// What characters are written with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pen {
    /// The colour of the strokes.
    pub ink: Color,
    /// The colour behind them.
    pub paper: Color,
    /// Bold, or bright.
    pub bold: bool,
    /// Faint.
    pub dim: bool,
    /// Ink and paper in each other's place.
    pub reversed: bool,
}

impl Pen {
    /// What a terminal writes with when it has been told nothing.
    pub const TERMINAL: Self =
        Self { ink: Color::Terminal, paper: Color::Terminal, bold: false, dim: false, reversed: false };

    /// A pen of two colours and no attributes.
    pub const fn new(ink: Color, paper: Color) -> Self {
        Self { ink, paper, ..Self::TERMINAL }
    }

    /// The pen nearest to this one that shows the same blank as `other`: strokes that are not there have no
    /// colour.
    #[must_use]
    pub fn for_blank(self, other: Self) -> Self {
        if other.reversed {
            Self { paper: self.paper, ..other }
        } else {
            Self { paper: other.paper, reversed: false, ..self }
        }
    }

    /// Changes the pen to `next`, and appends the shortest sequence that says so.
    pub fn change_to(&mut self, next: Self, line: &mut String) {
        if *self != next {
            let from = line.len();
            line.push_str("\x1b[");
            self.put_changes(next, line);
            let begin = line.len();
            // 0 is all that the terminal has by itself, and may be left out alone.
            if next != Self::TERMINAL {
                line.push('0');
                Self::TERMINAL.put_changes_after(next, line);
            }
            let (changes, anew) = (begin - from - 2, line.len() - begin);
            if anew < changes {
                line.replace_range(from + 2..begin, "");
            } else {
                line.truncate(begin);
            }
            line.push('m');
        }
        *self = next;
    }

    /// Appends the parameters that change this pen to `next`.
    fn put_changes(self, next: Self, line: &mut String) {
        let begin = line.len();
        self.put_changes_after(next, line);
        // All but the first are parted from the one before.
        if line.len() > begin {
            line.remove(begin);
        }
    }

    /// The same after other parameters.
    fn put_changes_after(self, next: Self, line: &mut String) {
        let (mut bold, mut dim) = (self.bold, self.dim);
        if (bold && !next.bold) || (dim && !next.dim) {
            // One parameter takes back both.
            line.push_str(";22");
            (bold, dim) = (false, false);
        }
        if next.bold && !bold {
            line.push_str(";1");
        }
        if next.dim && !dim {
            line.push_str(";2");
        }
        if next.reversed != self.reversed {
            line.push_str(if next.reversed { ";7" } else { ";27" });
        }
        if next.ink != self.ink {
            put_color(next.ink, 0, line);
        }
        if next.paper != self.paper {
            // What a paper has in place of an ink's 30 to 39 and 90 to 97.
            put_color(next.paper, 10, line);
        }
    }
}

/// Appends the parameters of a colour: 30 + attribute, 90 + attribute for a bright one (aixterm), 39 for the
/// terminal's own; 38;5 and a number, or 38;2 and three bytes (with semicolons as xterm had them first, which
/// every terminal reads).
fn put_color(color: Color, add: u8, line: &mut String) {
    // A string takes every character.
    let _ = match color {
        Color::Terminal => write!(line, ";{}", 39 + add),
        Color::Attribute(attribute @ 0..8) => write!(line, ";{}", 30 + add + attribute),
        Color::Attribute(attribute) => write!(line, ";{}", 90 + add + attribute % 8),
        Color::Indexed(index) => write!(line, ";{};5;{index}", 38 + add),
        Color::Rgb([r, g, b]) => write!(line, ";{};2;{r};{g};{b}", 38 + add),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(mut from: Pen, to: Pen) -> String {
        let mut line = String::new();
        from.change_to(to, &mut line);
        line
    }

    const GRAY: Color = Color::Attribute(7);
    const BLACK: Color = Color::Attribute(0);

    #[test]
    fn only_what_changes_is_told() {
        let gray = Pen::new(GRAY, BLACK);
        assert_eq!(change(Pen::TERMINAL, gray), "\x1b[37;40m");
        assert_eq!(change(gray, gray), "");
        assert_eq!(change(gray, Pen { ink: Color::Attribute(8), ..gray }), "\x1b[90m");
        assert_eq!(change(gray, Pen { paper: Color::Attribute(15), ..gray }), "\x1b[107m");
        assert_eq!(change(gray, Pen { paper: Color::Indexed(240), ..gray }), "\x1b[48;5;240m");
        assert_eq!(change(gray, Pen { ink: Color::Rgb([1, 2, 3]), ..gray }), "\x1b[38;2;1;2;3m");
        assert_eq!(change(gray, Pen { paper: Color::Terminal, ..gray }), "\x1b[49m");
        assert_eq!(change(gray, Pen::TERMINAL), "\x1b[m");
    }

    #[test]
    fn attributes_come_and_go() {
        let bold = Pen { bold: true, ..Pen::TERMINAL };
        let dim = Pen { dim: true, ..Pen::TERMINAL };
        let reversed = Pen { reversed: true, ..Pen::TERMINAL };
        assert_eq!(change(Pen::TERMINAL, bold), "\x1b[1m");
        assert_eq!(change(bold, dim), "\x1b[0;2m");
        assert_eq!(change(reversed, bold), "\x1b[0;1m");
        assert_eq!(change(reversed, Pen { bold: true, ..reversed }), "\x1b[1m");
        let gray = Pen::new(GRAY, BLACK);
        assert_eq!(change(Pen { bold: true, ..gray }, gray), "\x1b[22m");
        assert_eq!(change(Pen { bold: true, ..gray }, Pen { dim: true, ..gray }), "\x1b[22;2m");
        assert_eq!(change(Pen { reversed: true, ..gray }, gray), "\x1b[27m");
    }

    #[test]
    fn a_blank_needs_no_ink() {
        let (gray, white) = (Pen::new(GRAY, BLACK), Pen::new(Color::Attribute(15), BLACK));
        assert_eq!(gray.for_blank(white), gray);
        assert_eq!(gray.for_blank(Pen { bold: true, ..white }), gray);
        let reversed = Pen { reversed: true, ..white };
        assert_eq!(gray.for_blank(reversed), reversed, "its ink is what shows");
        assert_eq!(reversed.for_blank(gray), Pen { reversed: false, ..reversed });
    }
}

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

impl Color {
    /// Whether it is an attribute that some terminals have as ink only.
    pub const fn is_bright(self) -> bool {
        matches!(self, Self::Attribute(8..))
    }
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
        if let Some(parameters) = self.parameters(next) {
            parameters.put(line);
        }
        *self = next;
    }

    /// How many bytes [`Pen::change_to`] appends.
    #[inline]
    pub fn distance(self, next: Self) -> u32 {
        self.parameters(next).map_or(0, |parameters| parameters.bytes())
    }

    /// What changes this pen to `next`: what differs, or all of it after a 0, whichever is shorter; absent
    /// where nothing differs.
    fn parameters(self, next: Self) -> Option<Parameters> {
        if self == next {
            return None;
        }
        let mut changes = Parameters::default();
        self.changes(next, &mut changes);
        let mut anew = Parameters::default();
        // 0 is all that the terminal has by itself, and may be left out alone.
        if next != Self::TERMINAL {
            anew.push(0);
            Self::TERMINAL.changes(next, &mut anew);
        }
        Some(if anew.bytes() < changes.bytes() { anew } else { changes })
    }

    fn changes(self, next: Self, into: &mut Parameters) {
        let (mut bold, mut dim) = (self.bold, self.dim);
        if (bold && !next.bold) || (dim && !next.dim) {
            // One parameter takes back both.
            into.push(22);
            (bold, dim) = (false, false);
        }
        if next.bold && !bold {
            into.push(1);
        }
        if next.dim && !dim {
            into.push(2);
        }
        if next.reversed != self.reversed {
            into.push(if next.reversed { 7 } else { 27 });
        }
        if next.ink != self.ink {
            into.push_color(next.ink, 0);
        }
        if next.paper != self.paper {
            // What a paper has in place of an ink's 30 to 39 and 90 to 97.
            into.push_color(next.paper, 10);
        }
    }
}

/// The numbers of one SGR sequence.
#[derive(Clone, Copy, Debug, Default)]
struct Parameters {
    /// At most one that takes back or resets, two that set, one that reverses, and five for each color.
    numbers: [u8; 14],
    count: usize,
    /// The digits of all of them.
    digits: u32,
}

impl Parameters {
    #[inline]
    fn push(&mut self, number: u8) {
        self.numbers[self.count] = number;
        self.count += 1;
        self.digits += 1 + u32::from(number >= 10) + u32::from(number >= 100);
    }

    fn push_all<const N: usize>(&mut self, numbers: [u8; N]) {
        for number in numbers {
            self.push(number);
        }
    }

    /// Pushes those of a colour: 30 + attribute, 90 + attribute for a bright one (aixterm), 39 for the
    /// terminal's own; 38;5 and a number, or 38;2 and three bytes (with semicolons as xterm had them first,
    /// which every terminal reads).
    fn push_color(&mut self, color: Color, add: u8) {
        match color {
            Color::Terminal => self.push(39 + add),
            Color::Attribute(attribute @ 0..8) => self.push(30 + add + attribute),
            Color::Attribute(attribute) => self.push(90 + add + attribute % 8),
            Color::Indexed(index) => self.push_all([38 + add, 5, index]),
            Color::Rgb([r, g, b]) => self.push_all([38 + add, 2, r, g, b]),
        }
    }

    /// Of the whole sequence: ESC, `[`, the numbers with what parts them, `m`.
    #[inline]
    fn bytes(&self) -> u32 {
        3 + self.digits + (self.count as u32).saturating_sub(1)
    }

    fn put(&self, line: &mut String) {
        line.push_str("\x1b[");
        for (place, number) in self.numbers[..self.count].iter().enumerate() {
            if place > 0 {
                line.push(';');
            }
            // A string takes every character.
            let _ = write!(line, "{number}");
        }
        line.push('m');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(mut from: Pen, to: Pen) -> String {
        let mut line = String::new();
        let told = from.distance(to);
        from.change_to(to, &mut line);
        assert_eq!(line.len(), told as usize);
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

//! Two screens to the bytes that turn one into the other, as few as are simple to find.

use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{self, Modifier};
use ratatui::text::Span;

use crate::output::{Color, Pen};

/// The bytes for a terminal, and what it writes with after them.
#[derive(Debug)]
pub struct Encoder {
    pen: Pen,
    bytes: String,
}

impl Default for Encoder {
    fn default() -> Self {
        Self { pen: Pen::TERMINAL, bytes: String::new() }
    }
}

/// A place on the screen: column and row, from 0.
type Place = (u16, u16);

impl Encoder {
    /// Forgets what the terminal writes with, and clears it.
    pub fn clear(&mut self) {
        self.pen = Pen::TERMINAL;
        self.bytes.push_str("\x1b[m\x1b[2J");
    }

    /// Appends what turns a screen that shows `before` into one that shows `after`, of the same size. Bold,
    /// dim and reversed are all the modifiers that it knows.
    pub fn turn(&mut self, before: &Buffer, after: &Buffer) {
        // Somebody else may have moved the cursor: a place is absolute first.
        let mut cursor = None;
        for y in after.area.rows().map(|row| row.y) {
            let mut x = after.area.x;
            while x < after.area.right() {
                let cell = &after[(x, y)];
                // The second column of a wide character is nobody's when that goes.
                let orphan = x > after.area.x && !is_one_column(before[(x - 1, y)].symbol());
                if orphan || look(&before[(x, y)]) != look(cell) {
                    self.go(cursor, (x, y), after);
                    self.put(cell);
                    let known = is_one_column(cell.symbol()) && x + 1 < after.area.right();
                    cursor = known.then_some((x + 1, y));
                }
                x += columns(cell.symbol());
            }
        }
    }

    /// How many bytes there are.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Takes the bytes out.
    pub fn take(&mut self) -> String {
        std::mem::take(&mut self.bytes)
    }

    fn put(&mut self, cell: &Cell) {
        self.pen.change_to(self.pen_of(cell), &mut self.bytes);
        self.bytes.push_str(cell.symbol());
    }

    fn pen_of(&self, cell: &Cell) -> Pen {
        let meant = meant(cell);
        if cell.symbol() == " " { self.pen.for_blank(meant) } else { meant }
    }

    /// Moves the cursor, by what stands between where that is shorter. The cursor's own place is absent where
    /// it is not known: behind the last column, and behind what may be two columns wide.
    fn go(&mut self, from: Option<Place>, to: Place, screen: &Buffer) {
        // A string takes every character.
        let _ = match from {
            Some(from) if from == to => Ok(()),
            Some((x, y)) if y == to.1 && x < to.0 => {
                let columns = to.0 - x;
                let way = if columns == 1 { "\x1b[C".to_owned() } else { format!("\x1b[{columns}C") };
                match self.between(x, to, way.len(), screen) {
                    Some(cells) => self.bytes.write_str(&cells),
                    None => self.bytes.write_str(&way),
                }
            }
            Some((_, y)) if to == (0, y + 1) => self.bytes.write_str("\r\n"),
            _ => match to {
                (0, 0) => self.bytes.write_str("\x1b[H"),
                (0, y) => write!(self.bytes, "\x1b[{}H", y + 1),
                (x, y) => write!(self.bytes, "\x1b[{};{}H", y + 1, x + 1),
            },
        };
    }

    /// What stands between a column and a place to the right of it, where that is written with the same pen
    /// and in no more than so many bytes.
    fn between(&self, from: u16, to: Place, bytes: usize, screen: &Buffer) -> Option<String> {
        let mut text = String::new();
        for x in from..to.0 {
            let cell = &screen[(x, to.1)];
            if !is_one_column(cell.symbol()) || self.pen_of(cell) != self.pen {
                return None;
            }
            text.push_str(cell.symbol());
            if text.len() > bytes {
                return None;
            }
        }
        Some(text)
    }
}

/// What can be seen of a cell.
fn look(cell: &Cell) -> (&str, Pen) {
    let pen = meant(cell);
    (cell.symbol(), if cell.symbol() == " " { Pen::TERMINAL.for_blank(pen) } else { pen })
}

fn meant(cell: &Cell) -> Pen {
    Pen {
        ink: color(cell.fg),
        paper: color(cell.bg),
        bold: cell.modifier.contains(Modifier::BOLD),
        dim: cell.modifier.contains(Modifier::DIM),
        reversed: cell.modifier.contains(Modifier::REVERSED),
    }
}

/// ratatui calls attribute 7 `Gray`.
const fn color(color: style::Color) -> Color {
    Color::Attribute(match color {
        style::Color::Reset => return Color::Terminal,
        style::Color::Rgb(r, g, b) => return Color::Rgb([r, g, b]),
        style::Color::Indexed(index) => return Color::Indexed(index),
        style::Color::Black => 0,
        style::Color::Red => 1,
        style::Color::Green => 2,
        style::Color::Yellow => 3,
        style::Color::Blue => 4,
        style::Color::Magenta => 5,
        style::Color::Cyan => 6,
        style::Color::Gray => 7,
        style::Color::DarkGray => 8,
        style::Color::LightRed => 9,
        style::Color::LightGreen => 10,
        style::Color::LightYellow => 11,
        style::Color::LightBlue => 12,
        style::Color::LightMagenta => 13,
        style::Color::LightCyan => 14,
        style::Color::White => 15,
    })
}

/// Whether every terminal puts the cursor one column on: Latin letters, and what frames and pictures are made
/// of. Of anything else it is not asked; the next place is then absolute.
fn is_one_column(symbol: &str) -> bool {
    let mut characters = symbol.chars();
    let one = matches!(
        characters.next(),
        Some(
            ' '..='~'
            | '\u{a0}'..='\u{2ff}'
            | '\u{2190}'..='\u{21ff}'
            | '\u{2500}'..='\u{25ff}'
            | '\u{2800}'..='\u{28ff}',
        )
    );
    one && characters.next().is_none()
}

/// How many columns a symbol covers on the screen that is meant.
fn columns(symbol: &str) -> u16 {
    if is_one_column(symbol) { 1 } else { u16::try_from(Span::raw(symbol).width()).unwrap_or(1).max(1) }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU16;

    use proptest::prelude::*;
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    use super::*;

    fn row(text: &str) -> Buffer {
        Buffer::with_lines([text])
    }

    fn turned(before: &Buffer, after: &Buffer) -> String {
        let mut encoder = Encoder::default();
        encoder.turn(before, after);
        encoder.take()
    }

    #[test]
    fn what_stands_already_is_not_sent() {
        assert_eq!(turned(&row("abc"), &row("abc")), "");
        assert_eq!(turned(&row("abc"), &row("abx")), "\x1b[1;3Hx");
        assert_eq!(turned(&row("abc"), &row("xbx")), "\x1b[Hxbx", "one character is shorter than a move");
        assert_eq!(turned(&row("a─────b"), &row("x─────x")), "\x1b[Hx\x1b[5Cx");
        let mut blank = row(" ");
        blank.set_style(blank.area, Style::new().fg(style::Color::White));
        assert_eq!(turned(&row(" "), &blank), "", "nobody sees the ink of a blank");
    }

    #[test]
    fn a_new_row_is_two_bytes_away() {
        let lines = |a: &str, b: &str| Buffer::with_lines([a, b]);
        assert_eq!(turned(&lines("a  ", "b  "), &lines("x  ", "y  ")), "\x1b[Hx\r\ny");
        assert_eq!(
            turned(&lines("a", "b"), &lines("x", "y")),
            "\x1b[Hx\x1b[2Hy",
            "not from behind the last column"
        );
    }

    #[test]
    fn the_pen_stays_from_screen_to_screen() {
        let mut encoder = Encoder::default();
        let mut gray = row("a");
        gray.set_style(gray.area, Style::new().fg(style::Color::Gray).bg(style::Color::Black));
        encoder.turn(&row(" "), &gray);
        assert_eq!(encoder.take(), "\x1b[H\x1b[37;40ma");
        let mut other = gray.clone();
        other[(0, 0)].set_symbol("b");
        encoder.turn(&gray, &other);
        assert_eq!((encoder.len(), encoder.take().as_str()), (4, "\x1b[Hb"));
    }

    const SIZE: Rect = Rect::new(0, 0, 9, 4);

    /// Screens of which many cells are alike, as they are.
    fn screen() -> impl Strategy<Value = Buffer> {
        let symbol = prop::sample::select(vec![" ", " ", "a", "░", "█", "─", "é", "漢", "⣿"]);
        let color = prop::sample::select(vec![
            style::Color::Reset,
            style::Color::Black,
            style::Color::Gray,
            style::Color::White,
            style::Color::Indexed(240),
            style::Color::Rgb(1, 2, 3),
        ]);
        let modifier = prop::sample::select(vec![
            Modifier::empty(),
            Modifier::empty(),
            Modifier::BOLD,
            Modifier::DIM,
            Modifier::REVERSED,
            Modifier::REVERSED | Modifier::BOLD,
        ]);
        let style = (color.clone(), color, modifier)
            .prop_map(|(ink, paper, modifier)| Style::new().fg(ink).bg(paper).add_modifier(modifier));
        prop::collection::vec((symbol, style), SIZE.area() as usize).prop_map(|cells| {
            let mut buffer = Buffer::empty(SIZE);
            for (place, (symbol, style)) in SIZE.positions().zip(cells) {
                // A symbol of two columns has the second, too, and none where there is no room for it.
                let covered = place.x > 0 && buffer[(place.x - 1, place.y)].symbol() == "漢";
                if !covered && (symbol != "漢" || place.x + 1 < SIZE.right()) {
                    buffer.set_string(place.x, place.y, symbol, style);
                }
            }
            buffer
        })
    }

    fn seen(color: style::Color) -> vt100::Color {
        match super::color(color) {
            Color::Terminal => vt100::Color::Default,
            Color::Attribute(index) | Color::Indexed(index) => vt100::Color::Idx(index),
            Color::Rgb([r, g, b]) => vt100::Color::Rgb(r, g, b),
        }
    }

    fn check(terminal: &vt100::Parser, meant: &Buffer) -> Result<(), TestCaseError> {
        for place in SIZE.positions() {
            let (cell, shown) = (&meant[place], terminal.screen().cell(place.y, place.x).unwrap());
            if place.x > 0 && meant[(place.x - 1, place.y)].symbol() == "漢" {
                prop_assert!(shown.is_wide_continuation());
                continue;
            }
            let symbol = if shown.has_contents() { shown.contents() } else { " " };
            prop_assert_eq!(symbol, cell.symbol());
            let blank = symbol == " ";
            let reversed = cell.modifier.contains(Modifier::REVERSED);
            prop_assert_eq!(shown.inverse(), reversed);
            if !blank || reversed {
                prop_assert_eq!(shown.fgcolor(), seen(cell.fg));
            }
            if !blank || !reversed {
                prop_assert_eq!(shown.bgcolor(), seen(cell.bg));
            }
            if !blank {
                prop_assert_eq!(shown.bold(), cell.modifier.contains(Modifier::BOLD));
                prop_assert_eq!(shown.dim(), cell.modifier.contains(Modifier::DIM));
            }
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn a_terminal_shows_what_was_meant(screens in prop::collection::vec(screen(), 1..5)) {
            let [rows, columns] = [SIZE.height, SIZE.width].map(|side| NonZeroU16::new(side).unwrap());
            let mut terminal = vt100::Parser::new(rows, columns, 0);
            let mut encoder = Encoder::default();
            encoder.clear();
            let mut before = Buffer::empty(SIZE);
            for after in screens {
                encoder.turn(&before, &after);
                terminal.process(encoder.take().as_bytes());
                check(&terminal, &after)?;
                before = after;
            }
        }
    }
}

//! ratatui's buffer as a screen that the encoder reads.

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{self, Modifier};
use ratatui::text::Span;

use crate::math::Size;
use crate::output::{Color, Pen, Screen, ScreenCell, Symbol};

/// Bold, dim and reversed are all the modifiers that there are.
impl Screen for Buffer {
    fn size(&self) -> Size {
        Size::new(self.area.width.into(), self.area.height.into())
    }

    fn look(&self, column: u32, row: u32) -> ScreenCell<'_> {
        // Columns and rows of a buffer have 16 bits.
        let cell = &self[(self.area.x + column as u16, self.area.y + row as u16)];
        let symbol = Symbol::new(cell.symbol());
        ScreenCell { symbol, pen: pen(cell), columns: columns(symbol) }
    }
}

fn pen(cell: &Cell) -> Pen {
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

/// How many columns a symbol covers on the screen that is meant.
fn columns(symbol: Symbol<'_>) -> u32 {
    let width = |text: &str| Span::raw(text).width() as u32;
    match symbol {
        _ if symbol.is_one_column() => 1,
        Symbol::Char(character) => width(character.encode_utf8(&mut [0; 4])),
        Symbol::Cluster(text) => width(text),
    }
    .max(1)
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU16;

    use proptest::prelude::*;
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    use super::*;
    use crate::output::Encoder;

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
            let reversed = cell.modifier.contains(Modifier::REVERSED);
            // A full block stands for a blank.
            if symbol == "█" && cell.symbol() == " " {
                prop_assert_eq!((shown.fgcolor(), reversed), (seen(cell.bg), false));
                continue;
            }
            if symbol == " " && cell.symbol() == "█" {
                prop_assert_eq!((shown.bgcolor(), shown.inverse()), (seen(cell.fg), false));
                continue;
            }
            prop_assert_eq!(symbol, cell.symbol());
            let blank = symbol == " ";
            prop_assert_eq!(shown.inverse(), reversed);
            if !blank || reversed {
                prop_assert_eq!(shown.fgcolor(), seen(cell.fg));
            }
            let full = symbol == "█" && cell.modifier.is_empty();
            if (!blank || !reversed) && !full {
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

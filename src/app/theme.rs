//! The styles of the panels: DOS attributes, or the terminal's own ink and paper.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

use crate::glyph::{Ground, Palette};

/// How each part of the screen is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    /// Borders and plain text.
    pub text: Style,
    /// Titles and numbers to notice.
    pub bright: Style,
    /// What did nothing.
    pub dim: Style,
    /// Labels of the function keys.
    pub label: Style,
}

impl Theme {
    /// The styles that go with a picture's palette.
    pub const fn of(palette: Palette) -> Self {
        match palette {
            Palette::Dos(_) | Palette::Gray(_) | Palette::Color(_) => {
                let text = Style::new().fg(Color::Gray).bg(Color::Black);
                Self {
                    text,
                    bright: text.fg(Color::White),
                    dim: text.fg(Color::DarkGray),
                    label: Style::new().fg(Color::Black).bg(Color::Gray),
                }
            }
            Palette::Mono(_) => {
                let text = Style::new();
                Self {
                    text,
                    bright: text.add_modifier(Modifier::BOLD),
                    dim: text.add_modifier(Modifier::DIM),
                    label: text.add_modifier(Modifier::REVERSED),
                }
            }
        }
    }

    /// What stands behind the picture's own ink: the paper of the panels, which is dark, or the terminal's
    /// where they have none.
    pub fn ground(&self, terminal: Ground) -> Ground {
        if self.text.bg.is_some() { Ground::Dark } else { terminal }
    }

    /// Puts the panels' ink and paper in the place of the terminal's own, which ASCII and Braille are drawn
    /// in: on a light terminal the picture would be a negative amid dark panels.
    pub fn fill(&self, area: Rect, buffer: &mut Buffer) {
        for place in area.intersection(buffer.area).positions() {
            let cell = &mut buffer[place];
            for (color, own) in [(&mut cell.fg, self.text.fg), (&mut cell.bg, self.text.bg)] {
                if *color == Color::Reset {
                    *color = own.unwrap_or(Color::Reset);
                }
            }
        }
    }
}

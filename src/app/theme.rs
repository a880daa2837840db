//! The styles of the screen: attributes of a PC's text screen, or the terminal's own ink and paper.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

use crate::glyph::{Ground, Palette};

/// How each part of the screen is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    /// Borders and plain text of the panels.
    pub text: Style,
    /// Titles of the panels, and numbers to notice.
    pub bright: Style,
    /// What did nothing.
    pub dim: Style,
    /// The row in hand.
    pub chosen: Style,
    /// The picture, where it has no colours of its own, and words over it.
    pub picture: Style,
    /// A mark in the picture.
    pub mark: Style,
    /// Numbers of the function keys.
    pub key_number: Style,
    /// Labels of the function keys.
    pub key_label: Style,
    /// Menus.
    pub menu: SheetTheme,
    /// Dialogs.
    pub dialog: SheetTheme,
    /// A line that is typed into, and a list.
    pub entry: Style,
    /// The row of a list that is chosen, while the keys go elsewhere.
    pub entry_chosen: Style,
    /// A button.
    pub button: SheetTheme,
    /// What lies in the shadow of a dialog.
    pub shadow: Style,
}

/// How something with hot letters is drawn.
#[derive(Clone, Copy, Debug)]
pub struct SheetTheme {
    /// Text.
    pub text: Style,
    /// Hot letters.
    pub hot: Style,
    /// What the keys go to.
    pub chosen: Style,
    /// Its hot letter.
    pub chosen_hot: Style,
}

impl SheetTheme {
    /// Black on a paper, hot letters in red; on green where the keys go to it.
    const fn on(paper: Color) -> Self {
        let text = on(Color::Black, paper);
        let chosen = on(Color::White, Color::Green);
        Self { text, hot: text.fg(Color::Red), chosen, chosen_hot: chosen.fg(Color::LightYellow) }
    }
}

const fn on(ink: Color, paper: Color) -> Style {
    Style::new().fg(ink).bg(paper)
}

impl Theme {
    /// The styles that go with a picture's palette.
    pub const fn of(palette: Palette) -> Self {
        match palette {
            Palette::Dos(_) | Palette::Gray(_) | Palette::Color(_) => Self::dos(),
            Palette::Mono(_) => Self::mono(),
        }
    }

    /// The attributes that Norton and Borland made us see: a window is blue, what opens over it is gray.
    const fn dos() -> Self {
        let text = on(Color::Gray, Color::Blue);
        let black = on(Color::Gray, Color::Black);
        Self {
            text,
            bright: text.fg(Color::LightYellow),
            dim: text.fg(Color::Cyan),
            chosen: on(Color::Black, Color::Cyan),
            picture: black,
            mark: black.fg(Color::LightYellow),
            key_number: black,
            key_label: on(Color::Black, Color::Cyan),
            menu: SheetTheme::on(Color::Gray),
            dialog: SheetTheme::on(Color::Gray),
            entry: on(Color::White, Color::Blue),
            entry_chosen: on(Color::Black, Color::Cyan),
            button: SheetTheme { hot: on(Color::LightYellow, Color::Cyan), ..SheetTheme::on(Color::Cyan) },
            shadow: on(Color::DarkGray, Color::Black),
        }
    }

    const fn mono() -> Self {
        let text = Style::new();
        let reversed = text.add_modifier(Modifier::REVERSED);
        let bold = text.add_modifier(Modifier::BOLD);
        let bold_reversed = reversed.add_modifier(Modifier::BOLD);
        let sheet = SheetTheme { text, hot: bold, chosen: reversed, chosen_hot: bold_reversed };
        Self {
            text,
            bright: bold,
            dim: text.add_modifier(Modifier::DIM),
            chosen: reversed,
            picture: text,
            mark: bold,
            key_number: bold,
            key_label: reversed,
            menu: sheet,
            dialog: sheet,
            entry: text,
            entry_chosen: bold,
            button: sheet,
            shadow: text.add_modifier(Modifier::DIM),
        }
    }

    /// What stands behind the picture's own ink: black, or the terminal's paper where there is no colour.
    pub fn ground(&self, terminal: Ground) -> Ground {
        if self.picture.bg.is_some() { Ground::Dark } else { terminal }
    }

    /// Puts gray and black in the place of the terminal's own ink and paper, which ASCII and Braille are
    /// drawn in: on a light terminal the picture would be a negative of what is meant.
    pub fn fill(&self, area: Rect, buffer: &mut Buffer) {
        fill_with(self.picture, area, buffer);
    }

    /// Puts the colours of a panel in the place of those that a widget brings along: where the panel has
    /// none, none are left.
    pub fn take_over(&self, area: Rect, buffer: &mut Buffer) {
        if self.text.fg.is_some() {
            return fill_with(self.text, area, buffer);
        }
        for place in area.intersection(buffer.area).positions() {
            buffer[place].set_fg(Color::Reset).set_bg(Color::Reset);
        }
    }
}

/// Puts the colours of a style in the place of the terminal's own.
fn fill_with(style: Style, area: Rect, buffer: &mut Buffer) {
    for place in area.intersection(buffer.area).positions() {
        let cell = &mut buffer[place];
        for (color, own) in [(&mut cell.fg, style.fg), (&mut cell.bg, style.bg)] {
            if *color == Color::Reset {
                *color = own.unwrap_or(Color::Reset);
            }
        }
    }
}

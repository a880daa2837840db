//! The pull-down menus.

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::{Position, Rect};
use ratatui::text::Line;
use ratatui::widgets::{Block, Clear, Widget};

use super::form_view::draw_shadow;
use super::hot;
use crate::app::actions::{Action, Entry, Menu};
use crate::app::theme::{SheetTheme, Theme};

/// Columns before the first menu's name, and on either side of each.
const PAD: u16 = 2;

/// The menu that is pulled down, and the row that the keys go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MenuBar {
    /// The menu, by its place in [`Menu::ALL`].
    menu: usize,
    row: usize,
}

/// What a key did to the menus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MenuEvent {
    /// They stay.
    Stays,
    /// They were left.
    Left,
    /// This was chosen.
    Chosen(Action),
}

impl MenuBar {
    /// The first menu.
    pub const fn first() -> Self {
        Self { menu: 0, row: 0 }
    }

    /// The menu of a hot letter.
    pub fn of_letter(letter: char) -> Option<Self> {
        let letter = letter.to_ascii_lowercase();
        let menu = Menu::ALL.iter().position(|menu| hot::letter(menu.name()) == Some(letter))?;
        Some(Self { menu, row: 0 })
    }

    /// The menu of which the name stands at a place of a screen.
    pub fn at(at: Position, screen: Rect) -> Option<Self> {
        let menu = name_places(screen).into_iter().position(|place| place.contains(at))?;
        Some(Self { menu, row: 0 })
    }

    fn entries(self) -> Vec<&'static Entry> {
        Menu::ALL[self.menu].entries().collect()
    }

    /// What the row does that the keys go to.
    pub fn hint(self) -> &'static str {
        self.entries().get(self.row).map_or("", |entry| entry.sentence)
    }

    /// Does what a key asks for.
    pub fn take(&mut self, key: KeyEvent) -> MenuEvent {
        let entries = self.entries();
        let (menus, rows) = (Menu::ALL.len(), entries.len());
        match key.code {
            KeyCode::Esc | KeyCode::F(9 | 10) => return MenuEvent::Left,
            KeyCode::Left => *self = Self { menu: (self.menu + menus - 1) % menus, row: 0 },
            KeyCode::Right | KeyCode::Tab => *self = Self { menu: (self.menu + 1) % menus, row: 0 },
            KeyCode::Up => self.row = (self.row + rows - 1) % rows,
            KeyCode::Down => self.row = (self.row + 1) % rows,
            KeyCode::Home | KeyCode::PageUp => self.row = 0,
            KeyCode::End | KeyCode::PageDown => self.row = rows - 1,
            KeyCode::Enter => return MenuEvent::Chosen(entries[self.row].action),
            KeyCode::Char(c) if key.modifiers.contains(KeyModifiers::ALT) => {
                if let Some(other) = Self::of_letter(c) {
                    *self = other;
                }
            }
            KeyCode::Char(c) => {
                let letter = Some(c.to_ascii_lowercase());
                if let Some(entry) = entries.iter().find(|entry| hot::letter(entry.name) == letter) {
                    return MenuEvent::Chosen(entry.action);
                }
            }
            _ => {}
        }
        MenuEvent::Stays
    }

    /// Does what a click asks for.
    pub fn click(&mut self, at: Position, screen: Rect) -> MenuEvent {
        if let Some(other) = Self::at(at, screen) {
            *self = other;
            return MenuEvent::Stays;
        }
        let (place, first) = self.place(screen);
        let row = usize::from(at.y.saturating_sub(place.y + 1)) + first;
        let is_on_row = at.y > place.y && at.y + 1 < place.bottom();
        match self.entries().get(row) {
            Some(entry) if place.contains(at) && is_on_row => MenuEvent::Chosen(entry.action),
            _ if place.contains(at) => MenuEvent::Stays,
            _ => MenuEvent::Left,
        }
    }

    /// Where the menu is pulled down to, and the first row that is in sight there.
    fn place(self, screen: Rect) -> (Rect, usize) {
        let entries = self.entries();
        let name = |entry: &&Entry| hot::width(entry.name);
        let names = entries.iter().map(name).max().unwrap_or(0);
        let keys = entries.iter().map(|entry| first_key(entry).chars().count() as u16).max().unwrap_or(0);
        let width = (names + keys + 6).min(screen.width);
        let bar = name_places(screen)[self.menu];
        let x = bar.x.saturating_sub(1).min(screen.right() - width);
        let height = (entries.len() as u16 + 2).min(screen.height.saturating_sub(1));
        let room = usize::from(height.saturating_sub(2));
        let first = (self.row + 1).saturating_sub(room);
        (Rect { x, y: screen.y + 1.min(screen.height), width, height }, first)
    }

    /// Draws the bar over the first row of the screen, and the menu below it; gives their places.
    pub fn draw(self, theme: &Theme, screen: Rect, buffer: &mut Buffer) -> [Rect; 2] {
        let bar = Rect { height: 1.min(screen.height), ..screen };
        let SheetTheme { text, hot: letter, chosen, chosen_hot } = theme.menu;
        Clear.render(bar, buffer);
        buffer.set_style(bar, text);
        for (number, (menu, place)) in Menu::ALL.iter().zip(name_places(screen)).enumerate() {
            let [text, letter] = if number == self.menu { [chosen, chosen_hot] } else { [text, letter] };
            buffer.set_style(place, text);
            // A name that is cut begins with its hot letter.
            let pad = place.width.saturating_sub(hot::width(menu.name())) / 2;
            let name = Rect { x: place.x + pad, width: place.width - pad, ..place };
            hot::line(menu.name(), text, letter).render(name, buffer);
        }
        let (place, first) = self.place(screen);
        let all = draw_shadow(theme, place, buffer);
        Clear.render(place, buffer);
        let block = Block::bordered().style(text);
        let inside = block.inner(place);
        block.render(place, buffer);
        let entries = self.entries();
        for (number, y) in (first..entries.len()).zip(inside.top()..inside.bottom()) {
            let entry = entries[number];
            let row = Rect { y, height: 1, ..inside };
            let [text, letter] = if number == self.row { [chosen, chosen_hot] } else { [text, letter] };
            buffer.set_style(row, text);
            let name = Rect { x: row.x + 1, width: row.width.saturating_sub(1), ..row };
            hot::line(entry.name, text, letter).render(name.intersection(row), buffer);
            let key = Line::styled(first_key(entry) + " ", text).right_aligned();
            let columns = key.width() as u16;
            if columns < row.width {
                key.render(Rect { x: row.right() - columns, width: columns, ..row }, buffer);
            }
        }
        [bar, all]
    }
}

fn first_key(entry: &Entry) -> String {
    entry.keys.first().map(ToString::to_string).unwrap_or_default()
}

/// Where the names of the menus stand, as far as the screen is wide; closer where it is narrow.
fn name_places(screen: Rect) -> Vec<Rect> {
    let names: u16 = Menu::ALL.iter().map(|menu| hot::width(menu.name())).sum();
    let count = Menu::ALL.len() as u16;
    let pad = if names + 2 * PAD * count <= screen.width { PAD } else { 0 };
    let gap = u16::from(pad == 0);
    let mut x = screen.x;
    let place = |menu: &Menu| {
        let width = hot::width(menu.name()) + 2 * pad;
        let place = Rect { x, y: screen.y, width, height: 1 }.intersection(screen);
        x = (x + width + gap).min(screen.right());
        place
    };
    Menu::ALL.iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hot_letters_are_each_ones_own() {
        let unique = |letters: Vec<Option<char>>| {
            letters.iter().enumerate().all(|(n, letter)| letter.is_some() && !letters[..n].contains(letter))
        };
        assert!(unique(Menu::ALL.iter().map(|menu| hot::letter(menu.name())).collect()));
        for menu in Menu::ALL {
            assert!(unique(menu.entries().map(|entry| hot::letter(entry.name)).collect()), "{menu:?}");
        }
    }

    #[test]
    fn every_action_is_reached_by_arrows_and_by_letters() {
        for (number, menu) in Menu::ALL.into_iter().enumerate() {
            for (row, entry) in menu.entries().enumerate() {
                let mut by_arrows = MenuBar::first();
                let keys = [vec![KeyCode::Right; number], vec![KeyCode::Down; row]].concat();
                assert!(keys.into_iter().all(|code| by_arrows.take(code.into()) == MenuEvent::Stays));
                assert_eq!(by_arrows.take(KeyCode::Enter.into()), MenuEvent::Chosen(entry.action));
                let mut by_letter = MenuBar::of_letter(hot::letter(menu.name()).unwrap()).unwrap();
                let key = KeyCode::Char(hot::letter(entry.name).unwrap());
                assert_eq!(by_letter.take(key.into()), MenuEvent::Chosen(entry.action), "{}", entry.name);
            }
        }
    }

    #[test]
    fn no_screen_is_too_small() {
        let theme = Theme::of(crate::glyph::Palette::DOS);
        for (width, height) in [(1, 1), (2, 2), (10, 3), (20, 5), (40, 10), (200, 60)] {
            let screen = Rect::new(0, 0, width, height);
            for menu in 0..Menu::ALL.len() {
                let mut bar = MenuBar { menu, row: 0 };
                for _ in 0..15 {
                    for place in bar.draw(&theme, screen, &mut Buffer::empty(screen)) {
                        assert_eq!(place.intersection(screen), place);
                    }
                    bar.take(KeyCode::Down.into());
                }
            }
        }
    }
}

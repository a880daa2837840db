//! A line of text that is typed into.

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

/// More than any path or number has; what is pasted beyond it is left out.
const LONGEST: usize = 4096;

/// A line of text, and where the next letter goes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InputLine {
    letters: Vec<char>,
    /// The place of the cursor: before the letter of this number.
    at: usize,
    /// Whether nothing has been typed yet: the first letter takes the place of all.
    fresh: bool,
}

impl InputLine {
    /// A line with a text that the first letter typed replaces.
    pub fn new(text: &str) -> Self {
        // What can not be typed is not drawn either.
        let letters: Vec<char> = text.chars().filter(|c| !c.is_control()).take(LONGEST).collect();
        Self { at: letters.len(), letters, fresh: true }
    }

    /// The first letter typed replaces the text again.
    pub const fn refresh(&mut self) {
        (self.at, self.fresh) = (self.letters.len(), true);
    }

    /// The text.
    pub fn text(&self) -> String {
        self.letters.iter().collect()
    }

    /// Does what a key asks for; gives whether it was one of this line's.
    pub fn take(&mut self, key: KeyEvent) -> bool {
        let fresh = std::mem::take(&mut self.fresh);
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        match key.code {
            KeyCode::Char('a') if control => self.at = 0,
            KeyCode::Char('e') if control => self.at = self.letters.len(),
            KeyCode::Char('u') if control => {
                self.letters.drain(..std::mem::take(&mut self.at));
            }
            KeyCode::Char('k') if control => self.letters.truncate(self.at),
            KeyCode::Char(c) if !control && !key.modifiers.contains(KeyModifiers::ALT) => {
                if fresh {
                    self.letters.clear();
                    self.at = 0;
                }
                if self.letters.len() < LONGEST {
                    self.letters.insert(self.at, c);
                    self.at += 1;
                }
            }
            KeyCode::Backspace if self.at > 0 => {
                self.at -= 1;
                self.letters.remove(self.at);
            }
            KeyCode::Delete if self.at < self.letters.len() => {
                self.letters.remove(self.at);
            }
            KeyCode::Backspace | KeyCode::Delete => {}
            KeyCode::Left => self.at = self.at.saturating_sub(1),
            KeyCode::Right => self.at = (self.at + 1).min(self.letters.len()),
            KeyCode::Home => self.at = 0,
            KeyCode::End => self.at = self.letters.len(),
            _ => {
                self.fresh = fresh;
                return false;
            }
        }
        true
    }

    /// Draws the part around the cursor; the cursor itself where keys go here.
    pub fn draw(&self, has_keys: bool, style: Style, area: Rect, buffer: &mut Buffer) {
        buffer.set_style(area, style);
        let room = usize::from(area.width);
        if room == 0 || area.height == 0 {
            return;
        }
        let first = if has_keys { (self.at + 1).saturating_sub(room) } else { 0 };
        let shown: String = self.letters.iter().skip(first).collect();
        buffer.set_stringn(area.x, area.y, shown, room, style);
        if has_keys {
            let all_replaced = self.fresh && !self.letters.is_empty();
            let cursor = area.x + (self.at - first) as u16;
            let (from, to) =
                if all_replaced { (area.x, cursor) } else { (cursor, (cursor + 1).min(area.right())) };
            for x in from..to {
                buffer[(x, area.y)].set_style(style.add_modifier(Modifier::REVERSED));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(line: &mut InputLine, codes: &[KeyCode]) {
        for &code in codes {
            line.take(code.into());
        }
    }

    #[test]
    fn letters_go_where_the_cursor_is() {
        let mut line = InputLine::new("");
        typed(&mut line, &['a', 'c'].map(KeyCode::Char));
        typed(&mut line, &[KeyCode::Left, KeyCode::Char('b'), KeyCode::End, KeyCode::Char('d')]);
        assert_eq!(line.text(), "abcd");
        typed(&mut line, &[KeyCode::Home, KeyCode::Delete, KeyCode::Backspace, KeyCode::Right]);
        typed(&mut line, &[KeyCode::Backspace]);
        assert_eq!(line.text(), "cd");
        assert!(!line.take(KeyCode::Enter.into()) && !line.take(KeyCode::Up.into()));
    }

    #[test]
    fn the_first_letter_replaces_what_was_offered_unless_it_is_edited() {
        let mut offered = InputLine::new("0, -9, 3");
        typed(&mut offered, &[KeyCode::Char('7')]);
        assert_eq!(offered.text(), "7");
        let mut offered = InputLine::new("0, -9, 3");
        typed(&mut offered, &[KeyCode::Backspace, KeyCode::Char('4')]);
        assert_eq!(offered.text(), "0, -9, 4");
    }

    #[test]
    fn the_cursor_stays_in_sight() {
        let line = InputLine::new("a long path to a scene");
        for width in 0..30 {
            let area = Rect::new(0, 0, width, 1);
            let mut buffer = Buffer::empty(area);
            line.draw(true, Style::new(), area, &mut buffer);
            let reversed =
                buffer.content.iter().filter(|cell| cell.modifier.contains(Modifier::REVERSED)).count();
            assert_eq!(reversed, usize::from(width).saturating_sub(1).min(22), "{width}");
        }
    }
}

//! What is wrong with the scene now, over the last picture that was right.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Paragraph, Widget};

use super::theme::Theme;

/// Draws it at the bottom of the area, as many of its lines as half of that has; gives its place.
pub fn draw(text: &str, theme: &Theme, area: Rect, buffer: &mut Buffer) -> Rect {
    let width = usize::from(area.width.saturating_sub(2)).max(1);
    let lines: Vec<String> = text.lines().flat_map(|line| cut(line, width)).collect();
    let room = (area.height / 2).max(3);
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX).min(room).min(area.height);
    let place = Rect { y: area.bottom() - height, height, ..area };
    Clear.render(place, buffer);
    let block = Block::bordered().title(Span::styled(" MISTAKE ", theme.bright)).style(theme.text);
    let lines: Vec<Line<'_>> = lines.into_iter().map(Line::from).collect();
    Paragraph::new(lines).block(block).render(place, buffer);
    place
}

/// A line in pieces of so many columns; a line of pictures of text is not wrapped at words.
fn cut(line: &str, width: usize) -> Vec<String> {
    let characters: Vec<char> = line.chars().collect();
    if characters.is_empty() {
        return vec![String::new()];
    }
    characters.chunks(width).map(|piece| piece.iter().collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Palette;

    #[test]
    fn no_area_is_too_small() {
        let text = "error: a thing\n\n  --> part.scene:1:1\n".repeat(20);
        for (width, height) in [(0, 0), (1, 1), (2, 2), (5, 3), (40, 20)] {
            let area = Rect::new(0, 0, width, height);
            let place = draw(&text, &Theme::of(Palette::DOS), area, &mut Buffer::empty(area));
            assert_eq!(place.intersection(area), place);
        }
    }
}

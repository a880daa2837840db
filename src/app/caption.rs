//! Words over the middle of the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;
use ratatui::widgets::Widget;

/// Draws a text in the middle of an area, in as many lines as its width asks for, each with a blank on either
/// side; gives their place. What does not fit is cut off at the bottom.
pub fn draw(text: &str, style: Style, area: Rect, buffer: &mut Buffer) -> Rect {
    let lines = wrapped(text, area.width.saturating_sub(2).into());
    let height = area.height.min(lines.len() as u16);
    let place = Rect { y: area.y + (area.height - height) / 2, height, ..area };
    for (line, y) in lines.into_iter().zip(place.top()..place.bottom()) {
        let line = Line::from(format!(" {line} ")).style(style);
        let width = (line.width() as u16).min(area.width);
        let row = Rect { x: area.x + (area.width - width) / 2, y, width, height: 1 };
        line.render(row, buffer);
    }
    place
}

/// The words in lines of up to so many columns, and of one word at least.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= columns => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_wrapped_to_the_width() {
        assert_eq!(wrapped("nothing in view: Home goes back", 16), ["nothing in view:", "Home goes back"]);
        assert_eq!(wrapped("nothing in view", 3), ["nothing", "in", "view"]);
        assert!(wrapped("", 9).is_empty());
    }

    #[test]
    fn no_area_is_too_small() {
        for (width, height) in [(0, 0), (1, 1), (5, 2), (40, 1)] {
            let area = Rect::new(0, 0, width, height);
            let place = draw("nothing in view: Home goes back", Style::new(), area, &mut Buffer::empty(area));
            assert_eq!(place.intersection(area), place);
        }
    }
}

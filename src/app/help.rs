//! The keys over the picture, made from the keymap.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Clear, Paragraph, Widget};

use super::keys::KEYMAP;
use super::theme::Theme;

/// Columns between the keys and what they do, and on either side.
const GAP: usize = 2;

/// Draws the help in the middle of the area, and gives its place. What does not fit is cut off at the right
/// and at the bottom.
pub fn draw(theme: &Theme, area: Rect, buffer: &mut Buffer) -> Rect {
    let rows: Vec<(String, &str)> = KEYMAP
        .iter()
        .map(|line| {
            let keys: Vec<_> = line.keys.iter().map(|(chord, _)| chord.to_string()).collect();
            (keys.join(" "), line.does)
        })
        .collect();
    let columns = |text: &str| text.chars().count();
    let keys_columns = rows.iter().map(|(keys, _)| columns(keys)).max().unwrap_or(0);
    let does_columns = rows.iter().map(|(_, does)| columns(does)).max().unwrap_or(0);
    let lines: Vec<_> = rows
        .into_iter()
        .map(|(keys, does)| {
            let padding = GAP + keys_columns - columns(&keys);
            Line::from(vec![
                Span::raw(" ".repeat(GAP)),
                Span::styled(keys, theme.bright),
                Span::raw(" ".repeat(padding)),
                Span::raw(does),
            ])
        })
        .collect();
    let width = u16::try_from(keys_columns + does_columns + 3 * GAP + 2).unwrap_or(u16::MAX).min(area.width);
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX).min(area.height);
    let place =
        Rect { x: area.x + (area.width - width) / 2, y: area.y + (area.height - height) / 2, width, height };
    Clear.render(place, buffer);
    let block = Block::bordered()
        .border_type(BorderType::Double)
        .title(Span::styled(" KEYS ", theme.bright))
        .title_bottom(Line::from(" any key goes back ").right_aligned())
        .style(theme.text);
    Paragraph::new(lines).block(block).render(place, buffer);
    place
}

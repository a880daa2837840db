//! The keys over the picture, made from the table of actions.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Clear, Paragraph, Widget};

use super::actions::{self, ACTIONS, Entry, Group};
use super::theme::Theme;

/// Columns between the keys and what they do, and on either side.
const GAP: usize = 2;

/// Draws the help in the middle of the area, and gives its place. What does not fit is cut off at the right
/// and at the bottom.
pub fn draw(theme: &Theme, area: Rect, buffer: &mut Buffer) -> Rect {
    let rows: Vec<(String, &str)> = ACTIONS.iter().map(|group| (keys(group), group.does)).collect();
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

/// All keys of a group, the first of each action before the others.
fn keys(group: &Group) -> String {
    names(group).join(" ")
}

/// Each action's keys and what it does, in a sentence, in the order of the help.
pub fn key_list() -> Vec<(String, &'static str)> {
    let told = |entry: &'static Entry| {
        let keys: Vec<String> = entry.keys.iter().map(ToString::to_string).collect();
        (keys.join(", "), entry.sentence)
    };
    actions::entries().map(told).collect()
}

fn names(group: &Group) -> Vec<String> {
    let most = group.entries.iter().map(|entry| entry.keys.len()).max().unwrap_or(0);
    let nth = |n: usize| group.entries.iter().filter_map(move |entry| entry.keys.get(n));
    (0..most).flat_map(nth).map(ToString::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The README's list of keys is what this table makes.
    #[test]
    fn the_readme_has_the_same_keys() {
        let readme = include_str!("../../README.md");
        let table = readme.split("## Keys").nth(1).unwrap().split("\n\n").nth(1).unwrap();
        let made = ACTIONS.iter().map(|group| {
            let keys: Vec<String> = names(group).iter().map(|name| format!("`{name}`")).collect();
            format!("| {} | {} |\n", keys.join(" "), group.does)
        });
        let made = format!("| keys | what they do |\n|---|---|\n{}", made.collect::<String>());
        assert_eq!(table.trim_end(), made.trim_end(), "the README's table should be\n{made}");
    }
}

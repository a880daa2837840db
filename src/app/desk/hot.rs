//! Text with a hot letter, marked by `&` before it.

use ratatui::style::Style;
use ratatui::text::{Line, Span};

/// The text without the mark.
pub fn plain(marked: &str) -> String {
    marked.replacen('&', "", 1)
}

/// The hot letter, in lower case; absent where none is marked.
pub fn letter(marked: &str) -> Option<char> {
    let behind = marked.split_once('&')?.1;
    behind.chars().next().map(|c| c.to_ascii_lowercase())
}

/// The text with its hot letter in a style of its own.
pub fn line(marked: &str, text: Style, hot: Style) -> Line<'_> {
    let Some((before, behind)) = marked.split_once('&') else { return Line::styled(marked, text) };
    let end = behind.chars().next().map_or(0, char::len_utf8);
    let (letter, rest) = behind.split_at(end);
    Line::from(vec![Span::styled(before, text), Span::styled(letter, hot), Span::styled(rest, text)])
}

/// Columns of the text without the mark.
pub fn width(marked: &str) -> u16 {
    Line::from(plain(marked)).width() as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_letter_behind_the_mark_is_hot() {
        assert_eq!((plain("E&xit"), letter("E&xit"), width("E&xit")), ("Exit".to_owned(), Some('x'), 4));
        assert_eq!((plain("Exit"), letter("Exit")), ("Exit".to_owned(), None));
        let [text, hot] = [Style::new(), Style::new().reversed()];
        let spans = line("E&xit", text, hot).spans;
        let told: Vec<_> = spans.iter().map(|span| (&*span.content, span.style == hot)).collect();
        assert_eq!(told, [("E", false), ("x", true), ("it", false)]);
    }
}

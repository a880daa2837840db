//! The screen in the characters that the terminal has.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::glyph::GlyphMode;
use crate::output::Capabilities;

/// Puts the nearest character that the terminal has in the place of each that it lacks: in ASCII only, where
/// its locale is not UTF-8, and in the DOS set, where it has little more. What is asked for by name, the
/// picture, stays out of `area`.
pub fn fit(buffer: &mut Buffer, area: Rect, terminal: Capabilities) {
    let replace: fn(char) -> char = match terminal.glyphs {
        _ if !terminal.utf8 => ascii,
        GlyphMode::Cp437 => dos,
        _ => return,
    };
    for place in area.intersection(buffer.area).positions() {
        let cell = &mut buffer[place];
        // What stands above a letter has no place in either set.
        if let Some(first) = cell.symbol().chars().next() {
            cell.set_char(replace(first));
        }
    }
}

/// The nearest character of ASCII.
const fn ascii(symbol: char) -> char {
    match symbol {
        ' '..='~' => symbol,
        '═' => '=',
        '─' | '–' | '−' => '-',
        '║' | '│' => '|',
        '╔' | '╗' | '╚' | '╝' | '┌' | '┐' | '└' | '┘' | '├' | '┤' | '╟' | '╢' => '+',
        '┼' => 'X',
        '×' => 'x',
        '°' | '\u{2800}' => ' ',
        '█' | '▓' | '▌' => '#',
        '♦' | '•' => '*',
        '░' | '▒' | '·' | '\u{2801}'..='\u{28ff}' => '.',
        '←' => '<',
        '→' | '►' => '>',
        '↑' => '^',
        '↓' => 'v',
        'Σ' => 'S',
        'θ' => 'o',
        'ⁿ' => 'n',
        _ => '?',
    }
}

/// The same of code page 437, as far as the panels need it; names from outside are left to the font.
const fn dos(symbol: char) -> char {
    match symbol {
        '×' => 'x',
        '–' | '−' => '-',
        'θ' => 'Θ',
        '\u{2800}' => ' ',
        '\u{2801}'..='\u{28ff}' => '·',
        _ => symbol,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Style;

    fn fitted(text: &str, terminal: Capabilities) -> String {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 20, 1));
        buffer.set_string(0, 0, text, Style::new());
        fit(&mut buffer, Rect::new(0, 0, 40, 40), terminal);
        buffer.content.iter().map(ratatui::buffer::Cell::symbol).collect::<String>().trim_end().to_owned()
    }

    #[test]
    fn without_utf_8_all_is_ascii() {
        let terminal = Capabilities { utf8: false, glyphs: GlyphMode::Ascii, ..Capabilities::default() };
        assert_eq!(fitted("╔═║─│┐×█▌░", terminal), "+=|-|+x##.");
        assert_eq!(fitted("e\u{301}\u{e9}한글.scene", terminal), "e?? ? .scene");
    }

    #[test]
    fn a_dos_font_has_frames_and_no_times() {
        let terminal = Capabilities { glyphs: GlyphMode::Cp437, ..Capabilities::default() };
        assert_eq!(fitted("╔═║ 40×25°", terminal), "╔═║ 40x25°");
        assert_eq!(fitted("╔═║ 40×25°", Capabilities::default()), "╔═║ 40×25°");
    }
}

//! Keys by what terminals send for them: characters, control characters, and the sequences of xterm, rxvt,
//! PuTTY, the Linux console and kitty.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// The key of a character or control character, as crossterm names it in raw mode.
pub fn character(c: char) -> KeyEvent {
    let control = |c| KeyEvent::new(KeyCode::Char(c), KeyModifiers::CONTROL);
    let byte = c as u32 as u8;
    match c {
        '\r' => KeyCode::Enter.into(),
        '\t' => KeyCode::Tab.into(),
        '\x1b' => KeyCode::Esc.into(),
        '\x7f' => KeyCode::Backspace.into(),
        '\0' => control(' '),
        '\x01'..='\x1a' => control((byte - 1 + b'a') as char),
        '\x1c'..='\x1f' => control((byte - 0x1c + b'4') as char),
        c if c.is_uppercase() => KeyEvent::new(KeyCode::Char(c), KeyModifiers::SHIFT),
        c => KeyCode::Char(c).into(),
    }
}

/// The key of `ESC O` and a letter: keys in application mode, function keys, the keypad.
pub fn single_shift(last: u8) -> Option<KeyEvent> {
    Some(match last {
        // rxvt, with Ctrl.
        b'a'..=b'd' => KeyEvent::new(letter(last.to_ascii_uppercase())?, KeyModifiers::CONTROL),
        b'M' => KeyCode::Enter.into(),
        // The keypad has its characters in the order of ASCII, from the asterisk to the nine.
        b'j'..=b'y' => KeyCode::Char((last - b'j' + b'*') as char).into(),
        last => letter(last)?.into(),
    })
}

/// The key of `ESC [ [` and a letter: the Linux console's first five function keys.
pub fn linux_console(last: u8) -> Option<KeyEvent> {
    matches!(last, b'A'..=b'E').then(|| KeyCode::F(last - b'A' + 1).into())
}

/// The key in a control sequence, given without its `ESC [`: parameters and the final byte. A key that is let
/// go is none.
pub fn in_sequence(parameters: &str, last: u8) -> Option<KeyEvent> {
    // xterm: what is held down is the second parameter, less one, as bits; kitty: what happens stands behind
    // a colon.
    let mut fields = parameters.split(';');
    let first = number(fields.next())?;
    let mut held = fields.next().unwrap_or_default().split(':');
    let modifiers = modifiers(number(held.next())?.unwrap_or(1));
    if number(held.next())? == Some(3) {
        return None;
    }
    let third = number(fields.next())?;
    let with = |code| KeyEvent::new(code, modifiers);
    let shifted = |code| KeyEvent::new(code, modifiers | KeyModifiers::SHIFT);
    Some(match last {
        b'Z' => shifted(KeyCode::BackTab),
        // rxvt, with Shift.
        b'a'..=b'd' if parameters.is_empty() => shifted(letter(last.to_ascii_uppercase())?),
        b'~' if first == Some(27) => with_modifiers(character(char::from_u32(third?)?), modifiers),
        b'~' => with(numbered(first?)?),
        // rxvt: with Ctrl, Shift, and both.
        b'^' => KeyEvent::new(numbered(first?)?, KeyModifiers::CONTROL),
        b'$' => KeyEvent::new(numbered(first?)?, KeyModifiers::SHIFT),
        b'@' => KeyEvent::new(numbered(first?)?, KeyModifiers::CONTROL | KeyModifiers::SHIFT),
        b'u' => with_modifiers(character(char::from_u32(first?)?), modifiers),
        // A place on the screen, which looks like F3 with something held down.
        b'R' if !parameters.is_empty() => return None,
        last => with(letter(last)?),
    })
}

/// Absent where the text is no number; 0 digits are no number given.
#[expect(clippy::option_option, reason = "a number may be left out, and a text may be no number")]
fn number(text: Option<&str>) -> Option<Option<u32>> {
    match text {
        None | Some("") => Some(None),
        Some(text) => text.parse().ok().map(Some),
    }
}

fn modifiers(parameter: u32) -> KeyModifiers {
    let bits = parameter.saturating_sub(1);
    [(1, KeyModifiers::SHIFT), (2, KeyModifiers::ALT), (4, KeyModifiers::CONTROL), (8, KeyModifiers::SUPER)]
        .into_iter()
        .filter(|(bit, _)| bits & bit != 0)
        .map(|(_, modifier)| modifier)
        .collect()
}

fn with_modifiers(key: KeyEvent, modifiers: KeyModifiers) -> KeyEvent {
    KeyEvent::new(key.code, key.modifiers | modifiers)
}

/// The key of a final letter.
fn letter(last: u8) -> Option<KeyCode> {
    Some(match last {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        b'F' => KeyCode::End,
        b'H' => KeyCode::Home,
        b'P'..=b'S' => KeyCode::F(last - b'P' + 1),
        _ => return None,
    })
}

/// The key of a number before a tilde. The gaps are those of the VT220's keyboard.
fn numbered(number: u32) -> Option<KeyCode> {
    let function = |first: u32, key: u8| KeyCode::F(key + (number - first) as u8);
    Some(match number {
        1 | 7 => KeyCode::Home,
        2 => KeyCode::Insert,
        3 => KeyCode::Delete,
        4 | 8 => KeyCode::End,
        5 => KeyCode::PageUp,
        6 => KeyCode::PageDown,
        11..=15 => function(11, 1),
        17..=21 => function(17, 6),
        23..=26 => function(23, 11),
        28..=29 => function(28, 15),
        31..=34 => function(31, 17),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sequence(text: &str) -> Option<(KeyCode, KeyModifiers)> {
        let last = text.as_bytes()[text.len() - 1];
        in_sequence(&text[..text.len() - 1], last).map(|key| (key.code, key.modifiers))
    }

    #[test]
    fn each_terminal_has_its_function_keys() {
        const NONE: KeyModifiers = KeyModifiers::NONE;
        assert_eq!(single_shift(b'P').unwrap().code, KeyCode::F(1), "xterm");
        assert_eq!(sequence("11~"), Some((KeyCode::F(1), NONE)), "PuTTY, rxvt");
        assert_eq!(linux_console(b'A').unwrap().code, KeyCode::F(1));
        let numbers = [15, 17, 18, 19, 20, 21, 23, 24].map(|n| sequence(&format!("{n}~")).unwrap().0);
        assert_eq!(numbers, [5, 6, 7, 8, 9, 10, 11, 12].map(KeyCode::F));
        assert_eq!(sequence("16~"), None);
        assert_eq!(linux_console(b'F'), None);
    }

    #[test]
    fn each_terminal_has_its_home() {
        for text in ["H", "1~", "7~"] {
            assert_eq!(sequence(text), Some((KeyCode::Home, KeyModifiers::NONE)));
        }
        assert_eq!(single_shift(b'H').unwrap().code, KeyCode::Home);
        assert_eq!(sequence("7^"), Some((KeyCode::Home, KeyModifiers::CONTROL)));
        assert_eq!(sequence("7$"), Some((KeyCode::Home, KeyModifiers::SHIFT)));
    }

    #[test]
    fn what_is_held_down_comes_along() {
        let both = KeyModifiers::SHIFT | KeyModifiers::CONTROL;
        assert_eq!(sequence("1;2C"), Some((KeyCode::Right, KeyModifiers::SHIFT)));
        assert_eq!(sequence("1;6C"), Some((KeyCode::Right, both)));
        assert_eq!(sequence("a"), Some((KeyCode::Up, KeyModifiers::SHIFT)));
        assert_eq!(single_shift(b'd').unwrap(), KeyEvent::new(KeyCode::Left, KeyModifiers::CONTROL));
        assert_eq!(sequence("15;5~"), Some((KeyCode::F(5), KeyModifiers::CONTROL)));
        assert_eq!(sequence("Z"), Some((KeyCode::BackTab, KeyModifiers::SHIFT)));
        assert_eq!(sequence("1;1:1C"), Some((KeyCode::Right, KeyModifiers::NONE)));
        assert_eq!(sequence("1;1:3C"), None, "let go");
    }

    #[test]
    fn a_character_may_come_as_a_number() {
        let control_c = Some((KeyCode::Char('c'), KeyModifiers::CONTROL));
        assert_eq!(sequence("99;5u"), control_c);
        assert_eq!(sequence("27;5;99~"), control_c);
        assert_eq!(sequence("27u"), Some((KeyCode::Esc, KeyModifiers::NONE)));
        assert_eq!(sequence("99;5:3u"), None, "let go");
    }

    #[test]
    fn control_characters_are_keys_with_control() {
        let key = |c| (character(c).code, character(c).modifiers);
        assert_eq!(key('\x03'), (KeyCode::Char('c'), KeyModifiers::CONTROL));
        assert_eq!(key('\x1a'), (KeyCode::Char('z'), KeyModifiers::CONTROL));
        assert_eq!(key('\0'), (KeyCode::Char(' '), KeyModifiers::CONTROL));
        assert_eq!(key('\t'), (KeyCode::Tab, KeyModifiers::NONE));
        assert_eq!(key('\x7f'), (KeyCode::Backspace, KeyModifiers::NONE));
        assert_eq!(key('W'), (KeyCode::Char('W'), KeyModifiers::SHIFT));
        assert_eq!(key('é'), (KeyCode::Char('é'), KeyModifiers::NONE));
    }

    #[test]
    fn what_is_no_key_is_none() {
        for text in
            ["0n", "?62;22c", ">0;1;2c", "12;40R", "?2026;2$y", "x", "99999999999~", "1;2", "I", "<0;1;1M"]
        {
            assert_eq!(sequence(text), None, "{text}");
        }
        assert_eq!(single_shift(b'!'), None);
    }
}

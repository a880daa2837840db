//! What is done with the mouse, in xterm's form SGR 1006.

use ratatui::layout::Position;

/// What is done with the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mouse {
    /// The first button was pressed on this cell: column and row from 0.
    Click(Position),
    /// The wheel was turned away.
    WheelUp,
    /// The wheel was turned nearer.
    WheelDown,
}

/// What a control sequence says, given without its `ESC [`: parameters and the final byte. Other buttons, and
/// buttons that are let go, do nothing.
pub fn in_sequence(parameters: &str, last: u8) -> Option<Mouse> {
    let mut numbers = parameters.strip_prefix('<')?.split(';').map(|number| number.parse::<u16>().ok());
    let (button, column, row) = (numbers.next()??, numbers.next()??, numbers.next()??);
    // What is held down is in the bits of 4, 8 and 16.
    match (button & !0b1_1100, last) {
        (0, b'M') => Some(Mouse::Click(Position::new(column.saturating_sub(1), row.saturating_sub(1)))),
        (64, b'M') => Some(Mouse::WheelUp),
        (65, b'M') => Some(Mouse::WheelDown),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_button_and_the_wheel_count() {
        let click = Some(Mouse::Click(Position::new(9, 4)));
        assert_eq!(in_sequence("<0;10;5", b'M'), click);
        assert_eq!(in_sequence("<16;10;5", b'M'), click, "with Ctrl");
        assert_eq!(in_sequence("<64;10;5", b'M'), Some(Mouse::WheelUp));
        assert_eq!(in_sequence("<65;10;5", b'M'), Some(Mouse::WheelDown));
        for (parameters, last) in [("<0;10;5", b'm'), ("<2;10;5", b'M'), ("0;10;5", b'M'), ("<0;10", b'M')] {
            assert_eq!(in_sequence(parameters, last), None);
        }
    }
}

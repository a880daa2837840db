//! From keys to actions.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::actions::{self, Action, KEY_BAR};
use super::chord::Chord;

/// The action of a key; absent where it has none.
pub fn action(event: KeyEvent) -> Option<Action> {
    let chord = Chord::of(event);
    actions::entries().find(|entry| entry.keys.contains(&chord)).map(|entry| entry.action)
}

/// The function keys, by number, with their labels: those that do something.
pub fn function_keys() -> Vec<(u8, &'static str)> {
    let bound = |number| {
        actions::entries().any(|entry| entry.keys.iter().any(|chord| chord.function_number() == Some(number)))
    };
    (1..).zip(KEY_BAR).filter(|&(number, _)| bound(number)).collect()
}

/// The function key that a digit stands for behind Esc or with Alt, where no function key arrives: 0 is F10.
pub fn function_key(event: KeyEvent) -> Option<KeyEvent> {
    let KeyCode::Char(digit @ '0'..='9') = event.code else { return None };
    let number = if digit == '0' { 10 } else { digit as u8 - b'0' };
    Some(KeyEvent::new(KeyCode::F(number), KeyModifiers::NONE))
}

//! The keys: one table feeds the dispatch, the help and the function-key bar.

use std::fmt;

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// The eye goes left around the target.
    OrbitLeft,
    /// The eye goes right around the target.
    OrbitRight,
    /// The eye goes up around the target.
    OrbitUp,
    /// The eye goes down around the target.
    OrbitDown,
    /// Eye and target go along the line of sight.
    FlyForward,
    /// Eye and target go back along the line of sight.
    FlyBack,
    /// Eye and target go left.
    FlyLeft,
    /// Eye and target go right.
    FlyRight,
    /// Eye and target go up.
    Rise,
    /// Eye and target go down.
    Sink,
    /// The field gets narrower.
    ZoomIn,
    /// The field gets wider.
    ZoomOut,
    /// The next view of the scene.
    NextView,
    /// The view before.
    PreviousView,
    /// The view as it was before any move.
    Home,
    /// The shading model with one term less.
    ShadingDown,
    /// The shading model with one term more.
    ShadingUp,
    /// The next set of characters.
    NextGlyphs,
    /// Follows one ray, or leaves it.
    Follow,
    /// The step before, of the ray that is followed.
    StepBack,
    /// The next step of the ray that is followed.
    StepOn,
    /// Shows or hides the keys.
    Help,
    /// Closes what is open over the picture.
    Close,
    /// Sends the whole screen again.
    Redraw,
    /// Gives the terminal back to the shell for a while.
    Suspend,
    /// The end.
    Quit,
}

/// A key with what is held down beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chord {
    code: KeyCode,
    control: bool,
}

/// A line of the help: keys that belong together.
#[derive(Debug)]
pub struct Line {
    /// What they do, as the help says it.
    pub does: &'static str,
    /// The label in the function-key bar, where one of the keys is a function key.
    pub label: Option<&'static str>,
    /// Each key with its action, in the order of the help.
    pub keys: &'static [(Chord, Action)],
}

const fn key(code: KeyCode) -> Chord {
    Chord { code, control: false }
}

const fn char(c: char) -> Chord {
    key(KeyCode::Char(c))
}

const fn control(c: char) -> Chord {
    Chord { code: KeyCode::Char(c), control: true }
}

/// Every key of the viewer. Letters stand for both cases.
pub const KEYMAP: &[Line] = &[
    Line {
        does: "orbit about the target",
        label: None,
        keys: &[
            (key(KeyCode::Left), Action::OrbitLeft),
            (key(KeyCode::Down), Action::OrbitDown),
            (key(KeyCode::Up), Action::OrbitUp),
            (key(KeyCode::Right), Action::OrbitRight),
            (char('h'), Action::OrbitLeft),
            (char('j'), Action::OrbitDown),
            (char('k'), Action::OrbitUp),
            (char('l'), Action::OrbitRight),
        ],
    },
    Line {
        does: "fly forward, left, back, right",
        label: None,
        keys: &[
            (char('w'), Action::FlyForward),
            (char('a'), Action::FlyLeft),
            (char('s'), Action::FlyBack),
            (char('d'), Action::FlyRight),
        ],
    },
    Line { does: "rise, sink", label: None, keys: &[(char('r'), Action::Rise), (char('f'), Action::Sink)] },
    Line {
        does: "zoom in, out",
        label: None,
        keys: &[(char('+'), Action::ZoomIn), (char('='), Action::ZoomIn), (char('-'), Action::ZoomOut)],
    },
    Line {
        does: "next view, the one before",
        label: Some("View"),
        keys: &[
            (key(KeyCode::F(3)), Action::NextView),
            (key(KeyCode::Tab), Action::NextView),
            (key(KeyCode::BackTab), Action::PreviousView),
        ],
    },
    Line {
        does: "follow one ray; arrows take another",
        label: Some("Follow"),
        keys: &[(key(KeyCode::F(4)), Action::Follow)],
    },
    Line {
        does: "its steps: the one before, the next",
        label: None,
        keys: &[(key(KeyCode::PageUp), Action::StepBack), (key(KeyCode::PageDown), Action::StepOn)],
    },
    Line { does: "back to the view", label: None, keys: &[(key(KeyCode::Home), Action::Home)] },
    Line {
        does: "shading model: a term less, more",
        label: None,
        keys: &[(char('['), Action::ShadingDown), (char(']'), Action::ShadingUp)],
    },
    Line {
        does: "next set of characters",
        label: Some("Glyphs"),
        keys: &[(key(KeyCode::F(7)), Action::NextGlyphs), (char('g'), Action::NextGlyphs)],
    },
    Line {
        does: "these keys",
        label: Some("Help"),
        keys: &[(key(KeyCode::F(1)), Action::Help), (char('?'), Action::Help)],
    },
    Line { does: "close what is open", label: None, keys: &[(key(KeyCode::Esc), Action::Close)] },
    Line { does: "send the whole screen again", label: None, keys: &[(control('l'), Action::Redraw)] },
    Line { does: "suspend", label: None, keys: &[(control('z'), Action::Suspend)] },
    Line {
        does: "quit",
        label: Some("Quit"),
        keys: &[(key(KeyCode::F(10)), Action::Quit), (char('q'), Action::Quit), (control('c'), Action::Quit)],
    },
];

/// The action of a key; absent where it has none.
pub fn action(event: KeyEvent) -> Option<Action> {
    let chord = Chord::of(event);
    bindings().find_map(|(bound, action)| (bound == chord).then_some(action))
}

/// The function keys that work, by number, with their labels.
pub fn function_keys() -> Vec<(u8, &'static str)> {
    let mut keys: Vec<_> = KEYMAP
        .iter()
        .filter_map(|line| {
            let number = line.keys.iter().find_map(|(chord, _)| chord.function_number())?;
            Some((number, line.label?))
        })
        .collect();
    keys.sort_unstable();
    keys
}

fn bindings() -> impl Iterator<Item = (Chord, Action)> {
    KEYMAP.iter().flat_map(|line| line.keys.iter().copied())
}

impl Chord {
    /// Shift is already in the character, except that Caps Lock should not turn the keys off.
    fn of(event: KeyEvent) -> Self {
        let code = match event.code {
            KeyCode::Char(c) => KeyCode::Char(c.to_ascii_lowercase()),
            code => code,
        };
        Self { code, control: event.modifiers.contains(KeyModifiers::CONTROL) }
    }

    const fn function_number(self) -> Option<u8> {
        match self.code {
            KeyCode::F(number) => Some(number),
            _ => None,
        }
    }
}

impl fmt::Display for Chord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.code {
            KeyCode::Char(c) if self.control => write!(f, "Ctrl-{}", c.to_ascii_uppercase()),
            KeyCode::Char(c) => write!(f, "{c}"),
            KeyCode::Left => f.write_str("←"),
            KeyCode::Right => f.write_str("→"),
            KeyCode::Up => f.write_str("↑"),
            KeyCode::Down => f.write_str("↓"),
            KeyCode::BackTab => f.write_str("Shift-Tab"),
            code => write!(f, "{code}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_is_bound_twice() {
        let chords: Vec<_> = bindings().map(|(chord, _)| chord).collect();
        for (n, chord) in chords.iter().enumerate() {
            assert!(!chords[..n].contains(chord), "{chord} is bound twice");
        }
    }

    #[test]
    fn every_action_has_a_key() {
        // `Quit` is the last: a new action before it makes this count and the table differ.
        for number in 0..=Action::Quit as usize {
            assert!(bindings().any(|(_, action)| action as usize == number), "action {number} has no key");
        }
    }

    #[test]
    fn a_label_stands_for_exactly_one_function_key() {
        for line in KEYMAP {
            let function_keys =
                line.keys.iter().filter(|(chord, _)| chord.function_number().is_some()).count();
            assert_eq!(function_keys, usize::from(line.label.is_some()), "{}", line.does);
        }
        assert_eq!(function_keys(), [(1, "Help"), (3, "View"), (4, "Follow"), (7, "Glyphs"), (10, "Quit")]);
    }

    #[test]
    fn keys_are_found_in_either_case_and_with_control() {
        let press = |code, modifiers| action(KeyEvent::new(code, modifiers));
        assert_eq!(press(KeyCode::Char('w'), KeyModifiers::NONE), Some(Action::FlyForward));
        assert_eq!(press(KeyCode::Char('W'), KeyModifiers::SHIFT), Some(Action::FlyForward));
        assert_eq!(press(KeyCode::Char('+'), KeyModifiers::SHIFT), Some(Action::ZoomIn));
        assert_eq!(press(KeyCode::BackTab, KeyModifiers::SHIFT), Some(Action::PreviousView));
        assert_eq!(press(KeyCode::Char('c'), KeyModifiers::CONTROL), Some(Action::Quit));
        assert_eq!(press(KeyCode::Char('c'), KeyModifiers::NONE), None);
        assert_eq!(press(KeyCode::Char('q'), KeyModifiers::CONTROL), None);
    }
}

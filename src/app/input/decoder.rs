//! Bytes of a terminal to keys and answers, in whatever pieces they come.
//!
//! A pure state machine: the time is given, and it says until when it would like more bytes. ECMA-48 frames
//! what is swallowed whole: a control sequence ends with its first byte from `@` to `~`, a control string
//! with ST or BEL.

use std::time::{Duration, Instant};

use ratatui::crossterm::event::{KeyEvent, KeyModifiers};

use super::{Input, answers, key_codes, mouse};

/// A lone `ESC` is the key after this time. Terminals send a sequence in one write, and what parts it is one
/// hop of the network; 50 ms is what vim and tmux came to wait too, and no person notices.
const BELIEVE_ESCAPE: Duration = Duration::from_millis(50);

/// What a person may have begun with Alt (`ESC [`) is waited for so long, and so long after an Esc that was
/// believed a sequence may still go on: twice the longest way of a packet that TCP sends once more on a usual
/// link.
const MISS_REST: Duration = Duration::from_secs(1);

/// What is certainly of a terminal, because it has contents, is waited for longer: a link may stall, and half
/// of a colour has letters that are keys.
const MISS_END: Duration = Duration::from_secs(5);

/// More than any answer that is read has; what is longer is still swallowed to its end.
const LONGEST: usize = 256;

/// The state between two pieces.
#[derive(Debug, Default)]
pub struct Decoder {
    state: State,
    /// The bytes since `ESC`, without it; in `Ground`, those of an unfinished character.
    held: Vec<u8>,
    /// Whether the `ESC` has been given as a key, because its rest came late.
    late: bool,
    /// Whether `ESC` stood before the unfinished character: it is Alt.
    alt: bool,
    /// When the last byte came.
    last: Option<Instant>,
    /// When `ESC` was given as a key, and nothing has come since.
    believed: Option<Instant>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Ground,
    /// After `ESC`.
    Escape,
    /// After `ESC O`.
    SingleShift,
    /// After `ESC [`.
    Sequence,
    /// After `ESC [ [`.
    LinuxConsole,
    /// After `ESC [ M`: the button, the column and the row follow, a byte each, that look like any character.
    Mouse { left: u8 },
    /// In a control string: OSC, DCS, SOS, PM or APC.
    String,
    /// After an `ESC` in a control string, which ends it.
    StringEscape,
}

impl Decoder {
    /// Takes in what came at a time, and gives what it makes whole.
    pub fn take(&mut self, bytes: &[u8], now: Instant) -> Vec<Input> {
        let mut inputs = Vec::new();
        // What waits has waited long enough, even if nobody has looked at the clock meanwhile.
        inputs.extend(self.wait_no_longer(now));
        let believed = self.believed.take();
        if let (Some(since), Some(b'[' | b'O' | b']' | b'P' | b'_' | b'^' | b'X')) = (believed, bytes.first())
            && now.saturating_duration_since(since) < MISS_REST
        {
            self.state = State::Escape;
            self.late = true;
        }
        for &byte in bytes {
            self.step(byte, &mut inputs);
        }
        self.last = Some(now);
        inputs
    }

    /// When the bytes that are held will no longer be waited for.
    pub fn patience_ends(&self) -> Option<Instant> {
        let patience = match (self.state, self.held.len()) {
            (State::Ground, _) => return None,
            (State::Escape, _) => BELIEVE_ESCAPE,
            _ if self.may_be_typed() => BELIEVE_ESCAPE,
            (_, 1) => MISS_REST,
            _ => MISS_END,
        };
        self.last.map(|last| last + patience)
    }

    /// Gives up what has been waited for long enough: `ESC` alone was a key, and so was what came alone after
    /// it.
    pub fn wait_no_longer(&mut self, now: Instant) -> Vec<Input> {
        let mut inputs = Vec::new();
        if self.patience_ends().is_some_and(|end| end <= now) {
            if self.state == State::Escape {
                inputs.push(key('\x1b'));
                self.believed = Some(now);
                self.begin(State::Ground);
            } else if self.may_be_typed() {
                self.give_characters(&mut inputs);
            } else {
                self.begin(State::Ground);
            }
        }
        inputs
    }

    /// Whether what is held came some time after Esc and is so short that a person may have typed it.
    fn may_be_typed(&self) -> bool {
        self.late && (self.held.len() == 1 || self.state == State::LinuxConsole)
    }

    fn begin(&mut self, state: State) {
        self.state = state;
        self.held.clear();
        self.late = false;
        self.alt = false;
    }

    fn step(&mut self, byte: u8, inputs: &mut Vec<Input>) {
        let in_string = matches!(self.state, State::String | State::StringEscape);
        match (self.state, byte) {
            (State::Ground, 0x1b) => self.begin(State::Escape),
            (State::Ground, byte) => self.character(byte, inputs),
            (State::Escape, 0x1b) => inputs.push(key('\x1b')),
            (State::Escape, byte) => self.after_escape(byte, inputs),
            (State::String, 0x1b) => self.state = State::StringEscape,
            (State::String, 0x07) | (State::StringEscape, b'\\') => self.end_string(inputs),
            (State::StringEscape, byte) => {
                // The string was cut off, and this is the next thing.
                self.begin(State::Escape);
                if byte != 0x1b {
                    self.step(byte, inputs);
                }
            }
            (State::Mouse { left: 1 }, _) => self.begin(State::Ground),
            (State::Mouse { left }, _) => self.state = State::Mouse { left: left - 1 },
            // A control character ends whatever it comes into, so that Ctrl-C always counts.
            (_, 0x00..=0x1f) => {
                self.begin(State::Ground);
                self.step(byte, inputs);
            }
            (_, 0x80..) if !in_string => {
                self.begin(State::Ground);
                self.step(byte, inputs);
            }
            (state, byte) => {
                if self.held.len() < LONGEST {
                    self.held.push(byte);
                }
                match state {
                    State::SingleShift => self.end_single_shift(byte, inputs),
                    State::LinuxConsole => self.end(key_codes::linux_console(byte), inputs),
                    State::Sequence => self.in_sequence(byte, inputs),
                    // Each command has a number; a `]` without one, after an Esc that was believed, was a
                    // key.
                    _ if self.late && self.held.starts_with(b"]") && !self.held[1].is_ascii_digit() => {
                        self.give_characters(inputs);
                    }
                    _ => {}
                }
            }
        }
    }

    fn after_escape(&mut self, byte: u8, inputs: &mut Vec<Input>) {
        let state = match byte {
            b'O' => State::SingleShift,
            b'[' => State::Sequence,
            b']' | b'P' | b'X' | b'^' | b'_' => State::String,
            // The end of a string that has not been waited for.
            b'\\' => return self.begin(State::Ground),
            _ => {
                self.begin(State::Ground);
                self.alt = true;
                return self.character(byte, inputs);
            }
        };
        self.held.push(byte);
        self.state = state;
    }

    /// A byte of a character in UTF-8. What is no UTF-8 is no key.
    fn character(&mut self, byte: u8, inputs: &mut Vec<Input>) {
        self.held.push(byte);
        match std::str::from_utf8(&self.held) {
            Ok(text) => {
                let held = if self.alt { KeyModifiers::ALT } else { KeyModifiers::NONE };
                inputs.extend(
                    text.chars()
                        .map(key_codes::character)
                        .map(|key| Input::Key(KeyEvent { modifiers: key.modifiers | held, ..key })),
                );
                self.begin(State::Ground);
            }
            Err(error) if error.error_len().is_none() => {}
            Err(_) => {
                // The byte that does not go on with the character may begin the next.
                let alone = self.held.len() == 1;
                self.begin(State::Ground);
                if !alone {
                    self.step(byte, inputs);
                }
            }
        }
    }

    fn end_single_shift(&mut self, byte: u8, inputs: &mut Vec<Input>) {
        // Old xterms put what is held down before the letter.
        if !matches!(byte, b'0'..=b'9' | b';') {
            self.end(key_codes::single_shift(byte), inputs);
        }
    }

    fn in_sequence(&mut self, byte: u8, inputs: &mut Vec<Input>) {
        let parameters = std::str::from_utf8(&self.held[1..self.held.len() - 1]).unwrap_or_default();
        let key = match byte {
            b'[' if parameters.is_empty() => return self.state = State::LinuxConsole,
            b'M' if parameters.is_empty() => return self.state = State::Mouse { left: 3 },
            // rxvt ends keys with Shift in what else goes before the end.
            b'$' if !parameters.is_empty() && parameters.bytes().all(|byte| byte.is_ascii_digit()) => {
                key_codes::in_sequence(parameters, byte)
            }
            b'@'..=b'~' if self.held.len() < LONGEST => {
                if let Some(answer) = answers::in_sequence(parameters, byte) {
                    inputs.push(Input::Answer(answer));
                    return self.begin(State::Ground);
                }
                if let Some(used) = mouse::in_sequence(parameters, byte) {
                    inputs.push(Input::Mouse(used));
                    return self.begin(State::Ground);
                }
                key_codes::in_sequence(parameters, byte)
            }
            b'@'..=b'~' => None,
            _ => return,
        };
        self.end(key, inputs);
    }

    /// Ends a sequence. One without a meaning is swallowed; but what came some time after Esc and has no
    /// parameters was typed.
    fn end(&mut self, key: Option<KeyEvent>, inputs: &mut Vec<Input>) {
        match key {
            Some(key) => inputs.push(Input::Key(key)),
            None if self.late && (self.held.len() == 2 || self.state == State::LinuxConsole) => {
                return self.give_characters(inputs);
            }
            None => {}
        }
        self.begin(State::Ground);
    }

    fn end_string(&mut self, inputs: &mut Vec<Input>) {
        if let (Some((b']', text)), true) = (self.held.split_first(), self.held.len() < LONGEST) {
            let text = String::from_utf8_lossy(text);
            inputs.extend(answers::in_command(&text).into_iter().map(Input::Answer));
        }
        self.begin(State::Ground);
    }

    /// Gives what is held as the characters that it is.
    fn give_characters(&mut self, inputs: &mut Vec<Input>) {
        let typed = std::mem::take(&mut self.held);
        self.begin(State::Ground);
        for byte in typed {
            self.character(byte, inputs);
        }
    }
}

fn key(c: char) -> Input {
    Input::Key(key_codes::character(c))
}

#[cfg(test)]
#[path = "decoder_tests.rs"]
mod tests;

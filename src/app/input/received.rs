//! What the terminal sent.

use std::io;

use ratatui::crossterm::event::KeyEvent;

use super::answers::Answer;
use super::mouse::Mouse;

/// What the terminal sent.
#[derive(Debug)]
pub enum Input {
    /// A key was pressed, or repeats.
    Key(KeyEvent),
    /// The mouse was used.
    Mouse(Mouse),
    /// An answer to something that we may have asked.
    Answer(Answer),
    /// The terminal has another size.
    #[cfg(not(unix))]
    Resized,
    /// The terminal is gone.
    HungUp,
    /// The terminal cannot be read.
    Failed(io::Error),
}

//! A line on a terminal that says how far something is that takes long.

use std::io::{IsTerminal, Write, stderr};

/// A line of standard error that is written over, and is gone with this. A file or a pipe has none.
#[derive(Debug)]
pub struct ProgressLine {
    is_wanted: bool,
    is_shown: bool,
}

impl ProgressLine {
    /// Nothing so far, nor ever where it is not wanted.
    pub fn new(is_wanted: bool) -> Self {
        Self { is_wanted: is_wanted && stderr().is_terminal(), is_shown: false }
    }

    /// Shows a text in place of the one before.
    pub fn show(&mut self, text: &str) {
        if self.is_wanted {
            // Where even that fails there is nobody to tell.
            let _ = write!(stderr(), "\r{text}\x1b[K");
            self.is_shown = true;
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if self.is_shown {
            let _ = write!(stderr(), "\r\x1b[K");
        }
    }
}

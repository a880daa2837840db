//! A line on a terminal that says how far something is that takes long.

use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use super::terminal::capabilities;

/// What takes no longer needs no word.
const PATIENCE: Duration = Duration::from_secs(1);

/// The line, which is gone with this. A file or a pipe has none.
#[derive(Debug)]
pub struct ProgressLine {
    begin: Instant,
    is_wanted: bool,
    is_shown: bool,
}

impl ProgressLine {
    /// For what begins now.
    pub fn begin() -> Self {
        let is_wanted = stderr().is_terminal() && capabilities().cursor;
        Self { begin: Instant::now(), is_wanted, is_shown: false }
    }

    /// Says that so many are done of all.
    pub fn say(&mut self, done: u32, of: u32, what: &str) {
        let spent = self.begin.elapsed();
        if !self.is_wanted || spent < PATIENCE || done == 0 {
            return;
        }
        let left = spent.div_f64(f64::from(done)).mul_f64(f64::from(of.saturating_sub(done)));
        // A line that can not be written is no reason to end what it tells of.
        let _ = write!(stderr(), "\r{done} of {of} {what}, {} s left\x1b[K", left.as_secs() + 1);
        self.is_shown = true;
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if self.is_shown {
            let _ = write!(stderr(), "\r\x1b[K");
        }
    }
}

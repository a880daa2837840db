//! A word where a pipe with a name is read that nobody writes to: else the program would stand still without
//! saying why.

use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use super::error::{tell, visible};

/// So long nothing is said: who writes to a pipe has begun by then, in a shell as in a script.
const PATIENCE: Duration = Duration::from_secs(1);

/// Says that a file is waited for while this is held, where it is a pipe.
#[derive(Debug)]
pub struct Waiting {
    /// Ends the thread that waits, by being dropped.
    _end: Option<Sender<()>>,
}

impl Waiting {
    /// For a file that is about to be read.
    pub fn new(file: &str) -> Self {
        if !is_pipe(file) {
            return Self { _end: None };
        }
        let (end, ended) = mpsc::channel::<()>();
        let message = format!("{}: waiting for what is written to this pipe; Ctrl-C ends it", visible(file));
        let wait = move || {
            if ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                tell(&message);
            }
        };
        // Without a thread nothing is said.
        let begun = thread::Builder::new().name("waiting".to_owned()).spawn(wait).is_ok();
        Self { _end: begun.then_some(end) }
    }
}

#[cfg(unix)]
fn is_pipe(file: &str) -> bool {
    use std::os::unix::fs::FileTypeExt;
    file != "-" && std::fs::metadata(file).is_ok_and(|found| found.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_pipe(_: &str) -> bool {
    false
}

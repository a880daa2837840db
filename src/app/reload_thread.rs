//! The thread that waits for the scenes that follow one that was opened.

use std::panic::{self, AssertUnwindSafe};
use std::sync::mpsc::Sender;
use std::{io, thread};

use super::events::Event;
use super::reloading::{NextScene, Reloaded};

/// Starts it for the scene of that number; it ends with these, or with the viewer.
pub fn start(of: u64, mut next: NextScene, events: Sender<Event>) -> io::Result<()> {
    let wait = move || {
        loop {
            // What a panic leaves half done is not looked at: the program ends.
            let event = match panic::catch_unwind(AssertUnwindSafe(&mut next)) {
                Ok(None) => return,
                Ok(Some(scene)) => Event::Changed(Reloaded { of, scene }),
                Err(_) => Event::Panicked,
            };
            let is_last = matches!(event, Event::Panicked);
            if events.send(event).is_err() || is_last {
                return;
            }
        }
    };
    thread::Builder::new().name("reloader".to_owned()).spawn(wait).map(drop)
}

//! Everything that can happen, in one channel: keys, sizes, signals, finished pictures, the end of the line.

use std::io;
use std::sync::mpsc::Sender;
use std::thread;

use ratatui::crossterm::event::{self, KeyEvent};

use crate::frame::Frame;

/// Something that happened.
#[derive(Debug)]
pub enum Event {
    /// A key was pressed, or repeats.
    Key(KeyEvent),
    /// The terminal has another size.
    Resized,
    /// A picture is finished.
    Drawn(Box<Frame>),
    /// The tracing thread panicked; its message is out.
    Panicked,
    /// The terminal is gone.
    HungUp,
    /// Input cannot be read.
    Failed(io::Error),
    /// A signal came that ends programs.
    Terminated(i32),
    /// A signal came that stops programs until they are continued.
    Stopped,
    /// We were stopped, and go on.
    Continued,
}

/// Starts to listen to the keys. The thread lasts as long as the process: nothing ends a read from a terminal.
pub fn listen_to_keys(events: Sender<Event>) -> io::Result<()> {
    let read = move || {
        loop {
            let event = match event::read() {
                Ok(event::Event::Key(key)) if !key.is_release() => Event::Key(key),
                Ok(event::Event::Resize(..)) => Event::Resized,
                Ok(_) => continue,
                Err(error) => Event::Failed(error),
            };
            let last = matches!(event, Event::Failed(_));
            if events.send(event).is_err() || last {
                return;
            }
        }
    };
    thread::Builder::new().name("keys".to_owned()).spawn(read).map(drop)
}

//! Everything that can happen, in one channel: keys, sizes, signals, finished pictures, the end of the line.

use std::collections::VecDeque;
use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::Instant;

use ratatui::crossterm::event::KeyEvent;

use super::done::Done;
use super::fence::Fence;
use super::input::{self, Answer, Input, Mouse};
use super::reloading::Reloaded;
use crate::frame::Frame;
use crate::stage::WorkStep;

/// Something that happened.
#[derive(Debug)]
pub enum Event {
    /// A key was pressed, or repeats.
    Key(KeyEvent),
    /// The mouse was used.
    Mouse(Mouse),
    /// The terminal answered.
    Answer(Answer),
    /// The terminal has come as far as the status request of this number.
    Reached(u64),
    /// The terminal has another size.
    Resized,
    /// Something takes long, and is so far.
    Working(WorkStep),
    /// The scene is there, or why there is none.
    Loaded,
    /// An errand is done.
    Done(Done),
    /// A file of the scene has changed.
    Changed(Reloaded),
    /// A picture is finished.
    Drawn(Box<Frame>),
    /// A picture that nobody wanted any more was given up.
    GivenUp,
    /// The thread that traces, or the one that reads the scene, panicked; its message is out.
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

impl Event {
    /// Whether nothing is worth waiting for any more.
    pub fn is_urgent(&self) -> bool {
        matches!(self, Self::Panicked | Self::HungUp | Self::Failed(_) | Self::Terminated(_))
    }
}

impl From<Input> for Event {
    fn from(input: Input) -> Self {
        match input {
            Input::Key(key) => Self::Key(key),
            Input::Mouse(used) => Self::Mouse(used),
            Input::Answer(answer) => Self::Answer(answer),
            #[cfg(not(unix))]
            Input::Resized => Self::Resized,
            Input::HungUp => Self::HungUp,
            Input::Failed(error) => Self::Failed(error),
        }
    }
}

/// Starts to listen to the terminal. The thread lasts as long as the process or the terminal, whoever still
/// listens, for an answer that is on its way is waited for.
pub fn listen_to_terminal(events: Sender<Event>, fence: Fence) -> io::Result<()> {
    input::start(move |input| {
        let event = match input {
            Input::Answer(Answer::Status) => Event::Reached(fence.answered()),
            Input::HungUp | Input::Failed(_) => {
                fence.forget();
                input.into()
            }
            input => input.into(),
        };
        // Without a receiver the viewer has ended.
        let _ = events.send(event);
    })
}

/// The end of the channel where events arrive, and those that have been looked at and put aside.
pub struct Inbox {
    events: Receiver<Event>,
    aside: VecDeque<Event>,
}

impl Inbox {
    /// An inbox with nothing put aside.
    pub fn new(events: Receiver<Event>) -> Self {
        Self { events, aside: VecDeque::new() }
    }

    /// Keeps an event for later, behind those that are kept already.
    pub fn put_aside(&mut self, event: Event) {
        self.aside.push_back(event);
    }

    /// The next event, those put aside first; absent at the deadline, if there is one.
    ///
    /// # Errors
    /// Where nobody is left to send any.
    pub fn next(&mut self, deadline: Option<Instant>) -> Result<Option<Event>, Gone> {
        match self.aside.pop_front() {
            Some(event) => Ok(Some(event)),
            None => self.next_arrival(deadline),
        }
    }

    /// The next event that arrives, past those put aside; absent at the deadline, if there is one.
    ///
    /// # Errors
    /// Where nobody is left to send any.
    pub fn next_arrival(&mut self, deadline: Option<Instant>) -> Result<Option<Event>, Gone> {
        let Some(deadline) = deadline else { return self.events.recv().map(Some).map_err(|_| Gone) };
        match self.events.recv_timeout(deadline.saturating_duration_since(Instant::now())) {
            Ok(event) => Ok(Some(event)),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(Gone),
        }
    }

    /// An event that is there already.
    pub fn try_next(&mut self) -> Option<Event> {
        self.aside.pop_front().or_else(|| self.events.try_recv().ok())
    }
}

/// Nobody is left to send an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gone;

//! The thread that traces: it draws the picture that was asked for last, and never a queue of old ones.

use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use super::Painter;
use super::events::Event;
use crate::frame::Request;

/// The way to the tracing thread. Dropping it ends the thread after the picture in hand.
pub struct Tracer {
    mailbox: Arc<Mailbox>,
    /// The last request that was posted.
    asked: Option<Request>,
}

impl Tracer {
    /// Starts the thread. It sends each finished picture, or that it has panicked, to `events`.
    pub fn start(painter: Arc<dyn Painter>, events: Sender<Event>) -> io::Result<Self> {
        let mailbox = Arc::new(Mailbox::default());
        let inbox = mailbox.clone();
        thread::Builder::new().name("tracer".to_owned()).spawn(move || {
            while let Some(request) = inbox.take() {
                // What a panicking painter leaves half done is not looked at again: the program ends.
                let drawn = panic::catch_unwind(AssertUnwindSafe(|| painter.draw(&request)));
                let event = drawn.map_or(Event::Panicked, |frame| Event::Drawn(Box::new(frame)));
                if events.send(event).is_err() {
                    return;
                }
            }
        })?;
        Ok(Self { mailbox, asked: None })
    }

    /// Asks for a picture in place of any that has not been begun. The same request twice is asked once.
    pub fn ask(&mut self, request: Request) {
        if self.asked.as_ref() != Some(&request) {
            self.mailbox.post(request.clone());
            self.asked = Some(request);
        }
    }
}

impl Drop for Tracer {
    fn drop(&mut self) {
        self.mailbox.close();
    }
}

/// Room for one request: the latest wins.
#[derive(Default)]
struct Mailbox {
    slot: Mutex<Slot>,
    changed: Condvar,
}

#[derive(Default)]
struct Slot {
    request: Option<Request>,
    closed: bool,
}

impl Mailbox {
    fn post(&self, request: Request) {
        self.lock().request = Some(request);
        self.changed.notify_one();
    }

    fn close(&self) {
        self.lock().closed = true;
        self.changed.notify_one();
    }

    /// Waits for a request; absent once the mailbox is closed.
    fn take(&self) -> Option<Request> {
        let waiting = |slot: &mut Slot| slot.request.is_none() && !slot.closed;
        let slot = self.changed.wait_while(self.lock(), waiting);
        let mut slot = slot.unwrap_or_else(PoisonError::into_inner);
        if slot.closed { None } else { slot.request.take() }
    }

    fn lock(&self) -> MutexGuard<'_, Slot> {
        // Each change is a single assignment: the slot is whole after any panic.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

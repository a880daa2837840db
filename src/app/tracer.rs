//! The thread that traces: it draws the picture that was asked for last, and never a queue of old ones.

use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use super::Painter;
use super::events::Event;
use super::watch::Watch;
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
        let mut watch = Watch::start(painter.progress(), events.clone())?;
        let mut painter = painter;
        thread::Builder::new().name("tracer".to_owned()).spawn(move || {
            while let Some(request) = inbox.take() {
                if let Some(next) = inbox.new_painter() {
                    // Where the system has no thread for it, nobody is told how far a picture is.
                    if let Ok(other) = Watch::start(next.progress(), events.clone()) {
                        watch.close();
                        watch = other;
                    }
                    painter = next;
                }
                watch.begin();
                // What a panicking painter leaves half done is not looked at again: the program ends.
                let drawn = panic::catch_unwind(AssertUnwindSafe(|| painter.draw(&request)));
                watch.end();
                let panicked = drawn.is_err();
                let event = drawn.map_or(Event::Panicked, |frame| Event::Drawn(Box::new(frame)));
                if events.send(event).is_err() || panicked {
                    break;
                }
            }
            watch.close();
        })?;
        Ok(Self { mailbox, asked: None })
    }

    /// Whether this is the request that was asked last.
    pub fn has_been_asked(&self, request: &Request) -> bool {
        self.asked.as_ref() == Some(request)
    }

    /// Pictures that are asked for from now on are of another painter.
    pub fn change(&mut self, painter: Arc<dyn Painter>) {
        self.mailbox.lock().painter = Some(painter);
        self.asked = None;
    }

    /// Asks for a picture in place of any that has not been begun. The same request twice is asked once.
    pub fn ask(&mut self, request: Request) {
        if !self.has_been_asked(&request) {
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
    /// Who is to draw it and all that follow, where that is another than before.
    painter: Option<Arc<dyn Painter>>,
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

    fn new_painter(&self) -> Option<Arc<dyn Painter>> {
        self.lock().painter.take()
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

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{self, Receiver};

    use super::*;
    use crate::frame::{Frame, Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::Size;
    use crate::plan::Options;
    use crate::scene::{Camera, Scene};
    use crate::tone::Tone;

    /// Says when it begins a picture, and finishes it when it is told to.
    struct Slow {
        studio: Studio,
        begun: Mutex<Sender<u32>>,
        finish: Mutex<Receiver<()>>,
    }

    impl Painter for Slow {
        fn scene(&self) -> &Scene {
            self.studio.scene()
        }
        fn camera(&self, index: usize, aspect: f64) -> Camera {
            self.studio.camera(index, aspect)
        }
        fn draw(&self, request: &Request) -> Frame {
            self.begun.lock().unwrap().send(request.dots.width).unwrap();
            self.finish.lock().unwrap().recv().expect("the order to finish");
            self.studio.draw(request)
        }
    }

    /// A request told apart by its width.
    fn request(width: u32) -> Request {
        Request {
            camera: Studio::new(Scene::default()).unwrap().camera(0, 1.0),
            dots: Size::new(width, 1),
            dot_aspect: 1.0,
            options: Options { threads: 1, ..Options::default() },
            wants: Wants::CELLS,
            glyphs: GlyphMode::Shade,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        }
    }

    fn start() -> (Tracer, Receiver<u32>, Sender<()>, Receiver<Event>) {
        let (begin, begun) = mpsc::channel();
        let (finish, finished) = mpsc::channel();
        let studio = Studio::new(Scene::default()).unwrap();
        let slow = Slow { studio, begun: Mutex::new(begin), finish: Mutex::new(finished) };
        let (sender, events) = mpsc::channel();
        (Tracer::start(Arc::new(slow), sender).unwrap(), begun, finish, events)
    }

    /// What came of a picture; on a busy machine there may be word before that it takes long.
    fn done(events: &Receiver<Event>) -> Event {
        events.iter().find(|event| !matches!(event, Event::Working(_))).expect("an end")
    }

    #[test]
    fn only_the_latest_of_the_waiting_requests_is_drawn() {
        let (mut tracer, begun, finish, events) = start();
        tracer.ask(request(1));
        assert_eq!(begun.recv().unwrap(), 1);
        for width in 2..=9 {
            tracer.ask(request(width));
        }
        finish.send(()).unwrap();
        assert_eq!(begun.recv().unwrap(), 9);
        finish.send(()).unwrap();
        for width in [1, 9] {
            let Event::Drawn(frame) = done(&events) else { panic!("a picture") };
            assert_eq!(frame.cells.expect("they were asked for").size().width, width);
        }
    }

    #[test]
    fn the_same_request_is_drawn_once() {
        let (mut tracer, begun, finish, _events) = start();
        for width in [1, 2] {
            tracer.ask(request(width));
            assert_eq!(begun.recv().unwrap(), width);
            tracer.ask(request(width));
            finish.send(()).unwrap();
        }
        drop(tracer);
        assert_eq!(begun.iter().count(), 0);
    }

    #[test]
    fn a_panic_is_an_event_and_ends_the_thread() {
        let (mut tracer, begun, finish, events) = start();
        drop(finish); // the order to finish never comes, and the painter panics
        tracer.ask(request(1));
        assert!(matches!(done(&events), Event::Panicked));
        assert!(events.recv().is_err(), "the thread has dropped its sender");
        assert_eq!(begun.recv().unwrap(), 1);
    }
}

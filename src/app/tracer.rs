//! The thread that traces: it draws the picture that was asked for last, and never a queue of old ones.

use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Instant;

use super::Painter;
use super::events::Event;
use super::refinement::Order;
use super::watch::Watch;
use crate::stage::GiveUp;

/// The way to the tracing thread. Dropping it ends the thread, which gives up what it has in hand.
pub struct Tracer {
    mailbox: Arc<Mailbox>,
    /// Whether nobody wants what was asked for last.
    unwanted: Arc<AtomicBool>,
}

/// What is to be drawn, and whether nobody wants it any more.
struct Job {
    order: Order,
    unwanted: Arc<AtomicBool>,
}

impl Tracer {
    /// Starts the thread. It sends each finished picture, that one was given up, or that it has panicked, to
    /// `events`.
    pub fn start(painter: Arc<dyn Painter>, events: Sender<Event>) -> io::Result<Self> {
        let mailbox = Arc::new(Mailbox::default());
        let inbox = mailbox.clone();
        let mut watch = Watch::start(painter.progress(), events.clone())?;
        let mut painter = painter;
        thread::Builder::new().name("tracer".to_owned()).spawn(move || {
            while let Some(Job { order, unwanted }) = inbox.take() {
                if let Some(next) = inbox.new_painter() {
                    // Where the system has no thread for it, nobody is told how far a picture is.
                    if let Ok(other) = Watch::start(next.progress(), events.clone()) {
                        watch.close();
                        watch = other;
                    }
                    painter = next;
                }
                watch.begin();
                let begin = Instant::now();
                let when = || unwanted.load(Ordering::Relaxed) && begin.elapsed() >= order.patience;
                // What a panicking painter leaves half done is not looked at again: the program ends.
                let drawn =
                    panic::catch_unwind(AssertUnwindSafe(|| order.draw(&*painter, &GiveUp::when(&when))));
                watch.end();
                let panicked = drawn.is_err();
                let event = match drawn {
                    Ok(Some(frame)) => Event::Drawn(Box::new(frame)),
                    Ok(None) => Event::GivenUp,
                    Err(_) => Event::Panicked,
                };
                if events.send(event).is_err() || panicked {
                    break;
                }
            }
            watch.close();
        })?;
        Ok(Self { mailbox, unwanted: Arc::default() })
    }

    /// Asks for a picture in place of any that has not been begun.
    pub fn ask(&mut self, order: Order) {
        self.unwanted = Arc::default();
        self.mailbox.post(Job { order, unwanted: self.unwanted.clone() });
    }

    /// Says that nobody wants what was asked for last. It is given up when its patience is over.
    pub fn give_up(&self) {
        self.unwanted.store(true, Ordering::Relaxed);
    }

    /// Pictures that are asked for from now on are of another painter.
    pub fn change(&mut self, painter: Arc<dyn Painter>) {
        self.mailbox.lock().painter = Some(painter);
    }
}

impl Drop for Tracer {
    fn drop(&mut self) {
        self.give_up();
        self.mailbox.close();
    }
}

/// Room for one job: the latest wins.
#[derive(Default)]
struct Mailbox {
    slot: Mutex<Slot>,
    changed: Condvar,
}

#[derive(Default)]
struct Slot {
    job: Option<Job>,
    /// Who is to draw it and all that follow, where that is another than before.
    painter: Option<Arc<dyn Painter>>,
    closed: bool,
}

impl Mailbox {
    fn post(&self, job: Job) {
        self.lock().job = Some(job);
        self.changed.notify_one();
    }

    fn close(&self) {
        self.lock().closed = true;
        self.changed.notify_one();
    }

    fn new_painter(&self) -> Option<Arc<dyn Painter>> {
        self.lock().painter.take()
    }

    /// Waits for a job; absent once the mailbox is closed.
    fn take(&self) -> Option<Job> {
        let waiting = |slot: &mut Slot| slot.job.is_none() && !slot.closed;
        let slot = self.changed.wait_while(self.lock(), waiting);
        let mut slot = slot.unwrap_or_else(PoisonError::into_inner);
        if slot.closed { None } else { slot.job.take() }
    }

    fn lock(&self) -> MutexGuard<'_, Slot> {
        // Each change is a single assignment: the slot is whole after any panic.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{self, Receiver};
    use std::time::Duration;

    use super::*;
    use crate::frame::{Frame, Request, Studio, Wants};
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

    /// An order told apart by its width, that is finished whoever wants it.
    fn order(width: u32) -> Order {
        let request = Request {
            camera: Studio::new(Scene::default()).unwrap().camera(0, 1.0),
            dots: Size::new(width, 1),
            dot_aspect: 1.0,
            options: Options { threads: 1, ..Options::default() },
            wants: Wants::CELLS,
            glyphs: GlyphMode::Shade,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        };
        Order { request, factor: 1, patience: Duration::MAX }
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
        tracer.ask(order(1));
        assert_eq!(begun.recv().unwrap(), 1);
        for width in 2..=9 {
            tracer.ask(order(width));
        }
        finish.send(()).unwrap();
        assert_eq!(begun.recv().unwrap(), 9);
        finish.send(()).unwrap();
        for width in [1, 9] {
            let Event::Drawn(frame) = done(&events) else { panic!("a picture") };
            assert_eq!(frame.cells.expect("they were asked for").size().width, width);
        }
    }

    /// Draws until it is to give up.
    struct Endless(Studio, Mutex<Sender<()>>);

    impl Painter for Endless {
        fn scene(&self) -> &Scene {
            self.0.scene()
        }
        fn camera(&self, index: usize, aspect: f64) -> Camera {
            self.0.camera(index, aspect)
        }
        fn draw(&self, _request: &Request) -> Frame {
            unreachable!("it is drawn unless it is given up")
        }
        fn draw_unless(&self, request: &Request, give_up: &GiveUp) -> Option<Frame> {
            self.1.lock().unwrap().send(()).unwrap();
            if request.dots.width > 1 {
                return Some(self.0.draw(request));
            }
            while !give_up.is_due() {
                thread::yield_now();
            }
            None
        }
    }

    #[test]
    fn what_nobody_wants_is_given_up() {
        let (begin, begun) = mpsc::channel();
        let (sender, events) = mpsc::channel();
        let endless = Endless(Studio::new(Scene::default()).unwrap(), Mutex::new(begin));
        let mut tracer = Tracer::start(Arc::new(endless), sender).unwrap();
        tracer.ask(Order { patience: Duration::ZERO, ..order(1) });
        begun.recv().unwrap();
        tracer.give_up();
        assert!(matches!(done(&events), Event::GivenUp));
        // The next is not touched by that.
        tracer.ask(order(2));
        assert!(matches!(done(&events), Event::Drawn(_)));
        // The end gives up what is in hand.
        tracer.ask(Order { patience: Duration::ZERO, ..order(1) });
        begun.recv().unwrap();
        begun.recv().unwrap();
        drop(tracer);
        assert!(matches!(done(&events), Event::GivenUp));
        assert!(events.recv().is_err(), "the thread has ended");
    }

    #[test]
    fn a_panic_is_an_event_and_ends_the_thread() {
        let (mut tracer, begun, finish, events) = start();
        drop(finish); // the order to finish never comes, and the painter panics
        tracer.ask(order(1));
        assert!(matches!(done(&events), Event::Panicked));
        assert!(events.recv().is_err(), "the thread has dropped its sender");
        assert_eq!(begun.recv().unwrap(), 1);
    }
}

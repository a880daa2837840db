//! Tells the screen, from time to time, how far long work is. Nothing wakes by a clock while nothing is at
//! work.

use std::io;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use super::events::Event;
use crate::stage::Progress;

/// So often: as often as a person reads a new number, and rarely enough for the slowest line. Work that is
/// done sooner is never spoken of.
const TICK: Duration = Duration::from_millis(250);

/// Watches one piece of work at a time, until it is closed.
#[derive(Clone)]
pub struct Watch(Arc<Shared>);

struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Clone, Copy, Debug)]
struct State {
    now: Now,
    /// The number of the piece of work: pictures that follow each other without a pause are each begun anew.
    piece: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Now {
    Idle,
    Working,
    Closed,
}

impl Watch {
    /// Starts the thread that watches. It sends [`Event::Working`] while something is.
    pub fn start(progress: Progress, events: Sender<Event>) -> io::Result<Self> {
        let shared = Arc::new(Shared {
            state: Mutex::new(State { now: Now::Idle, piece: 0 }),
            changed: Condvar::new(),
        });
        let watched = Arc::clone(&shared);
        let watch = move || {
            let mut last = None;
            loop {
                match watched.wait() {
                    Wait::Closed => return,
                    Wait::Idle => last = None,
                    Wait::Tick(_at_work) => {
                        let step = progress.now();
                        if last != Some(step) && events.send(Event::Working(step)).is_err() {
                            return;
                        }
                        last = Some(step);
                    }
                }
            }
        };
        thread::Builder::new().name("watch".to_owned()).spawn(watch)?;
        Ok(Self(shared))
    }

    /// Work begins.
    pub fn begin(&self) {
        self.0.set(Now::Working);
    }

    /// It is done. From here on nothing is said of it, so what is sent next comes behind all that was.
    pub fn end(&self) {
        self.0.set(Now::Idle);
    }

    /// Ends the thread.
    pub fn close(&self) {
        self.0.set(Now::Closed);
    }
}

/// What a wait ended with.
enum Wait<'a> {
    Closed,
    /// Nothing is at work, or another piece than before.
    Idle,
    /// The same piece is still at work, and stays so while this is held.
    Tick(MutexGuard<'a, State>),
}

impl Shared {
    fn set(&self, now: Now) {
        let mut state = self.lock();
        // What is closed stays closed: work may be done before anybody has asked to watch it.
        if state.now != Now::Closed {
            *state = State { now, piece: state.piece + u64::from(now == Now::Working) };
        }
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // Each change is a single assignment: the state is whole after any panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for work, then a tick of it.
    fn wait(&self) -> Wait<'_> {
        let idle = self.changed.wait_while(self.lock(), |state| state.now == Now::Idle);
        let state = idle.unwrap_or_else(PoisonError::into_inner);
        let piece = state.piece;
        let same = |state: &State| state.now == Now::Working && state.piece == piece;
        let ticked = self.changed.wait_timeout_while(state, TICK, |state| same(state));
        let (state, _) = ticked.unwrap_or_else(PoisonError::into_inner);
        if state.now == Now::Closed {
            Wait::Closed
        } else if same(&state) {
            Wait::Tick(state)
        } else {
            Wait::Idle
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::{Task, WorkStep};
    use std::sync::mpsc;

    #[test]
    fn each_step_is_told_once_and_none_behind_the_end() {
        let (sender, events) = mpsc::channel();
        let progress = Progress::default();
        let watch = Watch::start(progress.clone(), sender).unwrap();
        progress.begin(Task::Tracing, 2);
        watch.begin();
        let told = || match events.recv().unwrap() {
            Event::Working(step) => step,
            event => panic!("{event:?}"),
        };
        assert_eq!(told(), WorkStep { task: Task::Tracing, percent: Some(0) });
        progress.advance(1);
        assert_eq!(told(), WorkStep { task: Task::Tracing, percent: Some(50) });
        watch.end();
        progress.advance(1);
        watch.close();
        // The thread lets go of its sender without another word.
        assert!(events.recv().is_err());
    }

    #[test]
    fn what_is_closed_stays_closed() {
        let (sender, events) = mpsc::channel();
        let watch = Watch::start(Progress::default(), sender).unwrap();
        watch.close();
        watch.begin();
        assert!(events.recv().is_err(), "its thread has ended");
    }
}

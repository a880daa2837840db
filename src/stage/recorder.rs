//! A probe that keeps what happens to rays.

use super::Stage;
use super::probe::Probe;
use super::ray_event::RayEvent;

/// Keeps the events of the rays that are traced, in their order: the first of them, as many as are wanted.
#[derive(Clone, Debug)]
pub struct Recorder {
    /// What happened so far.
    pub events: Vec<RayEvent>,
    /// How many more happened that are not kept.
    pub left_out: u64,
    most: usize,
}

impl Recorder {
    /// Keeps so many events.
    pub const fn of_the_first(most: usize) -> Self {
        Self { events: Vec::new(), left_out: 0, most }
    }
}

impl Default for Recorder {
    /// Keeps all.
    fn default() -> Self {
        Self::of_the_first(usize::MAX)
    }
}

impl Probe for Recorder {
    fn at(&mut self, _: Stage) {}

    fn record(&mut self, event: impl FnOnce() -> RayEvent) {
        if self.events.len() < self.most {
            self.events.push(event());
        } else {
            self.left_out += 1;
        }
    }
}

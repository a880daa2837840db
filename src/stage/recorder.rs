//! A probe that keeps what happens to rays.

use super::Stage;
use super::probe::Probe;
use super::ray_event::RayEvent;

/// Keeps the events of the rays that are traced, in their order.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    /// What happened so far.
    pub events: Vec<RayEvent>,
}

impl Probe for Recorder {
    fn at(&mut self, _: Stage) {}

    fn record(&mut self, event: impl FnOnce() -> RayEvent) {
        self.events.push(event());
    }
}

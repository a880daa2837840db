//! What watches the tracing: when it passes from stage to stage, and what a ray meets.
//!
//! Whoever traces carries a [`Meter`] along, which counts and has a probe. [`Silent`] costs nothing,
//! [`Stopwatch`](super::Stopwatch) adds up times, [`Recorder`](super::Recorder) keeps what happens to a ray.

use super::ray_event::RayEvent;
use super::{Counts, Stage};

/// Runs along with the tracing.
pub trait Probe {
    /// The work from here on belongs to `stage`.
    fn at(&mut self, stage: Stage);

    /// Takes what has just happened to the ray. Single rays tell it, those of packets do not. A probe that
    /// does not ask for `event` pays nothing: it is not even made.
    #[inline(always)]
    fn record(&mut self, event: impl FnOnce() -> RayEvent)
    where
        Self: Sized,
    {
        let _ = event;
    }
}

/// Watches nothing, at no cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Probe for Silent {
    #[inline]
    fn at(&mut self, _: Stage) {}
}

/// Counts and a probe, carried along by whoever traces.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter<P> {
    /// What was counted.
    pub counts: Counts,
    /// What watches.
    pub probe: P,
}

impl<P: Probe> Meter<P> {
    /// Nothing counted yet.
    pub fn new(probe: P) -> Self {
        Self { counts: Counts::default(), probe }
    }

    /// The work from here on belongs to `stage`.
    #[inline]
    pub fn at(&mut self, stage: Stage) {
        self.probe.at(stage);
    }

    /// [`Probe::record`].
    #[inline(always)]
    pub fn record(&mut self, event: impl FnOnce() -> RayEvent) {
        self.probe.record(event);
    }

    /// Counts and records a cell that the ray comes into at `from`.
    #[inline(always)]
    pub fn enter_cell(&mut self, from: f64) {
        self.enter_numbered_cell(from, None);
    }

    /// The same of a cell of the lattice of all objects, where it has a number there.
    #[inline(always)]
    pub fn enter_numbered_cell(&mut self, from: f64, number: Option<u32>) {
        self.counts.cells_visited += 1;
        self.record(|| RayEvent::Cell { from, number });
    }
}

//! Memory for incoherent rays: those of packets that were given up, traced as a stream.

use crate::lattice::{Candidate, Stream};
use crate::math::{Ray, RayIndex};
use crate::solid::{Departure, Departures, RayBatch, Scratch};

/// Memory for incoherent rays.
#[derive(Debug, Default)]
pub(super) struct IncoherentRays {
    pub stream: Stream,
    pub rays: Vec<StreamRay>,
    /// By ray, the primitive that it leaves to the outside, and [`Departures::NOWHERE`] where it leaves none.
    pub leaves: Vec<u32>,
    pub balls: Queue,
    pub tubes: Queue,
    pub eight: RayBatch,
    pub scratch: Scratch,
}

/// A ray of a stream, and its place among the packets.
#[derive(Clone, Copy, Debug)]
pub(super) struct StreamRay {
    pub at: RayIndex,
    pub ray: Ray,
    pub departure: Option<Departure>,
}

/// Rays that are to be intersected with primitives of one form, several at a time.
#[derive(Debug, Default)]
pub(super) struct Queue(pub Vec<QueuedTest>);

#[derive(Clone, Copy, Debug)]
pub(super) struct QueuedTest {
    pub candidate: Candidate,
    /// The primitive, by its index in the assembly.
    pub index: u32,
}

impl IncoherentRays {
    /// Takes all rays out.
    #[inline]
    pub fn clear(&mut self) {
        self.stream.clear();
        self.rays.clear();
        self.leaves.clear();
    }

    /// Adds a ray that meets nothing that matters beyond `to`.
    #[inline(always)]
    pub fn push(&mut self, at: RayIndex, ray: Ray, departure: Option<Departure>, to: f64) {
        self.stream.push(&ray, to);
        self.leaves.push(departure.filter(|d| !d.inward).map_or(Departures::NOWHERE, |d| d.primitive));
        self.rays.push(StreamRay { at, ray, departure });
    }
}

//! Memory of one worker.

use fearless_simd::Simd;

use crate::lattice::{FRUSTA, Frustum, FrustumSoa};
use crate::math::{RayPacket, Real};
use crate::solid::{PacketCrossings, PacketScratch, PacketShear, PrunedExpr, Pruning};
use crate::stage::Counts;

use super::packet_culler::PacketCuller;
use super::packet_hits::PacketHits;
use super::reordering::RayReordering;
use super::source::PacketSource;
use super::stream::Apart;
use super::walk::Waits;

/// What tracing a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileMemory {
    /// By packet: its own frustum, if it asks, and how far its rays have still to look.
    pub(super) frustums: Vec<Option<Frustum>>,
    pub(super) far: Vec<f64>,
    /// Their rays in single precision, for as many as a frusta has.
    pub(super) thin: Vec<PacketCuller>,
    pub(super) frusta: FrustumSoa,
    pub(super) reordering: RayReordering,
    pub(super) apart: Apart,
    /// By packet: the planes across its rays, where they were asked for.
    pub(super) sheared: Vec<PacketShear>,
    /// Nodes to be walked.
    pub(super) stack: Vec<Waits>,
    pub(super) numbers: Numbers<f64>,
    pub(super) singles: Numbers<f32>,
    /// What rays meet of one object.
    pub(super) met: Box<PacketHits>,
    pub(super) pruning: Pruning,
    /// Pruned expressions that are not in use.
    pub(super) remains: Vec<PrunedExpr>,
    pub(super) counts: Counts,
}

/// Memory for what is asked of a packet, in numbers of this precision.
#[derive(Debug)]
pub(super) struct Numbers<T> {
    pub scratch: PacketScratch<T>,
    pub found: Box<PacketCrossings<T>>,
    /// By packet: its rays, and what they met, where those of the tile are others.
    pub rays: Vec<RayPacket<T>>,
    pub nearest: Vec<PacketHits<T>>,
}

impl<T: Real> Default for Numbers<T> {
    fn default() -> Self {
        Self {
            scratch: PacketScratch::default(),
            found: Box::new(PacketCrossings::NONE),
            rays: Vec::new(),
            nearest: Vec::new(),
        }
    }
}

/// Precisions in which rays are asked.
pub(super) trait Asks: Real {
    /// Their part of the memory.
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self>;

    /// Makes a packet known in this precision, where they are not its own.
    fn take<S: Simd>(simd: S, full: &RayPacket, own: &mut [RayPacket<Self>], k: usize);

    /// A packet that was made known.
    fn source<'a>(full: PacketSource<'a>, own: &'a [RayPacket<Self>], k: usize) -> PacketSource<'a, Self>;
}

impl Asks for f64 {
    #[inline(always)]
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self> {
        &mut memory.numbers
    }

    #[inline(always)]
    fn take<S: Simd>(_: S, _: &RayPacket, _: &mut [RayPacket], _: usize) {}

    #[inline(always)]
    fn source<'a>(full: PacketSource<'a>, _: &'a [RayPacket], _: usize) -> PacketSource<'a> {
        full
    }
}

impl Asks for f32 {
    #[inline(always)]
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self> {
        &mut memory.singles
    }

    #[inline(always)]
    fn take<S: Simd>(simd: S, full: &RayPacket, own: &mut [RayPacket<Self>], k: usize) {
        simd.vectorize(
            #[inline(always)]
            || own[k].set_nearest(full),
        );
    }

    #[inline(always)]
    fn source<'a>(full: PacketSource<'a>, own: &'a [RayPacket<Self>], k: usize) -> PacketSource<'a, Self> {
        // Only rays from the eye are asked so, which leave nothing.
        PacketSource {
            rays: &own[k],
            departures: None,
            full_rays: full.rays,
            full_departures: full.departures,
        }
    }
}

impl TileMemory {
    /// What was counted since it was last taken.
    pub fn counts_mut(&mut self) -> &mut Counts {
        &mut self.counts
    }

    /// Forgets the planes across the rays of the last tile.
    pub(super) fn forget_sheared(&mut self) {
        self.sheared.iter_mut().for_each(PacketShear::forget);
    }
}

impl Default for TileMemory {
    fn default() -> Self {
        Self {
            frustums: Vec::new(),
            far: Vec::new(),
            thin: vec![PacketCuller::EMPTY; FRUSTA],
            frusta: FrustumSoa::default(),
            reordering: RayReordering::default(),
            apart: Apart::default(),
            sheared: vec![PacketShear::UNKNOWN; FRUSTA],
            stack: Vec::new(),
            numbers: Numbers::default(),
            singles: Numbers::default(),
            met: Box::default(),
            pruning: Pruning::default(),
            remains: Vec::new(),
            counts: Counts::default(),
        }
    }
}

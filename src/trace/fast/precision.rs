//! The precisions in which packets are traced: double, or single for rays from the eye.

use fearless_simd::Simd;

use crate::math::{RayPacket, Real};

use super::memory::{PrecisionScratch, TileMemory};
use super::source::PacketSource;

/// A precision in which packets are traced.
pub(super) trait Precision: Real {
    /// Its part of the memory.
    fn scratch(memory: &mut TileMemory) -> &mut PrecisionScratch<Self>;

    /// Rounds a packet to `own[k]`, where this precision is not that of the tile's rays.
    fn take<S: Simd>(simd: S, full: &RayPacket, own: &mut [RayPacket<Self>], k: usize);

    /// A packet that was taken.
    fn source<'a>(full: PacketSource<'a>, own: &'a [RayPacket<Self>], k: usize) -> PacketSource<'a, Self>;
}

impl Precision for f64 {
    #[inline(always)]
    fn scratch(memory: &mut TileMemory) -> &mut PrecisionScratch<Self> {
        &mut memory.doubles
    }

    #[inline(always)]
    fn take<S: Simd>(_: S, _: &RayPacket, _: &mut [RayPacket], _: usize) {}

    #[inline(always)]
    fn source<'a>(full: PacketSource<'a>, _: &'a [RayPacket], _: usize) -> PacketSource<'a> {
        full
    }
}

impl Precision for f32 {
    #[inline(always)]
    fn scratch(memory: &mut TileMemory) -> &mut PrecisionScratch<Self> {
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
        // Only rays from the eye are traced so, which leave nothing.
        PacketSource {
            rays: &own[k],
            departures: None,
            full_rays: full.rays,
            full_departures: full.departures,
        }
    }
}

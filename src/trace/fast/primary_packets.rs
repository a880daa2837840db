//! The rays from the eye through a tile, in packets that are made where anything may lie in their way.

use fearless_simd::{Level, Simd};

use crate::math::{LaneVector, Lanes, REGISTERS, RayPacket, dispatch};
use crate::view::TileCamera;

use super::super::exact::all_moved_nearer;

/// Room for the rays from the eye through a tile, by block.
#[derive(Debug)]
pub struct PrimaryPackets<'a> {
    /// What they are made by.
    pub camera: &'a TileCamera<'a>,
    /// As many as the tile has blocks.
    pub rays: &'a mut [RayPacket],
    /// The path length from the eye to where each ray starts, in two parts that are to be added to a
    /// distance, the second first.
    pub before: &'a mut [[Lanes; 2]],
}

impl PrimaryPackets<'_> {
    /// Makes the rays of block `k`, which start near the world.
    pub fn make(&mut self, k: usize, level: Level) {
        self.camera.rays(k, level, &mut self.rays[k]);
        approach(&mut self.rays[k], &mut self.before[k], level);
    }
}

/// Moves the starts of rays from the eye near to the world. Sets the path lengths there, as
/// [`PrimaryPackets::before`] has them.
pub(super) fn approach(packet: &mut RayPacket, before: &mut [Lanes; 2], level: Level) {
    dispatch!(level, simd => approached(simd, packet, before));
}

#[inline(always)]
fn approached<S: Simd>(simd: S, packet: &mut RayPacket, before: &mut [Lanes; 2]) {
    for register in 0..REGISTERS {
        let (near, [far, left]) = all_moved_nearer(&packet.load(simd, register));
        packet.o.store(register, near.o);
        before[0].store(register, far);
        before[1].store(register, left);
    }
}

//! Rays from the eye in packets: blocks of eight by eight dots.

use std::ops::Range;

use fearless_simd::{Level, Simd, SimdBase, f64x8};

use crate::math::{DVec3, LaneVector, Number, REGISTERS, RayPacket, Size, dispatch};

use super::direction::all_settled;
use super::pinhole::PinholeCamera;
use super::tile::Tile;

/// Dots along each side of a block: together as many as a packet has rays.
pub const BLOCK: u32 = 8;

/// A block of dots, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Its leftmost column and top row.
    pub corner: [u32; 2],
    /// Its columns and rows that are in the picture, up to [`BLOCK`].
    pub size: Size,
}

impl Block {
    /// Which rays of its packet are there.
    pub fn live(&self) -> u64 {
        let row = (1_u64 << self.size.width) - 1;
        (0..self.size.height).fold(0, |live, j| live | row << (j * BLOCK))
    }

    /// Calls `each` with every row of the block and the places of its dots in the scan order of a tile, in
    /// which its corner is counted.
    #[inline]
    pub fn rows(&self, tile: &Tile, mut each: impl FnMut(usize, Range<usize>)) {
        let [left, top] = self.corner;
        for row in 0..self.size.height {
            let first = ((top + row) * tile.size.width + left) as usize;
            each(row as usize, first..first + self.size.width as usize);
        }
    }

    /// Sets a packet's rays to those through a point of each dot, `off` from its middle in dots. `eye` is
    /// where they start, and `longest_path` how far they go at most, in the assembly's coordinates
    /// ([`super::settled`]).
    pub fn rays(
        &self,
        pinhole: &PinholeCamera,
        off: [f64; 2],
        eye: DVec3,
        longest_path: f64,
        level: Level,
        packet: &mut RayPacket,
    ) {
        packet.live = self.live();
        dispatch!(level, simd => self.fill(simd, pinhole, off, eye, longest_path, packet));
    }

    #[inline(always)]
    fn fill<S: Simd>(
        &self,
        simd: S,
        pinhole: &PinholeCamera,
        off: [f64; 2],
        eye: DVec3,
        longest_path: f64,
        packet: &mut RayPacket,
    ) {
        let columns = f64x8::load_array(simd, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        let x = columns + f64::from(self.corner[0]) + 0.5 + off[0];
        let across = pinhole.across(x);
        let start = across.same(eye);
        for row in 0..REGISTERS {
            let y = f64::from(self.corner[1] + row as u32) + 0.5 + off[1];
            let d = all_settled(pinhole.upward(across, x.same(pinhole.height(y))), longest_path);
            packet.o.store(row, start);
            packet.d.store(row, d);
        }
        packet.close(simd);
    }
}

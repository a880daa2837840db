//! The rays of a packet sixteen at a time, in single precision: a row.

use fearless_simd::{Simd, SimdBase, f32x16};

use super::DVec3;
use super::number::PACKET;

/// Rays in a row.
pub const ROW: usize = 16;

/// Rows in a packet.
pub const ROWS: usize = PACKET / ROW;

/// A vector for all rays of a row, rounded to single precision.
#[inline(always)]
pub fn splats<S: Simd>(simd: S, v: DVec3) -> [f32x16<S>; 3] {
    [f32x16::splat(simd, v.x as f32), f32x16::splat(simd, v.y as f32), f32x16::splat(simd, v.z as f32)]
}

/// A number of each ray of row `row`, below [`ROWS`].
#[inline(always)]
pub fn row_of<S: Simd>(simd: S, numbers: &[f32; PACKET], row: usize) -> f32x16<S> {
    f32x16::from_slice(simd, &numbers[row * ROW..][..ROW])
}

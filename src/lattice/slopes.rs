//! How the rays of a packet lie to an axis: their slopes along two directions across it, between which they
//! all go.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::math::{DVec3, LaneVector, Number, REGISTERS, RayPacket};

/// The least cosine between a ray and the frustum's axis: past 78° off the slopes, and with them the planes,
/// say little.
pub(super) const COHERENT: f64 = 0.2;

/// How a packet of rays spreads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// From one point, or in no order: planes through the outermost rays.
    Diverging,
    /// Towards one point at the end of each.
    Converging,
}

/// The axis of frustums that run together, and two directions across it.
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    pub(super) axis: DVec3,
    across: [DVec3; 2],
}

/// How rays lie to a basis: the least and the greatest slope along each direction across, and the least
/// cosine with the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    low: [f64; 2],
    high: [f64; 2],
    pub least: f64,
}

impl Basis {
    /// The one whose directions across run along the sides of a frustum with these corners, the first two of
    /// which are neighbours.
    pub fn of_corners(corners: [DVec3; 4]) -> Self {
        let axis = (corners[0] + corners[1] + corners[2] + corners[3]).normalize_or(DVec3::X);
        let u = (corners[1] - corners[0]).cross(axis).normalize_or(axis.any_orthonormal_vector());
        let u = u.cross(axis).normalize_or(u);
        Self { axis, across: [u, axis.cross(u)] }
    }

    /// One along the rays of some packets.
    pub(super) fn along<'b>(packets: impl Iterator<Item = &'b RayPacket>) -> Self {
        let mut sum = DVec3::ZERO;
        for packet in packets {
            // Corners and middle: enough for a direction in between.
            for lane in [0, 7, 27, 36, 56, 63] {
                sum += packet.d.get(lane);
            }
        }
        let axis = sum.normalize_or(DVec3::X);
        let u = axis.any_orthonormal_vector();
        Self { axis, across: [u, axis.cross(u)] }
    }
}

impl Slopes {
    pub const NONE: Self =
        Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2], least: f64::INFINITY };

    /// Those of a closed packet.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, packet: &RayPacket, basis: &Basis) -> Self {
        let infinite = f64x8::splat(simd, f64::INFINITY);
        let (mut low, mut high, mut least) = ([infinite; 2], [-infinite; 2], infinite);
        for register in 0..REGISTERS {
            let d = packet.d.load(simd, register);
            let w = d.dot_one(basis.axis);
            least = w.smaller(least);
            let inverse = w.same(1.0) / w;
            for slot in 0..2 {
                let slope = d.dot_one(basis.across[slot]) * inverse;
                low[slot] = slope.smaller(low[slot]);
                high[slot] = slope.larger(high[slot]);
            }
        }
        Self {
            low: [lowest(low[0]), lowest(low[1])],
            high: [highest(high[0]), highest(high[1])],
            least: lowest(least),
        }
    }

    /// Those of directions between four, if they all go forward.
    pub fn between(corners: &[DVec3; 4], basis: &Basis) -> Self {
        let mut slopes = Self::NONE;
        for d in corners {
            let w = d.dot(basis.axis);
            slopes.least = slopes.least.min(w);
            for slot in 0..2 {
                let slope = d.dot(basis.across[slot]) / w;
                slopes.low[slot] = slopes.low[slot].min(slope);
                slopes.high[slot] = slopes.high[slot].max(slope);
            }
        }
        slopes
    }

    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        for slot in 0..2 {
            self.low[slot] = self.low[slot].min(other.low[slot]);
            self.high[slot] = self.high[slot].max(other.high[slot]);
        }
        self.least = self.least.min(other.least);
    }

    /// The normals of the planes around all, inward; none where the slopes say too little.
    #[inline(always)]
    pub fn normals(&self, basis: &Basis, spread: Spread) -> Option<[DVec3; 4]> {
        if self.least <= COHERENT {
            return None;
        }
        let Basis { axis, across: [u, v] } = *basis;
        // Towards one point, and seen from there, what comes from one side lies on the other.
        let (below, above) =
            if spread == Spread::Diverging { (self.low, self.high) } else { (self.high, self.low) };
        Some([u - below[0] * axis, above[0] * axis - u, v - below[1] * axis, above[1] * axis - v])
    }
}

/// The least of eight, none of which is not-a-number.
#[inline(always)]
pub(super) fn lowest<S: Simd>(x: f64x8<S>) -> f64 {
    x.reduce_min()
}

/// The greatest of eight, none of which is not-a-number.
#[inline(always)]
pub(super) fn highest<S: Simd>(x: f64x8<S>) -> f64 {
    x.reduce_max()
}

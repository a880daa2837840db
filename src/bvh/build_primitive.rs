//! Boxes in the form in which very many are joined and parted: one operation on all their sides.

use fearless_simd::{Select, Simd, SimdBase, f32x4, f32x8};

use crate::math::{Bounds, DVec3};

use super::rounding::{MARGIN, lower, upper};

/// Where the longest edge stands.
const LONGEST: usize = 3;

/// The first of the upper sides.
const UPPER: usize = 4;

/// Where an object's number stands.
const OBJECT: usize = 7;

/// Marks the number of an object whose box tells what ball it is.
const ROUND: u32 = 1 << 31;

/// A box as a node holds it, in single precision, and as how far it reaches: along −x, −y and −z, its longest
/// edge, and along x, y and z. Two are joined by the larger of each, the longest edge too: that of a joined
/// one is the longest of any box in it.
///
/// The last number is an object's, by its bits, where the box is one's own; else it says nothing.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub struct BuildPrimitive([f32; 8]);

impl BuildPrimitive {
    /// No box at all.
    pub const NOTHING: Self = Self([f32::NEG_INFINITY; 8]);

    /// The box of an object, moved outward by [`MARGIN`].
    pub fn new(b: &Bounds, object: u32) -> Self {
        let [x, y, z] = (b.lo - MARGIN).to_array().map(|side| -lower(side));
        let [to_x, to_y, to_z] = (b.hi + MARGIN).to_array().map(upper);
        let longer = |a: f32, b: f32| if a > b { a } else { b };
        let longest = longer(longer(to_x + x, to_y + y), to_z + z);
        Self([x, y, z, longest, to_x, to_y, to_z, f32::from_bits(object)])
    }

    /// The object whose box it is.
    #[inline]
    pub fn object(&self) -> u32 {
        self.0[OBJECT].to_bits() & !ROUND
    }

    /// The box of a ball that it tells.
    #[must_use]
    pub fn round(mut self) -> Self {
        self.0[OBJECT] = f32::from_bits(self.object() | ROUND);
        self
    }

    /// Whether the box of an object tells what ball it is.
    #[inline]
    pub fn is_round(&self) -> bool {
        self.0[OBJECT].to_bits() & ROUND != 0
    }

    /// The lower and the upper corner.
    pub fn corners(&self) -> ([f32; 3], [f32; 3]) {
        let [from, to] = [0, 1].map(|end| [0, 1, 2].map(|axis| self.sides(axis)[end]));
        (from, to)
    }

    /// From where to where it reaches along an axis.
    #[inline]
    pub fn sides(&self, axis: usize) -> [f32; 2] {
        [-self.0[axis], self.0[axis + UPPER]]
    }

    /// The longest edge of any box in it.
    #[inline(always)]
    pub fn longest(&self) -> f32 {
        self.0[LONGEST]
    }

    /// Its numbers.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::from_slice(simd, &self.0)
    }

    /// A box of such numbers.
    #[inline(always)]
    pub fn store<S: Simd>(sides: f32x8<S>) -> Self {
        let mut own = Self::NOTHING;
        sides.store_slice(&mut own.0);
        own
    }

    /// Grows it to hold another.
    #[inline(always)]
    pub fn join<S: Simd>(&mut self, simd: S, other: &Self) {
        larger(self.load(simd), other.load(simd)).store_slice(&mut self.0);
    }

    /// How long it is along an axis.
    #[inline(always)]
    pub fn edge(&self, axis: usize) -> f64 {
        f64::from(self.0[axis]) + f64::from(self.0[axis + UPPER])
    }

    /// The edges of the whole.
    #[inline(always)]
    pub fn edges(&self) -> DVec3 {
        DVec3::new(self.edge(0), self.edge(1), self.edge(2))
    }

    /// Twice the centre.
    #[inline(always)]
    pub fn center(&self, axis: usize) -> f32 {
        self.0[axis + UPPER] - self.0[axis]
    }

    /// Twice the centre on all axes, and a number that says nothing.
    #[inline(always)]
    pub fn centers<S: Simd>(&self, simd: S) -> f32x4<S> {
        let (lower, upper) = self.0.split_at(UPPER);
        f32x4::from_slice(simd, upper) - f32x4::from_slice(simd, lower)
    }

    /// Half the surface, where it is not empty.
    #[inline(always)]
    pub fn area(&self) -> f64 {
        let [x, y, z] = [self.edge(0), self.edge(1), self.edge(2)];
        x * y + y * z + z * x
    }
}

/// The larger of each two; the own one where the other is no number.
#[inline(always)]
fn larger<S: Simd>(own: f32x8<S>, other: f32x8<S>) -> f32x8<S> {
    other.simd_gt(own).select(other, own)
}

/// What is known of a range of boxes.
#[derive(Clone, Copy)]
pub struct About {
    pub reach: BuildPrimitive,
    /// The least of twice their centres, by axis; the last number says nothing.
    low: [f32; 4],
    /// The largest.
    high: [f32; 4],
}

impl About {
    pub const NOTHING: Self =
        Self { reach: BuildPrimitive::NOTHING, low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] };

    /// What is known of all these.
    #[inline(always)]
    pub fn all<S: Simd>(simd: S, items: &[BuildPrimitive]) -> Self {
        let mut reach = BuildPrimitive::NOTHING.load(simd);
        let mut low = f32x4::splat(simd, f32::INFINITY);
        let mut high = f32x4::splat(simd, f32::NEG_INFINITY);
        for item in items {
            reach = larger(reach, item.load(simd));
            let centers = item.centers(simd);
            low = centers.simd_lt(low).select(centers, low);
            high = centers.simd_gt(high).select(centers, high);
        }
        let mut about = Self { reach: BuildPrimitive::store(reach), ..Self::NOTHING };
        low.store_slice(&mut about.low);
        high.store_slice(&mut about.high);
        about
    }

    /// What is known of two ranges together.
    pub fn with<S: Simd>(mut self, simd: S, other: &Self) -> Self {
        self.reach.join(simd, &other.reach);
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }

    /// From where to where twice the centres reach along an axis.
    #[inline(always)]
    pub fn centers(&self, axis: usize) -> (f32, f32) {
        (self.low[axis], self.high[axis])
    }

    /// The axis along which the centres reach farthest.
    #[inline(always)]
    pub fn widest(&self) -> usize {
        let reach = |axis: usize| f64::from(self.high[axis] - self.low[axis]);
        DVec3::new(reach(0), reach(1), reach(2)).max_position()
    }
}

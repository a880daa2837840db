//! The nearest hits of a bundle, as far as they are known.

use fearless_simd::{Select, Simd, SimdBase, f64x8, mask64x8};

use crate::math::{Bundle, Column, LANES, Mask, Number, ROWS, row_of};
use crate::solid::Crossing;

use super::super::Hit;

/// What each ray of a bundle met first.
#[derive(Clone, Debug)]
pub struct Nearest {
    /// Where; infinite where nothing was met.
    pub t: Column,
    /// How far that may be off.
    pub error: Column,
    /// Where it met what comes next, another object's surface.
    pub second: Column,
    /// The object, by its index in the assembly.
    pub object: Column,
    /// The primitive, by its index in the assembly.
    pub primitive: Column,
    /// The face of the primitive.
    pub surface: Column,
    /// Which rays go into the object there, a bit for each.
    pub entering: u64,
    /// Which rays are to be asked one by one.
    pub unsure: u64,
    /// Which rays have no company, and are to be asked in a stream.
    pub apart: u64,
}

impl Default for Nearest {
    fn default() -> Self {
        Self::NOTHING
    }
}

impl Nearest {
    /// Nothing was met yet.
    pub const NOTHING: Self = Self {
        t: Column::filled(f64::INFINITY),
        error: Column::filled(0.0),
        second: Column::filled(f64::INFINITY),
        object: Column::filled(0.0),
        primitive: Column::filled(0.0),
        surface: Column::filled(0.0),
        entering: 0,
        unsure: 0,
        apart: 0,
    };

    /// Forgets all.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.t = Column::filled(f64::INFINITY);
        self.second = Column::filled(f64::INFINITY);
        self.forget_rays();
    }

    /// Forgets which rays met anything in which way; where is left over.
    pub(super) fn forget_rays(&mut self) {
        (self.entering, self.unsure, self.apart) = (0, 0, 0);
    }

    /// Forgets what one ray met.
    #[inline]
    pub(super) fn forget(&mut self, lane: usize) {
        (self.t.0[lane], self.second.0[lane]) = (f64::INFINITY, f64::INFINITY);
        self.unsure &= !(1 << lane);
    }

    /// A crossing of one ray with an object.
    #[inline]
    pub(super) fn offer_one(&mut self, lane: usize, object: u32, crossing: &Crossing) {
        let best = self.t.0[lane];
        self.second.0[lane] = self.second.0[lane].min(best.max(crossing.t));
        if crossing.t < best {
            self.t.0[lane] = crossing.t;
            self.error.0[lane] = crossing.error;
            self.object.0[lane] = f64::from(object);
            self.primitive.0[lane] = f64::from(crossing.primitive);
            self.surface.0[lane] = f64::from(crossing.surface);
            self.entering = self.entering & !(1 << lane) | u64::from(crossing.entering) << lane;
        }
    }

    /// Sets what one ray met.
    pub fn set(&mut self, lane: usize, hit: Option<&Hit>) {
        let Some(hit) = hit else {
            self.t.0[lane] = f64::INFINITY;
            return;
        };
        self.t.0[lane] = hit.t;
        self.error.0[lane] = hit.error;
        self.object.0[lane] = f64::from(hit.object);
        self.primitive.0[lane] = f64::from(hit.primitive);
        self.surface.0[lane] = f64::from(hit.surface);
        self.entering = self.entering & !(1 << lane) | u64::from(hit.entering) << lane;
    }

    /// Crossings of some rays of a row with an object.
    #[inline(always)]
    pub fn offer<S: Simd>(&mut self, simd: S, row: usize, met: &Offer<S>) {
        let (best, second) = (self.t.load(simd, row), self.second.load(simd, row));
        let t = met.any.select(met.t, f64x8::splat(simd, f64::INFINITY));
        self.second.store(row, t.larger(best).smaller(second));
        let nearer = t.is_below(best);
        if !nearer.any() {
            return;
        }
        self.t.put(simd, row, nearer, t);
        self.error.put(simd, row, nearer, met.error);
        self.object.put(simd, row, nearer, f64x8::splat(simd, f64::from(met.object)));
        self.primitive.put(simd, row, nearer, met.primitive);
        self.surface.put(simd, row, nearer, met.surface);
        let shift = row * LANES;
        let (nearer, entering) = (u64::from(nearer.bits()) << shift, u64::from(met.entering.bits()) << shift);
        self.entering = self.entering & !nearer | entering & nearer;
    }

    /// Is unsure of all rays that met two objects within `slack`.
    #[inline(always)]
    pub fn doubt<S: Simd>(&mut self, simd: S, slack: f64) {
        for row in 0..ROWS {
            let t = self.t.load(simd, row);
            let close = self.second.load(simd, row).is_at_most(t + slack)
                & t.is_below(f64x8::splat(simd, f64::INFINITY));
            self.unsure |= u64::from(close.bits()) << (row * LANES);
        }
    }

    /// The greatest distance at which any of the rays may still meet something.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S, bundle: &Bundle) -> f64 {
        // Nobody knows what those met that are not there: what they leave is not set.
        let nowhere = f64x8::splat(simd, f64::NEG_INFINITY);
        let mut most = nowhere;
        for row in 0..ROWS {
            if bundle.live_in(row) != 0 {
                let t = row_of(simd, bundle.live, row).select(self.t.load(simd, row), nowhere);
                most = t.larger(most);
            }
        }
        most.reduce_max()
    }
}

/// Crossings of a row with one object.
#[derive(Clone, Copy, Debug)]
pub struct Offer<S: Simd> {
    /// Which rays have one.
    pub any: mask64x8<S>,
    /// Where.
    pub t: f64x8<S>,
    /// How far that may be off.
    pub error: f64x8<S>,
    /// Whether the ray goes into the object there.
    pub entering: mask64x8<S>,
    /// The object.
    pub object: u32,
    /// The primitive.
    pub primitive: f64x8<S>,
    /// The face.
    pub surface: f64x8<S>,
}

//! Rays.

use super::DVec3;

/// A half-line: the points `o + t·d`, `t ≥ 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub o: DVec3,
    /// Where it goes; its length is 1 within rounding, so that `t` is a distance.
    pub d: DVec3,
}

impl Ray {
    /// A ray from `o` along `d`, which must have length 1 within rounding.
    #[inline]
    pub const fn new(o: DVec3, d: DVec3) -> Self {
        Self { o, d }
    }

    /// The point at distance `t`.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.o + t * self.d
    }
}

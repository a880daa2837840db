//! Open tubes: the sides of cylinders, cones and frustums, seen from both sides.

use crate::math::{Bounds, DVec3, Number, Placement, Rays};

use super::round::{Round, SIDE, SideCrossings};

/// The side of a unit frustum under an affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube(Round);

impl Tube {
    /// The tube at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn new(place: Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        Self(Round::frustum(place, bottom, top, map_error))
    }

    /// Where the line of each ray goes in through the tube's wall, and where it comes out.
    #[inline(always)]
    pub fn crossings<N: Number>(&self, rays: &Rays<N>) -> SideCrossings<N> {
        self.0.side_crossings(rays)
    }

    /// The normal at a point of the tube, away from its axis, of length 1.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        self.0.normal(p, SIDE)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.0.bounds()
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn off(&self) -> f64 {
        self.0.off()
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        self.0.support(v)
    }

    /// Whether the box is certainly off the tube: outside, or within it.
    pub fn misses(&self, b: &Bounds) -> bool {
        self.0.misses(b) || self.0.covers(b)
    }
}

//! Lights, and how surfaces lie to them: one formula for one surface and for eight.

use crate::math::{DVec3, Mask, Number, Vector};
use crate::view::all_settled;

use super::direction::WITHIN;

/// A light nearer than this, in the assembly's unit, is at the point itself: 2⁻⁵⁰⁰, whose square does not
/// underflow. A hit's own place is not known so well by far.
const NEAREST: f64 = f64::from_bits((1023 - 500) << 52);

/// A light in the assembly's coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lamp<C> {
    pub at: DVec3,
    pub light: C,
}

/// Direction and distance from a surface to a lamp, or from as many as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Towards<N> {
    /// The direction, of length 1.
    pub d: Vector<N>,
    pub distance: N,
    /// `L·N`.
    pub facing: N,
}

impl<N: Number> Towards<N> {
    /// From the surface at `p` to a lamp at `lamp`; both in the assembly's coordinates.
    #[inline(always)]
    pub fn new(lamp: DVec3, p: Vector<N>, normal: Vector<N>) -> Self {
        let to_lamp = p.same(lamp) - p;
        let distance = to_lamp.length();
        let d = all_settled(to_lamp / distance, WITHIN);
        Self { d, distance, facing: d.dot(normal) }
    }

    /// Whether the lamp shines on the surface's side. At the very point it has no direction and lights
    /// nothing.
    #[inline(always)]
    pub fn shines(&self) -> N::Mask {
        let zero = self.facing.same(0.0);
        self.facing.is_above(zero) & !self.distance.is_below(zero.same(NEAREST))
    }

    /// The cosine of the angle between the mirrored light and the direction to the eye, at most 1.
    /// `seen_along` is the direction of the ray that met the surface.
    #[inline(always)]
    pub fn mirrored_cosine(&self, normal: Vector<N>, seen_along: Vector<N>) -> N {
        let mirrored = normal * (self.facing * 2.0) - self.d;
        let cosine = -mirrored.dot(seen_along);
        // Rounding may put it above 1, and n may be large enough to make anything of that.
        let one = cosine.same(1.0);
        cosine.is_above(one).choose(one, cosine)
    }
}

//! Open tubes: the sides of cylinders, cones and frustums, seen from both sides.

use crate::math::{Bounds, DAffine3, DMat3, DVec3, Mask, Number, Placement, Rays, Vector};

use super::span::{Ends, ROUNDING, Spans};
use super::taper::Taper;
use super::unit_space::{UnitSpace, is_finite};

/// The side of a unit frustum under an affine map. Scenes of a million are made of them: the map out of the unit space,
/// which no ray asks for, is not kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    space: UnitSpace,
    taper: Taper,
    /// Along its axis, of length 1; 0 where that is not known.
    along: DVec3,
    /// How far its points are from its axis at most.
    radius: f64,
}

/// The points near a line: a round bar without ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// A point of the line.
    pub middle: DVec3,
    /// Along the line, of length 1; 0 where it is not known.
    pub along: DVec3,
    /// How far its points are from the line at most.
    pub radius: f64,
}

/// Where a line crosses the side of a frustum between its caps.
#[derive(Clone, Copy, Debug)]
pub struct SideCrossings<N: Number> {
    /// Into it.
    pub enter: Ends<N>,
    /// Whether there is such a place.
    pub enters: N::Mask,
    /// Out of it.
    pub leave: Ends<N>,
    /// Whether there is such a place.
    pub leaves: N::Mask,
    /// Whether the line crosses the whole cone, beyond the caps too, only once.
    pub one_way: N::Mask,
}

impl<N: Number> SideCrossings<N> {
    #[inline(always)]
    fn none(like: N) -> Self {
        let Spans { enter, leave, any } = Spans::none(like);
        Self { enter, enters: any, leave, leaves: any, one_way: any }
    }
}

/// A part in a million wider than it is: far more than roundings of the numbers that are compared.
const BEYOND: f64 = 1.0 + 1e-6;

/// Products that are smaller may have lost digits.
const FULL_DIGITS: f64 = 1e-290;

impl Tube {
    /// The tube at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn new(place: &Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        let space = UnitSpace::new(place, map_error);
        let DMat3 { x_axis, y_axis, z_axis } = place.linear;
        // The widest radius of the ellipse that the map makes of a circle: the root of the greater eigenvalue of its
        // Gram matrix.
        let (xx, yy, xy) = (x_axis.length_squared(), y_axis.length_squared(), x_axis.dot(y_axis));
        let widest = (0.5 * (xx + yy) + 0.5 * libm::hypot(xx - yy, 2.0 * xy)).sqrt();
        let radius = (bottom.max(top) * widest + space.displacement) * (1.0 + ROUNDING);
        Self { space, taper: Taper::new(bottom, top), along: z_axis.normalize_or_zero(), radius }
    }

    /// Where the line of each ray goes in through the tube's wall, and where it comes out. A line with only one crossing,
    /// which is steeper than the wall or parallel to it, has only one of them.
    #[inline(always)]
    pub fn crossings<N: Number>(&self, rays: &Rays<N>) -> SideCrossings<N> {
        let rays = self.space.brought(rays);
        if !self.near(&rays).any() {
            return SideCrossings::none(rays.o.x);
        }
        let rays = self.space.recentred(&rays);
        let near = !rays.pass_by();
        if !near.any() {
            return SideCrossings::none(rays.t);
        }
        let side = self.taper.sides(&rays);
        let met = side.any & near;
        SideCrossings {
            enter: Ends { t: rays.t + side.enter.t, ..side.enter },
            enters: met & rays.between_caps(side.enter.t),
            leave: Ends { t: rays.t + side.leave.t, ..side.leave },
            leaves: met & rays.between_caps(side.leave.t),
            one_way: met & !(is_finite(side.enter.t) & is_finite(side.leave.t)),
        }
    }

    /// Which lines, brought to the unit space, come so near the axis that they may meet the tube: known without a division.
    ///
    /// Every crossing that is found lies between the caps, where the tube is no wider than its widest, and satisfies the
    /// tube's equation as near as [`UnitSpace::off`] says: the line comes so near the axis, but for the rounding of that
    /// distance, which is within the same.
    #[inline(always)]
    fn near<N: Number>(&self, rays: &Rays<N>) -> N::Mask {
        let Rays { o, d } = *rays;
        let across = d.x * o.y - d.y * o.x;
        let reach = self.taper.widest() * BEYOND + 4.0 * self.space.off.element_sum();
        let most = (d.x * d.x + d.y * d.y) * (reach * reach) + FULL_DIGITS;
        !(across * across).is_above(most)
    }

    /// The normals at points of the tube, away from its axis, of length 1.
    #[inline(always)]
    pub fn normals<N: Number>(&self, p: Vector<N>) -> Vector<N> {
        self.space.normals(self.taper.gradient(self.space.points(p)))
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.linear().map_or(EVERYWHERE, |linear| self.taper.bounds(&linear, self.space.center))
    }

    /// A bar around it, and around all places where it may seem to be.
    pub fn bar(&self) -> Bar {
        Bar { middle: self.space.center, along: self.along, radius: self.radius }
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn off(&self) -> f64 {
        self.space.displacement
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        match self.linear() {
            Some(linear) => self.space.center.dot(v) + self.taper.support(linear.transpose() * v),
            None => EVERYWHERE.hi.dot(v.abs()),
        }
    }

    /// Whether the box is certainly off the tube: outside, or within it.
    pub fn misses(&self, b: &Bounds) -> bool {
        let u = self.space.bounds(b);
        self.taper.misses(&u) || self.taper.covers(&u)
    }

    /// From unit directions to world directions: the inverse of the map that rays go by, off by as much as that may be
    /// of the one before it. `None` for a map that rounding made flat, so thin is it.
    fn linear(&self) -> Option<DMat3> {
        let back = DAffine3 { matrix3: self.space.inverse, translation: DVec3::ZERO };
        Placement::new(&back).map(|place| place.inverse)
    }
}

/// The world limit: a tube is seen, and all that is seen lies within.
const EVERYWHERE: Bounds = Bounds::new(DVec3::splat(-2.0), DVec3::splat(2.0));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_knows_how_far_it_reaches() {
        // A cylinder of radius 0.3 along (2, 3, 6) / 7, half as long as that, around (1, −1, 0).
        let axis = DVec3::new(2.0, 3.0, 6.0) / 7.0;
        let (x, y) = axis.any_orthonormal_pair();
        let center = DVec3::new(1.0, -1.0, 0.0);
        let map = DAffine3 { matrix3: DMat3::from_cols(0.3 * x, 0.3 * y, 0.5 * axis), translation: center };
        let tube = Tube::new(&Placement::new(&map).unwrap(), 1.0, 1.0, DVec3::ZERO);
        let half = axis.map(|along| 0.5 * along + 0.3 * (1.0 - along * along).sqrt());
        let off = 8.0 * f64::EPSILON;
        assert!((tube.bounds().lo - (center - half)).abs().max_element() <= off);
        assert!((tube.bounds().hi - (center + half)).abs().max_element() <= off);
        for v in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert!((tube.support(v) - (center + half).dot(v)).abs() <= off);
        }
    }
}

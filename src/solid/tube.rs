//! Open tubes: the sides of cylinders, cones and truncated cones, seen from both sides.

use crate::math::{Bounds, DAffine3, DMat3, DVec3, Mask, Number, Placement, Rays, Vector};

use super::span::{Ends, ROUNDING, Spans};
use super::taper::{Taper, Tapers};
use super::unit_space::{UnitSpace, at_closest, is_finite, pass_by};

/// The side of a unit truncated cone under an affine map. Scenes of a million are made of them: the map out
/// of the unit space, which no ray asks for, is not kept.
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

/// Where a line crosses the side of a truncated cone between its caps.
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
        let Spans { enter, leave, any, .. } = Spans::none(like);
        Self { enter, enters: any, leave, leaves: any, one_way: any }
    }
}

/// A part in a million wider than it is: far more than roundings of the numbers that are compared.
const BEYOND: f64 = 1.0 + 1e-6;

/// Products that are smaller may have lost digits.
const FULL_DIGITS: f64 = 1e-290;

/// A tube for each of as many rays as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tubes<N> {
    center: Vector<N>,
    /// The rows of the map to the unit space.
    rows: [Vector<N>; 3],
    unit_error: Vector<N>,
    error_sum: N,
    rounding_share: N,
    taper: Tapers<N>,
}

/// Numbers that say what a tube is.
pub(super) const NUMBERS_OF_TUBE: usize = 18;

impl<N: Number> Tubes<N> {
    /// Tubes of numbers that [`Tube::numbers`] gives.
    #[inline(always)]
    pub fn new(numbers: [N; NUMBERS_OF_TUBE]) -> Self {
        let [
            x,
            y,
            z,
            ax,
            ay,
            az,
            bx,
            by,
            bz,
            cx,
            cy,
            cz,
            error_x,
            error_y,
            error_z,
            rounding_share,
            middle,
            slope,
        ] = numbers;
        let rows =
            [Vector { x: ax, y: ay, z: az }, Vector { x: bx, y: by, z: bz }, Vector { x: cx, y: cy, z: cz }];
        Self {
            center: Vector { x, y, z },
            rows,
            unit_error: Vector { x: error_x, y: error_y, z: error_z },
            error_sum: error_x + error_y + error_z,
            rounding_share,
            taper: Tapers { middle, slope },
        }
    }

    /// Where the line of each ray goes in through its tube's wall, and where it comes out.
    #[inline(always)]
    pub fn crossings(&self, rays: &Rays<N>) -> SideCrossings<N> {
        let from_center = rays.o - self.center;
        let [first, second, third] = self.rows;
        let o = Vector { x: from_center.dot(first), y: from_center.dot(second), z: from_center.dot(third) };
        let d = Vector { x: rays.d.dot(first), y: rays.d.dot(second), z: rays.d.dot(third) };
        let rays = Rays { o, d };
        if !self.near(&rays).any() {
            return SideCrossings::none(rays.o.x);
        }
        let (rays, _, t) = at_closest(&rays);
        let near = !pass_by(rays.o, self.error_sum);
        if !near.any() {
            return SideCrossings::none(t);
        }
        let side = self.taper.sides(&rays, self.unit_error, self.rounding_share);
        let met = side.any & near;
        SideCrossings {
            enter: Ends { t: t + side.enter.t, ..side.enter },
            enters: met & between_caps(&rays, side.enter.t),
            leave: Ends { t: t + side.leave.t, ..side.leave },
            leaves: met & between_caps(&rays, side.leave.t),
            one_way: met & !(is_finite(side.enter.t) & is_finite(side.leave.t)),
        }
    }

    /// Which lines, brought to the unit space, come so near the axis that they may meet the tube: known
    /// without a division.
    ///
    /// Every crossing that is found lies between the caps, where the tube is no wider than its widest, and
    /// satisfies the tube's equation as near as [`UnitSpace::unit_error`] says: the line comes so near the
    /// axis, but for the rounding of that distance, which is within the same.
    #[inline(always)]
    fn near(&self, rays: &Rays<N>) -> N::Mask {
        let Rays { o, d } = *rays;
        let across = d.x * o.y - d.y * o.x;
        let Tapers { middle, slope } = self.taper;
        let reach = (middle + slope.magnitude()) * BEYOND + self.error_sum * 4.0;
        let most = (d.x * d.x + d.y * d.y) * (reach * reach) + FULL_DIGITS;
        !(across * across).is_above(most)
    }
}

/// Whether the places at `t` are between the caps.
#[inline(always)]
fn between_caps<N: Number>(rays: &Rays<N>, t: N) -> N::Mask {
    let z = rays.o.z + t * rays.d.z;
    is_finite(t) & z.magnitude().is_at_most(z.same(1.0))
}

impl Tube {
    /// The tube at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn new(place: &Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        let space = UnitSpace::new(place, map_error);
        let DMat3 { x_axis, y_axis, z_axis } = place.linear;
        // The widest radius of the ellipse that the map makes of a circle: the root of the greater eigenvalue
        // of its Gram matrix.
        let (xx, yy, xy) = (x_axis.length_squared(), y_axis.length_squared(), x_axis.dot(y_axis));
        let widest = (0.5 * (xx + yy) + 0.5 * libm::hypot(xx - yy, 2.0 * xy)).sqrt();
        let radius = (bottom.max(top) * widest + space.place_error) * (1.0 + ROUNDING);
        Self { space, taper: Taper::new(bottom, top), along: z_axis.normalize_or_zero(), radius }
    }

    /// Where the line of each ray goes in through the tube's wall, and where it comes out. A line with only
    /// one crossing, which is steeper than the wall or parallel to it, has only one of them.
    #[inline(always)]
    pub fn crossings<N: Number>(&self, rays: &Rays<N>) -> SideCrossings<N> {
        let like = rays.o;
        let UnitSpace { center, inverse, unit_error, rounding_share, .. } = &self.space;
        let [middle, slope] = self.taper.numbers();
        let tubes = Tubes {
            center: like.same(*center),
            rows: [like.same(inverse.row(0)), like.same(inverse.row(1)), like.same(inverse.row(2))],
            unit_error: like.same(*unit_error),
            error_sum: like.x.same(unit_error.element_sum()),
            rounding_share: like.x.same(*rounding_share),
            taper: Tapers { middle: like.x.same(middle), slope: like.x.same(slope) },
        };
        tubes.crossings(rays)
    }

    /// What [`Tubes::new`] asks for.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f64; NUMBERS_OF_TUBE] {
        let UnitSpace { center, inverse, unit_error, rounding_share, .. } = &self.space;
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = inverse;
        let [middle, slope] = self.taper.numbers();
        [
            center.x,
            center.y,
            center.z,
            x.x,
            y.x,
            z.x,
            x.y,
            y.y,
            z.y,
            x.z,
            y.z,
            z.z,
            unit_error.x,
            unit_error.y,
            unit_error.z,
            *rounding_share,
            middle,
            slope,
        ]
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
    pub fn place_error(&self) -> f64 {
        self.space.place_error
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

    /// From unit directions to world directions: the inverse of the map that rays go by, off by as much as
    /// that may be of the one before it. `None` for a map that rounding made flat, so thin is it.
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
        let tolerance = 8.0 * f64::EPSILON;
        assert!((tube.bounds().lo - (center - half)).abs().max_element() <= tolerance);
        assert!((tube.bounds().hi - (center + half)).abs().max_element() <= tolerance);
        for v in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert!((tube.support(v) - (center + half).dot(v)).abs() <= tolerance);
        }
    }
}

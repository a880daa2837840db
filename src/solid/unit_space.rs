//! The unit space of a curved shape: there the shape is round, and rays come to it.

use crate::math::{Bounds, DMat3, DVec3, Number, Placement, Rays, Vector};

use super::span::rounding_at;

/// The map from the world into the unit space of a shape, and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UnitSpace {
    /// The world place of the unit origin.
    pub center: DVec3,
    /// From world directions to unit directions.
    pub inverse: DMat3,
    /// How far a point of the shape may be off its place, by its map and by our own rounding, along each axis
    /// of the unit space: a coin has a sharp rim however thin it is, and a needle a sharp tip.
    pub unit_error: DVec3,
    /// The same in the world, for all of it.
    pub place_error: f64,
    /// The least share of it that is our own rounding.
    pub rounding_share: f64,
}

/// Rays in the unit space, re-centred: `o` is the point of each that is closest to the unit origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Centred<N> {
    pub o: Vector<N>,
    pub d: Vector<N>,
    pub d_squared: N,
    /// `t` of the closest point.
    pub t: N,
    /// How far `o` may be off along each axis.
    pub unit_error: DVec3,
    /// The share of it that is our own rounding.
    pub rounding_share: f64,
}

impl UnitSpace {
    /// That of a shape at `place`, which may be off by `map_error`.
    pub fn new(place: &Placement, map_error: DVec3) -> Self {
        let Placement { inverse, center, .. } = *place;
        let rows = [inverse.row(0), inverse.row(1), inverse.row(2)];
        let seen = rounding_at(center.length());
        let unit_error = rows.map(|row| seen * row.length() + row.abs().dot(map_error));
        let rounding_share = (0..3).map(|i| seen * rows[i].length() / unit_error[i]).fold(1.0, f64::min);
        let place_error = seen + map_error.length();
        Self { center, inverse, unit_error: DVec3::from_array(unit_error), place_error, rounding_share }
    }

    /// The inverse map makes no vector longer by more than this: the root of the sum of its squares.
    pub fn norm(&self) -> f64 {
        norm(&self.inverse)
    }

    /// Rays there.
    #[inline(always)]
    pub fn centred<N: Number>(&self, rays: &Rays<N>) -> Centred<N> {
        self.recentred(&self.brought(rays))
    }

    /// Rays there, not re-centred yet.
    #[inline(always)]
    pub fn brought<N: Number>(&self, rays: &Rays<N>) -> Rays<N> {
        let from_center = rays.o - self.center;
        Rays { o: from_center.mapped(&self.inverse), d: rays.d.mapped(&self.inverse) }
    }

    /// Rays that were brought there, re-centred.
    #[inline(always)]
    pub fn recentred<N: Number>(&self, rays: &Rays<N>) -> Centred<N> {
        let (Rays { o, d }, d_squared, t) = at_closest(rays);
        Centred {
            o,
            d,
            d_squared,
            t,
            unit_error: self.unit_error * N::EPSILON_RATIO,
            rounding_share: self.rounding_share,
        }
    }

    /// Points of the world there.
    #[inline(always)]
    pub fn points<N: Number>(&self, p: Vector<N>) -> Vector<N> {
        (p - self.center).mapped(&self.inverse)
    }

    /// The normals in the world, of length 1, of a surface that rises along `gradient` there.
    #[inline(always)]
    pub fn normals<N: Number>(&self, gradient: Vector<N>) -> Vector<N> {
        // A normal goes through the transposed inverse; scaled first, so that no square overflows.
        let normal = gradient.mapped(&self.inverse.transpose());
        let Vector { x, y, z } = normal.magnitude();
        (normal / x.larger(y).larger(z)).normalized_or(normal.same(DVec3::Z))
    }

    /// The box there around a box of the world.
    #[inline]
    pub fn bounds(&self, b: &Bounds) -> Bounds {
        let inverse = &self.inverse;
        let center = *inverse * (b.center() - self.center);
        let half = inverse.x_axis.abs() * b.half().x
            + inverse.y_axis.abs() * b.half().y
            + inverse.z_axis.abs() * b.half().z;
        Bounds::new(center - half, center + half)
    }
}

impl<N: Number> Centred<N> {
    /// Whether the line is certainly beside a truncated cone.
    #[inline(always)]
    pub fn pass_by(&self) -> N::Mask {
        pass_by(self.o, self.t.same(self.unit_error.element_sum()))
    }
}

/// Rays from the point of each that is closest to the origin, the square of the length of their directions,
/// and how far that point is from their starts.
#[inline(always)]
pub(super) fn at_closest<N: Number>(rays: &Rays<N>) -> (Rays<N>, N, N) {
    let Rays { o, d } = *rays;
    let d_squared = d.length_squared();
    let inverse = d_squared.same(1.0) / d_squared;
    let first = -o.dot(d) * inverse;
    let o = o + d * first;
    let second = -o.dot(d) * inverse;
    let o = o + d * second;
    (Rays { o, d }, d_squared, first + second)
}

/// Whether lines whose points closest to the unit origin are `o` are certainly beside a truncated cone, which
/// lies within √2 of that origin; `error` is the sum of how far a point may be off along each axis.
#[inline(always)]
pub(super) fn pass_by<N: Number>(o: Vector<N>, error: N) -> N::Mask {
    // (√2 + error)² with 4 for 2√2.
    o.length_squared().is_above(error * (error + 4.0) + 2.0)
}

/// No vector becomes longer by more than this under a linear map.
pub(super) fn norm(map: &DMat3) -> f64 {
    let columns = [map.x_axis, map.y_axis, map.z_axis];
    columns.iter().map(|column| column.length_squared()).sum::<f64>().sqrt()
}

/// Whether there is such a place: those that there are not are infinitely far away.
#[inline(always)]
pub(super) fn is_finite<N: Number>(t: N) -> N::Mask {
    t.magnitude().is_below(t.same(f64::INFINITY))
}

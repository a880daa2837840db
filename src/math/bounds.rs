//! Boxes along the axes.

use super::{DAffine3, DVec3};

/// A box along the axes, closed: `lo ≤ p ≤ hi`. Empty where any `lo > hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub lo: DVec3,
    /// The largest coordinates.
    pub hi: DVec3,
}

impl Bounds {
    /// The box that holds nothing; the neutral element of [`Bounds::join`].
    pub const EMPTY: Self = Self { lo: DVec3::INFINITY, hi: DVec3::NEG_INFINITY };

    /// The box from `lo` to `hi`.
    #[inline]
    pub const fn new(lo: DVec3, hi: DVec3) -> Self {
        Self { lo, hi }
    }

    /// The smallest box around points.
    #[inline]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { lo: b.lo.min(p), hi: b.hi.max(p) })
    }

    /// Whether no point is inside.
    #[inline]
    pub fn is_empty(&self) -> bool {
        !self.lo.cmple(self.hi).all()
    }

    /// The smallest box that holds both.
    #[must_use]
    #[inline]
    pub fn join(&self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The box of the points in both; empty where they do not meet.
    #[must_use]
    #[inline]
    pub fn meet(&self, other: &Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// The same box with every face moved outward by `margin` of its axis.
    #[must_use]
    #[inline]
    pub fn padded(&self, margin: DVec3) -> Self {
        Self { lo: self.lo - margin, hi: self.hi + margin }
    }

    /// Whether the point is inside or on a face.
    #[inline]
    pub fn contains(&self, p: DVec3) -> bool {
        self.lo.cmple(p).all() && p.cmple(self.hi).all()
    }

    /// The point in the middle; halves are taken first, so that no sum overflows.
    #[inline]
    pub fn center(&self) -> DVec3 {
        self.lo * 0.5 + self.hi * 0.5
    }

    /// Half the edge lengths.
    #[inline]
    pub fn half(&self) -> DVec3 {
        self.hi * 0.5 - self.lo * 0.5
    }

    /// How far its points lie from the origin along each axis at most.
    #[inline]
    pub fn farthest(&self) -> DVec3 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The eight corners.
    #[inline]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.lo.x } else { self.hi.x },
                if i & 2 == 0 { self.lo.y } else { self.hi.y },
                if i & 4 == 0 { self.lo.z } else { self.hi.z },
            )
        })
    }

    /// The box around this box moved by `map`.
    ///
    /// Of a sum of rounded terms the least is that of the least terms, since rounding keeps the order of
    /// numbers: these are the same bits as those of the box around the eight moved corners.
    #[must_use]
    #[inline]
    pub fn mapped(&self, map: &DAffine3) -> Self {
        let along = |axis: usize| {
            let (one, other) = (map.matrix3.col(axis) * self.lo[axis], map.matrix3.col(axis) * self.hi[axis]);
            (one.min(other), one.max(other))
        };
        let [(x_lo, x_hi), (y_lo, y_hi), (z_lo, z_hi)] = [along(0), along(1), along(2)];
        Self { lo: x_lo + y_lo + z_lo + map.translation, hi: x_hi + y_hi + z_hi + map.translation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DMat3;

    #[test]
    fn a_moved_box_is_the_box_around_its_moved_corners() {
        let axis = DVec3::new(2.0, -3.0, 6.0) / 7.0;
        for step in 0..100 {
            let step = f64::from(step);
            let turn = DMat3::from_axis_angle(axis, 0.7 * step);
            let matrix3 = turn * DMat3::from_diagonal(DVec3::new(0.3, 1.0 + step, -1e-3));
            let map = DAffine3 { matrix3, translation: axis * (step - 50.0) };
            let b = Bounds::new(DVec3::new(-1.0, -0.1, 0.0), DVec3::new(0.7, 1.0, 0.3 + step));
            let corners = b.corners().map(|corner| map.transform_point3(corner));
            assert_eq!(b.mapped(&map), Bounds::around(corners));
        }
    }
}

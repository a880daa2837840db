//! Boxes: three pairs of parallel planes.
//!
//! A direction component of 0 is decided by `lo ≤ o < hi`, half open, so that 0 · ∞ never arises and of two
//! boxes that share a face exactly one claims a ray in the plane of that face.

use crate::math::{Bounds, DMat3, DVec3, Placement, Ray};

use super::span::{End, ROUNDING, Span};

/// A box along the axes of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisBox {
    bounds: Bounds,
    reach: f64,
}

impl AxisBox {
    /// A box with an interior.
    pub fn new(bounds: Bounds) -> Self {
        let reach = bounds.lo.abs().max(bounds.hi.abs()).length();
        Self { bounds, reach }
    }

    /// Where the ray is inside.
    #[inline]
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let off = ROUNDING * (self.reach + ray.o.length());
        let mut span = Span::LINE;
        for axis in 0..3 {
            let (lo, hi) = (self.bounds.lo[axis], self.bounds.hi[axis]);
            clip_to_slab(&mut span, ray.o[axis], ray.d[axis], [lo, hi], off, axis)?;
        }
        span.if_any()
    }

    /// The outward normal of a face.
    pub fn normal(surface: u32) -> DVec3 {
        DVec3::AXES[(surface / 2) as usize] * side(surface)
    }

    /// The box itself.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }
}

/// The unit cube under an affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkewBox {
    place: Placement,
    /// The rows of the inverse: normals of the three pairs of faces, in units of half their distance.
    rows: [DVec3; 3],
    row_lengths: [f64; 3],
    reach: f64,
}

impl SkewBox {
    /// The unit cube at `place`.
    pub fn new(place: Placement) -> Self {
        let rows = [place.inverse.row(0), place.inverse.row(1), place.inverse.row(2)];
        let DMat3 { x_axis, y_axis, z_axis } = place.linear;
        let reach = place.center.length() + x_axis.length() + y_axis.length() + z_axis.length();
        Self { place, rows, row_lengths: rows.map(DVec3::length), reach }
    }

    /// Where the ray is inside.
    #[inline]
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let from_center = ray.o - self.place.center;
        let off = ROUNDING * (self.reach + from_center.length());
        let mut span = Span::LINE;
        for axis in 0..3 {
            let (o, d) = (self.rows[axis].dot(from_center), self.rows[axis].dot(ray.d));
            clip_to_slab(&mut span, o, d, [-1.0, 1.0], off * self.row_lengths[axis], axis)?;
        }
        span.if_any()
    }

    /// The outward normal of a face, of length 1.
    pub fn normal(&self, surface: u32) -> DVec3 {
        let row = self.rows[(surface / 2) as usize];
        let size = row.abs().max_element();
        (row / size).normalize_or(DVec3::Z) * side(surface)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        let DMat3 { x_axis, y_axis, z_axis } = self.place.linear;
        let half = x_axis.abs() + y_axis.abs() + z_axis.abs();
        Bounds::new(self.place.center - half, self.place.center + half)
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let unit = self.place.linear.transpose() * v;
        self.place.center.dot(v) + unit.abs().element_sum()
    }

    /// The interval of each face normal over a box.
    fn extents(&self, b: &Bounds) -> [(f64, f64); 3] {
        self.rows.map(|row| {
            let middle = row.dot(b.center() - self.place.center);
            let half = row.abs().dot(b.half());
            (middle - half, middle + half)
        })
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        self.extents(b).iter().any(|&(lo, hi)| lo > 1.0 || hi < -1.0)
    }

    /// Whether the box is certainly inside.
    pub fn covers(&self, b: &Bounds) -> bool {
        self.extents(b).iter().all(|&(lo, hi)| lo > -1.0 && hi < 1.0)
    }
}

/// Faces are numbered by axis, the lower one first.
fn side(surface: u32) -> f64 {
    if surface & 1 == 0 { -1.0 } else { 1.0 }
}

/// Cuts the span to one slab; `None` where the ray runs beside it. `off` is how far `o` and the faces may be off.
#[inline]
fn clip_to_slab(span: &mut Span, o: f64, d: f64, [lo, hi]: [f64; 2], off: f64, axis: usize) -> Option<()> {
    if d == 0.0 {
        return (lo <= o && o < hi).then_some(());
    }
    let error = off / d.abs();
    let low = End { t: (lo - o) / d, error, surface: 2 * axis as u32 };
    let high = End { t: (hi - o) / d, error, surface: 2 * axis as u32 + 1 };
    if d > 0.0 {
        span.clip(low, high);
    } else {
        span.clip(high, low);
    }
    Some(())
}

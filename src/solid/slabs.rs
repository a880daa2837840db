//! Boxes: three pairs of parallel planes.
//!
//! A direction component of 0 is decided by `lo ≤ o < hi`, half open, so that 0 · ∞ never arises and of two
//! boxes that share a face exactly one claims a ray in the plane of that face.

use crate::math::{Bounds, DMat3, DVec3, Mask, Number, Placement, Rays, two_sum};

use super::classification::Classification;
use super::span::{Ends, ROUNDING, STILL, Spans, WORLD, rounding_at};

/// A box along the axes of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisBox {
    bounds: Bounds,
    /// How far a face within the world may be off its place: by what its numbers lost, and by our own
    /// rounding.
    place_error: f64,
}

/// How far our own rounding may make a face of a box along the axes seem off its place: a [`rounding_at`]
/// without the way to the box's centre, from which nothing is computed.
const SEEN: f64 = ROUNDING * WORLD;

impl AxisBox {
    /// The box with edges of twice `half`, all above 0, around a centre that may be off by `map_error`.
    ///
    /// A face that cuts the world is as exact as it was written, however far the box reaches: what its sum of
    /// centre and half lost is known, and beyond that only coordinates within [`WORLD`] are computed with.
    pub fn new(center: DVec3, half: DVec3, map_error: DVec3) -> Self {
        let (mut bounds, mut place_error) = (Bounds::EMPTY, 0.0_f64);
        for axis in 0..3 {
            let (lo, hi) = (two_sum(center[axis], -half[axis]), two_sum(center[axis], half[axis]));
            (bounds.lo[axis], bounds.hi[axis]) = (lo.0, hi.0);
            for (face, lost) in [lo, hi] {
                if face.abs() <= WORLD {
                    place_error = place_error.max(lost.abs() + map_error[axis]);
                }
            }
        }
        Self { bounds, place_error: SEEN + place_error }
    }

    /// Where each ray is inside.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        let mut spans = Spans::line(rays.o.x);
        for axis in 0..3 {
            let slab = Slab {
                lo: self.bounds.lo[axis],
                hi: self.bounds.hi[axis],
                face_error: self.place_error,
                still: 0.0,
            };
            slab.clip(&mut spans, rays.o.along(axis), rays.d.along(axis), axis);
            if !spans.may.any() {
                return spans;
            }
        }
        let spans = spans.if_any(
            self.rounding_share(),
            #[inline(always)]
            |axis| axis,
        );
        with_sides(spans, [rays.d.x, rays.d.y, rays.d.z])
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// The share of its errors that our own rounding may have made.
    pub fn rounding_share(&self) -> f64 {
        SEEN / self.place_error
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
    /// How far a face of each pair may be off its place, by its map and by our own rounding, in units of its
    /// row.
    face_errors: [f64; 3],
    /// The same in the world, for all of it.
    place_error: f64,
    /// The least share of it that is our own rounding.
    rounding_share: f64,
    /// What rounding may make of the 0 of a direction in the plane of such a face.
    still: [f64; 3],
}

impl SkewBox {
    /// The unit cube at `place`, which may be off by `map_error`.
    pub fn new(place: Placement, map_error: DVec3) -> Self {
        let rows = [place.inverse.row(0), place.inverse.row(1), place.inverse.row(2)];
        let lengths = rows.map(DVec3::length);
        let seen = rounding_at(place.center.length());
        let face_errors = [0, 1, 2].map(|i| seen * lengths[i] + rows[i].abs().dot(map_error));
        let rounding_share = (0..3).map(|i| seen * lengths[i] / face_errors[i]).fold(1.0, f64::min);
        let place_error = seen + map_error.length();
        // A dot product of three terms and the row itself: 4 half-ulps.
        let still = lengths.map(|length| 2.0 * f64::EPSILON * length);
        Self { place, rows, face_errors, place_error, rounding_share, still }
    }

    /// Where each ray is inside.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        let from_center = rays.o - self.place.center;
        let mut spans = Spans::line(rays.o.x);
        let speeds =
            [rays.d.dot_one(self.rows[0]), rays.d.dot_one(self.rows[1]), rays.d.dot_one(self.rows[2])];
        for axis in 0..3 {
            let slab =
                Slab { lo: -1.0, hi: 1.0, face_error: self.face_errors[axis], still: self.still[axis] };
            slab.clip(&mut spans, from_center.dot_one(self.rows[axis]), speeds[axis], axis);
            if !spans.may.any() {
                return spans;
            }
        }
        with_sides(
            spans.if_any(
                self.rounding_share,
                #[inline(always)]
                |axis| axis,
            ),
            speeds,
        )
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// The share of its errors that our own rounding may have made.
    pub fn rounding_share(&self) -> f64 {
        self.rounding_share
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

    /// How far the nearest two parallel faces are apart.
    pub fn thickness(&self) -> f64 {
        2.0 / self.rows.iter().map(|row| row.length()).fold(0.0, f64::max)
    }

    /// The interval of each face normal over a box.
    fn extents(&self, b: &Bounds) -> [(f64, f64); 3] {
        self.rows.map(|row| {
            let middle = row.dot(b.center() - self.place.center);
            let half = row.abs().dot(b.half());
            (middle - half, middle + half)
        })
    }

    /// How it lies to a box.
    pub fn classify(&self, b: &Bounds) -> Classification {
        let extents = self.extents(b);
        Classification::of(extents.iter().any(|&(lo, hi)| lo > 1.0 || hi < -1.0), || {
            extents.iter().all(|&(lo, hi)| lo > -1.0 && hi < 1.0)
        })
    }
}

/// Faces are numbered by axis, the lower one first.
fn side(surface: u32) -> f64 {
    if surface & 1 == 0 { -1.0 } else { 1.0 }
}

/// A pair of parallel planes.
#[derive(Clone, Copy, Debug)]
struct Slab {
    lo: f64,
    hi: f64,
    /// How far a ray's start and the faces may be off.
    face_error: f64,
    /// A ray slower than this across the slab runs in the plane of its faces, as far as the map lets it be
    /// known.
    still: f64,
}

impl Slab {
    /// Cuts each span to the slab, and leaves none of those rays that run beside it. The axis stands for the
    /// surface until [`with_sides`] says which of the two it is.
    #[inline(always)]
    fn clip<N: Number>(&self, spans: &mut Spans<N>, o: N, d: N, axis: usize) {
        let still = d.magnitude().is_below(o.same((self.still * N::EPSILON_RATIO).max(STILL * N::LEAST)));
        let inside = o.is_at_least(o.same(self.lo)) & o.is_below(o.same(self.hi));
        spans.keep(
            !still | inside,
            #[inline(always)]
            || {
                let error = o.same(self.face_error * N::EPSILON_RATIO);
                still
                    & ((o - self.lo).magnitude().is_at_most(error)
                        | (o - self.hi).magnitude().is_at_most(error))
            },
        );
        let inverse = d.same(1.0) / d;
        let (low, high) = ((-o + self.lo) * inverse, (-o + self.hi) * inverse);
        let forward = d.is_above(d.same(0.0));
        // A ray along the slab crosses neither face.
        let enter = still.choose(o.same(f64::NEG_INFINITY), forward.choose(low, high));
        let leave = still.choose(o.same(f64::INFINITY), forward.choose(high, low));
        let (error, surface) =
            (inverse.magnitude() * (self.face_error * N::EPSILON_RATIO), o.same(axis as f64));
        spans.clip(Ends { t: enter, error, surface }, Ends { t: leave, error, surface });
    }
}

/// Spans whose surfaces are axes, with the faces themselves: a ray comes in by the face that it comes
/// against.
#[inline(always)]
fn with_sides<N: Number>(spans: Spans<N>, d: [N; 3]) -> Spans<N> {
    let [enter, leave] = [facing(spans.enter, d, [0.0, 1.0]), facing(spans.leave, d, [1.0, 0.0])];
    Spans { enter, leave, ..spans }
}

/// The face of an axis' pair that is crossed: one where the ray goes down the axis, the other where it goes
/// up.
#[inline(always)]
fn facing<N: Number>(end: Ends<N>, d: [N; 3], [upward, downward]: [f64; 2]) -> Ends<N> {
    let axis = end.surface;
    let (is_x, is_y) = (axis.is_equal(axis.same(0.0)), axis.is_equal(axis.same(1.0)));
    let speed = is_x.choose(d[0], is_y.choose(d[1], d[2]));
    let side = speed.is_above(speed.same(0.0)).choose(axis.same(upward), axis.same(downward));
    Ends { surface: axis + axis + side, ..end }
}

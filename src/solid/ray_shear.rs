//! Whether a line passes through a flat outline, decided in the plane across the line.
//!
//! The corners of an outline are sheared along the line into a plane of two axes of the world, the line at
//! (0, 0). On which side of an edge the line passes is the exact sign of the area that it spans with the edge
//! there (Woop, Benthin, Wald: Watertight ray/triangle intersection, JCGT 2013; signs by Shewchuk's adaptive
//! predicates). A point on an edge counts as moved by an infinitesimal step, the same for all outlines, so
//! that of the outlines around an edge or a corner exactly as many are crossed as a line beside it would
//! cross.

use robust::{Coord, orient2d};

use crate::math::{Bounds, DVec3, Number, Ray, Rays, Vector};

/// An area that is a difference of two products has the sign of its rounded value where that is larger than
/// this share of their sum: three roundings of half an ulp (Ozaki et al.: Simple floating-point filters for
/// the two-dimensional orientation problem, BIT 2016). The bound of the `robust` crate is no larger.
pub(super) const ROUNDED: f64 = 1.5 * f64::EPSILON;

/// The plane across a ray: two axes of the world sheared along it.
pub(super) struct RayShear<'a> {
    ray: &'a Ray,
    /// The axis that the ray goes farthest on, and the others.
    axes: [usize; 3],
    /// How far the ray goes along each of the others for a step along the first: 1 at most.
    pub(super) shear: [f64; 2],
}

impl<'a> RayShear<'a> {
    pub fn new(ray: &'a Ray) -> Self {
        let size = ray.d.abs();
        let main = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let axes = [main, (main + 1) % 3, (main + 2) % 3];
        Self { ray, axes, shear: [ray.d[axes[1]] / ray.d[main], ray.d[axes[2]] / ray.d[main]] }
    }

    /// The place of a point in the plane.
    #[inline]
    fn place(&self, p: DVec3) -> Coord<f64> {
        let [x, y, _] = self.sheared(p);
        Coord { x, y }
    }

    /// The place of a point in the plane, and how far it lies from the ray's start along the axis that the
    /// ray goes farthest on.
    #[inline]
    pub fn sheared(&self, p: DVec3) -> [f64; 3] {
        let q = (p - self.ray.o).to_array();
        let along = q[self.axes[0]];
        [q[self.axes[1]] - self.shear[0] * along, q[self.axes[2]] - self.shear[1] * along, along]
    }

    /// The axis that the ray goes farthest on.
    #[inline]
    pub fn main(&self) -> usize {
        self.axes[0]
    }

    /// How far the ray goes along that axis on a way of length 1: at least 1/√3 either way.
    #[inline]
    pub fn step(&self) -> f64 {
        self.ray.d[self.axes[0]]
    }

    /// Whether the line passes through a triangle. One without area across the line is never passed through.
    #[inline]
    pub fn meets_triangle(&self, corners: &[DVec3; 3]) -> bool {
        // Not by `map`, which is not inlined.
        let [a, b, c] = [self.place(corners[0]), self.place(corners[1]), self.place(corners[2])];
        let first = side(a, b);
        first.is_some() && first == side(b, c) && first == side(c, a)
    }

    /// Whether the line is inside a stretch of an outline an odd number of times, counted by the edges from
    /// each corner to the next that lie to the right of the line in the plane.
    pub fn crosses_odd(&self, corners: &[DVec3]) -> bool {
        let mut odd = false;
        let Some((first, rest)) = corners.split_first() else { return false };
        let mut p = self.place(*first);
        for corner in rest {
            let q = self.place(*corner);
            odd ^= is_right(p, q);
            p = q;
        }
        odd
    }

    /// Whether edges between points of a box can lie to the right of the line: not where all are above it or
    /// all below. Every rounding here keeps the order of what it rounds, so the answer is that of
    /// [`Self::place`].
    pub fn may_cross(&self, b: &Bounds) -> bool {
        let (lo, hi) = (b.lo - self.ray.o, b.hi - self.ray.o);
        let shear = self.shear[1];
        let along = [shear * lo[self.axes[0]], shear * hi[self.axes[0]]];
        let least = lo[self.axes[2]] - along[0].max(along[1]);
        let most = hi[self.axes[2]] - along[0].min(along[1]);
        least <= 0.0 && most > 0.0
    }
}

/// Whether an edge crosses the half-line to the right of the line's point, that point itself moved by (ε,
/// ε²).
pub(super) fn is_right(p: Coord<f64>, q: Coord<f64>) -> bool {
    if (p.y > 0.0) == (q.y > 0.0) {
        return false;
    }
    let (low, high) = if p.y > 0.0 { (q, p) } else { (p, q) };
    // With both ends on one side the exact sign is plain.
    if low.x > 0.0 && high.x > 0.0 {
        return true;
    }
    if low.x < 0.0 && high.x < 0.0 {
        return false;
    }
    // An area of 0 becomes negative by the step along x.
    orient2d(low, high, Coord { x: 0.0, y: 0.0 }) > 0.0
}

/// On which side of the directed edge the ray's point lies, itself moved by (ε, ε²); `None` for an edge of no
/// length across the ray, whose triangle has no area there.
#[inline]
fn side(p: Coord<f64>, q: Coord<f64>) -> Option<bool> {
    let (left, right) = (p.x * q.y, p.y * q.x);
    let area = left - right;
    if area.abs() > ROUNDED * (left.abs() + right.abs()) {
        return Some(area > 0.0);
    }
    exact_side(p, q)
}

/// [`side`] where rounding could have made the sign.
#[inline(never)]
fn exact_side(p: Coord<f64>, q: Coord<f64>) -> Option<bool> {
    let area = orient2d(p, q, Coord { x: 0.0, y: 0.0 });
    if area != 0.0 {
        return Some(area > 0.0);
    }
    // The area's change for a step along x is −(q.y − p.y), along y it is q.x − p.x.
    if p.y != q.y {
        return Some(p.y > q.y);
    }
    (p.x != q.x).then_some(q.x > p.x)
}

/// The sine of the angle between a line and a plane above which their crossing is off by a thousand times a
/// coordinate's error at most, and the corners of an outline can not say more.
pub(super) const STEEP: f64 = 1e-3;

/// So many times its error may a crossing lie from another of the same place
/// ([`super::crossing`]: slopes of one place differ by a factor of 256), and a little more.
pub(super) const ONE_PLACE: f64 = 300.0;

/// Where lines meet a plane.
pub(super) struct OnPlane<N> {
    /// The sine of the angle between each and the plane, below 0 where the line comes against the normal.
    pub towards: N,
    pub t: N,
    pub error: N,
}

/// Where lines meet the plane through `anchor` across `normal`, and how far that may be off, given how far
/// coordinates may be.
#[inline(always)]
pub(super) fn on_plane<N: Number>(
    rays: &Rays<N>,
    normal: DVec3,
    anchor: DVec3,
    place_error: f64,
) -> OnPlane<N> {
    let towards = rays.d.dot_one(normal);
    let t = (rays.o.same(anchor) - rays.o).dot_one(normal) / towards;
    OnPlane { towards, t, error: t.same(place_error) / towards.magnitude() }
}

/// Where lines meet planes, each its own: as [`on_plane`] says.
#[inline(always)]
pub(super) fn planes_met<N: Number>(
    rays: &Rays<N>,
    normals: Vector<N>,
    anchors: Vector<N>,
    place_error: f64,
) -> OnPlane<N> {
    let towards = rays.d.dot(normals);
    let t = (anchors - rays.o).dot(normals) / towards;
    OnPlane { towards, t, error: t.same(place_error) / towards.magnitude() }
}

/// Where a line that passes through an outline meets the plane through `anchor` across `normal`, and how far
/// that may be off, given how far coordinates may be. Where the outline lies so nearly edge on that the plane
/// leads away from its corners: the middle of them along the line, and as far off as they reach.
pub(super) fn plane_crossing(
    ray: &Ray,
    corners: &[DVec3],
    normal: DVec3,
    anchor: DVec3,
    place_error: f64,
) -> (f64, f64) {
    let OnPlane { towards, t, error } = on_plane(&Rays::from(ray), normal, anchor, place_error);
    if towards.abs() > STEEP {
        return (t, error);
    }
    let along = corners.iter().map(|&p| (p - ray.o).dot(ray.d));
    let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    let half = 0.5 * high - 0.5 * low + place_error;
    if (low - place_error..=high + place_error).contains(&t) && error < half {
        return (t, error);
    }
    (0.5 * low + 0.5 * high, half)
}

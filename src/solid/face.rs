//! Polygons, concave ones too: surfaces seen from both sides.
//!
//! A ray meets a polygon where its outline turns around it an odd number of times, decided exactly in the
//! plane across the ray ([`super::ray_shear`]): of two polygons with a common edge exactly one is met there.

use crate::math::{Bounds, DVec3, Mask, Number, Placement, Ray, Rays};

use super::ray_shear::{OnPlane, RayShear, STEEP, on_plane, plane_crossing};
use super::span::{End, Ends, rounding_at};

/// So many edges are looked at together: past twice as many, boxes around each group of them are asked first.
const GROUP: usize = 32;

/// Corners that are written with six digits leave their plane by this much, in the assembly's unit. A polygon
/// that is bent further is meant so.
const WRITTEN: f64 = 1e-5;

/// Where lines meet the plane of a polygon.
pub(super) struct SteepCrossings<N: Number> {
    pub end: Ends<N>,
    /// Which come against the normal.
    pub against: N::Mask,
    /// Which are steep enough for the plane to say where: of the others `end` means nothing.
    pub steep: N::Mask,
}

/// A polygon in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// The corners in order, and the first again.
    outline: Box<[DVec3]>,
    /// Boxes around each [`GROUP`] of edges; none where there are few.
    groups: Box<[Bounds]>,
    /// Across the plane that fits best, of length 1: the outline turns to the left around it.
    normal: DVec3,
    /// A point of that plane: the mean of the corners.
    middle: DVec3,
    /// How far corners may seem off the plane: by their own rounding, and by that of ours.
    place_error: f64,
    /// The box of a polygon so bent that its plane leads out of it.
    bent_box: Option<Box<Bounds>>,
}

impl Face {
    /// The polygon of these corners, put at `place`, which may be off by `map_error`.
    pub fn new(corners: impl ExactSizeIterator<Item = DVec3>, place: &Placement, map_error: DVec3) -> Self {
        let share = 1.0 / corners.len() as f64;
        let mut outline: Vec<DVec3> = Vec::with_capacity(corners.len() + 1);
        outline.extend(corners.map(|p| place.linear * p + place.center));
        let middle = outline.iter().fold(DVec3::ZERO, |sum, &p| sum + p * share);
        let reach = outline.iter().map(|p| p.length()).fold(0.0, f64::max);
        outline.extend(outline.first().copied());
        let normal = newell(&outline);
        let bent = outline.iter().map(|&p| normal.dot(p - middle).abs()).fold(0.0, f64::max);
        let groups = if outline.len() > 2 * GROUP {
            // Groups share the corner between them.
            let group = |start| &outline[start..outline.len().min(start + GROUP + 1)];
            (0..outline.len() - 1)
                .step_by(GROUP)
                .map(|start| Bounds::around(group(start).iter().copied()))
                .collect()
        } else {
            Box::default()
        };
        let bent_box = (bent > rounding_at(reach)).then(|| Box::new(Bounds::around(outline.iter().copied())));
        let place_error = bent.min(WRITTEN) + rounding_at(reach) + map_error.length();
        Self { outline: outline.into(), groups, normal, middle, place_error, bent_box }
    }

    /// Where the line of the ray meets the polygon.
    #[inline]
    pub fn crossing(&self, ray: &Ray) -> Option<End> {
        let across = RayShear::new(ray);
        if !self.surrounds(&across) {
            return None;
        }
        let (t, error) = plane_crossing(ray, self.corners(), self.normal, self.middle, self.place_error);
        let t = self.bent_box.as_ref().map_or(t, |b| nearest_within(b, &Rays::from(ray), t));
        Some(End { t, error, surface: 0 })
    }

    /// Where lines through the outline meet the polygon: [`Face::crossing`] of those that are steep enough
    /// for their plane to say it.
    #[inline(always)]
    pub(super) fn steep_crossings<N: Number>(&self, rays: &Rays<N>) -> SteepCrossings<N> {
        let OnPlane { towards, t, error } = on_plane(rays, self.normal, self.middle, self.place_error);
        let t = match &self.bent_box {
            Some(b) => nearest_within(b, rays, t),
            None => t,
        };
        SteepCrossings {
            end: Ends { t, error, surface: t.same(0.0) },
            against: towards.is_below(t.same(0.0)),
            steep: towards.magnitude().is_above(t.same(STEEP)),
        }
    }

    /// Stretches of the outline, all of its edges together, each with a box around it where there are many.
    #[inline(always)]
    pub(super) fn stretches(&self) -> impl Iterator<Item = (Option<&Bounds>, &[DVec3])> {
        let length = if self.groups.is_empty() { self.outline.len() } else { GROUP };
        (0..self.outline.len() - 1).step_by(length).enumerate().map(move |(number, start)| {
            let end = self.outline.len().min(start + length + 1);
            (self.groups.get(number), &self.outline[start..end])
        })
    }

    fn surrounds(&self, across: &RayShear) -> bool {
        let mut odd = false;
        for (b, corners) in self.stretches() {
            if b.is_none_or(|b| across.may_cross(b)) {
                odd ^= across.crosses_odd(corners);
            }
        }
        odd
    }

    /// The normal of its plane, of length 1.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The corners in order, from the second: the first is the last.
    pub fn corners(&self) -> &[DVec3] {
        &self.outline[1..]
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.corners().iter().copied())
    }

    /// How far a corner may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        self.corners().iter().map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the box is certainly off the polygon.
    pub fn misses(&self, b: &Bounds) -> bool {
        let distance = self.normal.dot(b.center() - self.middle).abs() - self.normal.abs().dot(b.half());
        distance > self.place_error || self.bounds().meet(b).is_empty()
    }
}

/// The place nearest to `t` on the ray within the box. A ray through an outline passes through the hull of
/// its corners, and so through their box, but for rounding.
#[inline(always)]
fn nearest_within<N: Number>(b: &Bounds, rays: &Rays<N>, t: N) -> N {
    let infinite = t.same(f64::INFINITY);
    let (mut low, mut high) = (-infinite, infinite);
    for axis in 0..3 {
        let (o, inverse) = (rays.o.along(axis), t.same(1.0) / rays.d.along(axis));
        let (t1, t2) = ((-o + b.lo[axis]) * inverse, (-o + b.hi[axis]) * inverse);
        let finite = inverse.magnitude().is_below(infinite);
        low = finite.choose(t1.smaller(t2).larger(low), low);
        high = finite.choose(t1.larger(t2).smaller(high), high);
    }
    let within = t.is_below(low).choose(low, t.is_above(high).choose(high, t));
    low.is_at_most(high).choose(within, low * 0.5 + high * 0.5)
}

/// The normal of a closed outline by Newell's method: its components are the areas of the outline's shadows
/// along the axes, so that it fits the corners even where they are not quite in a plane. Corners are taken
/// from the first, and scaled, so that nothing cancels or overflows.
fn newell(outline: &[DVec3]) -> DVec3 {
    let first = outline[0];
    let size = outline.iter().map(|&p| (p - first).abs().max_element()).fold(0.0, f64::max);
    let from_first = |p: DVec3| (p - first) / size;
    let sum = outline
        .windows(2)
        .fold(DVec3::ZERO, |sum, edge| sum + from_first(edge[0]).cross(from_first(edge[1])));
    sum.normalize_or(DVec3::Z)
}

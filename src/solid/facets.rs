//! Convex solids of flat faces: prisms, pyramids, coarse spheres.

use crate::math::{Bounds, DVec3, Mask, Number, Placement, Rays};
use crate::scene;

use super::classification::Classification;
use super::span::{Ends, Spans, rounding_at};
use super::unit_space::norm;

/// An intersection of half-spaces, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolyhedron {
    /// The points `p` with `normal · (p − center) ≤ offset`; normals have length 1.
    faces: Box<[scene::HalfSpace]>,
    center: DVec3,
    bounds: Bounds,
    /// Where they are known: else those of the box stand for them.
    corners: Box<[DVec3]>,
    /// By face: how far it may be from its place, by the map and by our own rounding.
    face_errors: Box<[f64]>,
    /// The largest of them.
    place_error: f64,
    /// The least share of it that is our own rounding.
    rounding_share: f64,
    thickness: f64,
}

/// What rounding may make of the 0 of a direction in the plane of a face: a dot product of three terms, and
/// the normal itself, 4 half-ulps.
const STILL: f64 = 2.0 * f64::EPSILON;

impl ConvexPolyhedron {
    /// The faces of `unit`, put at `place`, which may be off by `map_error`.
    pub fn new(unit: &scene::Facets, place: &Placement, map_error: DVec3) -> Self {
        let turn = place.inverse.transpose();
        let faces: Box<[scene::HalfSpace]> = unit
            .faces
            .iter()
            .map(|face| {
                let normal = turn * face.normal;
                // Scaled before its length is taken, so that no square overflows.
                let size = normal.abs().max_element();
                let length = (normal / size).length();
                scene::HalfSpace { normal: normal / size / length, offset: face.offset / size / length }
            })
            .collect();
        let map = crate::math::DAffine3 { matrix3: place.linear, translation: place.center };
        let bounds = unit.bounds.mapped(&map);
        let seen = rounding_at(place.center.length());
        let face_errors: Box<[f64]> =
            faces.iter().map(|face| seen + face.normal.abs().dot(map_error)).collect();
        let rounding_share = face_errors.iter().map(|error| seen / error).fold(1.0, f64::min);
        let place_error = face_errors.iter().fold(0.0, |most: f64, &error| most.max(error));
        // The narrowest unit solid, a prism of three sides, is 1.5 thick, a pyramid over it more than a third
        // of that.
        let thickness = 0.5 / norm(&place.inverse);
        let (center, corners) = (place.center, Box::default());
        Self { faces, center, bounds, corners, face_errors, place_error, rounding_share, thickness }
    }

    /// The same solid, with its corners.
    #[must_use]
    pub fn with_corners(self, corners: Box<[DVec3]>) -> Self {
        // Two planes that are as near as can be touch a face, or two edges: those are as far apart as two
        // faces at least by a third, about.
        let across = |face: &scene::HalfSpace| {
            let along = corners.iter().map(|p| p.dot(face.normal));
            let (lo, hi) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
            hi - lo
        };
        let thickness = self.faces.iter().map(across).fold(f64::INFINITY, f64::min) / 3.0;
        Self { bounds: Bounds::around(corners.iter().copied()), corners, thickness, ..self }
    }

    /// Where each ray is inside. A ray in the plane of a face is decided half open, as for slabs: inside
    /// where the normal's first component that is not 0 is negative.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        let like = rays.o.x;
        let from_center = rays.o - self.center;
        let mut spans = Spans::line(like);
        let (before, behind) = (like.same(f64::NEG_INFINITY), like.same(f64::INFINITY));
        let still = STILL * N::EPSILON_RATIO;
        for (surface, (face, face_error)) in self.faces.iter().zip(&self.face_errors).enumerate() {
            let above = from_center.dot_one(face.normal) - face.offset;
            let d = rays.d.dot_one(face.normal);
            let inverse = like.same(1.0) / d;
            let (t, error, surface) = (
                -above * inverse,
                inverse.magnitude() * (*face_error * N::EPSILON_RATIO),
                like.same(surface as f64),
            );
            let (against, along) = (d.is_below(like.same(-still)), d.is_above(like.same(still)));
            let enter = Ends { t: against.choose(t, before), error, surface };
            let leave = Ends { t: along.choose(t, behind), error, surface };
            spans.clip(enter, leave);
            let zero = like.same(0.0);
            let outside =
                if points_down(face.normal) { above.is_above(zero) } else { above.is_at_least(zero) };
            spans.keep(
                against | along | !outside,
                #[inline(always)]
                || {
                    !(against | along)
                        & above.magnitude().is_at_most(like.same(*face_error * N::EPSILON_RATIO))
                },
            );
        }
        spans.if_any(
            self.rounding_share,
            #[inline(always)]
            |surface| surface,
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

    /// How far two parallel planes around it are apart at least, or less.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The outward normal of a face, of length 1.
    pub fn normal(&self, surface: u32) -> DVec3 {
        self.faces[surface as usize].normal
    }

    /// How far it reaches along `v` at most: the greatest `p · v` of its corners, or of its box.
    pub fn support(&self, v: DVec3) -> f64 {
        let farthest = |points: &[DVec3]| points.iter().map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max);
        if self.corners.is_empty() { farthest(&self.bounds.corners()) } else { farthest(&self.corners) }
    }

    /// How many faces it has.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.faces.len()
    }

    /// A box around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// How it lies to a box.
    pub fn classify(&self, b: &Bounds) -> Classification {
        if self.bounds.meet(b).is_empty() {
            return Classification::Outside;
        }
        let (center, half) = (b.center() - self.center, b.half());
        let mut all = true;
        for face in &self.faces {
            let (middle, reach) = (face.normal.dot(center), face.normal.abs().dot(half));
            if middle - reach > face.offset {
                return Classification::Outside;
            }
            all &= middle + reach < face.offset;
        }
        if all { Classification::Inside } else { Classification::Mixed }
    }
}

fn points_down(normal: DVec3) -> bool {
    normal.to_array().into_iter().find(|&x| x != 0.0).is_some_and(|x| x < 0.0)
}

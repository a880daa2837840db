//! Polygons with a normal at each corner.

use crate::math::{DVec3, Placement};
use crate::scene::Corner;

use super::face::Face;

/// A polygon whose normal changes from corner to corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The polygon itself.
    pub face: Face,
    /// A normal to each corner of the face, in the same order; of length 1, or 0.
    normals: Box<[DVec3]>,
}

impl Patch {
    /// The patch of these corners, put at `place`, which may be off by `map_error`.
    pub fn new(corners: &[Corner], place: &Placement, map_error: DVec3) -> Self {
        let face = Face::new(corners.iter().map(|corner| corner.place), place, map_error);
        let turn = place.inverse.transpose();
        let turned = |corner: &Corner| {
            let normal = turn * corner.normal;
            (normal / normal.abs().max_element()).normalize_or_zero()
        };
        // The face gives its corners from the second on, the first as its last.
        let normals = corners[1..].iter().chain(&corners[..1]).map(turned).collect();
        Self { face, normals }
    }

    /// The normal at a point of the patch, on the plane's own side or on the other, as its corners say, of
    /// length 1; that of the plane where the corners' normals cancel.
    ///
    /// Between three corners it is their mean by areas; between more, their mean by mean value coordinates,
    /// which is the same for a triangle (Floater: Mean value coordinates, CAGD 2003; for concave outlines
    /// Hormann and Floater: Mean value coordinates for arbitrary planar polygons, ACM TOG 2006).
    pub fn normal(&self, p: DVec3) -> DVec3 {
        self.interpolated(p).normalize_or(self.face.normal())
    }

    fn interpolated(&self, p: DVec3) -> DVec3 {
        let (corners, plane) = (self.face.corners(), self.face.normal());
        let mut sum = DVec3::ZERO;
        let edge = |from: usize, to: usize| {
            half_tangent(corners[from] - p, corners[to] - p, plane)
                .map_err(|share| self.normals[from] * (1.0 - share) + self.normals[to] * share)
        };
        let mut before = match edge(corners.len() - 1, 0) {
            Ok(tangent) => tangent,
            Err(on_edge) => return on_edge,
        };
        for (i, corner) in corners.iter().enumerate() {
            let next = if i + 1 == corners.len() { 0 } else { i + 1 };
            let behind = match edge(i, next) {
                Ok(tangent) => tangent,
                Err(on_edge) => return on_edge,
            };
            sum += self.normals[i] * ((before + behind) / corner.distance(p));
            before = behind;
        }
        sum
    }
}

/// The tangent of half the angle from `a` to `b` about `axis`; where the angle is a half turn or an end is 0,
/// so that the origin lies on the edge between them, how far along.
fn half_tangent(a: DVec3, b: DVec3, axis: DVec3) -> Result<f64, f64> {
    let (area, along) = (a.cross(b).dot(axis), a.dot(b));
    let lengths = a.length() * b.length();
    // sin / (1 + cos) and (1 − cos) / sin are the same; each is taken where it does not cancel.
    if along > 0.0 {
        Ok(area / (lengths + along))
    } else if area == 0.0 {
        Err(a.length() / (a.length() + b.length()))
    } else {
        Ok((lengths - along) / area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DAffine3;

    fn patch(corners: &[([f64; 3], [f64; 3])]) -> Patch {
        let corners: Vec<Corner> = corners
            .iter()
            .map(|&(place, normal)| Corner { place: place.into(), normal: normal.into() })
            .collect();
        Patch::new(&corners, &Placement::new(&DAffine3::IDENTITY).unwrap(), DVec3::ZERO)
    }

    #[test]
    fn between_three_corners_normals_are_weighed_by_areas() {
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let patch = patch(&[([0.0, 0.0, 0.0], x), ([4.0, 0.0, 0.0], y), ([0.0, 4.0, 0.0], z)]);
        for (u, v) in [(0.25, 0.25), (0.5, 0.125), (0.01, 0.98), (0.0, 0.5), (0.5, 0.5), (1.0, 0.0)] {
            let expected = DVec3::new(1.0 - u - v, u, v).normalize();
            let found = patch.normal(DVec3::new(4.0 * u, 4.0 * v, 0.0));
            assert!((found - expected).length() < 1e-14, "{u} {v}: {found} {expected}");
        }
    }

    #[test]
    fn a_linear_field_of_normals_is_kept_in_a_concave_patch() {
        let field = |p: DVec3| DVec3::new(0.3 * p.x - 0.1 * p.y, 0.2 * p.y, 1.0);
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.0, 2.0]];
        let corners: Vec<Corner> = outline
            .iter()
            .map(|&[x, y]| {
                let place = DVec3::new(x, y, 0.0);
                Corner { place, normal: field(place) }
            })
            .collect();
        let place = Placement::new(&DAffine3::IDENTITY).unwrap();
        let mut patch = Patch::new(&corners, &place, DVec3::ZERO);
        // Lengths matter to the field: as they are given.
        patch.normals = corners[1..].iter().chain(&corners[..1]).map(|corner| corner.normal).collect();
        for p in [[0.1, 1.2], [1.0, 0.25], [1.9, 1.5], [0.5, 0.1]] {
            let p = DVec3::new(p[0], p[1], 0.0);
            assert!((patch.normal(p) - field(p).normalize()).length() < 1e-14, "{p}");
        }
    }

    #[test]
    fn corners_without_normals_leave_that_of_the_plane() {
        let none = [0.0; 3];
        let patch = patch(&[([0.0, 0.0, 0.0], none), ([1.0, 0.0, 0.0], none), ([0.0, 1.0, 0.0], none)]);
        assert_eq!(patch.normal(DVec3::new(0.2, 0.2, 0.0)), DVec3::Z);
    }
}

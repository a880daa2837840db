//! Rays aimed at one primitive: at its surface from outside, along its surface so that they graze it, and
//! past it.

use ray13::math::{DVec3, Ray};
use ray13::scene::{Primitive, Shape};

use crate::conformance::chance::Chance;

/// A point of a shape's surface and the outward normal there, in the shape's own coordinates.
fn on_surface(shape: &Shape, chance: &mut Chance) -> (DVec3, DVec3) {
    match shape {
        Shape::Cone { bottom, top } => {
            let (sin, cos) = libm::sincos(chance.within(0.0, std::f64::consts::TAU));
            if chance.below(4) == 0 {
                let z = chance.sign();
                let radius = if z < 0.0 { *bottom } else { *top };
                let r = radius * chance.within(0.0, 1.0).sqrt();
                return (DVec3::new(r * cos, r * sin, z), DVec3::Z * z);
            }
            let z = chance.within(-1.0, 1.0);
            let slope = 0.5 * (top - bottom);
            let r = 0.5 * (top + bottom) + slope * z;
            (DVec3::new(r * cos, r * sin, z), DVec3::new(cos, sin, -slope).normalize())
        }
        Shape::Cube => {
            let (axis, sign) = (chance.below(3), chance.sign());
            let mut p = chance.point();
            p[axis] = sign;
            (p, DVec3::AXES[axis] * sign)
        }
        Shape::Facets(facets) => {
            // Where a line from a point inside leaves.
            let from = facets.bounds.center();
            let toward = chance.direction();
            let distance = |face: &&ray13::scene::HalfSpace| {
                (face.offset - face.normal.dot(from)) / face.normal.dot(toward)
            };
            let ahead = facets.faces.iter().filter(|face| face.normal.dot(toward) > 0.0);
            let face = ahead.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("it is bounded");
            (from + toward * distance(&face), face.normal)
        }
        _ => {
            let normal = chance.direction();
            (normal, normal)
        }
    }
}

/// A ray from `distance` away, in the scene's unit. Half of them meet the surface from outside; a quarter
/// pass it at a tenth to 1e-16 of its size, on either side; a quarter go anywhere near it.
pub fn aimed(primitive: &Primitive, distance: f64, chance: &mut Chance) -> Ray {
    let (p, n) = on_surface(&primitive.shape, chance);
    let (p, d) = match chance.below(4) {
        0 | 1 => {
            let d = chance.direction();
            (p, if d.dot(n) > 0.0 { -d } else { d })
        }
        2 => {
            let d = n.cross(chance.direction()).normalize_or(n.any_orthonormal_vector());
            (p + n * chance.sign() * chance.decade(-16.0, -1.0), d)
        }
        _ => (chance.point() * 1.3, chance.direction()),
    };
    let d = (primitive.map.matrix3 * d).normalize();
    Ray::new(primitive.map.transform_point3(p) - d * distance, d)
}

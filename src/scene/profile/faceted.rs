//! Curved solids as OpenSCAD cuts them into facets.

use std::sync::Arc;

use super::arcs::{Fragments, MOST_CORNERS, corners};
use crate::math::DVec3;
use crate::scene::degrees;
use crate::scene::{Mesh, Shape};

/// The mesh that stands for a unit shape whose radius becomes `radius`; none for a surface, and where it
/// would have more than [`MOST_CORNERS`].
pub fn faceted(shape: &Shape, radius: f64, fragments: &Fragments) -> Option<Arc<Mesh>> {
    let count = fragments.of_circle(radius);
    match shape {
        Shape::Mesh(mesh) => Some(Arc::clone(mesh)),
        Shape::Cube => Some(Arc::new(cube())),
        Shape::Sphere => {
            let rings = (count * 0.5).ceil();
            let ring = |i: usize| {
                let polar = (i as f64 + 0.5) * 180.0 / rings;
                (degrees::sin(polar), degrees::cos(polar))
            };
            let profile = || (0..rings as usize).rev().map(ring).collect::<Vec<_>>();
            (count * rings <= MOST_CORNERS).then(|| Arc::new(turned(count, &profile())))
        }
        Shape::Cone { bottom, top } => {
            (count <= MOST_CORNERS).then(|| Arc::new(turned(count, &[(*bottom, -1.0), (*top, 1.0)])))
        }
        Shape::Facets(_)
        | Shape::Bezier(_)
        | Shape::Sheet(_)
        | Shape::Face(_)
        | Shape::Patch(_)
        | Shape::Tube { .. } => None,
    }
}

fn cube() -> Mesh {
    let corner =
        |i: u32| DVec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 }));
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { points: (0..8).map(corner).collect(), triangles }
}

/// The convex solid between regular polygons stacked along z: `(circumradius, z)` from below, z rising. One
/// of no radius is a point.
fn turned(count: f64, profile: &[(f64, f64)]) -> Mesh {
    let mut mesh = Mesh { points: Vec::new(), triangles: Vec::new() };
    // By ring: its first corner, and how many it has.
    let mut rings = Vec::new();
    for &(radius, z) in profile {
        let first = mesh.points.len() as u32;
        if radius > 0.0 {
            mesh.points.extend(corners(radius, count).into_iter().map(|p| p.extend(z)));
        } else {
            mesh.points.push(DVec3::new(0.0, 0.0, z));
        }
        rings.push((first, mesh.points.len() as u32 - first));
    }
    let at = |(first, size): (u32, u32), i: u32| first + i % size;
    let sides = count as u32;
    let mut give = |triangle: [u32; 3]| {
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            mesh.triangles.push(triangle);
        }
    };
    for pair in rings.windows(2) {
        let [low, high] = [pair[0], pair[1]];
        for i in 0..sides {
            give([at(low, i), at(low, i + 1), at(high, i + 1)]);
            give([at(low, i), at(high, i + 1), at(high, i)]);
        }
    }
    if let [bottom, .., top] = rings[..] {
        for i in 1..sides.saturating_sub(1) {
            give([at(bottom, 0), at(bottom, i + 1), at(bottom, i)]);
            give([at(top, 0), at(top, i), at(top, i + 1)]);
        }
    }
    mesh
}

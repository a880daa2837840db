//! Solids that nobody would draw: small numbers on a coarse grid, so that faces are flush, edges meet and
//! solids coincide.

use std::sync::Arc;

use proptest::prelude::*;
use ray13::math::{Bounds, DAffine3, DMat3, DVec3};
use ray13::scene::{Facets, HalfSpace, MaterialId, Mesh, Primitive, Shape, Solid};

/// A prism of six sides, as OpenSCAD's `$fn = 6` asks for; its radius is 1, its height 2.
fn prism() -> Shape {
    let corners = (0..6).map(|k| {
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_3;
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    });
    let corners: Vec<DVec3> = corners.collect();
    let side = |k: usize| {
        let normal = (corners[k] + corners[(k + 1) % 6]).normalize();
        HalfSpace { normal, offset: normal.dot(corners[k]) }
    };
    let caps = [DVec3::Z, DVec3::NEG_Z].map(|normal| HalfSpace { normal, offset: 1.0 });
    let bounds = Bounds::around(corners.iter().flat_map(|&c| [c - DVec3::Z, c + DVec3::Z]));
    Shape::Facets(Arc::new(Facets { faces: (0..6).map(side).chain(caps).collect(), bounds }))
}

/// Two tetrahedra that share an edge: not convex, and an edge of four triangles.
fn mesh() -> Shape {
    let points = [[0, 0, -1], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]]
        .map(|p| DVec3::from(p.map(f64::from)));
    let first = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    let second = [[0, 1, 4], [0, 1, 5], [0, 4, 5], [1, 4, 5]];
    Shape::Mesh(Arc::new(Mesh { points: points.to_vec(), triangles: [first, second].concat() }))
}

fn any_shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        3 => Just(Shape::Sphere),
        3 => Just(Shape::Cube),
        1 => Just(Shape::Cone { bottom: 1.0, top: 1.0 }),
        1 => Just(Shape::Cone { bottom: 1.0, top: 0.0 }),
        1 => Just(Shape::Cone { bottom: 0.25, top: 1.0 }),
        1 => Just(prism()),
        1 => Just(mesh()),
    ]
}

/// Quarter turns with signs and permuted axes, or any turn.
fn any_turn() -> impl Strategy<Value = DMat3> {
    let axes = prop::sample::select(vec![
        DMat3::IDENTITY,
        DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
        DMat3::from_cols(DVec3::NEG_X, DVec3::Z, DVec3::Y),
        DMat3::from_cols(DVec3::Z, DVec3::NEG_Y, DVec3::X),
    ]);
    prop_oneof![3 => axes, 1 => any_rotation()]
}

/// Any turn.
pub fn any_rotation() -> impl Strategy<Value = DMat3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| {
        let first = DVec3::new(1.0, y, z).normalize();
        let third = first.cross(DVec3::new(x, 1.1, y)).normalize();
        DMat3::from_cols(first, third.cross(first), third)
    })
}

fn any_primitive() -> impl Strategy<Value = Solid> {
    let grid = (-2_i32..=2, -2_i32..=2, -2_i32..=2);
    let sizes = (1_i32..=3, 1_i32..=3, 1_i32..=3);
    (any_shape(), any_turn(), grid, sizes).prop_map(|(shape, turn, (x, y, z), (a, b, c))| {
        let half = DVec3::new(f64::from(a), f64::from(b), f64::from(c)) / 2.0;
        let center = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) / 2.0;
        let map = DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(half), center);
        Solid::Primitive(Primitive::new(shape, map, MaterialId(0)))
    })
}

/// An expression of some primitives.
pub fn any_solid() -> impl Strategy<Value = Solid> {
    any_primitive().prop_recursive(3, 12, 3, |part| {
        let parts = prop::collection::vec(part, 1..=3);
        (parts, 0..3).prop_map(|(parts, operation)| match operation {
            0 => Solid::Union(parts),
            1 => Solid::Intersection(parts),
            _ => Solid::Difference(parts),
        })
    })
}

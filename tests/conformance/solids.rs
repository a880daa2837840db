//! Solids and scenes by hand.

use std::sync::Arc;

use ray13::math::{Bounds, DAffine3, DMat3, DVec3};
use ray13::scene::{
    BezierPatches, Facets, HalfSpace, Material, MaterialId, Mesh, Object, Primitive, Scene, Shape, Solid,
};

use crate::conformance::chance::Chance;

pub const CYLINDER: Shape = Shape::Cone { bottom: 1.0, top: 1.0 };
pub const CONE: Shape = Shape::Cone { bottom: 1.0, top: 0.0 };
pub const TRUNCATED_CONE: Shape = Shape::Cone { bottom: 0.25, top: 1.0 };

/// A prism of six sides; its radius is 1, its height 2.
pub fn prism() -> Shape {
    let corner = |k: u32| {
        let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::FRAC_PI_3);
        DVec3::new(cos, sin, 0.0)
    };
    let side = |k: u32| {
        let normal = (corner(k) + corner(k + 1)).normalize();
        HalfSpace { normal, offset: normal.dot(corner(k)) }
    };
    let caps = [DVec3::Z, DVec3::NEG_Z].map(|normal| HalfSpace { normal, offset: 1.0 });
    let bounds = Bounds::around((0..6).flat_map(|k| [corner(k) - DVec3::Z, corner(k) + DVec3::Z]));
    Shape::Facets(Arc::new(Facets { faces: (0..6).map(side).chain(caps).collect(), bounds }))
}

/// Two tetrahedra that share an edge: not convex, and an edge of four triangles.
pub fn mesh() -> Shape {
    let points = [[0, 0, -1], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]]
        .map(|p| DVec3::from(p.map(f64::from)));
    let first = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    let second = [[0, 1, 4], [0, 1, 5], [0, 4, 5], [1, 4, 5]];
    Shape::Mesh(Arc::new(Mesh { points: points.to_vec(), triangles: [first, second].concat() }))
}

/// Six patches around a cube whose sides bulge and dent: not convex.
pub fn pillow() -> Shape {
    let at = |i: usize| i as f64 / 1.5 - 1.0;
    let (mut points, mut patches) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for (side, height) in [(-1.0, 0.9), (1.0, -0.6)] {
            // Sides share their rims, which are bent as well: a point of the cube is moved by where it is.
            let bent = |i: usize| {
                let (a, b) = (at(i % 4), at(i / 4));
                let is_inner = [i % 4, i / 4].iter().all(|place| [1, 2].contains(place));
                let along = side * if is_inner { 1.0 + height } else { 1.0 };
                let mut p = [a, b, along];
                p.rotate_right(axis);
                let [x, y, z] = p;
                DVec3::new(x + 0.2 * y * z, y - 0.15 * z * z, z + 0.1 * x * y * y)
            };
            let first = points.len() as u32;
            points.extend((0..16).map(bent));
            patches.push(std::array::from_fn(|i| first + i as u32));
        }
    }
    let pillow = BezierPatches::new(&points, &patches);
    assert!(pillow.is_closed());
    Shape::Bezier(Arc::new(pillow))
}

/// A patch of any shape, and now and then with a side that is one point.
pub fn any_patch(chance: &mut Chance) -> Shape {
    let mut points: Vec<DVec3> = (0..16)
        .map(|i| DVec3::new(f64::from(i % 4), f64::from(i / 4), 0.0) / 1.5 - DVec3::new(1.0, 1.0, 0.0))
        .map(|p| p + chance.point() * 0.4)
        .collect();
    if chance.below(3) == 0 {
        let end = points[0];
        points[..4].fill(end);
    }
    Shape::Bezier(Arc::new(BezierPatches::new(&points, &[std::array::from_fn(|i| i as u32)])))
}

pub fn primitive(shape: &Shape, linear: DMat3, center: DVec3) -> Primitive {
    let map = DAffine3::from_mat3_translation(linear, center);
    Primitive::new(shape.clone(), map, MaterialId(0))
}

pub fn solid(shape: &Shape, linear: DMat3, center: DVec3) -> Solid {
    Solid::Primitive(primitive(shape, linear, center))
}

/// Along the axes.
pub fn placed(shape: &Shape, center: DVec3, half: DVec3) -> Solid {
    solid(shape, DMat3::from_diagonal(half), center)
}

pub fn scene(solids: impl IntoIterator<Item = Solid>) -> Scene {
    let objects = solids.into_iter().map(|solid| Object { name: None, solid }).collect();
    Scene { objects, materials: vec![Material::default()], ..Scene::default() }
}

/// The same solid with every primitive changed.
pub fn mapped(solid: &Solid, change: &impl Fn(&Primitive) -> Primitive) -> Solid {
    let all = |parts: &[Solid]| parts.iter().map(|part| mapped(part, change)).collect();
    match solid {
        Solid::Primitive(p) => Solid::Primitive(change(p)),
        Solid::Union(parts) => Solid::Union(all(parts)),
        Solid::Intersection(parts) => Solid::Intersection(all(parts)),
        Solid::Difference(parts) => Solid::Difference(all(parts)),
    }
}

/// The same solid moved.
pub fn moved(solid: &Solid, by: &DAffine3) -> Solid {
    mapped(solid, &|p| Primitive::new(p.shape.clone(), *by * p.map, p.material))
}

//! Closed meshes that are hard on whoever traces them.

use std::sync::Arc;

use ray13::math::{DAffine3, DVec3};
use ray13::scene::{Camera, FieldSpan, Material, MaterialId, Mesh, Object, Primitive, Scene, Shape, Solid};

/// A mesh under a name, and the size of its pictures: large ones are looked at through fewer dots.
#[derive(Debug)]
pub struct Nasty {
    pub name: &'static str,
    pub mesh: Mesh,
    pub dots: u32,
}

/// The middle of a mesh, and how long it is along its longest axis.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub middle: DVec3,
    pub size: f64,
}

/// A box whose sides are grids of `n` × `n` squares, each of two triangles in one plane with its neighbours.
fn grid_box(n: u32, half: DVec3, center: DVec3) -> Mesh {
    let mut mesh = Mesh { points: Vec::new(), triangles: Vec::new() };
    let mut number = std::collections::HashMap::new();
    let mut corner = |mesh: &mut Mesh, place: [u32; 3]| {
        *number.entry(place).or_insert_with(|| {
            let at = DVec3::from(place.map(|i| 2.0 * f64::from(i) / f64::from(n) - 1.0));
            mesh.points.push(center + half * at);
            mesh.points.len() as u32 - 1
        })
    };
    for axis in 0..3 {
        for side in [0, n] {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let at = |i: u32, j: u32| {
                    let mut place = [side; 3];
                    (place[(axis + 1) % 3], place[(axis + 2) % 3]) = (i, j);
                    place
                };
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                    .map(|place| corner(&mut mesh, place));
                let both = if side == 0 { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] };
                mesh.triangles.extend(both);
            }
        }
    }
    mesh
}

/// A ball with bumps, of about 4 n² triangles.
fn ball(n: u32, radius: f64, bump: f64) -> Mesh {
    let at = |i: u32, j: u32| {
        let (a, b) = (f64::from(i), f64::from(j));
        let (a, b) = (std::f64::consts::PI * a / f64::from(n), std::f64::consts::PI * b / f64::from(n));
        let r = radius * (1.0 + bump * libm::sin(8.0 * a) * libm::sin(8.0 * b));
        DVec3::new(libm::sin(a) * libm::cos(b), libm::sin(a) * libm::sin(b), libm::cos(a)) * r
    };
    let mut points = vec![at(0, 0), at(n, 0)];
    points.extend((1..n).flat_map(|i| (0..2 * n).map(move |j| (i, j))).map(|(i, j)| at(i, j)));
    let number = |i: u32, j: u32| match i {
        0 => 0,
        i if i == n => 1,
        i => 2 + (i - 1) * 2 * n + j % (2 * n),
    };
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..2 * n).map(move |j| (i, j))) {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        if i > 0 {
            triangles.push([a, b, d]);
        }
        if i < n - 1 {
            triangles.push([d, b, c]);
        }
    }
    Mesh { points, triangles }
}

/// Two fans of `n` triangles between two corners and a rim with teeth of this share of its radius.
fn fan(n: u32, teeth: f64) -> Mesh {
    let mut points = vec![DVec3::new(0.0, 0.0, 0.8), DVec3::new(0.1, 0.0, -0.3)];
    points.extend((0..n).map(|i| {
        let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / f64::from(n));
        DVec3::new(cos, sin, 0.1 * cos) * if i % 2 == 0 { 1.0 } else { 1.0 - teeth }
    }));
    let rim = |i: u32| 2 + i % n;
    let triangles = (0..n).flat_map(|i| [[0, rim(i), rim(i + 1)], [1, rim(i + 1), rim(i)]]).collect();
    Mesh { points, triangles }
}

/// A thin solid between three corners, and one of them moved by `off` times each axis, with a dent.
fn needle(off: f64) -> Mesh {
    let points = vec![
        DVec3::new(-1.0, 0.0, 0.0),
        DVec3::new(1.0, 0.1, 0.2),
        DVec3::new(1.0, 0.1 + off, 0.2),
        DVec3::new(1.0, 0.1, 0.2 + off),
        DVec3::new(0.5, 0.075 + 0.2 * off, 0.15 + 0.2 * off),
    ];
    Mesh { points, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]] }
}

/// Both as one mesh.
fn and(mut a: Mesh, b: &Mesh) -> Mesh {
    let first = a.points.len() as u32;
    a.points.extend(&b.points);
    a.triangles.extend(b.triangles.iter().map(|t| t.map(|i| i + first)));
    a
}

/// The same turned inside out.
fn inverted(mut mesh: Mesh) -> Mesh {
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    mesh
}

/// The same with all points moved.
fn moved(mut mesh: Mesh, by: impl Fn(DVec3) -> DVec3) -> Mesh {
    mesh.points.iter_mut().for_each(|p| *p = by(*p));
    mesh
}

/// All of them.
pub fn nasty() -> Vec<Nasty> {
    let cube = |n: u32, half: f64| grid_box(n, DVec3::splat(half), DVec3::ZERO);
    let of = |name: &'static str, mesh: Mesh| Nasty { name, mesh, dots: 17 };
    let mut all = vec![
        of("a bumpy ball", ball(12, 1.0, 0.1)),
        of("a grid of coplanar neighbours", cube(5, 1.0)),
        of("needle triangles", needle(1e-3)),
        of("needles thinner than single precision", needle(1e-8)),
        of("needles thinner than rounding", needle(1e-15)),
        of("a plate thinner than single precision", grid_box(5, DVec3::new(1.0, 1.0, 1e-9), DVec3::ZERO)),
        of("a plate thinner than rounding", grid_box(5, DVec3::new(1.0, 1.0, 1e-18), DVec3::ZERO)),
        of("teeth", fan(200, 0.5)),
        of("coordinates of 1e-12", moved(ball(10, 1.0, 0.1), |p| p * 1e-12)),
        of("coordinates of 1e12", moved(ball(10, 1.0, 0.1), |p| p * 1e12)),
        of("far from the origin", moved(ball(10, 1.0, 0.1), |p| p + DVec3::new(3e5, -1e5, 2e5))),
        of("a shell in a shell", and(cube(5, 1.0), &ball(8, 0.6, 0.1))),
        of("an inverted shell in a shell", and(cube(5, 1.0), &inverted(ball(8, 0.6, 0.1)))),
        of("two coincident shells", and(cube(5, 1.0), &cube(5, 1.0))),
        of("two coincident shells of other triangles", and(cube(5, 1.0), &cube(4, 1.0))),
        of("three coincident shells", and(and(cube(5, 1.0), &cube(4, 1.0)), &inverted(cube(5, 1.0)))),
        of("shells that cross", and(ball(9, 1.0, 0.1), &grid_box(5, DVec3::splat(0.6), DVec3::splat(0.5)))),
        of("inside out", inverted(ball(12, 1.0, 0.3))),
        of(
            "tiny triangles beside large ones",
            and(cube(5, 1.0), &moved(ball(5, 1e-6, 0.1), |p| p + 1.0 + 1e-5)),
        ),
        Nasty { name: "ten thousand triangles at a corner", mesh: fan(10_000, 1e-4), dots: 5 },
    ];
    for nasty in &mut all {
        // One more point that no triangle has must not matter.
        nasty.mesh.points.push(nasty.mesh.points[0]);
    }
    all
}

impl Nasty {
    /// The mesh as a scene of one object.
    pub fn scene(&self) -> Scene {
        let shape = Shape::Mesh(Arc::new(self.mesh.clone()));
        let solid = Solid::Primitive(Primitive::new(shape, DAffine3::IDENTITY, MaterialId(0)));
        Scene {
            objects: vec![Object { name: None, solid }],
            materials: vec![Material::default()],
            ..Scene::default()
        }
    }

    /// All but every seventh of its triangles, as a surface.
    pub fn open_scene(&self) -> Scene {
        let mut mesh = self.mesh.clone();
        let mut number = 0;
        mesh.triangles.retain(|_| {
            number += 1;
            number % 7 != 0
        });
        let solid =
            Solid::Primitive(Primitive::new(Shape::Sheet(Arc::new(mesh)), DAffine3::IDENTITY, MaterialId(0)));
        Scene { objects: vec![Object { name: None, solid }], ..self.scene() }
    }

    /// Where its triangles are.
    pub fn extent(&self) -> Extent {
        let points = &self.mesh.points;
        let used = self.mesh.triangles.iter().flatten().map(|&i| points[i as usize]);
        let (lo, hi) = used.fold((points[0], points[0]), |(lo, hi), p| (lo.min(p), hi.max(p)));
        Extent { middle: 0.5 * lo + 0.5 * hi, size: (hi - lo).max_element() }
    }

    /// Looks from outside at the middle and at a corner, from inside, and along an edge and a face.
    pub fn cameras(&self) -> Vec<Camera> {
        let (points, triangles) = (&self.mesh.points, &self.mesh.triangles);
        let Extent { middle, size } = self.extent();
        let [a, b, c] = triangles[triangles.len() / 3].map(|i| points[i as usize]);
        let out = middle + DVec3::new(2.1, -1.7, 1.3) * size;
        let pairs = [
            (out, middle),
            (out, a),
            (middle + DVec3::new(0.03, 0.02, -0.01) * size, 0.5 * a + 0.5 * b),
            (a + (a - b).normalize_or(DVec3::X) * size, b),
            (a + (2.0 * a - b - c).normalize_or(DVec3::X) * size, 0.5 * b + 0.5 * c),
        ];
        let seen = pairs.into_iter().filter(|(eye, target)| eye.distance(*target) > 1e-3 * size);
        seen.map(|(eye, target)| Camera {
            name: None,
            eye,
            target,
            up: DVec3::new(0.1, 0.2, 1.0),
            field: [35.0; 2],
            span: FieldSpan::Edges,
            zoom: 1.0,
        })
        .collect()
    }
}

//! Cases small enough to work out by hand.

use std::sync::Arc;

use ray13::math::{Bounds, DAffine3, DMat3, DVec3, Ray};
use ray13::scene::{Facets, HalfSpace, MaterialId, Mesh, Object, Primitive, Scene, Shape, Solid};

use super::{Big, Chord, Hit, Number, Oracle, Verdict, Wide, chord, point_at, silhouette, verdict};

fn solid(shape: Shape, map: DAffine3) -> Solid {
    Solid::Primitive(Primitive::new(shape, map, MaterialId(0)))
}

fn at(shape: Shape, center: DVec3, half: DVec3) -> Solid {
    solid(shape, DAffine3::from_mat3_translation(DMat3::from_diagonal(half), center))
}

fn scene(solids: impl IntoIterator<Item = Solid>) -> Scene {
    let objects = solids.into_iter().map(|solid| Object { name: None, solid }).collect();
    Scene { objects, ..Scene::default() }
}

fn hit(solids: impl IntoIterator<Item = Solid>, origin: DVec3, toward: DVec3) -> Option<Hit> {
    let scene = scene(solids);
    let wide = Oracle::<Wide>::new(&scene).hit(origin, toward);
    assert_eq!(wide, Oracle::<Big>::new(&scene).hit(origin, toward), "in both kinds of numbers");
    wide
}

#[track_caller]
fn assert_hit(found: Option<Hit>, t: f64, object: u32, normal: DVec3) {
    let found = found.expect("the ray meets the scene");
    assert!((found.t - t).abs() <= 1e-15 * t.abs(), "{found:?}, expected t = {t}");
    assert_eq!(found.object, object);
    assert!(found.normal.abs_diff_eq(normal, 1e-14), "{found:?}, expected {normal}");
}

const CONE: Shape = Shape::Cone { bottom: 1.0, top: 0.0 };
const CYLINDER: Shape = Shape::Cone { bottom: 1.0, top: 1.0 };

#[test]
fn a_sphere_at_a_distance() {
    let ball = || [at(Shape::Sphere, DVec3::ZERO, DVec3::splat(2.0))];
    let from = DVec3::new(0.0, -10.0, 0.0);
    assert_hit(hit(ball(), from, DVec3::Y), 8.0, 1, DVec3::NEG_Y);
    assert_hit(hit(ball(), from, DVec3::Y * 2.0), 4.0, 1, DVec3::NEG_Y);
    assert_eq!(hit(ball(), from, DVec3::NEG_Y), None);
    assert_eq!(hit(ball(), from + DVec3::X * 2.000_001, DVec3::Y), None);
    // From inside, the surface is met on leaving, and the normal is turned to the eye.
    assert_hit(hit(ball(), DVec3::ZERO, DVec3::X), 2.0, 1, DVec3::NEG_X);
    // 3-4-5: at height 1.2 the sphere of radius 2 is 1.6 wide.
    assert_hit(hit(ball(), from + DVec3::Z * 1.2, DVec3::Y), 8.4, 1, DVec3::new(0.0, -0.8, 0.6));
}

#[test]
fn a_sphere_a_million_radii_away() {
    let ball = [at(Shape::Sphere, DVec3::new(1e6, 0.0, 0.0), DVec3::ONE)];
    let found = hit(ball, DVec3::new(0.0, 0.6, 0.0), DVec3::X);
    assert_hit(found, 1e6 - 0.8, 1, DVec3::new(-0.8, 0.6, 0.0));
}

#[test]
fn an_ellipsoid_has_the_gradient_as_its_normal() {
    let half = DVec3::new(3.0, 2.0, 1.0);
    let point = DVec3::new(0.6 * 3.0, -0.8 * 2.0, 0.0);
    let found = hit([at(Shape::Sphere, DVec3::ZERO, half)], point - DVec3::Y, DVec3::Y);
    assert_hit(found, 1.0, 1, (point / (half * half)).normalize());
}

#[test]
fn a_cone_narrows_upwards_to_its_tip() {
    // Radius 1 at z = −1, 0 at z = 1: at z = 0 it is 0.5 wide, and its side rises 2 for 1.
    let cone = || [at(CONE, DVec3::ZERO, DVec3::ONE)];
    let side = DVec3::new(-2.0, 0.0, 1.0).normalize();
    assert_hit(hit(cone(), DVec3::new(-5.0, 0.0, 0.0), DVec3::X), 4.5, 1, side);
    assert_hit(hit(cone(), DVec3::new(0.25, 0.0, -3.0), DVec3::Z), 2.0, 1, DVec3::NEG_Z);
    // The other nappe is not part of the solid.
    assert_eq!(hit(cone(), DVec3::new(-5.0, 0.0, 1.5), DVec3::X), None);
    assert_hit(
        hit(cone(), DVec3::new(0.25, 0.0, 9.0), DVec3::NEG_Z),
        8.5,
        1,
        DVec3::new(2.0, 0.0, 1.0).normalize(),
    );
}

#[test]
fn a_drilled_cube_is_open() {
    let drilled = || {
        let hole = at(CYLINDER, DVec3::ZERO, DVec3::new(0.5, 0.5, 1.0));
        [Solid::Difference(vec![at(Shape::Cube, DVec3::ZERO, DVec3::ONE), hole])]
    };
    // The hole ends flush with the faces of the cube: nothing closes it.
    assert_eq!(hit(drilled(), DVec3::new(0.2, 0.1, 5.0), DVec3::NEG_Z), None);
    assert_hit(hit(drilled(), DVec3::new(0.8, 0.1, 5.0), DVec3::NEG_Z), 4.0, 1, DVec3::Z);
    // From inside the hole its wall is seen, with the normal towards the eye.
    assert_hit(hit(drilled(), DVec3::ZERO, DVec3::X), 0.5, 1, DVec3::NEG_X);
}

#[test]
fn regular_sets_have_no_skin() {
    let cube = || at(Shape::Cube, DVec3::ZERO, DVec3::ONE);
    let neighbour = at(Shape::Cube, DVec3::X * 2.0, DVec3::ONE);
    let from = DVec3::new(-5.0, 0.3, 0.2);
    assert_eq!(hit([Solid::Difference(vec![cube(), cube()])], from, DVec3::X), None);
    assert_eq!(hit([Solid::Intersection(vec![cube(), neighbour])], from, DVec3::X), None);
    assert_hit(hit([Solid::Intersection(vec![cube(), cube()])], from, DVec3::X), 4.0, 1, DVec3::NEG_X);
    assert_eq!(
        hit([Solid::Union(vec![]), Solid::Intersection(vec![]), Solid::Difference(vec![])], from, DVec3::X),
        None
    );
}

#[test]
fn of_two_that_coincide_the_first_shows() {
    let small = at(Shape::Cube, DVec3::X * 0.5, DVec3::new(0.5, 1.0, 1.0));
    let large = at(Shape::Cube, DVec3::X, DVec3::ONE);
    let far = at(Shape::Sphere, DVec3::X * 9.0, DVec3::ONE);
    let from = DVec3::new(-5.0, 0.3, 0.2);
    assert_hit(hit([far, small.clone(), large.clone()], from, DVec3::X), 5.0, 2, DVec3::NEG_X);
    // From inside both, the first end is met, although it lies within the other.
    assert_hit(hit([large, small], DVec3::new(0.5, 0.0, 0.0), DVec3::X), 0.5, 2, DVec3::NEG_X);
}

/// The corner of a cube: x, y, z ≥ 0 and x + y + z ≤ 1.
fn tetrahedron() -> (Shape, Shape) {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let bounds = Bounds::around(points.iter().copied());
    let slope = HalfSpace { normal: DVec3::ONE.normalize(), offset: DVec3::ONE.normalize().x };
    let axes = [DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let faces = axes.map(|normal| HalfSpace { normal, offset: 0.0 }).into_iter().chain([slope]).collect();
    // One triangle is turned the other way: either order is allowed.
    let triangles = vec![[0, 1, 2], [0, 1, 3], [0, 2, 3], [3, 1, 2]];
    (Shape::Facets(Arc::new(Facets { faces, bounds })), Shape::Mesh(Arc::new(Mesh { points, triangles })))
}

#[test]
fn facets_and_meshes_of_one_solid_agree() {
    let (facets, mesh) = tetrahedron();
    for shape in [facets, mesh] {
        let moved = || [at(shape.clone(), DVec3::new(0.0, 0.0, 1.0), DVec3::splat(2.0))];
        let slope = DVec3::ONE.normalize();
        assert_hit(hit(moved(), DVec3::new(0.5, 0.5, 9.0), DVec3::NEG_Z), 7.0, 1, slope);
        assert_hit(hit(moved(), DVec3::new(0.5, 0.25, -1.0), DVec3::Z), 2.0, 1, DVec3::NEG_Z);
        assert_eq!(hit(moved(), DVec3::new(1.5, 0.75, 9.0), DVec3::NEG_Z), None);
        assert_hit(hit(moved(), DVec3::new(0.25, 0.25, 1.25), DVec3::X), 1.25, 1, -slope);
    }
}

#[test]
fn a_mesh_inside_a_mesh_is_a_hollow() {
    let (_, mesh) = tetrahedron();
    let Shape::Mesh(mesh) = mesh else { unreachable!() };
    let inner = mesh.points.iter().map(|p| *p * 0.25 + DVec3::splat(0.0625));
    let points = mesh.points.iter().copied().chain(inner).collect();
    let shifted = mesh.triangles.iter().map(|t| t.map(|i| i + 4));
    let triangles = mesh.triangles.iter().copied().chain(shifted).collect();
    let hollow = [at(Shape::Mesh(Arc::new(Mesh { points, triangles })), DVec3::ZERO, DVec3::ONE)];
    // The hollow's own wall, from inside it.
    assert_hit(hit(hollow, DVec3::splat(0.125), DVec3::NEG_X), 0.0625, 1, DVec3::X);
}

#[test]
fn a_sheared_map_is_inverted() {
    // x' = x + z: the cube's left face is x − z = −1.
    let shear = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(1.0, 0.0, 1.0));
    let leaning = [solid(Shape::Cube, DAffine3::from_mat3(shear))];
    let found = hit(leaning, DVec3::new(-5.0, 0.0, 0.5), DVec3::X);
    assert_hit(found, 4.5, 1, DVec3::new(-1.0, 0.0, 1.0).normalize());
}

fn primitive(shape: Shape, half: DVec3) -> Primitive {
    Primitive::new(shape, DAffine3::from_scale(half), MaterialId(0))
}

#[test]
fn a_chord_is_rounded_once_from_whatever_far() {
    // From 1e9 radii away at height 0.6: 1e9 − 0.8 and 1e9 + 0.8, whose squares differ by 1 part in 1e18.
    let ball = primitive(Shape::Sphere, DVec3::ONE);
    let ray = Ray::new(DVec3::new(-1e9, 0.0, 0.6), DVec3::X);
    let found: Chord<Big> = chord(&ball, &ray).unwrap();
    // 0.6 is not six tenths: 1 − 0.6² is near 0.64 only.
    let half = (Big::from(1.0) - Big::from(0.6) * Big::from(0.6)).sqrt();
    assert_eq!(found.enter.t.value(), (Big::from(1e9) - half.clone()).value());
    assert_eq!(found.leave.t.value(), (Big::from(1e9) + half.clone()).value());
    assert!((found.leave.t.clone() - found.enter.t.clone() - half.clone() - half).abs() < Big::from(1e-150));
    assert!((point_at(&ray, &found.enter.t) - DVec3::new(-0.8, 0.0, 0.6)).length() < 1e-15);
    assert_eq!(silhouette::<Big>(&ball, &ray), Some(0.6));
    assert!((found.enter.tangent - 0.75).abs() < 1e-15, "{}", found.enter.tangent);
    // A scale and a ratio at which no square is an f64.
    let needle = primitive(Shape::Sphere, DVec3::new(1e300, 1e-300, 1e-300));
    let across = Ray::new(DVec3::new(0.0, -1e-299, 0.0), DVec3::Y);
    let found = chord::<Big>(&needle, &across).unwrap();
    assert_eq!(found.enter.t.value(), (Big::from(1e-299) - Big::from(1e-300)).value());
}

#[test]
fn a_chord_names_its_faces() {
    let faces = |shape: Shape, o: [f64; 3], d: [f64; 3]| {
        let found = chord::<Wide>(&primitive(shape, DVec3::ONE), &Ray::new(o.into(), d.into()))?;
        Some((found.enter.t.value(), found.enter.face, found.leave.t.value(), found.leave.face))
    };
    assert_eq!(faces(Shape::Cube, [-3.0, 0.1, 0.2], [1.0, 0.0, 0.0]), Some((2.0, 0, 4.0, 1)));
    assert_eq!(faces(Shape::Cube, [0.0, 0.1, 3.0], [0.0, 0.0, -1.0]), Some((2.0, 5, 4.0, 4)));
    assert_eq!(faces(CYLINDER, [0.0, 0.0, -3.0], [0.0, 0.0, 1.0]), Some((2.0, 1, 4.0, 2)));
    assert_eq!(faces(CYLINDER, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), Some((2.0, 0, 4.0, 0)));
    // Steeper than the side of the cone: in through the base, out through the side; and above its tip,
    // nothing.
    assert_eq!(faces(CONE, [0.25, 0.0, -3.0], [0.0, 0.0, 1.0]), Some((2.0, 1, 3.5, 0)));
    assert_eq!(faces(CONE, [-3.0, 0.0, 1.5], [1.0, 0.0, 0.0]), None);
    // A line that only touches is not inside.
    assert_eq!(faces(Shape::Sphere, [-3.0, 1.0, 0.0], [1.0, 0.0, 0.0]), None);
}

#[test]
fn a_silhouette_is_where_the_measure_is_one() {
    let l = |shape: Shape, o: [f64; 3], d: [f64; 3]| {
        silhouette::<Wide>(&primitive(shape, DVec3::splat(2.0)), &Ray::new(o.into(), d.into()))
    };
    assert_eq!(l(CYLINDER, [-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]), Some(0.5));
    assert_eq!(l(CYLINDER, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]), None);
    // At z = 0 the cone's radius is 1, half of its largest.
    assert_eq!(l(CONE, [-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]), Some(1.0));
    assert_eq!(l(CONE, [-5.0, 0.25, 0.0], [1.0, 0.0, 0.0]), Some(0.25));
    assert_eq!(l(Shape::Cube, [-5.0, 0.25, 0.0], [1.0, 0.0, 0.0]), None);
}

#[test]
fn a_verdict_leaves_the_rim_open() {
    for shape in [Shape::Sphere, Shape::Cube, CYLINDER, CONE] {
        let at_height = |y: f64| {
            let ray = Ray::new(DVec3::new(-9.0, y, -1.0 + 1e-3), DVec3::X);
            let lowered = if shape == Shape::Sphere { Ray::new(ray.o.with_z(0.0), ray.d) } else { ray };
            verdict::<Big>(&primitive(shape.clone(), DVec3::ONE), &lowered, DVec3::splat(1e-2))
        };
        // The caps are that near too, and the cone is a little narrower there.
        let within = if shape == Shape::Sphere { Verdict::Hit } else { Verdict::Either };
        assert_eq!(at_height(0.98), within, "{shape:?}");
        assert_eq!([at_height(0.999), at_height(1.001)], [Verdict::Either; 2], "{shape:?}");
        assert_eq!(at_height(1.02), Verdict::Miss, "{shape:?}");
    }
    let behind = Ray::new(DVec3::new(9.0, 0.0, 0.0), DVec3::X);
    assert_eq!(
        verdict::<Big>(&primitive(Shape::Sphere, DVec3::ONE), &behind, DVec3::splat(1e-2)),
        Verdict::Miss
    );
}

#[test]
fn near_faces_are_two_beside_anything_large() {
    // A plate of 1e-9, cut out of a cube so that a gap is left, beside a ball of radius 1000.
    let plate = at(Shape::Cube, DVec3::ZERO, DVec3::new(1.0, 1.0, 5e-10));
    let ball = at(Shape::Sphere, DVec3::X * 2000.0, DVec3::splat(1000.0));
    let found = hit([plate, ball], DVec3::new(0.2, 0.1, -1.0), DVec3::Z);
    assert_hit(found, 1.0 - 5e-10, 1, DVec3::NEG_Z);
}

#[test]
fn what_is_of_no_account_is_the_caller_s_to_say() {
    let scene = scene([Solid::Difference(vec![
        at(Shape::Cube, DVec3::ZERO, DVec3::ONE),
        at(Shape::Cube, DVec3::ZERO, DVec3::new(1.0, 1.0, 1.0 - f64::EPSILON)),
    ])]);
    let hit = |tolerance| {
        let oracle = Oracle::<Big>::with_tolerance(&scene, tolerance);
        oracle.hit(DVec3::new(0.2, 0.1, 5.0), DVec3::NEG_Z).map(|hit| (hit.t, hit.primitive, hit.entering))
    };
    assert_eq!(hit(1.0), None);
    assert_eq!(hit(0.0), Some((4.0, 0, Some(true))));
}

#[test]
fn normals_keep_their_length_at_any_scale() {
    let (_, mesh) = tetrahedron();
    for scale in [1e-150, 1e-80, 1e80, 1e150] {
        for shape in [mesh.clone(), Shape::Sphere, CONE] {
            let scaled = at(shape, DVec3::ZERO, DVec3::splat(scale));
            let from = DVec3::new(0.2, 0.1, -5.0) * scale;
            let found = hit([scaled], from, DVec3::Z).unwrap();
            assert!((found.normal.length() - 1.0).abs() < 1e-15 && found.normal.z < 0.0, "{found:?}");
        }
    }
}

//! Cases small enough to work out by hand.

use std::sync::Arc;

use ray13::math::{Bounds, DAffine3, DMat3, DVec3};
use ray13::scene::{Facets, HalfSpace, MaterialId, Mesh, Object, Primitive, Scene, Shape, Solid};

use super::{Brute, Hit};

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
    Brute::new(&scene).hit(origin, toward)
}

#[track_caller]
fn assert_hit(found: Option<Hit>, t: f64, object: u32, normal: DVec3) {
    let found = found.expect("the ray meets the scene");
    assert!((found.t - t).abs() <= 1e-15 * t.abs(), "{found:?}, expected t = {t}");
    assert_eq!(found.object, object);
    assert!(found.normal.abs_diff_eq(normal, 1e-14), "{found:?}, expected {normal}");
}

const CONE: Shape = Shape::Frustum { bottom: 1.0, top: 0.0 };
const CYLINDER: Shape = Shape::Frustum { bottom: 1.0, top: 1.0 };

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

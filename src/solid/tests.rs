//! Small cases of rays against solids, worked out by hand.

use super::*;
use crate::math::{DAffine3, DVec3, Ray};
use crate::scene;
use crate::stage::{Meter, Silent};

fn primitive(shape: scene::Shape, map: DAffine3) -> scene::Solid {
    scene::Solid::Primitive(scene::Primitive::new(shape, map, scene::MaterialId(0)))
}

fn cube(center: [f64; 3], half: [f64; 3]) -> scene::Solid {
    let map = DAffine3::from_translation(DVec3::from(center)) * DAffine3::from_scale(DVec3::from(half));
    primitive(scene::Shape::Cube, map)
}

fn drum(center: [f64; 3], radius: f64, half: f64) -> scene::Solid {
    let map = DAffine3::from_translation(DVec3::from(center))
        * DAffine3::from_scale(DVec3::new(radius, radius, half));
    primitive(scene::Shape::Cone { bottom: 1.0, top: 1.0 }, map)
}

fn sphere(center: [f64; 3], radius: f64) -> scene::Solid {
    let map = DAffine3::from_translation(DVec3::from(center)) * DAffine3::from_scale(DVec3::splat(radius));
    primitive(scene::Shape::Sphere, map)
}

fn turned(solid: &scene::Solid, about: DAffine3) -> scene::Solid {
    use scene::Solid::{Difference, Intersection, Primitive, Union};
    let all = |c: &[scene::Solid]| c.iter().map(|s| turned(s, about)).collect();
    match solid {
        Primitive(p) => Primitive(scene::Primitive::new(p.shape.clone(), about * p.map, p.material)),
        Union(c) => Union(all(c)),
        Intersection(c) => Intersection(all(c)),
        Difference(c) => Difference(all(c)),
    }
}

/// The first crossing, in the scene's unit.
fn first(solid: &scene::Solid, o: [f64; 3], d: [f64; 3]) -> Option<(f64, u32, bool)> {
    let scene = scene::Scene {
        objects: vec![scene::Object { name: None, solid: solid.clone() }],
        materials: vec![scene::Material::default()],
        ..scene::Scene::default()
    };
    let assembly = Assembly::new(&scene).unwrap();
    let object = assembly.objects.first()?;
    let ray = assembly.ray(&Ray::new(DVec3::from(o), DVec3::from(d).normalize()));
    let mut meter = Meter::new(Silent);
    let found = match &object.body {
        Body::Single(index) => {
            first_of_span(&ray, &assembly.primitives[*index as usize], *index, None, &mut meter)
        }
        Body::Surface(index) => {
            first_of_surface(&ray, &assembly.primitives[*index as usize], *index, None, &mut meter)
        }
        Body::Composite { whole, .. } => first_of_expression(
            &ray,
            &**whole,
            &assembly.primitives,
            None,
            TRange::ALL,
            &mut Scratch::default(),
            &mut meter,
        ),
    };
    found.map(|c| (c.t * assembly.scene_frame.unit, c.primitive, c.entering))
}

fn rotations() -> [DAffine3; 3] {
    [
        DAffine3::IDENTITY,
        DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7),
        DAffine3::from_axis_angle(DVec3::new(-3.0, 1.0, 0.5).normalize(), 2.9),
    ]
}

/// Rays at a solid near the origin from all around.
fn rays() -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    (0..400).map(|i| {
        // Golden-angle steps around a sphere of directions, aimed at points near the middle.
        let z = 1.0 - (f64::from(i) + 0.5) / 200.0;
        let (sin, cos) = libm::sincos(2.399_963 * f64::from(i));
        let r = (1.0 - z * z).sqrt();
        let o = DVec3::new(r * cos, r * sin, z) * 7.0;
        let aim = DVec3::new(sin * z, cos * r, sin * cos) * 0.9;
        (o.to_array(), (aim - o).to_array())
    })
}

#[test]
fn a_drilled_cube_is_open_where_it_is_drilled() {
    let drilled = scene::Solid::Difference(vec![cube([0.0; 3], [1.0; 3]), drum([0.0; 3], 0.5, 1.0)]);
    assert_eq!(first(&drilled, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0]), None);
    assert_eq!(first(&drilled, [0.7, 0.7, 5.0], [0.0, 0.0, -1.0]).unwrap().0, 4.0);
    let (t, shown, entering) = first(&drilled, [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]).unwrap();
    assert!((t - 0.5).abs() < 1e-15 && shown == 1 && entering, "{t} {shown} {entering}");
}

#[test]
fn a_solid_minus_itself_is_nothing() {
    let solids = [cube([0.0; 3], [1.0; 3]), sphere([0.1, 0.2, 0.3], 1.0), drum([0.0; 3], 0.9, 1.1)];
    for solid in &solids {
        for about in rotations() {
            let solid = turned(solid, about);
            let nothing = scene::Solid::Difference(vec![solid.clone(), solid.clone()]);
            for (o, d) in rays() {
                assert_eq!(first(&nothing, o, d), None);
            }
        }
    }
}

#[test]
fn a_solid_joined_or_met_with_itself_is_the_solid_and_the_first_shows() {
    let solids = [cube([0.0; 3], [1.0; 3]), sphere([0.1, 0.2, 0.3], 1.0), drum([0.0; 3], 0.9, 1.1)];
    for solid in &solids {
        for about in rotations() {
            let solid = turned(solid, about);
            let pair = vec![solid.clone(), solid.clone()];
            for (o, d) in rays() {
                let alone = first(&solid, o, d);
                assert_eq!(first(&scene::Solid::Union(pair.clone()), o, d), alone);
                assert_eq!(first(&scene::Solid::Intersection(pair.clone()), o, d), alone);
            }
        }
    }
}

#[test]
fn coincident_faces_show_the_first_that_still_stands_there() {
    // X is cut away whole; Y lies where X was.
    let x = cube([0.0; 3], [1.0; 3]);
    let gone = scene::Solid::Difference(vec![x.clone(), cube([0.0; 3], [2.0; 3])]);
    let both = scene::Solid::Union(vec![gone, x]);
    let (t, shown, entering) = first(&both, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0]).unwrap();
    assert_eq!((t, shown, entering), (4.0, 2, true));
}

#[test]
fn a_viewpoint_inside_sees_the_far_wall() {
    let room = cube([0.0; 3], [1.0; 3]);
    assert_eq!(first(&room, [0.0; 3], [1.0, 0.0, 0.0]), Some((1.0, 0, false)));
    let hollow = scene::Solid::Difference(vec![room, sphere([0.0; 3], 0.5)]);
    assert_eq!(first(&hollow, [0.0; 3], [1.0, 0.0, 0.0]), Some((0.5, 1, true)));
}

#[test]
fn a_cone_is_met_on_its_own_nappe_only() {
    let cone = primitive(scene::Shape::Cone { bottom: 1.0, top: 0.0 }, DAffine3::IDENTITY);
    // Above the apex, where the other nappe would be.
    assert_eq!(first(&cone, [-5.0, 0.0, 1.5], [1.0, 0.0, 0.0]), None);
    let (t, _, _) = first(&cone, [-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]).unwrap();
    assert!((t - 4.5).abs() < 1e-14, "{t}");
    // Down the axis, through the apex, and along the side.
    assert_eq!(first(&cone, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0]).unwrap().0, 4.0);
    let (t, _, _) = first(&cone, [0.25, 0.0, 5.0], [0.0, 0.0, -1.0]).unwrap();
    assert!((t - 4.5).abs() < 1e-14, "{t}");
}

#[test]
fn a_tangent_ray_meets_nothing() {
    assert_eq!(first(&sphere([0.0; 3], 1.0), [-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]), None);
    assert_eq!(first(&drum([0.0; 3], 1.0, 1.0), [-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]), None);
}

#[test]
fn of_two_boxes_that_share_a_face_exactly_one_claims_a_ray_in_it() {
    let (left, right) = (cube([-0.5, 0.0, 0.0], [0.5, 1.0, 1.0]), cube([0.5, 0.0, 0.0], [0.5, 1.0, 1.0]));
    let claims = [&left, &right].map(|b| first(b, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0]).is_some());
    assert_eq!(claims, [false, true]);
}

/// With a hollow, so that it is a mesh to us, too.
fn tetrahedron() -> scene::Solid {
    let outer = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let points = outer.into_iter().chain(outer.map(|p| 0.25 * p + 0.0625)).collect();
    let triangles: Vec<[u32; 3]> = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let inner = triangles.iter().map(|t| t.map(|i| i + 4));
    let triangles = triangles.iter().copied().chain(inner).collect();
    primitive(scene::Shape::Mesh(std::sync::Arc::new(scene::Mesh { points, triangles })), DAffine3::IDENTITY)
}

#[test]
fn a_mesh_is_closed_at_its_edges_and_corners() {
    let solid = tetrahedron();
    // Through the middle of an edge, through a corner, along an edge, in the plane of a face.
    assert_eq!(first(&solid, [-1.0, 0.2, 0.2], [1.0, 0.0, 0.0]).map(|f| f.2), Some(true));
    for (o, d) in [
        ([0.5, 0.0, -3.0], [0.0, 0.0, 1.0]),
        ([0.0, 0.0, -3.0], [0.0, 0.0, 1.0]),
        ([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.25, 0.25, -3.0], [0.0, 0.0, 1.0]),
    ] {
        let scene = scene::Scene {
            objects: vec![scene::Object { name: None, solid: solid.clone() }],
            ..scene::Scene::default()
        };
        let assembly = Assembly::new(&scene).unwrap();
        let ray = assembly.ray(&Ray::new(DVec3::from(o), DVec3::from(d)));
        let mut crossings = 0;
        assembly.primitives[0].form.crossings(&ray, |_| crossings += 1);
        assert_eq!(crossings % 2, 0, "{o:?} {d:?}");
    }
}

#[test]
fn pruning_keeps_what_a_point_sees() {
    use crate::math::Bounds;
    let solid = scene::Solid::Difference(vec![
        scene::Solid::Union(vec![cube([0.0; 3], [1.0; 3]), sphere([1.0, 0.0, 0.0], 0.8)]),
        drum([0.0; 3], 0.5, 3.0),
        sphere([1.5, 0.0, 0.0], 0.4),
    ]);
    let scene =
        scene::Scene { objects: vec![scene::Object { name: None, solid }], ..scene::Scene::default() };
    let assembly = Assembly::new(&scene).unwrap();
    let Body::Composite { whole, .. } = &assembly.objects[0].body else { panic!("a composite") };
    let at = |x: f64, y: f64, z: f64| {
        let p = assembly.scene_frame.inward(DVec3::new(x, y, z));
        let (b, mut remains) = (Bounds::new(p - 1e-3, p + 1e-3), PrunedExpr::default());
        let whole = ExprView::from(&**whole);
        let found = whole.pruned(&assembly.primitives, &b, &mut Pruning::default(), &mut remains);
        (found, Expression::from(&remains))
    };
    assert_eq!(at(0.0, 0.0, 0.0).0, Classification::Outside);
    assert_eq!(at(0.7, 0.7, 0.0).0, Classification::Inside);
    // Above the sphere, the cube's face alone is left.
    assert_eq!(at(1.0, 0.9, 0.0), (Classification::Mixed, Expression::new(&CsgTree::Leaf(0))));
}

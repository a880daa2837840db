//! Random faces, patches and tubes among balls, against the oracle's calculation.

use std::sync::Arc;

use crate::support::cases::cases;
use crate::support::oracle::{Oracle, Wide};
use crate::support::oracle_agreement::compare;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use ray13::frame::Studio;
use ray13::math::{DAffine3, DMat3, DVec3, Size};
use ray13::scene::{Camera, Corner, FieldSpan, Material, MaterialId, Object, Primitive, Scene, Shape, Solid};

const DOTS: Size = Size::new(24, 24);

fn any_rotation() -> impl Strategy<Value = DMat3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| {
        let first = DVec3::new(1.0, y, z).normalize();
        let third = first.cross(DVec3::new(x, 1.1, y)).normalize();
        DMat3::from_cols(first, third.cross(first), third)
    })
}

/// A star of corners about the origin: concave wherever a corner lies nearer than its neighbours.
fn any_face() -> impl Strategy<Value = Shape> {
    prop::collection::vec(0.2..2.0, 3..90).prop_map(|radii| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(i, &r): (usize, &f64)| {
            let (sin, cos) = libm::sincos(step * i as f64);
            DVec3::new(r * cos, r * sin, 0.0)
        };
        Shape::Face(radii.iter().enumerate().map(corner).collect())
    })
}

/// A triangle whose corners' normals lean.
fn any_patch() -> impl Strategy<Value = Shape> {
    let lean = || (-1.0..1.0_f64, -1.0..1.0_f64);
    (0.2..2.0_f64, 0.2..2.0_f64, [lean(), lean(), lean()], any::<bool>()).prop_map(
        |(a, b, leans, flipped)| {
            let places = [DVec3::new(-a, -0.7, 0.0), DVec3::new(b, -0.9, 0.0), DVec3::new(0.1, 1.4, 0.0)];
            let corner = |i: usize| {
                let (x, y) = leans[i];
                let normal = DVec3::new(x, y, if flipped { -1.0 } else { 1.0 });
                Corner { place: places[i], normal }
            };
            Shape::Patch(Arc::new([0, 1, 2].map(corner)))
        },
    )
}

fn any_part() -> impl Strategy<Value = Solid> {
    let tube = |bottom, top| Just(Shape::Tube { bottom, top });
    let shape = prop_oneof![
        3 => any_face(),
        2 => any_patch(),
        1 => tube(1.0, 1.0),
        1 => tube(1.0, 0.0),
        1 => tube(0.25, 1.0),
        1 => Just(Shape::Sphere),
    ];
    let place = (-1.5..1.5, -1.5..1.5, -1.5..1.5);
    let sizes = (0.3..1.5, 0.3..1.5, 0.3..1.5);
    (shape, any_rotation(), place, sizes).prop_map(|(shape, turn, (x, y, z), (a, b, c))| {
        let linear = turn * DMat3::from_diagonal(DVec3::new(a, b, c));
        let map = DAffine3::from_mat3_translation(linear, DVec3::new(x, y, z));
        Solid::Primitive(Primitive::new(shape, map, MaterialId(0)))
    })
}

fn any_scene() -> impl Strategy<Value = Vec<Solid>> {
    prop::collection::vec(any_part(), 1..=5)
}

fn assert_agrees(solids: &[Solid], scale: f64, eye: DVec3, zoom: f64) -> Result<(), TestCaseError> {
    let scaled = |solid: &Solid| match solid {
        Solid::Primitive(p) => {
            let map = DAffine3::from_scale(DVec3::splat(scale)) * p.map;
            Solid::Primitive(Primitive::new(p.shape.clone(), map, p.material))
        }
        other => other.clone(),
    };
    let objects = solids.iter().map(|solid| Object { name: None, solid: scaled(solid) }).collect();
    let scene = Scene { objects, materials: vec![Material::default()], ..Scene::default() };
    let studio = Studio::new(scene).unwrap();
    let oracle = Oracle::<Wide>::new(studio.scene());
    let camera = Camera {
        name: None,
        eye: eye * scale,
        target: DVec3::new(0.1, 0.05, -0.07) * scale,
        up: DVec3::new(0.1, 0.2, 1.0),
        field: [40.0, 40.0],
        span: FieldSpan::Edges,
        zoom,
    };
    let comparison = compare(&studio, &oracle, &camera, DOTS);
    prop_assert!(comparison.faults.is_empty(), "{}", comparison.first_faults());
    Ok(())
}

fn any_direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z + 1.5).normalize())
}

proptest! {
    // The same cases each time: a test that fails tells of the change before it.
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(13), ..cases(120) })]

    #[test]
    fn surfaces_agree_at_any_scale(
        solids in any_scene(),
        exponent in -9_i32..=9,
        direction in any_direction(),
    ) {
        assert_agrees(&solids, libm::pow(10.0, f64::from(exponent)), direction * 9.0, 1.0)?;
    }

    #[test]
    fn surfaces_agree_from_within(solids in any_scene(), x in -1.5..1.5, y in -1.5..1.5, z in -1.5..1.5) {
        assert_agrees(&solids, 1.0, DVec3::new(x, y, z), 0.5)?;
    }

    #[test]
    fn surfaces_agree_from_afar(solids in any_scene(), direction in any_direction(), exponent in 1_i32..=6) {
        let far = libm::pow(10.0, f64::from(exponent));
        assert_agrees(&solids, 1.0, direction * 9.0 * far, far)?;
    }
}

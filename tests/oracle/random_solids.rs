//! The tracer against the oracle's calculation, on expressions that nobody would draw: small numbers on a
//! coarse grid, so that faces are flush, edges meet and solids coincide, and then the whole of it turned.

use crate::support::anything::{any_rotation, any_solid};
use crate::support::cases::cases;
use crate::support::oracle::{Oracle, Wide};
use crate::support::oracle_agreement::compare;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use ray13::frame::Studio;
use ray13::math::{DAffine3, DVec3, Size};
use ray13::scene::{Camera, FieldSpan, Material, Object, Primitive, Scene, Solid};

const DOTS: Size = Size::new(24, 24);

/// The same solid moved by a map.
fn moved(solid: &Solid, by: &DAffine3) -> Solid {
    let all = |parts: &[Solid]| parts.iter().map(|part| moved(part, by)).collect();
    match solid {
        Solid::Primitive(p) => Solid::Primitive(Primitive::new(p.shape.clone(), *by * p.map, p.material)),
        Solid::Union(parts) => Solid::Union(all(parts)),
        Solid::Intersection(parts) => Solid::Intersection(all(parts)),
        Solid::Difference(parts) => Solid::Difference(all(parts)),
    }
}

fn scene(solids: &[Solid], by: &DAffine3) -> Scene {
    let objects = solids.iter().map(|solid| Object { name: None, solid: moved(solid, by) }).collect();
    Scene { objects, materials: vec![Material::default()], ..Scene::default() }
}

/// Looks from a point, given before the map, at about the middle.
fn camera(eye: DVec3, zoom: f64, by: &DAffine3) -> Camera {
    let eye = by.transform_point3(eye);
    let target = by.transform_point3(DVec3::new(0.1, 0.05, -0.07));
    Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 0.2, 1.0),
        field: [40.0, 40.0],
        span: FieldSpan::Edges,
        zoom,
    }
}

/// Far enough away to see all that can be on the grid.
const OUTSIDE: f64 = 9.0;

fn assert_agrees(solids: &[Solid], by: &DAffine3, eye: DVec3, zoom: f64) -> Result<(), TestCaseError> {
    let studio = Studio::new(scene(solids, by)).unwrap();
    let oracle = Oracle::<Wide>::new(studio.scene());
    let comparison = compare(&studio, &oracle, &camera(eye, zoom, by), DOTS);
    prop_assert!(comparison.faults.is_empty(), "{}", comparison.first_faults());
    Ok(())
}

fn any_solids() -> impl Strategy<Value = Vec<Solid>> {
    prop::collection::vec(any_solid(), 1..=3)
}

fn any_direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z + 1.5).normalize())
}

proptest! {
    // The same cases each time: a test that fails tells of the change before it.
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(13), ..cases(160) })]

    #[test]
    fn agree_as_they_stand(solids in any_solids(), direction in any_direction()) {
        assert_agrees(&solids, &DAffine3::IDENTITY, direction * OUTSIDE, 1.0)?;
    }

    #[test]
    fn agree_when_turned_and_scaled(
        solids in any_solids(),
        turn in any_rotation(),
        exponent in -9_i32..=9,
        direction in any_direction(),
    ) {
        let by = DAffine3::from_mat3(turn * libm::pow(10.0, f64::from(exponent)));
        assert_agrees(&solids, &by, direction * OUTSIDE, 1.0)?;
    }

    #[test]
    fn agree_from_within(
        solids in any_solids(),
        x in -1.5..1.5,
        y in -1.5..1.5,
        z in -1.5..1.5,
    ) {
        assert_agrees(&solids, &DAffine3::IDENTITY, DVec3::new(x, y, z), 0.5)?;
    }

    #[test]
    fn agree_from_afar(solids in any_solids(), direction in any_direction(), exponent in 1_i32..=6) {
        let far = libm::pow(10.0, f64::from(exponent));
        assert_agrees(&solids, &DAffine3::IDENTITY, direction * OUTSIDE * far, far)?;
    }
}

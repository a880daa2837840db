//! The tracer against the oracle's calculation: OpenSCAD's examples, and the scenes inside the program. No dot may
//! be hit by one and missed by the other, and their depths agree to nine digits.

mod agreement;
mod oracle;
mod rays;
mod request;
mod scenery;

use std::path::{Path, PathBuf};

use agreement::compare;
use oracle::{Oracle, Wide};
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::scene::{Camera, ReadOptions, Scene, read_file};
use scenery::embedded_scenes;

const DOTS: Size = Size::new(96, 64);

/// OpenSCAD's examples are not part of this repository; they may stand beside it.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/scenes/openscad")
}

/// The scene's own framing and the same distance from other sides: along an axis, where faces are edge on and
/// surfaces line up; from below; near; and from the middle of the scene outwards.
fn views(studio: &Studio) -> Vec<(&'static str, Camera)> {
    let framed = studio.camera(usize::MAX, f64::from(DOTS.width) / f64::from(DOTS.height));
    let distance = framed.eye.distance(framed.target);
    let from = |direction: DVec3, share: f64| {
        let eye = framed.target + direction.normalize() * distance * share;
        let up = if direction.normalize().z.abs() > 0.99 { DVec3::Y } else { DVec3::Z };
        Camera { eye, up, ..framed.clone() }
    };
    let inside = Camera { eye: framed.target, target: framed.eye, ..framed.clone() };
    vec![
        ("along -x", from(DVec3::X, 1.0)),
        ("along -z", from(DVec3::Z, 1.0)),
        ("oblique", from(DVec3::new(1.0, 2.0, 3.0), 1.0)),
        ("below, far", from(DVec3::new(-2.0, 1.0, -1.5), 20.0)),
        ("near", from(DVec3::new(0.3, -1.0, 0.4), 0.6)),
        ("inside", inside),
        ("framed", framed),
    ]
}

/// Panics with the first dots where the tracer and the oracle disagree.
fn assert_agrees(name: &str, scene: Scene) {
    let studio = Studio::new(scene).unwrap();
    let oracle = Oracle::<Wide>::new(studio.scene());
    let own = studio.scene().views.iter().map(|camera| ("own view", camera.clone()));
    let mut hits = 0;
    for (view, camera) in views(&studio).into_iter().chain(own) {
        let comparison = compare(&studio, &oracle, &camera, DOTS);
        assert!(comparison.faults.is_empty(), "{name}, {view}: {}", comparison.first_faults());
        hits += comparison.hits;
    }
    assert!(hits > 0, "{name}: no ray meets it");
}

/// OpenSCAD's examples, a test each.
macro_rules! examples {
    ($($test:ident: $file:literal,)*) => {
        const EXAMPLES: &[&str] = &[$($file),*];
        $(#[test]
        fn $test() {
            let path = folder().join($file);
            if !folder().exists() {
                println!("skipped: ../shared/scenes is not here");
                return;
            }
            let scene = read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
            assert_agrees($file, scene);
        })*
    };
}

examples! {
    csg: "CSG.csg",
    csg_modules: "CSG-modules.csg",
    example001: "example001.csg",
    example002: "example002.csg",
    example003: "example003.csg",
    example004: "example004.csg",
    example005: "example005.csg",
    example014: "example014.csg",
    example019: "example019.csg",
}

#[test]
fn every_example_has_a_test() {
    let Ok(entries) = folder().read_dir() else {
        println!("skipped: ../shared/scenes is not here");
        return;
    };
    let mut found: Vec<String> =
        entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    found.sort();
    let mut tested = EXAMPLES.to_vec();
    tested.sort_unstable();
    assert_eq!(found, tested);
}

#[test]
fn the_scenes_inside_the_program() {
    for (name, scene) in embedded_scenes() {
        assert_agrees(name, scene);
    }
}

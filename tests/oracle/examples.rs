//! The tracer against the oracle's calculation: OpenSCAD's examples, and the scenes inside the program. No
//! dot may be hit by one and missed by the other, and their depths agree to nine digits.

use std::path::{Path, PathBuf};

use crate::support::beside;
use crate::support::oracle::{Oracle, Wide};
use crate::support::oracle_agreement::compare;
use crate::support::scenery::embedded_scenes;
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::scene::{Camera, FieldSpan, ReadOptions, Scene, read_file};

const DOTS: Size = Size::new(66, 44);

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
    // The oracle's rays are those of a field between edges; NFF's is one between centres.
    let own = studio.scene().views.iter().map(|camera| Camera { span: FieldSpan::Edges, ..camera.clone() });
    let own = own.map(|camera| ("own view", camera));
    let mut hits = 0;
    for (view, camera) in views(&studio).into_iter().chain(own) {
        let comparison = compare(&studio, &oracle, &camera, DOTS);
        assert!(comparison.faults.is_empty(), "{name}, {view}: {}", comparison.first_faults());
        hits += comparison.hits;
    }
    assert!(hits > 0, "{name}: no ray meets it");
}

fn from_file(path: &Path) -> Scene {
    read_file(path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// A file of this repository's own.
fn own(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

/// OpenSCAD's examples, a test each, where they stand beside this repository.
macro_rules! examples {
    ($($test:ident: $file:literal,)*) => {
        const EXAMPLES: &[&str] = &[$($file),*];
        $(#[test]
        fn $test() {
            if let Some(path) = beside::path(concat!("openscad/", $file)) {
                assert_agrees($file, from_file(&path));
            }
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
    if beside::path("openscad").is_none() {
        return;
    }
    let names = beside::files("openscad").into_iter().map(|path| path.file_name().unwrap().to_owned());
    let mut tested = EXAMPLES.to_vec();
    tested.sort_unstable();
    assert_eq!(names.collect::<Vec<_>>(), tested);
}

#[test]
fn a_part_as_openscad_exports_it() {
    assert_agrees("bracket.csg", from_file(&own("bracket.csg")));
}

#[test]
fn surfaces_and_balls_of_nff() {
    for name in ["balls.nff", "surfaces.nff"] {
        assert_agrees(name, from_file(&own(name)));
    }
}

/// The scenes inside the program, a test each.
macro_rules! embedded {
    ($($scene:ident,)*) => {
        const EMBEDDED: &[&str] = &[$(stringify!($scene)),*];
        $(#[test]
        fn $scene() {
            let (name, scene) = embedded_scenes().into_iter().find(|s| s.0 == stringify!($scene)).unwrap();
            assert_agrees(name, scene);
        })*
    };
}

embedded! {
    bolt,
    die,
    glass,
    hanyang,
    mirrors,
    teapot,
    temple,
}

#[test]
fn every_scene_inside_has_a_test() {
    let mut names: Vec<_> = embedded_scenes().into_iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    assert_eq!(names, EMBEDDED);
}

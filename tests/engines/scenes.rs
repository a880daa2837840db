//! Scenes as people write them: those inside the program, OpenSCAD's examples and the standard scenes of
//! 1987.

use std::path::Path;

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{Camera, ReadOptions, Scene, read_file};

use crate::support::agreement::assert_same_picture;
use crate::support::beside;
use crate::support::request::request;
use crate::support::same::{exact, fast};
use crate::support::scenery::embedded_scenes;

/// Several tiles, those at the rim cut.
const DOTS: Size = Size::new(67, 45);

/// The first view, one from above the other side, and one from within, backwards.
pub fn views(studio: &Studio) -> [(&'static str, Camera); 3] {
    let own = studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height));
    let away = own.eye - own.target;
    let round = DVec3::new(-away.y, away.x, away.z.abs() + 0.5 * away.length());
    let above = Camera { eye: own.target + round, ..own.clone() };
    let within = Camera { eye: own.target + 0.05 * round, target: own.target - round, ..own.clone() };
    [("its own view", own), ("from above", above), ("from within", within)]
}

#[track_caller]
fn all_same(name: &str, scene: Scene, structures: &[StructureChoice]) {
    let studio = Studio::new(scene).unwrap();
    let mut hits = 0;
    for (view, camera) in views(&studio) {
        if camera.check().is_err() {
            continue;
        }
        let request = request(camera, DOTS);
        let frame = fast(&studio, &request);
        hits += frame.counts.primary_hits;
        for &structure in structures {
            let other = exact(&studio, &request, structure);
            assert_same_picture(&format!("{name}, {view}, against {structure:?}"), &frame, &other);
            let counted = |f: &ray13::frame::Frame| {
                let c = f.counts;
                [
                    c.primary_rays,
                    c.primary_hits,
                    c.shadow_rays,
                    c.shadow_hits,
                    c.secondary_rays,
                    c.secondary_hits,
                ]
            };
            assert_eq!(counted(&frame), counted(&other), "{name}, {view}: rays are counted otherwise");
        }
    }
    assert!(hits > 0, "{name}: no ray meets it");
}

/// The files of a folder that may stand beside this repository, by name, behind this repository's own of that
/// kind.
pub fn with_those_beside(own: &[&str], folder: &str) -> Vec<(String, Scene)> {
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let paths = own.iter().map(|name| files.join(name)).chain(beside::files(folder));
    let scene = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
    };
    paths.map(scene).collect()
}

/// This repository's own files as OpenSCAD exports them.
pub const CSG: [&str; 1] = ["bracket.csg"];

/// This repository's own files of NFF.
pub const NFF: [&str; 2] = ["balls.nff", "surfaces.nff"];

#[test]
fn inside_the_program() {
    for (name, scene) in embedded_scenes() {
        all_same(name, scene, &[StructureChoice::None, StructureChoice::Boxes]);
    }
}

#[test]
fn of_patches() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/cushion.scene");
    let scene = read_file(&file, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    all_same("cushion", scene, &[StructureChoice::None, StructureChoice::Boxes, StructureChoice::Tree]);
}

#[test]
fn of_openscad() {
    for (name, scene) in with_those_beside(&CSG, "openscad") {
        all_same(&name, scene, &[StructureChoice::None, StructureChoice::Boxes]);
    }
}

#[test]
fn of_the_standard_procedural_database() {
    for (name, scene) in with_those_beside(&NFF, "spd") {
        // Through cells, which share nothing with boxes; all their thousands of objects would take minutes.
        all_same(&name, scene, &[StructureChoice::Tree]);
    }
}

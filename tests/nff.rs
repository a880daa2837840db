//! Files of NFF: those of the Standard Procedural Databases by their known numbers, and what a shell is told of bad
//! ones.

mod request;

use std::path::{Path, PathBuf};
use std::process::Command;

use ray13::frame::Studio;
use ray13::math::Size;
use ray13::scene::{ReadOptions, Scene, read_file};
use request::request;

/// The databases are not part of this repository; they may stand beside it.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/scenes/spd")
}

fn file(name: &str) -> Option<PathBuf> {
    let path = folder().join(name).with_extension("nff");
    if !path.exists() {
        eprintln!("left out: {} is not here", path.display());
        return None;
    }
    Some(path)
}

fn scene(name: &str) -> Option<Scene> {
    Some(read_file(&file(name)?, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
}

/// Dots of a picture of 513 × 513 that see something, as the databases' own documentation counts them; the last
/// digit there is one of another program, so a few may differ.
const HITS: [(&str, u64); 8] = [
    ("balls", 263_169),
    ("gears", 245_332),
    ("lattice", 261_170),
    ("mount", 173_686),
    ("rings", 263_169),
    ("teapot", 161_546),
    ("tetra", 49_950),
    ("tree", 169_909),
];
const OTHER_ROUNDING: u64 = 5;

#[test]
fn the_databases_are_seen_by_as_many_rays_as_they_should_be() {
    for (name, expected) in HITS {
        let Some(scene) = scene(name) else { continue };
        let studio = Studio::new(scene).unwrap();
        let mut request = request(studio.camera(0, 1.0), Size::new(513, 513));
        request.options.shadows = false;
        let counts = studio.draw(&request).counts;
        assert_eq!(counts.primary_rays, 513 * 513);
        assert!(counts.primary_hits.abs_diff(expected) <= OTHER_ROUNDING, "{name}: {}", counts.primary_hits);
    }
}

#[test]
fn balls_of_every_size_hold_as_many_balls_as_they_should() {
    // Nine balls around each of the level before, and the floor.
    for (name, balls) in [("balls-1", 10), ("balls-2", 91), ("balls-3", 820), ("balls", 7381)] {
        let Some(scene) = scene(name) else { continue };
        assert_eq!(scene.objects.len(), balls + 1, "{name}");
        assert!(scene.notes.is_empty(), "{name}: {:?}", scene.notes);
    }
}

/// What `ray13 check` says of a file with these contents.
fn told(name: &str, contents: &[u8]) -> (Option<i32>, String) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).with_extension("nff");
    std::fs::write(&path, contents).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_ray13")).arg("check").arg(&path).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_bad_file_is_refused_with_its_place() {
    for (name, contents, expected) in [
        ("cut", "f 1 1 1 1 0 1 0 0\np 4\n0 0 0\n1 0 0\n1 1 0", "the file ends within `p`"),
        ("letters", "s 0 0 0 1\ns 0 zero 0 1\n", "is no number"),
        ("unknown", "s 0 0 0 1\nq 0\n", "no such entity"),
        ("count", "p -3\n", "whole number"),
        ("huge", "p 4000000000\n0 0 0\n", "the file ends within `p`"),
        ("infinite", "s 0 0 0 1e400\n", "beyond the largest number"),
        ("radius", "s 0 0 0 0\n", "above 0"),
        ("empty", "# nothing\n", "empty"),
    ] {
        let (code, message) = told(name, contents.as_bytes());
        assert_eq!(code, Some(2), "{name}: {message}");
        assert!(message.contains(expected) && !message.contains("panicked"), "{name}: {message}");
    }
    let (code, message) = told("binary", b"s 0 0 0 1 \xff\xfe");
    assert_eq!(code, Some(2));
    assert!(message.contains("not text"), "{message}");
}

#[test]
fn a_file_cut_off_anywhere_is_never_a_panic() {
    let Some(path) = file("teapot") else { return };
    let text = std::fs::read(path).unwrap();
    for end in (0..4000).step_by(7) {
        let _ = ray13::scene::read("teapot.nff", &text[..end], &ReadOptions::default());
    }
}

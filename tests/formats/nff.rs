//! Files of NFF: how many objects the databases hold, and what a shell is told of bad files.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::any_text::placed;
use crate::support::beside;
use crate::support::request::request;
use ray13::frame::Studio;
use ray13::math::Size;
use ray13::scene::{ReadOptions, read};

/// Five balls over a floor.
const BALLS: &[u8] = include_bytes!("../files/balls.nff");

/// Polygons, a patch, a cone and a ball.
const SURFACES: &[u8] = include_bytes!("../files/surfaces.nff");

#[test]
fn balls_of_every_size_hold_as_many_balls_as_they_should() {
    // Nine balls around each of the level before, and the floor.
    for (name, balls) in [("balls-1", 10), ("balls-2", 91), ("balls-3", 820), ("balls", 7381)] {
        let Some(path) = beside::path(&format!("spd/{name}.nff")) else { continue };
        assert_holds(name, &fs::read(path).unwrap(), balls + 1);
    }
    assert_holds("balls", BALLS, 5 + 1);
    // Three polygons, of which one has normals, a cone and a ball.
    assert_holds("surfaces", SURFACES, 5);
}

#[track_caller]
fn assert_holds(name: &str, text: &[u8], objects: usize) {
    let scene = read(&format!("{name}.nff"), text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.objects.len(), objects, "{name}");
    assert!(scene.notes.is_empty(), "{name}: {:?}", scene.notes);
}

/// As in `mount`, where each of the surfaces in a glass ball had added 0.5 of ambient light, and the ball was
/// white.
#[test]
fn glass_does_not_shine_by_itself() {
    let text = "v from 0 -5 0 at 0 0 0 up 0 0 1 angle 30\nl 9 -9 9\nf 1 1 1 .1 .1 101 .9 1.5\ns 0 0 0 1";
    let scene = read("glass.nff", text.as_bytes(), &ReadOptions::default()).unwrap();
    let studio = Studio::new(scene).unwrap();
    let frame = studio.draw(&request(studio.camera(0, 1.0), Size::new(64, 64)));
    let brightest = frame.light.values().iter().copied().fold(0.0, f64::max);
    // Without a background: ambient and diffuse light of 0.1 each have half of white, at up to six surfaces
    // in a row, and the highlight has 0.05.
    assert!(brightest < 6.0 * 0.1 + 0.05, "{brightest}");
}

/// What `ray13 check` says of a file with these contents.
fn told(name: &str, contents: &[u8]) -> (Option<i32>, String) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).with_extension("nff");
    fs::write(&path, contents).unwrap();
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
        ("sense8", "nff\nversion 2.0\nviewpos 0 0 0\n", "Sense8's WorldToolKit"),
    ] {
        let (code, message) = told(name, contents.as_bytes());
        assert_eq!(code, Some(2), "{name}: {message}");
        assert!(message.contains(expected) && !message.contains("panicked"), "{name}: {message}");
    }
    let (code, message) = told("binary", b"s 0 0 0 1 \xff\xfe");
    assert_eq!(code, Some(2));
    assert!(message.contains("not text"), "{message}");
}

/// A cut within an entity is an error at its place; one between two leaves what stands before it.
#[test]
fn a_file_cut_off_anywhere_says_where_or_holds_what_is_left() {
    assert_cut_off_anywhere(BALLS, 1);
    assert_cut_off_anywhere(SURFACES, 1);
    if let Some(path) = beside::path("spd/teapot.nff") {
        assert_cut_off_anywhere(&fs::read(path).unwrap()[..4000], 7);
    }
}

fn assert_cut_off_anywhere(text: &[u8], step: usize) {
    let (mut objects, mut refused) = (0, 0);
    for end in (0..text.len()).step_by(step) {
        match read("cut.nff", &text[..end], &ReadOptions::default()) {
            Ok(scene) => {
                // What was read of a longer text is read of it again, and no more than that.
                assert!(scene.objects.len() >= objects, "at {end}: {objects} objects before");
                objects = scene.objects.len();
            }
            Err(errors) => {
                if let Err(fault) = placed(&errors) {
                    panic!("at {end}: {fault}");
                }
                refused += 1;
            }
        }
    }
    assert!(objects > 0 && refused > 0, "{objects} objects, {refused} cuts refused");
}

//! One object of many primitives, which is cut into cells: the same picture by packets, by single rays
//! through the cells, and by single rays through the whole expression.
//!
//! A plate of 900 holes once took the fast engine fifty times as long as the exact one.

use std::fmt::Write;

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::{EngineChoice, PrecisionChoice, StructureChoice};
use ray13::scene::{Camera, ReadOptions, read};

use crate::support::agreement::difference;
use crate::support::request::request;
use crate::support::same::{exact, fast};

/// Tiles that are whole, and some that are not.
const DOTS: Size = Size::new(72, 40);

/// A plate around the origin, 2 wide and 0.4 high, with `side` × `side` holes, each made by `hole` of its
/// half width.
fn plate(side: u32, hole: impl Fn(f64) -> String) -> String {
    let mut text = "difference() { cube([2, 2, 0.4], center = true);".to_owned();
    let step = 2.0 / f64::from(side);
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let place = |k: u32| (f64::from(k) + 0.5) * step - 1.0;
        write!(text, "translate([{}, {}, 0]) {}", place(i), place(j), hole(step)).unwrap();
    }
    text + "}"
}

fn round(share: f64) -> impl Fn(f64) -> String {
    move |step| format!("cylinder(h = 1, r = {}, center = true);", share * step)
}

fn square(step: f64) -> String {
    format!("cube([{0}, {0}, 1], center = true);", 0.6 * step)
}

/// A Menger sponge as people write it: every cube of every level has its three bars, as long as `length` of
/// the cube, or of the whole where that is none.
fn sponge(levels: u32, length: Option<f64>) -> String {
    fn bars(text: &mut String, center: [f64; 3], size: f64, levels: u32, length: Option<f64>) {
        let third = size / 3.0;
        for axis in 0..3 {
            let (mut edges, mut at) = ([third; 3], center);
            edges[axis] = length.map_or(2.1, |length| length * size);
            if length.is_none() {
                at[axis] = 0.0;
            }
            write!(text, "translate({at:?}) cube({edges:?}, center = true);").unwrap();
        }
        if levels < 2 {
            return;
        }
        for place in 0..27 {
            let step = [place % 3, place / 3 % 3, place / 9].map(|k| f64::from(k) - 1.0);
            if step.iter().filter(|&&k| k == 0.0).count() < 2 {
                let center = std::array::from_fn(|axis| center[axis] + step[axis] * third);
                bars(text, center, third, levels - 1, length);
            }
        }
    }
    let mut text = "difference() { cube(2, center = true);".to_owned();
    bars(&mut text, [0.0; 3], 2.0, levels, length);
    text + "}"
}

/// So many balls in a cube around the origin, the same for the same `seed`.
fn balls(count: u32, radius: f64, seed: u32) -> String {
    let place = |k: u32, step: u32| f64::from((k + seed) * step % 257) / 128.0 - 1.0;
    (0..count)
        .map(|k| {
            let [x, y, z] = [31, 89, 200].map(|step| place(k, step));
            format!("translate([{x}, {y}, {z}]) sphere({radius});")
        })
        .collect()
}

/// Checks what is seen from a number of eyes, one of which may be in a hole.
#[track_caller]
fn alike(name: &str, text: &str, eyes: &[[f64; 3]]) {
    let scene = read(name, text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let studio = Studio::new(scene).unwrap();
    let own = studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height));
    let target = DVec3::new(0.1, 0.05, -0.07);
    let others = eyes.iter().map(|&eye| Camera { eye: DVec3::from(eye), target, ..own.clone() });
    for camera in others.chain([own.clone()]) {
        let request = request(camera, DOTS);
        let whole = exact(&studio, &request, StructureChoice::None);
        assert!(whole.counts.primary_hits > 0, "{name}: nothing is seen from {}", request.camera.eye);
        for (way, frame) in [
            ("packets", fast(&studio, &request)),
            ("cells", exact(&studio, &request, StructureChoice::Boxes)),
            ("cells in a lattice", exact(&studio, &request, StructureChoice::Lattice)),
        ] {
            if let Some(fault) = difference(&frame, &whole) {
                panic!("{name} by {way}, from {}: {fault}", request.camera.eye);
            }
        }
        let mut single = request.clone();
        single.options.engine = EngineChoice::Fast;
        (single.options.precision, single.options.shadows) = (PrecisionChoice::Single, false);
        let frame = studio.draw_anew(&single);
        let objects = [&frame, &whole].map(|frame| frame.object.as_ref().unwrap().values());
        assert!(objects[0] == objects[1], "{name} in single precision, from {}", request.camera.eye);
    }
}

const EYES: [[f64; 3]; 3] = [[1.3, -2.0, 1.4], [-0.4, 0.3, 2.5], [2.6, 0.05, 0.0]];

#[test]
fn plates_of_holes() {
    alike("round", &plate(9, round(0.3)), &EYES);
    alike("round, many", &plate(30, round(0.3)), &EYES);
    alike("square", &plate(20, square), &EYES);
}

#[test]
fn an_eye_in_a_hole() {
    let [middle, wall] = [[0.1, 0.1, 0.15], [0.1 + 0.058, 0.1, 0.1]];
    alike("round", &plate(10, round(0.3)), &[middle, wall, [0.1, 0.1, 0.2]]);
    alike("square", &plate(10, square), &[middle, [0.1 + 0.06, 0.1, 0.1]]);
}

#[test]
fn holes_that_touch_each_other_and_the_side() {
    // Each touches its neighbours in a line, and those at the rim the plate's side.
    alike("tangent", &plate(8, round(0.5)), &EYES);
    alike("overlapping", &plate(8, round(0.55)), &EYES);
}

#[test]
fn sponges_as_people_write_them() {
    alike("bars as long as all, many of them twice", &sponge(3, None), &EYES);
    alike("bars that end where the next begin", &sponge(3, Some(1.0)), &EYES);
    alike("bars a little longer", &sponge(3, Some(1.02)), &[[0.1, -0.2, 0.1]]);
}

#[test]
fn duplicates() {
    let twice = format!("difference() {{ cube(1.9, center = true); {0} {0} }}", balls(60, 0.3, 5));
    alike("cut twice", &twice, &EYES);
    let both = format!("union() {{ {0} {0} }}", balls(60, 0.2, 7));
    alike("put together twice", &both, &EYES);
}

#[test]
fn deep_sponges_of_balls() {
    alike("balls", &format!("difference() {{ cube(2, center = true); {} }}", balls(250, 0.25, 3)), &EYES);
}

#[test]
fn differences_in_differences() {
    let mut left = "cube(2, center = true);".to_owned();
    let mut right = balls(20, 0.5, 90);
    for depth in 0..5 {
        left = format!("difference() {{ {left} {} }}", balls(30, 0.3, 30 * depth));
        right = format!("difference() {{ union() {{ {} }} {right} }}", balls(30, 0.6, 20 * depth));
    }
    alike("of the first", &left, &EYES);
    alike("of the others", &format!("difference() {{ cube(2, center = true); {right} }}"), &EYES);
}

// Solids that all meet in one line are parted by no cut.
#[test]
fn a_fan_of_slabs() {
    let slabs: String =
        (0..60).map(|k| format!("rotate([0, 0, {}]) cube([3, 0.01, 1], center = true);", 3 * k)).collect();
    alike("fan", &format!("difference() {{ cube([2, 2, 0.8], center = true); {slabs} }}"), &EYES);
}

//! `--facets openscad` beside OpenSCAD's own export: the same depths, dot for dot.

use ray13::frame::Frame;
use ray13::scene::{FacetMode, Format, ReadOptions, read};

use crate::support::around::{DOTS, cameras_around, frame};
use crate::support::drawings::own_corners;
use crate::support::openscad::{exported_text, in_parallel, is_missing};

/// Small models: each word alone, and nested, mirrored, small and large.
const MODELS: [&str; 24] = [
    "sphere(5);",
    "sphere(r = 1);",
    "sphere(3, $fn = 7);",
    "sphere(d = 30, $fa = 30, $fs = 0.1);",
    "cylinder(h = 9, r = 4);",
    "cylinder(h = 9, r1 = 4, r2 = 1, $fn = 5, center = true);",
    "cylinder(h = 9, r1 = 0, r2 = 4);",
    "cylinder(h = 0.9, d1 = 0.4, d2 = 0, $fs = 0.1);",
    "linear_extrude(4) circle(6);",
    "linear_extrude(4, twist = 40) translate([2, 0]) circle(3);",
    "linear_extrude(4) difference() { circle(6); translate([1, 1]) circle(2, $fn = 9); }",
    "rotate_extrude() translate([5, 0]) circle(2);",
    "rotate_extrude(angle = 140, $fn = 20) translate([5, 0]) square([2, 3]);",
    "linear_extrude(2) offset(delta = 1) square([5, 3]);",
    "hull() { sphere(2); translate([6, 0, 1]) cylinder(h = 2, r = 3); }",
    "minkowski() { cube([4, 5, 1]); sphere(1, $fn = 10); }",
    "difference() { cube(10, center = true); sphere(6); cylinder(h = 11, r = 2, center = true); }",
    "intersection() { sphere(6, $fn = 30); translate([2, 1, 0]) rotate([20, 30, 0]) cylinder(h = 20, r = 4, center = true); }",
    "mirror([1, 1, 0]) difference() { sphere(5, $fn = 11); translate([3, 0, 0]) sphere(4); }",
    "scale([1, 2, 0.5]) rotate([0, 40, 10]) cylinder(h = 5, r = 3, $fn = 25);",
    "scale(1e5) difference() { cylinder(h = 4, r = 5); translate([0, 0, 2]) sphere(3); }",
    "scale(1e-2) difference() { cylinder(h = 4, r = 5); translate([0, 0, 2]) sphere(3); }",
    "sphere(2e5);",
    "resize([4, 0, 9], auto = true) union() { sphere(3); translate([4, 0, 0]) cylinder(h = 3, r = 1); }",
];

/// What lies between the depths of a dot and of those around it; what is missed is infinitely far.
fn around(frame: &Frame, column: u32, row: u32) -> [f64; 2] {
    let depth = frame.depth.as_ref().unwrap();
    let near = |at: u32, most: u32| at.saturating_sub(1)..=(at + 1).min(most - 1);
    let depths = near(row, DOTS.height)
        .flat_map(|j| near(column, DOTS.width).map(move |i| (i, j)))
        .map(|place| depth[place]);
    depths.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], depth| [low.min(depth), high.max(depth)])
}

#[test]
fn what_is_seen_is_what_is_exported() {
    if is_missing() {
        return;
    }
    let dots = in_parallel(&MODELS, |model| {
        let [csg, stl] = ["csg", "stl"].map(|ending| exported_text(model, ending).expect(model));
        let options = ReadOptions { facets: FacetMode::OpenScad, ..ReadOptions::default() };
        let own = read("model.csg", &csg, &options).unwrap_or_else(|why| panic!("{model}: {why}"));
        let as_mesh = ReadOptions { format: Some(Format::Stl), ..ReadOptions::default() };
        let theirs = read("model.stl", &stl, &as_mesh).unwrap_or_else(|why| panic!("{model}: {why}"));
        let (size, cameras) = cameras_around(&own, [[1.0, -2.0, 0.7], [-0.3, 0.4, -1.5], [0.2, 0.1, 3.0]]);
        let (mut seen, mut off) = (0, 0);
        for camera in cameras {
            let [own, theirs] = [&own, &theirs].map(|scene| frame(scene, &camera));
            let [depth, expected] = [&own, &theirs].map(|frame| frame.depth.as_ref().unwrap());
            for place in (0..DOTS.height).flat_map(|j| (0..DOTS.width).map(move |i| (i, j))) {
                // STL has six digits.
                let near = 1e-5 * size;
                seen += usize::from(depth[place].is_finite());
                let is_same =
                    depth[place] == expected[place] || (depth[place] - expected[place]).abs() <= near;
                if !is_same {
                    off += 1;
                    let [low, high] = around(&theirs, place.0, place.1);
                    let is_edge = (low - near..=high + near).contains(&depth[place]) || depth[place] == high;
                    assert!(is_edge, "{model}: {place:?}: {} for {}", depth[place], expected[place]);
                }
            }
        }
        assert!(seen > 500, "{model}: {seen} dots");
        assert!(off * 200 <= seen, "{model}: {off} of {seen} dots");
        seen
    });
    assert!(dots.iter().sum::<usize>() > 50_000);
}

#[test]
fn round_words_have_the_corners_of_their_settings() {
    let options = ReadOptions { facets: FacetMode::OpenScad, ..ReadOptions::default() };
    for (text, expected) in [
        ("sphere(r = 5);", 16 * 8),
        ("sphere(r = 1);", 5 * 3),
        ("sphere(r = 5, $fn = 100);", 100 * 50),
        ("cylinder(h = 2, r1 = 4, r2 = 0, $fn = 6);", 7),
        ("linear_extrude(height = 2) circle(r = 3, $fa = 90, $fs = 0.1);", 2 * 5),
        ("cube(2);", 0),
    ] {
        let scene = read("text", text.as_bytes(), &options).unwrap_or_else(|why| panic!("{why}"));
        assert_eq!(own_corners(&scene).len(), expected, "{text}");
    }
}

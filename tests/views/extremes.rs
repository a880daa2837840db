//! Scenes and views at the ends of what numbers can hold. Each of these came from an attack on the program
//! that found it wanting.

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use ray13::frame::{Frame, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{Camera, ReadOptions, Scene, read};
use ray13::tone::Tone;

/// Odd, so that one dot looks along the line of sight.
const DOTS: Size = Size::new(21, 21);

/// The same picture by every structure.
#[track_caller]
fn drawn(text: &str, eye: DVec3, target: DVec3) -> Frame {
    let scene = read("extreme", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let camera = Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 1.0, 0.2),
        field: [30.0, 30.0],
        span: ray13::scene::FieldSpan::Edges,
        zoom: 1.0,
    };
    drawn_by(scene, &camera, DOTS)
}

/// The picture of one camera, the same by every structure.
#[track_caller]
fn drawn_by(scene: Scene, camera: &Camera, dots: Size) -> Frame {
    let studio = Studio::new(scene).unwrap();
    let choices =
        [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree, StructureChoice::Boxes];
    let [frame, others @ ..] = choices.map(|structure| {
        let mut request = request(camera.clone(), dots);
        request.options.structure = structure;
        studio.draw(&request)
    });
    for other in others {
        assert_same_picture(other.space.name(), &other, &frame);
    }
    frame
}

const MIDDLE: (u32, u32) = (10, 10);

// The error of a crossing at the apex was infinite: alone, the cone was entered through its base; in a
// composite, the crossing took all those behind it along.
#[test]
fn a_ray_through_the_apex_meets_the_cone() {
    let cone = "cylinder(h = 2, r1 = 1, r2 = 0, center = true);";
    for text in [cone.to_owned(), format!("difference() {{ {cone} translate([5, 0, 0]) sphere(1); }}")] {
        let above = drawn(&text, DVec3::new(3.0, 0.0, 9.0), DVec3::Z);
        assert!(
            (above.depth.as_ref().unwrap()[MIDDLE] - 73_f64.sqrt()).abs() < 1e-9,
            "{text} {}",
            above.depth.as_ref().unwrap()[MIDDLE]
        );
    }
    let within = format!("difference() {{ {cone} translate([5, 0, 0]) sphere(1); }}");
    assert!((drawn(&within, DVec3::Z, DVec3::ZERO).depth.as_ref().unwrap()[MIDDLE] - 2.0).abs() < 1e-9);
}

// From 1e155 on the square of a light's distance overflowed, and it lit nothing.
#[test]
fn a_light_lights_from_any_distance() {
    let lit = |at: f64| {
        let text = format!("light(at = [0, -{at:e}, {at:e}]); sphere(1); translate([0, 0, 2]) cube(1);");
        drawn(&text, DVec3::new(4.0, -6.0, 5.0), DVec3::ZERO).levels(Tone::default())
    };
    for at in [1e150, 1e160, 1e300, 1e308] {
        assert_eq!(lit(at), lit(1e20), "{at:e}");
    }
}

// An eye farther away than numbers can hold, in the scene's own size, gave rays without a start.
#[test]
fn an_eye_at_any_distance_sees_nothing_or_something() {
    for (size, far) in [(1.0, 1e300), (1e-150, 1e200), (1e-300, 1e308)] {
        let frame = drawn(&format!("sphere({size:e});"), DVec3::new(far, 0.0, 0.3 * far), DVec3::ZERO);
        assert!(frame.light.values().iter().all(|light| light.is_finite()));
        let nothing = |place: usize| frame.object.as_ref().unwrap().values()[place] == 0;
        assert!(
            (0..DOTS.area()).all(|p| frame.depth.as_ref().unwrap().values()[p].is_finite() != nothing(p)),
            "{size} {far}"
        );
    }
}

// Each object that coincides with the nearest was compared with all others: a minute for a picture of these.
#[test]
fn thousands_of_objects_may_coincide() {
    let frame = drawn(&"sphere(1);".repeat(4000), DVec3::new(4.0, -6.0, 5.0), DVec3::ZERO);
    assert_eq!(frame.object.as_ref().unwrap()[MIDDLE], 1);
}

const VIEW: &str = "light(at = [6, -6, 8]); camera(eye = [5, -7, 4], target = [0, 0, 0], field = [30, 20]);";

/// The picture of the scene's own camera, the same by every structure.
#[track_caller]
fn pictured(text: &str) -> Frame {
    let text = format!("{VIEW} {text}");
    let scene = read("extreme", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let camera = scene.views[0].clone();
    drawn_by(scene, &camera, Size::new(60, 40))
}

/// Two ways to write one scene: every dot has the same level.
#[track_caller]
fn assert_same_scene(text: &str, plain: &str) {
    let (frame, expected) = (pictured(text), pictured(plain));
    let [levels, plain] = [&frame, &expected].map(|frame| frame.levels(Tone::default()));
    let differ = (0..plain.size().area()).filter(|&p| levels.values()[p] != plain.values()[p]).count();
    assert_eq!(differ, 0, "{text}");
    assert!(frame.counts.primary_hits > 100 || expected.counts.primary_hits == 0, "{text}");
}

// The face shown was the first in the file, which a far cutter or a far pivot had made less sure; the plate
// flush with it was asked for its own error only, and lay in its own shadow.
#[test]
fn flush_faces_of_unlike_errors_do_not_shade_each_other() {
    let plate = "translate([-0.5, -0.5, 0.1]) cube([1, 1, 0.2]);";
    let cut = |cutter: &str| {
        format!(
            "rotate([10, 20, 30]) object(\"u\") {{ difference() {{ cube(2, center = true); {cutter} }} {plate} }}"
        )
    };
    let plain = cut("translate([-5, -5, 0.3]) cube(10);");
    assert_same_scene(&cut("translate([-5000, -5000, 0.3]) cube(10000);"), &plain);
    assert_same_scene(&cut("translate([-500000, -500000, 0.3]) cube(1000000);"), &plain);
    let drift = "translate([1000000.1, 1000000.3, 1000000.7]) translate([-1000000, -1000000, -1000000])
        translate([-0.1, -0.3, -0.7])";
    for solid in ["cube(2, center = true);", "sphere(1);", "cylinder(h = 2, r = 1, center = true);"] {
        let both = format!("object(\"u\") {{ {drift} {solid} {solid} }}");
        assert_same_scene(&both, &format!("object(\"u\") {{ {solid} }}"));
        // As two objects, too: the first in the file shows.
        assert_same_scene(&format!("{drift} {solid} {solid}"), solid);
    }
}

// Cells of a sub-lattice forgot what lay within the error of a map beside them, and put a lid on the hole.
#[test]
fn a_hole_is_open_however_far_the_pivot_of_its_turn() {
    let body = "cube(at = [-0.5, 0, 0], semi = [1.5, 2, 2]);";
    let plain = format!("difference() {{ {body} cube(2, center = true); }}");
    for (pivot, there, back) in [
        ("5000.1", "rotate(30)", "rotate(-30)"),
        ("100000.1", "", ""),
        ("1000000.1", "rotate(77)", "rotate(-77)"),
    ] {
        let maps = format!("translate([-{pivot}, 0, 0]) {there} {back} translate([{pivot}, 0, 0])");
        assert_same_scene(&format!("difference() {{ {body} {maps} cube(2, center = true); }}"), &plain);
    }
}

// Slopes were told apart by errors: two copies of a solid, one of them less sure, did not cancel.
#[test]
fn a_solid_minus_itself_is_nothing_however_unsure_the_copy() {
    let turns = "rotate([10, 20, 30]) rotate([-10, 0, 0]) rotate([0, -20, 0]) rotate(-30)";
    let pivots = ["1000000.1", "10000000.1"].map(|x| {
        format!(
            "cube(2, center = true); translate([{x}, 0, 0]) {turns} translate([-{x}, 0, 0]) cube(2, center = true);"
        )
    });
    let others = [
        "sphere(1); translate([1000000000.1, 0, 0]) translate([-1000000000.1, 0, 0]) sphere(1);",
        "rotate([10, 20, 30]) cube(2, center = true); rotate([10, 20, 30]) translate([-1, -1, -1]) cube(1e6);",
        "cylinder(h = 2, r = 1); cylinder(h = 1e7, r = 1e7);",
    ];
    for parts in pivots.iter().map(String::as_str).chain(others) {
        let frame = pictured(&format!("difference() {{ {parts} }}"));
        assert_eq!(frame.counts.primary_hits, 0, "{parts}");
    }
}

// The share that a way of 1e55 there and back loses of a solid of 1 is no f32: the bound was infinite, and
// hid the solid.
#[test]
fn no_bound_hides_a_solid() {
    for solid in ["cylinder(h = 2, r = 1);", "rotate([1, 2, 3]) cube(1);", "scale([1, 2, 3]) sphere(0.5);"] {
        let moved = format!("translate([1e55, 0, 0]) translate([-1e55, 0, 0]) {solid}");
        let (frame, plain) = (pictured(&moved), pictured(solid));
        assert!(plain.counts.primary_hits > 100, "{solid}");
        assert!(frame.counts.primary_hits * 2 > plain.counts.primary_hits, "{solid}");
    }
}

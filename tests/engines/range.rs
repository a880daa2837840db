//! There is no scene and no view for which the fast engine must not be used: where its numbers do not
//! suffice, it asks the exact one.

use ray13::frame::{Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{Camera, FieldSpan, read};

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::same::{exact, fast};

const DOTS: Size = Size::new(19, 19);

/// Solids about the origin, of size `s`.
fn scene(s: f64) -> String {
    format!(
        "light(at = [{a:e}, -{b:e}, {b:e}]);
        material(kr = 0.5) translate([-{b:e}, 0, 0]) sphere({s:e});
        material(kt = 0.5, index = 1.5) sphere({s:e});
        translate([{b:e}, 0, 0]) difference() {{ cube({b:e}, center = true); sphere({s:e}); }}
        translate([0, {b:e}, 0]) cylinder(h = {s:e}, r1 = {s:e}, r2 = 0);
        translate([0, -{b:e}, 0]) rotate([10, 20, 30]) cube({s:e});
        translate([0, 0, {s:e}]) cylinder(h = {s:e}, r = {s:e}, $fn = 5);",
        a = 5.0 * s,
        b = 1.5 * s,
    )
}

#[track_caller]
fn same(text: &str, eye: DVec3, target: DVec3, field: f64, zoom: f64) {
    let scene = read("range", text.as_bytes(), &ray13::scene::ReadOptions::default());
    let studio = Studio::new(scene.unwrap_or_else(|e| panic!("{e}"))).unwrap();
    let camera = Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 0.2, 1.0),
        field: [field, field],
        span: FieldSpan::Edges,
        zoom,
    };
    assert_eq!(camera.check(), Ok(()), "{camera:?}");
    let plain = request(camera, DOTS);
    for samples in [1, 2] {
        let mut request = Request { ..plain.clone() };
        request.options.samples = samples;
        let frame = fast(&studio, &request);
        for structure in [StructureChoice::None, StructureChoice::Boxes] {
            let other = exact(&studio, &request, structure);
            let what = format!("{text}\n{eye} → {target}, {field}°, zoom {zoom:e}, {structure:?}");
            assert_same_picture(&what, &frame, &other);
        }
    }
}

#[test]
fn scenes_of_any_size() {
    for decade in [-300, -150, -30, -6, 0, 6, 30, 150, 300] {
        let s = libm::pow(10.0, f64::from(decade));
        same(&scene(s), DVec3::new(3.0, -7.0, 4.0) * s, DVec3::ZERO, 40.0, 1.0);
    }
}

#[test]
fn scenes_anywhere() {
    for far in [1e3, 1e6, 1e9, 1e12, 1e100] {
        let way = DVec3::new(far, -far, 0.5 * far);
        let text = format!("translate([{far:e}, -{far:e}, {:e}]) {{ {} }}", 0.5 * far, scene(1.0));
        // The light stays behind; so far away there is nothing left of the solids' own shapes.
        let eye = way + DVec3::new(3.0, -7.0, 4.0) * (far * 1e-12).max(1.0);
        same(&without_light(&text), eye, way, 40.0, 1.0);
    }
}

/// A light can not be moved by a map.
fn without_light(text: &str) -> String {
    let (before, rest) = text.split_once("light").unwrap();
    let (_, after) = rest.split_once(';').unwrap();
    format!("{before}{after}")
}

#[test]
fn eyes_at_any_distance() {
    let toward = DVec3::new(0.4, -0.8, 0.45);
    for decade in [-9, -3, 0, 3, 6, 9, 12, 15, 16, 30, 100, 150, 300] {
        let far = libm::pow(10.0, f64::from(decade));
        for zoom in [1.0, far.clamp(1.0, 1e15)] {
            same(&scene(1.0), toward * far, DVec3::ZERO, 40.0, zoom);
        }
    }
}

#[test]
fn fields_of_any_angle() {
    for eye in [DVec3::new(3.0, -7.0, 4.0), DVec3::new(0.2, 0.1, 0.9), DVec3::ZERO] {
        for field in [1e-12, 1e-6, 0.01, 90.0, 170.0, 179.0, 179.999, 179.999_999_999] {
            same(&scene(1.0), eye, DVec3::new(0.1, 0.2, -0.3), field, 1.0);
        }
    }
}

// The box of the point had infinite sides in the assembly's unit, and was met by frustums that did not exist.
#[test]
fn an_object_of_one_point() {
    let text = "intersection() {
        translate([1, -1, 0]) rotate([90, 0, 0]) scale([1.5, 0.5, 0.5]) cylinder(h = 2, r = 1, center = true);
        translate([-1, 1, -1]) scale([0.5, 1.5, 0.5]) sphere(1);
        sphere(0.5);
    }";
    same(text, DVec3::new(0.0, 0.0, 9.0), DVec3::new(0.1, 0.05, -0.07), 40.0, 1.0);
}

#[test]
fn needles_plates_and_neighbours_of_unlike_size() {
    let pairs = [
        "scale([1e-9, 1, 1e9]) sphere(1); sphere(1);",
        "scale([1, 1, 1e-150]) cube(2, center = true); sphere(1e-150);",
        "sphere(1e-200); translate([3, 0, 0]) sphere(1e100);",
        "cube([1e12, 1e12, 1], center = true); translate([0, 0, 1]) sphere(0.5);",
        "difference() { cube(2, center = true); scale([1e-6, 1e-6, 1]) cylinder(h = 5, r = 1, center = true); }",
    ];
    for text in pairs {
        for eye in [DVec3::new(3.0, -7.0, 4.0), DVec3::new(1e6, -1e7, 1e6), DVec3::new(0.0, 0.0, 1.5)] {
            same(text, eye, DVec3::new(0.1, 0.0, 0.0), 40.0, 1.0);
        }
    }
}

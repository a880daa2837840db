//! Single precision against double: every ray meets the same object in nearly the same place.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use ray13::frame::{Frame, Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{Options, Precision, PrecisionChoice, Shading};
use ray13::scene::{Camera, ReadOptions, Scene, read};
use ray13::tone::Tone;

use super::random::any_scene;
use super::scenes::{CSG, views, with_those_beside};
use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::scenery::embedded_scenes;

const DOTS: Size = Size::new(128, 96);

/// No ray starts on a surface.
fn plain(camera: Camera, dots: Size, precision: PrecisionChoice) -> Request {
    let request = request(camera, dots);
    let options = Options { precision, shadows: false, shading: Shading::Phong, ..request.options };
    Request { options, ..request }
}

/// How two pictures of the same view differ.
#[derive(Debug, Default)]
struct Differing {
    dots: usize,
    /// Dots that see another object, or a depth that is off by more than a thousandth.
    others: usize,
    /// Dots of another level; and those of one that is not the next.
    levels: usize,
    far: usize,
}

impl Differing {
    /// One dot in ten thousand lies so near the step from one level to the next, or of a few dots none.
    fn is_small(&self) -> bool {
        self.others == 0 && self.far == 0 && self.levels * 10_000 <= self.dots
    }
}

fn differing(half: &Frame, full: &Frame) -> Differing {
    let tone = Tone::default();
    let levels = [half, full].map(|frame| frame.levels(tone));
    let mut differing = Differing { dots: levels[0].values().len(), ..Differing::default() };
    for dot in 0..differing.dots {
        let [one, other] = [0, 1].map(|k| levels[k].values()[dot].get());
        let steps = one.abs_diff(other);
        differing.levels += usize::from(steps > 0);
        differing.far += usize::from(steps > 1);
        let object = |frame: &Frame| frame.object.as_ref().unwrap().values()[dot];
        let [near, depth] = [half, full].map(|frame| frame.depth.as_ref().unwrap().values()[dot]);
        let is_there = near == depth || (near - depth).abs() <= 1e-3 * depth;
        differing.others += usize::from(object(half) != object(full) || !is_there);
    }
    differing
}

fn both(studio: &Studio, camera: &Camera, dots: Size, precision: PrecisionChoice) -> [Frame; 2] {
    [precision, PrecisionChoice::Double].map(|choice| studio.draw_anew(&plain(camera.clone(), dots, choice)))
}

/// Checks all views of a scene, and counts those that took single precision.
#[track_caller]
fn alike(name: &str, scene: Scene) -> usize {
    let studio = Studio::new(scene).unwrap();
    let mut halves = 0;
    for (view, camera) in views(&studio) {
        let [half, full] = both(&studio, &camera, DOTS, PrecisionChoice::Auto);
        assert_eq!(full.precision, Precision::Double);
        halves += usize::from(half.precision == Precision::Single);
        let differing = differing(&half, &full);
        assert!(differing.is_small(), "{name}, {view}: {differing:?}");
    }
    halves
}

#[test]
fn scenes_as_people_write_them() {
    let inside: usize = embedded_scenes().into_iter().map(|(name, scene)| alike(name, scene)).sum();
    assert!(inside >= 6, "{inside} views took single precision");
    for (name, scene) in with_those_beside(&CSG, "openscad") {
        assert!(alike(&name, scene) > 0, "{name} took double precision");
    }
}

fn studio(text: &str) -> Studio {
    Studio::new(read("a text", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
        .unwrap()
}

#[track_caller]
fn same_from(text: &str, eyes: &[DVec3]) {
    let studio = studio(text);
    for &eye in eyes {
        let camera = Camera { eye, target: DVec3::ZERO, ..studio.camera(0, 1.0) };
        let [half, full] = both(&studio, &camera, Size::new(200, 200), PrecisionChoice::Auto);
        assert_eq!(half.precision, Precision::Single, "{text}");
        assert!(full.counts.primary_hits > 5000, "{text}");
        let differing = differing(&half, &full);
        assert!(differing.is_small(), "{text}, from {eye}: {differing:?}");
    }
}

/// What single precision can not tell apart is traced in double precision: a wall of a millionth, with one
/// face from each of two primitives.
#[test]
fn thin_walls_stay() {
    let eyes = [DVec3::new(1.0, -2.0, 6.0), DVec3::new(5.0, 0.1, 1.0)];
    same_from(
        "difference() { cube(2, center = true); translate([0, 0, -0.000001]) cube(2, center = true); }
         difference() { translate([1, 1, 0]) sphere(1); translate([1, 1, 0]) sphere(0.999999); }",
        &eyes,
    );
}

/// Chords through a sharp edge are shorter than what their ends are off: a strip along it was lost that was
/// dots wide.
#[test]
fn sharp_edges_stay() {
    let above = [DVec3::new(0.0, 0.0, 10.0), DVec3::new(0.0, -1.0, 10.0), DVec3::new(3.0, -5.0, 7.0)];
    for text in [
        "cylinder(h = 0.01, r1 = 2, r2 = 0);",
        "cylinder(h = 0.01, r1 = 2, r2 = 1);",
        "cylinder(h = 0.01, r1 = 2, r2 = 0, $fn = 6);",
        "polyhedron([[-2, -2, 0], [2, -2, 0], [0, 2, 0], [0, 0, 0.01]], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);",
        "difference() {
            translate([-2, -2, -1]) cube([4, 4, 1]);
            translate([0, 0, -0.01]) cylinder(h = 0.01, r1 = 0, r2 = 1.5);
         }",
        "multmatrix([[1, 0, 300, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube([2, 2, 0.006], center = true);",
    ] {
        same_from(text, &above);
    }
}

/// What lies at the start of a ray, to within what single precision lose, was passed over.
#[test]
fn an_eye_beside_a_face_sees_it() {
    let studio = studio(
        "difference() { cube(2, center = true); translate([0.5, 0, 0]) sphere(0.3); } cube([0.1, 3, 3]);",
    );
    for height in [1e-5, 1e-9, -1e-5] {
        let eye = DVec3::new(-0.5, 0.1, 1.0 + height);
        for target in [DVec3::new(-0.4, 0.2, 0.0), DVec3::new(0.9, 0.1, 0.99)] {
            let camera = Camera { eye, target, ..studio.camera(0, 1.0) };
            let [half, full] = both(&studio, &camera, Size::new(64, 64), PrecisionChoice::Single);
            let differing = differing(&half, &full);
            assert!(full.counts.primary_hits > 0 && differing.is_small(), "{height} {target}: {differing:?}");
        }
    }
}

/// A face that is skimmed and lies behind another: a row of dots saw it.
#[test]
fn a_row_in_the_plane_of_a_face() {
    let studio = studio("cube(2, center = true);");
    for height in [0.0, 1e-8, 3e-8, 5e-8, 1e-6] {
        let eye = DVec3::new(8.0, 0.0, 1.0 + height);
        let camera = Camera { eye, target: DVec3::new(0.0, 0.0, eye.z - 1e-9), ..studio.camera(0, 1.0) };
        let [half, full] = both(&studio, &camera, Size::new(201, 201), PrecisionChoice::Auto);
        assert_eq!(half.precision, Precision::Single);
        let differing = differing(&half, &full);
        assert!(differing.is_small(), "{height}: {differing:?}");
    }
}

/// Squares of what is so thin are beyond f32.
#[test]
fn what_is_beyond_the_numbers_is_asked_with_all_digits() {
    for thin in ["1e-18", "1e-25", "1e-40"] {
        for solid in ["sphere(1)", "rotate([10, 20, 30]) cube(1)", "cylinder(h = 1, r = 1)"] {
            let studio = studio(&format!("scale([1, 1.5, {thin}]) {solid}; translate([3, 0, 0]) cube(1);"));
            let camera = studio.camera(0, 1.0);
            let [half, full] = both(&studio, &camera, Size::new(48, 48), PrecisionChoice::Single);
            assert_eq!(half.precision, Precision::Double);
            assert_same_picture(&format!("{solid}, {thin}"), &half, &full);
        }
    }
}

/// Edges on a row of dots: which of two faces a ray meets there was left to single precision.
#[test]
fn edges_in_the_plane_of_a_row_show_the_same_face() {
    let text = "rotate([180, 90, 0]) cube([0.5, 1.5, 0.5], center = true);
        translate([0, -0.5, 0]) cube([1, 2, 0.5], center = false);
        translate([1, 1, -1]) multmatrix([[1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]) cylinder(h = 2, r = 0.5, $fn = 8);";
    let studio = studio(text);
    for eye in [DVec3::new(7.0, 0.0, -2.0), DVec3::new(0.0, -6.0, 0.0), DVec3::new(-5.0, 0.5, 0.25)] {
        for toward in [-eye.with_z(0.0), -eye.with_y(0.0)] {
            let camera = Camera {
                eye,
                target: eye + toward,
                field: [53.130_102_354_155_98; 2],
                ..studio.camera(0, 1.0)
            };
            let [half, full] = both(&studio, &camera, Size::new(161, 161), PrecisionChoice::Single);
            assert_eq!(
                half.levels(Tone::default()),
                full.levels(Tone::default()),
                "from {eye} along {toward}"
            );
        }
    }
}

/// Flush faces of two objects, seen so aslant that both are met anywhere within more than a rounding.
#[test]
fn flush_faces_are_the_first_in_the_file_however_aslant() {
    let low = [DVec3::new(0.0, -30.0, 0.1), DVec3::new(25.0, 9.0, 0.05)];
    let text = "camera(name = \"low\", eye = [0, -30, 0.1], target = [0, 0, 0], field = [10, 1]);
        color(\"black\") translate([-2, -2, -1]) cube([4, 4, 1]);
        translate([0, 0, -0.5]) cylinder(h = 0.5, r = 1.5);";
    let studio = studio(text);
    for eye in low {
        let camera = Camera { eye, ..studio.camera(0, 1.0) };
        let [half, full] = both(&studio, &camera, Size::new(200, 40), PrecisionChoice::Single);
        let differing = differing(&half, &full);
        assert!(full.counts.primary_hits > 100 && differing.is_small(), "from {eye}: {differing:?}");
    }
}

/// Where single precision finds a face on the box of its mesh, the hit may lie beside that box: a ray from
/// there counted as one that starts outside, so that past the face it was inside for ever. Shadows fell where
/// it passed over the hole, and glass was entered where it was left.
#[test]
fn rays_leave_the_faces_of_meshes_that_end_with_their_boxes() {
    let star = |height: f64, size: f64| {
        let corners: Vec<String> = (0..12_u32)
            .map(|i| {
                let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 12.0);
                let reach = if i.is_multiple_of(2) { size } else { 0.7 * size };
                format!("[{}, {}]", cos * reach, sin * reach)
            })
            .collect();
        format!("linear_extrude(height = {height}) polygon([{}]);", corners.join(", "))
    };
    let nut = format!("difference() {{ {} translate([0, 0, -1]) {} }}", star(1.3, 3.0), star(3.0, 1.5));
    let glass = format!(
        "material(kt = 0.7, index = 1.4) {} translate([-3, -3, -1]) cube([6, 6, 0.2]);",
        star(1.3, 3.0)
    );
    for text in [nut, glass] {
        let studio = studio(&format!("light(at = [9, -6, 8]); {text}"));
        let camera = Camera { eye: DVec3::new(7.0, -5.0, 6.0), target: DVec3::ZERO, ..studio.camera(0, 1.0) };
        let [half, full] = [PrecisionChoice::Single, PrecisionChoice::Double].map(|precision| {
            let request = request(camera.clone(), DOTS);
            studio.draw_anew(&Request { options: Options { precision, ..request.options }, ..request })
        });
        assert_eq!(half.precision, Precision::Single, "{text}");
        assert!(full.counts.primary_hits > 2000, "{}: {text}", full.counts.primary_hits);
        let differing = differing(&half, &full);
        assert!(differing.is_small(), "{text}: {differing:?}");
    }
}

#[test]
fn the_plan_knows_where_half_the_digits_would_be_seen() {
    let precision = |text: &str, change: &dyn Fn(&mut Request)| {
        let studio = studio(text);
        let mut request = plain(studio.camera(0, 1.0), Size::new(64, 64), PrecisionChoice::Auto);
        change(&mut request);
        studio.draw_anew(&request).precision
    };
    let cut = "difference() { cube(2, center = true); sphere(1.2); }";
    assert_eq!(precision(cut, &|_| {}), Precision::Single);
    // Near the surface a dot is small.
    assert_eq!(precision(cut, &|r| r.camera.zoom = 1e3), Precision::Double);
    assert_eq!(precision(cut, &|r| r.camera.eye = r.camera.target), Precision::Double);
    // Rays start on surfaces.
    assert_eq!(precision(cut, &|r| r.options.shadows = true), Precision::Double);
    let mirror = format!("material(kr = 0.5) {{ {cut} }}");
    assert_eq!(precision(&mirror, &|_| {}), Precision::Single);
    assert_eq!(precision(&mirror, &|r| r.options.shading = Shading::Whitted), Precision::Double);
    // So thin that all rays would be asked twice.
    let plate = format!("{cut} rotate([30, 20, 10]) cylinder(h = 1e-5, r = 2, $fn = 6);");
    assert_eq!(precision(&plate, &|_| {}), Precision::Double);
    assert_eq!(precision("sphere(1);", &|_| {}), Precision::Double);
    assert_eq!(precision(cut, &|r| r.options.precision = PrecisionChoice::Double), Precision::Double);
}

proptest! {
    // The same cases each time: a test that fails tells of the change before it.
    #![proptest_config(ProptestConfig { cases: 48, rng_seed: RngSeed::Fixed(13), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_scenes_are_the_same(scene in any_scene()) {
        let studio = Studio::new(scene).unwrap();
        let dots = Size::new(96, 80);
        let [half, full] = both(&studio, &studio.camera(0, 1.2), dots, PrecisionChoice::Single);
        let differing = differing(&half, &full);
        // Where light happens to be as bright as the step between two levels a row of dots may take the
        // other.
        let few = differing.levels * 500 <= differing.dots;
        prop_assert!(differing.others == 0 && differing.far == 0 && few, "{:?}", differing);
    }
}

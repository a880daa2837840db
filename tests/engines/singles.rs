//! Half the digits against all of them: the same picture, but for dots on edges that the plan allows for.

use proptest::prelude::*;
use ray13::frame::{Frame, Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{Options, Precision, PrecisionChoice, Shading};
use ray13::scene::{Camera, ReadOptions, Scene, read};
use ray13::tone::Tone;

use crate::random::any_scene;
use crate::request::request;
use crate::scenery::embedded_scenes;
use crate::scenes::{beside, views};

const DOTS: Size = Size::new(256, 192);

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
    /// Dots of another level; and those among them of one that is not the next, and that see no edge in `full`.
    levels: usize,
    far: usize,
}

/// Whether a dot or one of its neighbours sees something that the dot does not: another object, or another face of it.
fn is_at_edge(frame: &Frame, (column, row): (u32, u32)) -> bool {
    let (objects, normals) = (frame.object.as_ref().unwrap(), frame.normal.as_ref().unwrap());
    let depths = frame.depth.as_ref().unwrap();
    let size = objects.size();
    let around = |x: u32, most: u32| x.saturating_sub(1)..(x + 2).min(most);
    let here = (column, row);
    around(row, size.height).flat_map(|j| around(column, size.width).map(move |i| (i, j))).any(|there| {
        objects[there] != objects[here]
            || normals[there].dot(normals[here]) < 0.9
            || (depths[there] - depths[here]).abs() > 0.01 * depths[here]
    })
}

fn differing(half: &Frame, full: &Frame) -> Differing {
    let tone = Tone::default();
    let (one, other) = (half.levels(tone), full.levels(tone));
    let size = one.size();
    let mut differing = Differing { dots: size.area(), ..Differing::default() };
    for (j, i) in (0..size.height).flat_map(|j| (0..size.width).map(move |i| (j, i))) {
        let steps = one[(i, j)].get().abs_diff(other[(i, j)].get());
        differing.levels += usize::from(steps > 0);
        differing.far += usize::from(steps > 1 && !is_at_edge(full, (i, j)));
    }
    differing
}

fn both(studio: &Studio, camera: &Camera, dots: Size, precision: PrecisionChoice) -> [Frame; 2] {
    [precision, PrecisionChoice::Double].map(|choice| studio.draw_anew(&plain(camera.clone(), dots, choice)))
}

/// Checks all views of a scene, and counts those that took half the digits.
#[track_caller]
fn alike(name: &str, scene: Scene) -> usize {
    let studio = Studio::new(scene).unwrap();
    let mut halves = 0;
    for (view, camera) in views(&studio) {
        let [half, full] = both(&studio, &camera, DOTS, PrecisionChoice::Auto);
        assert_eq!(full.precision, Precision::Double);
        halves += usize::from(half.precision == Precision::Single);
        let differing = differing(&half, &full);
        let few = differing.levels * 1000 <= differing.dots;
        assert!(few && differing.far == 0, "{name}, {view}: {differing:?}");
    }
    halves
}

#[test]
fn one_dot_in_a_thousand_differs_at_most() {
    let inside: usize = embedded_scenes().into_iter().map(|(name, scene)| alike(name, scene)).sum();
    assert!(inside >= 6, "{inside} views took half the digits");
    for (name, scene) in beside("openscad") {
        assert!(alike(&name, scene) > 0, "{name} took all digits");
    }
}

fn studio(text: &str) -> Studio {
    Studio::new(read("a text", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
        .unwrap()
}

/// What half the digits can not tell apart is asked with all: a wall of a millionth, with one face from each of two primitives.
#[test]
fn thin_walls_stay() {
    let studio = studio(
        "difference() { cube(2, center = true); translate([0, 0, -0.000001]) cube(2, center = true); }
         difference() { translate([3, 0, 0]) sphere(1); translate([3, 0, 0]) sphere(0.999999); }",
    );
    let camera = Camera { eye: DVec3::new(1.0, -2.0, 9.0), target: DVec3::X, ..studio.camera(0, 1.0) };
    let [half, full] = both(&studio, &camera, Size::new(64, 64), PrecisionChoice::Auto);
    assert_eq!(half.precision, Precision::Single);
    assert!(half.counts.primary_hits > 500);
    assert!(half.counts.primary_hits.abs_diff(full.counts.primary_hits) <= 2);
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
    // So thin that rays might miss it.
    let plate = format!("{cut} rotate([30, 20, 10]) cylinder(h = 1e-5, r = 2, $fn = 6);");
    assert_eq!(precision(&plate, &|_| {}), Precision::Double);
    assert_eq!(precision("sphere(1);", &|_| {}), Precision::Double);
    assert_eq!(precision(cut, &|r| r.options.precision = PrecisionChoice::Double), Precision::Double);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn random_scenes_differ_at_edges_only(scene in any_scene()) {
        let studio = Studio::new(scene).unwrap();
        let dots = Size::new(96, 80);
        let [half, full] = both(&studio, &studio.camera(0, 1.2), dots, PrecisionChoice::Single);
        let differing = differing(&half, &full);
        prop_assert!(differing.far == 0 && differing.levels * 200 <= differing.dots, "{:?}", differing);
    }
}

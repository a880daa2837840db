//! The same bits at every SIMD width.

use fearless_simd::Level;
#[cfg(not(feature = "fallback"))]
use fearless_simd::Simd;
use ray13::frame::{Request, Studio};
use ray13::math::Size;
use ray13::plan::{Options, PrecisionChoice};
use ray13::scene::{Scene, read};

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::same::fast;
use crate::support::scenery::embedded_scenes;

/// No width at all, and the best that this processor has, to which the others are held where this is not
/// compiled.
#[cfg(feature = "fallback")]
fn levels() -> Vec<(&'static str, Level)> {
    vec![("fallback", Level::fallback()), ("the best", Level::new())]
}

/// All widths that this processor has; no width at all is compiled with `--features fallback`.
#[cfg(not(feature = "fallback"))]
fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    {
        let all = [
            best.as_sse2().map(|simd| ("SSE2", simd.level())),
            best.as_sse4_2().map(|simd| ("SSE4.2", simd.level())),
            best.as_avx2().map(|simd| ("AVX2", simd.level())),
            best.as_avx512().map(|simd| ("AVX-512", simd.level())),
        ];
        all.into_iter().flatten().collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    vec![("the best", best)]
}

/// One scene with everything that has a formula of its own: balls, boxes straight and skew, round solids,
/// prisms, meshes, expressions of them, mirrors and glass.
const ALL_KINDS: &str = "
    light(at = [6, -6, 8]); light(at = [-5, -3, 4], intensity = 0.5);
    material(kr = 0.4) translate([-3, 0, 0]) sphere(1);
    material(kt = 0.6, index = 1.5) scale([1, 0.5, 1]) sphere(1);
    translate([3, 0, -1]) cube(2);
    rotate([20, 30, 40]) translate([0, 4, 0]) cube([1, 2, 3], center = true);
    translate([-3, 3, 0]) cylinder(h = 2, r1 = 1, r2 = 0.3);
    translate([3, 3, 0]) cylinder(h = 2, r = 1, $fn = 7);
    translate([0, 0, 2]) polyhedron([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, 0.25]],
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]);
    translate([0, -2, 0]) difference() { cube(1, center = true); sphere(0.6); cylinder(h = 3, r = 0.2, center = true); }
    translate([-3, -2, 0]) difference() {
        cylinder(h = 1, r = 1, center = true);
        for_all();
    }
";

fn all_kinds() -> Scene {
    let holes: String = (0..12)
        .map(|i| {
            format!("rotate({}) translate([0.7, 0, 0]) cylinder(h = 3, r = 0.1, center = true);", 30 * i)
        })
        .collect();
    let text = ALL_KINDS.replace("for_all();", &holes);
    read("kinds", text.as_bytes(), &ray13::scene::ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

#[track_caller]
fn same_at_all(name: &str, scene: &Scene, ask: impl Fn(&Studio) -> Request) {
    let mut first = None;
    for (width, level) in levels() {
        let studio = Studio::new(scene.clone()).unwrap().at_level(level);
        let frame = fast(&studio, &ask(&studio));
        let (other, expected) = first.get_or_insert_with(|| (width, frame.clone()));
        let what = format!("{name}, {other} and {width}");
        assert_same_picture(&what, expected, &frame);
        assert_eq!(expected.counts, frame.counts, "{what}");
    }
}

fn plain(studio: &Studio, dots: Size) -> Request {
    request(studio.camera(0, f64::from(dots.width) / f64::from(dots.height)), dots)
}

#[test]
fn scenes_inside_the_program_are_the_same() {
    for (name, scene) in embedded_scenes() {
        same_at_all(name, &scene, |studio| plain(studio, Size::new(65, 40)));
    }
}

#[test]
fn solids_of_all_kinds_are_the_same_at_any_size_of_the_picture() {
    let scene = all_kinds();
    for (width, height) in [(1, 1), (7, 9), (8, 8), (33, 65), (96, 64)] {
        same_at_all("all kinds", &scene, |studio| plain(studio, Size::new(width, height)));
    }
}

#[test]
fn samples_and_colours_are_the_same() {
    let scene = all_kinds();
    for (samples, color) in [(2, false), (1, true), (3, true)] {
        same_at_all("all kinds", &scene, |studio| {
            let plain = plain(studio, Size::new(41, 35));
            Request { options: Options { samples, color, ..plain.options }, ..plain }
        });
    }
}

#[test]
fn half_the_digits_are_the_same() {
    let scene = all_kinds();
    for (width, height) in [(7, 9), (96, 64)] {
        same_at_all("all kinds", &scene, |studio| {
            let plain = plain(studio, Size::new(width, height));
            let precision = PrecisionChoice::Single;
            Request { options: Options { precision, shadows: false, ..plain.options }, ..plain }
        });
    }
}

#[test]
fn an_eye_far_away_or_within_sees_the_same() {
    let scene = all_kinds();
    for share in [1e-3, 0.3, 1e3, 1e9, 1e100] {
        same_at_all("all kinds", &scene, |studio| {
            let mut request = plain(studio, Size::new(33, 33));
            let camera = &mut request.camera;
            camera.eye = camera.target + (camera.eye - camera.target) * share;
            camera.zoom = share.clamp(1.0, 1e12);
            request
        });
    }
}

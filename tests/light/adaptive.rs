//! Anti-aliasing by need: where a level is decided one ray is enough, where it is not as many as it takes.

use ray13::frame::{Frame, Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{ERROR, EngineChoice, Options, PrecisionChoice};
use ray13::scene::{Camera, EmbeddedScene, ReadOptions, embedded, read};
use ray13::tone::Tone;

use crate::support::request::request;

const DOTS: Size = Size::new(72, 48);

/// Rays of a dot of a reference: none of those that are compared with it.
const REFERENCE: std::ops::Range<u32> = 1024..1088;

fn studio(text: &str) -> Studio {
    let scene = read("adaptive", text.as_bytes(), &ReadOptions::default());
    Studio::new(scene.unwrap_or_else(|e| panic!("{e}"))).unwrap()
}

fn with(plain: &Request, change: impl FnOnce(&mut Options)) -> Request {
    let mut request = plain.clone();
    change(&mut request.options);
    request
}

fn adaptive(plain: &Request) -> Request {
    with(plain, |options| options.adaptive = Some(ERROR))
}

fn plain(studio: &Studio) -> Request {
    request(studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height)), DOTS)
}

/// Those that take little time: CSG, a mirror, and curved solids.
fn some_scenes() -> impl Iterator<Item = &'static EmbeddedScene> {
    embedded().iter().filter(|scene| ["hanyang", "bolt", "die"].contains(&scene.name))
}

fn wrong_levels(frame: &Frame, reference: &Frame) -> usize {
    let [own, other] = [frame, reference].map(|frame| frame.levels(Tone::Lightness));
    own.values().iter().zip(other.values()).filter(|(own, other)| own != other).count()
}

#[test]
fn a_level_that_nothing_puts_in_doubt_takes_one_ray() {
    let studio = studio("light(at = [0, -1e6, 0]); cube(1000, center = true);");
    let camera = Camera { eye: DVec3::new(0.0, -600.0, 0.0), target: DVec3::ZERO, ..plain(&studio).camera };
    let frame = studio.draw(&adaptive(&request(camera, DOTS)));
    assert_eq!(frame.counts.primary_rays, DOTS.area() as u64);
}

/// On three scenes together as few levels are wrong as with 16 rays a dot, give or take a tenth, with two
/// fifths of the rays at most; none of the scenes has twice as many wrong.
#[test]
fn adaptive_rays_are_as_good_as_sixteen_with_two_fifths_of_them() {
    let (mut wrong, mut wrong_of_16, mut rays) = (0, 0, 0.0);
    for scene in some_scenes() {
        let studio = studio(scene.text);
        let plain = Request { dots: Size::new(128, 84), ..plain(&studio) };
        let reference = studio.draw_samples(&plain, REFERENCE);
        let own = studio.draw(&adaptive(&plain));
        let sixteen = studio.draw(&with(&plain, |options| options.samples = 4));
        let [one, other] = [&own, &sixteen].map(|frame| wrong_levels(frame, &reference));
        // A few dots either way are chance.
        assert!(one <= 2 * other + 8, "{}: {one} wrong levels, {other} with 16 rays", scene.name);
        wrong += one;
        wrong_of_16 += other;
        rays += own.counts.primary_rays as f64 / sixteen.counts.primary_rays as f64 / 3.0;
    }
    assert!(wrong * 10 <= wrong_of_16 * 11, "{wrong} wrong levels, {wrong_of_16} with 16 rays");
    assert!(rays < 0.4, "{rays} of the rays");
}

#[test]
fn both_engines_any_threads_and_colours_have_the_same_dots() {
    let scene = "light(at = [3, -4, 5], color = \"orange\"); light(at = [-5, -4, 2]); \
        material(name = \"glass\", kt = 0.7, index = 1.5); \
        translate([0.4, -2, 0]) material(\"glass\") sphere(0.6); material(kr = 0.4) cube(1); \
        difference() { translate([-1, 1, 0]) sphere(1); translate([-1, 0, 0]) cylinder(h = 9, r = 0.2); }";
    for color in [false, true] {
        let draw = |engine, threads| {
            let studio = studio(scene);
            let precision = PrecisionChoice::Double;
            let request = with(&adaptive(&plain(&studio)), |options| {
                *options = Options { engine, threads, color, precision, ..*options };
            });
            studio.draw(&request)
        };
        let exact = draw(EngineChoice::Exact, 1);
        assert!(exact.counts.primary_rays > DOTS.area() as u64);
        for threads in [1, 3] {
            let comparison = draw(EngineChoice::Fast, threads).compare(&exact).unwrap();
            assert!(comparison.is_same(), "{threads} threads: {comparison}");
        }
    }
}

/// Wires of a fifth of a dot, between the middles of dots: no ray through a middle meets them.
#[test]
fn what_lies_between_all_middles_is_found_by_its_solid() {
    let size = Size::new(32, 32);
    let wires = (-3..=3)
        .map(|i| format!("translate([{}, -0.1, -14]) cube([0.2, 0.2, 28]);", 4.0 * f64::from(i) - 0.1));
    let studio = studio(&format!("light(at = [0, -1e3, 0]); {}", wires.collect::<String>()));
    let camera = Camera {
        eye: DVec3::new(0.0, -16.0, 0.0),
        target: DVec3::ZERO,
        field: [90.0, 90.0],
        ..studio.camera(0, 1.0)
    };
    let plain = request(camera, size);
    let lit = |frame: &Frame| frame.light.values().iter().filter(|&&light| light > 0.0).count();
    assert_eq!(lit(&studio.draw(&plain)), 0);
    assert!(lit(&studio.draw(&adaptive(&plain))) > 7 * 24);
}

/// A camera that moves by a tenth of a dot changes hardly more levels than with as many rays for each dot.
#[test]
fn what_moves_does_not_flicker() {
    let changed = |request: &Request, studio: &Studio| {
        let camera = &request.camera;
        let sight = camera.target - camera.eye;
        let dot =
            2.0 * sight.length() * libm::tan(0.5 * camera.field[0].to_radians()) / f64::from(DOTS.width);
        let aside = sight.cross(camera.up).normalize() * (0.1 * dot);
        let moved = Camera { eye: camera.eye + aside, target: camera.target + aside, ..camera.clone() };
        let moved = Request { camera: moved, ..request.clone() };
        wrong_levels(&studio.draw(request), &studio.draw(&moved))
    };
    let (mut own, mut fixed) = (0, 0);
    for scene in some_scenes() {
        let studio = studio(scene.text);
        let plain = plain(&studio);
        own += changed(&adaptive(&plain), &studio);
        fixed += changed(&with(&plain, |options| options.samples = 4), &studio);
    }
    assert!(own * 10 <= fixed * 12, "{own} levels change, {fixed} with 16 rays");
}

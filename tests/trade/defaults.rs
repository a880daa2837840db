//! The defaults lose less than half a level where that can be held: what is spared of mirror and Snell rays,
//! and of precision.

use ray13::frame::{Frame, Request, Studio};
use ray13::math::Size;
use ray13::plan::{CUTOFF, EngineChoice, Options, PrecisionChoice, StructureChoice};
use ray13::scene::embedded;

use super::{given, inside, picture};

/// Half a level, in twelfths of L*.
const HALF: f64 = 0.5;

const DOTS: Size = Size::new(64, 39);

fn drawn(studio: &Studio, options: Options) -> Frame {
    studio.draw(&Request { options, ..picture(studio, DOTS) })
}

/// Each view of each scene inside.
fn each_view(mut look: impl FnMut(&str, &dyn Fn(Options) -> Frame)) {
    for scene in embedded() {
        let studio = inside(scene.name);
        for view in 0..studio.scene().views.len().max(1) {
            let camera = studio.camera(view, f64::from(DOTS.width) / f64::from(DOTS.height));
            let name = format!("{}, {}", scene.name, camera.name.as_deref().unwrap_or("framed"));
            let base = Request { camera, ..picture(&studio, DOTS) };
            look(&name, &|options| studio.draw(&Request { options, ..base.clone() }));
        }
    }
}

#[test]
fn cut_off_depth_and_precision_lose_less_than_half_a_level() {
    each_view(|view, drawn| {
        let own = drawn(Options::default());
        let precision = PrecisionChoice::Double;
        let all = Options { depth: 64, cutoff: CUTOFF / 10.0, precision, ..Options::default() };
        let loss = own.compare(&drawn(all)).unwrap();
        assert!(loss.light < HALF, "{view}: {loss}");
    });
}

/// No number of rays has every edge within half a level, so in the mean: four rays a dot have it, one has it
/// within a level.
#[test]
fn rays_a_dot_lose_less_than_half_a_level_in_the_mean_from_four_on() {
    for scene in embedded() {
        let studio = inside(scene.name);
        let base = picture(&studio, Size::new(96, 58));
        let drawn = |options| studio.draw(&Request { options, ..base.clone() });
        let [one, four, many] = [1, 2, 4].map(|samples| drawn(Options { samples, ..Options::default() }));
        let [one, four] = [one, four].map(|frame| frame.compare(&many).unwrap());
        assert!(four.light_rms < HALF && one.light_rms < 2.0 * HALF, "{}: {one}; {four}", scene.name);
    }
}

/// Whatever `auto` takes of engines and structures, the picture is the same to the bit.
#[test]
fn engine_and_structure_lose_nothing() {
    for scene in embedded() {
        let studio = inside(scene.name);
        let double = Options { precision: PrecisionChoice::Double, ..Options::default() };
        let own = drawn(&studio, double);
        for structure in [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree] {
            let exact = Options { engine: EngineChoice::Exact, structure, ..double };
            let other = drawn(&studio, exact).compare(&own).unwrap();
            assert!(other.is_same(), "{} {structure:?}: {other}", scene.name);
        }
    }
}

/// Nine glass balls, each in the one before: a ray that all are asked about splits in two at each surface.
#[test]
fn the_cut_off_spares_seven_of_eight_rays_in_nested_glass_and_half_a_level_at_most() {
    let studio = given(include_str!("../files/nested-glass.scene"));
    let deep = Options { depth: 9, ..Options::default() };
    let [own, all] = [CUTOFF, 0.0].map(|cutoff| drawn(&studio, Options { cutoff, ..deep }));
    let loss = own.compare(&all).unwrap();
    assert!(loss.light < HALF, "{loss}");
    assert!(8 * own.counts.secondary_rays <= all.counts.secondary_rays);
}

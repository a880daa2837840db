//! A reference knows how well it knows.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

use ray13::math::Size;
use ray13::scene::embedded;
use ray13::stage::GiveUp;
use ray13::tone::lightness;
use ray13::trade::{EyeDistance, LevelDifference, Reference, ReferenceGoal};

use super::{inside, picture, reference};

/// What a reference claims holds against one of 16 times the rays, by as much as that one claims itself.
#[test]
fn the_claimed_error_holds() {
    // Not where a ray is hundreds in glass, or goes through a solid of hundreds: their edges are as others'.
    for scene in embedded().iter().filter(|scene| !["glass", "bolt"].contains(&scene.name)) {
        let studio = inside(scene.name);
        let base = picture(&studio, Size::new(32, 20));
        let [few, many] = [8, 128].map(|rays| reference(&studio, &base, rays));
        assert_eq!((few.rays(), many.rays()), (8, 128));
        let wrong = LevelDifference::between(few.levels(), many.levels()).unwrap();
        let wrong = wrong.beyond(0) as f64 / wrong.all() as f64;
        let [claimed, finer] = [few.error(), many.error()];
        assert!(wrong <= claimed.wrong + finer.wrong, "{}: {wrong}, {claimed:?}, {finer:?}", scene.name);
        let apart = |(a, b): (&f64, &f64)| (lightness(*a) - lightness(*b)) / (100.0 / 12.0);
        let squares = few.light().values().iter().zip(many.light().values()).map(apart).map(|x| x * x);
        let rms = (squares.sum::<f64>() / few.light().size().area() as f64).sqrt();
        assert!(rms <= claimed.rms + finer.rms, "{}: {rms}, {claimed:?}, {finer:?}", scene.name);
        assert!(finer.wrong < claimed.wrong / 2.0 && finer.rms < claimed.rms / 2.0, "{}", scene.name);
    }
}

/// From `--samples 2`, which took the very four rays of a reference of four: 0 wrong levels, and recommended.
#[test]
fn no_setting_is_held_against_its_own_rays() {
    let studio = inside("die");
    let base = picture(&studio, Size::new(64, 40));
    for (samples, rays) in [(2, 4), (4, 16)] {
        let mut request = base.clone();
        request.options.samples = samples;
        let frame = studio.draw_anew(&request);
        let found = reference(&studio, &base, rays);
        assert_ne!(frame.light.values(), found.light().values(), "{rays} rays");
    }
}

/// What a reference has when it is given up is a reference of fewer rays.
#[test]
fn a_reference_that_is_given_up_has_the_rays_until_then() {
    let studio = inside("hanyang");
    let base = picture(&studio, Size::new(16, 16));
    let goal = ReferenceGoal { apart: 0.01, rays: Some(1024), until: Instant::now() };
    let given_up_after = |times: u32| {
        let asked = AtomicU32::new(0);
        let when = || asked.fetch_add(1, Ordering::Relaxed) >= times;
        Reference::new(&studio, &base, &goal, EyeDistance::default(), &GiveUp::when(&when))
    };
    assert!(given_up_after(0).is_none() && given_up_after(4).is_none());
    let found = given_up_after(60).unwrap();
    assert!((8..=32).contains(&found.rays()), "{}", found.rays());
    let same = reference(&studio, &base, found.rays());
    assert_eq!(found.light().values(), same.light().values());
    assert_eq!(found.error(), same.error());
}

/// The exact engine answers for all rays, though it traces few: the fast one is held to its bits.
#[test]
fn the_fast_engine_is_trusted_while_it_finds_the_bits() {
    let studio = inside("glass");
    let base = picture(&studio, Size::new(32, 16));
    let found = reference(&studio, &base, 16);
    assert_eq!((found.rays(), found.exact_rays()), (16, 4));
    let [two, three] = [2, 3].map(|rays| reference(&studio, &base, rays));
    assert_eq!([two.exact_rays(), three.exact_rays(), three.rays()], [2, 4, 4]);
}

//! Single solids from afar, and very long or flat ones.

use ray13::math::{DMat3, DVec3};
use ray13::scene::{Primitive, Scene, Shape, Solid};

use crate::conformance::aim::aimed;
use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Subject};
use crate::conformance::long::{cases, report, skipped};
use crate::conformance::solids::{placed, primitive, scene};
use crate::conformance::tally::Tally;

/// Solids for each decade, and rays at each of them.
const SOLIDS: usize = 5;
const RAYS: usize = 20;

/// What else stands in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
enum World {
    Lone,
    /// A second solid as far off as the eye, so that the world is as large as the way.
    Large,
}

fn world_of(primitive: &Primitive, world: World, distance: f64, away: DVec3) -> Scene {
    let lone = Solid::Primitive(primitive.clone());
    match world {
        World::Lone => scene([lone]),
        World::Large => {
            let far = primitive.map.translation + away * (10.0 + 2.0 * distance);
            scene([lone, placed(&Shape::Sphere, far, DVec3::ONE)])
        }
    }
}

/// Rays at one solid against the oracle. Rays that meet the second solid first say nothing of it.
fn tally<S: Subject>(
    primitive: &Primitive,
    ratio: f64,
    world: World,
    distance: f64,
    chance: &mut Chance,
) -> Tally {
    let subject = S::new(&world_of(primitive, world, distance, chance.direction()), Cut::Tree);
    let rays: Vec<_> = (0..RAYS).map(|_| aimed(primitive, distance, chance)).collect();
    let mut tally = Tally::default();
    for (ray, found) in rays.iter().zip(subject.first(&rays)) {
        if found.is_none_or(|found| found.object == 0) {
            tally.count(&subject, primitive, ratio, ray, found);
        }
    }
    tally
}

/// A solid of about 1 in size, turned, near the origin.
fn somewhere(shape: &Shape, half: DVec3, chance: &mut Chance) -> Primitive {
    primitive(shape, chance.turn() * DMat3::from_diagonal(half), chance.point() * 2.0)
}

/// From 1 to 1e9 radii away.
pub fn at_any_distance<S: Subject>(name: &str, shape: &Shape, round: bool) {
    let mut faults = Tally::default();
    for world in [World::Lone, World::Large] {
        for decade in 0..=9_i32 {
            let distance = libm::pow(10.0, f64::from(decade));
            if distance > S::RANGE.distance || (world == World::Large && distance > S::RANGE.world) {
                skipped(&format!("{name}, {world:?}, 1e{decade} radii"));
                continue;
            }
            let mut sum = Tally::default();
            for case in 0..cases(SOLIDS, 100) {
                let chance = &mut Chance::new(name, (decade as u64) << 32 | case as u64);
                let half = if round {
                    DVec3::ONE
                } else {
                    DVec3::new(chance.within(0.3, 1.0), chance.within(0.3, 1.0), chance.within(0.3, 1.0))
                };
                let solid = somewhere(shape, half, chance);
                sum.add(tally::<S>(&solid, half.max_element() / half.min_element(), world, distance, chance));
            }
            report(|| format!("{name}, {world:?}, 1e{decade} radii: {}", sum.figures()));
            faults.add(sum);
        }
    }
    faults.assert_right(name);
}

/// Needles and coins, one axis or two as long as 1 to 1e6 of the others, along the axes and turned.
pub fn at_any_ratio<S: Subject>(name: &str, shape: &Shape) {
    let mut faults = Tally::default();
    for decade in 0..=6_i32 {
        let ratio = libm::pow(10.0, f64::from(decade));
        if ratio > S::RANGE.ratio {
            skipped(&format!("{name}, ratio 1e{decade}"));
            continue;
        }
        let mut sum = Tally::default();
        for case in 0..cases(2 * SOLIDS, 100) {
            let chance = &mut Chance::new(name, 1 << 60 | (decade as u64) << 32 | case as u64);
            let thin = ratio.recip();
            let half = chance.one_of(&[
                DVec3::new(1.0, thin, thin),
                DVec3::new(thin, 1.0, thin),
                DVec3::new(thin, thin, 1.0),
                DVec3::new(thin, 1.0, 1.0),
                DVec3::new(1.0, 1.0, thin),
                DVec3::new(1.0, thin.sqrt(), thin),
            ]);
            let mut solid = somewhere(shape, half, chance);
            if case % 2 == 0 {
                solid.map.matrix3 = DMat3::from_diagonal(half);
            }
            let distance = chance.decade(0.0, 2.0);
            sum.add(tally::<S>(&solid, ratio, World::Lone, distance, chance));
        }
        report(|| format!("{name}, ratio 1e{decade}: {}", sum.figures()));
        faults.add(sum);
    }
    faults.assert_right(name);
}

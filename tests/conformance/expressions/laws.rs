//! Expressions that mean the same: operands in another order, and the laws of sets.

use ray13::math::{DAffine3, DMat3, DVec3, Ray};
use ray13::scene::{Shape, Solid};

use super::random::{any_solid, any_turn};
use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Found, Subject};
use crate::conformance::faults::assert_none;
use crate::conformance::long::{cases, report};
use crate::conformance::solids::{CYLINDER, moved, placed, scene, solid};
use crate::conformance::tally::ulp;

/// The same set with the operands in another order: all of a union or an intersection, the cuts of a
/// difference.
fn shuffled(solid: &Solid, chance: &mut Chance) -> Solid {
    let mut all = |parts: &[Solid], kept: usize| {
        let mut parts: Vec<Solid> = parts.iter().map(|part| shuffled(part, chance)).collect();
        if parts.len() > kept {
            chance.shuffle(&mut parts[kept..]);
        }
        parts
    };
    match solid {
        Solid::Primitive(_) => solid.clone(),
        Solid::Union(parts) => Solid::Union(all(parts, 0)),
        Solid::Intersection(parts) => Solid::Intersection(all(parts, 0)),
        Solid::Difference(parts) => Solid::Difference(all(parts, 1)),
    }
}

/// Bars along an axis through the cube, their ends flush with its faces.
fn bars(places: &[(f64, f64)], half: f64, axis: usize) -> impl Iterator<Item = Solid> {
    let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
    places.iter().map(move |&(u, v)| {
        let (mut center, mut halves) = (DVec3::ZERO, DVec3::splat(half));
        (center[second], center[third]) = (u, v);
        halves[axis] = 1.0;
        placed(&Shape::Cube, center, halves)
    })
}

/// A sponge of three levels of differences, most of whose faces are flush with others: bars are cut from a
/// cube, balls and rods from the finer bars, and small cubes from the rods.
fn sponge() -> Solid {
    let steps = [-2.0 / 3.0, 0.0, 2.0 / 3.0];
    let around: Vec<(f64, f64)> = steps
        .iter()
        .flat_map(|&u| steps.iter().map(move |&v| (u, v)))
        .filter(|&place| place != (0.0, 0.0))
        .collect();
    let coarse = (0..3).flat_map(|axis| bars(&[(0.0, 0.0)], 1.0 / 3.0, axis)).collect();
    let fine = (0..3).flat_map(|axis| bars(&around, 1.0 / 9.0, axis)).collect();
    let at = |n: usize| DVec3::new(steps[n % 3], steps[n / 3 % 3], steps[n / 9]);
    let balls = (0..27).map(|n| placed(&Shape::Sphere, at(n), DVec3::splat(1.0 / 9.0))).collect();
    let rod = |&(u, v): &(f64, f64)| placed(&CYLINDER, DVec3::new(u, v, 0.0), DVec3::new(0.1, 0.1, 1.0));
    let rods = around.iter().map(rod).collect();
    let small = (0..27).map(|n| placed(&Shape::Cube, at(n), DVec3::splat(1.0 / 27.0))).collect();
    let rods = Solid::Difference(vec![Solid::Union(rods), Solid::Union(small)]);
    let fine = Solid::Difference(vec![Solid::Union(fine), Solid::Union(balls), rods]);
    Solid::Difference(vec![placed(&Shape::Cube, DVec3::ZERO, DVec3::ONE), Solid::Union(coarse), fine])
}

/// From outside and from inside, some of them along an axis.
fn rays_near(by: &DAffine3, count: usize, chance: &mut Chance) -> Vec<Ray> {
    let ray = |_| {
        let d = if chance.below(8) == 0 {
            DVec3::AXES[chance.below(3)] * chance.sign()
        } else {
            chance.direction()
        };
        let target = chance.point() * 1.1;
        let o = target - d * if chance.below(4) == 0 { 0.0 } else { 6.0 };
        Ray::new(by.transform_point3(o), by.transform_vector3(d).normalize())
    };
    (0..count).map(ray).collect()
}

/// Whether two hits are of one place, within what their engine says of them.
fn alike(a: Option<Found>, b: Option<Found>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            (a.t - b.t).abs() <= a.error + b.error + 2.0 * ulp(a.t.max(b.t)) && a.entering == b.entering
        }
        _ => false,
    }
}

/// All structures and all orders of the operands of a sponge agree, as it stands and turned.
pub fn a_sponge_is_one_in_any_order<S: Subject>() {
    let whole = sponge();
    let mut faults = Vec::new();
    let (mut hits, mut count) = (0_usize, 0_usize);
    for case in 0..4 {
        let chance = &mut Chance::new("sponge", case);
        let by = match case {
            0 | 1 => DAffine3::IDENTITY,
            2 => DAffine3::from_mat3(chance.turn()),
            _ => DAffine3::from_mat3_translation(chance.turn() * 1e-3, chance.point()),
        };
        let turned = moved(&whole, &by);
        let rays = rays_near(&by, cases(5_000, 50), chance);
        let expected = S::new(&scene([turned.clone()]), Cut::None).first(&rays);
        hits += expected.iter().flatten().count();
        count += rays.len();
        let mut compare = |other: Vec<Option<Found>>, exactly: bool, what: &str| {
            for ((ray, a), b) in rays.iter().zip(&expected).zip(other) {
                if if exactly { *a != b } else { !alike(*a, b) } {
                    faults.push(format!("case {case}, {what}: {a:?} against {b:?}, {ray:?}"));
                }
            }
        };
        for &cut in S::CUTS.iter().filter(|&&cut| cut != Cut::None) {
            compare(S::new(&scene([turned.clone()]), cut).first(&rays), true, &format!("{cut:?}"));
        }
        for turn in 0..3 {
            let other = scene([shuffled(&turned, chance)]);
            compare(S::new(&other, Cut::ALL[turn]).first(&rays), false, &format!("order {turn}"));
        }
    }
    report(|| format!("sponge: {count} rays, {hits} hits, {} faults", faults.len()));
    assert!(hits * 4 > count, "{hits} of {count}");
    assert_none(&faults, count);
}

/// Both sides of each, on random solids with flush faces.
pub fn the_laws_of_sets_hold<S: Subject>() {
    use Solid::{Difference, Intersection, Union};
    let mut faults = Vec::new();
    let (mut hits, mut count) = (0_usize, 0_usize);
    for case in 0..cases(150, 100) {
        let chance = &mut Chance::new("laws", case as u64);
        let by = DAffine3::from_mat3(
            any_turn(chance) * if case % 3 == 0 { chance.decade(-9.0, 9.0) } else { 1.0 },
        );
        let [a, b, c] = [1, 1, 1].map(|depth| moved(&any_solid(chance, depth), &by));
        let cover = moved(&solid(&Shape::Cube, DMat3::from_diagonal(DVec3::splat(16.0)), DVec3::ZERO), &by);
        let (a, b, c) = (|| a.clone(), || b.clone(), || c.clone());
        let laws = [
            (
                "De Morgan",
                Difference(vec![a(), Union(vec![b(), c()])]),
                Intersection(vec![Difference(vec![a(), b()]), Difference(vec![a(), c()])]),
            ),
            (
                "De Morgan's other",
                Difference(vec![a(), Intersection(vec![b(), c()])]),
                Union(vec![Difference(vec![a(), b()]), Difference(vec![a(), c()])]),
            ),
            (
                "distribution",
                Intersection(vec![a(), Union(vec![b(), c()])]),
                Union(vec![Intersection(vec![a(), b()]), Intersection(vec![a(), c()])]),
            ),
            ("absorption", Union(vec![a(), Intersection(vec![a(), b()])]), a()),
            ("double complement", Difference(vec![cover.clone(), Difference(vec![cover, a()])]), a()),
            (
                "a cut twice",
                Difference(vec![a(), b(), c()]),
                Difference(vec![Difference(vec![a(), b()]), c()]),
            ),
            ("order", Union(vec![a(), b(), c()]), Union(vec![c(), a(), b()])),
        ];
        let rays = rays_near(&by, 20, chance);
        for (law, left, right) in laws {
            let cut = chance.one_of(&Cut::ALL);
            let [left, right] = [left, right].map(|side| S::new(&scene([side]), cut).first(&rays));
            for ((ray, left), right) in rays.iter().zip(left).zip(right) {
                count += 1;
                hits += usize::from(left.is_some());
                if !alike(left, right) {
                    faults.push(format!("case {case}, {law}: {left:?} against {right:?}, {ray:?}"));
                }
            }
        }
    }
    report(|| format!("laws: {count} rays, {hits} hits, {} faults", faults.len()));
    assert!(hits * 10 > count, "{hits} of {count}");
    assert_none(&faults, count);
}

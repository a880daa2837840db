//! Rays that leave a surface, and rays that come from the other side.

use ray13::math::{DMat3, DVec3, Ray};
use ray13::scene::{Primitive, Scene, Shape, Solid};

use crate::conformance::aim::aimed;
use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Found, Start, Subject};
use crate::conformance::expressions::random::any_solid;
use crate::conformance::faults::assert_none;
use crate::conformance::long::{cases, report};
use crate::conformance::solids::{CONE, CYLINDER, TRUNCATED_CONE, placed, primitive, prism, scene};
use crate::conformance::tally::{said, ulp};
use crate::support::oracle::{Big, Verdict, verdict};

/// All shapes of convex solids, turned and not.
fn any_convex(chance: &mut Chance) -> (Shape, DMat3) {
    let shape = chance.one_of(&[Shape::Sphere, Shape::Cube, CYLINDER, CONE, TRUNCATED_CONE, prism()]);
    let half = if chance.below(2) == 0 {
        DVec3::ONE
    } else {
        DVec3::new(chance.within(0.2, 1.0), chance.within(0.2, 1.0), chance.within(0.2, 1.0))
    };
    let turn = if chance.below(3) == 0 { DMat3::IDENTITY } else { chance.turn() };
    (shape, turn * DMat3::from_diagonal(half))
}

/// Radii and places over 16 decades. A convex solid is not met again by a ray that leaves it to its outer
/// side, and by one to its inner side it is left once.
pub fn surfaces_are_left_once<S: Subject>() {
    let (mut left, mut at_rim, mut faults) = (0_usize, 0_usize, Vec::new());
    for case in 0..cases(300, 4) {
        let chance = &mut Chance::new("leaving", case as u64);
        let (shape, linear) = any_convex(chance);
        let radius = chance.decade(-8.0, 8.0);
        // No farther than its own digits reach.
        let place = chance.direction() * chance.decade(-8.0, 8.0).min(radius * 1e12);
        let solid = primitive(&shape, linear * radius, place);
        let scene = alone_or_not(Solid::Primitive(solid.clone()), place, radius, chance);
        let subject = S::new(&scene, chance.one_of(&Cut::ALL));
        let rays: Vec<Ray> =
            (0..3).map(|_| aimed(&solid, radius * chance.decade(0.0, 2.0), chance)).collect();
        let mut starts = Vec::new();
        for (ray, hit) in rays.iter().zip(subject.first(&rays)) {
            let Some(hit) = hit.filter(|hit| hit.primitive == 0) else { continue };
            let start = |_| Start { ray: *ray, hit, toward: chance.direction() };
            starts.extend((0..cases(30, 12)).map(start));
        }
        for (start, next) in starts.iter().zip(subject.next(&starts)) {
            let own = next.filter(|found| found.primitive == 0);
            let inward = subject.inward(start);
            left += 1;
            if inward && own.is_none() && starts_at_rim(&subject, &solid, start) {
                at_rim += 1;
                continue;
            }
            if own.is_some() != inward || own.is_some_and(|found| found.entering) {
                faults.push(format!(
                    "inward {inward}, then {next:?}, after {:?} toward {:?}: {}",
                    start.hit,
                    start.toward.to_array(),
                    said(&solid, &start.ray)
                ));
            }
            if let Some(found) = own.filter(|_| inward) {
                // On from where it came out, nothing of it is ahead.
                let ray = Ray::new(start.ray.at(start.hit.t), start.toward);
                let onward = Start { ray, hit: found, toward: start.toward };
                let again = subject.next(&[onward])[0].filter(|found| found.primitive == 0);
                if again.is_some() && !subject.inward(&onward) {
                    faults.push(format!("left twice, {found:?} and {again:?}: {}", said(&solid, &ray)));
                }
            }
        }
    }
    report(|| format!("leaving: {left} rays, {at_rim} from a rim, {} faults", faults.len()));
    assert!(left > 1000 && at_rim * 100 < left, "{left}, {at_rim} of them from a rim");
    assert_none(&faults, left);
}

/// Whether the ray starts so near an edge, and crosses it so nearly along the surface, that it may as well be
/// outside: of the solid shrunk by the engine's bound nothing is ahead.
fn starts_at_rim(subject: &impl Subject, solid: &Primitive, start: &Start) -> bool {
    let from = Ray::new(start.ray.at(start.hit.t), start.toward);
    let inverse = solid.map.matrix3.inverse();
    // Here the start is a point of the scene, each of its coordinates rounded, on a solid that may be off by
    // its map.
    let off = 4.0 * (f64::EPSILON * from.o.length() + solid.map_error().length());
    let rounded = DVec3::from_array([0, 1, 2].map(|i| inverse.row(i).length())) * off;
    verdict::<Big>(solid, &from, subject.rim(solid, &start.ray) + rounded) != Verdict::Hit
}

/// The solid alone; beside another; or as part of an expression.
fn alone_or_not(solid: Solid, place: DVec3, radius: f64, chance: &mut Chance) -> Scene {
    let other = placed(&Shape::Sphere, place + DVec3::X * 40.0 * radius, DVec3::splat(radius));
    match chance.below(3) {
        0 => scene([solid]),
        1 => scene([solid, other]),
        _ => scene([Solid::Union(vec![solid, other])]),
    }
}

/// A way is blocked by what the next hit is, if that is nearer than its end, whatever structure is asked.
pub fn a_way_is_blocked_by_the_next_hit<S: Subject>() {
    let (mut asked, mut blocked) = (0_usize, 0_usize);
    for case in 0..cases(60, 100) {
        let chance = &mut Chance::new("blocked", case as u64);
        let world = scene((0..3).map(|_| any_solid(chance, 3)).collect::<Vec<_>>());
        let rays: Vec<Ray> = (0..30)
            .map(|_| {
                let d = chance.direction();
                Ray::new(chance.point() * 1.5 - d * 8.0, d)
            })
            .collect();
        let subject = S::new(&world, Cut::None);
        let hits = subject.first(&rays);
        let starts: Vec<Start> = rays
            .iter()
            .zip(hits)
            .filter_map(|(ray, hit)| Some(Start { ray: *ray, hit: hit?, toward: chance.direction() }))
            .collect();
        let next = subject.next(&starts);
        for (share, is_expected) in [(0.5, false), (2.0, true)] {
            let distance = |found: &Option<Found>| found.map_or(100.0, |found| found.t * share);
            let ways: Vec<(Start, f64)> =
                starts.iter().zip(&next).map(|(start, found)| (*start, distance(found))).collect();
            // Where nothing is ahead nothing blocks; a hit nearer than its own error says nothing.
            let clear = |found: Option<Found>| found.is_none_or(|found| found.t > 4.0 * found.error);
            for &cut in S::CUTS {
                let answers = S::new(&world, cut).blocked(&ways);
                for ((way, found), answer) in ways.iter().zip(&next).zip(answers) {
                    asked += 1;
                    blocked += usize::from(answer);
                    if clear(*found) {
                        assert_eq!(
                            answer,
                            is_expected && found.is_some(),
                            "case {case}, {cut:?}: {way:?} {found:?}"
                        );
                    }
                }
            }
        }
    }
    report(|| format!("blocked: {asked} ways, {blocked} blocked"));
    assert!(blocked * 20 > asked, "{blocked} of {asked}");
}

/// From the other end of a line the same two ends are found.
pub fn a_reversed_ray_finds_the_same_ends<S: Subject>() {
    let (mut compared, mut same, mut faults) = (0_usize, 0_usize, Vec::new());
    let mut worst = 0.0_f64;
    for case in 0..cases(400, 250) {
        let chance = &mut Chance::new("reversed", case as u64);
        let (shape, linear) = any_convex(chance);
        let solid = primitive(&shape, linear, chance.point());
        let subject = S::new(&scene([Solid::Primitive(solid.clone())]), Cut::None);
        for _ in 0..10 {
            let there = aimed(&solid, 8.0, chance);
            let length = 16.0;
            let back = Ray::new(there.at(length), -there.d);
            let Some(from_there) = ends(&subject, &there) else { continue };
            let Some(from_back) = ends(&subject, &back) else { continue };
            compared += 1;
            for (a, b) in [(from_there[0], from_back[1]), (from_there[1], from_back[0])] {
                let off = (a.t - (length - b.t)).abs();
                // The other start is rounded, and each distance: that moves an end as far as the engine's own
                // error.
                let allowed = a.error + b.error + 2.0 * ulp(length);
                worst = worst.max(off / allowed);
                same += usize::from(off == 0.0);
                if off > allowed {
                    faults.push(format!("{a:?} and {b:?}, {off:e} apart: {}", said(&solid, &there)));
                }
            }
        }
    }
    report(|| format!("reversed: {compared} chords, {same} ends to the bit, worst {worst:.3} of the bounds"));
    assert!(compared > 1000, "{compared}");
    assert_none(&faults, compared);
}

/// Where a ray goes into a lone solid, and out of it.
fn ends(subject: &impl Subject, ray: &Ray) -> Option<[Found; 2]> {
    let enter = subject.first(&[*ray])[0].filter(|found| found.entering)?;
    let leave = subject.next(&[Start { ray: *ray, hit: enter, toward: ray.d }])[0]?;
    Some([enter, Found { t: enter.t + leave.t, error: enter.error + leave.error, ..leave }])
}

//! Rays in the plane of a face, along an edge, along a plane of the lattice.

use ray13::math::{DVec3, Ray};
use ray13::scene::{Scene, Shape, Solid};

use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Start, Subject};
use crate::conformance::long::{cases, report};
use crate::conformance::solids::{placed, scene};

/// Boxes that fill a grid of 3 by 3 by 3, of uneven steps that f64 holds exactly.
fn grid(chance: &mut Chance) -> ([[f64; 4]; 3], Vec<Solid>) {
    let step = |chance: &mut Chance| (1 + chance.below(4000)) as f64 / 1024.0;
    let lines: [[f64; 4]; 3] = std::array::from_fn(|_| {
        let mut at = -2.0;
        std::array::from_fn(|i| {
            at += if i == 0 { 0.0 } else { step(chance) };
            at
        })
    });
    let mut boxes = Vec::new();
    for (i, j, k) in (0..27).map(|n| (n % 3, n / 3 % 3, n / 9)) {
        let lo = DVec3::new(lines[0][i], lines[1][j], lines[2][k]);
        let hi = DVec3::new(lines[0][i + 1], lines[1][j + 1], lines[2][k + 1]);
        boxes.push(placed(&Shape::Cube, (lo + hi) * 0.5, (hi - lo) * 0.5));
    }
    (lines, boxes)
}

/// A ray that runs in one plane of the grid, or in two, which is along an edge: from outside the grid, and
/// aimed at it. A place on a line is one of the middle two: those that boxes share.
fn along_planes(lines: &[[f64; 4]; 3], chance: &mut Chance) -> Ray {
    let axis = chance.below(3);
    let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
    let (low, high) = (lines[axis][0], lines[axis][3]);
    let (mut o, mut d) = (DVec3::ZERO, DVec3::ZERO);
    d[axis] = chance.sign();
    o[axis] = if d[axis] > 0.0 { low - 4.0 } else { high + 4.0 };
    o[second] = lines[second][1 + chance.below(2)];
    // Along an edge, or in the plane only, between or on lines; along the axis or aslant in the plane.
    o[third] = match chance.below(3) {
        0 => lines[third][1 + chance.below(2)],
        _ => chance.within(lines[third][0], lines[third][3]),
    };
    if chance.below(3) == 0 {
        let target = chance.within(lines[third][0], lines[third][3]);
        d[third] = (target - o[third]) / (4.0 + chance.within(0.0, high - low));
    }
    Ray::new(o, d.normalize())
}

/// Whether a point of a ray is on an outer face of the grid, whose lines are within 14 of the origin.
fn is_on_outside(lines: &[[f64; 4]; 3], p: DVec3) -> bool {
    (0..3).any(|axis| [0, 3].iter().any(|&i| (p[axis] - lines[axis][i]).abs() < 64.0 * f64::EPSILON))
}

/// Where a ray is inside one box.
#[derive(Debug, Clone)]
struct Chord {
    enter: f64,
    leave: f64,
    error: f64,
    number: usize,
}

/// Of the boxes of a grid exactly as many are met by a ray in their faces as by one beside it, one after the
/// other without a gap; and all structures say the same.
pub fn one_of_two_abutting_boxes_claims_a_ray<S: Subject>() {
    let mut rays_asked = 0;
    for case in 0..cases(40, 100) {
        let chance = &mut Chance::new("planes", case as u64);
        let (lines, boxes) = grid(chance);
        let rays: Vec<Ray> = (0..20).map(|_| along_planes(&lines, chance)).collect();
        let all = scene(boxes.clone());
        let first = S::new(&all, Cut::None).first(&rays);
        for &cut in S::CUTS {
            assert_eq!(first, S::new(&all, cut).first(&rays), "case {case}, {cut:?}");
        }
        // Each box asked alone: the chords must follow each other from one end of the grid to the other.
        let mut chords: Vec<Vec<Chord>> = vec![Vec::new(); rays.len()];
        for (number, one) in boxes.iter().enumerate() {
            let subject = S::new(&scene([one.clone()]), Cut::None);
            for (place, (ray, enter)) in rays.iter().zip(subject.first(&rays)).enumerate() {
                let Some(hit) = enter else { continue };
                let leave = subject.next(&[Start { ray: *ray, hit, toward: ray.d }])[0];
                let leave =
                    leave.unwrap_or_else(|| panic!("case {case}: box {number} is never left, {ray:?}"));
                chords[place].push(Chord {
                    enter: hit.t,
                    leave: hit.t + leave.t,
                    error: hit.error + leave.error,
                    number,
                });
            }
        }
        for ((ray, found), mut met) in rays.iter().zip(&first).zip(chords) {
            rays_asked += 1;
            met.sort_by(|a, b| a.enter.total_cmp(&b.enter));
            let found =
                found.unwrap_or_else(|| panic!("case {case}: a ray through the middle is missed: {ray:?}"));
            assert_eq!(found.object as usize, met[0].number, "case {case}: {ray:?} {met:?}");
            for end in [met[0].enter, met[met.len() - 1].leave] {
                let p = ray.at(end);
                assert!(is_on_outside(&lines, p), "case {case}: no end of the grid at {p}: {ray:?} {met:?}");
            }
            for pair in met.windows(2) {
                // The end of one is the start of the next, but for what each says of its own.
                let (gap, allowed) = ((pair[1].enter - pair[0].leave).abs(), pair[0].error + pair[1].error);
                assert!(gap <= allowed, "case {case}: {gap:e} between boxes: {ray:?} {met:?}");
            }
        }
    }
    report(|| format!("planes: {rays_asked} rays"));
}

/// Along the faces of a lone box, its edges and its corners, all structures say the same, the
/// lower faces are met, the upper ones are not.
pub fn faces_are_half_open<S: Subject>() {
    let chance = &mut Chance::new("half open", 0);
    for _ in 0..cases(50, 100) {
        let lo = chance.point().map(|x| (x * 1024.0).round() / 1024.0);
        let size = DVec3::new(0.25, 0.5, 1.0) * (1 + chance.below(8)) as f64;
        let scene: Scene = scene([placed(&Shape::Cube, lo + size, size)]);
        for axis in 0..3 {
            let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
            for (u, v) in (0..9).map(|n| (n % 3, n / 3)) {
                let mut o = lo;
                o[axis] -= 4.0;
                // At the lower face, between, at the upper face.
                o[second] += size[second] * f64::from(u);
                o[third] += size[third] * f64::from(v);
                let ray = Ray::new(o, DVec3::AXES[axis]);
                let met: Vec<_> = S::CUTS.iter().map(|&cut| S::new(&scene, cut).first(&[ray])[0]).collect();
                assert!(met.iter().all(|found| *found == met[0]), "{met:?}");
                assert_eq!(met[0].is_some(), u < 2 && v < 2, "axis {axis} {u} {v} {scene:?}");
                assert!(met[0].is_none_or(|found| found.t == 4.0), "{met:?}");
            }
        }
    }
}

/// A union of abutting boxes has no wall inside, also for a ray in the plane between them.
pub fn a_union_of_boxes_is_one<S: Subject>() {
    for case in 0..cases(40, 100) {
        let chance = &mut Chance::new("union of boxes", case as u64);
        let (lines, boxes) = grid(chance);
        let rays: Vec<Ray> = (0..20).map(|_| along_planes(&lines, chance)).collect();
        let joined = scene([Solid::Union(boxes)]);
        for &cut in S::CUTS {
            let subject = S::new(&joined, cut);
            for (ray, hit) in rays.iter().zip(subject.first(&rays)) {
                let hit = hit.unwrap_or_else(|| panic!("case {case}, {cut:?}: missed by {ray:?}"));
                let leave = subject.next(&[Start { ray: *ray, hit, toward: ray.d }])[0];
                let leave = leave.unwrap_or_else(|| panic!("case {case}, {cut:?}: never left by {ray:?}"));
                assert!(hit.entering && !leave.entering, "case {case}, {cut:?}: {ray:?} {hit:?} {leave:?}");
                let p = ray.at(hit.t + leave.t);
                assert!(is_on_outside(&lines, p), "case {case}, {cut:?}: a wall inside at {p}: {ray:?}");
            }
        }
    }
}

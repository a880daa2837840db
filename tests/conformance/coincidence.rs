//! What is nothing, what is everything, and what is open: a solid and itself, and holes that end in a face.

use ray13::frame::Frame;
use ray13::math::{DAffine3, DVec3, Ray, Size};
use ray13::scene::{Camera, FieldSpan, ReadOptions, Scene, Shape, Solid, read};

use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Subject};
use crate::conformance::faults::assert_none;
use crate::conformance::long::{cases, report};
use crate::conformance::solids::{CYLINDER, moved, placed, scene};

const DOTS: Size = Size::new(40, 40);

const SOLIDS: [&str; 7] = [
    "cube([1, 1.3, 0.7], center = true);",
    "sphere(0.9);",
    "sphere(semi = [1, 0.6, 0.3]);",
    "cylinder(h = 1.4, r = 0.6, center = true);",
    "cone(h = 1.5, r = 0.8, center = true);",
    "cylinder(h = 1.4, r = 0.7, center = true, $fn = 6);",
    "polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]);",
];

fn scene_of(text: &str) -> Scene {
    read("identity", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{text}\n{e}"))
}

/// Seen from 6 sizes away, from a direction of the case's own.
fn seen<S: Subject>(scene: &Scene, size: f64, center: DVec3, chance: &mut Chance) -> Frame {
    let eye = center + chance.direction() * 6.0 * size;
    let camera = Camera {
        name: None,
        eye,
        target: center,
        up: DVec3::new(0.1, 0.2, 1.0),
        field: [22.0, 22.0],
        span: FieldSpan::Edges,
        zoom: 1.0,
    };
    S::draw(scene, &camera, DOTS, Cut::Tree)
}

fn hits(frame: &Frame) -> usize {
    frame.depth.as_ref().unwrap().values().iter().filter(|t| t.is_finite()).count()
}

/// So many maps, and after them their inverses in the other order: the product is the identity but for
/// rounding.
fn there_and_back(depth: usize, chance: &mut Chance) -> String {
    let (mut there, mut back) = (String::new(), String::new());
    for _ in 0..depth {
        let DVec3 { x, y, z } = chance.point();
        match chance.below(3) {
            0 => {
                there.push_str(&format!("translate([{x:?}, {y:?}, {z:?}]) "));
                back.insert_str(0, &format!("translate([{:?}, {:?}, {:?}]) ", -x, -y, -z));
            }
            1 => {
                let angle = 180.0 * chance.within(-1.0, 1.0);
                there.push_str(&format!("rotate({angle:?}, v = [{x:?}, {y:?}, {z:?}]) "));
                back.insert_str(0, &format!("rotate({:?}, v = [{x:?}, {y:?}, {z:?}]) ", -angle));
            }
            _ => {
                let factor = chance.decade(-0.3, 0.3);
                there.push_str(&format!("scale({factor:?}) "));
                back.insert_str(0, &format!("scale({:?}) ", factor.recip()));
            }
        }
    }
    there + &back
}

/// A solid minus itself is nothing, under maps nested up to 200 deep whose product is the identity.
pub fn a_solid_minus_itself_is_nothing<S: Subject>() {
    let mut faults = Vec::new();
    let mut pictures = 0_usize;
    for case in 0..cases(84, 30) {
        let chance = &mut Chance::new("nothing", case as u64);
        let solid = SOLIDS[case % SOLIDS.len()];
        let depth = [0, 1, 2, 5, 20, 50, 100][case / SOLIDS.len() % 7];
        let (maps, scale) =
            (there_and_back(depth, chance), if case % 2 == 0 { 1.0 } else { chance.decade(-6.0, 6.0) });
        let DVec3 { x, y, z } = chance.direction();
        let angle = chance.within(0.0, 360.0);
        let outer = format!("scale({scale:?}) rotate({angle:?}, v = [{x:?}, {y:?}, {z:?}])");
        let alone = scene_of(&format!("{outer} {solid}"));
        assert!(hits(&seen::<S>(&alone, scale, DVec3::ZERO, &mut chance.clone())) > 50, "{outer} {solid}");
        for text in [
            format!("{outer} difference() {{ {solid} {maps} {solid} }}"),
            format!("{outer} difference() {{ {maps} {solid} {solid} }}"),
        ] {
            let found = hits(&seen::<S>(&scene_of(&text), scale, DVec3::ZERO, chance));
            pictures += 1;
            if found > 0 {
                faults.push(format!(
                    "{found} dots hit, {depth} maps and back: {}",
                    &text[..text.len().min(1500)]
                ));
            }
        }
    }
    report(|| format!("nothing: {pictures} pictures, {} faults", faults.len()));
    assert_none(&faults, pictures);
}

/// A solid joined or met with itself is the solid, dot for dot.
pub fn a_solid_and_itself_is_the_solid<S: Subject>() {
    for case in 0..cases(42, 30) {
        let chance = &mut Chance::new("itself", case as u64);
        let solid = SOLIDS[case % SOLIDS.len()];
        let maps = there_and_back([0, 1, 5][case / SOLIDS.len() % 3], chance);
        let DVec3 { x, y, z } = chance.direction();
        let outer = format!("rotate({:?}, v = [{x:?}, {y:?}, {z:?}])", chance.within(0.0, 360.0));
        let draw = |text: &str| {
            let mut chance = Chance::new("itself, from where", case as u64);
            seen::<S>(&scene_of(&format!("{outer} {text}")), 1.0, DVec3::ZERO, &mut chance)
        };
        let alone = draw(solid);
        assert!(hits(&alone) > 50, "{solid}");
        for operator in ["union", "intersection"] {
            let text = format!("{operator}() {{ {solid} {maps} {solid} }}");
            let pair = draw(&text);
            let (alone, pair) =
                (alone.depth.as_ref().unwrap().values(), pair.depth.as_ref().unwrap().values());
            let differs = |(a, b): (&f64, &f64)| {
                a.is_finite() != b.is_finite() || (a.is_finite() && (a - b).abs() > 1e-12 * a)
            };
            let dots = alone.iter().zip(pair).filter(|&pair| differs(pair)).count();
            assert_eq!(dots, 0, "case {case}: {outer} {text}");
        }
    }
}

/// A hole whose ends are flush with the faces of a box is open all over, at any rotation and scale.
pub fn a_flush_hole_is_open<S: Subject>() {
    let mut faults = Vec::new();
    let (mut count, mut walls) = (0_usize, 0_usize);
    for case in 0..cases(300, 100) {
        let chance = &mut Chance::new("hole", case as u64);
        let by = DAffine3::from_mat3_translation(
            chance.turn() * if case % 2 == 0 { 1.0 } else { chance.decade(-12.0, 12.0) },
            DVec3::ZERO,
        );
        let half = DVec3::new(chance.within(0.5, 2.0), chance.within(0.5, 2.0), chance.decade(-3.0, 0.5));
        let (radius, center) = (chance.within(0.1, 0.4), DVec3::new(chance.within(-0.1, 0.1), 0.0, 0.0));
        let shape = chance.one_of(&[CYLINDER, Shape::Cube]);
        let hole = placed(&shape, center, DVec3::new(radius, radius, half.z));
        let body = Solid::Difference(vec![placed(&Shape::Cube, DVec3::ZERO, half), hole]);
        let wall = placed(&Shape::Cube, DVec3::Z * -20.0, DVec3::new(30.0, 30.0, 0.5));
        let world = scene([moved(&body, &by), moved(&wall, &by)]);
        let through = |_| {
            // Both ends of the way within the hole, not nearer to its wall than a hundredth of its radius.
            let mut end = |z: f64| {
                let (sin, cos) = libm::sincos(chance.within(0.0, std::f64::consts::TAU));
                center
                    + DVec3::new(cos, sin, 0.0) * (radius * 0.99 * chance.within(0.0, 1.0).sqrt())
                    + DVec3::Z * z
            };
            let (above, below) = (end(half.z), end(-half.z));
            let d = (below - above).normalize();
            let o = above - d * 4.0;
            Ray::new(by.transform_point3(o), by.transform_vector3(d).normalize())
        };
        let rays: Vec<Ray> = (0..20).map(through).collect();
        let subject = S::new(&world, chance.one_of(&Cut::ALL));
        for (ray, found) in rays.iter().zip(subject.first(&rays)) {
            // Aslant through a thin plate a ray may pass the wall behind, but never meet the plate.
            count += 1;
            walls += usize::from(found.is_some_and(|found| found.object == 1));
            if found.is_some_and(|found| found.object == 0) {
                faults.push(format!("case {case}: {found:?}, {ray:?}, {half} {radius} {shape:?} {by:?}"));
            }
        }
    }
    report(|| format!("holes: {count} rays, {walls} to the wall behind, {} faults", faults.len()));
    assert!(walls * 5 > count, "{walls} of {count} meet the wall behind");
    assert_none(&faults, count);
}

/// A flush hole under maps whose product is the identity but for rounding, in a box under none.
pub fn a_flush_hole_is_open_under_other_maps<S: Subject>() {
    let (mut count, mut faults) = (0_usize, Vec::new());
    for case in 0..cases(100, 100) {
        let chance = &mut Chance::new("other maps", case as u64);
        let maps = there_and_back(1 + case % 10, chance);
        let text = format!(
            "difference() {{ cube([2, 2, 1], center = true); {maps} cylinder(h = 1, r = 0.5, center = true); }}"
        );
        let subject = S::new(&scene_of(&text), chance.one_of(&Cut::ALL));
        let beside = Ray::new(DVec3::new(0.8, -0.8, 3.5), DVec3::NEG_Z);
        assert!(subject.first(&[beside])[0].is_some(), "case {case}: the plate itself is missed: {text}");
        let ray = |_| {
            let mut end = |z: f64| DVec3::new(chance.within(-0.34, 0.34), chance.within(-0.34, 0.34), z);
            let (above, below) = (end(0.5), end(-0.5));
            let d = (below - above).normalize();
            Ray::new(above - d * 3.0, d)
        };
        let rays: Vec<Ray> = (0..20).map(ray).collect();
        count += rays.len();
        let met = subject.first(&rays).into_iter().zip(&rays).filter(|(found, _)| found.is_some());
        faults.extend(met.map(|(found, ray)| format!("{found:?} {ray:?} {text}")));
    }
    assert_none(&faults, count);
}

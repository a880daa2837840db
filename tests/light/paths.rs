//! The paths of single rays, against those worked out by hand.

use ray13::math::DVec3;
use ray13::stage::RayKind;

use super::glass::World;
use super::sending::{bends, clear, legs, scene};

/// Ten rays that meet what lies within 1 of the origin, from different sides.
fn ten_rays() -> Vec<(DVec3, DVec3)> {
    (0..10)
        .map(|i| {
            let turn = 2.4 * f64::from(i);
            let (sin, cos) = libm::sincos(turn);
            let eye = DVec3::new(4.0 * cos, 4.0 * sin, 3.0 * libm::sin(0.7 * turn));
            let aim = DVec3::new(0.08, -0.05, 0.03) * f64::from(i) + DVec3::new(0.01, 0.02, -0.03);
            (eye, (aim - eye).normalize())
        })
        .collect()
}

/// Bends of a path that are compared.
const MOST: usize = 12;

/// Compares the paths of rays with those worked out by hand; gives how often a path bent.
fn agree(text: &str, world: &World, rays: &[(DVec3, DVec3)]) -> usize {
    let scene = scene(&clear(text));
    let mut bent = 0;
    for &(eye, d) in rays {
        // A path may go round in total reflections for ever.
        let expected = world.path(eye, d, MOST);
        let mut traced = bends(&legs(&scene, eye, d, RayKind::Snell));
        traced.truncate(MOST);
        assert_eq!(traced.len(), expected.len(), "from {eye} along {d}:\n{traced:?}\n{expected:?}");
        for (one, other) in traced.iter().zip(&expected) {
            let near = |a: DVec3, b: DVec3| (a - b).length() < 1e-9;
            let same = near(one.at, other.at) && near(one.d, other.d) && one.index == other.index;
            assert!(same, "from {eye} along {d}:\n{one:?}\n{other:?}");
        }
        bent += expected.len();
    }
    bent
}

fn inside(p: DVec3, center: DVec3, radius: f64) -> bool {
    p.distance(center) < radius
}

#[test]
fn through_a_ball_bends_twice() {
    let world = World {
        spheres: &[(DVec3::ZERO, 1.0)],
        index: &|p| if inside(p, DVec3::ZERO, 1.0) { 1.5 } else { 1.0 },
    };
    let text = "material(\"glass\") sphere(1);";
    assert_eq!(agree(text, &world, &ten_rays()), 20);
}

#[test]
fn through_a_shell_is_the_same_for_a_cut_and_for_air_inside() {
    let world = World {
        spheres: &[(DVec3::ZERO, 1.0), (DVec3::ZERO, 0.7)],
        index: &|p| {
            let glass = inside(p, DVec3::ZERO, 1.0) && !inside(p, DVec3::ZERO, 0.7);
            if glass { 1.5 } else { 1.0 }
        },
    };
    let cut = "material(\"glass\") difference() { sphere(1); sphere(0.7); }";
    let filled = "material(\"glass\") sphere(1); material(\"air\") sphere(0.7);";
    let bent = agree(cut, &world, &ten_rays());
    assert!(bent >= 30, "{bent}");
    assert_eq!(agree(filled, &world, &ten_rays()), bent);
}

#[test]
fn through_a_pinhole_of_two_balls() {
    let (left, right) = (DVec3::new(-0.9, 0.0, 0.0), DVec3::new(0.9, 0.0, 0.0));
    let world = World {
        spheres: &[(left, 1.4), (right, 1.4)],
        index: &|p| if inside(p, left, 1.4) && inside(p, right, 1.4) { 1.5 } else { 1.0 },
    };
    let text = "material(\"glass\") intersection() {
        translate([-0.9, 0, 0]) sphere(1.4); translate([0.9, 0, 0]) sphere(1.4); }";
    let bent = agree(text, &world, &ten_rays());
    assert!(bent >= 16, "{bent}");
}

#[test]
fn through_a_ball_in_a_ball_in_a_ball() {
    let inner = DVec3::new(0.2, 0.0, 0.1);
    let index = |p: DVec3| match () {
        () if inside(p, inner, 0.3) => 1.33,
        () if inside(p, DVec3::ZERO, 0.6) => 1.8,
        () if inside(p, DVec3::ZERO, 1.0) => 1.5,
        () => 1.0,
    };
    let world = World { spheres: &[(DVec3::ZERO, 1.0), (DVec3::ZERO, 0.6), (inner, 0.3)], index: &index };
    let text = "material(\"glass\") sphere(1); material(\"dense\") sphere(0.6);
        material(\"water\") translate([0.2, 0, 0.1]) sphere(0.3);";
    let bent = agree(text, &world, &ten_rays());
    assert!(bent >= 40, "{bent}");
}

#[test]
fn through_an_overlap_goes_by_the_last_in_the_file_from_both_sides() {
    let (left, right) = (DVec3::new(-0.4, 0.0, 0.0), DVec3::new(0.4, 0.0, 0.0));
    for last_is_dense in [true, false] {
        let index = |p: DVec3| match (inside(p, left, 0.8), inside(p, right, 0.8)) {
            (true, true) if last_is_dense => 1.8,
            (true, _) => 1.5,
            (false, true) => 1.8,
            (false, false) => 1.0,
        };
        let world = World { spheres: &[(left, 0.8), (right, 0.8)], index: &index };
        let mut balls = [
            "material(\"glass\") translate([-0.4, 0, 0]) sphere(0.8);",
            "material(\"dense\") translate([0.4, 0, 0]) sphere(0.8);",
        ];
        if !last_is_dense {
            balls.reverse();
        }
        let mut rays = ten_rays();
        // And back from where each of them came out.
        let scene = scene(&clear(&balls.concat()));
        for (eye, d) in ten_rays() {
            let legs = legs(&scene, eye, d, RayKind::Snell);
            let last = legs.last().unwrap();
            rays.push((last.ray.at(5.0), -last.ray.d));
        }
        let bent = agree(&balls.concat(), &world, &rays);
        assert!(bent >= 40, "{bent}");
    }
}

#[test]
fn from_an_eye_in_glass_starts_in_glass() {
    let index = |p: DVec3| match () {
        () if inside(p, DVec3::ZERO, 0.5) => 1.8,
        () if inside(p, DVec3::ZERO, 1.0) => 1.5,
        () => 1.0,
    };
    let world = World { spheres: &[(DVec3::ZERO, 1.0), (DVec3::ZERO, 0.5)], index: &index };
    let text = "material(\"glass\") sphere(1); material(\"dense\") sphere(0.5);";
    let looks = |at: DVec3| ten_rays().into_iter().map(move |(_, d)| (at, d)).collect::<Vec<_>>();
    let bent = agree(text, &world, &looks(DVec3::new(0.1, 0.05, -0.1)));
    assert!(bent >= 20, "{bent}");
    let bent = agree(text, &world, &looks(DVec3::new(0.7, 0.2, -0.1)));
    assert!(bent >= 10, "{bent}");
    // The same in a solid that is cut: here the eye is in the hollow, and there in the glass.
    let hollow = World {
        spheres: &[(DVec3::ZERO, 1.0), (DVec3::ZERO, 0.5)],
        index: &|p| {
            let glass = inside(p, DVec3::ZERO, 1.0) && !inside(p, DVec3::ZERO, 0.5);
            if glass { 1.5 } else { 1.0 }
        },
    };
    let text = "material(\"glass\") difference() { sphere(1); sphere(0.5); }";
    let bent = agree(text, &hollow, &looks(DVec3::new(0.1, 0.05, -0.1)));
    assert!(bent >= 20, "{bent}");
    let bent = agree(text, &hollow, &looks(DVec3::new(0.7, 0.2, -0.1)));
    assert!(bent >= 10, "{bent}");
}

#[test]
fn through_touching_blocks_has_no_air_between_them() {
    let text =
        "material(\"glass\") cube([1, 1, 1]); material(\"dense\") translate([0, 0, -1]) cube([1, 1, 1]);";
    let d = DVec3::new(0.3, 0.2, -1.0).normalize();
    let path = bends(&legs(&scene(&clear(text)), DVec3::new(0.3, 0.4, 1.5), d, RayKind::Snell));
    let indices: Vec<f64> = path.iter().map(|b| b.index).collect();
    assert_eq!(indices, [1.5, 1.8, 1.0]);
    for (bend, index) in path.iter().zip([1.5, 1.8, 1.0]) {
        let sine = d.cross(DVec3::Z).length() / index;
        assert!((bend.d.cross(DVec3::Z).length() - sine).abs() < 1e-12);
    }
}

#[test]
fn into_a_corner_of_glass_comes_back_the_way_it_came() {
    // Three total reflections on faces at right angles turn any direction round.
    let text = "material(\"glass\") polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);";
    let scene = scene(&clear(text));
    for (x, y) in [(0.02, 0.01), (-0.03, 0.05), (0.04, -0.02)] {
        let d = DVec3::new(-1.0 + x, -1.0 + y, -1.0).normalize();
        let eye = DVec3::new(0.3, 0.28, 0.27) - d;
        let legs = legs(&scene, eye, d, RayKind::Snell);
        let kinds: Vec<RayKind> = legs.iter().map(|leg| leg.kind).collect();
        let [mirror, snell] = [RayKind::Mirror, RayKind::Snell];
        assert_eq!(kinds, [RayKind::Eye, snell, mirror, mirror, mirror, snell]);
        let last = legs.last().unwrap();
        assert!((last.ray.d + d).length() < 1e-12 && last.hit.is_none(), "{d} came back as {last:?}");
        assert_eq!((last.weight, last.index), (1.0, 1.0));
    }
}

#[test]
fn between_mirrors_bounces_like_a_ball() {
    let text = "material(kd = 0, ks = 0, kr = 1) { translate([0, 0, 2]) cube([9, 9, 1], center = true);
        translate([0, 0, -2]) cube([9, 9, 1], center = true); }";
    let d = DVec3::new(0.1, 0.0, 1.0).normalize();
    let legs = legs(&scene(text), DVec3::ZERO, d, RayKind::Snell);
    for (number, leg) in legs.iter().enumerate().skip(1) {
        let z = if number % 2 == 1 { 1.5 } else { -1.5 };
        let x = 0.15 + 0.3 * (number as f64 - 1.0);
        assert!((leg.ray.o - DVec3::new(x, 0.0, z)).length() < 1e-9 || x > 4.5, "{number}: {leg:?}");
    }
    assert!(legs.len() > 14, "{}", legs.len());
}

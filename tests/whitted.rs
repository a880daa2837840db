//! Equation (4): mirror and Snell rays, the media they go through, and the light that comes through glass.

mod glass;
mod request;
mod sending;

use glass::{Bend, World};
use proptest::prelude::*;
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::{CUTOFF, Options, Shading, StructureChoice};
use ray13::scene::{Camera, Material};
use ray13::shade::Kind;
use ray13::tone::Level;
use request::request;
use sending::{all_rays, bends, dot, legs, scene};

/// Glass that shows nothing but what comes through it.
const CLEAR: &str = "material(name = \"glass\", kd = 0, ks = 0, kt = 1, index = 1.5, color = [0, 0, 0]);
    material(name = \"dense\", kd = 0, ks = 0, kt = 1, index = 1.8, color = [0, 0, 0]);
    material(name = \"air\", kd = 0, ks = 0, kt = 1, index = 1, color = [0, 0, 0]);
    material(name = \"water\", kd = 0, ks = 0, kt = 1, index = 1.33, color = [0, 0, 0]);
    material(name = \"wall\", kd = 0, ks = 0, color = [0.5, 0.5, 0.5]);
    world(ambient = 1, background = 0);";

fn clear(text: &str) -> String {
    format!("{CLEAR}{text}")
}

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
        let mut traced = bends(&legs(&scene, eye, d, Kind::Snell));
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

mod the_path {
    use super::*;

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
    fn through_a_lens_of_two_balls() {
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
                let legs = legs(&scene, eye, d, Kind::Snell);
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
        let path = bends(&legs(&scene(&clear(text)), DVec3::new(0.3, 0.4, 1.5), d, Kind::Snell));
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
            let legs = legs(&scene, eye, d, Kind::Snell);
            let kinds: Vec<Kind> = legs.iter().map(|leg| leg.kind).collect();
            let [mirror, snell] = [Kind::Mirror, Kind::Snell];
            assert_eq!(kinds, [Kind::Eye, snell, mirror, mirror, mirror, snell]);
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
        let legs = legs(&scene(text), DVec3::ZERO, d, Kind::Snell);
        for (number, leg) in legs.iter().enumerate().skip(1) {
            let z = if number % 2 == 1 { 1.5 } else { -1.5 };
            let x = 0.15 + 0.3 * (number as f64 - 1.0);
            assert!((leg.ray.o - DVec3::new(x, 0.0, z)).length() < 1e-9 || x > 4.5, "{number}: {leg:?}");
        }
        assert!(legs.len() > 14, "{}", legs.len());
    }
}

mod the_light {
    use super::*;

    const EYE: DVec3 = DVec3::new(0.0, -6.0, 0.0);

    #[test]
    fn of_an_opaque_ball_in_glass_is_seen_through_the_glass() {
        let text = clear("material(\"glass\") sphere(1); material(\"wall\") sphere(0.4);");
        let (light, counts) = dot(&text, EYE, DVec3::Y, &all_rays());
        assert_eq!((light, counts.secondary_rays, counts.secondary_hits), (0.5, 1, 1));
        // 0.4 · 1.5 = 0.6 wide it seems, and no wider.
        let far = DVec3::new(0.0, -600.0, 0.0);
        let seen = |x: f64| dot(&text, far + DVec3::X * x, DVec3::Y, &all_rays()).0;
        assert_eq!((seen(0.59), seen(0.61)), (0.5, 0.0));
    }

    #[test]
    fn of_wood_under_glass_is_seen_whichever_comes_first() {
        let glass = "material(\"glass\") translate([0, 0, 0.5]) cube([4, 4, 1], center = true);";
        let wood = "material(\"wall\") translate([0, 0, -0.5]) cube([4, 4, 1], center = true);";
        for text in [[glass, wood].concat(), [wood, glass].concat()] {
            let d = DVec3::new(0.1, 0.2, -1.0).normalize();
            let (light, counts) = dot(&clear(&text), DVec3::new(0.1, 0.1, 5.0), d, &all_rays());
            assert_eq!((light, counts.secondary_rays), (0.5, 1));
        }
    }

    #[test]
    fn of_a_mirror_is_its_share_of_what_it_shows_and_the_way_adds_up() {
        // Seen from (0, −6, 0): 6 to the mirror, 8 back to the wall, whose face is at y = −8.
        let text = |world: &str| {
            format!(
                "{world} light(at = [0, 20, 0], intensity = 1);
                material(kd = 0, ks = 0, kr = 0.25, color = [0, 0, 0]) translate([0, 1, 0]) cube([4, 2, 4], center = true);
                material(kd = 0.5, ks = 0, color = [1, 1, 1]) translate([0, -9, 0]) cube([4, 2, 4], center = true);"
            )
        };
        let options = Options { shadows: false, ..all_rays() };
        let (light, counts) = dot(&text("world(ambient = 0.2);"), EYE, DVec3::Y, &options);
        assert!((light - 0.25 * (0.2 + 0.5)).abs() < 1e-12, "{light}");
        assert_eq!((counts.secondary_rays, counts.shadow_rays), (1, 0));
        let (light, _) = dot(&text("world(ambient = 0.2, k = 3);"), EYE, DVec3::Y, &options);
        assert!((light - 0.25 * (0.2 + 0.5 / (6.0 + 8.0 + 3.0))).abs() < 1e-12, "{light}");
        // In the mirror's own shadow there is the ambient light only.
        let (light, counts) = dot(&text("world(ambient = 0.2);"), EYE, DVec3::Y, &all_rays());
        assert_eq!((light, counts.shadow_rays, counts.shadow_hits), (0.05, 1, 1));
    }

    #[test]
    fn of_a_mirror_needs_equation_four() {
        let text =
            "material(kd = 0, ks = 0, kr = 1) sphere(1); material(kt = 0.5) translate([3, 0, 0]) sphere(1);
            light(at = [0, -9, 0]);";
        for (shading, sent) in [(Shading::Phong, false), (Shading::Whitted, true)] {
            let (_, counts) = dot(text, EYE, DVec3::Y, &Options { shading, ..all_rays() });
            assert_eq!(counts.secondary_rays > 0, sent);
        }
    }

    #[test]
    fn that_is_totally_reflected_is_sent_once_with_both_shares() {
        let text =
            "material(kd = 0, ks = 0, kr = 0.25, kt = 0.5, index = 1.5, color = [0, 0, 0]) cube(2, center = true);
            world(ambient = 0, background = 1);";
        let d = DVec3::new(0.6, 0.0, 0.8);
        // Inside, onto the upper face at 37° (sine 0.6): above the critical sine of 0.667 it is not.
        let eye = DVec3::new(-0.5, 0.1, -0.3);
        let (_, counts) = dot(text, eye, d, &Options { depth: 1, ..all_rays() });
        assert_eq!((counts.secondary_rays, counts.truncated_rays), (2, 1));
        // At 53° it is.
        let (eye, d) = (DVec3::new(-0.9, 0.1, 0.0), DVec3::new(0.8, 0.0, 0.6));
        let (_, counts) = dot(text, eye, d, &Options { depth: 1, ..all_rays() });
        assert_eq!((counts.secondary_rays, counts.secondary_hits), (1, 1));
        let path = legs(&scene(text), DVec3::new(0.0, 0.1, 0.5), DVec3::new(0.8, 0.0, 0.6), Kind::Snell);
        assert_eq!((path[1].kind, path[1].weight), (Kind::Mirror, 0.75));
    }

    #[test]
    fn of_a_ray_cut_off_is_ambient_and_counted() {
        let text = "world(ambient = 0.3, background = 0); material(kd = 0, ks = 0, kr = 1, color = [0, 0, 0]) {
            translate([0, 0, 2]) cube([9, 9, 1], center = true); translate([0, 0, -2]) cube([9, 9, 1], center = true); }";
        for depth in [0, 1, 4, 64] {
            let (light, counts) = dot(text, DVec3::ZERO, DVec3::Z, &Options { depth, ..all_rays() });
            let sent = u64::from(depth);
            assert_eq!(
                (counts.secondary_rays, counts.secondary_hits, counts.truncated_rays),
                (sent, sent, 1)
            );
            assert_eq!(light, 0.3);
        }
    }

    #[test]
    fn is_followed_while_it_can_still_change_by_the_cutoff() {
        let text = |lamp: &str| {
            format!(
                "{lamp} material(kd = 0, ks = 0, kr = 0.1, color = [0, 0, 0]) {{
                translate([0, 0, 2]) cube([9, 9, 1], center = true);
                translate([0, 0, -2]) cube([9, 9, 1], center = true); }}"
            )
        };
        let rays = |lamp: &str, cutoff: f64| {
            let options = Options { cutoff, ..Options::default() };
            let (_, counts) = dot(&text(lamp), DVec3::ZERO, DVec3::Z, &options);
            (counts.secondary_rays, counts.truncated_rays)
        };
        assert_eq!(rays("", CUTOFF), (1, 1));
        assert_eq!(rays("", 0.0099), (2, 1));
        assert_eq!(rays("", 0.2), (0, 1));
        assert_eq!(rays("", 0.0), (5, 1));
        // Something ten times as bright as white can change ten times as much.
        assert_eq!(rays("light(at = [0, 0, 0], intensity = 10);", CUTOFF), (2, 1));
    }

    #[test]
    fn that_the_cutoff_leaves_out_is_half_of_the_smallest_step() {
        let lights: Vec<f64> = Level::all().map(Level::light).collect();
        let smallest = lights.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        assert_eq!(CUTOFF, libm::floor(1000.0 * smallest / 2.0) / 1000.0);
    }

    #[test]
    fn comes_through_each_glass_solid_once() {
        let lit = |between: &str| {
            let text = format!(
                "world(ambient = 0); light(at = [0, 0, 10], intensity = 1);
                material(name = \"glass\", kd = 0, ks = 0, kt = 0.6, index = 1.5);
                material(kd = 1, ks = 0, color = [1, 1, 1]) translate([0, 0, -0.5]) cube([9, 9, 1], center = true);
                {between}"
            );
            let eye = DVec3::new(3.0, 0.0, 1.0);
            let (light, counts) = dot(&text, eye, -eye.normalize(), &all_rays());
            assert_eq!(counts.shadow_rays, 1);
            (libm::round(light * 1e12) / 1e12, counts.shadow_hits)
        };
        let ball = |z: f64| format!("material(\"glass\") translate([0, 0, {z}]) sphere(0.8);");
        let shell = "material(\"glass\") translate([0, 0, 5]) difference() { sphere(0.8); sphere(0.5); }";
        let opaque = "translate([0, 0, 7]) cube(1, center = true);";
        assert_eq!(lit(""), (1.0, 0));
        assert_eq!(lit(&ball(5.0)), (0.6, 1));
        assert_eq!(lit(shell), (0.6, 1));
        assert_eq!(lit(&format!("{}{}", ball(4.0), ball(6.0))), (0.36, 1));
        // In one another, too.
        let inner = "material(\"glass\") translate([0, 0, 5]) sphere(0.4);";
        assert_eq!(lit(&format!("{}{inner}", ball(5.0))), (0.36, 1));
        assert_eq!(lit(&format!("{}{opaque}", ball(4.0))), (0.0, 1));
        assert_eq!(lit(&format!("{opaque}{}", ball(4.0))), (0.0, 1));
        // Behind the light nothing counts, nor does glass around the light that ends before it.
        assert_eq!(lit(&ball(12.0)), (1.0, 0));
        assert_eq!(lit(&ball(10.0)), (0.6, 1));
    }

    #[test]
    fn of_the_same_scene_is_the_same_in_every_structure() {
        for name in ["glass", "mirrors"] {
            let text = ray13::scene::embedded().iter().find(|s| s.name == name).unwrap().text;
            let studio = Studio::new(scene(text)).unwrap();
            let frames =
                [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree].map(|structure| {
                    let mut request = request(studio.camera(0, 1.6), Size::new(64, 40));
                    request.options.structure = structure;
                    studio.draw(&request)
                });
            for frame in &frames[1..] {
                assert!(frame.light == frames[0].light, "{name}");
                assert_eq!(frame.counts.secondary_rays, frames[0].counts.secondary_rays);
            }
            assert!(frames[0].counts.secondary_rays > 1000);
        }
    }
}

fn material() -> impl Strategy<Value = Material> {
    let shares = prop::array::uniform4(0.0..1.0_f64);
    (shares, 0.5..3.0, 1.0..40.0, prop::array::uniform3(0.0..=1.0)).prop_map(|(shares, index, n, color)| {
        let all = shares.iter().sum::<f64>().max(1.0);
        let [kd, ks, kr, kt] = shares.map(|share| share / all);
        Material { name: None, color: DVec3::from(color), kd, ks, n, kr, kt, index }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// With shares that add up to 1 at most no light comes out of nothing, however the solids overlap, touch and
    /// enclose one another.
    #[test]
    fn no_dot_is_brighter_than_the_brightest_source(
        materials in prop::collection::vec(material(), 7),
        places in prop::collection::vec((-4..=4, -4..=4, -4..=4), 6),
        background in 0.0..=1.0,
        eye in (-9..=9, -9..=9, -9..=9),
    ) {
        let solids = ["sphere(2.5);", "cube(2, center = true);", "cylinder(h = 3, r = 1, center = true);",
            "difference() { sphere(2); cube(2, center = true); }", "union() { sphere(1); cube([4, 1, 1]); }",
            "intersection() { cube(3); sphere(3); }"];
        let text: String = solids.iter().zip(&places)
            .map(|(solid, (x, y, z))| format!("translate([{x}, {y}, {z}]) {solid}\n"))
            .collect();
        let mut scene = scene(&format!(
            "world(ambient = 0, background = {background});
            light(at = [5, -9, 12], intensity = 0.7); light(at = [0, 0, 0], intensity = 0.3); {text}"));
        for (object, number) in scene.objects.iter_mut().zip(0..) {
            paint(&mut object.solid, number);
        }
        prop_assert!(scene.objects.len() <= materials.len());
        scene.materials = materials;
        let eye = DVec3::new(f64::from(eye.0), f64::from(eye.1), f64::from(eye.2)) * 0.5;
        let camera = Camera { name: None, eye, target: eye + DVec3::new(-1.0, 3.0, -0.5), up: DVec3::Z,
            field: [120.0, 120.0], span: ray13::scene::FieldSpan::Edges, zoom: 1.0 };
        let mut request = request(camera, Size::new(16, 16));
        request.options = Options { depth: 6, ..all_rays() };
        let frame = Studio::new(scene).unwrap().draw(&request);
        for &light in frame.light.values() {
            prop_assert!((0.0..=1.0 + 1e-12).contains(&light), "{light}");
        }
    }
}

/// Gives all primitives of a solid one material.
fn paint(solid: &mut ray13::scene::Solid, number: u32) {
    use ray13::scene::{MaterialId, Solid};
    match solid {
        Solid::Primitive(primitive) => primitive.material = MaterialId(number),
        Solid::Union(children) | Solid::Intersection(children) | Solid::Difference(children) => {
            children.iter_mut().for_each(|child| paint(child, number));
        }
    }
}

#[test]
fn a_scene_without_mirrors_or_glass_plans_no_rays_for_them() {
    let counts = |text: &str| dot(text, DVec3::new(0.0, -6.0, 0.0), DVec3::Y, &all_rays()).1;
    let plain = counts("sphere(1); light(at = [0, -9, 0]);");
    assert_eq!((plain.secondary_rays, plain.truncated_rays), (0, 0));
    let one: Vec<Bend> =
        bends(&legs(&scene("sphere(1);"), DVec3::new(0.0, -6.0, 0.0), DVec3::Y, Kind::Snell));
    assert!(one.is_empty());
}

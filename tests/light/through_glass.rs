//! What single dots see by mirrors, in glass and behind it, and how many rays were sent for it.

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::{CUTOFF, Options, Shading, StructureChoice};
use ray13::stage::RayKind;
use ray13::tone::Level;

use super::sending::{all_rays, clear, dot, legs, scene};
use crate::support::request::request;

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
    let path = legs(&scene(text), DVec3::new(0.0, 0.1, 0.5), DVec3::new(0.8, 0.0, 0.6), RayKind::Snell);
    assert_eq!((path[1].kind, path[1].weight), (RayKind::Mirror, 0.75));
}

// Every scene of the Standard Procedural Databases, whose background is blue, was traced in three channels
// for a gray picture.
#[test]
fn in_one_channel_is_the_gray_of_that_in_three_where_the_background_alone_has_a_colour() {
    let text = "world(ambient = 0.1, background = [0.1, 0.4, 0.9]); light(at = [-3, -9, 5]);
        material(kd = 0.6, ks = 0.2, kr = 0.3, color = [0.9, 0.3, 0.1]) sphere(1);
        material(kd = 0.2, kt = 0.7, index = 1.4, color = [0.2, 0.9, 0.1]) translate([1.5, -1, 0]) sphere(0.8);";
    for d in [[0.0, 1.0, 0.0], [0.1, 1.0, 0.1], [0.35, 1.0, 0.05], [0.9, 0.2, 0.1]] {
        let d = DVec3::from_array(d).normalize();
        let [(gray, one), (of_three, three)] =
            [false, true].map(|color| dot(text, EYE, d, &Options { color, ..all_rays() }));
        assert_eq!(one, three);
        assert!(gray > 0.0 && (gray - of_three).abs() < 1e-14, "{gray} {of_three}");
    }
}

#[test]
fn of_a_ray_cut_off_is_ambient_and_counted() {
    let text = "world(ambient = 0.3, background = 0); material(kd = 0, ks = 0, kr = 1, color = [0, 0, 0]) {
        translate([0, 0, 2]) cube([9, 9, 1], center = true); translate([0, 0, -2]) cube([9, 9, 1], center = true); }";
    for depth in [0, 1, 4, 64] {
        let (light, counts) = dot(text, DVec3::ZERO, DVec3::Z, &Options { depth, ..all_rays() });
        let sent = u64::from(depth);
        assert_eq!((counts.secondary_rays, counts.secondary_hits, counts.truncated_rays), (sent, sent, 1));
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
    assert_eq!(rays("", 0.0), (16, 1));
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
            [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree, StructureChoice::Boxes]
                .map(|structure| {
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

#[test]
fn a_scene_without_mirrors_or_glass_sends_no_rays_for_them() {
    let counts = |text: &str| dot(text, DVec3::new(0.0, -6.0, 0.0), DVec3::Y, &all_rays()).1;
    let plain = counts("sphere(1); light(at = [0, -9, 0]);");
    assert_eq!((plain.secondary_rays, plain.truncated_rays), (0, 0));
}

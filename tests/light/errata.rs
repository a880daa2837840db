//! The formulas that the paper's text gets wrong, or the scan made unreadable, each by its meaning: the table
//! in docs/paper.md names these tests.

use crate::support::picture::{Seen, look, look_at, shape};
use ray13::frame::{Studio, pcat};
use ray13::math::{DAffine3, DMat3, DVec3};
use ray13::plan::Shading;
use ray13::scene::{Anchor, Light, Material, MaterialId, Object, Primitive, Shape, Solid, World};

const CYLINDER: Shape = Shape::Cone { bottom: 1.0, top: 1.0 };

/// The paper's cone stands below its tip: the centre point is the apex, the base c below it.
const CONE: Shape = Shape::Cone { bottom: 1.0, top: 0.0 };

/// The gradient of a function by central differences: the error is of second order in the step.
fn gradient(f: impl Fn(DVec3) -> f64, p: DVec3) -> DVec3 {
    let step = 1e-5;
    let slope = |axis: DVec3| (f(p + axis * step) - f(p - axis * step)) / (2.0 * step);
    DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z))
}

/// Every dot of a picture whose hit lies on the surface `f = 0` shows the gradient of `f`.
#[track_caller]
fn assert_normals(what: &str, seen: &Seen, f: impl Fn(DVec3) -> f64, not_along: Option<DVec3>) {
    let mut compared = 0;
    for (point, normal) in seen.hits() {
        if f(point).abs() > 1e-9 || not_along.is_some_and(|axis| normal.dot(axis).abs() > 0.999) {
            continue;
        }
        let expected = gradient(&f, point).normalize();
        assert!(normal.abs_diff_eq(expected, 1e-6), "{what} at {point}: {normal}, expected {expected}");
        compared += 1;
    }
    assert!(compared > 100, "{what}: only {compared} dots show the surface");
}

/// Unequal half-sizes, so that `X/a` and `X/a²` differ.
const HALF: DVec3 = DVec3::new(3.0, 2.0, 1.0);

fn placed(half: DVec3) -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_diagonal(half))
}

#[test]
fn the_sphere_normal_is_the_gradient() {
    let seen = look(shape(Shape::Sphere, placed(HALF)), DVec3::new(4.0, -9.0, 5.0));
    assert_normals("sphere", &seen, |p| (p / HALF).length_squared() - 1.0, None);
}

#[test]
fn the_cylinder_normal_is_the_gradient() {
    let seen = look(shape(CYLINDER, placed(HALF)), DVec3::new(4.0, -9.0, 5.0));
    let side = |p: DVec3| (p.truncate() / HALF.truncate()).length_squared() - 1.0;
    assert_normals("cylinder", &seen, side, Some(DVec3::Z));
    let caps = seen.hits().filter(|(_, normal)| *normal == DVec3::Z).count();
    assert!(caps > 100, "the cap shows (0, 0, sign Z)");
}

#[test]
fn the_cone_normal_is_the_gradient_and_points_outward() {
    // X²/a² + Y²/b² ≤ Z²/c², −c ≤ Z ≤ 0: the tip is at the origin.
    let map = DAffine3::from_mat3_translation(
        DMat3::from_diagonal(DVec3::new(3.0, 2.0, 2.0)),
        DVec3::new(0.0, 0.0, -2.0),
    );
    let half = DVec3::new(3.0, 2.0, 4.0);
    let seen = look(shape(CONE, map), DVec3::new(4.0, -9.0, 1.0));
    let side = |p: DVec3| (p.truncate() / half.truncate()).length_squared() - p.z * p.z / (half.z * half.z);
    assert_normals("cone", &seen, side, None);
    // Z is below 0 on the whole side, so −Z/c² is above: the printed sign would point down, into the solid.
    assert!(seen.hits().all(|(_, normal)| normal.z > 0.0));
    let below = look(shape(CONE, map), DVec3::new(1.0, -2.0, -15.0));
    assert!(below.hits().any(|(_, normal)| normal == DVec3::NEG_Z), "the base shows (0, 0, −1)");
}

#[test]
fn the_cone_has_a_tip_and_no_cap() {
    // Straight down on the tip: the surface there is a point, and its normal is no cap's.
    let seen = look(shape(CONE, placed(DVec3::ONE)), DVec3::new(0.0, 0.0, 6.0));
    let flat = seen.hits().filter(|(_, normal)| normal.z > 0.99).count();
    assert!(seen.hits().count() > 100);
    // The picture has an even number of dots, so none looks exactly at the tip.
    assert_eq!(flat, 0, "a dot shows a horizontal face");
}

/// A white sphere of radius 1 lit by one light, seen from (0, −6, 0).
fn lit(material: Material, light: DVec3, world: World, shading: Shading) -> Seen {
    let mut scene = shape(Shape::Sphere, DAffine3::IDENTITY);
    scene.materials = vec![material];
    scene.lights = vec![Light { anchor: Anchor::World(light), intensity: 1.0, color: DVec3::ONE }];
    scene.world = world;
    look_at(scene, DVec3::new(0.0, -6.0, 0.0), shading)
}

fn matt() -> Material {
    Material { color: DVec3::ONE, kd: 0.5, ks: 0.0, ..Material::default() }
}

const DARK: World = World { ambient: DVec3::ZERO, background: DVec3::ZERO, k: None };

#[test]
fn the_diffuse_term_is_never_below_zero() {
    // max(0, L·N): the side away from the light gets the ambient light and no less.
    let light = DVec3::new(20.0, 0.0, 0.0);
    let world = World { ambient: DVec3::splat(0.25), ..DARK };
    let seen = lit(matt(), light, world, Shading::Lambert);
    let (mut bright, mut dark) = (0, 0);
    for (point, normal, shown) in seen.lit_hits() {
        let cosine = normal.dot((light - point).normalize());
        let expected = 0.25 + 0.5 * cosine.max(0.0);
        assert!((shown - expected).abs() < 1e-9, "{point}: {shown}, expected {expected}");
        if cosine > 0.0 { bright += 1 } else { dark += 1 }
    }
    assert!(bright > 100 && dark > 100, "{bright} dots in the light, {dark} in the dark");
}

#[test]
fn the_depth_term_divides_the_light_and_not_the_ambient_share() {
    let light = DVec3::new(3.0, -20.0, 4.0);
    let world = World { ambient: DVec3::splat(0.1), k: Some(2.0), ..DARK };
    let seen = lit(matt(), light, world, Shading::Depth);
    let eye = DVec3::new(0.0, -6.0, 0.0);
    for (point, normal, shown) in seen.lit_hits() {
        let cosine = normal.dot((light - point).normalize()).max(0.0);
        let expected = 0.1 + 0.5 * cosine / (point.distance(eye) + 2.0);
        assert!((shown - expected).abs() < 1e-9, "{point}: {shown}, expected {expected}");
    }
}

#[test]
fn the_highlight_has_the_exponent_n() {
    // cosⁿθ, not cos²θ: θ between the sight line and the mirror direction of the light.
    let eye = DVec3::new(0.0, -6.0, 0.0);
    let light = DVec3::new(8.0, -12.0, 6.0);
    for n in [2.0, 9.0, 40.5] {
        let material = Material { ks: 0.5, n, kd: 0.0, ..matt() };
        let seen = lit(material, light, DARK, Shading::Phong);
        let mut bright = 0;
        for (point, normal, shown) in seen.lit_hits() {
            let to_light = (light - point).normalize();
            let mirror = 2.0 * normal.dot(to_light) * normal - to_light;
            let cosine = mirror.dot((eye - point).normalize()).max(0.0);
            let lit = normal.dot(to_light) > 0.0;
            let expected = if lit { 0.5 * libm::pow(cosine, n) } else { 0.0 };
            assert!((shown - expected).abs() < 1e-9, "n = {n}, {point}: {shown}, expected {expected}");
            bright += usize::from(expected > 0.01);
        }
        assert!(bright > 20, "n = {n}: only {bright} dots show the highlight");
    }
}

/// A ball that mirrors with a share `kr`, lit and seen from (0, −6, 0), before the ground of another shade.
fn ball_over_ground(kr: f64, shading: Shading) -> Seen {
    let mut scene = shape(Shape::Sphere, DAffine3::IDENTITY);
    let below = DVec3::new(0.0, 0.0, -3.0);
    let map = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::new(50.0, 50.0, 1.0)), below);
    let ground = Solid::Primitive(Primitive::new(Shape::Cube, map, MaterialId(1)));
    scene.objects.push(Object { name: None, solid: ground });
    let white = Material { color: DVec3::ONE, kd: 0.0, ks: 0.0, ..Material::default() };
    scene.materials = vec![Material { kr, color: DVec3::splat(0.5), ks: 0.4, ..matt() }, white];
    let at = DVec3::new(8.0, -12.0, 6.0);
    scene.lights = vec![Light { anchor: Anchor::World(at), intensity: 1.0, color: DVec3::ONE }];
    scene.world = World { ambient: DVec3::splat(0.25), background: DVec3::splat(0.75), k: Some(1.0) };
    look_at(scene, DVec3::new(0.0, -6.0, 0.0), shading)
}

/// What a ray that leaves a point of the ball along the mirror direction sees: the ground's ambient light, or
/// the sky.
fn mirrored(point: DVec3, normal: DVec3) -> Option<f64> {
    let sight = (point - DVec3::new(0.0, -6.0, 0.0)).normalize();
    let d = sight - 2.0 * sight.dot(normal) * normal;
    // Beyond the ground's edge it is sky again; rays that pass near the edge are left to others.
    let far = (point.z + 2.0) / -d.z;
    let land = (point + far * d).truncate().abs().max_element();
    (d.z > 0.01 || land < 49.0).then_some(if d.z > 0.0 { 0.75 } else { 0.25 })
}

#[test]
fn the_highlight_is_no_image_in_a_mirror() {
    // By (3) a mirror shows what a ball of any other kind shows.
    let [mirror, plain] = [0.5, 0.0].map(|kr| ball_over_ground(kr, Shading::Phong));
    assert!(mirror.lit_hits().eq(plain.lit_hits()));
}

#[test]
fn equation_four_adds_its_terms_to_those_of_equation_three() {
    let [three, four] = [Shading::Phong, Shading::Whitted].map(|shading| ball_over_ground(0.5, shading));
    let (mut ground, mut sky) = (0, 0);
    for ((point, normal, before), (_, _, light)) in three.lit_hits().zip(four.lit_hits()) {
        if (point.length() - 1.0).abs() > 1e-6 {
            assert_eq!(light, before, "the ground is no mirror");
            continue;
        }
        let Some(seen) = mirrored(point, normal) else { continue };
        assert!((light - before - 0.5 * seen).abs() < 1e-12, "{point}: {before}, then {light}");
        if seen == 0.25 { ground += 1 } else { sky += 1 }
    }
    assert!(ground > 100 && sky > 100, "{ground} dots show the ground, {sky} the sky");
}

#[test]
fn the_picture_of_the_pc_has_164_by_188_dots() {
    // "16⁴ × 188", over the paper's field of 40° × 25° and no more.
    let studio = Studio::new(shape(Shape::Sphere, DAffine3::IDENTITY)).unwrap();
    let frame = studio.draw(&pcat::request(studio.framed(1.0)));
    assert_eq!((frame.light.size().width, frame.light.size().height), (164, 188));
    assert!(frame.counts.primary_hits > 0);
    assert!((frame.field[0] - 40.0).abs() < 1e-12 && (frame.field[1] - 25.0).abs() < 1e-12);
}

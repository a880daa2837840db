//! No light comes out of nothing.

use proptest::prelude::*;
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::Options;
use ray13::scene::{Camera, FieldSpan, Material, MaterialId, Solid};

use super::sending::{all_rays, scene};
use crate::support::request::request;

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

    /// With shares that add up to 1 at most no light comes out of nothing, however the solids overlap, touch
    /// and enclose one another.
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
            field: [120.0, 120.0], span: FieldSpan::Edges, zoom: 1.0 };
        let mut request = request(camera, Size::new(16, 16));
        request.options = Options { depth: 6, ..all_rays() };
        let frame = Studio::new(scene).unwrap().draw(&request);
        for &light in frame.light.values() {
            prop_assert!((0.0..=1.0 + 1e-12).contains(&light), "{light}");
        }
    }
}

/// Gives all primitives of a solid one material.
fn paint(solid: &mut Solid, number: u32) {
    match solid {
        Solid::Primitive(primitive) => primitive.material = MaterialId(number),
        Solid::Union(children) | Solid::Intersection(children) | Solid::Difference(children) => {
            for child in children {
                paint(child, number);
            }
        }
    }
}

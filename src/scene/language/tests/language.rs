//! The words for solids, maps, surfaces and views; what OpenSCAD's files say.

use super::{bounds, primitive, primitives, scene};
use crate::math::{Bounds, DVec3};
use crate::scene::{Anchor, Material, Scene, Shape, embedded};

fn box_of(text: &str) -> Bounds {
    bounds(&primitive(text))
}

fn exactly(lo: [f64; 3], hi: [f64; 3]) -> Bounds {
    Bounds::new(DVec3::from_array(lo), DVec3::from_array(hi))
}

#[track_caller]
fn nearly(text: &str, lo: [f64; 3], hi: [f64; 3]) {
    let (found, expected) = (box_of(text), exactly(lo, hi));
    let error = (found.lo - expected.lo).abs().max(found.hi - expected.hi).max_element();
    assert!(error < 1e-12, "{text}: {found:?}, not {expected:?}");
}

#[test]
fn primitives_stand_where_openscad_puts_them() {
    assert_eq!(box_of("cube();"), exactly([0.0; 3], [1.0; 3]));
    assert_eq!(box_of("cube([0.1, 0.2, 0.3]);"), exactly([0.0; 3], [0.1, 0.2, 0.3]));
    assert_eq!(box_of("cube(3, true);"), exactly([-1.5; 3], [1.5; 3]));
    assert_eq!(
        box_of("cube(center = true, size = [1, 2, 4]);"),
        exactly([-0.5, -1.0, -2.0], [0.5, 1.0, 2.0])
    );
    assert_eq!(box_of("cube(center = true, 3);"), exactly([-1.5; 3], [1.5; 3]));
    assert_eq!(box_of("sphere();"), exactly([-1.0; 3], [1.0; 3]));
    assert_eq!(box_of("sphere(d = 3);"), exactly([-1.5; 3], [1.5; 3]));
    assert_eq!(box_of("cylinder(5);"), exactly([-1.0, -1.0, 0.0], [1.0, 1.0, 5.0]));
    assert_eq!(box_of("cylinder(h = 4, r = 2, center = true);"), exactly([-2.0; 3], [2.0; 3]));
    assert_eq!(box_of("cone(h = 4, r = 2);"), exactly([-2.0, -2.0, 0.0], [2.0, 2.0, 4.0]));
    assert_eq!(box_of("sphere(r = undef, $fn = undef);"), exactly([-1.0; 3], [1.0; 3]));
}

#[test]
fn radii_of_cylinders() {
    let radii = |text: &str| {
        let primitive = primitive(text);
        let Shape::Cone { bottom, top } = primitive.shape else { panic!("{primitive:?}") };
        (bottom, top, primitive.map.matrix3.x_axis.x)
    };
    assert_eq!(radii("cylinder(h = 1, r1 = 2, r2 = 4);"), (0.5, 1.0, 4.0));
    assert_eq!(radii("cylinder(1, 4, 0);"), (1.0, 0.0, 4.0));
    assert_eq!(radii("cylinder(h = 1, r1 = 0, r2 = 3);"), (0.0, 1.0, 3.0));
    assert_eq!(radii("cylinder(h = 1, r1 = 4);"), (1.0, 0.25, 4.0), "r2 is 1 where it is not given");
    assert_eq!(radii("cylinder(h = 1, r = 4, r2 = 2);"), (1.0, 0.5, 4.0));
    assert_eq!(radii("cylinder(h = 1, d1 = 2, d2 = 4);"), (0.5, 1.0, 2.0));
    assert_eq!(radii("cylinder(h = 1, d = 4);"), (1.0, 1.0, 2.0));
}

#[test]
fn the_papers_parameters() {
    assert_eq!(
        box_of("sphere(at = [1, 2, 3], semi = [4, 5, 6]);"),
        exactly([-3.0, -3.0, -3.0], [5.0, 7.0, 9.0])
    );
    assert_eq!(box_of("cube(at = [1, 2, 3], semi = 1);"), exactly([0.0, 1.0, 2.0], [2.0, 3.0, 4.0]));
    assert_eq!(box_of("cylinder(semi = [1, 2, 3]);"), exactly([-1.0, -2.0, -3.0], [1.0, 2.0, 3.0]));
    let cone = primitive("cone(at = [0, 0, 5], semi = [1, 2, 3]);");
    assert_eq!(bounds(&cone), exactly([-1.0, -2.0, 2.0], [1.0, 2.0, 5.0]), "the apex is the centre");
    assert_eq!(cone.shape, Shape::Cone { bottom: 1.0, top: 0.0 });
}

#[test]
fn few_sides_are_flat_and_many_are_round() {
    let is_faceted = |text: &str| matches!(primitive(text).shape, Shape::Facets(_));
    for (fragments, expected) in
        [("0", false), ("2", false), ("3", true), ("12.5", true), ("13", false), ("-6", false)]
    {
        assert_eq!(is_faceted(&format!("cylinder($fn = {fragments});")), expected, "{fragments}");
        assert_eq!(is_faceted(&format!("$fn = 3; $fn = {fragments}; sphere();")), expected, "{fragments}");
    }
    assert!(is_faceted("union($fn = 6) cylinder();") && !is_faceted("$fn = 6; cylinder($fn = 0);"));
    assert_eq!(box_of("cylinder(h = 2, r = 3, $fn = 4);"), exactly([-3.0, -3.0, 0.0], [3.0, 3.0, 2.0]));
}

#[test]
fn maps_are_openscads() {
    nearly("translate([1, 2]) cube(1);", [1.0, 2.0, 0.0], [2.0, 3.0, 1.0]);
    assert_eq!(box_of("rotate(90) cube([1, 2, 3]);"), exactly([-2.0, 0.0, 0.0], [0.0, 1.0, 3.0]));
    assert_eq!(box_of("rotate([90, 0, 0]) cube([1, 2, 3]);"), exactly([0.0, -3.0, 0.0], [1.0, 0.0, 2.0]));
    // x first, then y: z goes to −y and stays there.
    assert_eq!(box_of("rotate([90, 90, 0]) cube([1, 2, 3]);"), exactly([0.0, -3.0, -1.0], [2.0, 0.0, 0.0]));
    assert_eq!(box_of("rotate([90, 0, 90]) cube([1, 2, 3]);"), exactly([0.0, 0.0, 0.0], [3.0, 1.0, 2.0]));
    nearly("rotate(a = 120, v = [1, 1, 1]) cube([1, 2, 3]);", [0.0; 3], [3.0, 1.0, 2.0]);
    assert_eq!(box_of("scale(2) cube(1);"), exactly([0.0; 3], [2.0; 3]));
    assert_eq!(box_of("scale([1, 2]) cube(1);"), exactly([0.0; 3], [1.0, 2.0, 1.0]));
    assert_eq!(box_of("mirror([1, 0, 0]) cube(1);"), exactly([-1.0, 0.0, 0.0], [0.0, 1.0, 1.0]));
    assert_eq!(box_of("mirror([0, 0, 0]) cube(1);"), exactly([0.0; 3], [1.0; 3]));
    let matrix = "multmatrix([[0, 0, 1, 5], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]]) cube([1, 2, 3]);";
    assert_eq!(box_of(matrix), exactly([5.0, 0.0, -1.0], [8.0, 2.0, 0.0]));
    assert_eq!(box_of(&matrix.replace(", [0, 0, 0, 1]]", "]")), box_of(matrix));
    nearly("translate([10, 0, 0]) rotate(90) scale(2) cube(1);", [8.0, 0.0, 0.0], [10.0, 2.0, 2.0]);
}

#[test]
fn sizes_at_the_extremes() {
    for size in ["1e-150", "1e150", "1e-300", "1e300"] {
        let value: f64 = size.parse().expect("a number");
        assert_eq!(box_of(&format!("cube({size});")).hi, DVec3::splat(value));
        assert_eq!(box_of(&format!("scale({size}) rotate(90) sphere(1);")).hi.z, value);
    }
    nearly("scale(1e150) scale(1e-150) rotate(30, [1, 2, 3]) sphere(1e-150);", [0.0; 3], [0.0; 3]);
    nearly("scale([1e-150, 1, 1e150]) scale([1e150, 1, 1e-150]) cube(1);", [0.0; 3], [1.0; 3]);
}

#[test]
fn literals() {
    assert_eq!(box_of("cube([.5, 1e0, +2.5E-1,],);"), exactly([0.0; 3], [0.5, 1.0, 0.25]));
    assert_eq!(
        box_of("\u{feff}// no\n/* cube(9); **/ translate([--1, - 1, 1.]) /**/ cube(1)/*;*/;"),
        exactly([1.0, -1.0, 1.0], [2.0, 0.0, 2.0])
    );
    let named =
        |text: &str| scene(&format!("object({text}) cube(1);")).objects[0].name.clone().expect("a name");
    assert_eq!(named(r#""a\"b\\c\td""#), "a\"b\\c\td");
    assert_eq!(named(r#""\x41é\u00e9\U01F600""#), "Aéé😀");
    assert_eq!(named(r#""C:\part \xzz""#), r"C:\part \xzz");
}

fn materials(text: &str) -> Vec<Material> {
    let scene = scene(text);
    primitives(&scene)
        .iter()
        .map(|primitive| scene.materials[primitive.material.0 as usize].clone())
        .collect()
}

#[test]
fn the_nearest_material_counts() {
    let text = "material(\"a\", kd = 0.1) { cube(1); material(\"b\") sphere(1); }
        material(\"a\", kd = 0.5, color = [1, 0, 0]); material(\"b\", kr = 0.5); cube(1); material(\"a\") cube(1);";
    let [changed, nearest, default, named] = &materials(text)[..] else { panic!("four primitives") };
    assert_eq!((changed.kd, changed.color, changed.name.as_deref()), (0.1, DVec3::X, None));
    assert_eq!((nearest.kd, nearest.kr, nearest.name.as_deref()), (0.8, 0.5, Some("b")));
    assert_eq!(*default, Material::default());
    assert_eq!((named.kd, named.name.as_deref()), (0.5, Some("a")));
}

#[test]
fn the_outermost_color_counts() {
    let text = "material(\"m\", kd = 0.5);
        color(\"red\") material(\"m\") cube(1); material(\"m\") color(\"red\") cube(1);
        color([1, 0, 0]) color(\"blue\") cube(1); color(\"blue\", 0.25) cube(1); color([0, 0, 1, 0.25]) cube(1);";
    let [inside, outside, first, clear, also_clear] = &materials(text)[..] else { panic!("five primitives") };
    assert_eq!(inside, outside);
    let text = "color([-1, -1, -1, 1]) color(\"red\") cube(1);";
    assert_eq!(materials(text)[0].color, DVec3::X, "as OpenSCAD writes a colour that is none");
    assert_eq!((inside.color, inside.kd), (DVec3::X, 0.5));
    assert_eq!((first.color, first.kd), (DVec3::X, Material::default().kd));
    assert_eq!((clear.color, clear.kt), (DVec3::Z * 0.25, 0.75));
    assert_eq!(clear, also_clear);
}

#[test]
fn equal_materials_are_one() {
    let text =
        "color(\"red\") cube(1); color([1, 0, 0]) cube(1); color(\"#f00\") { cube(1); cube(2); } cube(3);
        material(kd = 0.3) cube(1); material(kd = 0.3) cube(2); material(\"unused\");";
    assert_eq!(scene(text).materials.len(), 3);
}

#[test]
fn views_lights_and_the_world() {
    let scene = scene(
        "camera(\"front\", eye = [0, -9, 3]);
        camera(eye = [0, 0, 9], target = [0, 0, 1], field = [60, 30.5], zoom = 2);
        camera(eye = [1, 1, 1], up = [0, 1, 0]);
        light(at = [1, 2, 3], intensity = 0.5, color = \"red\"); light([0, 0, 9]);
        world(ambient = 0.2, background = [0.1, 0.2, 0.3], k = 5);
        sphere(1);",
    );
    let [front, above, third] = &scene.views[..] else { panic!("three views") };
    assert_eq!((front.name.as_deref(), front.target, front.up), (Some("front"), DVec3::ZERO, DVec3::Z));
    assert_eq!((front.field, front.zoom), ([40.0, 25.0], 1.0));
    assert_eq!((above.up, above.field, above.zoom), (DVec3::Y, [60.0, 30.5], 2.0));
    assert_eq!(third.up, DVec3::Y);
    assert_eq!(scene.lights[0].anchor, Anchor::World(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!((scene.lights[0].intensity, scene.lights[0].color), (0.5, DVec3::X));
    assert_eq!((scene.lights[1].intensity, scene.lights[1].color), (1.0, DVec3::ONE));
    let world = scene.world;
    assert_eq!((world.ambient, world.background), (DVec3::splat(0.2), DVec3::new(0.1, 0.2, 0.3)));
    assert_eq!(world.k, Some(5.0));
}

#[test]
fn a_file_as_openscad_writes_it() {
    // The shape of OpenSCAD's own example "CSG-modules": groups for modules, colours, settings on every
    // solid.
    let scene: Scene = scene(
        "group() {
	multmatrix([[1, 0, 0, -24], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
		difference() {
			cube(size = [15, 15, 15], center = true);
			group() {
				color([0, 1, 0, 1]) {
					cylinder($fn = 0, $fa = 5, $fs = 0.1, h = 20, r1 = 5, r2 = 5, center = true);
				}
			}
		}
	}
	render(convexity = 2) { sphere($fn = 0, $fa = 12, $fs = 2, r = 10); }
	polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], convexity = 1);
}",
    );
    assert_eq!((scene.objects.len(), scene.materials.len(), scene.notes.len()), (3, 2, 0));
}

#[test]
fn embedded_scenes_read_and_have_views_and_lights() {
    let names: Vec<_> = embedded().iter().map(|scene| scene.name).collect();
    assert_eq!(names, ["hanyang", "die", "bolt", "temple", "glass", "mirrors", "teapot"]);
    for embedded in embedded() {
        let scene = scene(embedded.text);
        assert!(
            scene.notes.is_empty() && scene.views.len() >= 3 && scene.lights.len() >= 2,
            "{}",
            embedded.name
        );
        let world =
            primitives(&scene).iter().fold(Bounds::EMPTY, |all, primitive| all.join(&bounds(primitive)));
        let inside = scene.views.iter().filter(|view| world.contains(view.eye)).count();
        let expected = match embedded.name {
            "hanyang" => 1,
            "temple" => 2,
            "bolt" => 0,
            _ => inside,
        };
        assert_eq!(inside, expected, "{}", embedded.name);
    }
    let die = scene(embedded()[1].text);
    let pips = |scene: &Scene| {
        primitives(scene).iter().filter(|primitive| primitive.map.matrix3.determinant().abs() < 0.02).count()
    };
    assert_eq!(pips(&die), 2 * 21);
}

#[test]
fn a_clear_colour_leaves_its_share_of_the_mirror() {
    let [clear, full] = &materials(
        "color(\"red\", 0.25) material(kr = 0.8) cube(1); color(\"red\") material(kr = 1) cube(1);",
    )[..] else {
        panic!("two primitives")
    };
    assert_eq!((clear.kr, clear.kt), (0.2, 0.75));
    assert_eq!((full.kr, full.kt), (1.0, 0.0));
}

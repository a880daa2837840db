//! Plane figures, and what is made of them.

use super::{primitives, scene};
use crate::math::{Bounds, DVec3};
use crate::scene::{Mesh, ReadOptions, Scene, Shape, Solid, read};

fn mesh(scene: &Scene) -> Mesh {
    let found = primitives(scene);
    let [primitive] = found[..] else { panic!("{} primitives", found.len()) };
    let Shape::Mesh(mesh) = &primitive.shape else { panic!("{primitive:?}") };
    let points = mesh.points.iter().map(|&p| primitive.map.transform_point3(p)).collect();
    Mesh { points, triangles: mesh.triangles.clone() }
}

/// Six times the volume within a closed mesh whose triangles all turn the same way is the sum of these
/// products; turned either way, it is found by parity along a grid of rays.
fn volume(mesh: &Mesh) -> f64 {
    let bounds = Bounds::around(mesh.points.iter().copied());
    let size = bounds.half() * 2.0;
    let (count, mut sum) = (60, 0.0);
    for i in 0..count {
        for j in 0..count {
            // Off the grid of whole numbers, on which edges lie.
            let at = |k: i32, share: f64| (f64::from(k) + share) / f64::from(count);
            let (x, y) = (bounds.lo.x + size.x * at(i, 0.513), bounds.lo.y + size.y * at(j, 0.4791));
            let mut heights = Vec::new();
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|i| mesh.points[i as usize] - DVec3::new(x, y, 0.0));
                let [p, q, r] = [
                    b.truncate().perp_dot(c.truncate()),
                    c.truncate().perp_dot(a.truncate()),
                    a.truncate().perp_dot(b.truncate()),
                ];
                if (p > 0.0 && q > 0.0 && r > 0.0) || (p < 0.0 && q < 0.0 && r < 0.0) {
                    heights.push((p * a.z + q * b.z + r * c.z) / (p + q + r));
                }
            }
            assert_eq!(heights.len() % 2, 0, "a ray leaves what it enters");
            heights.sort_by(f64::total_cmp);
            sum += heights.chunks_exact(2).map(|pair| pair[1] - pair[0]).sum::<f64>();
        }
    }
    sum * size.x * size.y / f64::from(count * count)
}

fn assert_volume(text: &str, expected: f64) {
    let found = volume(&mesh(&scene(text)));
    assert!((found - expected).abs() < 0.03 * expected, "{text}: {found} {expected}");
}

#[test]
fn what_is_extruded_straight_is_exact() {
    let scene = scene(
        "linear_extrude(4) { circle(2); translate([9, 0]) square([1, 2]); }
         linear_extrude(4, center = true) translate([0, 9, 5]) circle(d = 2, $fn = 6);",
    );
    let found = primitives(&scene);
    assert_eq!(scene.objects.len(), 3);
    assert_eq!(found[0].shape, Shape::Cone { bottom: 1.0, top: 1.0 });
    assert_eq!(found[1].shape, Shape::Cube);
    assert!(matches!(found[2].shape, Shape::Facets(_)));
    let bounds = |i: usize| found[i].shape.bounds().mapped(&found[i].map);
    assert_eq!(bounds(0), Bounds::new(DVec3::new(-2.0, -2.0, 0.0), DVec3::new(2.0, 2.0, 4.0)));
    assert_eq!(bounds(1), Bounds::new(DVec3::new(9.0, 0.0, 0.0), DVec3::new(10.0, 2.0, 4.0)));
    // A way along z does not move a figure.
    assert_eq!((bounds(2).lo.z, bounds(2).hi.z), (-2.0, 2.0));
}

#[test]
fn operators_on_figures_are_operators_on_what_is_extruded() {
    let scene =
        scene("linear_extrude(4) difference() { square(3); intersection() { circle(1); circle(2); } }");
    let [object] = &scene.objects[..] else { panic!("{scene:?}") };
    let Solid::Difference(parts) = &object.solid else { panic!("{object:?}") };
    assert!(matches!(&parts[1], Solid::Intersection(both) if both.len() == 2));
}

#[test]
fn a_drawing_is_one_unit_thick() {
    let scene = scene("square(3); color(\"red\") polygon([[5, 0], [6, 0], [5, 1]]);");
    for primitive in primitives(&scene) {
        let bounds = primitive.shape.bounds().mapped(&primitive.map);
        assert_eq!((bounds.lo.z, bounds.hi.z), (-0.5, 0.5));
    }
}

#[test]
fn a_polygon_is_filled_where_an_odd_number_of_outlines_lies_around() {
    // A star's five points; its middle is not inside.
    let star = "polygon([[0, 3], [1.8, -2.4], [-2.9, 0.9], [2.9, 0.9], [-1.8, -2.4]])";
    let whole = "polygon([[0, 3], [1.8, -2.4], [-2.9, 0.9], [2.9, 0.9], [-1.8, -2.4]], [[0, 1, 2, 3, 4]])";
    let lone = mesh(&scene(&format!("linear_extrude(1) {star};")));
    assert_eq!(mesh(&scene(&format!("linear_extrude(1) {whole};"))), lone);
    let hull = mesh(&scene(&format!("linear_extrude(1) hull() {star};")));
    assert!(volume(&lone) < 0.5 * volume(&hull));
    let squares = "polygon([[0,0],[9,0],[9,9],[0,9],[2,2],[7,2],[7,7],[2,7],[3,3],[6,3],[6,6],[3,6]],
        [[0,1,2,3],[4,5,6,7],[8,9,10,11]])";
    assert_volume(&format!("linear_extrude(2) {squares};"), 2.0 * (81.0 - 25.0 + 9.0));
    // Corners that were not cut keep their places to the last bit.
    let odd = mesh(&scene("linear_extrude(1) polygon([[0.1, 0.7], [0.3, 0.7], [0.3, 1.1]]);"));
    assert!(
        odd.points.contains(&DVec3::new(0.1, 0.7, 0.0)) && odd.points.contains(&DVec3::new(0.3, 1.1, 1.0))
    );
}

#[test]
fn twists_and_scales_and_turns_enclose_what_they_should() {
    assert_volume("linear_extrude(6, twist = 90, slices = 40) square(2, center = true);", 24.0);
    // Sides in four, of which each turns by itself: nearer to the true surface, which has all of the area.
    let sides = |arguments: &str| {
        mesh(&scene(&format!(
            "linear_extrude(6, twist = 90, slices = 9{arguments}) square(2, center = true);"
        )))
    };
    assert_eq!((sides("").points.len(), sides(", segments = 16").points.len()), (40, 160));
    assert_eq!(sides(", segments = 18").points.len(), 160);
    assert_volume("linear_extrude(6, scale = 0) square([2, 4], center = true);", 16.0);
    // ∫ 8 (1 − t/2)(1 + t) dt over a unit, times the height.
    assert_volume(
        "linear_extrude(6, scale = [0.5, 2]) square([2, 4], center = true);",
        6.0 * 8.0 * (1.0 + 0.25 - 1.0 / 6.0),
    );
    assert_volume("linear_extrude(6, scale = [0, 1]) square([2, 4], center = true);", 24.0);
    let tau = std::f64::consts::TAU;
    assert_volume("rotate_extrude($fn = 90) translate([3, 0]) square(2);", tau * 4.0 * 4.0);
    assert_volume("rotate_extrude(angle = 90, $fn = 90) translate([3, 0]) square(2);", tau * 4.0);
    assert_volume("rotate_extrude(angle = -90, $fn = 90) translate([-5, 0]) square(2);", tau * 4.0);
    assert_volume("rotate_extrude($fn = 90) polygon([[0, 0], [3, 0], [0, 3]]);", tau / 2.0 * 9.0);
    assert_volume(
        "linear_extrude(6, v = [3, 0, 4]) polygon([[0, 0], [2, 0], [2, 2], [0, 2]]);",
        4.0 * 6.0 * 0.8,
    );
}

#[test]
fn hulls_sums_offsets_shadows_and_sizes() {
    assert_volume("hull() { cube(2); translate([0, 0, 4]) cube(2); hull() cube(1); }", 24.0);
    assert_volume(
        "hull() { linear_extrude(1) square(2); translate([0, 0, 3]) linear_extrude(1, scale = 1) square(2); }",
        16.0,
    );
    assert_volume("minkowski() { cube([4, 3, 2]); cube(1); }", 60.0);
    assert_volume("linear_extrude(2) minkowski() { square(4); square(1); }", 50.0);
    assert_volume("linear_extrude(2) offset(delta = 1) square(4);", 72.0);
    assert_volume("linear_extrude(2) offset(delta = -1) square(4);", 8.0);
    assert_volume(
        "linear_extrude(2) offset(r = 1, $fn = 90) square(4);",
        2.0 * (16.0 + 16.0 + std::f64::consts::PI),
    );
    assert_volume("linear_extrude(2) fill() difference() { square(4); translate([1, 1]) square(1); }", 32.0);
    assert_volume("linear_extrude(2) projection() translate([0, 0, 9]) cube([4, 3, 1]);", 24.0);
    assert_volume(
        "linear_extrude(2) projection(cut = true) difference() { cube(4, center = true); translate([-1, -1, -1]) cube(2); }",
        24.0,
    );
    assert_volume("resize([10, 0, 5], auto = [false, true, false]) cube([2, 3, 4]);", 10.0 * 15.0 * 5.0);
    let grown =
        mesh(&scene("linear_extrude(2) minkowski() { polygon([[0,0],[4,0],[4,4],[2,1]]); square(1); }"));
    assert!(volume(&grown) > 0.0);
}

#[test]
fn what_is_cut_is_measured_by_what_is_left_of_it() {
    // Half of a cube of edge 2; the half towards z = 0 is cut away.
    let half = "difference() { cube(2); translate([-1, -1, -1]) cube([4, 4, 2]); }";
    assert_volume(&format!("hull() {{ {half} }}"), 4.0);
    assert_volume(&format!("hull() {{ {half} translate([0, 0, 3]) cube([2, 2, 1]); }}"), 12.0);
    assert_volume("hull() intersection() { cube([4, 1, 1]); translate([3, 0, 0]) cube(2); }", 1.0);
    assert_volume(&format!("linear_extrude(2) projection() rotate([90, 0, 0]) {half}"), 4.0);
    // What is swept, and a ring that is hollow.
    let cut = "difference() { linear_extrude(2) polygon([[0,0],[2,0],[2,2],[0,2],[0,1]]); translate([-1,-1,1]) cube(9); }";
    assert_volume(&format!("hull() {cut}"), 4.0);
    let ring =
        "rotate_extrude($fn = 16) translate([5, 0]) difference() { circle(2, $fn = 8); circle(1, $fn = 8); }";
    let quarter = scene(&format!(
        "resize([0, 0, 8]) intersection() {{ {ring} translate([0, 0, 1]) cube([9, 9, 9]); }}"
    ));
    assert_eq!(primitives(&quarter).len(), 2);
    // A frame: its shadow has a hole, and so has its sum.
    let frame = "difference() { cube([4, 4, 1]); translate([1, 1, -1]) cube([2, 2, 3]); }";
    assert_volume(&format!("linear_extrude(2) projection() {frame}"), 24.0);
    let sum = scene(&format!("minkowski() {{ {frame} cube(0.5); }}"));
    let reach = primitives(&sum)
        .iter()
        .fold(Bounds::EMPTY, |all, primitive| all.join(&primitive.shape.bounds().mapped(&primitive.map)));
    assert_eq!((reach.lo, reach.hi), (DVec3::ZERO, DVec3::new(4.5, 4.5, 1.5)));
    // Two of which neither is convex.
    let corner = "difference() { cube(2); translate([1, 1, -1]) cube(4); }";
    assert_volume(&format!("minkowski() {{ {corner} {corner} }}"), 4.0 * (16.0 - 3.0));
    // The cutter reaches far beyond what it cuts.
    let resized = scene(&format!("resize([10, 0, 5]) {half}"));
    let [object] = &resized.objects[..] else { panic!("{resized:?}") };
    let Solid::Difference(parts) = &object.solid else { panic!("it stays what it is: {object:?}") };
    let Solid::Primitive(cube) = &parts[0] else { panic!("{parts:?}") };
    let bounds = cube.shape.bounds().mapped(&cube.map);
    assert!((bounds.hi - DVec3::new(10.0, 2.0, 10.0)).length() < 1e-9, "{bounds:?}");
}

#[test]
fn faces_in_one_plane_are_carved_whole() {
    let nothing = "hull() difference() { cube(2); cube(2); }";
    let read = read("test.csg", format!("cube(1); {nothing}").as_bytes(), &ReadOptions::default());
    assert_eq!(read.map(|scene| scene.objects.len()), Ok(1));
    for scale in ["1e-150", "1e-9", "1", "1e9", "1e90"] {
        let text = format!("scale({scale}) hull() difference() {{ cube(2); translate([0, 0, 1]) cube(2); }}");
        let hull = mesh(&scene(&text));
        let size = hull.points.iter().map(|p| p.max_element()).fold(0.0, f64::max);
        assert!(hull.points.iter().all(|p| p.z <= 0.500_001 * size), "{text}: {hull:?}");
    }
}

#[test]
fn many_forms_take_no_longer_than_one_that_is_large() {
    // A report: six spheres, each added to the sum of those before it, took seconds, and nested hulls of many
    // corners as long as somebody wrote them. The bound is one of the scene, not of each word.
    let nested = "linear_extrude(1) hull() hull() hull() hull() hull() circle(1, $fn = 5e5);";
    let sum = "minkowski() { sphere(1, $fn = 100); sphere(1, $fn = 100); }";
    let hollow = "difference() { sphere(1, $fn = 30); sphere(0.9, $fn = 30); }";
    let hollow = format!("minkowski() {{ {hollow} {hollow} }}");
    for text in [nested, sum, &hollow] {
        let errors = super::errors(text);
        assert!(errors.contains("would take too long") && errors.contains("$fn"), "{errors}");
    }
}

#[test]
fn what_has_nothing_in_it_is_nothing() {
    for nothing in [
        "linear_extrude(2) polygon([[0, 0], [1, 0], [2, 0]]);",
        "linear_extrude(2) polygon([]);",
        "linear_extrude(2) offset(delta = -3) square(4);",
        "linear_extrude(2) hull() { }",
        "hull() { }",
        "hull() linear_extrude(1) polygon([]);",
        "linear_extrude(2) minkowski() { }",
        "linear_extrude(1, twist = 9) difference() { square(1); square(1); }",
        "linear_extrude(2) cube(1);",
        "rotate_extrude() sphere(1);",
        "projection() square(1);",
        "linear_extrude(2) intersection() { circle(1); polygon([]); }",
    ] {
        let read = read("test.csg", format!("cube(1); {nothing}").as_bytes(), &ReadOptions::default());
        assert_eq!(read.unwrap_or_else(|e| panic!("{nothing}: {e}")).objects.len(), 1, "{nothing}");
    }
}

#[test]
fn what_would_never_end_is_refused_with_a_word() {
    let tangle: Vec<String> =
        (0..3000).map(|i| format!("[{}, {}]", i * 7919 % 3001, i * 104_729 % 2999)).collect();
    let tangle = format!("linear_extrude(1) polygon([{}]);", tangle.join(", "));
    for (text, word) in [
        ("linear_extrude(1, twist = 3, slices = 1e9) square(1);", "corners"),
        ("linear_extrude(1, twist = 1e15) square(1);", "corners"),
        ("hull() sphere(1, $fn = 1e9);", "corners"),
        ("hull() cylinder(1, $fn = 1e300);", "corners"),
        ("linear_extrude(1, twist = 1) circle(1, $fs=1e-300, $fa=1e-300, $fn=1e8);", "corners"),
        ("linear_extrude(1) offset(r = 1, $fn = 1e9) square(1);", "corners"),
        ("linear_extrude(1, twist = 9, segments = 1e9) square(1);", "corners"),
        ("rotate_extrude() translate([-1, 0]) square(2);", "both sides"),
        ("linear_extrude(1, v = [1, 0, 0]) square(1);", "upwards"),
        ("polygon([[0, 0], [1, 0], [0, 1]], [[0, 1, 3]]);", "index"),
        ("polygon([[0, 0], [1, 0], 7]);", "[x, y]"),
        (tangle.as_str(), "sorted out"),
    ] {
        let errors = super::errors(text);
        assert!(errors.contains(word), "{errors}");
        assert!(errors.starts_with("test:1:"), "{errors}");
    }
}

#[test]
fn the_deepest_nest_of_hulls_is_read() {
    let text = format!("{}cube(1);{}", "hull() {".repeat(1900), "}".repeat(1900));
    assert_eq!(mesh(&scene(&text)).points.len(), 8);
}

#[test]
fn numbers_at_the_ends_of_f64_do_no_harm() {
    let text = "linear_extrude(1) polygon([[1e304, 0], [0, 1e304], [-1e304, 0]]);
        linear_extrude(1, twist = 90) polygon([[1e-310, 0], [0, 1e-310], [-1e-310, 0]]);
        linear_extrude(1) offset(r = 1e300) square(1);
        hull() { cube(1e300); cube(1e-300); }
        resize([1e300, 0, 0]) cube(1);
        rotate_extrude(angle = 1e-300) square(1);
        linear_extrude(1e-320) square(1); cube(1);";
    let read = read("test.csg", text.as_bytes(), &ReadOptions::default()).expect("a scene");
    assert!(!read.objects.is_empty());
}

//! Every picture is defined: wherever the eye stands and whatever it looks at, no value is infinite or not a
//! number, and every structure gives the same bits. Inputs that have no picture are refused with the reason.

use crate::support::cases::cases;
use crate::support::request::request;
use crate::support::sound::Pictures;
use proptest::prelude::*;
use proptest::sample::select;
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::Shading;
use ray13::scene::{Camera, CameraError, FieldSpan, ReadOptions, read};

/// Odd, so that one dot looks along the line of sight.
const DOTS: Size = Size::new(7, 7);

fn studio(text: &str) -> Studio {
    let scene = read("extreme", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    Studio::new(scene).unwrap()
}

fn camera(eye: DVec3, target: DVec3) -> Camera {
    Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 0.3, 1.0),
        field: [60.0, 60.0],
        span: FieldSpan::Edges,
        zoom: 1.0,
    }
}

/// By every shading model.
#[track_caller]
fn all_sound(what: &str, text: &str, studio: &Studio, camera: &Camera) {
    assert_eq!(camera.check(), Ok(()), "{what}: {camera:?}");
    for shading in Shading::ALL {
        // In one channel and in three, in turn.
        let color = matches!(shading, Shading::Lambert | Shading::Whitted);
        let pictures = Pictures::sound(studio, camera, DOTS, shading, color);
        if let Err(fault) = pictures.and_then(|pictures| pictures.same()) {
            panic!("{what}: {fault}\n{text}");
        }
    }
}

/// Solids about the origin whose surfaces have points in common with [`PLACES`].
const SOLIDS: [(&str, &str); 16] = [
    ("ball", "sphere(1);"),
    ("ellipsoid", "sphere(semi = [1, 2, 0.5]);"),
    ("cube", "cube(2, center = true);"),
    ("turned cube", "rotate([30, 45, 60]) cube(2, center = true);"),
    ("cylinder", "cylinder(h = 2, r = 1, center = true);"),
    ("cone", "cylinder(h = 2, r1 = 1, r2 = 0, center = true);"),
    ("turned cone", "rotate([0, 90, 30]) cylinder(h = 2, r1 = 0, r2 = 1, center = true);"),
    ("truncated cone", "cylinder(h = 2, r1 = 1, r2 = 0.5, center = true);"),
    ("prism", "cylinder(h = 2, r = 1, center = true, $fn = 6);"),
    (
        "mesh",
        "polyhedron([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, 0.25]],
            [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]);",
    ),
    ("hollow cube", "difference() { cube(2, center = true); sphere(1); }"),
    ("wedge", "intersection() { cube(2, center = true); rotate(45) cube([1, 2, 2]); sphere(1); }"),
    ("touching cubes", "cube(1); translate([-1, 0, 0]) cube(1); translate([0, -1, -1]) cube(1);"),
    ("needle", "scale([1e-9, 1, 1e9]) sphere(1);"),
    ("plate", "scale([1, 1, 1e-150]) cube(2, center = true);"),
    ("nested balls", "sphere(1); sphere(0.5); difference() { sphere(1); sphere(0.5); }"),
];

/// Surfaces of [`SOLIDS`]: mirrors, glass of every index, shares that are all 0, highlights as sharp as
/// numbers are.
const MATERIALS: [&str; 7] = [
    "color(\"gray\")",
    "material(kd = 0, ks = 0, kr = 1)",
    "material(kd = 0, ks = 1, n = 1e9, kr = 0.1, kt = 0.9, index = 1.5)",
    "material(kd = 0, ks = 1, n = 1e300, kt = 1, index = 1e3)",
    "material(kd = 1, ks = 1, n = 1e-300, kt = 1, index = 1e-3)",
    "material(kd = 0, ks = 0, kr = 0, kt = 0, color = [0, 0, 0])",
    "material(kr = 0.5, kt = 0.5, index = 1, color = [1, 0, 5e-324])",
];

/// On surfaces, edges, corners and apexes of [`SOLIDS`], in the middle of them and beside them.
const PLACES: [DVec3; 14] = [
    DVec3::ZERO,
    DVec3::X,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
    DVec3::ONE,
    DVec3::new(1.0, 0.0, -1.0),
    DVec3::new(0.0, 0.0, 0.5),
    DVec3::new(0.6, 0.8, 0.0),
    DVec3::new(-0.0, 1.0, f64::MIN_POSITIVE),
    DVec3::new(5e-324, -1e-310, 3.0),
    DVec3::new(1.0 + f64::EPSILON, 0.0, 0.0),
    DVec3::new(-0.3, 4.0, 0.7),
    DVec3::new(9.0, -9.0, 9.0),
];

/// A light at the origin, at a corner, at the eye's place in some views, and one as near to an axis as
/// numbers tell.
const LIGHTS: &str = "world(ambient = 0.1, background = [0.1, 0.2, 0.3], k = 1);
    light(at = [0, 0, 0]); light(at = [1, 1, 1], intensity = 0.3); light(at = [9, -9, 9], color = [1, 0.5, 0.2]);
    light(at = [1e-200, 0, 1]);";

/// Every material on one of [`SOLIDS`], from every place.
fn from_every_place(solid: &str) {
    let number = SOLIDS.iter().position(|(name, _)| *name == solid).unwrap();
    let (name, solid) = SOLIDS[number];
    for (kind, material) in MATERIALS.into_iter().enumerate() {
        let text = format!("{LIGHTS} {material} {{ {solid} }}");
        let studio = studio(&text);
        for (from, eye) in PLACES.into_iter().enumerate() {
            // One pair of places with each material, all pairs with one or another.
            let target = PLACES[(from + 1 + (number + kind) % (PLACES.len() - 1)) % PLACES.len()];
            if eye != target && (target - eye).is_finite() {
                all_sound(&format!("{name}, {material}"), &text, &studio, &camera(eye, target));
            }
        }
    }
}

/// A test for each of [`SOLIDS`].
macro_rules! from_every_place_on_and_in {
    ($($test:ident: $solid:literal,)*) => {
        mod from_every_place_on_and_in {
            $(#[test]
            fn $test() {
                super::from_every_place($solid);
            })*

            #[test]
            fn all_of_them() {
                assert_eq!(super::SOLIDS.map(|(name, _)| name), [$($solid),*]);
            }
        }
    };
}

from_every_place_on_and_in! {
    a_ball: "ball",
    an_ellipsoid: "ellipsoid",
    a_cube: "cube",
    a_turned_cube: "turned cube",
    a_cylinder: "cylinder",
    a_cone: "cone",
    a_turned_cone: "turned cone",
    a_truncated_cone: "truncated cone",
    a_prism: "prism",
    a_mesh: "mesh",
    a_hollow_cube: "hollow cube",
    a_wedge: "wedge",
    touching_cubes: "touching cubes",
    a_needle: "needle",
    a_plate: "plate",
    nested_balls: "nested balls",
}

#[test]
fn along_axes_and_with_any_field_and_zoom() {
    let text = format!(
        "{LIGHTS} sphere(1); material(kr = 1) cube(1); translate([3, 0, 0]) difference() {{ cube(2); sphere(1); }}"
    );
    let studio = studio(&text);
    for eye in
        [DVec3::new(0.0, -5.0, 0.0), DVec3::new(1.0, -5.0, 1.0), DVec3::new(-5.0, 0.0, -0.0), DVec3::Z * 5.0]
    {
        for axis in [
            DVec3::Y,
            DVec3::X,
            DVec3::NEG_Z,
            DVec3::new(1e-310, 1.0, -5e-324),
            DVec3::new(1e-200, 1.0, 1e-160),
        ] {
            for (field, zoom) in [
                (0.001, 1.0),
                (179.9, 1.0),
                (40.0, 1e-6),
                (40.0, 1e6),
                (1e-300, 1e300),
                (179.999_999_999, 1e-300),
                (5e-324, 5e-324),
            ] {
                let target = eye + axis;
                let camera = Camera { field: [field, field], zoom, ..camera(eye, target) };
                all_sound("an axis", &text, &studio, &camera);
                let aside =
                    Camera { target: eye + 1e-9 * axis, up: DVec3::new(1e300, 1e-300, -1e300), ..camera };
                all_sound("near an axis", &text, &studio, &aside);
            }
        }
    }
}

// A long run of the property below: the normal of the ball was the root of a subnormal number, and 1.0000055
// long.
#[test]
fn from_so_far_that_a_place_in_a_ball_is_lost() {
    let text = "cube([1, 2, 1]); sphere(1); cube(1);";
    let far = camera(DVec3::new(-1e-160, 1.0, -1e16), DVec3::ZERO);
    all_sound("far", text, &studio(text), &Camera { up: DVec3::X, field: [5e-324, 5e-324], ..far });
}

#[test]
fn with_up_nearly_along_the_sight() {
    let text = format!(
        "{LIGHTS} material(kd = 1, kr = 0.2) difference() {{ cube(2, center = true); sphere(1.2); }}"
    );
    let studio = studio(&text);
    for sight in [DVec3::Y, DVec3::new(0.3, 0.5, -0.1), DVec3::new(1e-8, 1.0, 1e-8)] {
        for off in [1e-2, 1e-9, 1e-14, 4e-15] {
            let up = sight.normalize() + off * DVec3::new(0.7, 0.1, 0.7);
            let camera = Camera { up, ..camera(sight * -4.0, DVec3::ZERO) };
            all_sound("up", &text, &studio, &camera);
        }
    }
}

#[test]
fn at_every_size_and_distance() {
    for size in [1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300] {
        for material in ["color(\"red\")", "material(kr = 0.4, kt = 0.6, index = 1.5)"] {
            // Brighter, and no cut-off ends the rays that split in glass; bright lights have a test of their
            // own.
            let intensity = f64::min(size, 1.0);
            let text = format!(
                "world(k = {size:e}); light(at = [{size:e}, 0, 0]); light(at = [-1e300, 1e-300, 1e300], intensity = {intensity:e});
                scale({size:e}) {material} {{ sphere(1); translate([0.1, 0.2, -0.3]) cube([3, 0.5, 0.5]); difference() {{ cube(1.5, center = true); sphere(0.9); }} }}"
            );
            let studio = studio(&text);
            for far in [0.5, 1.0, 7.0, 1e9, 1e120] {
                let eye = DVec3::new(-0.9, -far, 0.4) * size;
                if eye.is_finite() {
                    all_sound("a size", &text, &studio, &camera(eye, DVec3::ZERO));
                }
            }
            all_sound("framed", &text, &studio, &studio.camera(0, 1.0));
            all_sound("at the end", &text, &studio, &camera(DVec3::splat(1e308), DVec3::X * size));
            all_sound("beyond", &text, &studio, &camera(DVec3::MAX, DVec3::ZERO));
        }
    }
}

// Two lights of 1e308 each summed up to infinity, and so did the samples of a dot; an infinite light times a
// depth term of 0 was not a number; and a highlight's cosine of 1 + 2e-16 to the power of 1e300 was infinite.
#[test]
fn with_lights_as_bright_as_numbers_are() {
    let white = "[1.7e308, 1.7e308, 1.6e308]";
    for k in ["", ", k = 5e-324", ", k = 1e308"] {
        for scene in [
            "material(kd = 1, ks = 1, n = 1e300) sphere(1);",
            "material(kd = 1, ks = 1, kr = 1) { sphere(1); translate([2, 0, 0]) sphere(1); cube([9, 9, 0.1], center = true); }",
        ] {
            let text = format!(
                "world(ambient = {white}, background = {white}{k});
                light(at = [1, 1, 9], intensity = 1.7e308); light(at = [0, -4, 0], intensity = 1.7e308, color = [1, 1, 0.9]);
                light(at = [9, 1, 1], intensity = 1e308); {scene}"
            );
            let studio = studio(&text);
            all_sound("bright", &text, &studio, &camera(DVec3::new(0.0, -4.0, 0.0), DVec3::ZERO));
            let mut request = request(camera(DVec3::new(0.5, -3.0, 1.0), DVec3::ZERO), Size::new(2, 2));
            request.options.samples = 64;
            let frame = studio.draw(&request);
            assert!(frame.light.values().iter().all(|light| light.is_finite()), "{text}");
        }
    }
}

#[test]
fn what_has_no_picture_is_refused() {
    let good = camera(DVec3::ZERO, DVec3::Y);
    for (camera, error) in [
        (Camera { target: DVec3::ZERO, ..good.clone() }, CameraError::NoSight),
        (Camera { target: DVec3::new(0.0, -0.0, 0.0), ..good.clone() }, CameraError::NoSight),
        (Camera { up: DVec3::Y, ..good.clone() }, CameraError::UpAlongSight),
        (Camera { up: DVec3::new(0.0, -1e300, 1e284), ..good.clone() }, CameraError::UpAlongSight),
        (Camera { up: DVec3::ZERO, ..good.clone() }, CameraError::UpAlongSight),
        (Camera { eye: DVec3::MAX, target: DVec3::MIN, ..good.clone() }, CameraError::TooFar),
        (Camera { field: [180.0, 40.0], ..good.clone() }, CameraError::OutOfRange),
        (Camera { zoom: f64::INFINITY, ..good.clone() }, CameraError::OutOfRange),
        (Camera { up: DVec3::NAN, ..good.clone() }, CameraError::OutOfRange),
    ] {
        assert_eq!(camera.check(), Err(error), "{camera:?}");
    }
    for (text, place, message) in [
        ("cube(1);\ncamera(eye = [1e308, 0, 0], target = [-1e308, 0, 0]);", "2:14", "farther apart"),
        ("cube(1);\ncamera(eye = [0, 0, 0]);", "2:14", "the same point"),
        ("cube(1); camera(eye = [0, 5, 0], up = [1e-15, 1, 0]);", "1:39", "along the line of sight"),
        // Found by tests/formats/any_text.rs: these were read, and then could not be put together, at no
        // place.
        ("sphere(5e-324);", "1:1", "smaller than"),
        ("multmatrix([[1, 1, 0, 0], [0, 5e-324, 0, 0], [0, 0, 1, 0]]) cube(2);", "1:61", "smaller than"),
        ("translate([0, 0, 1e306]) cube(1);", "1:26", "farther than 1e305"),
        ("material(kr = 0.5, kt = 0.6) cube(1);", "1:25", "add up to 1.1"),
        ("material(\"a\", kt = 0.6); material(\"a\", kr = 1) cube(1);", "1:45", "add up to 1.6"),
    ] {
        let error = read("test", text.as_bytes(), &ReadOptions::default()).expect_err(text).to_string();
        assert!(
            error.starts_with(&format!("test:{place}: error: ")) && error.contains(message),
            "{text}: {error}"
        );
    }
}

/// Numbers at the ends of what there is, and between.
fn number() -> impl Strategy<Value = f64> {
    let small = [0.0, -0.0, f64::MIN_POSITIVE, -f64::MIN_POSITIVE, 5e-324, -1e-310, 1e-300, -1e-160, 1e-16];
    let plain = [1.0, -1.0, 0.5, -0.5, 2.0, -3.0, 1.0 + f64::EPSILON, 1.0 - f64::EPSILON / 2.0];
    let large = [1e9, -1e16, 1e100, -1e160, 1e300, -1e300, 1e304, 1.7e308];
    prop_oneof![6 => select(plain.to_vec()), 3 => select(small.to_vec()), 1 => select(large.to_vec()), 5 => -2.0..2.0]
}

fn point() -> impl Strategy<Value = DVec3> {
    let any = (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    prop_oneof![2 => select(PLACES.to_vec()), 1 => any]
}

fn size() -> impl Strategy<Value = f64> {
    let ends = vec![f64::MIN_POSITIVE, 1e-300, 1e-150, 1e-9, 1e9, 1e150, 1e300];
    prop_oneof![6 => select(vec![1.0, 0.5, 2.0]), 4 => 0.01..3.0, 1 => select(ends)]
}

/// As the language writes it.
fn triple(v: DVec3) -> String {
    format!("[{:e}, {:e}, {:e}]", v.x, v.y, v.z)
}

fn solid() -> impl Strategy<Value = String> {
    let plain = select(SOLIDS.to_vec()).prop_map(|(_, text)| text.to_owned());
    let sized =
        (0..4, size(), size(), size(), select(vec![0, 3, 6])).prop_map(|(kind, a, b, c, sides)| match kind {
            0 => format!("sphere(r = {a:e}, $fn = {sides});"),
            1 => format!("cube([{a:e}, {b:e}, {c:e}]);"),
            2 => format!("cylinder(h = {a:e}, r1 = {b:e}, r2 = {c:e}, $fn = {sides});"),
            _ => format!("cone(h = {a:e}, r = {b:e});"),
        });
    let angle = || prop_oneof![select(vec![0.0, 45.0, 90.0, -180.0, 1e-300, 1e300, 30.0]), -360.0..360.0];
    let turn = (angle(), angle(), angle()).prop_map(|(x, y, z)| format!("rotate([{x:e}, {y:e}, {z:e}])"));
    let map = prop_oneof![
        3 => point().prop_map(|p| format!("translate({})", triple(p))),
        2 => turn,
        1 => (size(), size(), size()).prop_map(|(x, y, z)| format!("scale([{x:e}, -{y:e}, {z:e}])")),
        1 => point().prop_map(|p| format!("mirror({})", triple(p))),
    ];
    let moved =
        (map, prop_oneof![plain, sized]).prop_map(|(map, solid)| format!("{map} union() {{ {solid} }}"));
    moved.prop_recursive(2, 6, 3, |part| {
        let word = select(vec!["union", "difference", "intersection", "group"]);
        (word, prop::collection::vec(part, 1..=3))
            .prop_map(|(word, parts)| format!("{word}() {{ {} }}", parts.join(" ")))
    })
}

fn light() -> impl Strategy<Value = String> {
    let intensity = select(vec![0.0, 5e-324, 0.5, 1.0, 1e300, 1.7e308]);
    (point(), intensity, select(vec!["\"white\"", "\"red\"", "[1, 0, 5e-324]"])).prop_map(
        |(at, intensity, color)| {
            format!("light(at = {}, intensity = {intensity:e}, color = {color});", triple(at))
        },
    )
}

fn scene() -> impl Strategy<Value = String> {
    let world = (select(vec![0.0, 0.1, 1.7e308]), select(vec!["", ", k = 1", ", k = 5e-324", ", k = 1e308"]))
        .prop_map(|(glow, k)| format!("world(ambient = {glow:e}, background = {glow:e}{k});"));
    let object = (select(MATERIALS.to_vec()), solid())
        .prop_map(|(material, solid)| format!("{material} {{ {solid} }}"));
    let (lights, objects) = (prop::collection::vec(light(), 0..=3), prop::collection::vec(object, 1..=4));
    (world, lights, objects).prop_map(|(world, lights, objects)| {
        format!("{world}\n{}\n{}", lights.join("\n"), objects.join("\n"))
    })
}

fn any_camera() -> impl Strategy<Value = Camera> {
    let axis = select(vec![
        DVec3::X,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::new(1.0, 5e-324, -1e-310),
        DVec3::new(1e-121, 1.0, 1e-120),
    ]);
    let toward = prop_oneof![point().prop_map(|p| (p, true)), axis.prop_map(|d| (d, false))];
    let field =
        || prop_oneof![select(vec![5e-324, 0.001, 40.0, 90.0, 179.9, 179.999_999_999_99]), 1.0..179.0];
    let zoom = select(vec![1.0, 1e-6, 1e6, 1e-300, 1e300, f64::MAX]);
    (point(), toward, point(), field(), field(), zoom).prop_map(
        |(eye, (toward, is_place), up, across, down, zoom)| {
            let target = if is_place { toward } else { eye + toward };
            Camera { up, field: [across, down], zoom, ..camera(eye, target) }
        },
    )
}

/// Drawn by [`any_view_of_any_scene`]: the start of each ray was moved once toward the world, which left one
/// part in 2^52 of the way, and cells were looked for from there in vain.
#[test]
fn from_farther_away_than_numbers_have_digits() {
    let text = format!("{LIGHTS} translate([0, 0, 1]) sphere(semi = [1, 2, 0.5]); sphere(1); cube(1);");
    let studio = studio(&text);
    for exponent in [15, 17, 33, 60, 150, 300] {
        let far = libm::pow(10.0, f64::from(exponent));
        let camera = Camera {
            eye: DVec3::new(1.0, far, far),
            up: DVec3::X,
            field: [10.0 / far; 2],
            ..camera(DVec3::ZERO, DVec3::ZERO)
        };
        all_sound(&format!("from 1e{exponent}"), &text, &studio, &camera);
    }
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn any_view_of_any_scene(
        text in scene(),
        camera in any_camera(),
        scale in prop_oneof![4 => Just(1.0), 1 => select(vec![1e-300, 1e-9, 1e9, 1e150, 1e304])],
        shading in select(Shading::ALL.to_vec()),
        color in any::<bool>(),
    ) {
        let text = format!("{text} scale({scale:e}) {{ sphere(1); cube(1); }}");
        let Ok(scene) = read("any", text.as_bytes(), &ReadOptions::default()) else { return Ok(()) };
        let studio = Studio::new(scene).map_err(|e| TestCaseError::fail(format!("it was read, but: {e}\n{text}")))?;
        let scaled = Camera { eye: camera.eye * scale, target: camera.target * scale, ..camera };
        let framed = studio.camera(0, 1.0);
        prop_assert_eq!(framed.check(), Ok(()), "{}", text);
        for camera in [scaled, framed] {
            if camera.check().is_ok() {
                let pictures = Pictures::sound(&studio, &camera, DOTS, shading, color);
                let same = pictures.and_then(|pictures| pictures.same());
                same.map_err(|fault| TestCaseError::fail(format!("{fault}\n{text}")))?;
            }
        }
    }
}

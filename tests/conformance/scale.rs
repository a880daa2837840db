//! Pictures of one scene at all scales, and far from the origin.

use ray13::frame::Frame;
use ray13::math::{DAffine3, DMat3, DVec3, Size};
use ray13::scene::{
    Anchor, Camera, FieldSpan, Light, Object, Primitive, Scene, Shape, Solid, embedded, read,
};
use ray13::tone::Tone;

use crate::conformance::engine::{Cut, Subject};
use crate::conformance::long::{is_long, report, skipped};
use crate::conformance::solids::{CONE, CYLINDER, mapped, placed, scene, solid};

const DOTS: Size = Size::new(64, 48);

/// A scene, its name, and from where it is seen.
struct View {
    name: String,
    scene: Scene,
    camera: Camera,
}

fn camera(eye: DVec3, target: DVec3, angle: f64) -> Camera {
    Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 0.2, 1.0),
        field: [angle, angle],
        span: FieldSpan::Edges,
        zoom: 1.0,
    }
}

/// Solids of size 1 seen from 10, and the scenes inside the program.
fn views() -> Vec<View> {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let cube = || solid(&Shape::Cube, turn * 0.75, DVec3::ZERO);
    let rod = |axis: usize| {
        let quarter =
            [DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y), DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X)];
        let lie = if axis == 0 { DMat3::IDENTITY } else { quarter[axis - 1] };
        solid(&CYLINDER, turn * lie * DMat3::from_diagonal(DVec3::new(0.5, 0.5, 0.75)), DVec3::ZERO)
    };
    let by_hand = [
        ("sphere", placed(&Shape::Sphere, DVec3::ZERO, DVec3::ONE)),
        (
            "ellipsoid",
            solid(&Shape::Sphere, turn * DMat3::from_diagonal(DVec3::new(1.0, 0.5, 0.25)), DVec3::ZERO),
        ),
        ("cone", solid(&CONE, turn, DVec3::ZERO)),
        ("drilled cube", Solid::Difference(vec![cube(), rod(0), rod(1), rod(2)])),
        ("rounded cube", Solid::Intersection(vec![cube(), placed(&Shape::Sphere, DVec3::ZERO, DVec3::ONE)])),
    ];
    let eye = DVec3::new(4.0, -8.0, 4.5);
    let mut all: Vec<View> = by_hand
        .into_iter()
        .map(|(name, solid)| View {
            name: name.to_owned(),
            scene: scene([solid]),
            camera: camera(eye, DVec3::ZERO, 14.0),
        })
        .collect();
    for one in embedded() {
        let scene = read(one.name, one.text.as_bytes(), &ray13::scene::ReadOptions::default()).unwrap();
        let camera = scene.views.first().cloned().unwrap_or_else(|| camera(eye, DVec3::ZERO, 40.0));
        all.push(View { name: one.name.to_owned(), scene, camera });
    }
    all
}

/// The view with every length and place changed: objects, lights, camera, and the constant of the depth.
fn changed(
    view: &View,
    map: &impl Fn(&DAffine3) -> DAffine3,
    place: impl Fn(DVec3) -> DVec3,
    scale: f64,
) -> View {
    let View { name, scene, camera } = view;
    // The change rounds nothing, or as little as a scale does: the maps are as good as they were.
    let primitive =
        |p: &Primitive| Primitive { map: map(&p.map), ..p.clone() }.with_map_error(p.map_error() * scale);
    let object = |object: &Object| Object { name: None, solid: mapped(&object.solid, &primitive) };
    let light = |light: &Light| match light.anchor {
        Anchor::World(p) => Light { anchor: Anchor::World(place(p)), ..light.clone() },
        Anchor::Eye(_) => light.clone(),
    };
    let mut world = scene.world;
    world.k = world.k.map(|k| k * scale);
    let scene = Scene {
        objects: scene.objects.iter().map(object).collect(),
        lights: scene.lights.iter().map(light).collect(),
        world,
        ..scene.clone()
    };
    let camera = Camera { eye: place(camera.eye), target: place(camera.target), ..camera.clone() };
    View { name: name.clone(), scene, camera }
}

fn scaled(view: &View, scale: f64) -> View {
    let map =
        |map: &DAffine3| DAffine3 { matrix3: map.matrix3 * scale, translation: map.translation * scale };
    changed(view, &map, |p| p * scale, scale)
}

fn drawn<S: Subject>(view: &View) -> Frame {
    S::draw(&view.scene, &view.camera, DOTS, Cut::Tree)
}

fn levels(frame: &Frame) -> Vec<u8> {
    frame.levels(Tone::default()).values().iter().map(|level| level.get()).collect()
}

/// How many dots have another level.
fn differing(a: &Frame, b: &Frame) -> usize {
    levels(a).iter().zip(levels(b)).filter(|(a, b)| **a != *b).count()
}

/// At powers of two the same bits, at powers of ten the same levels.
pub fn a_picture_is_the_same_at_any_scale<S: Subject>() {
    let decades: &[i32] = if is_long() {
        &[-150, -100, -50, -30, -15, -9, -6, -3, -1, 1, 3, 6, 9, 15, 30, 50, 100, 150]
    } else {
        &[-150, -9, 9, 150]
    };
    let mut faults = Vec::new();
    for view in views() {
        let view = scaled(&view, 1.0);
        let plain = drawn::<S>(&view);
        assert!(
            plain.depth.as_ref().unwrap().values().iter().filter(|t| t.is_finite()).count() > 100,
            "{}",
            view.name
        );
        for &decade in decades {
            if f64::from(decade.abs()) > S::RANGE.decades {
                skipped(&format!("{} at 1e{decade}", view.name));
                continue;
            }
            // The power of two next to the power of ten.
            let two = libm::ldexp(1.0, libm::ilogb(libm::pow(10.0, f64::from(decade))));
            let exact = drawn::<S>(&scaled(&view, two));
            let same = |(a, b): (&f64, &f64)| (a * two).to_bits() == b.to_bits();
            let depths = plain
                .depth
                .as_ref()
                .unwrap()
                .values()
                .iter()
                .zip(exact.depth.as_ref().unwrap().values())
                .filter(|&pair| !same(pair))
                .count();
            let lights = |frame: &Frame| frame.light.values().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let light = lights(&plain).iter().zip(lights(&exact)).filter(|(a, b)| **a != *b).count();
            if depths + light > 0 {
                faults.push(format!("{} at {two:e}: {depths} depths and {light} lights differ", view.name));
            }
            let ten = drawn::<S>(&scaled(&view, libm::pow(10.0, f64::from(decade))));
            let dots = differing(&plain, &ten);
            if dots > 0 {
                faults.push(format!("{} at 1e{decade}: {dots} levels differ", view.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Scene and camera moved together, as far as 2⁴⁰, which is 1.1e12. Places are first rounded to 2⁻¹¹, so that
/// their sums with the way are exact, and the moved scene is the same scene.
pub fn a_picture_is_the_same_anywhere<S: Subject>() {
    let grid = |x: f64| (x * 2048.0).round() / 2048.0;
    let exponents: &[i32] =
        if is_long() { &[1, 5, 10, 15, 20, 25, 30, 33, 36, 38, 40] } else { &[10, 25, 40] };
    let (mut dots, mut other) = (0_usize, 0_usize);
    let mut faults = Vec::new();
    for view in views() {
        let on_grid = |map: &DAffine3| DAffine3 { translation: map.translation.map(grid), ..*map };
        let view = changed(&view, &on_grid, |p| p.map(grid), 1.0);
        let plain = drawn::<S>(&view);
        for (number, &exponent) in exponents.iter().enumerate() {
            let far = libm::ldexp(1.0, exponent);
            let way =
                [DVec3::new(far, -far, 0.5 * far), DVec3::X * far, DVec3::new(-far, 0.0, far)][number % 3];
            let moved = changed(
                &view,
                &|map: &DAffine3| DAffine3 { translation: map.translation + way, ..*map },
                |p| p + way,
                1.0,
            );
            let differs = differing(&plain, &drawn::<S>(&moved));
            dots += DOTS.area();
            other += differs;
            if differs > 0 {
                faults.push(format!("{} moved by {way}: {differs} levels differ", view.name));
            }
        }
    }
    report(|| format!("translation: {other} of {dots} levels differ\n{}", faults.join("\n")));
    assert!(other * 10_000 <= dots, "{other} of {dots}:\n{}", faults.join("\n"));
}

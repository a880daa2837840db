//! Eric Haines's standard scenes, counted as others counted them, and a small one of this repository's own,
//! counted by the oracle.

use std::sync::Arc;

use ray13::frame::{Frame, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{
    Anchor, Camera, FieldSpan, Material, MaterialId, ReadOptions, Scene, Shape, Solid, UpAxis, read,
    read_file,
};
use ray13::tone::Tone;

use crate::support::agreement::assert_same_picture;
use crate::support::beside;
use crate::support::oracle::{Oracle, Wide};
use crate::support::rays::directions;
use crate::support::request::request;

/// One of the databases, where they stand beside this repository.
fn studio(name: &str) -> Option<Studio> {
    let scene = read_file(&beside::path(&format!("spd/{name}.nff"))?, &ReadOptions::default()).unwrap();
    Some(Studio::new(scene).unwrap())
}

/// Five mirroring balls over a floor, written as the databases are.
fn own_balls() -> Studio {
    let text = include_bytes!("../files/balls.nff");
    Studio::new(read("balls.nff", text, &ReadOptions::default()).unwrap()).unwrap()
}

/// Counts of an independent program in f64 that starts rays on their surfaces, four generations after the
/// primary rays. Its primary hits are those published by Havran and Sixta (Comparison of hierarchical grids,
/// 1999).
struct Expected {
    name: &'static str,
    primary_hits: u64,
    shadow_rays: u64,
    shadow_hits: u64,
    secondary_rays: u64,
    secondary_hits: u64,
    /// The share by which a count other than the primary hits may differ. Gears and teapot have rays that run
    /// along edges which two faces share; which of the two shows decides what is sent on.
    share: f64,
}

#[track_caller]
fn holds(expected: &Expected) {
    if let Some(studio) = studio(expected.name) {
        holds_of(expected, &studio, studio.camera(0, 1.0), Size::new(513, 513), 4);
    }
}

/// With so many generations after the primary rays.
#[track_caller]
fn holds_of(expected: &Expected, studio: &Studio, camera: Camera, dots: Size, depth: u32) {
    let mut request = request(camera, dots);
    request.options.depth = depth;
    request.options.cutoff = 0.0;
    let counts = studio.draw(&request).counts;
    assert!(
        counts.primary_hits.abs_diff(expected.primary_hits) <= 5,
        "{}: {} primary hits, expected {}",
        expected.name,
        counts.primary_hits,
        expected.primary_hits
    );
    for (what, counted, expected_count) in [
        ("shadow rays", counts.shadow_rays, expected.shadow_rays),
        ("shadow rays blocked", counts.shadow_hits, expected.shadow_hits),
        ("secondary rays", counts.secondary_rays, expected.secondary_rays),
        ("secondary rays that hit", counts.secondary_hits, expected.secondary_hits),
    ] {
        let off = counted.abs_diff(expected_count) as f64;
        assert!(
            off <= expected.share * expected_count as f64,
            "{}: {counted} {what}, expected {expected_count}",
            expected.name
        );
    }
}

macro_rules! counted {
    ($name:ident, $hits:literal, $shadow:literal, $blocked:literal, $sent:literal, $met:literal, $share:literal) => {
        #[test]
        fn $name() {
            holds(&Expected {
                name: stringify!($name),
                primary_hits: $hits,
                shadow_rays: $shadow,
                shadow_hits: $blocked,
                secondary_rays: $sent,
                secondary_hits: $met,
                share: $share,
            });
        }
    };
}

counted!(balls, 263_169, 954_971, 287_384, 175_921, 126_753, 0.005);
counted!(gears, 245_332, 1_551_091, 618_517, 188_586, 129_578, 0.01);
counted!(lattice, 261_170, 1_163_405, 926_879, 237_005, 175_456, 0.005);
counted!(mount, 173_686, 414_445, 254_279, 712_356, 476_908, 0.005);
counted!(rings, 263_169, 1_084_970, 515_843, 315_863, 179_785, 0.005);
counted!(teapot, 161_546, 409_139, 40_619, 226_182, 67_616, 0.01);
counted!(tetra, 49_950, 46_261, 5_557, 0, 0, 0.005);
counted!(tree, 169_909, 1_097_835, 43_403, 0, 0, 0.005);

/// How far from a surface the oracle starts a ray, in the scene's unit: far more than rounding, far less than
/// a ball.
const OFF: f64 = 1e-7;

fn at_rest(anchor: Anchor) -> DVec3 {
    match anchor {
        Anchor::World(place) => place,
        Anchor::Eye(_) => panic!("a lamp of NFF that moves"),
    }
}

#[test]
fn the_oracle_counts_as_many_rays() {
    let studio = own_balls();
    let (scene, dots) = (studio.scene(), Size::new(96, 96));
    let camera = Camera { span: FieldSpan::Edges, ..studio.camera(0, 1.0) };
    let oracle = Oracle::<Wide>::new(scene);
    let mut expected = Expected {
        name: "balls.nff",
        primary_hits: 0,
        shadow_rays: 0,
        shadow_hits: 0,
        secondary_rays: 0,
        secondary_hits: 0,
        share: 0.001,
    };
    let lamps: Vec<DVec3> = scene.lights.iter().map(|light| light.anchor).map(at_rest).collect();
    let mut met = vec![false; scene.objects.len()];
    let mut shadows = |lit: DVec3, normal: DVec3| {
        for way in lamps.iter().map(|&lamp| lamp - lit).filter(|way| normal.dot(*way) > 0.0) {
            expected.shadow_rays += 1;
            let between = oracle.hit(lit, way.normalize());
            expected.shadow_hits += u64::from(between.is_some_and(|other| other.t < way.length()));
        }
    };
    for toward in directions(&camera, dots) {
        let Some(hit) = oracle.hit(camera.eye, toward) else { continue };
        expected.primary_hits += 1;
        met[hit.object as usize - 1] = true;
        let lit = camera.eye + hit.t * toward + OFF * hit.normal;
        shadows(lit, hit.normal);
        // The floor is the first object, and no mirror.
        if hit.object > 1 {
            expected.secondary_rays += 1;
            let toward = toward - 2.0 * toward.dot(hit.normal) * hit.normal;
            let Some(mirrored) = oracle.hit(lit, toward) else { continue };
            expected.secondary_hits += 1;
            shadows(lit + mirrored.t * toward + OFF * mirrored.normal, mirrored.normal);
        }
    }
    assert!(met.iter().all(|&met| met) && expected.shadow_hits > 100 && expected.secondary_hits > 100);
    holds_of(&expected, &studio, camera, dots, 1);
}

/// Draws by every structure, all to the same bits; gives the picture by lattice.
#[track_caller]
fn assert_every_structure_shows_the_same(name: &str, studio: &Studio) -> Frame {
    let draw = |structure| {
        let mut request = request(studio.camera(0, 1.0), Size::new(100, 100));
        request.options.structure = structure;
        studio.draw(&request)
    };
    let whole = draw(StructureChoice::None);
    assert!(whole.counts.primary_hits > 1000, "{name}");
    assert_same_picture(&format!("{name}: tree"), &draw(StructureChoice::Tree), &whole);
    assert_same_picture(&format!("{name}: boxes"), &draw(StructureChoice::Boxes), &whole);
    let lattice = draw(StructureChoice::Lattice);
    assert_same_picture(&format!("{name}: lattice"), &lattice, &whole);
    lattice
}

#[test]
fn every_structure_shows_the_same_balls() {
    let lattice = assert_every_structure_shows_the_same("balls.nff", &own_balls());
    assert_eq!((lattice.over_budget, lattice.space.name()), (None, "lattice"));
    // Where the lattice passes its budget, it says so and a tree takes its place.
    for (name, passes) in [("balls-1", false), ("balls-2", false), ("balls-3", true)] {
        let Some(studio) = studio(name) else { continue };
        let lattice = assert_every_structure_shows_the_same(name, &studio);
        assert_eq!(lattice.over_budget.is_some(), passes, "{name}");
        assert_eq!(lattice.space.name(), if passes { "tree" } else { "lattice" }, "{name}");
    }
}

/// The faces of a database as OBJ, and the scene with the same faces, flat and of one material.
fn as_obj(scene: &Scene) -> (String, Scene) {
    let mut text = String::new();
    let mut flat = Scene { materials: vec![Material::default()], ..scene.clone() };
    for object in &mut flat.objects {
        let Solid::Primitive(primitive) = &mut object.solid else { panic!("a face is one primitive") };
        let corners: Arc<[DVec3]> = match &primitive.shape {
            Shape::Face(corners) => Arc::clone(corners),
            Shape::Patch(corners) => corners.iter().map(|corner| corner.place).collect(),
            other => panic!("a face is no {other:?}"),
        };
        for corner in &*corners {
            text += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
        }
        let numbers: Vec<String> = (1..=corners.len()).rev().map(|back| format!("-{back}")).collect();
        text += &format!("f {}\n", numbers.join(" "));
        (primitive.shape, primitive.material) = (Shape::Face(corners), MaterialId(0));
    }
    (text, flat)
}

#[test]
fn faces_are_seen_alike_as_obj() {
    for name in ["teapot", "gears"] {
        let Some(studio) = studio(name) else { return };
        let (text, flat) = as_obj(studio.scene());
        let options = ReadOptions { up: Some(UpAxis::Z), ..ReadOptions::default() };
        let mesh = read("faces.obj", text.as_bytes(), &options).unwrap();
        let mesh = Scene { objects: mesh.objects, ..flat.clone() };
        let request = request(studio.camera(0, 1.0), Size::new(160, 160));
        let [mesh, flat] = [mesh, flat].map(|scene| Studio::new(scene).unwrap().draw(&request));
        assert!(flat.counts.primary_hits > 10_000, "{name}: {}", flat.counts.primary_hits);
        let comparison = mesh.compare(&flat).unwrap();
        assert_eq!(mesh.levels(Tone::default()), flat.levels(Tone::default()), "{name}: {comparison}");
    }
}

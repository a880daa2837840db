//! The stages of a picture, from text to characters. `cargo bench --bench stages`.

#[expect(dead_code, reason = "not every scene that can be written is measured")]
mod scenery;
mod setting;

use std::fs;
use std::hint::black_box;
use std::path::Path;

use criterion::{BatchSize, BenchmarkId, Criterion};
use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette, compose};
use ray13::lattice::{Lattice, SubLattices, Tree};
use ray13::math::Size;
use ray13::plan::{Options, Shading};
use ray13::scene::{Format, Scene, embedded};
use ray13::solid::Assembly;
use ray13::tone::Tone;
use scenery::Shape;

/// A large terminal of 200 × 45 cells.
const DOTS: Size = Size::new(400, 180);

/// The scene of which light and characters are made, and composite objects.
const SCENE: &str = "hanyang";

/// Objects of the scenes that are read and cut.
const OBJECTS: u64 = 10_000;

/// The Standard Procedural Databases, where they stand beside the repository.
const SPD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/scenes/spd");

fn main() {
    let mut criterion = setting::criterion();
    reading(&mut criterion);
    assembling(&mut criterion);
    cutting(&mut criterion);
    drawing(&mut criterion);
    lighting(&mut criterion);
    composing(&mut criterion);
    criterion.final_summary();
}

fn inside(name: &str) -> Scene {
    let scene = embedded().iter().find(|scene| scene.name == name);
    setting::scene(name, scene.map_or("", |scene| scene.text), Format::Language)
}

/// Scenes of NFF with their names: spheres, and open cylinders.
fn spread() -> [(&'static str, String); 2] {
    [("spheres", Shape::Spheres), ("cylinders", Shape::Cylinders)]
        .map(|(name, shape)| (name, setting::spread(OBJECTS, shape)))
}

fn reading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read");
    for scene in embedded() {
        group.bench_function(scene.name, |bencher| {
            bencher.iter(|| setting::scene(scene.name, black_box(scene.text), Format::Language));
        });
    }
    for (name, text) in spread() {
        group.bench_function(BenchmarkId::new(name, OBJECTS), |bencher| {
            bencher.iter(|| setting::scene(name, black_box(&text), Format::Nff));
        });
    }
    group.finish();
}

fn assembling(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("assemble");
    let solids = inside(SCENE);
    group.bench_function(SCENE, |bencher| bencher.iter(|| Assembly::new(black_box(&solids))));
    for (name, text) in spread() {
        let scene = setting::scene(name, &text, Format::Nff);
        group.bench_function(BenchmarkId::new(name, OBJECTS), |bencher| {
            bencher.iter(|| Assembly::new(black_box(&scene)));
        });
    }
    group.finish();
}

fn cutting(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("cut");
    let assembly = setting::assembled(&inside(SCENE));
    group.bench_function(BenchmarkId::new("lattice", SCENE), |bencher| {
        bencher.iter(|| Lattice::new(black_box(&assembly)));
    });
    group.bench_function(BenchmarkId::new("sub-lattices", SCENE), |bencher| {
        bencher.iter(|| SubLattices::new(black_box(&assembly)));
    });
    for (name, text) in spread() {
        let assembly = setting::assembled(&setting::scene(name, &text, Format::Nff));
        group.bench_function(BenchmarkId::new("tree", format!("{OBJECTS} {name}")), |bencher| {
            bencher.iter(|| Tree::new(black_box(&assembly)));
        });
    }
    group.finish();
}

fn drawing(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    let mut drawn = |name: &str, scene: Scene| {
        let studio = Studio::new(scene).unwrap_or_else(|e| panic!("{e}"));
        let request = request(&studio);
        group.bench_function(name, |bencher| bencher.iter(|| studio.draw_anew(black_box(&request))));
    };
    for scene in embedded() {
        drawn(scene.name, inside(scene.name));
    }
    if let Some(balls) = balls() {
        drawn("spd balls", balls);
    }
    group.finish();
}

fn balls() -> Option<Scene> {
    let balls = Path::new(SPD).join("balls.nff");
    let text = fs::read_to_string(&balls);
    let text =
        text.inspect_err(|error| eprintln!("spd balls is skipped: {}: {error}", balls.display())).ok()?;
    Some(setting::scene("balls.nff", &text, Format::Nff))
}

/// Another light from the same view, with all rays traced anew and with what those from the eye met taken
/// over; and another light in the same solids.
fn lighting(criterion: &mut Criterion) {
    let one_thread = Options { threads: 1, ..Options::default() };
    let lights = [
        ("eq. (1), no shadows", Options { shading: Shading::Lambert, shadows: false, ..one_thread }),
        ("eq. (1)", Options { shading: Shading::Lambert, ..one_thread }),
        ("eq. (4)", one_thread),
    ];
    let mut group = criterion.benchmark_group("light");
    let scenes = embedded().iter().map(|scene| (scene.name, inside(scene.name)));
    for (name, scene) in scenes.chain(balls().map(|balls| ("spd balls", balls))) {
        let studio = Studio::new(scene).unwrap_or_else(|e| panic!("{e}"));
        let plain = Request { wants: Wants::LIGHT, ..request(&studio) };
        // None of those that are measured.
        let before =
            Request { options: Options { shading: Shading::Phong, ..plain.options }, ..plain.clone() };
        for (light, options) in lights {
            let request = Request { options, ..plain.clone() };
            group.bench_function(format!("{name}/{light}/anew"), |bencher| {
                bencher.iter(|| studio.draw_anew(black_box(&request)));
            });
            group.bench_function(format!("{name}/{light}/hits taken over"), |bencher| {
                let again = || drop(studio.draw(&before));
                bencher.iter_batched(again, |()| studio.draw(&request), BatchSize::PerIteration);
            });
        }
    }
    let [(name, text), _] = spread();
    let scene = setting::scene(name, &text, Format::Nff);
    let mut studio = Studio::new(scene.clone()).unwrap_or_else(|e| panic!("{e}"));
    group.bench_function(BenchmarkId::new("set_scene", format!("{OBJECTS} {name}")), |bencher| {
        bencher.iter_batched(|| scene.clone(), |scene| studio.set_scene(scene), BatchSize::PerIteration);
    });
    group.finish();
}

fn composing(criterion: &mut Criterion) {
    let studio = Studio::new(inside(SCENE)).unwrap_or_else(|e| panic!("{e}"));
    let light = studio.draw(&request(&studio)).light;
    let mut group = criterion.benchmark_group("compose");
    for mode in GlyphMode::ALL {
        group.bench_function(mode.name(), |bencher| {
            bencher.iter(|| compose(black_box(&light), mode, Palette::DOS, Tone::Lightness));
        });
    }
    group.finish();
}

fn request(studio: &Studio) -> Request {
    Request {
        camera: studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height)),
        dots: DOTS,
        dot_aspect: 1.0,
        wants: Wants::CELLS,
        options: Options::default(),
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    }
}

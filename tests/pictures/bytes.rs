//! How many bytes a moving picture takes: a contract (`docs/terminals.md`).

use ray13::frame::{Request, Studio};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::{DVec3, Size};
use ray13::output::Encoder;
use ray13::scene::Camera;

use crate::support::request::request;
use crate::support::scenery::embedded_scenes;

/// What is sent for one set of characters.
struct Sent {
    /// For the first picture, on a cleared screen.
    first: usize,
    /// For one of the others: as many take more as take less.
    median: usize,
}

/// The camera carried round its target, about what is up.
fn turned(camera: &Camera, degrees: f64) -> Camera {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let axis = camera.up.normalize_or(DVec3::Z);
    let sight = camera.eye - camera.target;
    let sight = sight * cos + axis.cross(sight) * sin + axis * axis.dot(sight) * (1.0 - cos);
    Camera { eye: camera.target + sight, ..camera.clone() }
}

/// Sixty pictures round the scene, `step` degrees apart, after a first.
fn orbit(glyphs: GlyphMode, cells: Size, step: f64) -> Sent {
    let (_, scene) = embedded_scenes().into_iter().find(|(name, _)| *name == "hanyang").unwrap();
    let studio = Studio::new(scene).unwrap();
    let per_cell = glyphs.dots_per_cell();
    let dots = Size::new(cells.width * per_cell.width, cells.height * per_cell.height);
    let aspect = f64::from(cells.width) / (2.0 * f64::from(cells.height));
    let camera = studio.camera(0, aspect);
    let picture = |k: u32| {
        let camera = turned(&camera, step * f64::from(k));
        let dot_aspect = glyphs.dot_aspect(0.5);
        studio
            .draw(&Request { glyphs, palette: Palette::DOS, dot_aspect, ..request(camera, dots) })
            .cells
            .unwrap()
    };
    let mut encoder = Encoder::default();
    let mut shown = picture(0);
    encoder.draw(&*shown);
    let first = encoder.take().len();
    let mut sent: Vec<usize> = (1..=60)
        .map(|k| {
            let next = picture(k);
            encoder.turn(&*shown, &*next);
            shown = next;
            encoder.take().len()
        })
        .collect();
    sent.sort_unstable();
    Sent { first, median: sent[sent.len() / 2] }
}

const LARGE: Size = Size::new(120, 40);
const SMALL: Size = Size::new(80, 24);

#[test]
fn an_orbit_in_shades_stays_within_its_bytes() {
    for (cells, first, median) in [(LARGE, 12_000, 4_400), (SMALL, 5_300, 2_000)] {
        let sent = orbit(GlyphMode::Shade, cells, 2.0);
        eprintln!("shade {cells:?}: {} first, {} a frame", sent.first, sent.median);
        assert!(sent.first <= first && sent.median <= median, "{cells:?}: {} {}", sent.first, sent.median);
    }
}

#[test]
fn an_orbit_in_blocks_stays_within_its_bytes() {
    for (cells, first, median) in [(LARGE, 12_500, 6_400), (SMALL, 5_600, 3_200)] {
        let sent = orbit(GlyphMode::Blocks, cells, 5.0);
        eprintln!("blocks {cells:?}: {} first, {} a frame", sent.first, sent.median);
        assert!(sent.first <= first && sent.median <= median, "{cells:?}: {} {}", sent.first, sent.median);
    }
}

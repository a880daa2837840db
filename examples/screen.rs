//! Writes a PNG of how a terminal of 16 colours shows a scene, 8 × 16 pixels to a cell, its shades as even grays:
//! `cargo run --release --example screen -- hanyang docs/pictures/hanyang.png`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette, appearance};
use ray13::math::Size;
use ray13::output::{self, Pixels};
use ray13::plan::Options;
use ray13::scene::{self, ReadOptions, embedded};
use ray13::tone::Tone;

/// The screen, in cells.
const SCREEN: Size = Size::new(100, 30);
/// Pixels of a cell, as VGA drew text.
const PIXELS: Size = Size::new(8, 16);

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(name), Some(path)) = (arguments.next(), arguments.next()) else {
        return Err("expected a scene, embedded or a file, and a file to write".into());
    };
    let options = ReadOptions::default();
    let scene = match embedded().iter().find(|scene| scene.name == name) {
        Some(inside) => scene::read(inside.name, inside.text.as_bytes(), &options)?,
        None => scene::read_file(Path::new(&name), &options)?,
    };
    let studio = Studio::new(scene)?;

    let glyphs = GlyphMode::Blocks;
    let per_cell = glyphs.dots_per_cell();
    let cell_aspect = f64::from(PIXELS.width) / f64::from(PIXELS.height);
    let frame = studio.draw(&Request {
        camera: studio.camera(0, cell_aspect * f64::from(SCREEN.width) / f64::from(SCREEN.height)),
        dots: Size::new(SCREEN.width * per_cell.width, SCREEN.height * per_cell.height),
        dot_aspect: glyphs.dot_aspect(cell_aspect),
        options: Options { samples: 2, ..Options::default() },
        wants: Wants::CELLS,
        glyphs,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    });
    let cells = frame.cells.ok_or("a frame has the characters that it was asked for")?;
    let screen = appearance(&cells, Palette::DOS, PIXELS).map(|&light| Tone::Lightness.level(light).srgb());
    output::png(&Pixels::Gray(screen), &mut BufWriter::new(File::create(path)?))?;
    Ok(())
}

//! Writes a PNG of what a terminal of 16 colours shows of a scene, pixel by pixel as a VGA card drew text, 8
//! × 16 pixels to a cell; and, if a second file is named, one of the levels that it is made of:
//!
//! ```sh
//! cd docs/pictures
//! cargo run --release --example screen -- hanyang hanyang.png hanyang-levels.png
//! ```

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{Cell, Coverage, GlyphMode, Palette, coverage};
use ray13::math::{Grid, Size};
use ray13::output::{self, Pixels};
use ray13::plan::Options;
use ray13::scene::{self, ReadOptions, embedded};
use ray13::tone::{Tone, srgb_of_light};

/// The screen, in cells.
const SCREEN: Size = Size::new(100, 30);
/// Pixels of a cell, as VGA drew text.
const PIXELS: Size = Size::new(8, 16);
/// The shades of the VGA card's font by quarters of ink: two rows of pixels each, over and over, the left
/// pixel in the highest bit.
const SHADES: [[u8; 2]; 5] = [[0, 0], [0x11, 0x44], [0x55, 0xAA], [0xDD, 0x77], [0xFF, 0xFF]];
const PALETTE: Palette = Palette::DOS;

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
        palette: PALETTE,
        tone: Tone::Lightness,
    });
    let cells = frame.cells.ok_or("a frame has the characters that it was asked for")?;
    let pixels = Size::new(SCREEN.width * PIXELS.width, SCREEN.height * PIXELS.height);
    write(&path, Grid::from_fn(pixels, |x, y| pixel(cells[(x / PIXELS.width, y / PIXELS.height)], x, y)))?;
    if let Some(path) = arguments.next() {
        let dot = Size::new(PIXELS.width / per_cell.width, PIXELS.height / per_cell.height);
        let level = |x: u32, y: u32| Tone::Lightness.level(frame.light[(x / dot.width, y / dot.height)]);
        write(&path, Grid::from_fn(pixels, |x, y| level(x, y).srgb()))?;
    }
    Ok(())
}

/// The gray of a pixel of the screen, in or beside the strokes of its cell's character.
fn pixel(cell: Cell, x: u32, y: u32) -> u8 {
    let (x, y) = (x % PIXELS.width, y % PIXELS.height);
    let inked = match coverage(cell.glyph) {
        Some(Coverage::Even(share)) => {
            SHADES[(share * 4.0) as usize][y as usize % 2] >> (PIXELS.width - 1 - x) & 1 == 1
        }
        Some(Coverage::Dots(mask)) => mask >> (y * 4 / PIXELS.height * 2 + x * 2 / PIXELS.width) & 1 == 1,
        _ => false,
    };
    srgb_of_light(if inked { PALETTE.ink_light(cell) } else { PALETTE.paper_light(cell) })
}

fn write(path: &str, pixels: Grid<u8>) -> Result<(), Box<dyn Error>> {
    output::png(&Pixels::Gray(pixels), &mut BufWriter::new(File::create(path)?))?;
    Ok(())
}

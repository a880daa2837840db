//! How near plans come: what each picture was expected to take beside the least that it took, on one thread.
//!
//! ```sh
//! cargo run --release --example plans                  # the scenes inside the program
//! cargo run --release --example plans -- FILE…
//! ```

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::Options;
use ray13::scene::{self, ReadOptions, Scene};
use ray13::stage::Stage;
use ray13::tone::Tone;

/// Pictures are drawn until both are reached.
const PICTURES: usize = 5;
const LONG_ENOUGH: Duration = Duration::from_millis(400);

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let options = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
    println!("| scene | dots | plan takes | expected | least | times |");
    println!("|---|---|---|---|---|---|");
    if files.is_empty() {
        for inside in scene::embedded() {
            compare(inside.name, scene::read(inside.name, inside.text.as_bytes(), &options)?)?;
        }
    }
    for file in files {
        let path = Path::new(&file);
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        compare(&name, scene::read_file(path, &options)?)?;
    }
    Ok(())
}

/// Two rows: the characters of a terminal of 80 × 25, and the dots of one of 200 × 45.
fn compare(name: &str, scene: Scene) -> Result<(), Box<dyn Error>> {
    let studio = Studio::new(scene)?;
    for (dots, wants) in [(Size::new(160, 100), Wants::CELLS), (Size::new(400, 180), Wants::LIGHT)] {
        let request = Request {
            camera: studio.camera(0, f64::from(dots.width) / f64::from(dots.height)),
            dots,
            dot_aspect: 1.0,
            options: Options { threads: 1, ..Options::default() },
            wants,
            glyphs: GlyphMode::Blocks,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        };
        // What is built is built before any picture, and not part of its time.
        let planning = Instant::now();
        let stages = studio.explain(&request);
        let planned = planning.elapsed().saturating_sub(studio.built().cutting);
        let costs = stages.iter().filter(|s| s.stage != Stage::Lattice).filter_map(|s| s.cost);
        let expected: f64 = costs.map(|cost| cost.ms(1)).sum();
        let mut least = f64::INFINITY;
        let start = Instant::now();
        let mut pictures = 0;
        while pictures < PICTURES || start.elapsed() < LONG_ENOUGH {
            least = least.min(studio.draw_anew(&request).total.as_secs_f64() * 1e3);
            pictures += 1;
        }
        let Size { width, height } = dots;
        let planned = planned.as_secs_f64() * 1e3;
        println!(
            "| {name} | {width} × {height} | {planned:.1} ms | {expected:.2} ms | {least:.2} ms | {:.2} |",
            expected / least
        );
    }
    Ok(())
}

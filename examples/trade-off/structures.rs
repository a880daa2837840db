//! What a structure costs and saves, from one object to a million: each measured in a process of its own, so
//! that its memory is its own.

use std::error::Error;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::{EngineChoice, Options, Shading, StructureChoice};
use ray13::scene::{ReadOptions, read_file};
use ray13::tone::Tone;
use ray13::trade::peak_memory;

use super::scenery::{Scenery, Shape, Spread};

/// The word that has another process measure.
pub const MEASURE: &str = "--measure";

/// Few enough for every ray against a hundred thousand objects.
const DOTS: Size = Size::new(64, 36);

/// Pictures of which the fastest counts, as long as they are not slow.
const PICTURES: usize = 9;
const SLOW: Duration = Duration::from_millis(300);

const STRUCTURES: [StructureChoice; 4] =
    [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree, StructureChoice::Boxes];

const OBJECTS: [u64; 12] = [1, 2, 3, 5, 10, 20, 50, 100, 1_000, 10_000, 100_000, 1_000_000];

/// Every ray against more objects takes minutes.
const MOST_FOR_NONE: u64 = 100_000;

/// What was measured of one structure.
#[derive(Clone, Copy)]
struct Cut {
    build: f64,
    bytes: f64,
    /// Nanoseconds of a ray.
    ray: f64,
}

pub fn table() -> Result<String, Box<dyn Error>> {
    let mut table = "| objects | none, ray | lattice: build | memory | ray | tree: build | memory | ray \
        | boxes: build | memory | ray |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    // Of each two the first number of objects since which the one wins always.
    let mut wins_from = [[None; 4]; 4];
    for objects in OBJECTS {
        eprintln!("  {objects} spheres");
        let cuts = cuts(objects)?;
        write!(table, "| {objects} | {} |", cuts[0].map_or("–".to_owned(), |cut| nanoseconds(cut.ray)))?;
        for cut in &cuts[1..] {
            match cut {
                Some(cut) => write!(
                    table,
                    " {} | {} | {} |",
                    nanoseconds(cut.build * 1e9),
                    memory(cut.bytes - cuts[0].map_or(cut.bytes, |none| none.bytes)),
                    nanoseconds(cut.ray)
                )?,
                None => table.push_str(" – | – | – |"),
            }
        }
        table.push('\n');
        for own in 0..4 {
            for other in 0..4 {
                if let Some((one, two)) = cuts[own].zip(cuts[other]).filter(|(_, two)| !two.ray.is_nan()) {
                    let wins = one.ray < 0.95 * two.ray;
                    let from = wins_from[own][other].unwrap_or(objects);
                    wins_from[own][other] = wins.then_some(from);
                }
            }
        }
    }
    table.push_str("\nA ray is faster, by a twentieth or more, from so many objects on:\n\n| | than none | than the lattice | than the tree |\n|---|---|---|---|\n");
    for own in 1..4 {
        let cell = |other: usize| wins_from[own][other].map_or("–".to_owned(), |n: u64| n.to_string());
        let name = STRUCTURES[own].name();
        writeln!(table, "| {name} | {} | {} | {} |", cell(0), cell(1), cell(2))?;
    }
    Ok(table)
}

/// What each structure does with a scene; nothing where it can not be had, or takes too long.
fn cuts(objects: u64) -> Result<[Option<Cut>; 4], Box<dyn Error>> {
    let file = std::env::temp_dir().join(format!("ray13-trade-{}.nff", std::process::id()));
    let mut out = BufWriter::new(File::create(&file)?);
    Scenery { objects, shape: Shape::Spheres, spread: Spread::Even, seed: 1 }.write(&mut out)?;
    out.flush()?;
    let mut cuts = [None; 4];
    for (cut, structure) in cuts.iter_mut().zip(STRUCTURES) {
        let measured = Command::new(std::env::current_exe()?)
            .args([MEASURE])
            .arg(&file)
            .arg(structure.name())
            .output()?;
        if !measured.status.success() {
            return Err(String::from_utf8_lossy(&measured.stderr).into());
        }
        let text = String::from_utf8(measured.stdout)?;
        let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        if let [build, bytes, ray] = numbers[..] {
            *cut = Some(Cut { build, bytes, ray });
        }
    }
    fs::remove_file(&file)?;
    Ok(cuts)
}

/// Measures one structure and prints seconds of building, bytes of memory and nanoseconds of a ray, which is
/// not known where that takes minutes; nothing where its lattice would be too large.
pub fn measure(file: &str, structure: &str) -> Result<(), Box<dyn Error>> {
    let structure =
        STRUCTURES.into_iter().find(|choice| choice.name() == structure).ok_or("no such structure")?;
    let studio = Studio::new(read_file(Path::new(file), &ReadOptions::default())?)?;
    // Rays from the eye alone, one after the other, as the structures are meant for.
    let options = Options {
        structure,
        engine: EngineChoice::Exact,
        shading: Shading::Phong,
        shadows: false,
        threads: 1,
        ..Options::default()
    };
    let request = Request {
        camera: studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height)),
        dots: DOTS,
        dot_aspect: 1.0,
        options,
        wants: Wants::LIGHT,
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    };
    if structure == StructureChoice::None && studio.scene().objects.len() as u64 > MOST_FOR_NONE {
        println!("0 {} NaN", peak_memory().ok_or("no /proc")?);
        return Ok(());
    }
    let first = studio.draw_anew(&request);
    if first.over_budget.is_some() {
        return Ok(());
    }
    let again = if first.trace > SLOW { 0 } else { PICTURES };
    let others = (0..again).map(|_| studio.draw_anew(&request).trace);
    let least = others.chain([first.trace]).min().unwrap_or_default();
    let ray = least.as_secs_f64() * 1e9 / DOTS.area() as f64;
    println!("{} {} {ray}", studio.built().cutting.as_secs_f64(), peak_memory().ok_or("no /proc")?);
    Ok(())
}

/// A time of nanoseconds to two or three digits; – where it is not known.
fn nanoseconds(time: f64) -> String {
    match time {
        _ if time.is_nan() => "–".to_owned(),
        _ if time < 1e3 => format!("{time:.0} ns"),
        _ if time < 1e5 => format!("{:.1} µs", time / 1e3),
        _ if time < 1e6 => format!("{:.0} µs", time / 1e3),
        _ if time < 1e8 => format!("{:.1} ms", time / 1e6),
        _ if time < 1e9 => format!("{:.0} ms", time / 1e6),
        _ => format!("{:.1} s", time / 1e9),
    }
}

/// Memory; less than the process takes by chance is not told.
fn memory(bytes: f64) -> String {
    match bytes {
        _ if bytes < 1e6 => "< 1 MB".to_owned(),
        _ if bytes < 1e7 => format!("{:.1} MB", bytes / 1e6),
        _ => format!("{:.0} MB", bytes / 1e6),
    }
}

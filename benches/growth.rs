//! Measures how the cost of a picture grows, and prints the tables of `docs/performance.md`:
//! `cargo run --release --example growth`, or with the most objects there shall be:
//! `… --example growth -- 100000`.

mod scenery;
mod spread;

use std::error::Error;
use std::fmt::Write;
use std::time::Duration;

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::{DVec3, Size};
use ray13::plan::Options;
use ray13::scene::{Anchor, Format, Light, ReadOptions, Scene, embedded, read};
use ray13::tone::Tone;
use scenery::{Scenery, Shape, Spread};

/// A large terminal of 200 × 45 cells.
const DOTS: Size = Size::new(400, 180);

/// Pictures of which the fastest counts: the others met with something else on the machine.
const PICTURES: usize = 5;

/// The most objects where nothing else is asked for.
const MOST: u64 = 1_000_000;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let most = match &arguments[..] {
        [] => MOST,
        [file] if !file.starts_with(|c: char| c.is_ascii_digit()) => return spread::measure(file),
        [most] => most.parse()?,
        _ => return Err("expected one number at most: that of objects".into()),
    };
    println!("{}", objects(most)?);
    println!("{}", primitives()?);
    println!("{}", dots()?);
    println!("{}", lights()?);
    println!("{}", generations()?);
    Ok(())
}

fn objects(most: u64) -> Result<String, Box<dyn Error>> {
    let mut table = "| objects | read | assemble | cut | a picture | memory, bytes per object |\n\
        |---|---|---|---|---|---|\n"
        .to_owned();
    let mut put = |name: &str, scenery: Scenery| -> Result<(), Box<dyn Error>> {
        writeln!(table, "| {name} | {} |", spread::measured(&scenery)?)?;
        Ok(())
    };
    let spheres = Scenery { objects: 100, shape: Shape::Spheres, spread: Spread::Even, seed: 1 };
    for objects in std::iter::successors(Some(100), |n| Some(10 * n)).take_while(|&n| n < most) {
        put(&format!("{objects} spheres"), Scenery { objects, ..spheres })?;
    }
    for (shape, name) in
        [(Shape::Spheres, "spheres"), (Shape::Cylinders, "cylinders"), (Shape::Mixed, "of both and cones")]
    {
        for (spread, place) in [(Spread::Even, ""), (Spread::Clustered, ", in clusters")] {
            put(&format!("{most} {name}{place}"), Scenery { objects: most, shape, spread, ..spheres })?;
        }
    }
    Ok(table)
}

/// A block with balls taken out of it.
fn primitives() -> Result<String, Box<dyn Error>> {
    let mut table = "| primitives of one object | a picture |\n|---|---|\n".to_owned();
    for primitives in (0..=8).map(|power| 1_u32 << power) {
        let mut text = "difference() { cube(2, center = true);".to_owned();
        for ball in 1..primitives {
            // Steps without a common factor with the number of places: the balls stand apart, on the block's
            // surface too.
            let place = |step: u32| f64::from(ball * step % 257) / 128.0 - 1.0;
            let [x, y, z] = [place(31), place(89), place(200)];
            write!(text, "translate([{x}, {y}, {z}]) sphere(0.2);")?;
        }
        text.push('}');
        let options = ReadOptions { format: Some(Format::Language), ..ReadOptions::default() };
        let scene = read("block", text.as_bytes(), &options)?;
        writeln!(table, "| {primitives} | {} |", ms(picture(scene, DOTS, Options::default())?))?;
    }
    Ok(table)
}

fn dots() -> Result<String, Box<dyn Error>> {
    let mut table = "| dots | a picture of `hanyang` |\n|---|---|\n".to_owned();
    for size in [DOTS.width / 4, DOTS.width / 2, DOTS.width, 2 * DOTS.width, 4 * DOTS.width] {
        let dots = Size::new(size, size * DOTS.height / DOTS.width);
        let time = picture(inside("hanyang")?, dots, Options::default())?;
        writeln!(table, "| {} × {} | {} |", dots.width, dots.height, ms(time))?;
    }
    Ok(table)
}

fn lights() -> Result<String, Box<dyn Error>> {
    let mut table = "| lights | a picture of 1000 spheres |\n|---|---|\n".to_owned();
    let mut text = Vec::new();
    Scenery { objects: 1000, shape: Shape::Spheres, spread: Spread::Even, seed: 1 }.write(&mut text)?;
    for lights in [0_u32, 1, 2, 4, 8, 16] {
        let mut scene = read("spheres.nff", &text, &ReadOptions::default())?;
        scene.lights = (0..lights)
            .map(|light| {
                // A ring above the cube of the spheres.
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(light) / f64::from(lights));
                let anchor = Anchor::World(DVec3::new(400.0 * cos, 400.0 * sin, 300.0));
                Light { anchor, intensity: 1.0 / f64::from(lights), color: DVec3::ONE }
            })
            .collect();
        // A scene without lights would get some: without shadows, light costs next to nothing.
        let options = Options { shadows: lights > 0, ..Options::default() };
        let name = if lights > 0 { lights.to_string() } else { "without shadows".to_owned() };
        writeln!(table, "| {name} | {} |", ms(picture(scene, DOTS, options)?))?;
    }
    Ok(table)
}

fn generations() -> Result<String, Box<dyn Error>> {
    let mut table = "| generations of mirror rays | a picture of `mirrors` |\n|---|---|\n".to_owned();
    for depth in [0, 1, 2, 3, 4, 5, 10, 20] {
        // Every ray that may be sent is sent, however little it changes.
        let options = Options { depth, cutoff: 0.0, ..Options::default() };
        writeln!(table, "| {depth} | {} |", ms(picture(inside("mirrors")?, DOTS, options)?))?;
    }
    Ok(table)
}

fn inside(name: &str) -> Result<Scene, Box<dyn Error>> {
    let scene = embedded().iter().find(|scene| scene.name == name).ok_or("no such scene")?;
    Ok(read(scene.name, scene.text.as_bytes(), &ReadOptions::default())?)
}

fn picture(scene: Scene, dots: Size, options: Options) -> Result<Duration, Box<dyn Error>> {
    Ok(fastest(&Studio::new(scene)?, dots, options))
}

/// The time of the fastest of a few pictures after the first, which builds what the others find.
fn fastest(studio: &Studio, dots: Size, options: Options) -> Duration {
    let request = Request {
        camera: studio.camera(0, f64::from(dots.width) / f64::from(dots.height)),
        dots,
        dot_aspect: 1.0,
        wants: Wants::LIGHT,
        options,
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    };
    studio.draw(&request);
    (0..PICTURES).map(|_| studio.draw_anew(&request).total).min().unwrap_or_default()
}

fn ms(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    // Three digits say more than the clock knows.
    match ms {
        _ if ms < 10.0 => format!("{ms:.2} ms"),
        _ if ms < 100.0 => format!("{ms:.1} ms"),
        _ => format!("{ms:.0} ms"),
    }
}

//! Measures what anti-aliasing costs and brings, and prints the table of `docs/performance.md`:
//! `cargo run --release --example antialiasing`, or of other scenes:
//! `… --example antialiasing -- glass ../shared/scenes/spd/balls.nff`.

use std::error::Error;
use std::time::{Duration, Instant};

use ray13::frame::{Frame, Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::Options;
use ray13::scene::{ReadOptions, embedded, read};
use ray13::tone::Tone;

/// The dots of the table in the mission's own terms: 320 × 200.
const DOTS: Size = Size::new(320, 200);

/// The rays of a dot of the reference: none of those that are measured.
const REFERENCE: std::ops::Range<u32> = 1024..1536;

/// Pictures of which the fastest counts: the others met with something else on the machine.
const PICTURES: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut scenes: Vec<(String, Vec<u8>)> = Vec::new();
    for scene in embedded() {
        if arguments.is_empty() || arguments.iter().any(|name| name == scene.name) {
            scenes.push((scene.name.to_owned(), scene.text.as_bytes().to_vec()));
        }
    }
    for file in arguments.iter().filter(|name| embedded().iter().all(|scene| scene.name != **name)) {
        scenes.push((file.rsplit('/').next().unwrap_or(file).to_owned(), std::fs::read(file)?));
    }
    println!(
        "| scene | rays a dot | wrong levels, % | by two or more, % | time, ms | share of 16 | share of 64 |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (name, text) in scenes {
        let options = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
        let studio = Studio::new(read(&name, &text, &options)?)?;
        measure(&name, &studio);
    }
    Ok(())
}

fn measure(name: &str, studio: &Studio) {
    let plain = Request {
        camera: studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height)),
        dots: DOTS,
        dot_aspect: 1.0,
        options: Options { threads: 1, ..Options::default() },
        wants: Wants::LIGHT,
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    };
    let threads = Options { threads: 0, ..plain.options };
    let reference = studio.draw_samples(&Request { options: threads, ..plain.clone() }, REFERENCE);
    let with = |options: Options| Request { options, ..plain.clone() };
    let fixed = |samples| with(Options { samples, ..plain.options });
    let adaptive = |error| with(Options { adaptive: Some(error), ..plain.options });
    let mut of = [Duration::ZERO; 2];
    for (what, request) in [
        ("1", fixed(1)),
        ("4", fixed(2)),
        ("16", fixed(4)),
        ("64", fixed(8)),
        ("adaptive 1/2", adaptive(0.5)),
        ("adaptive 1/4", adaptive(0.25)),
        ("adaptive 1/8", adaptive(0.125)),
        ("adaptive 1/16", adaptive(0.0625)),
    ] {
        let mut least = Duration::MAX;
        let mut frame = None;
        for _ in 0..PICTURES {
            let start = Instant::now();
            frame = Some(studio.draw_anew(&request));
            least = least.min(start.elapsed());
        }
        let frame = frame.expect("at least one picture");
        let (wrong, far) = wrong_levels(&frame, &reference);
        match what {
            "16" => of[0] = least,
            "64" => of[1] = least,
            _ => {}
        }
        let rays = frame.counts.primary_rays as f64 / DOTS.area() as f64;
        let share = |of: Duration| {
            if of.is_zero() {
                String::new()
            } else {
                format!("{:.0} %", 100.0 * least.as_secs_f64() / of.as_secs_f64())
            }
        };
        println!(
            "| {name} | {what} ({rays:.2}) | {wrong:.2} | {far:.3} | {:.1} | {} | {} |",
            least.as_secs_f64() * 1e3,
            share(of[0]),
            share(of[1]),
        );
    }
}

/// The share of dots whose level is wrong, and of those that are off by two levels at least, in percent.
fn wrong_levels(frame: &Frame, reference: &Frame) -> (f64, f64) {
    let [own, other] = [frame, reference].map(|frame| frame.levels(Tone::Lightness));
    let off: Vec<u8> =
        own.values().iter().zip(other.values()).map(|(a, b)| a.get().abs_diff(b.get())).collect();
    let share = |least: u8| 100.0 * off.iter().filter(|&&off| off >= least).count() as f64 / off.len() as f64;
    (share(1), share(2))
}

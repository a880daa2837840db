//! Rays by need beside fixed rays that leave as many levels wrong.

use std::time::{Duration, Instant};

use ray13::frame::{Frame, Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::Options;
use ray13::tone::{Level, Tone};

use super::picture::wrong_levels;

/// The dots of the table in the mission's own terms: 320 × 200.
const DOTS: Size = Size::new(320, 200);

/// The rays of a dot of the reference: none of those that are measured.
const REFERENCE: std::ops::Range<u32> = 1024..2048;

/// Pictures of each kind, in turn, of which the middle one counts.
const PICTURES: usize = 5;

/// Errors that are tried, in halves: from a level down to a 128th of one.
const HALVINGS: std::ops::RangeInclusive<i32> = 0..=7;

pub fn measure(name: &str, studio: &Studio) {
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
    let with = |options: Options| Request { options, ..plain.clone() };
    let all_threads = with(Options { threads: 0, ..plain.options });
    let reference = levels(&studio.draw_samples(&all_threads, REFERENCE));
    let wrong = |frame: &Frame| wrong_levels(&levels(frame), &reference);
    let adaptive = |error| with(Options { adaptive: Some(error), ..plain.options });
    for samples in [1, 4, 8] {
        let fixed = with(Options { samples, ..plain.options });
        let bound = wrong(&studio.draw_anew(&fixed));
        let rays = samples * samples;
        if rays == 1 {
            let [time] = times([&fixed], studio);
            println!("| {name} | {rays} | {:.2} % | {} | | | | |", 100.0 * bound, written(time));
            continue;
        }
        // The largest error of which a quarter of its next leaves as few wrong: halves, and then fifths of
        // one.
        let found = HALVINGS
            .map(|halving| libm::exp2(-f64::from(halving)))
            .find(|&error| wrong(&studio.draw_anew(&adaptive(error))) <= bound);
        let Some(half) = found else {
            println!("| {name} | {rays} | {:.2} % | | none | | | |", 100.0 * bound);
            continue;
        };
        let between = [1.74, 1.52, 1.32, 1.15].map(|factor| half * factor);
        let found = between.into_iter().find(|&error| wrong(&studio.draw_anew(&adaptive(error))) <= bound);
        let request = adaptive(found.unwrap_or(half));
        let frame = studio.draw_anew(&request);
        let [of_fixed, own] = times([&fixed, &request], studio);
        println!(
            "| {name} | {rays} | {:.2} % | {} | {:.4} ({:.2} %) | {:.2} | {} | {:.0} % |",
            100.0 * bound,
            written(of_fixed),
            found.unwrap_or(half),
            100.0 * wrong(&frame),
            frame.counts.primary_rays as f64 / DOTS.area() as f64,
            written(own),
            100.0 * own.as_secs_f64() / of_fixed.as_secs_f64()
        );
    }
}

fn levels(frame: &Frame) -> Vec<Level> {
    frame.levels(Tone::Lightness).values().to_vec()
}

/// The middle time of each, the pictures being drawn in turn.
fn times<const N: usize>(requests: [&Request; N], studio: &Studio) -> [Duration; N] {
    let mut all = [(); N].map(|()| Vec::new());
    for _ in 0..PICTURES {
        for (request, times) in requests.iter().zip(&mut all) {
            let begin = Instant::now();
            studio.draw_anew(request);
            times.push(begin.elapsed());
        }
    }
    all.map(|mut times| {
        times.sort_unstable();
        times[PICTURES / 2]
    })
}

fn written(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}

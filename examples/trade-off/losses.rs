//! What the defaults lose, beside what others would.

use std::error::Error;
use std::fmt::Write;

use ray13::frame::{Comparison, Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::{CUTOFF, Options, PrecisionChoice};
use ray13::scene::{self, ReadOptions, embedded};
use ray13::tone::Tone;

use super::ms;

const DOTS: Size = Size::new(160, 96);

/// Pictures of which the least time counts.
const PICTURES: usize = 3;

fn request(studio: &Studio, view: usize, options: Options) -> Request {
    Request {
        camera: studio.camera(view, f64::from(DOTS.width) / f64::from(DOTS.height)),
        dots: DOTS,
        dot_aspect: 1.0,
        options: Options { threads: 1, ..options },
        wants: Wants::LIGHT,
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    }
}

/// A choice by its name, made of the best.
type Row = (&'static str, fn(Options) -> Options);

/// The largest loss over the views of each scene, by each choice against the best.
pub fn table() -> Result<String, Box<dyn Error>> {
    let deep = Options {
        depth: 64,
        cutoff: CUTOFF / 10.0,
        precision: PrecisionChoice::Double,
        ..Options::default()
    };
    let rows: [Row; 11] = [
        ("`--depth 5`", |deep| Options { depth: 5, ..deep }),
        ("`--depth 8`", |deep| Options { depth: 8, ..deep }),
        ("`--depth 12`", |deep| Options { depth: 12, ..deep }),
        ("**`--depth 16`**", |deep| Options { depth: 16, ..deep }),
        ("`--cutoff 0.033`", |deep| Options { cutoff: 0.033, ..deep }),
        ("**`--cutoff 0.011`**", |deep| Options { cutoff: 0.011, ..deep }),
        ("**`--precision auto`**", |deep| Options { precision: PrecisionChoice::Auto, ..deep }),
        ("`--precision single`", |deep| Options { precision: PrecisionChoice::Single, ..deep }),
        ("**all defaults** but rays a dot", |_| Options::default()),
        ("**`--samples 1`**, RMS", |deep| Options { samples: 1, ..deep }),
        ("`--samples 2`, RMS", |deep| Options { samples: 2, ..deep }),
    ];
    let names: Vec<&str> = embedded().iter().map(|scene| scene.name).collect();
    let mut table = format!("| | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()));
    let studios = names.iter().map(|name| super::inside(name)).collect::<Result<Vec<_>, _>>()?;
    for (name, change) in rows {
        let is_mean = name.ends_with("RMS");
        let best = if is_mean { Options { samples: 6, ..deep } } else { deep };
        let loss = |studio: &Studio| -> Result<f64, Box<dyn Error>> {
            let mut most = 0.0_f64;
            for view in 0..studio.scene().views.len().max(1) {
                let [own, best] =
                    [change(deep), best].map(|options| studio.draw(&request(studio, view, options)));
                let Comparison { light, light_rms, .. } = own.compare(&best)?;
                most = most.max(if is_mean { light_rms } else { light });
            }
            Ok(most)
        };
        let cells = studios.iter().map(loss).collect::<Result<Vec<_>, _>>()?;
        let cells: Vec<String> = cells.into_iter().map(|loss| format!("{loss:.2}")).collect();
        writeln!(table, "| {name} | {} |", cells.join(" | "))?;
    }
    Ok(table)
}

/// Nine glass balls, each in the one before, at depth 9: what `tests/trade/defaults.rs` holds.
pub fn nested_glass() -> Result<String, Box<dyn Error>> {
    let text = include_str!("../../tests/files/nested-glass.scene");
    let studio = Studio::new(scene::read("glass.scene", text.as_bytes(), &ReadOptions::default())?)?;
    let drawn = |cutoff: f64| {
        let request = request(&studio, 0, Options { depth: 9, cutoff, ..Options::default() });
        let least = (0..PICTURES).map(|_| studio.draw_anew(&request).total).min().unwrap_or_default();
        (studio.draw_anew(&request), least)
    };
    let (all, _) = drawn(0.0);
    let mut table =
        "| `--cutoff` | mirror and Snell rays | time | largest error, levels |\n|---|---|---|---|\n"
            .to_owned();
    for cutoff in [0.0, CUTOFF / 10.0, CUTOFF / 2.0, CUTOFF, 3.0 * CUTOFF] {
        let (own, time) = drawn(cutoff);
        let loss = own.compare(&all)?;
        writeln!(
            table,
            "| {cutoff:.4} | {} | {} | {:.2} |",
            own.counts.secondary_rays,
            ms(time),
            loss.light
        )?;
    }
    Ok(table)
}

//! Time against accuracy of each scene inside and of three of others.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{CELL_ASPECT, GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::{ERROR, Options};
use ray13::scene::{self, ReadOptions, embedded};
use ray13::tone::Tone;
use ray13::trade::{EyeDistance, Setting, Sweep, SweepLimits, TradePlot, svg};

use super::ms;

const CELLS: Size = Size::new(80, 45);

/// The time of each scene: the reference takes two fifths of it.
const TIME: Duration = Duration::from_secs(30);

/// Anti-aliasing that is measured of each scene in any case: rays for each dot along each axis, and errors of
/// as many rays as a dot needs, as shares of a level.
const SAMPLES: [u32; 2] = [2, 3];
const ERRORS: [f64; 3] = [4.0 * ERROR, 2.0 * ERROR, ERROR];

const OTHERS: [&str; 3] = ["balls", "rings", "tree"];
const BESIDE: &str = "../shared/scenes/spd";

pub fn tables(pictures: &Path) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    for inside in embedded() {
        let studio = super::inside(inside.name)?;
        text += &curve(inside.name, &studio, pictures)?;
    }
    for name in OTHERS {
        let path = Path::new(BESIDE).join(name).with_extension("nff");
        if path.exists() {
            let studio = Studio::new(scene::read_file(&path, &ReadOptions::default())?)?;
            text += &curve(&format!("spd-{name}"), &studio, pictures)?;
        }
    }
    Ok(text)
}

fn curve(name: &str, studio: &Studio, pictures: &Path) -> Result<String, Box<dyn Error>> {
    eprintln!("  {name}");
    let glyphs = GlyphMode::Blocks;
    let per_cell = glyphs.dots_per_cell();
    let base = Request {
        camera: studio.camera(0, CELL_ASPECT * f64::from(CELLS.width) / f64::from(CELLS.height)),
        dots: Size::new(CELLS.width * per_cell.width, CELLS.height * per_cell.height),
        dot_aspect: glyphs.dot_aspect(CELL_ASPECT),
        options: Options { threads: 1, ..Options::default() },
        wants: Wants::CELLS,
        glyphs,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    };
    let own = Setting::of(&base);
    // Wherever a sweep leads, the curve has these: both kinds of anti-aliasing, side by side.
    let adaptive = ERRORS.map(|error| Options { adaptive: Some(error), ..base.options });
    let fixed = SAMPLES.map(|samples| Options { samples, ..base.options });
    let also = fixed.into_iter().chain(adaptive).map(|options| Setting { options, ..own }).collect();
    let limits = SweepLimits { time: TIME, also, apart: 0.01, rays: None, eye: EyeDistance::default() };
    let sweep = Sweep::new(studio, &base, &limits, &AtomicBool::new(false), &mut |_| ())?;
    let file = format!("trade-{name}.svg");
    fs::write(pictures.join(&file), svg(&TradePlot::new(&sweep)))?;

    let reference = &sweep.reference;
    let percent = |share: f64| format!("{:.2} %", 100.0 * share);
    let mut text = format!(
        "### {name}\n\n![{name}](pictures/{file})\n\n\
         {} rays a dot in the reference, {} of the levels wrong at most, {:.3} levels RMS; it flickers by {:.2}.\n\n\
         | options | time | wrong | by 2 or more | RMS | largest | hits | cells | seen | flicker |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        reference.rays(),
        percent(reference.error().wrong),
        reference.error().rms,
        reference.shimmer().unwrap_or(0.0),
    );
    let front = sweep.front();
    let mut rows = front.clone();
    // What was asked for, anti-aliasing, and the other pictures, are shown wherever they are.
    let is_shown = |place: usize| {
        let one = &sweep.all[place];
        place == 0 || one.is_another_picture || limits.also.contains(&one.setting)
    };
    let others: Vec<usize> =
        (0..sweep.all.len()).filter(|&place| !rows.contains(&place) && is_shown(place)).collect();
    rows.extend(others);
    for place in rows {
        let one = &sweep.all[place];
        let (light, cells) = (&one.accuracy.light, one.accuracy.characters.ok_or("cells are wanted")?);
        let options = match one.setting.arguments(&own) {
            none if none.is_empty() => "the defaults".to_owned(),
            some => format!("`{some}`"),
        };
        let mark = match place {
            _ if one.is_another_picture => " (another picture)",
            0 => "",
            _ if front.contains(&place) => "",
            _ => " (beaten)",
        };
        let hits = one.accuracy.geometry.map_or("–".to_owned(), |geometry| percent(geometry.share()));
        writeln!(
            text,
            "| {options}{mark} | {} | {} | {} | {:.2} | {:.1} | {hits} | {} | {:.2} | {:.2} |",
            ms(one.cost()),
            percent(light.wrong()),
            percent(light.wrong_by(2)),
            light.rms,
            light.largest,
            percent(cells.share()),
            cells.seen,
            cells.shimmer.unwrap_or(0.0),
        )?;
    }
    Ok(text + "\n")
}

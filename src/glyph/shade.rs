//! A level as one cell: by a shade of two grays, by the terminal's own ink alone, or by an ASCII character.

use super::cell::Cell;
use super::choice::{Ground, Palette};
use super::grays::FourGrays;
use super::paint::Paint;
use super::shape::{Coverage, RAMP, SHADES, coverage};
use crate::tone::{Level, lightness};

/// Which papers a terminal has of the attributes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Papers {
    /// All.
    All,
    /// Black and light gray: a Linux console shows the bright ones as these.
    Dim,
}

/// What the grain of a shade costs beside its distance from the level, per L* between its two grays: so
/// little that a shade of neighbouring grays is given up only where another is nearer by more than 2 in L*,
/// which is about what the eye can tell of two surfaces (ΔE 2.3, Mahy 1994).
const GRAIN: f64 = 2.0 / 60.0;

/// The cells of the 13 levels in one palette.
pub struct Shades {
    palette: Palette,
    /// Of [`Palette::Mono`] those where the chequer has more ink.
    cells: [Cell; 13],
    /// The light of an even field.
    lights: [f64; 13],
}

impl Shades {
    /// For a terminal that has these papers.
    pub fn new(palette: Palette, papers: Papers) -> Self {
        let of_levels = |cell: &dyn Fn(Level) -> (Cell, f64)| {
            let all = std::array::from_fn(|k| cell(Level::new(k as u8).unwrap_or_default()));
            Self { palette, cells: all.map(|(cell, _)| cell), lights: all.map(|(_, light)| light) }
        };
        match palette {
            Palette::Dos(grays) => {
                let mixes = mixes(grays, papers);
                of_levels(&|level| nearest(&mixes, level))
            }
            Palette::Mono(ground) => of_levels(&|level| {
                (ink_only(level, ground, true), f64::from(MONO[usize::from(level.get())]) / EIGHTHS)
            }),
            Palette::Gray(_) | Palette::Color(_) => {
                of_levels(&|level| (Cell::flat(Paint::of_level(level)), level.light()))
            }
        }
    }

    /// The cell that shows `level` at a place of the screen.
    pub fn cell(&self, level: Level, column: u32, row: u32) -> Cell {
        match self.palette {
            Palette::Mono(ground) => ink_only(level, ground, (column ^ row) & 1 == 0),
            _ => self.cells[usize::from(level.get())],
        }
    }

    /// Whether an even field of `level` has whole cells of that light.
    pub fn holds_whole(&self, level: Level, light: f64) -> bool {
        // Both of a chequer.
        [0, 1].into_iter().any(|column| {
            let cell = self.cell(level, column, 0);
            match coverage(cell.glyph) {
                Some(Coverage::Even(0.0)) => self.palette.paper_light(cell) == light,
                Some(Coverage::Even(1.0)) => self.palette.ink_light(cell) == light,
                _ => false,
            }
        })
    }

    /// The light of an even field of `level`.
    pub fn light(&self, level: Level) -> f64 {
        self.lights[usize::from(level.get())]
    }
}

/// An even mix of two grays that a cell can show.
struct Mix {
    cell: Cell,
    light: f64,
    lightness: f64,
    /// L* between the two.
    grain: f64,
}

/// All there are of the four grays, those of neighbours first.
fn mixes(grays: FourGrays, papers: Papers) -> Vec<Mix> {
    let (paints, lights, lightnesses) = (grays.paints(), grays.lights(), grays.lightnesses());
    let mix = |cell, light, grain| Mix { cell, light, lightness: lightness(light), grain };
    let flat = (0..4).map(|k| mix(solid(paints[k], papers), lights[k], 0.0));
    let pairs = [(0, 1), (2, 1), (2, 3), (0, 2), (0, 3), (1, 3)];
    let shaded =
        pairs.into_iter().filter(|&(paper, _)| !(papers == Papers::Dim && paints[paper].is_bright()));
    let shaded = shaded.flat_map(|(paper, ink)| {
        (1..4).map(move |quarters| {
            let share = quarters as f64 / 4.0;
            let cell = Cell { glyph: SHADES[quarters], ink: paints[ink], paper: paints[paper] };
            let light = lights[ink] * share + lights[paper] * (1.0 - share);
            mix(cell, light, (lightnesses[ink] - lightnesses[paper]).abs())
        })
    });
    flat.chain(shaded).collect()
}

/// The cell of one gray: a blank where there is paper of it, else a full block.
fn solid(paint: Paint, papers: Papers) -> Cell {
    match (papers, paint) {
        (Papers::Dim, Paint::DarkGray) => Cell { glyph: '█', ink: paint, paper: Paint::Black },
        (Papers::Dim, Paint::White) => Cell { glyph: '█', ink: paint, paper: Paint::LightGray },
        _ => Cell::flat(paint),
    }
}

/// What looks most like a level, with its light; of equals the first.
fn nearest(mixes: &[Mix], level: Level) -> (Cell, f64) {
    let meant = lightness(level.light());
    let cost = |mix: &Mix| (mix.lightness - meant).abs() + GRAIN * mix.grain;
    let best = mixes.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
    best.map_or((Cell::flat(Paint::Black), 0.0), |mix| (mix.cell, mix.light))
}

/// The cell of the ASCII ramp for `level`.
pub fn ascii(level: Level, ground: Ground) -> Cell {
    let place = match ground {
        Ground::Dark => level.get(),
        Ground::Light => Level::MAX.get() - level.get(),
    };
    Cell { glyph: RAMP[usize::from(place)].0, ink: Paint::Terminal, paper: Paint::Terminal }
}

/// How much of a field is white for each level where there is one ink only, in eighths: an even number is one
/// shade, an odd one a chequer of two. The nearest in lightness, but never the chequer of black and a quarter
/// of white, which are too far apart to look even: `docs/13-grays.md` has the figures.
const MONO: [u8; 13] = [0, 0, 0, 2, 2, 2, 2, 3, 3, 4, 6, 7, 8];
const EIGHTHS: f64 = 8.0;

/// The cell of a level in the terminal's own ink; of the two in a chequer the whiter one, where that is asked
/// for.
fn ink_only(level: Level, ground: Ground, whiter: bool) -> Cell {
    let eighths = MONO[usize::from(level.get())];
    let white = usize::from(eighths / 2 + eighths % 2 * u8::from(whiter));
    let quarters = if ground == Ground::Dark { white } else { SHADES.len() - 1 - white };
    Cell { glyph: SHADES[quarters], ink: Paint::Terminal, paper: Paint::Terminal }
}

#[cfg(test)]
#[path = "shade_tests.rs"]
mod tests;

//! Modes in which every traced dot has a place of its own: half blocks, quadrants and Braille.

use super::cell::Cell;
use super::choice::{Ground, Palette};
use super::grays::FourGrays;
use super::paint::Paint;
use super::pair::{Grays, PairFit, paint};
use super::shape::{DOT_COUNT, DOTS, GlyphShape, HALVES, QUADRANTS, block_of, braille_of};
use crate::math::{DVec3, Grid, Size};
use crate::tone::{FOUR_GRAYS, INK_ONLY, Level, Tone, lightness};

/// Steps of the matrix from one gray to the next.
const STEPS: u8 = 4;

/// The dots of a half-block and of a quadrant cell.
const HALF: Size = Size::new(1, 2);
const QUARTERS: Size = Size::new(2, 2);

/// `▀`.
const UPPER: GlyphShape = HALVES[0];

/// Two dots to a cell, one above the other.
pub fn half(light: &Grid<f64>, palette: Palette, tone: Tone) -> Grid<Cell> {
    let level = |x, y| tone.level(light[(x, y)]);
    match palette {
        Palette::Mono(ground) => inked(light.size(), HALF, ground, level),
        Palette::Dos(grays) => {
            let (dither, paints) = (Dither::new(grays), grays.paints());
            halves(light.size(), |x, y| paints[dither.gray(level(x, y), x, y)])
        }
        Palette::Gray(_) | Palette::Color(_) => halves(light.size(), |x, y| Paint::of_level(level(x, y))),
    }
}

/// Two dots to a cell, each in its colour.
pub fn half_in_color(color: &Grid<DVec3>, tone: Tone) -> Grid<Cell> {
    halves(color.size(), |x, y| paint(tone.shown_color(color[(x, y)])))
}

/// 2 × 2 dots to a cell. Where they would have more than two grays, the nearest two.
pub fn quadrant(light: &Grid<f64>, palette: Palette, tone: Tone) -> Grid<Cell> {
    let level = |x, y| tone.level(light[(x, y)]);
    match palette {
        Palette::Mono(ground) => inked(light.size(), QUARTERS, ground, level),
        Palette::Dos(grays) => {
            let (dither, lights) = (Dither::new(grays), grays.lights());
            let dithered =
                Grid::from_fn_in_parallel(light.size(), |x, y| lights[dither.gray(level(x, y), x, y)]);
            PairFit::new(QUADRANTS).compose_grays(&doubled(&dithered), &Grays::four(grays), Tone::default())
        }
        Palette::Gray(_) | Palette::Color(_) => {
            PairFit::new(QUADRANTS).compose_grays(&doubled(light), &Grays::levels(), tone)
        }
    }
}

/// 2 × 2 dots to a cell, in the nearest two colours.
pub fn quadrant_in_color(color: &Grid<DVec3>, tone: Tone) -> Grid<Cell> {
    PairFit::new(QUADRANTS).compose_colors(&doubled(color), tone)
}

/// 2 × 4 dots to a cell, with ink or without, and the cell's ink. Braille dots do not touch, so all of them
/// together are far from white: as many twelfths of them are set as the level says, which keeps the order of
/// the levels and even steps, not their light.
pub fn braille(
    light: &Grid<f64>,
    ground: Ground,
    tone: Tone,
    ink: impl Fn(u32, u32) -> Paint + Sync,
) -> Grid<Cell> {
    let lit = |x, y| {
        let share = f64::from(tone.level(light[(x, y)]).get()) / f64::from(Level::MAX.get());
        (share > INK_ONLY.threshold(x, y)) == (ground == Ground::Dark)
    };
    Grid::from_fn_in_parallel(cells(light.size(), DOTS), |column, row| Cell {
        glyph: braille_of(mask(DOTS, column, row, lit)),
        ink: ink(column, row),
        paper: Paint::Terminal,
    })
}

/// For each level the gray below it, and how many quarters of the matrix have the next one.
struct Dither([(usize, u8); 13]);

impl Dither {
    /// The nearest in lightness.
    fn new(grays: FourGrays) -> Self {
        let lights = grays.lights();
        let mixed = |(dark, steps): (usize, u8)| {
            let share = f64::from(steps) / f64::from(STEPS);
            // White is the last, with no steps above it.
            let bright = lights.get(dark + 1).copied().unwrap_or_default();
            lightness(lights[dark] * (1.0 - share) + bright * share)
        };
        let all = (0..4).flat_map(|dark| (0..STEPS).map(move |steps| (dark, steps)));
        let all: Vec<_> = all.filter(|&(dark, steps)| dark < 3 || steps == 0).collect();
        Self(std::array::from_fn(|k| {
            let meant = lightness(Level::new(k as u8).unwrap_or_default().light());
            let away = |&mix: &(usize, u8)| (mixed(mix) - meant).abs();
            let nearest = all.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.copied().unwrap_or_default()
        }))
    }

    /// One of the two grays about a level, as the matrix over the dots says.
    fn gray(&self, level: Level, x: u32, y: u32) -> usize {
        let (dark, steps) = self.0[usize::from(level.get())];
        dark + usize::from(f64::from(steps) / f64::from(STEPS) > FOUR_GRAYS.threshold(x, y))
    }
}

fn halves(dots: Size, paint: impl Fn(u32, u32) -> Paint + Sync) -> Grid<Cell> {
    Grid::from_fn_in_parallel(cells(dots, HALF), |column, row| {
        Cell::pair(UPPER, paint(column, 2 * row), paint(column, 2 * row + 1))
    })
}

/// Full dots of the terminal's ink, as many as give the level's light.
fn inked(dots: Size, per_cell: Size, ground: Ground, level: impl Fn(u32, u32) -> Level + Sync) -> Grid<Cell> {
    let lit = |x, y| (level(x, y).light() > INK_ONLY.threshold(x, y)) == (ground == Ground::Dark);
    Grid::from_fn_in_parallel(cells(dots, per_cell), |column, row| Cell {
        // All choices of halves and quadrants are characters.
        glyph: block_of(mask(per_cell, column, row, lit)).unwrap_or(' '),
        ink: Paint::Terminal,
        paper: Paint::Terminal,
    })
}

/// The lit dots of a cell, `per_cell` of them spread over its 2 × 4.
fn mask(per_cell: Size, column: u32, row: u32, lit: impl Fn(u32, u32) -> bool) -> u8 {
    let place = |dot: u32| {
        let x = dot % DOTS.width * per_cell.width / DOTS.width;
        let y = dot / DOTS.width * per_cell.height / DOTS.height;
        (column * per_cell.width + x, row * per_cell.height + y)
    };
    (0..DOT_COUNT as u32)
        .map(|dot| {
            let (x, y) = place(dot);
            u8::from(lit(x, y)) << dot
        })
        .sum()
}

/// Whole cells of a picture.
fn cells(dots: Size, per_cell: Size) -> Size {
    Size::new(dots.width / per_cell.width, dots.height / per_cell.height)
}

/// Each row of dots twice: 2 × 4 to a cell from 2 × 2.
fn doubled<T: Copy + Send + Sync>(dots: &Grid<T>) -> Grid<T> {
    let size = dots.size();
    Grid::from_fn_in_parallel(Size::new(size.width, size.height * 2), |x, y| dots[(x, y / 2)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::{ColorDepth, appearance};

    fn mean(cells: &Grid<Cell>, palette: Palette) -> f64 {
        let seen = appearance(cells, palette, DOTS);
        seen.values().iter().sum::<f64>() / seen.values().len() as f64
    }

    #[test]
    fn four_grays_over_the_matrix_are_the_level() {
        for level in Level::all() {
            let flat = |per_cell: Size| {
                Grid::filled(Size::new(4 * per_cell.width, 2 * per_cell.height), level.light())
            };
            let halves = half(&flat(HALF), Palette::DOS, Tone::default());
            let quarters = quadrant(&flat(QUARTERS), Palette::DOS, Tone::default());
            assert!((mean(&halves, Palette::DOS) - level.light()).abs() < 1e-15, "{level:?}");
            assert!((mean(&quarters, Palette::DOS) - level.light()).abs() < 1e-15, "{level:?}");
            // The matrix is as large as the cell.
            assert!(quarters.values().iter().all(|cell| *cell == quarters[(0, 0)]), "{level:?}");
        }
    }

    #[test]
    fn each_dot_has_its_gray() {
        let light =
            Grid::from_fn(Size::new(1, 2), |_, y| Level::new(3 + 4 * y as u8).unwrap_or_default().light());
        let cell = half(&light, Palette::Gray(ColorDepth::Direct), Tone::default())[(0, 0)];
        assert_eq!(cell, Cell { glyph: '▀', ink: Paint::Rgb([74; 3]), paper: Paint::Rgb([154; 3]) });
    }

    #[test]
    fn a_bright_paper_is_spared_where_it_can_be() {
        let light = Grid::from_fn(Size::new(1, 2), |_, y| f64::from(y));
        let cell = half(&light, Palette::DOS, Tone::default())[(0, 0)];
        assert_eq!(cell, Cell { glyph: '▄', ink: Paint::White, paper: Paint::Black });
    }

    #[test]
    fn a_level_lights_its_twelfths_of_the_braille_dots() {
        for level in Level::all() {
            let light = Grid::filled(Size::new(4, 12), level.light());
            let cells = braille(&light, Ground::Dark, Tone::default(), |_, _| Paint::Terminal);
            let set: u32 = cells
                .values()
                .iter()
                .map(|cell| if cell.glyph == ' ' { 0 } else { (u32::from(cell.glyph) - 0x2800).count_ones() })
                .sum();
            assert_eq!(set, 4 * u32::from(level.get()));
        }
    }

    #[test]
    fn ink_alone_is_the_light_of_the_level_to_a_twelfth() {
        for level in Level::all() {
            let light = Grid::filled(Size::new(8, 12), level.light());
            for cells in [
                half(&light, Palette::MONO, Tone::default()),
                quadrant(&light, Palette::MONO, Tone::default()),
            ] {
                assert!((mean(&cells, Palette::MONO) - level.light()).abs() <= 0.5 / 12.0 + 1e-12);
            }
        }
    }
}

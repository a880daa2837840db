//! A level as one cell: by a shade of the four grays, by the terminal's own ink alone, or by an ASCII character.

use super::cell::Cell;
use super::choice::Palette;
use super::paint::Paint;
use super::shape::{RAMP, SHADES};
use crate::tone::Level;

/// The cell that shows `level` at a place of the screen.
pub fn shade(level: Level, palette: Palette, column: u32, row: u32) -> Cell {
    match palette {
        Palette::Dos => DOS[usize::from(level.get())],
        Palette::Mono => ink_only(level, column, row),
        Palette::Gray(_) | Palette::Color(_) => Cell::flat(Paint::of_level(level)),
    }
}

/// The cell of the ASCII ramp for `level`.
pub fn ascii(level: Level) -> Cell {
    Cell { glyph: RAMP[usize::from(level.get())].0, ink: Paint::Terminal, paper: Paint::Terminal }
}

/// The light of [`shade`] over an even field of a level.
pub fn shade_light(level: Level, palette: Palette) -> f64 {
    match palette {
        Palette::Mono => f64::from(MONO[usize::from(level.get())]) / EIGHTHS,
        Palette::Dos | Palette::Gray(_) | Palette::Color(_) => level.light(),
    }
}

/// How much of a field the terminal's ink covers for each level, in eighths: an even number is one shade, an odd one
/// a chequer of two. The nearest in lightness, but never the chequer of blank and `░`, which are too far apart to
/// look even: `docs/13-grays.md` has the figures.
const MONO: [u8; 13] = [0, 0, 0, 2, 2, 2, 2, 3, 3, 4, 6, 7, 8];
const EIGHTHS: f64 = 8.0;

/// The cell of a level in the terminal's own ink.
fn ink_only(level: Level, column: u32, row: u32) -> Cell {
    let eighths = MONO[usize::from(level.get())];
    let more = u8::from((column ^ row) & 1 == 0);
    let quarters = eighths / 2 + eighths % 2 * more;
    Cell { glyph: SHADES[usize::from(quarters)], ink: Paint::Terminal, paper: Paint::Terminal }
}

/// The 13 levels in DOS attributes: a shade between two neighbouring grays, the paper never a bright one. Where the
/// printed table leaves a choice, ink and paper are those of the neighbouring levels, so that fewest attributes
/// change, and level 8 is a full block, so that it is seen where papers are not.
const DOS: [Cell; 13] = {
    use Paint::{Black, DarkGray, LightGray, White};
    const fn cell(glyph: char, ink: Paint, paper: Paint) -> Cell {
        Cell { glyph, ink, paper }
    }
    [
        cell(' ', DarkGray, Black),
        cell('░', DarkGray, Black),
        cell('▒', DarkGray, Black),
        cell('▓', DarkGray, Black),
        cell('█', DarkGray, Black),
        cell('▓', DarkGray, LightGray),
        cell('▒', DarkGray, LightGray),
        cell('░', DarkGray, LightGray),
        cell('█', LightGray, LightGray),
        cell('░', White, LightGray),
        cell('▒', White, LightGray),
        cell('▓', White, LightGray),
        cell('█', White, LightGray),
    ]
};

#[cfg(test)]
mod tests {
    use super::super::shape::{Coverage, coverage};
    use super::*;
    use crate::tone::lightness;

    #[test]
    fn the_mix_of_ink_and_paper_is_the_light_of_the_level() {
        for level in Level::all() {
            let cell = shade(level, Palette::Dos, 0, 0);
            let Some(Coverage::Even(ink)) = coverage(cell.glyph) else { panic!("a shade covers evenly") };
            let light = cell.ink_light() * ink + cell.paper_light() * (1.0 - ink);
            assert!((light - level.light()).abs() < 1e-15, "level {}", level.get());
            assert!(matches!(cell.paper, Paint::Black | Paint::LightGray));
        }
    }

    #[test]
    fn the_grays_are_written_as_flat_cells_are() {
        for (k, paint) in
            [Paint::Black, Paint::DarkGray, Paint::LightGray, Paint::White].into_iter().enumerate()
        {
            assert_eq!(DOS[4 * k], Cell::flat(paint));
        }
    }

    #[test]
    fn ink_alone_is_the_nearest_that_looks_even() {
        let shades = [0_u8, 2, 3, 4, 5, 6, 7, 8];
        for level in Level::all() {
            let away =
                |eighths: u8| (lightness(f64::from(eighths) / EIGHTHS) - lightness(level.light())).abs();
            let nearest = shades.into_iter().min_by(|&a, &b| away(a).total_cmp(&away(b)));
            assert_eq!(Some(MONO[usize::from(level.get())]), nearest, "level {}", level.get());
        }
    }

    #[test]
    fn ink_alone_covers_what_it_says() {
        for level in Level::all() {
            let quarters = (0..4).map(|k| match coverage(shade(level, Palette::Mono, k % 2, k / 2).glyph) {
                Some(Coverage::Even(ink)) => ink / 4.0,
                _ => f64::NAN,
            });
            assert_eq!(quarters.sum::<f64>(), shade_light(level, Palette::Mono));
        }
    }

    #[test]
    fn ascii_is_a_ramp_of_the_terminals_own_colours() {
        let ramp: String = Level::all().map(|level| ascii(level).glyph).collect();
        assert_eq!(ramp, " .-,:;*=xo$#@");
    }
}

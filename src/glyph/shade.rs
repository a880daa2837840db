//! A level as one cell: by a shade of the four grays, by the terminal's own ink alone, or by an ASCII character.

use super::cell::Cell;
use super::choice::Palette;
use super::paint::Paint;
use super::shape::{RAMP, SHADES};
use crate::tone::{INK_ONLY, Level};

/// The cell that shows `level` at a place of the screen.
pub fn shade(level: Level, palette: Palette, column: u32, row: u32) -> Cell {
    match palette {
        Palette::Dos => DOS[usize::from(level.get())],
        Palette::Mono => ink_only(level.light(), column, row),
        Palette::Gray(_) | Palette::Color(_) => Cell::flat(Paint::of_level(level)),
    }
}

/// The cell of the ASCII ramp for `level`.
pub fn ascii(level: Level) -> Cell {
    Cell { glyph: RAMP[usize::from(level.get())].0, ink: Paint::Terminal, paper: Paint::Terminal }
}

/// The terminal's ink covers a cell by quarters; the matrix over the cells shares out what lies between two of them.
fn ink_only(light: f64, column: u32, row: u32) -> Cell {
    let most = SHADES.len() - 1;
    let quarters = (light * most as f64 + 1.0 - INK_ONLY.threshold(column, row)) as usize;
    Cell { glyph: SHADES[quarters.min(most)], ink: Paint::Terminal, paper: Paint::Terminal }
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
    fn ink_alone_shows_each_level_over_the_matrix() {
        let mut last = -1.0;
        for level in Level::all() {
            let mean = (0..12)
                .map(|k| match coverage(shade(level, Palette::Mono, k % 4, k / 4).glyph) {
                    Some(Coverage::Even(ink)) => ink / 12.0,
                    _ => f64::NAN,
                })
                .sum::<f64>();
            // A quarter of ink in one cell of twelve is the matrix's smallest step.
            assert!((mean - level.light()).abs() <= 0.5 / 48.0 + 1e-12, "level {}: {mean}", level.get());
            assert!(mean > last);
            last = mean;
        }
        assert_eq!(shade(Level::MIN, Palette::Mono, 2, 1).glyph, ' ');
        assert_eq!(shade(Level::MAX, Palette::Mono, 0, 0).glyph, '█');
    }

    #[test]
    fn ascii_is_a_ramp_of_the_terminals_own_colours() {
        let ramp: String = Level::all().map(|level| ascii(level).glyph).collect();
        assert_eq!(ramp, " .-,:;*=xo$#@");
    }
}

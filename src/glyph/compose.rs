//! A picture's light as character cells.

use super::cell::Cell;
use super::choice::{GlyphMode, Ground, Palette};
use super::dots::{braille, half, half_in_color, quadrant, quadrant_in_color};
use super::fit::BestFit;
use super::paint::{ColorDepth, Paint};
use super::pair::{Grays, PairFit, paint};
use super::shade::{Papers, Shades, ascii};
use super::shape::{BLOCKS, DOT_COUNT, DOTS, HALVES};
use crate::math::{DVec3, Grid};
use crate::shade::luminance;
use crate::tone::Tone;

/// The cells that show `light`, a gray in linear light per traced dot, with [`GlyphMode::dots_per_cell`] dots
/// to a cell. Light is clamped to 0 to 1. Dots right of the last whole cell and below it are ignored.
///
/// A cell depends on its own dots, on the ring of dots around it and on its place on the screen, on nothing
/// else, so a still part of a moving picture stays still. A cell whose dots are all of one light shows that
/// light's level. In the modes that fit, neither ink nor paper of an edge is brighter or darker than all of
/// these dots by more than a level.
///
/// ```
/// use ray13::glyph::{GlyphMode, Palette, compose};
/// use ray13::math::{Grid, Size};
/// use ray13::tone::Tone;
///
/// // One cell of 2 × 4 dots, white on the left.
/// let light = Grid::from_fn(Size::new(2, 4), |column, _| if column == 0 { 1.0 } else { 0.0 });
/// let cells = compose(&light, GlyphMode::Blocks, Palette::MONO, Tone::default());
/// assert_eq!(cells[(0, 0)].glyph, '▌');
/// ```
pub fn compose(light: &Grid<f64>, mode: GlyphMode, palette: Palette, tone: Tone) -> Grid<Cell> {
    if let Palette::Color(depth) = palette {
        return compose_color(&light.map(|&light| DVec3::splat(light)), mode, depth, tone);
    }
    let cells = match mode {
        GlyphMode::Shade => {
            let shades = Shades::new(palette, Papers::All);
            Grid::from_fn_in_parallel(light.size(), |column, row| {
                shades.cell(tone.level(light[(column, row)]), column, row)
            })
        }
        GlyphMode::Ascii => mapped(light, |light| ascii(tone.level(light), palette.ground())),
        GlyphMode::Half => half(light, palette, tone),
        GlyphMode::Quadrant => quadrant(light, palette, tone),
        GlyphMode::Braille => braille(light, palette.ground(), tone, |_, _| Paint::Terminal),
        GlyphMode::Blocks | GlyphMode::Cp437 => {
            let (shapes, papers) =
                if mode == GlyphMode::Blocks { (BLOCKS, Papers::All) } else { (HALVES, Papers::Dim) };
            match palette {
                Palette::Gray(_) => PairFit::new(shapes).compose_grays(light, &Grays::levels(), tone),
                _ => BestFit::new(shapes, papers, palette).compose(light, tone),
            }
        }
    };
    at(palette.depth(), cells)
}

/// The characters of a picture: in colour where both its dots and the palette have it.
pub fn compose_dots(
    light: &Grid<f64>,
    color: Option<&Grid<DVec3>>,
    mode: GlyphMode,
    palette: Palette,
    tone: Tone,
) -> Grid<Cell> {
    match (color, palette) {
        (Some(color), Palette::Color(depth)) => compose_color(color, mode, depth, tone),
        _ => compose(light, mode, palette, tone),
    }
}

/// The cells that show `color`, three linear primaries per traced dot, as [`compose`] does, in any colours.
/// There are no levels: `tone` changes luminance, nothing is rounded but to the terminal's depth. Where a
/// cell can have one colour only beside the terminal's own (`ascii`, `braille`), its ink carries lightness
/// and its colour the hue.
pub fn compose_color(color: &Grid<DVec3>, mode: GlyphMode, depth: ColorDepth, tone: Tone) -> Grid<Cell> {
    let light = || mapped(color, luminance);
    let cells = match mode {
        GlyphMode::Shade => mapped(color, |color| Cell::flat(paint(tone.shown_color(color)))),
        GlyphMode::Ascii => mapped(color, |color| Cell {
            ink: hue(color),
            ..ascii(tone.level(luminance(color)), Ground::Dark)
        }),
        GlyphMode::Half => half_in_color(color, tone),
        GlyphMode::Quadrant => quadrant_in_color(color, tone),
        GlyphMode::Braille => braille(&light(), Ground::Dark, tone, |column, row| {
            let dots = (0..DOT_COUNT as u32).map(|dot| {
                let (x, y) = (dot % DOTS.width, dot / DOTS.width);
                color[(column * DOTS.width + x, row * DOTS.height + y)]
            });
            hue(dots.sum())
        }),
        GlyphMode::Blocks => PairFit::new(BLOCKS).compose_colors(color, tone),
        GlyphMode::Cp437 => PairFit::new(HALVES).compose_colors(color, tone),
    };
    at(depth, cells)
}

/// A colour at its brightest; white for no light.
fn hue(color: DVec3) -> Paint {
    // Light may be beyond any range; a share of infinity would be none.
    let color = color.clamp(DVec3::ZERO, DVec3::MAX);
    let most = color.max_element();
    paint(if most > 0.0 { color / most } else { DVec3::ONE })
}

fn at(depth: ColorDepth, cells: Grid<Cell>) -> Grid<Cell> {
    if depth == ColorDepth::Direct { cells } else { mapped(&cells, |cell| cell.at(depth)) }
}

/// Each value mapped, by all threads.
fn mapped<T: Copy + Sync, U: Copy + Send>(grid: &Grid<T>, f: impl Fn(T) -> U + Sync) -> Grid<U> {
    Grid::from_fn_in_parallel(grid.size(), |column, row| f(grid[(column, row)]))
}

#[cfg(test)]
mod tests {
    use super::super::shape::coverage;
    use super::*;
    use crate::math::Size;
    use crate::tone::Level;
    use proptest::prelude::*;

    /// With levels or the terminal's own ink.
    const LEVELLED: [Palette; 3] = [Palette::DOS, Palette::Gray(ColorDepth::Direct), Palette::MONO];
    const PALETTES: [Palette; 6] = [
        Palette::DOS,
        Palette::Gray(ColorDepth::Direct),
        Palette::Gray(ColorDepth::Indexed),
        Palette::MONO,
        Palette::Color(ColorDepth::Direct),
        Palette::Color(ColorDepth::Indexed),
    ];
    const TONES: [Tone; 2] = [Tone::Lightness, Tone::Even];

    /// A screen of 5 × 3 cells of one light.
    fn flat(mode: GlyphMode, light: f64) -> Grid<f64> {
        let dots = mode.dots_per_cell();
        Grid::filled(Size::new(5 * dots.width, 3 * dots.height), light)
    }

    #[test]
    fn flat_light_is_its_level_in_every_mode() {
        for k in 0..=240 {
            let light = f64::from(k) / 240.0;
            for (palette, tone) in LEVELLED.into_iter().flat_map(|p| TONES.map(|t| (p, t))) {
                let cells = |mode| compose(&flat(mode, light), mode, palette, tone);
                let shades = cells(GlyphMode::Shade);
                let shade = |papers| Shades::new(palette, papers).cell(tone.level(light), 3, 2);
                assert_eq!(shades[(3, 2)], shade(Papers::All));
                assert_eq!(cells(GlyphMode::Blocks), shades);
                assert_eq!(cells(GlyphMode::Cp437)[(3, 2)], shade(Papers::Dim));
                assert_eq!(cells(GlyphMode::Ascii)[(3, 2)], ascii(tone.level(light), Ground::Dark));
            }
        }
    }

    #[test]
    fn flat_light_is_one_gray_in_the_gray_palette() {
        for level in Level::all() {
            for mode in [GlyphMode::Blocks, GlyphMode::Cp437, GlyphMode::Quadrant, GlyphMode::Half] {
                let palette = Palette::Gray(ColorDepth::Direct);
                let cells = compose(&flat(mode, level.light()), mode, palette, Tone::Lightness);
                let meant = Cell::flat(Paint::of_level(level));
                assert!(cells.values().iter().all(|cell| *cell == meant), "{mode:?} {level:?}");
            }
        }
    }

    #[test]
    fn flat_colour_is_that_colour() {
        let colour = DVec3::new(0.9, 0.3, 0.01);
        for mode in GlyphMode::ALL {
            let dots = flat(mode, 0.0).map(|_| colour);
            let cells = compose_color(&dots, mode, ColorDepth::Direct, Tone::Lightness);
            match mode {
                GlyphMode::Ascii | GlyphMode::Braille => assert_eq!(cells[(1, 1)].ink, paint(colour / 0.9)),
                _ => assert_eq!(cells[(1, 1)], Cell::flat(paint(colour))),
            }
            let indexed = compose_color(&dots, mode, ColorDepth::Indexed, Tone::Lightness);
            assert_eq!(indexed[(1, 1)], cells[(1, 1)].at(ColorDepth::Indexed));
        }
    }

    #[test]
    fn the_even_tone_shows_luminance_and_keeps_hue() {
        let colour = DVec3::new(0.4, 0.5, 0.5);
        let shown = Tone::Even.shown_color(colour);
        assert!((luminance(shown) - Tone::Even.shown(luminance(colour))).abs() < 1e-12);
        assert!((shown.x / shown.y - 0.8).abs() < 1e-12);
    }

    #[test]
    fn light_beyond_the_range_and_nan_are_shown() {
        for mode in GlyphMode::ALL {
            for palette in PALETTES {
                let cells = |light| compose(&flat(mode, light), mode, palette, Tone::Lightness);
                assert_eq!(cells(3.0), cells(1.0));
                assert_eq!(cells(f64::INFINITY), cells(1.0));
                assert_eq!(cells(-1.0), cells(0.0));
                assert_eq!(cells(f64::NAN), cells(0.0));
            }
        }
    }

    #[test]
    fn dots_beyond_the_last_whole_cell_are_ignored() {
        let light = Grid::filled(Size::new(7, 6), 0.5);
        let cells = compose(&light, GlyphMode::Blocks, Palette::DOS, Tone::Lightness);
        assert_eq!(cells.size(), Size::new(3, 1));
        let none = compose(&Grid::filled(Size::new(0, 0), 0.0), GlyphMode::Cp437, Palette::MONO, Tone::Even);
        assert_eq!(none.size(), Size::new(0, 0));
    }

    #[test]
    fn edges_take_the_shape_that_lies_along_them() {
        let edge = |inside: fn(u32, u32) -> bool, mode, palette| {
            let light = Grid::from_fn(Size::new(2, 4), |x, y| if inside(x, y) { 1.0 } else { 0.0 });
            compose(&light, mode, palette, Tone::Lightness)[(0, 0)]
        };
        let white = |glyph| Cell { glyph, ink: Paint::White, paper: Paint::Black };
        assert_eq!(edge(|_, y| y < 2, GlyphMode::Blocks, Palette::DOS), white('▀'));
        assert_eq!(edge(|_, y| y == 3, GlyphMode::Blocks, Palette::DOS), white('▂'));
        assert_eq!(edge(|x, y| x == 1 && y > 1, GlyphMode::Blocks, Palette::DOS), white('▗'));
        assert_eq!(edge(|x, _| x == 1, GlyphMode::Cp437, Palette::DOS), white('▐'));
        assert_eq!(edge(|x, y| x == 0 || y > 1, GlyphMode::Blocks, Palette::MONO).glyph, '▙');
    }

    /// Light of 3 × 2 cells: anything, the grays themselves among it, and beyond the range.
    fn any_light() -> impl Strategy<Value = Grid<f64>> {
        let dot = prop_oneof![
            Just(0.0),
            Just(1.0),
            (0_u8..13).prop_map(|k| Level::new(k).unwrap_or_default().light()),
            -0.5..2.0,
        ];
        let size = Size::new(6, 8);
        prop::collection::vec(dot, size.area()).prop_map(move |light| Grid::from_values(size, light))
    }

    proptest! {
        #[test]
        fn each_mode_keeps_to_its_glyphs_and_paints(light in any_light(), even in any::<bool>()) {
            let tone = TONES[usize::from(even)];
            for cell in compose(&light, GlyphMode::Cp437, Palette::DOS, tone).values() {
                prop_assert!(" ░▒▓█▀▄▌▐".contains(cell.glyph));
                prop_assert!(matches!(cell.paper, Paint::Black | Paint::LightGray));
            }
            let levels: Vec<Paint> = Level::all().map(Paint::of_level).collect();
            for mode in [GlyphMode::Blocks, GlyphMode::Quadrant, GlyphMode::Half, GlyphMode::Shade] {
                for cell in compose(&light, mode, Palette::Gray(ColorDepth::Direct), tone).values() {
                    prop_assert!(levels.contains(&cell.ink) && levels.contains(&cell.paper));
                }
            }
            for mode in GlyphMode::ALL {
                for ground in [Ground::Dark, Ground::Light] {
                    for cell in compose(&light, mode, Palette::Mono(ground), tone).values() {
                        prop_assert_eq!((cell.ink, cell.paper), (Paint::Terminal, Paint::Terminal));
                        prop_assert!(coverage(cell.glyph).is_some());
                    }
                }
            }
        }

        #[test]
        fn a_cell_depends_on_its_own_dots_and_their_ring_only(light in any_light(), other in any_light()) {
            for mode in [GlyphMode::Blocks, GlyphMode::Cp437, GlyphMode::Braille] {
                for palette in PALETTES {
                    // The middle cell of the upper row and its ring are kept, all around is changed.
                    let mixed = Grid::from_fn(light.size(), |x, y| {
                        let kept = (1..5).contains(&x) && y < 5;
                        if kept { light[(x, y)] } else { other[(x, y)] }
                    });
                    let [before, after] =
                        [&light, &mixed].map(|light| compose(light, mode, palette, Tone::Lightness));
                    prop_assert_eq!(before[(1, 0)], after[(1, 0)]);
                }
            }
        }
    }
}

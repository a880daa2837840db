//! No cell is brighter or darker than the dots in and around it by more than a level.

use super::choice::{GlyphMode, Ground, Palette};
use super::paint::{ColorDepth, Paint};
use super::range::levels_around;
use super::shape::{Coverage, coverage};
use super::{Cell, FourGrays, compose};
use crate::math::{Grid, Size};
use crate::tone::{Level, Tone};
use proptest::prelude::*;

const GRAY: Palette = Palette::Gray(ColorDepth::Direct);
/// Palettes whose grays are those of the levels.
const EXACT: [Palette; 2] = [Palette::DOS, GRAY];

/// The levels of what the eye tells apart in a cell: ink and paper of an edge, the mix of a shade.
fn parts(cell: Cell, palette: Palette) -> Vec<u8> {
    let (ink, paper) = (palette.ink_light(cell), palette.paper_light(cell));
    let lights = match coverage(cell.glyph) {
        Some(Coverage::Even(share)) => vec![ink * share + paper * (1.0 - share)],
        _ => vec![ink, paper],
    };
    lights.into_iter().map(|light| Level::nearest(light).get()).collect()
}

/// The first cell of `light` that reaches beyond its dots, as text.
fn beyond(light: &Grid<f64>, mode: GlyphMode, palette: Palette) -> Option<String> {
    let cells = compose(light, mode, palette, Tone::Lightness);
    for row in 0..cells.size().height {
        for column in 0..cells.size().width {
            let around = levels_around(light, column, row, Tone::Lightness);
            let (low, high) = (around.darkest.get().saturating_sub(1), around.lightest.get() + 1);
            let cell = cells[(column, row)];
            if parts(cell, palette).iter().any(|part| !(low..=high).contains(part)) {
                return Some(format!("{cell:?} at {column}, {row} where the dots are {around:?}"));
            }
        }
    }
    None
}

/// At 80 × 25 in a terminal the first picture had a bright line at its lower left, where level 5 becomes
/// level 4: `▆` of dark gray on light gray, right in the mean.
#[test]
fn where_two_levels_meet_there_is_no_line() {
    let steps = Level::all().zip(Level::all().skip(1));
    for (dark, bright) in steps.flat_map(|(a, b)| [(a, b), (b, a)]) {
        for edge in 0..=8 {
            for (across, share) in [(false, 1.0), (true, 1.0), (false, 0.5), (true, 0.5)] {
                let light = Grid::from_fn(Size::new(8, 12), |x, y| {
                    let place = if across { x } else { y };
                    let nearer = if place < edge { dark } else { bright };
                    // The levels themselves, and light between them that is only just of each.
                    let middle = f64::midpoint(dark.light(), bright.light());
                    middle + (nearer.light() - middle) * share
                });
                for (mode, palette) in
                    [GlyphMode::Blocks, GlyphMode::Cp437].into_iter().flat_map(|m| EXACT.map(|p| (m, p)))
                {
                    assert_eq!(beyond(&light, mode, palette), None, "{dark:?} {bright:?} {edge} {mode:?}");
                }
            }
        }
    }
}

/// The lowest row of the same picture became a row of dots in the terminal's own ink: three rows of level 3
/// above black have the mean of a white quarter.
#[test]
fn a_dark_edge_is_no_row_of_white_dots() {
    for ground in [Ground::Dark, Ground::Light] {
        for level in (1..9).filter_map(Level::new) {
            for rows in 0..=4 {
                let light = Grid::from_fn(Size::new(6, 4), |_, y| if y < rows { level.light() } else { 0.0 });
                let cells = compose(&light, GlyphMode::Blocks, Palette::Mono(ground), Tone::Lightness);
                let even = |cell: &Cell| matches!(coverage(cell.glyph), Some(Coverage::Even(_)));
                assert!(cells.values().iter().all(even), "{level:?} {rows}");
            }
        }
    }
}

fn any_light() -> impl Strategy<Value = Grid<f64>> {
    let size = Size::new(6, 12);
    let dot =
        prop_oneof![3 => 0.0..=1.0, 1 => (0_u8..13).prop_map(|k| Level::new(k).unwrap_or_default().light())];
    let narrow = (0.0..=1.0, 0.0..=0.3, prop::collection::vec(0.0..=1.0, size.area())).prop_map(
        |(base, reach, dots): (f64, f64, Vec<f64>)| {
            dots.iter().map(|dot| (base + reach * dot).min(1.0)).collect()
        },
    );
    prop_oneof![prop::collection::vec(dot, size.area()), narrow]
        .prop_map(move |dots| Grid::from_values(size, dots))
}

proptest! {
    #[test]
    fn no_part_reaches_beyond_its_dots(light in any_light()) {
        for mode in [GlyphMode::Blocks, GlyphMode::Cp437] {
            for palette in EXACT {
                prop_assert_eq!(beyond(&light, mode, palette), None);
            }
        }
    }

    /// Where grays are not the PC's, an edge has two of them only where the dots reach that far.
    #[test]
    fn no_edge_reaches_beyond_its_dots_in_other_grays(light in any_light()) {
        let xterm = FourGrays::Attributes([[0; 3], [0x7F; 3], [0xE5; 3], [0xFF; 3]]);
        let palette = Palette::Dos(xterm);
        let cells = compose(&light, GlyphMode::Blocks, palette, Tone::Lightness);
        for row in 0..cells.size().height {
            for column in 0..cells.size().width {
                let cell = cells[(column, row)];
                if let Some(Coverage::Dots(_)) = coverage(cell.glyph) {
                    let around = levels_around(&light, column, row, Tone::Lightness);
                    let parts = parts(cell, palette);
                    // Level 11 is level 12 there: its white is as near as any gray.
                    let (low, high) = (around.darkest.get().saturating_sub(2), around.lightest.get() + 2);
                    prop_assert!(parts.iter().all(|part| (low..=high).contains(part)), "{cell:?} {around:?}");
                    prop_assert!(!matches!(cell.ink, Paint::Terminal));
                }
            }
        }
    }
}

//! What cells look like: the light of a screen of them, dot by dot.

use super::cell::Cell;
use super::choice::Palette;
use super::shape::{BRAILLE_DOT, Coverage, DOTS, coverage};
use crate::math::{Grid, Size};

/// The linear light of `cells`, composed for a palette, at `per_cell` dots each. Shades and ASCII are taken
/// as an even mix of their ink and paper, a Braille dot as one over its place in the cell, and characters
/// that this program never uses as paper. The edges of shapes are exact where `per_cell` is a multiple of 2 ×
/// 4.
pub fn appearance(cells: &Grid<Cell>, palette: Palette, per_cell: Size) -> Grid<f64> {
    let size = cells.size();
    Grid::from_fn(Size::new(size.width * per_cell.width, size.height * per_cell.height), |x, y| {
        let cell = cells[(x / per_cell.width, y / per_cell.height)];
        let inked = |mask: u8| {
            let column = (x % per_cell.width) * DOTS.width / per_cell.width;
            let row = (y % per_cell.height) * DOTS.height / per_cell.height;
            f64::from(mask >> (row * DOTS.width + column) & 1)
        };
        let ink = match coverage(cell.glyph) {
            Some(Coverage::Even(share)) => share,
            Some(Coverage::Dots(mask)) => inked(mask),
            Some(Coverage::Specks(mask)) => inked(mask) * BRAILLE_DOT,
            None => 0.0,
        };
        palette.ink_light(cell) * ink + palette.paper_light(cell) * (1.0 - ink)
    })
}

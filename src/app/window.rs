//! What the terminal reports of its size.

use ratatui::layout::Size;

use crate::glyph::CELL_ASPECT;

/// The widths of a cell divided by its height that are believed: fonts for text are taller than wide, up to
/// the square cells of some consoles; terminals that report nonsense report it far outside.
const CELL_ASPECTS: std::ops::RangeInclusive<f64> = 0.25..=1.0;

/// What the terminal reports of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// Columns and rows; 0 where it does not say.
    pub cells: Size,
    /// Width and height of all cells in pixels; 0 where it does not say.
    pub pixels: Size,
}

impl Window {
    /// Width of a cell divided by its height; 1:2 where the terminal does not say or what it says is no cell.
    pub fn cell_aspect(self) -> f64 {
        let width = f64::from(self.pixels.width) / f64::from(self.cells.width);
        let height = f64::from(self.pixels.height) / f64::from(self.cells.height);
        // A size of 0 gives a NaN or an infinity, which no range contains.
        Some(width / height).filter(|aspect| CELL_ASPECTS.contains(aspect)).unwrap_or(CELL_ASPECT)
    }
}

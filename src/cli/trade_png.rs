//! The plot of time against accuracy as PNG: the screen that a terminal would show, in the letters of a PC.

use font8x8::{BASIC_FONTS, BOX_FONTS, LATIN_FONTS, UnicodeFonts};
use ratatui::style::Color;

use crate::glyph::{Coverage, coverage};
use crate::math::{Grid, Size};
use crate::output::{self, Pixels};
use crate::trade::TradePlot;

use super::error::CliError;
use super::trade_report::{PLOT, plot_screen};

/// Pixels of a cell: the letters are 8 × 8, and each of their rows is drawn twice, as a CGA card's on a VGA
/// screen.
const CELL: Size = Size::new(8, 16);

/// The plot, 8 × 16 pixels to a cell.
pub fn drawn(plot: &TradePlot) -> Result<Vec<u8>, CliError> {
    let screen = plot_screen(plot, PLOT);
    let size = Size::new(u32::from(screen.area.width), u32::from(screen.area.height));
    let pixels = Grid::from_fn(Size::new(size.width * CELL.width, size.height * CELL.height), |x, y| {
        let cell = &screen[((x / CELL.width) as u16, (y / CELL.height) as u16)];
        let symbol = cell.symbol().chars().next().unwrap_or(' ');
        if is_inked(symbol, x % CELL.width, y % CELL.height) { gray(cell.fg) } else { 0 }
    });
    let mut bytes = Vec::new();
    output::png(&Pixels::Gray(pixels), &mut bytes)
        .map_err(|e| CliError::Output(format!("the plot could not be encoded: {e}")))?;
    Ok(bytes)
}

/// Whether a pixel of a cell is of the character's own strokes.
fn is_inked(symbol: char, x: u32, y: u32) -> bool {
    if let Some(Coverage::Dots(mask) | Coverage::Specks(mask)) = coverage(symbol) {
        // 2 × 4 dots of 4 × 4 pixels; of Braille's the middle.
        let is_in = matches!(coverage(symbol), Some(Coverage::Dots(_))) || (1..3).contains(&(x % 4));
        return is_in && mask >> (y / 4 * 2 + x / 4) & 1 == 1;
    }
    let letters = [BASIC_FONTS.get(symbol), LATIN_FONTS.get(symbol), BOX_FONTS.get(symbol)];
    let rows = letters.into_iter().flatten().next().or_else(|| own(symbol));
    rows.is_some_and(|rows| rows[(y / 2) as usize] >> x & 1 == 1)
}

/// Marks that the font lacks, the left pixel in the lowest bit.
const fn own(symbol: char) -> Option<[u8; 8]> {
    match symbol {
        '♦' => Some([0x00, 0x08, 0x1C, 0x3E, 0x7F, 0x3E, 0x1C, 0x08]),
        _ => None,
    }
}

/// The colours of the plot as grays of a PC.
const fn gray(color: Color) -> u8 {
    match color {
        Color::DarkGray => 0x55,
        Color::White | Color::Yellow => 0xFF,
        _ => 0xAA,
    }
}

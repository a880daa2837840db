//! A picture's light as character cells.

use super::cell::{Cell, GlyphMode, Palette};
use super::fit::BestFit;
use super::shade::{ascii, shade};
use super::shape::{BLOCKS, HALVES};
use crate::math::Grid;
use crate::tone::Tone;

/// The cells that show `light`, a gray in linear light per traced dot, with [`GlyphMode::dots_per_cell`] dots to a
/// cell. Light is clamped to 0 to 1. Dots right of the last whole cell and below it are ignored.
///
/// A cell depends on its own dots and on its place on the screen, on nothing else, so a still part of a moving
/// picture stays still. A cell whose dots are all of one light shows that light's level.
pub fn compose(light: &Grid<f64>, mode: GlyphMode, palette: Palette, tone: Tone) -> Grid<Cell> {
    match mode {
        GlyphMode::Shade => Grid::from_fn(light.size(), |column, row| {
            shade(tone.level(light[(column, row)]), palette, column, row)
        }),
        GlyphMode::Ascii => light.map(|&light| ascii(tone.level(light))),
        GlyphMode::Blocks => BestFit::new(BLOCKS, palette, false).compose(light, tone),
        GlyphMode::Cp437 => BestFit::new(HALVES, palette, true).compose(light, tone),
    }
}

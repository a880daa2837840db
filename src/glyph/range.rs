//! Between which levels the dots in and around a cell lie: no part of the cell may go beyond them by more
//! than a level.
//!
//! A fit of the mean alone would show the slow passage from level 5 to level 4 as a strip of level 8 above a
//! cell of level 4: right in the mean, and a bright line where the picture has none.

use super::shape::{DOT_COUNT, DOTS};
use crate::math::Grid;
use crate::tone::{Level, Tone, lightness};

/// The darkest and the lightest level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelRange {
    /// At most [`LevelRange::lightest`].
    pub darkest: Level,
    /// At least [`LevelRange::darkest`].
    pub lightest: Level,
}

impl LevelRange {
    /// The L* that a part of the cell may have: from a level below the darkest to a level above the lightest.
    pub fn lightness_to_a_level(self) -> [f64; 2] {
        let of = |number| lightness(Level::new(number).unwrap_or(Level::MAX).light());
        [of(self.darkest.get().saturating_sub(1)), of(self.lightest.get() + 1)]
    }
}

/// The dots of a cell, [`DOTS`] of them, in scan order.
#[inline]
pub fn dots_of<T: Copy>(dots: &Grid<T>, column: u32, row: u32) -> [T; DOT_COUNT] {
    let corner = (column * DOTS.width, row * DOTS.height);
    let mut found = [dots[corner]; DOT_COUNT];
    for dot in 1..DOT_COUNT {
        let (x, y) = (dot as u32 % DOTS.width, dot as u32 / DOTS.width);
        found[dot] = dots[(corner.0 + x, corner.1 + y)];
    }
    found
}

/// Of the dots of a cell and of the ring of dots around it, as far as the picture goes.
#[inline]
pub fn levels_around(light: &Grid<f64>, column: u32, row: u32, tone: Tone) -> LevelRange {
    let reach = |first: u32, count: u32, end: u32| first.saturating_sub(1)..(first + count + 1).min(end);
    let size = light.size();
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for y in reach(row * DOTS.height, DOTS.height, size.height) {
        for x in reach(column * DOTS.width, DOTS.width, size.width) {
            let light = light[(x, y)];
            // NaN counts as no light.
            let light = if light.is_nan() { 0.0 } else { light };
            (least, most) = (least.min(light), most.max(light));
        }
    }
    // Tones keep the order of light.
    LevelRange { darkest: tone.level(least), lightest: tone.level(most) }
}

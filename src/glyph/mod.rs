//! Stages 10 and 11, DITHER and DISPLAY: light and levels in, character cells out.

mod appearance;
mod cell;
mod choice;
mod compose;
mod dots;
mod eye;
mod fit;
mod grays;
mod paint;
mod pair;
mod range;
mod shade;
mod shape;

pub use appearance::appearance;
pub use cell::Cell;
pub use choice::{CELL_ASPECT, GlyphMode, Ground, Palette};
pub use compose::{compose, compose_color, compose_dots};
pub use grays::FourGrays;
pub use paint::{ColorDepth, Paint};
pub use shape::{Coverage, complement_of, coverage};

#[cfg(test)]
mod range_tests;

//! Stages 10 and 11, DITHER and DISPLAY: light and levels in, character cells out.

mod appearance;
mod cell;
mod compose;
mod fit;
mod shade;
mod shape;

pub use appearance::appearance;
pub use cell::{Cell, GlyphMode, Paint, Palette};
pub use compose::compose;
pub use shape::{Coverage, coverage};

//! Stages 10 and 11, DITHER and DISPLAY: light and levels in, character cells out.

mod cell;

pub use cell::{Cell, GlyphMode, Paint, Palette};

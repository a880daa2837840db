//! Letters: lines of text as outlines, in the fonts of the machine.

mod curve_pen;
mod letters;
mod library;
mod likeness;
mod request;
mod scale;
mod vertical;

pub use letters::{AlignedAcross, AlignedUp, NotWritten, TextLine, WrittenText, written};
pub use library::{FontLibrary, KnownFonts};

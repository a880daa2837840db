//! Stage 11, DISPLAY: cells, levels and light in, bytes out. Nothing here opens a file or prints; each
//! function writes to what it is given, in pieces: give it a buffered writer. The only errors are the
//! writer's own, and a PNG of no dots.

mod animation;
mod cast;
mod cells;
mod cursor;
mod dos;
mod encoder;
mod levels;
mod markup;
mod pictures;
mod route;
mod screen;
mod sgr;
mod terminal;
mod terminfo;

pub use animation::animated_svg;
pub use cast::Cast;
pub use cells::{ansi, text};
pub use dos::dos_ansi;
pub use encoder::Encoder;
pub use levels::{LevelsError, levels, read_levels};
pub use markup::{html, svg};
pub use pictures::{Pixels, grays_of_levels, grays_of_light, pfm_gray, pfm_vectors, pgm, png, ppm};
pub use screen::{Screen, ScreenCell, Symbol};
pub use sgr::{Color, Pen};
pub use terminal::{Capabilities, Colors, Environment, is_known};
pub use terminfo::Description;

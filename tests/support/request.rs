//! A plain request for a picture.

use ray13::frame::{Request, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::{Options, PrecisionChoice};
use ray13::scene::Camera;
use ray13::tone::Tone;

/// Square dots, all digits, and otherwise what the program does when nothing is asked for.
pub fn request(camera: Camera, dots: Size) -> Request {
    Request {
        camera,
        dots,
        dot_aspect: 1.0,
        options: Options { precision: PrecisionChoice::Double, ..Options::default() },
        wants: Wants::ALL,
        glyphs: GlyphMode::default(),
        palette: Palette::default(),
        tone: Tone::default(),
    }
}

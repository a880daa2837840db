//! The picture of the paper: its field of 40° × 25° on the 164 × 188 dots of a PC/AT, shaded by eq. (3).

use crate::glyph::{GlyphMode, Palette};
use crate::math::Size;
use crate::plan::{Options, Shading, StructureChoice};
use crate::scene::{Camera, FieldSpan};
use crate::tone::Tone;

use super::{Request, Wants};

/// Dots across and down: the nearest reading of the scan's "16⁴ × 188".
pub const DOTS: Size = Size::new(164, 188);

/// Full angles across and down, in degrees.
pub const FIELD: [f64; 2] = [40.0, 25.0];

/// Even steps of light.
pub const TONE: Tone = Tone::Even;

/// Width of a dot divided by its height, so that the field falls on the dots exactly: 1.88.
pub fn dot_aspect() -> f64 {
    let [across, down] = FIELD.map(|angle| libm::tan(0.5 * angle.to_radians()));
    across / down * f64::from(DOTS.height) / f64::from(DOTS.width)
}

/// Highlights, no shadows, and the paper's lattice.
pub fn options() -> Options {
    Options {
        shading: Shading::Phong,
        shadows: false,
        structure: StructureChoice::Lattice,
        ..Options::default()
    }
}

/// The picture that the PC/AT would have made from a camera's place.
pub fn request(camera: Camera) -> Request {
    Request {
        camera: Camera { field: FIELD, span: FieldSpan::Edges, ..camera },
        dots: DOTS,
        dot_aspect: dot_aspect(),
        options: options(),
        wants: Wants::CELLS,
        glyphs: GlyphMode::default(),
        palette: Palette::default(),
        tone: TONE,
    }
}

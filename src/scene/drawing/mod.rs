//! Plane figures of drawing files, as OpenSCAD's `import` reads them: `docs/openscad.md` says by which rules.

mod dxf;
mod fault;
mod svg;
#[cfg(test)]
mod tests;

use super::profile::Fragments;
use crate::math::DVec2;

pub use fault::DrawingFault;

/// How a drawing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawingFormat {
    /// The drawing format of `AutoCAD`.
    Dxf,
    /// Scalable Vector Graphics, of the W3C.
    Svg,
}

/// What is wanted of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingRequest {
    /// The name of the only layer to be read; all of them where it is empty.
    pub layer: String,
    /// The name of the only element of an SVG file to be read, with what it holds; all where it is empty.
    pub id: String,
    /// The place of a DXF file that comes to the origin, in its own units.
    pub origin: DVec2,
    /// By what a DXF file is scaled, after that; above 0.
    pub scale: f64,
    /// How fine the curves of a DXF file are cut.
    pub fragments: Fragments,
    /// Whether the corners of a DXF file are moved onto OpenSCAD's grid, as it exports them.
    pub is_on_grid: bool,
    /// How many dots of an SVG file are an inch long; above 0.
    pub dpi: f64,
    /// Whether the middle of an SVG file comes to the origin.
    pub is_centred: bool,
}

/// What a drawing has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingContent {
    /// The shapes that are united, each as closed outlines: what an odd number of those lie around is inside.
    pub shapes: Vec<Vec<Vec<DVec2>>>,
    /// What was left out, or is not as it looks.
    pub notes: Vec<String>,
}

impl DrawingContent {
    /// Reads a file.
    ///
    /// # Errors
    /// The first mistake in it, also that it has more than [`MOST_CORNERS`](super::profile::MOST_CORNERS).
    pub fn read(bytes: &[u8], format: DrawingFormat, request: &DrawingRequest) -> Result<Self, DrawingFault> {
        match format {
            DrawingFormat::Dxf => dxf::read(bytes, request),
            DrawingFormat::Svg => svg::read(bytes, request),
        }
    }
}

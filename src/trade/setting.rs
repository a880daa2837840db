//! One way to draw a picture, as the knobs stand.

use crate::frame::Request;
use crate::glyph::GlyphMode;
use crate::math::Size;
use crate::plan::Options;

/// Where all knobs stand. What is no knob, as the view, is the request's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// What is computed.
    pub options: Options,
    /// The characters, which say how many dots are traced for a cell.
    pub glyphs: GlyphMode,
}

impl Setting {
    /// As the knobs stand in a request.
    pub const fn of(request: &Request) -> Self {
        Self { options: request.options, glyphs: request.glyphs }
    }

    /// The picture of `base` by this setting. With other characters it has the same cells on the screen, and
    /// of dots as many as these have.
    pub fn request(&self, base: &Request) -> Request {
        let mut request = Request { options: self.options, ..base.clone() };
        if let Some(cells) = cells(base).filter(|_| self.glyphs != base.glyphs) {
            let [own, per_cell] = [base.glyphs, self.glyphs].map(GlyphMode::dots_per_cell);
            let cell_aspect = base.dot_aspect * f64::from(own.width) / f64::from(own.height);
            request.glyphs = self.glyphs;
            request.dots = Size::new(cells.width * per_cell.width, cells.height * per_cell.height);
            request.dot_aspect = self.glyphs.dot_aspect(cell_aspect);
        }
        request
    }
}

/// The cells of a picture that has characters, in cells that are all whole.
pub(super) fn cells(request: &Request) -> Option<Size> {
    let (dots, per_cell) = (request.dots, request.glyphs.dots_per_cell());
    let whole = dots.width.is_multiple_of(per_cell.width) && dots.height.is_multiple_of(per_cell.height);
    let cells = Size::new(dots.width / per_cell.width, dots.height / per_cell.height);
    (request.wants.cells && whole).then_some(cells)
}

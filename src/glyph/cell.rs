//! A character cell.

use super::paint::{ColorDepth, Paint};
use super::shape::{GlyphShape, complement};

/// One character of the screen with its two colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cell {
    /// The character; always one column wide.
    pub glyph: char,
    /// The colour of the glyph's own strokes.
    pub ink: Paint,
    /// The colour behind it.
    pub paper: Paint,
}

impl Cell {
    /// A cell of one colour: a blank, as the strokes of a full block leave seams in fonts that are scaled,
    /// and are more bytes.
    pub const fn flat(paint: Paint) -> Self {
        // The ink is that of neighbouring levels, so that it changes least.
        let ink = if matches!(paint, Paint::Black) { Paint::DarkGray } else { paint };
        Self { glyph: ' ', ink, paper: paint }
    }

    /// A cell of two colours; with ink and paper in each other's place where that spares a bright paper.
    pub fn pair(shape: GlyphShape, ink: Paint, paper: Paint) -> Self {
        if ink == paper {
            return Self::flat(ink);
        }
        match complement(shape) {
            Some(other) if paper.is_bright() && !ink.is_bright() => {
                Self { glyph: other.glyph, ink: paper, paper: ink }
            }
            _ => Self { glyph: shape.glyph, ink, paper },
        }
    }

    /// The same for a terminal of that depth.
    #[must_use]
    pub fn at(self, depth: ColorDepth) -> Self {
        let ink = self.ink.at(depth);
        // Flat cells are the most: one search does for both.
        let paper = if self.paper == self.ink { ink } else { self.paper.at(depth) };
        Self { ink, paper, ..self }
    }
}

//! A character cell.

use super::paint::{ColorDepth, Paint};
use super::shape::{Shape, complement};

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
    /// A cell of one colour. The attributes are written as the levels that they are, with a paper that every
    /// terminal has.
    pub const fn flat(paint: Paint) -> Self {
        let (glyph, ink, paper) = match paint {
            Paint::Black => (' ', Paint::DarkGray, Paint::Black),
            Paint::DarkGray => ('█', paint, Paint::Black),
            Paint::LightGray => ('█', paint, paint),
            Paint::White => ('█', paint, Paint::LightGray),
            // The terminal's own colour, where nothing is said about ink, is that of its paper.
            Paint::Terminal | Paint::Indexed(_) | Paint::Rgb(_) => (' ', paint, paint),
        };
        Self { glyph, ink, paper }
    }

    /// A cell of two colours; with ink and paper in each other's place where that spares a bright paper.
    pub fn pair(shape: Shape, ink: Paint, paper: Paint) -> Self {
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

    /// The light of the ink. The terminal's own ink counts as white.
    pub fn ink_light(self) -> f64 {
        self.ink.light().unwrap_or(1.0)
    }

    /// The light of the paper. The terminal's own paper counts as black.
    pub fn paper_light(self) -> f64 {
        self.paper.light().unwrap_or(0.0)
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

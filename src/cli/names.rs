//! What the values of options are called: glyph modes, palettes, tones, structures, engines, precisions and
//! presets.

use clap::ValueEnum;

use crate::glyph::GlyphMode;
use crate::output::Capabilities;
use crate::plan::{EngineChoice, PrecisionChoice, StructureChoice};
use crate::tone::Tone;

/// The glyph modes by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Glyphs {
    /// The finest that the terminal is known to draw; blocks in a file or a pipe
    Auto,
    /// Shades, half blocks and quadrants, whichever fits the cell best
    Blocks,
    /// The same with the DOS set only
    Cp437,
    /// 2 x 2 dots per cell
    Quadrant,
    /// Two dots per cell, one above the other
    Half,
    /// One shade per cell
    Shade,
    /// Dots of ink only, 2 x 4 per cell
    Braille,
    /// ASCII only
    Ascii,
}

impl Glyphs {
    /// The mode that is named; what `terminal` draws where none is. A file or a pipe is no terminal, and its
    /// bytes depend on nothing around it.
    pub fn mode(self, terminal: Option<Capabilities>) -> GlyphMode {
        match self {
            Self::Auto => terminal.map_or(GlyphMode::Blocks, |terminal| terminal.glyphs),
            Self::Blocks => GlyphMode::Blocks,
            Self::Cp437 => GlyphMode::Cp437,
            Self::Quadrant => GlyphMode::Quadrant,
            Self::Half => GlyphMode::Half,
            Self::Shade => GlyphMode::Shade,
            Self::Braille => GlyphMode::Braille,
            Self::Ascii => GlyphMode::Ascii,
        }
    }
}

/// The palettes by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PaletteName {
    /// The four grays of a PC: by the attributes that are the terminal's own grays, else by number of its 256
    /// colours
    Dos,
    /// The four grays by attributes 0, 8, 7 and 15, taken for those of a PC whatever the terminal has made of
    /// them
    Dos16,
    /// The 13 levels themselves as ink and paper, on terminals of 256 or more colours
    Gray,
    /// The terminal's own ink and paper
    Mono,
    /// Any colour as ink and paper, on terminals of 256 or more colours
    Color,
}

/// The tones by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ToneName {
    /// The level nearest in lightness
    Lightness,
    /// Even steps of 1/12, as in 1986
    Even,
}

impl From<ToneName> for Tone {
    fn from(name: ToneName) -> Self {
        match name {
            ToneName::Lightness => Self::Lightness,
            ToneName::Even => Self::Even,
        }
    }
}

/// The structures by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StructureName {
    /// Whatever suits the scene
    Auto,
    /// Every ray against every object
    None,
    /// The paper's lattice
    Lattice,
    /// Lattices within lattices
    Tree,
    /// Boxes around boxes
    Boxes,
}

impl From<StructureName> for StructureChoice {
    fn from(name: StructureName) -> Self {
        match name {
            StructureName::Auto => Self::Auto,
            StructureName::None => Self::None,
            StructureName::Lattice => Self::Lattice,
            StructureName::Tree => Self::Tree,
            StructureName::Boxes => Self::Boxes,
        }
    }
}

/// The engines by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EngineName {
    /// The fast one, unless another structure than boxes is asked for
    Auto,
    /// Rays side by side, in tiles, through boxes
    Fast,
    /// One ray after the other: the reference, which the fast one asks where it is uncertain
    Exact,
}

impl From<EngineName> for EngineChoice {
    fn from(name: EngineName) -> Self {
        match name {
            EngineName::Auto => Self::Auto,
            EngineName::Fast => Self::Fast,
            EngineName::Exact => Self::Exact,
        }
    }
}

/// The precisions by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PrecisionName {
    /// Single precision where that saves time and nobody sees it: not in pfm
    Auto,
    /// Single precision
    Single,
    /// All
    Double,
}

impl From<PrecisionName> for PrecisionChoice {
    fn from(name: PrecisionName) -> Self {
        match name {
            PrecisionName::Auto => Self::Auto,
            PrecisionName::Single => Self::Single,
            PrecisionName::Double => Self::Double,
        }
    }
}

/// The presets by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// The picture of 1986: 40 x 25 degrees on 164 x 188 dots, which are 1.88 times as wide as high, with
    /// --shading 3 --no-shadows --tone even --structure lattice. --dots or --cells make dots of their own
    /// shape, --field is contained in the picture as ever
    Pcat,
}

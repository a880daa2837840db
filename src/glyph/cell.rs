//! A character cell and the choices that decide what may stand in it.

use crate::math::Size;
use crate::tone::GRAYS;

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

/// A colour of ink or paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Paint {
    /// Whatever the terminal uses when nothing is asked for.
    Terminal,
    /// Attribute 0.
    Black,
    /// Attribute 8.
    DarkGray,
    /// Attribute 7.
    LightGray,
    /// Attribute 15.
    White,
}

impl Paint {
    /// The linear light, 0 to 1, of one of the four grays; `None` for the terminal's own colours, which nothing knows.
    pub const fn light(self) -> Option<f64> {
        match self {
            Self::Terminal => None,
            Self::Black => Some(GRAYS[0]),
            Self::DarkGray => Some(GRAYS[1]),
            Self::LightGray => Some(GRAYS[2]),
            Self::White => Some(GRAYS[3]),
        }
    }
}

impl Cell {
    /// The light of the ink. The terminal's own ink counts as white.
    pub fn ink_light(self) -> f64 {
        self.ink.light().unwrap_or(1.0)
    }

    /// The light of the paper. The terminal's own paper counts as black.
    pub fn paper_light(self) -> f64 {
        self.paper.light().unwrap_or(0.0)
    }
}

/// Which characters draw the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GlyphMode {
    /// Shades, half blocks and quadrants, whichever fits the cell best.
    #[default]
    Blocks,
    /// The same with the DOS set only, paper black or light gray.
    Cp437,
    /// One shade per cell: one of the 13 levels exactly.
    Shade,
    /// A ramp of 13 ASCII characters.
    Ascii,
}

impl GlyphMode {
    /// All modes, in the order the viewer steps through.
    pub const ALL: [Self; 4] = [Self::Blocks, Self::Cp437, Self::Shade, Self::Ascii];

    /// Traced dots per cell.
    pub const fn dots_per_cell(self) -> Size {
        match self {
            Self::Blocks | Self::Cp437 => Size::new(2, 4),
            Self::Shade | Self::Ascii => Size::new(1, 1),
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blocks => "blocks",
            Self::Cp437 => "cp437",
            Self::Shade => "shade",
            Self::Ascii => "ascii",
        }
    }
}

/// Which colours draw the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Palette {
    /// The four grays of 16-colour attributes.
    #[default]
    Dos,
    /// The terminal's own ink and paper only.
    Mono,
}

impl Palette {
    /// The inks.
    pub const fn inks(self) -> &'static [Paint] {
        match self {
            Self::Dos => &[Paint::Black, Paint::LightGray, Paint::DarkGray, Paint::White],
            Self::Mono => &[Paint::Terminal],
        }
    }

    /// The papers, those first that every terminal has: a Linux console has no bright ones.
    pub const fn papers(self) -> &'static [Paint] {
        self.inks()
    }

    /// The papers that every terminal has.
    pub const fn dim_papers(self) -> &'static [Paint] {
        match self {
            Self::Dos => &[Paint::Black, Paint::LightGray],
            Self::Mono => &[Paint::Terminal],
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dos => "dos",
            Self::Mono => "mono",
        }
    }
}

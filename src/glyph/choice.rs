//! The choices that decide what may stand in a cell.

use super::paint::{ColorDepth, Paint};
use crate::math::Size;

/// Width of a character cell divided by its height, where nothing better is known: most fonts of terminals are
/// about twice as high as wide.
pub const CELL_ASPECT: f64 = 0.5;

/// Which characters draw the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GlyphMode {
    /// Shades, half blocks and quadrants, whichever fits the cell best.
    #[default]
    Blocks,
    /// The same with the DOS set only, paper black or light gray.
    Cp437,
    /// Quadrants: each dot a gray of its own, as far as two colours go.
    Quadrant,
    /// Half blocks: two dots, each with its gray.
    Half,
    /// One shade per cell: one of the 13 levels exactly.
    Shade,
    /// Braille: the ink of each of 2 × 4 dots, or none.
    Braille,
    /// A ramp of 13 ASCII characters.
    Ascii,
}

impl GlyphMode {
    /// All modes, in the order the viewer steps through.
    pub const ALL: [Self; 7] =
        [Self::Blocks, Self::Cp437, Self::Quadrant, Self::Half, Self::Shade, Self::Braille, Self::Ascii];

    /// Width of a traced dot on the screen divided by its height, where a cell's is `cell_aspect`.
    pub fn dot_aspect(self, cell_aspect: f64) -> f64 {
        let dots = self.dots_per_cell();
        cell_aspect * f64::from(dots.height) / f64::from(dots.width)
    }

    /// Traced dots per cell.
    pub const fn dots_per_cell(self) -> Size {
        match self {
            Self::Blocks | Self::Cp437 | Self::Braille => Size::new(2, 4),
            Self::Quadrant => Size::new(2, 2),
            Self::Half => Size::new(1, 2),
            Self::Shade | Self::Ascii => Size::new(1, 1),
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blocks => "blocks",
            Self::Cp437 => "cp437",
            Self::Quadrant => "quadrant",
            Self::Half => "half",
            Self::Shade => "shade",
            Self::Braille => "braille",
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
    /// The 13 levels themselves as ink and paper, on a terminal of that depth.
    Gray(ColorDepth),
    /// The terminal's own ink and paper only.
    Mono,
    /// Any colour as ink and paper, on a terminal of that depth; no levels.
    Color(ColorDepth),
}

impl Palette {
    /// The inks among the attributes; none for the palettes that give a colour by number.
    pub const fn inks(self) -> &'static [Paint] {
        match self {
            Self::Dos => &[Paint::Black, Paint::LightGray, Paint::DarkGray, Paint::White],
            Self::Mono => &[Paint::Terminal],
            Self::Gray(_) | Self::Color(_) => &[],
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
            _ => self.papers(),
        }
    }

    /// Whether the picture needs the light of each primary.
    pub const fn is_color(self) -> bool {
        matches!(self, Self::Color(_))
    }

    /// How exactly the terminal is told a colour, where it is told one by number.
    pub const fn depth(self) -> ColorDepth {
        match self {
            Self::Gray(depth) | Self::Color(depth) => depth,
            Self::Dos | Self::Mono => ColorDepth::Direct,
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dos => "dos",
            Self::Gray(_) => "gray",
            Self::Mono => "mono",
            Self::Color(_) => "color",
        }
    }
}

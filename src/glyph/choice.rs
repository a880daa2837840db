//! The choices that decide what may stand in a cell.

use super::cell::Cell;
use super::grays::FourGrays;
use super::paint::{ColorDepth, Paint};
use crate::math::Size;

/// Width of a character cell divided by its height, where nothing better is known: most fonts of terminals
/// are about twice as high as wide.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Palette {
    /// Four grays, as the attributes of 16-colour terminals are.
    Dos(FourGrays),
    /// The 13 levels themselves as ink and paper, on a terminal of that depth.
    Gray(ColorDepth),
    /// The terminal's own ink and paper only.
    Mono(Ground),
    /// Any colour as ink and paper, on a terminal of that depth; no levels.
    Color(ColorDepth),
}

/// What the terminal's own paper is, against its ink.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ground {
    /// Dark: ink is light.
    #[default]
    Dark,
    /// Light, so ink is dark, and is put where the picture is dark.
    Light,
}

impl Default for Palette {
    fn default() -> Self {
        Self::DOS
    }
}

impl Palette {
    /// The four grays of a PC's attributes.
    pub const DOS: Self = Self::Dos(FourGrays::VGA);
    /// The terminal's own ink on dark paper.
    pub const MONO: Self = Self::Mono(Ground::Dark);

    /// The inks that edges have, of colors that every cell can be given; none for the palettes of many
    /// colors. Dim ones first, so that they become papers: a Linux console has no bright ones.
    pub fn inks(self) -> Vec<Paint> {
        match self {
            Self::Dos(grays) => {
                let [black, dark, light, white] = grays.paints();
                vec![black, light, dark, white]
            }
            Self::Mono(_) => vec![Paint::Terminal],
            Self::Gray(_) | Self::Color(_) => Vec::new(),
        }
    }

    /// The palette that these glyphs have of it: ASCII and Braille have no paper but the terminal's own,
    /// which is dark or light, and no ink but its own where there is no color.
    #[must_use]
    pub const fn for_glyphs(self, glyphs: GlyphMode, ground: Ground) -> Self {
        match (self, glyphs) {
            (Self::Color(_), _) => self,
            (Self::Mono(_), _) | (_, GlyphMode::Ascii | GlyphMode::Braille) => Self::Mono(ground),
            _ => self,
        }
    }

    /// Whether each dot can have the gray of its level. Where it can not, a mode in which each dot has its
    /// own place is a coarse chequer.
    pub const fn has_levels(self) -> bool {
        matches!(self, Self::Gray(_) | Self::Color(_))
    }

    /// What stands behind the terminal's own ink.
    pub const fn ground(self) -> Ground {
        match self {
            Self::Mono(ground) => ground,
            Self::Dos(_) | Self::Gray(_) | Self::Color(_) => Ground::Dark,
        }
    }

    /// The linear light of a cell's ink, 0 to 1.
    pub fn ink_light(self, cell: Cell) -> f64 {
        self.light(cell.ink).unwrap_or(if self.ground() == Ground::Dark { 1.0 } else { 0.0 })
    }

    /// The linear light of a cell's paper, 0 to 1.
    pub fn paper_light(self, cell: Cell) -> f64 {
        self.light(cell.paper).unwrap_or(if self.ground() == Ground::Dark { 0.0 } else { 1.0 })
    }

    fn light(self, paint: Paint) -> Option<f64> {
        match self {
            Self::Dos(grays) => grays.light(paint).or_else(|| paint.light()),
            _ => paint.light(),
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
            Self::Dos(_) | Self::Mono(_) => ColorDepth::Direct,
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dos(_) => "dos",
            Self::Gray(_) => "gray",
            Self::Mono(_) => "mono",
            Self::Color(_) => "color",
        }
    }
}

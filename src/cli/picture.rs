//! From arguments to a request.

use crate::app::Questions;
use crate::frame::{MOST_DOTS, Request, Studio, Wants, pcat};
use crate::glyph::{CELL_ASPECT, FourGrays, GlyphMode, Ground, Palette};
use crate::math::Size;
use crate::output::Capabilities;
use crate::plan::{CUTOFF, DEPTH, ERROR, EngineChoice, Options, Shading, StructureChoice};
use crate::scene::{Camera, FieldSpan, Scene};
use crate::tone::Tone;

use super::arguments::{CameraArguments, PictureArguments};
use super::error::CliError;
use super::names::{AntiAliasing, Glyphs, PaletteName, Preset};
use super::terminal::capabilities;
use super::up::Up;

/// The screen that is assumed where there is none.
const SCREEN: Size = Size::new(80, 25);

/// The dots of pixels and raw values where no size is given: those of a PC's largest graphics screen of the
/// time, and in the shape of [`SCREEN`], whose cells are twice as high as wide.
pub const PIXELS: Size = Size::new(640, 400);

/// How large a picture is for which no size is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsized {
    /// As many dots as the terminal's cells have.
    Screen,
    /// [`PIXELS`].
    Pixels,
    /// As many dots as the cells of a PC's screen have.
    Dos,
}

/// A PC's screen of text.
const DOS_SCREEN: Size = Size { width: 80, height: 25 };

/// Rays per dot along each axis where only `--aa fixed` is given: 16 in all leave one dot in a hundred with
/// another level than any number would (docs/performance.md).
const FIXED_SAMPLES: u32 = 4;

/// How a picture is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Characters.
    pub glyphs: GlyphMode,
    /// Colours.
    pub palette: Palette,
}

impl PictureArguments {
    /// What the plan is made from. Fails for options that rule each other out.
    pub fn options(&self) -> Result<Options, CliError> {
        let preset = self.preset.map_or_else(Options::default, |Preset::Pcat| pcat::options());
        let shading = Shading::ALL.into_iter().find(|s| Some(s.number()) == self.shading);
        let engine = EngineChoice::from(self.engine);
        // What is given has the last word: an engine, before the structure of a preset.
        let structure = if engine == EngineChoice::Fast { StructureChoice::Auto } else { preset.structure };
        let options = Options {
            shading: shading.unwrap_or(preset.shading),
            depth: self.depth.unwrap_or(DEPTH),
            cutoff: self.cutoff.unwrap_or(CUTOFF),
            shadows: self.shadows || (preset.shadows && !self.no_shadows),
            structure: self.structure.map_or(structure, Into::into),
            engine,
            precision: self.precision.into(),
            samples: self.samples_per_axis(),
            adaptive: (self.anti_aliasing() == AntiAliasing::Adaptive).then(|| self.error.unwrap_or(ERROR)),
            color: false,
            threads: self.threads.map_or(0, usize::from),
        };
        let checked = options.check().map(|()| options);
        checked.map_err(|e| CliError::Input(format!("{e}: leave out --engine or --structure")))
    }

    /// What is asked for, by name or by what only it takes.
    pub fn anti_aliasing(&self) -> AntiAliasing {
        let meant = match (self.samples, self.error) {
            (_, Some(_)) => AntiAliasing::Adaptive,
            (Some(_), None) => AntiAliasing::Fixed,
            (None, None) => AntiAliasing::Off,
        };
        self.aa.unwrap_or(meant)
    }

    /// Whether no option says how many rays a dot has, as the picture of 1986 does: one.
    pub const fn says_nothing_of_rays(&self) -> bool {
        self.preset.is_none() && self.aa.is_none() && self.samples.is_none() && self.error.is_none()
    }

    fn samples_per_axis(&self) -> u32 {
        match self.anti_aliasing() {
            AntiAliasing::Fixed => self.samples.unwrap_or(FIXED_SAMPLES),
            AntiAliasing::Off | AntiAliasing::Adaptive => 1,
        }
    }

    /// How light becomes a level.
    pub fn tone(&self) -> Tone {
        let preset = self.preset.map_or_else(Tone::default, |Preset::Pcat| pcat::TONE);
        self.tone.map_or(preset, Into::into)
    }

    /// Whether anything says where the picture is seen from, but a view's name.
    pub fn moves_camera(&self) -> bool {
        self.preset.is_some() || self.camera.replaces_anything()
    }

    /// The view's camera with what is given in its place.
    pub fn camera(&self, studio: &Studio, aspect: f64) -> Result<Camera, CliError> {
        self.camera.camera(studio, aspect, self.preset.map(|Preset::Pcat| pcat::FIELD))
    }

    /// Characters and colours asked for; else those that `terminal` has, where a terminal is meant.
    pub fn look(&self, terminal: Option<Capabilities>) -> Look {
        let glyphs = self.glyphs.unwrap_or(Glyphs::Auto).mode(terminal);
        Look { glyphs, palette: self.palette(terminal).for_glyphs(glyphs, self.ground()) }
    }

    /// What the terminal's own paper is taken for, where nothing is known of it.
    pub fn ground(&self) -> Ground {
        if self.invert { Ground::Light } else { Ground::Dark }
    }

    /// What the viewer asks the terminal for: what no option says.
    pub fn questions(&self) -> Questions {
        Questions {
            grays: self.palette != Some(PaletteName::Dos16),
            ground: !(self.invert || self.no_invert),
        }
    }

    /// The palette asked for; else what the terminal and `NO_COLOR` (<https://no-color.org>) leave.
    pub fn palette(&self, terminal: Option<Capabilities>) -> Palette {
        // In a file they are meant for a terminal like the one here.
        let here = || terminal.unwrap_or_else(capabilities);
        let depth = || here().color_depth();
        // Nothing answers a still, and people change the attributes' colours; those by number they leave.
        let four_grays =
            || if here().has_256_colors() { Palette::Dos(FourGrays::Indexed) } else { Palette::DOS };
        let ground = self.ground();
        match self.palette {
            Some(PaletteName::Gray) => Palette::Gray(depth()),
            Some(PaletteName::Mono) => Palette::Mono(ground),
            Some(PaletteName::Color) => Palette::Color(depth()),
            Some(PaletteName::Dos16) => Palette::DOS,
            None if no_color() || terminal.is_some_and(|terminal| !terminal.has_grays()) => {
                Palette::Mono(ground)
            }
            Some(PaletteName::Dos) | None => four_grays(),
        }
    }

    /// The request for one picture.
    pub fn request(
        &self,
        studio: &Studio,
        look: Look,
        wants: Wants,
        size: Unsized,
    ) -> Result<Request, CliError> {
        let Look { glyphs, palette } = look;
        let per_cell = glyphs.dots_per_cell();
        let (dots, dot_aspect) = if let Some(dots) = self.dots {
            (dots, 1.0)
        } else if let (None, Some(Preset::Pcat)) = (self.cells, self.preset) {
            (pcat::DOTS, pcat::dot_aspect())
        } else if let (None, Unsized::Pixels) = (self.cells, size) {
            (PIXELS, 1.0)
        } else {
            let unsized_screen = || if size == Unsized::Dos { DOS_SCREEN } else { screen() };
            let cells = self.cells.unwrap_or_else(unsized_screen);
            let dots = Size::new(cells.width * per_cell.width, cells.height * per_cell.height);
            (dots, glyphs.dot_aspect(CELL_ASPECT))
        };
        if dots.area() > MOST_DOTS {
            let Size { width, height } = dots;
            return Err(CliError::Input(format!(
                "the picture would have {width} × {height} traced dots, more than {MOST_DOTS} in all"
            )));
        }
        let aspect = f64::from(dots.width) / f64::from(dots.height) * dot_aspect;
        let camera = self.camera(studio, aspect)?;
        Ok(Request {
            camera,
            dots,
            dot_aspect,
            options: self.options()?,
            wants,
            glyphs,
            palette,
            tone: self.tone(),
        })
    }
}

/// Whether the user wants no colours anywhere (<https://no-color.org>).
pub fn no_color() -> bool {
    std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
}

/// The terminal's cells, less the line that the shell's prompt comes to stand on.
fn screen() -> Size {
    use std::io::IsTerminal;
    if !std::io::stdout().is_terminal() {
        return SCREEN;
    }
    match crossterm::terminal::size() {
        Ok((width, height)) if width > 0 && height > 1 => Size::new(width.into(), u32::from(height) - 1),
        _ => SCREEN,
    }
}

impl CameraArguments {
    /// Whether anything but a view's name is given.
    pub fn replaces_anything(&self) -> bool {
        self.eye.is_some()
            || self.target.is_some()
            || self.up.is_some()
            || self.field.is_some()
            || self.zoom.is_some()
    }

    /// Whether all is given that a view says.
    pub fn replaces_view(&self) -> bool {
        self.eye.is_some()
            && self.target.is_some()
            && self.up.is_some()
            && self.field.is_some()
            && self.zoom.is_some()
    }

    /// The index of the view that is named.
    pub fn view_index(&self, scene: &Scene) -> Result<Option<usize>, CliError> {
        let Some(name) = self.view.as_deref() else { return Ok(None) };
        let found = scene.views.iter().position(|v| v.name.as_deref() == Some(name));
        found.map(Some).ok_or_else(|| {
            let names: Vec<&str> = scene.views.iter().filter_map(|v| v.name.as_deref()).collect();
            let known = if names.is_empty() {
                "it names none".to_owned()
            } else {
                format!("it has {}", names.join(", "))
            };
            CliError::Input(format!("the scene has no view `{name}`: {known}"))
        })
    }

    /// The view's camera with what is given in its place; `field` stands before the view's own.
    fn camera(&self, studio: &Studio, aspect: f64, field: Option<[f64; 2]>) -> Result<Camera, CliError> {
        let field = self.field.or(field);
        let base = studio.camera(self.view_index(studio.scene())?.unwrap_or(0), aspect);
        let camera = Camera {
            eye: self.eye.unwrap_or(base.eye),
            target: self.target.unwrap_or(base.target),
            up: self.up.and_then(Up::direction).unwrap_or(base.up),
            field: field.unwrap_or(base.field),
            span: if field.is_some() { FieldSpan::Edges } else { base.span },
            zoom: self.zoom.unwrap_or(base.zoom),
            ..base
        };
        camera.check().map_err(|e| CliError::Input(e.to_string()))?;
        Ok(camera)
    }
}

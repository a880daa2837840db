//! What the viewer knows, and how each action changes it. No terminal, no thread, no clock.

use ratatui::layout::Size;

use super::keys::Action;
use super::layout::Layout;
use super::motion::{self, FLY_STEP, ORBIT_STEP, ZOOM_STEP};
use super::{Painter, Settings};
use crate::frame::Request;
use crate::glyph::GlyphMode;
use crate::math;
use crate::plan::Shading;
use crate::scene::Camera;
use crate::view::{Lens, Picture};

/// Width of a cell divided by its height, where the terminal does not say.
const CELL_ASPECT: f64 = 0.5;

/// The widths of a cell divided by its height that are believed: fonts for text are taller than wide, up to the
/// square cells of some consoles; terminals that report nonsense report it far outside.
const CELL_ASPECTS: std::ops::RangeInclusive<f64> = 0.25..=1.0;

/// The state of the viewer.
#[derive(Clone, Debug)]
pub struct Model {
    /// What the person asked for, as changed by keys.
    pub settings: Settings,
    /// From where the scene is seen now.
    pub camera: Camera,
    /// Whether the camera has left its view.
    pub moved: bool,
    /// Whether the keys are shown.
    pub help: bool,
    /// What the reader left out, for the person who looks.
    pub notes: Vec<String>,
    /// Where things stand.
    pub layout: Layout,
    views: usize,
    cell_aspect: f64,
}

/// What an action asks of the world around the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Nothing beyond the model.
    None,
    /// Stop until the shell continues us.
    Suspend,
    /// End.
    Quit,
}

/// What the terminal reports of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// Columns and rows; 0 where it does not say.
    pub cells: Size,
    /// Width and height of all cells in pixels; 0 where it does not say.
    pub pixels: Size,
}

impl Window {
    /// Width of a cell divided by its height; 1:2 where the terminal does not say or what it says is no cell.
    fn cell_aspect(self) -> f64 {
        let width = f64::from(self.pixels.width) / f64::from(self.cells.width);
        let height = f64::from(self.pixels.height) / f64::from(self.cells.height);
        // A size of 0 gives a NaN or an infinity, which no range contains.
        Some(width / height).filter(|aspect| CELL_ASPECTS.contains(aspect)).unwrap_or(CELL_ASPECT)
    }
}

impl Model {
    /// The viewer before the first key.
    pub fn new(painter: &dyn Painter, settings: Settings, window: Window) -> Self {
        let layout = Layout::new(window.cells);
        let mut model = Self {
            camera: painter.camera(settings.view, 1.0),
            settings,
            moved: false,
            help: false,
            notes: painter.scene().notes.clone(),
            layout,
            views: painter.scene().views.len(),
            cell_aspect: window.cell_aspect(),
        };
        model.go_home(painter);
        model
    }

    /// Takes the size that the terminal has now. A view that nobody has moved is framed anew.
    pub fn resize(&mut self, painter: &dyn Painter, window: Window) {
        self.layout = Layout::new(window.cells);
        self.cell_aspect = window.cell_aspect();
        if !self.moved {
            self.go_home(painter);
        }
    }

    /// Does what a key asks for. While the keys are shown, any key hides them and does nothing else, but the
    /// one that suspends still does.
    pub fn update(&mut self, painter: &dyn Painter, action: Option<Action>) -> Effect {
        if std::mem::take(&mut self.help) && action != Some(Action::Suspend) {
            return Effect::None;
        }
        let Some(action) = action else { return Effect::None };
        let camera = &self.camera;
        match action {
            Action::OrbitLeft => self.look(motion::orbit(camera, -ORBIT_STEP, 0.0)),
            Action::OrbitRight => self.look(motion::orbit(camera, ORBIT_STEP, 0.0)),
            Action::OrbitUp => self.look(motion::orbit(camera, 0.0, ORBIT_STEP)),
            Action::OrbitDown => self.look(motion::orbit(camera, 0.0, -ORBIT_STEP)),
            Action::FlyForward => self.look(motion::fly(camera, FLY_STEP, 0.0, 0.0)),
            Action::FlyBack => self.look(motion::fly(camera, -FLY_STEP, 0.0, 0.0)),
            Action::FlyLeft => self.look(motion::fly(camera, 0.0, -FLY_STEP, 0.0)),
            Action::FlyRight => self.look(motion::fly(camera, 0.0, FLY_STEP, 0.0)),
            Action::Rise => self.look(motion::fly(camera, 0.0, 0.0, FLY_STEP)),
            Action::Sink => self.look(motion::fly(camera, 0.0, 0.0, -FLY_STEP)),
            Action::ZoomIn => self.look(motion::zoom(camera, ZOOM_STEP)),
            Action::ZoomOut => self.look(motion::zoom(camera, 1.0 / ZOOM_STEP)),
            Action::NextView => self.go_to_view(painter, 1),
            Action::PreviousView => self.go_to_view(painter, self.views.saturating_sub(1)),
            Action::Home => self.go_home(painter),
            Action::ShadingDown => self.settings.options.shading = self.shading(usize::checked_sub),
            Action::ShadingUp => self.settings.options.shading = self.shading(usize::checked_add),
            Action::NextGlyphs => self.settings.glyphs = after(&GlyphMode::ALL, self.settings.glyphs),
            Action::Help => self.help = true,
            Action::Suspend => return Effect::Suspend,
            Action::Quit => return Effect::Quit,
        }
        Effect::None
    }

    /// The picture that belongs to the state; absent where the screen has no room for a single dot.
    pub fn request(&self) -> Option<Request> {
        let cells = self.layout.picture;
        let per_cell = self.settings.glyphs.dots_per_cell();
        let dots = math::Size::new(
            u32::from(cells.width) * per_cell.width,
            u32::from(cells.height) * per_cell.height,
        );
        (dots.area() > 0).then(|| Request {
            camera: self.camera.clone(),
            dots,
            dot_aspect: self.cell_aspect * f64::from(per_cell.height) / f64::from(per_cell.width),
            options: self.settings.options,
            glyphs: self.settings.glyphs,
            palette: self.settings.palette,
            tone: self.settings.tone,
        })
    }

    /// The field of the picture, zoomed and widened to its shape: full angles across and down, in degrees.
    pub fn field(&self) -> [f64; 2] {
        self.request().map_or(self.camera.field, |request| {
            let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
            Lens::new(&self.camera, &picture).field()
        })
    }

    /// What the picture's panel calls the view.
    pub fn view_name(&self) -> String {
        let name = match &self.camera.name {
            Some(name) => name.clone(),
            None if self.views == 0 => "whole".to_owned(),
            None => (self.settings.view + 1).to_string(),
        };
        if self.moved { name + "*" } else { name }
    }

    fn look(&mut self, camera: Camera) {
        self.moved |= camera != self.camera;
        self.camera = camera;
    }

    fn go_to_view(&mut self, painter: &dyn Painter, further: usize) {
        // From a camera of one's own the first stop is the view it stands for.
        if self.settings.camera.take().is_none() {
            self.settings.view = (self.settings.view + further) % self.views.max(1);
        }
        self.go_home(painter);
    }

    fn go_home(&mut self, painter: &dyn Painter) {
        let picture = self.layout.picture;
        let aspect = self.cell_aspect * f64::from(picture.width) / f64::from(picture.height.max(1));
        let view = || painter.camera(self.settings.view, aspect);
        self.camera = self.settings.camera.clone().unwrap_or_else(view);
        self.moved = false;
    }

    /// The shading model one step away, or the present one where there is none.
    fn shading(&self, step: impl Fn(usize, usize) -> Option<usize>) -> Shading {
        let now = self.settings.options.shading;
        let place = Shading::ALL.iter().position(|&model| model == now);
        place
            .and_then(|place| step(place, 1))
            .and_then(|place| Shading::ALL.get(place))
            .copied()
            .unwrap_or(now)
    }
}

/// The element after `now`, the first after the last.
fn after<T: Copy + PartialEq>(all: &[T], now: T) -> T {
    let next = all.iter().skip_while(|&&one| one != now).nth(1);
    next.or(all.first()).copied().unwrap_or(now)
}

//! What the viewer knows, and how each action changes it. No terminal, no thread, no clock.

use std::path::PathBuf;

use super::actions::{Action, StandardView};
use super::desk::{Desk, SaveOrder};
use super::follow_order::{FollowOrder, FollowedDot};
use super::following::Following;
use super::layout::{Layout, Panelling};
use super::motion::{self, FLY_STEP, ORBIT_STEP, ZOOM_STEP};
use super::pace::Pace;
use super::theme::Theme;
use super::trade_panel::TradePanel;
use super::window::Window;
use super::{Painter, Settings};
use crate::frame::{Request, Wants};
use crate::math;
use crate::scene::Camera;
use crate::view::{Picture, PinholeCamera};

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
    /// How fast pictures are drawn.
    pub pace: Pace,
    /// The menu or the dialog that is open.
    pub desk: Option<Desk>,
    /// What was done, until the next key.
    pub told: Option<String>,
    /// Whether the key before was an Esc that closed nothing.
    pub escaped: bool,
    /// The ray that is followed, where one is.
    pub following: Option<Following>,
    /// The trade of time for accuracy, where it is looked at.
    pub trade: Option<TradePanel>,
    /// What the reader left out, for the person who looks.
    pub notes: Vec<String>,
    /// Why the scene's file is no scene now, where it is none: what is shown is what it was before.
    pub mistake: Option<String>,
    /// Where things stand.
    pub layout: Layout,
    /// How many views the scene has.
    pub views: usize,
    /// Width of a character cell divided by its height.
    pub cell_aspect: f64,
    /// Where the eye was before it jumped, the last behind.
    pub history: Vec<Camera>,
    /// A camera of draughtsmen, and whose it is, where the eye went there.
    pub standing: Option<(Camera, StandardView)>,
    /// Whether panels are wanted where they have room.
    panelling: Panelling,
    window: Window,
}

/// What a picture shows, and how.
#[derive(Clone, Debug)]
pub struct Subject {
    settings: Settings,
    camera: Camera,
    moved: bool,
}

/// What an action asks of the world around the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Nothing beyond the model.
    None,
    /// Send the whole screen once more.
    Redraw,
    /// Stop until the shell continues us.
    Suspend,
    /// Read this scene, and show it.
    Open(String),
    /// Measure the trade of the picture.
    Measure,
    /// Save the picture.
    Save(SaveOrder),
    /// Add a line to a file.
    Append(PathBuf, String),
    /// End.
    Quit,
}

impl Model {
    /// The viewer before the first key.
    pub fn new(painter: &dyn Painter, settings: Settings, window: Window) -> Self {
        let panelling = Panelling::default();
        let mut model = Self {
            camera: painter.camera(settings.view, 1.0),
            pace: Pace::new(!settings.slow),
            settings,
            moved: false,
            help: false,
            desk: None,
            told: None,
            escaped: false,
            following: None,
            trade: None,
            notes: painter.scene().notes.clone(),
            mistake: None,
            layout: Layout::new(window.cells, panelling),
            views: painter.scene().views.len(),
            cell_aspect: window.cell_aspect(),
            history: Vec::new(),
            standing: None,
            panelling,
            window,
        };
        model.go_home(painter);
        model
    }

    /// Takes the size that the terminal has now. A view that nobody has moved is framed anew.
    pub fn resize(&mut self, painter: &dyn Painter, window: Window) {
        self.window = window;
        self.layout = Layout::new(window.cells, self.panelling);
        self.cell_aspect = window.cell_aspect();
        if !self.moved {
            self.go_home(painter);
        }
    }

    /// Shows another scene, from where the one before is seen. Only a view that the scene itself gives, and
    /// that nobody has moved, is where the scene has it now.
    pub fn reload(&mut self, painter: &dyn Painter) {
        let scene = painter.scene();
        self.notes.clone_from(&scene.notes);
        // What was measured is another scene's.
        (self.mistake, self.trade) = (None, None);
        self.views = scene.views.len();
        let is_named = |view: &Camera| view.name.is_some() && view.name == self.camera.name;
        let same = scene.views.iter().position(is_named);
        self.settings.view = same.unwrap_or(self.settings.view.min(self.views.saturating_sub(1)));
        if !self.moved && self.views > 0 {
            self.go_home(painter);
        }
        if let Some(following) = &mut self.following {
            following.forget();
        }
    }

    /// Shows another scene in the place of this one, from its first view.
    pub fn open(&mut self, painter: &dyn Painter, title: String, folder: PathBuf) {
        let settings = &mut self.settings;
        (settings.title, settings.folder, settings.view, settings.camera) = (title, folder, 0, None);
        (self.desk, self.following, self.standing, self.trade) = (None, None, None, None);
        self.history.clear();
        self.reload(painter);
        self.go_home(painter);
    }

    /// The ray that is to be followed; absent where none is, or what is wanted is told of already.
    pub fn follow_order(&self) -> Option<FollowOrder> {
        self.following.as_ref()?.order(self.request()?)
    }

    /// Tells of a ray, where one is still followed.
    pub fn tell(&mut self, followed: FollowedDot) {
        if let Some(following) = &mut self.following {
            following.tell(followed);
        }
    }

    /// Does what a key asks for. While the keys are shown, any key hides them and does nothing else, but the
    /// one that suspends still does.
    pub fn update(&mut self, painter: &dyn Painter, action: Option<Action>) -> Effect {
        if std::mem::take(&mut self.help) && action != Some(Action::Suspend) {
            return Effect::None;
        }
        let Some(action) = action else { return Effect::None };
        let cells = self.request().map(|request| request.cells());
        if let (Some(following), Some(cells)) = (&mut self.following, cells)
            && following.takes(cells, action)
        {
            return Effect::None;
        }
        if let Some(trade) = &mut self.trade
            && trade.takes(action)
        {
            if let Some(setting) = trade.present() {
                (self.settings.options, self.settings.glyphs) = (setting.options, setting.glyphs);
                // At rest the picture is what was chosen, and not finer.
                self.settings.adaptive_at_rest = false;
            }
            return Effect::None;
        }
        let measured = self.trade.as_ref().map(|_| self.camera.clone());
        let effect = if self.opens(painter, action) { Effect::None } else { self.act(painter, action) };
        if self.trade.is_some() && measured.is_some_and(|camera| camera != self.camera) {
            self.trade = None;
            self.told = Some("what was measured is another view's: F6 measures this one".to_owned());
        }
        effect
    }

    fn act(&mut self, painter: &dyn Painter, action: Action) -> Effect {
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
            Action::Standard(view) => self.go_to_standard(painter, view),
            Action::Home => {
                self.remember();
                self.go_home(painter);
            }
            Action::FitAll => self.fit_all(painter),
            Action::LastView => self.go_back(),
            Action::ShadingDown => self.settings.options.shading = self.shading(usize::checked_sub),
            Action::ShadingUp => self.settings.options.shading = self.shading(usize::checked_add),
            Action::NextGlyphs => self.settings.glyphs = self.next_glyphs(),
            Action::Follow => {
                self.following = if self.following.is_some() { None } else { Some(Following::middle()) };
                self.trade = None;
            }
            Action::Lattice => {
                self.trade = None;
                self.following.get_or_insert_with(Following::middle).show_lattice();
            }
            // There is no ray whose steps these are; and what opens has been opened above.
            Action::StepBack
            | Action::StepOn
            | Action::Menu
            | Action::Open
            | Action::View
            | Action::Glyphs
            | Action::Save => {}
            Action::Help => self.help = true,
            // The keys have been closed above.
            Action::Close => (self.following, self.trade) = (None, None),
            Action::Trade => {
                if self.trade.take().is_none() {
                    (self.trade, self.following) = (Some(TradePanel::Measuring(None)), None);
                    return Effect::Measure;
                }
            }
            Action::Turbo => self.set_pace(self.pace.switched()),
            Action::Slower => self.set_pace(self.pace.slower()),
            Action::Faster => self.set_pace(self.pace.faster()),
            Action::Panels => {
                self.panelling = self.panelling.other();
                self.resize(painter, self.window);
            }
            Action::Redraw => return Effect::Redraw,
            Action::Suspend => return Effect::Suspend,
            Action::Quit => return Effect::Quit,
        }
        Effect::None
    }

    /// The picture that belongs to the state; absent where the screen has no room for a single dot.
    pub fn request(&self) -> Option<Request> {
        let cells = self.layout.picture;
        let palette = self.settings.palette;
        let ground = Theme::of(palette).ground(self.settings.ground);
        let per_cell = self.settings.glyphs.dots_per_cell();
        let dots = math::Size::new(
            u32::from(cells.width) * per_cell.width,
            u32::from(cells.height) * per_cell.height,
        );
        (dots.area() > 0).then(|| Request {
            camera: self.camera.clone(),
            dots,
            dot_aspect: self.settings.glyphs.dot_aspect(self.cell_aspect),
            options: self.settings.options,
            wants: Wants::CELLS,
            glyphs: self.settings.glyphs,
            palette: palette.for_glyphs(self.settings.glyphs, ground),
            tone: self.settings.tone,
        })
    }

    /// The field of the picture, zoomed and widened to its shape: full angles across and down, in degrees.
    pub fn field(&self) -> [f64; 2] {
        self.request().map_or(self.camera.field, |request| {
            let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
            PinholeCamera::new(&self.camera, &picture).field()
        })
    }

    /// How to get back to where something is to be seen, in words behind those that say so; empty where
    /// nobody has gone anywhere.
    pub const fn way_back(&self) -> &'static str {
        match (self.moved, self.settings.camera.is_some()) {
            (true, _) => ". Home goes back",
            (false, true) => ". Tab goes to the view",
            (false, false) => "",
        }
    }

    /// What is told of a picture beside it.
    pub fn subject(&self) -> Subject {
        Subject { settings: self.settings.clone(), camera: self.camera.clone(), moved: self.moved }
    }

    /// The state as it was when a picture was begun, as far as that is told of the picture; the rest as it is
    /// now.
    #[must_use]
    pub fn with(&self, subject: Subject) -> Self {
        let Subject { settings, camera, moved } = subject;
        Self { settings, camera, moved, ..self.clone() }
    }

    /// What the picture's panel calls the view.
    pub fn view_name(&self) -> String {
        if let Some((_, view)) = self.standing.as_ref().filter(|(camera, _)| *camera == self.camera) {
            return view.name().to_owned();
        }
        let name = match &self.camera.name {
            Some(name) => name.clone(),
            None if self.views == 0 => "whole".to_owned(),
            None => (self.settings.view + 1).to_string(),
        };
        if self.moved { name + "*" } else { name }
    }
}

#[cfg(test)]
#[path = "model_tests.rs"]
mod tests;

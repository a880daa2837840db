//! What the viewer knows, and how each action changes it. No terminal, no thread, no clock.

use super::actions::{Action, StandardView};
use super::following::Following;
use super::layout::{Layout, Panelling};
use super::motion::{self, FLY_STEP, ORBIT_STEP, ZOOM_STEP};
use super::theme::Theme;
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
    /// The ray that is followed, where one is.
    pub following: Option<Following>,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Nothing beyond the model.
    None,
    /// Send the whole screen once more.
    Redraw,
    /// Stop until the shell continues us.
    Suspend,
    /// End.
    Quit,
}

impl Model {
    /// The viewer before the first key.
    pub fn new(painter: &dyn Painter, settings: Settings, window: Window) -> Self {
        let panelling = Panelling::default();
        let mut model = Self {
            camera: painter.camera(settings.view, 1.0),
            settings,
            moved: false,
            help: false,
            following: None,
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
        self.follow_again(painter);
    }

    /// Shows another scene, from where the one before is seen. Only a view that the scene itself gives, and
    /// that nobody has moved, is where the scene has it now.
    pub fn reload(&mut self, painter: &dyn Painter) {
        let scene = painter.scene();
        self.notes.clone_from(&scene.notes);
        self.mistake = None;
        self.views = scene.views.len();
        let is_named = |view: &Camera| view.name.is_some() && view.name == self.camera.name;
        let same = scene.views.iter().position(is_named);
        self.settings.view = same.unwrap_or(self.settings.view.min(self.views.saturating_sub(1)));
        if !self.moved && self.views > 0 {
            self.go_home(painter);
        }
        self.follow_again(painter);
    }

    /// Follows the ray that is in the same place of a picture that has changed.
    fn follow_again(&mut self, painter: &dyn Painter) {
        match (self.following.take(), self.request()) {
            (Some(mut following), Some(request)) => {
                following.again(painter, &request);
                self.following = Some(following);
            }
            (following, _) => self.following = following,
        }
    }

    /// Does what a key asks for. While the keys are shown, any key hides them and does nothing else, but the
    /// one that suspends still does.
    pub fn update(&mut self, painter: &dyn Painter, action: Option<Action>) -> Effect {
        if std::mem::take(&mut self.help) && action != Some(Action::Suspend) {
            return Effect::None;
        }
        let Some(action) = action else { return Effect::None };
        if let (Some(request), Some(mut following)) = (self.request(), self.following.take()) {
            let is_taken = following.takes(painter, &request, action);
            self.following = Some(following);
            if is_taken {
                return Effect::None;
            }
        }
        let before = self.request();
        let effect = self.act(painter, action);
        if self.request() != before {
            self.follow_again(painter);
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
                let request = self.request().filter(|_| self.following.is_none());
                self.following = request.map(|request| Following::middle(painter, &request));
            }
            // There is no ray whose steps these are.
            Action::StepBack | Action::StepOn => {}
            Action::Help => self.help = true,
            // The keys have been closed above.
            Action::Close => self.following = None,
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
mod tests {
    use ratatui::layout::Size;

    use super::*;
    use crate::frame::{Frame, Studio};
    use crate::glyph::{ColorDepth, GlyphMode, Palette};
    use crate::math::{DAffine3, DVec3};
    use crate::plan::Shading;
    use crate::scene::{Material, MaterialId, Object, Primitive, Scene, Shape, Solid};

    /// A scene of three views; the framing depends on the aspect, as one from bounds does.
    struct Three(Studio);

    impl Painter for Three {
        fn scene(&self) -> &Scene {
            self.0.scene()
        }
        fn camera(&self, index: usize, aspect: f64) -> Camera {
            Camera { eye: DVec3::new(0.0, -5.0 - aspect, 0.0), ..view(["a", "b", "c"][index]) }
        }
        fn draw(&self, request: &Request) -> Frame {
            self.0.draw(request)
        }
    }

    fn view(name: &str) -> Camera {
        Camera {
            name: Some(name.to_owned()),
            eye: DVec3::new(0.0, -5.0, 0.0),
            target: DVec3::ZERO,
            up: DVec3::Z,
            field: [40.0, 25.0],
            span: crate::scene::FieldSpan::Edges,
            zoom: 1.0,
        }
    }

    fn three() -> Three {
        let scene = Scene { views: ["a", "b", "c"].map(view).to_vec(), ..Scene::default() };
        Three(Studio::new(scene).unwrap())
    }

    const SCREEN: Window = Window { cells: Size::new(80, 25), pixels: Size::ZERO };

    fn model() -> Model {
        Model::new(&three(), Settings::default(), SCREEN)
    }

    fn press(model: &mut Model, actions: &[Action]) {
        for &action in actions {
            assert_eq!(model.update(&three(), Some(action)), Effect::None);
        }
    }

    #[test]
    fn moves_leave_the_view_and_home_returns() {
        let moves = [
            Action::OrbitLeft,
            Action::OrbitRight,
            Action::OrbitUp,
            Action::OrbitDown,
            Action::FlyForward,
            Action::FlyBack,
            Action::FlyLeft,
            Action::FlyRight,
            Action::Rise,
            Action::Sink,
            Action::ZoomIn,
            Action::ZoomOut,
        ];
        let before = model();
        let mut seen = vec![before.request()];
        for action in moves {
            let mut model = model();
            press(&mut model, &[action]);
            assert_eq!(model.view_name(), "a*");
            assert!(!seen.contains(&model.request()), "{action:?} is a move of its own");
            seen.push(model.request());
            press(&mut model, &[Action::Home]);
            assert_eq!((model.view_name(), model.request()), ("a".to_owned(), before.request()));
        }
    }

    #[test]
    fn views_follow_each_other_in_a_ring() {
        let mut model = model();
        let mut names = Vec::new();
        for action in [Action::NextView; 3].into_iter().chain([Action::PreviousView]) {
            press(&mut model, &[Action::OrbitLeft, action]);
            names.push(model.view_name());
        }
        assert_eq!(names, ["b", "c", "a", "c"]);
    }

    #[test]
    fn a_scene_without_views_has_one_of_its_own() {
        let sphere = Primitive::new(Shape::Sphere, DAffine3::IDENTITY, MaterialId(0));
        let object = Object { name: None, solid: Solid::Primitive(sphere) };
        let scene = Scene { objects: vec![object], materials: vec![Material::default()], ..Scene::default() };
        let studio = Studio::new(scene).unwrap();
        let mut model = Model::new(&studio, Settings::default(), SCREEN);
        let whole = model.request();
        for action in [Action::NextView, Action::PreviousView] {
            model.update(&studio, Some(action));
            assert_eq!((model.view_name(), model.request()), ("whole".to_owned(), whole.clone()));
        }
    }

    #[test]
    fn a_camera_of_ones_own_comes_before_the_view_it_stands_for() {
        let own = Camera { name: None, eye: DVec3::new(7.0, 0.0, 0.0), ..view("") };
        let settings = Settings { camera: Some(own.clone()), view: 1, ..Settings::default() };
        let mut model = Model::new(&three(), settings, SCREEN);
        press(&mut model, &[Action::Rise, Action::Home]);
        assert_eq!(model.camera, own);
        press(&mut model, &[Action::NextView]);
        assert_eq!(model.view_name(), "b");
    }

    #[test]
    fn a_resize_frames_anew_only_what_nobody_has_moved() {
        let wide = Window { cells: Size::new(200, 25), ..SCREEN };
        let mut at_rest = model();
        at_rest.resize(&three(), wide);
        assert_ne!(at_rest.camera, model().camera);
        let mut moved = model();
        press(&mut moved, &[Action::OrbitLeft]);
        let camera = moved.camera.clone();
        moved.resize(&three(), wide);
        assert_eq!(moved.camera, camera);
        assert_eq!(moved.request().unwrap().dots, at_rest.request().unwrap().dots);
    }

    #[test]
    fn another_scene_is_seen_from_where_the_one_before_was() {
        let with = |names: &[&str]| {
            let views = names.iter().map(|name| view(name)).collect();
            Studio::new(Scene { views, notes: vec!["new".to_owned()], ..Scene::default() }).unwrap()
        };
        let mut model = model();
        press(&mut model, &[Action::NextView]);
        model.mistake = Some("wrong".to_owned());
        // The view `b` has become the first, and another aspect frames it.
        model.reload(&with(&["b", "a"]));
        assert_eq!((model.view_name(), model.settings.view), ("b".to_owned(), 0));
        assert_eq!((model.mistake.clone(), model.notes.clone()), (None, vec!["new".to_owned()]));
        press(&mut model, &[Action::OrbitLeft]);
        let camera = model.camera.clone();
        model.reload(&with(&["a", "b"]));
        assert_eq!((model.camera.clone(), model.settings.view), (camera.clone(), 1));
        model.reload(&with(&[]));
        assert_eq!((model.camera.clone(), model.settings.view), (camera, 0));
    }

    #[test]
    fn shading_stops_at_its_ends_and_glyphs_go_round() {
        let mut model = model();
        press(&mut model, &[Action::ShadingUp]);
        assert_eq!(model.settings.options.shading, *Shading::ALL.last().unwrap());
        press(&mut model, &[Action::ShadingDown; 9]);
        assert_eq!(model.settings.options.shading, Shading::ALL[0]);
        press(&mut model, &[Action::ShadingUp]);
        assert_eq!(model.settings.options.shading, Shading::ALL[1]);
        let first = model.settings.glyphs;
        press(&mut model, &[Action::NextGlyphs]);
        assert_ne!(model.settings.glyphs, first);
        // Half blocks and quadrants are coarse chequers of four grays.
        press(&mut model, &[Action::NextGlyphs; GlyphMode::ALL.len() - 3]);
        assert_eq!(model.settings.glyphs, first);
        model.settings.palette = Palette::Gray(ColorDepth::Direct);
        press(&mut model, &[Action::NextGlyphs; GlyphMode::ALL.len()]);
        assert_eq!(model.settings.glyphs, first);
    }

    #[test]
    fn any_key_closes_the_help_and_does_nothing_else() {
        for key in
            [Action::Quit, Action::OrbitLeft, Action::Help, Action::Close].map(Some).into_iter().chain([None])
        {
            let mut model = model();
            press(&mut model, &[Action::Help]);
            assert!(model.help);
            assert_eq!(model.update(&three(), key), Effect::None);
            assert!(!model.help && !model.moved);
        }
        let mut model = model();
        assert_eq!(model.update(&three(), Some(Action::Close)), Effect::None);
        assert!(!model.help && !model.moved, "where nothing is open, closing does nothing");
        assert_eq!(model.update(&three(), Some(Action::Quit)), Effect::Quit);
        assert_eq!(model.update(&three(), Some(Action::Suspend)), Effect::Suspend);
    }

    #[test]
    fn a_circle_is_round_in_any_cell_and_any_mode() {
        let mut model = model();
        for (pixels, aspect) in [
            (Size::new(800, 500), 0.5),
            (Size::new(80 * 9, 25 * 20), 0.45),
            (Size::new(0, 0), 0.5),
            (Size::new(800, 1), 0.5),
            (Size::new(1, 500), 0.5),
        ] {
            model.resize(&three(), Window { pixels, ..SCREEN });
            for glyphs in GlyphMode::ALL {
                model.settings.glyphs = glyphs;
                let request = model.request().unwrap();
                let picture =
                    f64::from(request.dots.width) / f64::from(request.dots.height) * request.dot_aspect;
                assert!((picture - aspect * 50.0 / 19.0).abs() < 1e-12, "{glyphs:?} {pixels:?}");
            }
        }
    }
}

//! What keys make of the state.

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
            let picture = f64::from(request.dots.width) / f64::from(request.dots.height) * request.dot_aspect;
            assert!((picture - aspect * 50.0 / 19.0).abs() < 1e-12, "{glyphs:?} {pixels:?}");
        }
    }
}

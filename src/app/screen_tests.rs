//! What the screen looks like.

use std::sync::Arc;
use std::time::Duration;

use ratatui::buffer::Cell;
use ratatui::layout::Size;

use super::*;
use crate::app::actions::Action;
use crate::app::attributes::{text, text_and_attributes};
use crate::app::refinement::RaysTold;
use crate::app::window::Window;
use crate::app::{Painter, Settings};
use crate::frame::{NothingInView, Request, Space, Studio};
use crate::glyph::{self, GlyphMode, Ground, Paint, Palette};
use crate::math::{self, DVec3, Grid};
use crate::output::Capabilities;
use crate::scene::{Camera, Scene};
use crate::stage::{Counts, Stage, StageTimes};

/// A scene of one named view and a note.
struct Still(Scene);

impl Painter for Still {
    fn scene(&self) -> &Scene {
        &self.0
    }
    fn camera(&self, index: usize, _aspect: f64) -> Camera {
        self.0.views[index].clone()
    }
    fn draw(&self, _request: &Request) -> Frame {
        unreachable!("the screen is drawn from a frame that is there")
    }
}

fn still() -> Still {
    let front = Camera {
        name: Some("front".to_owned()),
        eye: DVec3::new(0.0, -9.0, 3.0),
        target: DVec3::ZERO,
        up: DVec3::Z,
        field: [40.0, 25.0],
        span: crate::scene::FieldSpan::Edges,
        zoom: 1.0,
    };
    let notes = vec!["line 12: hull() is left out".to_owned(), "line 14: text() is left out".to_owned()];
    Still(Scene { views: vec![front], notes, ..Scene::default() })
}

fn model(width: u16, height: u16) -> Model {
    let settings = Settings { title: "hanyang.scene".to_owned(), ..Settings::default() };
    Model::new(&still(), settings, Window { cells: Size::new(width, height), ..Window::default() })
}

/// A disc on black, as large as the model's picture.
fn shown(model: &Model) -> Shown {
    let picture = model.layout.picture;
    let (width, height) = (f64::from(picture.width), f64::from(picture.height));
    let cells = Grid::from_fn(math::Size::new(picture.width.into(), picture.height.into()), |column, row| {
        let x = (f64::from(column) + 0.5 - width / 2.0) / height;
        let y = (f64::from(row) + 0.5 - height / 2.0) / height * 2.0;
        let glyph = ['█', '▓', '▒', '░', ' '][((x * x + y * y) * 5.0).min(4.0) as usize];
        glyph::Cell { glyph, ink: Paint::White, paper: Paint::Black }
    });
    let mut times = StageTimes::default();
    times[Stage::Cell] = Duration::from_micros(2_600);
    times[Stage::Solid] = Duration::from_micros(1_500);
    times[Stage::Csg] = Duration::from_micros(300);
    times[Stage::Shade] = Duration::from_micros(600);
    let frame = Frame {
        counts: Counts {
            primary_rays: 7_600,
            primary_hits: 3_100,
            shadow_rays: 6_200,
            shadow_hits: 400,
            clipped_rays: 2_114,
            cells_visited: 29_000,
            primitive_tests: 19_320,
            csg_evaluations: 5_000,
            ..Counts::default()
        },
        times,
        objects: 9,
        space: Space::Lattice([4, 3, 5]),
        field: model.field(),
        total: Duration::from_millis(5),
        ..Frame::blank(math::Size::new(0, 0), cells)
    };
    Shown {
        frame,
        rays: Some(RaysTold::default()),
        in_hand: None,
        bytes: 1_946,
        display: Duration::from_micros(200),
        round_trip: None,
    }
}

fn drawn(model: &Model, shown: Option<&Shown>) -> Buffer {
    let mut buffer = Buffer::empty(model.layout.screen);
    draw(model, shown, None, &mut buffer);
    buffer
}

#[test]
fn the_whole_screen_at_80_by_25() {
    let model = model(80, 25);
    insta::assert_snapshot!(text_and_attributes(&drawn(&model, Some(&shown(&model)))));
}

#[test]
fn the_whole_screen_at_80_by_24() {
    let model = model(80, 24);
    insta::assert_snapshot!(text_and_attributes(&drawn(&model, Some(&shown(&model)))));
}

#[test]
fn the_whole_screen_at_200_by_60() {
    let model = model(200, 60);
    insta::assert_snapshot!(text_and_attributes(&drawn(&model, Some(&shown(&model)))));
}

#[test]
fn the_whole_screen_without_colours() {
    let mut model = model(80, 24);
    model.settings.palette = Palette::MONO;
    insta::assert_snapshot!(text_and_attributes(&drawn(&model, Some(&shown(&model)))));
}

#[test]
fn title_picture_and_keys_where_the_panels_have_no_room() {
    for (width, height) in [(80, 23), (40, 10), (20, 5)] {
        let model = model(width, height);
        let name = format!("rows_at_{width}_by_{height}");
        insta::assert_snapshot!(name, text_and_attributes(&drawn(&model, Some(&shown(&model)))));
    }
}

#[test]
fn without_utf_8_the_frames_are_ascii_too() {
    let mut model = model(80, 24);
    model.settings.terminal =
        Capabilities { utf8: false, glyphs: GlyphMode::Ascii, ..Capabilities::default() };
    model.settings.title = "한양.scene".to_owned();
    let mut shown = shown(&model);
    shown.frame.nothing = Some(NothingInView::Behind);
    shown.frame.cells = Some(Arc::new(shown.frame.cells.unwrap().map(|_| glyph::Cell {
        glyph: '.',
        ink: Paint::White,
        paper: Paint::Black,
    })));
    for _ in 0..2 {
        let text = text(&drawn(&model, Some(&shown)));
        assert!(text.is_ascii(), "{text}");
        insta::assert_snapshot!(if model.help { "ascii_help" } else { "ascii" }, text);
        model.update(&still(), Some(Action::Help));
    }
}

#[test]
fn a_picture_of_nothing_says_so_and_how_to_get_back() {
    let mut model = model(80, 24);
    let mut shown = shown(&model);
    shown.frame.nothing = Some(NothingInView::Behind);
    let seen = text(&drawn(&model, Some(&shown)));
    assert!(seen.contains(" nothing in view: the scene is behind the eye ") && !seen.contains("goes back"));
    model.update(&still(), Some(Action::FlyForward));
    let seen = text(&drawn(&model, Some(&shown)));
    assert!(seen.contains(" the scene is behind the eye. ") && seen.contains(" Home goes back "), "{seen}");
}

/// Seen in xterm, black on white, with `LANG=C`: a white picture amid black panels.
#[test]
fn a_picture_in_the_terminals_own_ink_stands_on_the_paper_of_the_panels() {
    let model = model(80, 24);
    let mut shown = shown(&model);
    let own = glyph::Cell { glyph: 'o', ink: Paint::Terminal, paper: Paint::Terminal };
    shown.frame.cells = Some(Arc::new(shown.frame.cells.unwrap().map(|_| own)));
    let buffer = drawn(&model, Some(&shown));
    let cell = &buffer[model.layout.picture.as_position()];
    let colors = [ratatui::style::Color::Gray, ratatui::style::Color::Black];
    assert_eq!((cell.symbol(), [cell.fg, cell.bg]), ("o", colors));
}

/// Seen in xterm, black on white, after `g`: the picture was composed for the light paper that the
/// terminal has, and drawn on the dark one of the panels.
#[test]
fn dark_is_blank_on_the_panels_paper_and_ink_on_a_light_terminals_own() {
    let studio = Studio::new(Scene::default()).unwrap();
    for (glyphs, ink) in [(GlyphMode::Braille, "⣿"), (GlyphMode::Ascii, "@")] {
        for (palette, dark) in [(Palette::DOS, " "), (Palette::MONO, ink)] {
            let mut model = model(80, 24);
            (model.settings.glyphs, model.settings.palette) = (glyphs, palette);
            model.settings.ground = Ground::Light;
            let frame = studio.draw(&model.request().unwrap());
            let buffer = drawn(
                &model,
                Some(&Shown {
                    frame,
                    rays: None,
                    in_hand: None,
                    bytes: 0,
                    display: Duration::ZERO,
                    round_trip: None,
                }),
            );
            let symbol = buffer[model.layout.picture.as_position()].symbol();
            assert_eq!(symbol.replace('\u{2800}', " "), dark, "{glyphs:?} {palette:?}");
        }
    }
}

#[test]
fn what_takes_long_says_how_far_it_is() {
    let model = model(80, 24);
    let step = Some(WorkStep { task: Task::Tracing, percent: Some(45) });
    let mut seen = [None, Some(&shown(&model))].map(|shown| {
        let mut buffer = Buffer::empty(model.layout.screen);
        draw(&model, shown, step, &mut buffer);
        text(&buffer)
    });
    assert!(seen.iter().all(
        |seen| seen.contains(" 4►RAY         45 % ▌░░░") || seen.contains("4►RAY         45 % ██░░")
    ));
    insta::assert_snapshot!("tracing_the_first_picture", seen[0]);
    assert!(seen[1].contains("─ tracing 45 % ┘"), "{}", std::mem::take(&mut seen[1]));
}

#[test]
fn the_help_over_the_screen() {
    let mut model = model(80, 25);
    model.update(&still(), Some(Action::Help));
    insta::assert_snapshot!(text_and_attributes(&drawn(&model, Some(&shown(&model)))));
}

/// With its picture below or above, wherever the dot is not.
#[test]
fn a_followed_ray_over_the_screen() {
    let file = include_str!("../../tests/files/follow.scene");
    let scene = crate::scene::read("follow.scene", file.as_bytes(), &crate::scene::ReadOptions::default());
    let studio = Studio::new(scene.unwrap()).unwrap();
    for (width, height, steps) in [(80, 24, 0), (80, 25, 9), (200, 60, 30)] {
        let window = Window { cells: Size::new(width, height), ..Window::default() };
        let settings = Settings { title: "follow.scene".to_owned(), ..Settings::default() };
        let mut model = Model::new(&studio, settings, window);
        let down = if height == 25 { 5 } else { 0 };
        let actions = [vec![Action::Follow], vec![Action::OrbitDown; down], vec![Action::StepOn; steps]];
        for action in actions.concat() {
            model.update(&studio, Some(action));
            if let Some(order) = model.follow_order() {
                model.tell(order.follow(&studio));
            }
        }
        let frame = studio.draw(&model.request().unwrap());
        let shown = Shown {
            frame: Frame { times: StageTimes::default(), total: Duration::ZERO, ..frame },
            ..shown(&model)
        };
        insta::assert_snapshot!(
            format!("a_followed_ray_at_{width}_by_{height}"),
            text_and_attributes(&drawn(&model, Some(&shown)))
        );
    }
}

#[test]
fn before_the_first_picture_the_screen_says_so() {
    let text = text(&drawn(&model(80, 25), None));
    assert!(text.contains(" tracing ") && text.contains(" EYE 0.0 -9.0 3.0 ") && !text.contains("fps"));
}

#[test]
fn no_size_of_screen_or_picture_is_too_small_or_too_large() {
    let frames = [model(80, 25), model(1, 1), model(300, 100)].map(|model| shown(&model));
    for (width, height) in
        [(1, 1), (2, 1), (20, 4), (20, 5), (40, 10), (79, 25), (80, 23), (80, 24), (200, 60)]
    {
        let mut model = model(width, height);
        for _ in 0..2 {
            for shown in frames.iter().map(Some).chain([None]) {
                assert_eq!(drawn(&model, shown).area, model.layout.screen);
            }
            model.update(&still(), Some(Action::Help));
        }
    }
}

#[test]
fn on_the_smallest_screens_the_picture_is_alone() {
    let model = model(19, 5);
    let text = text(&drawn(&model, Some(&shown(&model))));
    assert!(text.contains('█') && !text.contains(['═', '│', 'R']), "{text}");
}

#[test]
fn names_from_outside_cannot_command_the_terminal() {
    let mut model = model(80, 25);
    model.settings.title = "a\x1b]0;b\x07\r\n.scene".to_owned();
    model.camera.name = Some("c\u{9b}2J".to_owned());
    model.notes = vec!["d\x1b[2J".to_owned()];
    let buffer = drawn(&model, None);
    assert!(buffer.content.iter().all(|cell| !cell.symbol().contains(char::is_control)));
}

#[test]
fn the_terminals_own_colours_mean_no_colour_anywhere() {
    let mut model = model(80, 25);
    model.settings.palette = Palette::MONO;
    model.help = true;
    let plain =
        |cell: &Cell| cell.fg == ratatui::style::Color::Reset && cell.bg == ratatui::style::Color::Reset;
    assert!(drawn(&model, None).content.iter().all(plain));
}

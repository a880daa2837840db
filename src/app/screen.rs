//! The screen as a function of the state: frame, panels, status line, function keys.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Widget};

use super::layout::Panels;
use super::model::Model;
use super::theme::Theme;
use super::{help, keys, motion};
use crate::frame::Frame;
use crate::math::DVec3;
use crate::plan::Shading;
use crate::widget::figures;
use crate::widget::{FlowChart, Picture};

/// The last finished picture and what it took to send it.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The picture.
    pub frame: Frame,
    /// Bytes to the terminal; 0 until they are known.
    pub bytes: usize,
    /// The time it took to draw the screen and turn it into these bytes.
    pub display: Duration,
}

impl Shown {
    /// From the request to the bytes, in milliseconds.
    fn total_ms(&self) -> f64 {
        self.frame.total.as_secs_f64() * 1e3 + self.display.as_secs_f64() * 1e3
    }
}

/// Draws the whole screen into a buffer of its size.
pub fn draw(model: &Model, shown: Option<&Shown>, buffer: &mut Buffer) {
    let theme = Theme::of(model.settings.palette);
    buffer.set_style(buffer.area, theme.text);
    if let Some(panels) = &model.layout.panels {
        draw_panels(model, shown, panels, &theme, buffer);
    }
    let picture = model.layout.picture;
    match shown {
        Some(Shown { frame: Frame { cells: Some(cells), .. }, .. }) => Picture(cells).render(picture, buffer),
        _ => Line::from("tracing").centered().style(theme.dim).render(middle_row(picture), buffer),
    }
    if model.help {
        help::draw(&theme, model.layout.screen, buffer);
    }
}

fn draw_panels(model: &Model, shown: Option<&Shown>, panels: &Panels, theme: &Theme, buffer: &mut Buffer) {
    let title = format!(" {} ═", model.settings.title.to_uppercase());
    Block::bordered()
        .border_type(BorderType::Double)
        .style(theme.text)
        .title(Line::from(vec![Span::raw("═"), Span::styled(" RAY13 ", theme.bright)]))
        .title(Line::from(title).right_aligned())
        .render(panels.outer, buffer);

    let chart = Block::bordered().style(theme.text).title(Span::styled(" FLOW CHART ", theme.bright));
    let inside = chart.inner(panels.chart);
    chart.render(panels.chart, buffer);
    if let Some(shown) = shown {
        FlowChart::new(&shown.frame)
            .shading(model.settings.options.shading)
            .sent(shown.bytes, shown.display)
            .styles(theme.text, theme.dim)
            .render(inside, buffer);
    }
    draw_choices(model, inside, theme, buffer);

    let mut picture = Block::bordered()
        .style(theme.text)
        .title(Span::styled(" PICTURE ", theme.bright))
        .title(Line::from(format!(" view: {} ", model.view_name())).right_aligned());
    if let Some(note) = note(model, shown) {
        picture = picture.title_bottom(note);
    }
    picture.render(panels.picture, buffer);

    Line::from(status(model, shown, panels.status.width)).style(theme.text).render(panels.status, buffer);
    draw_bar(theme, panels.bar, buffer);
}

/// What the keys have chosen, at the bottom of the flow chart's panel.
fn draw_choices(model: &Model, inside: Rect, theme: &Theme, buffer: &mut Buffer) {
    let settings = &model.settings;
    let choices = [
        ("shading", format!("({}) {}", settings.options.shading.number(), name(settings.options.shading))),
        ("shadows", if settings.options.shadows { "on" } else { "off" }.to_owned()),
        ("glyphs", settings.glyphs.name().to_owned()),
    ];
    let top = inside.bottom().saturating_sub(choices.len() as u16);
    for (y, (name, choice)) in (top..inside.bottom()).zip(choices) {
        let row = Rect { y, height: 1, ..inside };
        Line::from(vec![Span::styled(format!(" {name:<9}"), theme.dim), Span::raw(choice)])
            .render(row, buffer);
    }
}

/// What each equation adds to the one before.
const fn name(shading: Shading) -> &'static str {
    match shading {
        Shading::Lambert => "diffuse",
        Shading::Depth => "depth",
        Shading::Phong => "highlight",
        Shading::Whitted => "mirrors",
    }
}

fn draw_bar(theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let mut spans = vec![Span::raw(" ")];
    for (number, label) in keys::function_keys() {
        spans.push(Span::styled(number.to_string(), theme.bright));
        spans.push(Span::styled(label, theme.label));
        spans.push(Span::raw(" "));
    }
    Line::from(spans).style(theme.text).render(area, buffer);
}

/// What is shown otherwise than asked for: the first note, and how many more there are.
fn note(model: &Model, shown: Option<&Shown>) -> Option<Line<'static>> {
    let over = shown.and_then(|shown| shown.frame.over_budget).map(|over| over.to_string());
    let mut notes = model.notes.iter().chain(over.as_ref());
    let first = notes.next()?;
    let more = match notes.count() {
        0 => String::new(),
        more => format!(" (+{more})"),
    };
    Some(Line::from(format!(" {first}{more} ")))
}

fn status(model: &Model, shown: Option<&Shown>, columns: u16) -> String {
    let camera = &model.camera;
    let DVec3 { x, y, z } = camera.eye;
    let digits = decimals(motion::distance(camera));
    let [x, y, z] = [x, y, z].map(|coordinate| length(coordinate, digits));
    let [azimuth, elevation] = motion::direction(camera).map(tenths);
    let [across, down] = model.field().map(tenths);
    let mut parts = vec![
        format!("EYE {x} {y} {z}"),
        format!("DIR {azimuth} {elevation}"),
        format!("FIELD {across}×{down}"),
    ];
    if let Some(shown) = shown {
        let ms = shown.total_ms();
        parts.extend([milliseconds(ms), rate(ms), figures::bytes(shown.bytes) + "/f"]);
    }
    let wide = format!(" {}", parts.join("  "));
    // Long coordinates take the room from between the figures first.
    if wide.chars().count() <= columns.into() { wide } else { format!(" {}", parts.join(" ")) }
}

/// How many decimals show a step of the keys, a fiftieth of the distance or so, at any scale of the scene.
fn decimals(distance: f64) -> usize {
    // Nine decimals and a sign are what three coordinates have room for.
    (1.0 - libm::floor(libm::log10(distance / 5.0))).clamp(1.0, 9.0) as usize
}

/// A coordinate; in powers of ten where its digits would fill the line.
fn length(x: f64, decimals: usize) -> String {
    if x.abs() >= 1e6 { format!("{x:.3e}") } else { without_sign_of_zero(format!("{x:.decimals$}")) }
}

fn tenths(x: f64) -> String {
    without_sign_of_zero(format!("{x:.1}"))
}

/// −0.0 reads as a place left of 0.0, but is none.
fn without_sign_of_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

fn milliseconds(ms: f64) -> String {
    if ms < 9.95 { format!("{ms:.1} ms") } else { format!("{ms:.0} ms") }
}

/// Pictures per second if they followed each other without a pause.
fn rate(ms: f64) -> String {
    match 1e3 / ms {
        rate if rate < 9.95 => format!("{rate:.1} fps"),
        // Beyond a thousand the clock says more about itself than about the picture.
        rate if rate < 999.5 => format!("{rate:.0} fps"),
        _ => ">999 fps".to_owned(),
    }
}

fn middle_row(area: Rect) -> Rect {
    Rect { y: area.y + area.height / 2, height: area.height.min(1), ..area }
}

#[cfg(test)]
mod tests {
    use ratatui::buffer::Cell;
    use ratatui::layout::Size;

    use super::*;
    use crate::app::model::Window;
    use crate::app::{Painter, Settings, keys::Action};
    use crate::frame::{Request, Space};
    use crate::glyph::{self, Paint, Palette};
    use crate::math::{self, Grid};
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
        let cells =
            Grid::from_fn(math::Size::new(picture.width.into(), picture.height.into()), |column, row| {
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
        Shown { frame, bytes: 1_946, display: Duration::from_micros(200) }
    }

    fn drawn(model: &Model, shown: Option<&Shown>) -> Buffer {
        let mut buffer = Buffer::empty(model.layout.screen);
        draw(model, shown, &mut buffer);
        buffer
    }

    fn text(buffer: &Buffer) -> String {
        let rows = buffer.content.chunks(buffer.area.width.into());
        rows.map(|row| row.iter().map(Cell::symbol).collect::<String>() + "\n").collect()
    }

    #[test]
    fn the_whole_screen_at_80_by_25() {
        let model = model(80, 25);
        insta::assert_snapshot!(text(&drawn(&model, Some(&shown(&model)))));
    }

    #[test]
    fn the_help_over_the_screen() {
        let mut model = model(80, 25);
        model.update(&still(), Some(Action::Help));
        insta::assert_snapshot!(text(&drawn(&model, Some(&shown(&model)))));
    }

    #[test]
    fn before_the_first_picture_the_screen_says_so() {
        let text = text(&drawn(&model(80, 25), None));
        assert!(text.contains(" tracing ") && text.contains(" EYE 0.0 -9.0 3.0 ") && !text.contains("fps"));
    }

    #[test]
    fn no_size_of_screen_or_picture_is_too_small_or_too_large() {
        let frames = [model(80, 25), model(1, 1), model(300, 100)].map(|model| shown(&model));
        for (width, height) in [(1, 1), (2, 1), (40, 10), (79, 25), (80, 24), (80, 25), (200, 60)] {
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
    fn below_80_by_25_the_picture_is_alone() {
        let model = model(40, 10);
        let text = text(&drawn(&model, Some(&shown(&model))));
        assert!(text.contains('█') && !text.contains(['║', '│', 'R']), "{text}");
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

    #[test]
    fn coordinates_show_a_step_at_any_scale() {
        assert_eq!([9.5, 0.05, 1e-12, 5e4].map(decimals), [1, 3, 9, 1]);
        assert_eq!(length(-0.01, 1), "0.0");
        assert_eq!(length(-9.04, 1), "-9.0");
        assert_eq!(length(-1.5e30, 1), "-1.500e30");
    }
}

//! The screen as a function of the state: frame, panels, status line, function keys.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::{Alignment, Rect};
use ratatui::style::Style;
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
        Some(shown) => Picture(&shown.frame.cells).render(picture, buffer),
        None => Line::from("tracing").centered().style(theme.dim).render(middle_row(picture), buffer),
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
            .field(model.field())
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
    if let Some(note) = note(&model.notes) {
        picture = picture.title_bottom(note);
    }
    picture.render(panels.picture, buffer);

    Line::from(status(model, shown)).style(theme.text).render(panels.status, buffer);
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

/// What the reader left out: the first note, and how many more there are.
fn note(notes: &[String]) -> Option<Line<'_>> {
    let first = notes.first()?;
    let more = match notes.len() - 1 {
        0 => String::new(),
        more => format!(" (+{more})"),
    };
    Some(Line::from(format!(" {first}{more} ")).alignment(Alignment::Left).style(Style::new()))
}

fn status(model: &Model, shown: Option<&Shown>) -> String {
    let camera = &model.camera;
    let DVec3 { x, y, z } = camera.eye;
    let digits = decimals(motion::distance(camera));
    let [x, y, z] = [x, y, z].map(|coordinate| length(coordinate, digits));
    let [azimuth, elevation] = motion::direction(camera).map(tenths);
    let [across, down] = model.field().map(tenths);
    let view = format!(" EYE {x} {y} {z}  DIR {azimuth} {elevation}  FIELD {across}×{down}");
    shown.map_or(view.clone(), |shown| {
        let ms = shown.total_ms();
        let bytes = figures::bytes(shown.bytes);
        format!("{view}  {}  {} fps  {bytes}/f", milliseconds(ms), rate(ms))
    })
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
    if ms < 99.95 { format!("{ms:.1} ms") } else { format!("{ms:.0} ms") }
}

/// Pictures per second if they followed each other without a pause.
fn rate(ms: f64) -> String {
    match 1e3 / ms {
        rate if rate < 9.95 => format!("{rate:.1}"),
        // Beyond a thousand the clock says more about itself than about the picture.
        rate if rate < 999.5 => format!("{rate:.0}"),
        _ => ">999".to_owned(),
    }
}

fn middle_row(area: Rect) -> Rect {
    Rect { y: area.y + area.height / 2, height: area.height.min(1), ..area }
}

//! The screen as a function of the state: frame, panels, status line, function keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::around::{self, Labels};
use super::desk::Desk;
use super::layout::{self, Around};
use super::model::Model;
use super::shown::Shown;
use super::theme::Theme;
use super::{caption, charset, help, mistake, status};
use crate::frame::Frame;
use crate::plan::Shading;
use crate::stage::{Task, WorkStep};
use crate::widget::{FlowChart, PictureWidget};

/// Draws the whole screen into a buffer of its size; `working` is what is at work, where it takes long.
pub fn draw(model: &Model, shown: Option<&Shown>, working: Option<WorkStep>, buffer: &mut Buffer) {
    let theme = Theme::of(model.settings.palette);
    buffer.set_style(buffer.area, theme.text);
    let labels = Labels {
        title: &model.settings.title,
        view: Some(model.view_name()),
        note: note(model, shown),
        drawing: shown
            .and_then(|shown| shown.in_hand)
            .map(|in_hand| format!("{} {:.0} %", model.pace.name(), (in_hand.share * 100.0).floor())),
        working: working.filter(|_| shown.is_some()),
    };
    around::draw(&model.layout.around, &labels, &theme, buffer);
    if let Around::Panels(panels) = &model.layout.around {
        let inside = layout::inside(panels.chart);
        draw_chart(model, shown, working, inside, &theme, buffer);
        draw_choices(model, shown, inside, &theme, buffer);
        let status = status::line(model, shown, panels.status.width);
        Line::from(status).style(theme.text).render(panels.status, buffer);
    }
    let terminal = model.settings.terminal;
    charset::fit(buffer, model.layout.screen, terminal);
    // The picture is in characters that were chosen for it; what is written over it was not.
    let picture = model.layout.picture;
    buffer.set_style(picture, theme.picture);
    let over = match shown {
        Some(Shown { frame: Frame { cells: Some(cells), nothing, .. }, .. }) => {
            PictureWidget(cells).render(picture, buffer);
            theme.fill(picture, buffer);
            nothing.map(|nothing| nothing.to_string() + model.way_back())
        }
        _ => Some(working.map_or_else(|| Task::Tracing.name().to_owned(), around::words)),
    };
    if let Some(over) = over {
        let place = caption::draw(&over, theme.picture, picture, buffer);
        charset::fit(buffer, place, terminal);
    }
    if let Some(mistake) = &model.mistake {
        let place = mistake::draw(mistake, &theme, picture, buffer);
        charset::fit(buffer, place, terminal);
    }
    if let Some(following) = &model.following {
        for place in following.draw(&theme, picture, model.layout.body(), buffer) {
            charset::fit(buffer, place, terminal);
        }
    }
    if let Some(trade) = &model.trade {
        let place = trade.draw(&theme, model.layout.body(), buffer);
        charset::fit(buffer, place, terminal);
    }
    if let Some(said) = model.desk.as_ref().map(Desk::hint).or(model.told.as_deref()) {
        let place = around::draw_hint(&model.layout.around, said, &theme, buffer);
        charset::fit(buffer, place, terminal);
    }
    if let Some(desk) = &model.desk {
        for place in desk.draw(&theme, model.layout.screen, buffer) {
            charset::fit(buffer, place, terminal);
        }
    }
    if model.help {
        let place = help::draw(&theme, model.layout.screen, buffer);
        charset::fit(buffer, place, terminal);
    }
}

/// The chart of the picture that is shown, with what is at work on the next one.
fn draw_chart(
    model: &Model,
    shown: Option<&Shown>,
    working: Option<WorkStep>,
    area: Rect,
    theme: &Theme,
    buffer: &mut Buffer,
) {
    let chart = match shown {
        Some(shown) => FlowChart::new(&shown.frame).sent(shown.bytes, shown.display),
        None if working.is_some() => FlowChart::idle(),
        None => return,
    };
    let chart = chart.shading(model.settings.options.shading).working(working);
    let stage = shown.and_then(|shown| shown.in_hand).and_then(|in_hand| in_hand.stage);
    let chart = chart.in_hand(stage, theme.chosen);
    chart.styles(theme.text, theme.dim).render(area, buffer);
}

/// What the keys have chosen, and the rays of what is shown, at the bottom of the flow chart's panel.
fn draw_choices(model: &Model, shown: Option<&Shown>, inside: Rect, theme: &Theme, buffer: &mut Buffer) {
    let settings = &model.settings;
    let rays = shown.and_then(|shown| shown.rays).map(|rays| rays.to_string());
    let choices = [
        ("shading", format!("({}) {}", settings.options.shading.number(), name(settings.options.shading))),
        ("shadows", if settings.options.shadows { "on" } else { "off" }.to_owned()),
        ("glyphs", settings.glyphs.name().to_owned()),
    ];
    let all: Vec<_> = choices.into_iter().chain(rays.map(|rays| ("rays", rays))).collect();
    let top = inside.bottom().saturating_sub(all.len() as u16);
    for (y, (name, choice)) in (top..inside.bottom()).zip(all) {
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

/// What is shown otherwise than asked for: the first note, and how many more there are.
fn note(model: &Model, shown: Option<&Shown>) -> Option<String> {
    let over = shown.and_then(|shown| shown.frame.over_budget).map(|over| over.to_string());
    let mut notes = model.notes.iter().chain(over.as_ref());
    let first = notes.next()?;
    let more = match notes.count() {
        0 => String::new(),
        more => format!(" (+{more})"),
    };
    Some(format!("{first}{more}"))
}

#[cfg(test)]
#[path = "screen_tests.rs"]
mod tests;

//! What was measured of time and accuracy, for people and for programs.

use std::fmt::Write;
use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use serde_json::{Value, json};

use crate::trade::{Accuracy, KNOBS, Measurement, Sweep, SweepLimits, TradePlot};
use crate::widget::TradePlotWidget;

use super::error::visible;
use super::stats;
use super::trade_line::CommandLine;

/// Columns and rows of the plot: those of the smallest screen, with room for the shell's prompt.
const PLOT: Rect = Rect::new(0, 0, 79, 20);

/// The columns of the table: shares in percent, so that there is room for options within 80 columns.
const HEAD: &str = "     time   ±%  wrong%  by 2%   rms  max  hits% cells%  seen flick  options\n";

/// All that is told of a sweep.
pub struct Report<'a> {
    pub sweep: &'a Sweep,
    pub line: &'a CommandLine,
    pub limits: &'a SweepLimits,
}

impl Report<'_> {
    /// The front as a table, what it beats, and a plot.
    pub fn text(&self) -> String {
        let Self { sweep, line, .. } = self;
        let mut text = self.about();
        let front = sweep.front();
        let section = |text: &mut String, title: &str, places: &[usize]| {
            if !places.is_empty() {
                let _ = write!(text, "\n{title}\n{HEAD}");
                for &place in places {
                    text.push_str(&self.row(&sweep.all[place]));
                }
            }
        };
        section(&mut text, "The front: whatever is faster than one of these has more wrong levels", &front);
        let mut others: Vec<usize> = (0..sweep.all.len()).filter(|place| !front.contains(place)).collect();
        others.sort_by_key(|&place| sweep.all[place].cost());
        let (pictures, beaten): (Vec<usize>, Vec<usize>) =
            others.into_iter().partition(|&place| sweep.all[place].is_another_picture);
        section(&mut text, "Beaten by these", &beaten);
        section(&mut text, "Another picture, on purpose", &pictures);
        if !sweep.passed_over.is_empty() {
            text.push_str("\nNot measured\n");
        }
        for one in &sweep.passed_over {
            let _ = writeln!(text, "  {}: {}", line.options(&one.setting), one.why);
        }
        if sweep.all.len() > 1 {
            let _ = write!(text, "\n{}", plot(&TradePlot::new(sweep)));
        }
        let _ = write!(
            text,
            "\nA picture of these: {}, with the options of a line.\nThe same accuracy again: {} \"…\", with them in quotes.\n",
            visible(&line.render_with()),
            visible(&line.measure_with(sweep.reference.rays())),
        );
        text
    }

    /// What everything was compared with, in lines.
    fn about(&self) -> String {
        let reference = &self.sweep.reference;
        let (error, dots) = (reference.error(), reference.base().dots);
        let aim = if reference.reached() { "a tenth or less" } else { "more than a tenth" };
        let exact = if reference.exact_rays() < reference.rays() {
            format!(
                "{} of them by the exact engine:\nthe fast one finds its bits in these",
                reference.exact_rays()
            )
        } else {
            "all by the exact engine".to_owned()
        };
        let flicker =
            reference.shimmer().map_or(String::new(), |own| format!("; flickers by {own:.2} itself"));
        format!(
            "The reference: {} rays for each of {} × {} dots, {exact}{flicker}.\n\
             Its own error: {} of the levels wrong, {:.3} levels RMS;\n\
             that is {aim} of the {} to be told apart.\n",
            reference.rays(),
            dots.width,
            dots.height,
            percent(error.wrong),
            error.rms,
            percent(self.limits.apart),
        )
    }

    fn row(&self, one: &Measurement) -> String {
        let Accuracy { geometry, light, characters } = &one.accuracy;
        let [low, high] = one.times.middle_half();
        let spread =
            (high.as_secs_f64() - low.as_secs_f64()) / 2.0 / one.cost().as_secs_f64().max(f64::MIN_POSITIVE);
        let or_dash = |value: Option<String>| value.unwrap_or_else(|| "–".to_owned());
        let own = if self.line.is_own(&one.setting) { "(as asked) " } else { "" };
        let row = format!(
            "{:>9} {:>4.0} {:>7} {:>6} {:>5.2} {:>4.1} {:>6} {:>6} {:>5} {:>5}  {own}{}",
            ms(one.cost()),
            100.0 * spread,
            number(light.wrong()),
            number(light.wrong_by(2)),
            light.rms,
            light.largest,
            or_dash(geometry.map(|geometry| number(geometry.share()))),
            or_dash(characters.map(|characters| number(characters.share()))),
            or_dash(characters.map(|characters| format!("{:.2}", characters.seen))),
            or_dash(characters.and_then(|characters| characters.shimmer).map(|s| format!("{s:.2}"))),
            self.line.options(&one.setting),
        );
        format!("{}\n", row.trim_end())
    }

    /// One line.
    pub fn json(&self) -> String {
        let Self { sweep, limits, .. } = self;
        let reference = &sweep.reference;
        let error = reference.error();
        let front = sweep.front();
        let settings: Vec<Value> = (0..sweep.all.len())
            .map(|place| self.setting(&sweep.all[place], front.contains(&place)))
            .collect();
        let passed_over: Vec<Value> = (sweep.passed_over.iter())
            .map(|one| json!({ "options": self.line.options(&one.setting), "why": one.why.to_string() }))
            .collect();
        let all = json!({
            "dots": [reference.base().dots.width, reference.base().dots.height],
            "reference": {
                "rays": reference.rays(),
                "exact_rays": reference.exact_rays(),
                "wrong": error.wrong,
                "rms": error.rms,
                "apart": limits.apart,
                "reached": reference.reached(),
                "flicker": reference.shimmer(),
                "shown": reference.shown(),
                "degrees_per_cell": limits.eye.degrees_per_cell,
            },
            "interrupted": sweep.interrupted,
            "again": self.line.measure_with(reference.rays()),
            "settings": settings,
            "passed_over": passed_over,
        });
        format!("{all}\n")
    }

    fn setting(&self, one: &Measurement, on_front: bool) -> Value {
        let Accuracy { geometry, light, characters } = &one.accuracy;
        let [low, high] = one.times.middle_half();
        let own = &self.sweep.all[0].setting;
        let turned: Vec<&str> =
            KNOBS.iter().filter(|knob| knob.differs(&one.setting, own)).map(|knob| knob.name).collect();
        json!({
            "command": self.line.render(&one.setting),
            "options": self.line.options(&one.setting),
            "turned": turned,
            "front": on_front,
            "another_picture": one.is_another_picture,
            "pictures": one.times.all().len(),
            "ms_median": stats::ms(one.cost()),
            "ms_min": stats::ms(one.times.least()),
            "ms_middle_half": [stats::ms(low), stats::ms(high)],
            "geometry": geometry.map(|geometry| json!({
                "other_objects": geometry.share(),
                "depth_ulps": geometry.depth_ulps,
                "normal_degrees": geometry.normal,
            })),
            "light": {
                "rms": light.rms,
                "largest": light.largest,
                "wrong": light.wrong(),
                "wrong_by_2": light.wrong_by(2),
                "off_by": (0..=12).map(|levels| light.levels.off_by(levels)).collect::<Vec<_>>(),
            },
            "characters": characters.map(|characters| json!({
                "other_cells": characters.share(),
                "seen": characters.seen,
                "shown": characters.shown,
                "flicker": characters.shimmer,
            })),
        })
    }
}

/// The plot as a terminal shows it, without colours.
fn plot(plot: &TradePlot) -> String {
    let mut text = String::new();
    let buffer = plot_screen(plot);
    for y in 0..PLOT.height {
        let line: String = (0..PLOT.width).map(|x| buffer[(x, y)].symbol()).collect();
        text.push_str(line.trim_end());
        text.push('\n');
    }
    format!("{text}{}\n", TradePlotWidget::legend())
}

/// The cells of the plot.
pub fn plot_screen(plot: &TradePlot) -> Buffer {
    let mut buffer = Buffer::empty(PLOT);
    TradePlotWidget(plot).render(PLOT, &mut buffer);
    buffer
}

/// A time to three digits.
pub fn ms(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    match ms {
        _ if ms < 10.0 => format!("{ms:.2} ms"),
        _ if ms < 100.0 => format!("{ms:.1} ms"),
        _ => format!("{ms:.0} ms"),
    }
}

/// A share in percent, with its sign.
pub fn percent(share: f64) -> String {
    format!("{} %", number(share))
}

/// A share in percent, to two digits behind the point below 10.
fn number(share: f64) -> String {
    let percent = share * 100.0;
    match percent {
        0.0 => "0".to_owned(),
        _ if percent < 10.0 => format!("{percent:.2}"),
        _ => format!("{percent:.1}"),
    }
}

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

/// Columns and rows of the plot where no terminal says how wide it is: those of the smallest screen, with
/// room for the shell's prompt.
pub const PLOT: Rect = Rect::new(0, 0, 79, 20);

/// The narrowest and the widest plot, in columns: the widget's least, and what still is a plot at four times
/// the width of its height.
const PLOT_COLUMNS: [u16; 2] = [40, 160];

/// Fewer rays a dot do not know how far they are off: two see neither an edge in a corner of a dot nor how
/// light bends (`tests/trade/reference.rs` holds the error of 8).
const KNOWING_RAYS: u32 = 8;

/// The columns of text in a file.
const TEXT_COLUMNS: u16 = 100;

/// A column of figures.
struct Column {
    /// Its heading.
    name: &'static str,
    /// With the blanks before it.
    width: usize,
    /// Columns of higher numbers are left out first where a terminal is narrow; of 0 none.
    spared: u8,
    figure: fn(&Measurement) -> Option<String>,
    /// What it is, for the legend.
    meaning: &'static str,
}

/// All columns: shares in percent.
const COLUMNS: [Column; 10] = [
    Column {
        name: "time",
        width: 9,
        spared: 0,
        figure: |one| Some(ms(one.cost())),
        meaning: "of a picture, the median",
    },
    Column {
        name: "±%",
        width: 5,
        spared: 1,
        figure: |one| {
            let time = one.cost().as_secs_f64().max(f64::MIN_POSITIVE);
            Some(format!("{:.0}", 100.0 * one.times.spread().as_secs_f64() / time))
        },
        meaning: "half the width in which the middle half of its pictures lies; where two overlap, they are as fast",
    },
    Column {
        name: "wrong%",
        width: 8,
        spared: 0,
        figure: |one| Some(number(one.wrong())),
        meaning: "dots with another of the 13 levels than the reference",
    },
    Column {
        name: "by 2%",
        width: 7,
        spared: 3,
        figure: |one| Some(number(one.accuracy.light.wrong_by(2))),
        meaning: "those that are two or more levels off",
    },
    Column {
        name: "rms",
        width: 6,
        spared: 2,
        figure: |one| Some(format!("{:.2}", one.accuracy.light.rms)),
        meaning: "difference in lightness, root of the mean square, in levels",
    },
    Column {
        name: "max",
        width: 5,
        spared: 5,
        figure: |one| Some(format!("{:.1}", one.accuracy.light.largest)),
        meaning: "the largest of these differences",
    },
    Column {
        name: "hits%",
        width: 7,
        spared: 6,
        figure: |one| one.accuracy.geometry.map(|geometry| number(geometry.share())),
        meaning: "dots whose middle shows another object than by the exact engine",
    },
    Column {
        name: "cells%",
        width: 7,
        spared: 4,
        figure: |one| one.accuracy.characters.map(|characters| number(characters.share())),
        meaning: "cells with another character, ink or paper",
    },
    Column {
        name: "seen",
        width: 6,
        spared: 7,
        figure: |one| one.accuracy.characters.map(|characters| format!("{:.2}", characters.seen)),
        meaning: "what an eye sees of that, in levels",
    },
    Column {
        name: "flick",
        width: 6,
        spared: 8,
        figure: |one| {
            let shimmer = one.accuracy.characters.and_then(|characters| characters.shimmer);
            shimmer.map(|shimmer| format!("{shimmer:.2}"))
        },
        meaning: "what flickers when the view turns by a tenth of a dot, in levels",
    },
];

/// Columns of this number are left out to keep options in the line of their figures; else they have a line of
/// their own.
const SPARED_FOR_OPTIONS: u8 = 5;

/// Blanks between the figures and the options of a row.
const GAP: usize = 2;

/// What of a table fits a terminal.
struct TableLayout {
    columns: Vec<&'static Column>,
    /// Whether options stand behind the figures, and not above them.
    options_beside: bool,
    /// The columns of the terminal, or of text in a file.
    text: usize,
}

impl TableLayout {
    /// For options of so many characters at most.
    fn new(terminal: Option<u16>, longest: usize) -> Self {
        let text = usize::from(terminal.unwrap_or(TEXT_COLUMNS));
        let all = || COLUMNS.iter().collect::<Vec<_>>();
        let Some(width) = terminal.map(usize::from) else {
            return Self { columns: all(), options_beside: true, text };
        };
        let fitting = |room: usize, least: u8| {
            let mut columns = all();
            while columns.iter().map(|column| column.width).sum::<usize>() > room {
                let (place, column) = columns.iter().enumerate().max_by_key(|(_, column)| column.spared)?;
                if column.spared < least {
                    return None;
                }
                columns.remove(place);
            }
            Some(columns)
        };
        if let Some(columns) = fitting(width.saturating_sub(GAP + longest), SPARED_FOR_OPTIONS) {
            return Self { columns, options_beside: true, text };
        }
        let least = || COLUMNS.iter().filter(|column| column.spared == 0).collect();
        Self { columns: fitting(width, 1).unwrap_or_else(least), options_beside: false, text }
    }

    fn head(&self) -> String {
        let names: String =
            self.columns.iter().map(|column| format!("{:>1$}", column.name, column.width)).collect();
        if self.options_beside { format!("{names}  options\n") } else { format!("{names}\n") }
    }

    fn row(&self, one: &Measurement, options: &str) -> String {
        let figure = |column: &&Column| {
            let text = (column.figure)(one).unwrap_or_else(|| "–".to_owned());
            format!("{text:>0$}", column.width)
        };
        let figures: String = self.columns.iter().map(figure).collect();
        if self.options_beside {
            format!("{}\n", format!("{figures}  {options}").trim_end())
        } else {
            let options = if options.is_empty() { "(without options)" } else { options };
            format!("{}{figures}\n", wrapped(options, self.text, "  "))
        }
    }

    /// What the headings mean.
    fn legend(&self) -> String {
        let lines = self.columns.iter().map(|column| {
            let text = format!("{:<6} {}", column.name, column.meaning);
            wrapped(&text, self.text, "  ")
        });
        let left_out = if self.columns.len() < COLUMNS.len() {
            wrapped("A wider terminal has more columns, --json all of them.", self.text, "  ")
        } else {
            String::new()
        };
        lines.collect::<String>() + &left_out
    }
}

/// A paragraph in lines of so many columns at most, but for longer words; those after the first are indented
/// further.
fn wrapped(text: &str, columns: usize, indent: &str) -> String {
    let mut lines = vec![indent.to_owned()];
    let mut is_empty = true;
    for word in text.split(' ') {
        let last = lines.last_mut();
        if let Some(line) =
            last.filter(|line| is_empty || line.chars().count() + 1 + word.chars().count() <= columns)
        {
            if !is_empty {
                line.push(' ');
            }
            line.push_str(word);
        } else {
            lines.push(format!("{indent}{indent}{word}"));
        }
        is_empty = false;
    }
    lines.join("\n") + "\n"
}

/// All that is told of a sweep.
pub struct Report<'a> {
    pub sweep: &'a Sweep,
    pub line: &'a CommandLine,
    pub limits: &'a SweepLimits,
}

impl Report<'_> {
    /// The front as a table, what it beats, and a plot, for a terminal of so many columns, or a file.
    pub fn text(&self, terminal: Option<u16>) -> String {
        let Self { sweep, line, .. } = self;
        let longest = sweep.all.iter().map(|one| self.options(one).chars().count()).max().unwrap_or(0);
        let table = TableLayout::new(terminal, longest);
        let mut text = wrapped(&self.about(), table.text, "");
        let front = sweep.front();
        let section = |text: &mut String, title: &str, places: &[usize]| {
            if !places.is_empty() {
                let _ = write!(text, "\n{}{}", wrapped(title, table.text, ""), table.head());
                for &place in places {
                    text.push_str(&table.row(&sweep.all[place], &self.options(&sweep.all[place])));
                }
            }
        };
        section(&mut text, "The front: whatever is faster than one of these has more wrong levels", &front);
        let mut others: Vec<usize> = (0..sweep.all.len()).filter(|place| !front.contains(place)).collect();
        others.sort_by_key(|&place| sweep.all[place].cost());
        let (pictures, beaten): (Vec<usize>, Vec<usize>) =
            others.into_iter().partition(|&place| sweep.all[place].is_another_picture);
        section(&mut text, "Beaten by these, or as good and farther from what was asked for", &beaten);
        section(&mut text, "Another picture, on purpose", &pictures);
        if !sweep.passed_over.is_empty() {
            text.push_str("\nNot measured\n");
        }
        for one in &sweep.passed_over {
            let told = format!("{}: {}", line.options(&one.setting), one.why);
            text.push_str(&wrapped(&told, table.text, "  "));
        }
        let _ = write!(text, "\nThe columns\n{}", table.legend());
        if sweep.all.len() > 1 {
            let columns = terminal.map_or(PLOT.width, |columns| columns.saturating_sub(1));
            let columns = columns.clamp(PLOT_COLUMNS[0], PLOT_COLUMNS[1]);
            let place = Rect::new(0, 0, columns, columns.div_ceil(4));
            let _ = write!(text, "\n{}", plot(&TradePlot::new(sweep), place));
            text.push_str(&wrapped(&TradePlotWidget::legend(), table.text, ""));
        }
        let _ = write!(
            text,
            "\nA picture of these, with the options of a line:\n{}\n\
             The same accuracy again, with --with \"…\" for the options of a line:\n{}\n",
            visible(&line.render_with()),
            visible(&line.measure_own(sweep.reference.rays())),
        );
        text
    }

    /// What stands for a setting in the table.
    fn options(&self, one: &Measurement) -> String {
        let own = if self.line.is_own(&one.setting) { "(as asked) " } else { "" };
        format!("{own}{}", self.line.options(&one.setting)).trim_end().to_owned()
    }

    /// What everything was compared with, in a paragraph.
    fn about(&self) -> String {
        let reference = &self.sweep.reference;
        let (error, dots) = (reference.error(), reference.base().dots);
        let aim = if reference.reached() { "a tenth or less" } else { "more than a tenth" };
        let exact = if reference.exact_rays() < reference.rays() {
            format!(
                "{} of them by the exact engine: the fast one finds its bits in these",
                reference.exact_rays()
            )
        } else {
            "all by the exact engine".to_owned()
        };
        let flicker =
            reference.shimmer().map_or(String::new(), |own| format!("; flickers by {own:.2} itself"));
        let guess =
            if reference.rays() < KNOWING_RAYS { " (a guess: its rays are too few to know)" } else { "" };
        format!(
            "The reference: {} rays for each of {} × {} dots, {exact}{flicker}. \
             Its own error: {} of the levels wrong, {:.3} levels RMS{guess}; that is {aim} of the {} to be told apart.",
            reference.rays(),
            dots.width,
            dots.height,
            percent(error.wrong),
            error.rms,
            percent(self.limits.apart),
        )
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
            "again": self.line.measure_own(reference.rays()),
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
            "again": self.line.measure(&one.setting, self.sweep.reference.rays()),
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
fn plot(plot: &TradePlot, place: Rect) -> String {
    let buffer = plot_screen(plot, place);
    let line = |y| (0..place.width).map(|x| buffer[(x, y)].symbol()).collect::<String>();
    (0..place.height).map(|y| line(y).trim_end().to_owned() + "\n").collect()
}

/// The cells of the plot.
pub fn plot_screen(plot: &TradePlot, place: Rect) -> Buffer {
    let mut buffer = Buffer::empty(place);
    TradePlotWidget(plot).render(place, &mut buffer);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(layout: &TableLayout) -> Vec<&'static str> {
        layout.columns.iter().map(|column| column.name).collect()
    }

    /// Rows were wrapped by the terminal below 100 columns.
    #[test]
    fn a_table_fits_its_terminal() {
        let all = COLUMNS.iter().map(|column| column.width).sum::<usize>();
        for (columns, longest) in [(200, 60), (100, 30), (80, 36), (80, 60), (60, 20), (40, 60), (20, 5)] {
            let layout = TableLayout::new(Some(columns), longest);
            let figures = layout.columns.iter().map(|column| column.width).sum::<usize>();
            let width = figures + if layout.options_beside { GAP + longest } else { 0 };
            assert!(width <= columns.into() || columns == 20, "{columns}, {longest}: {width}");
            assert!(layout.head().chars().count() <= usize::from(columns).max(24) + GAP + "options".len());
            assert!(names(&layout).contains(&"time") && names(&layout).contains(&"wrong%"));
            assert_eq!(
                figures == all,
                columns >= 100 || (columns, longest) == (80, 60),
                "{columns}, {longest}"
            );
            for line in layout.legend().lines() {
                assert!(line.chars().count() <= usize::from(columns).max(30), "{line}");
            }
        }
        // What is in a file is not wrapped.
        let file = TableLayout::new(None, 300);
        assert!(file.options_beside && file.columns.len() == COLUMNS.len());
        assert_eq!(
            names(&TableLayout::new(Some(80), 36)),
            ["time", "±%", "wrong%", "by 2%", "rms", "cells%"]
        );
    }

    #[test]
    fn words_go_to_the_next_line_where_there_is_no_room() {
        assert_eq!(wrapped("--depth 2 --samples 3", 14, "  "), "  --depth 2\n    --samples\n    3\n");
        assert_eq!(wrapped("", 14, "  "), "  \n");
    }
}

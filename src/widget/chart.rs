//! The flow chart: a line per stage with its own count and its share of the time.

use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::{Color, Style};
use ratatui_core::widgets::Widget;

use super::figures;
use crate::frame::{Frame, Space};
use crate::math::{Grid, Size};
use crate::plan::Shading;
use crate::stage::{Counts, Stage, StageTimes, WorkStep};

/// Columns of a stage's number and name, and the blank before each.
const NAME_COLUMNS: u16 = 11;
/// Columns of the count.
const COUNT_COLUMNS: u16 = 8;

/// The eleven stages of a frame, one line each: number, name, its own count, and a bar that fills the rest
/// of the width for its share of the time. A stage that did nothing is dim. Wants 11 rows and 24 columns or
/// more; what does not fit is cut off.
#[derive(Clone, Debug)]
pub struct FlowChart {
    counts: Counts,
    times: StageTimes,
    objects: usize,
    space: Space,
    field: [f64; 2],
    shading: Option<Shading>,
    bytes: Option<usize>,
    working: Option<WorkStep>,
    /// Whether there is a frame that it is of.
    counted: bool,
    lit: Style,
    dim: Style,
    /// The stage of a ray that is in hand, and how its line is drawn.
    in_hand: Option<(Stage, Style)>,
}

/// What one line says.
struct Line {
    count: String,
    /// Whether the stage did anything.
    busy: bool,
}

impl FlowChart {
    /// The chart of what a frame counted.
    pub fn new(frame: &Frame) -> Self {
        Self {
            counts: frame.counts,
            times: frame.times,
            objects: frame.objects,
            space: frame.space,
            field: frame.field,
            shading: None,
            bytes: None,
            working: None,
            counted: true,
            lit: Style::new().fg(Color::Gray),
            dim: Style::new().fg(Color::DarkGray),
            in_hand: None,
        }
    }

    /// The chart before anything was counted.
    pub fn idle() -> Self {
        let nothing = Size::new(0, 0);
        Self { counted: false, ..Self::new(&Frame::blank(nothing, Grid::from_values(nothing, Vec::new()))) }
    }

    /// What is at work: its stage has a mark, its part of the whole in place of its count, and a bar for
    /// that.
    #[must_use]
    pub const fn working(mut self, step: Option<WorkStep>) -> Self {
        self.working = step;
        self
    }

    /// The stage that a ray is in, where one is followed while the picture is drawn, and how its line is
    /// drawn.
    #[must_use]
    pub fn in_hand(mut self, stage: Option<Stage>, style: Style) -> Self {
        self.in_hand = stage.map(|stage| (stage, style));
        self
    }

    /// The model shown by SHADE.
    #[must_use]
    pub const fn shading(mut self, shading: Shading) -> Self {
        self.shading = Some(shading);
        self
    }

    /// What DISPLAY sent to a terminal, and the time this took beyond that of the frame itself.
    #[must_use]
    pub fn sent(mut self, bytes: usize, time: Duration) -> Self {
        self.bytes = Some(bytes);
        self.times[Stage::Display] += time;
        self
    }

    /// How a line is drawn, and how that of a stage that did nothing.
    #[must_use]
    pub const fn styles(mut self, lit: Style, dim: Style) -> Self {
        self.lit = lit;
        self.dim = dim;
        self
    }

    fn line(&self, stage: Stage) -> Line {
        let counts = &self.counts;
        let rays = counts.rays();
        let counted = |n: u64| Line { count: figures::count(n), busy: n > 0 };
        let mean = |n: u64| match figures::per_ray(n, rays) {
            Some(count) if n > 0 => Line { count, busy: true },
            _ => Line::idle(),
        };
        match stage {
            Stage::Objects => counted(self.objects as u64),
            Stage::Lattice => match self.space {
                Space::Whole => Line::idle(),
                Space::Tree(nodes) | Space::Boxes(nodes) => {
                    let number = figures::count(nodes as u64);
                    let named = format!("{number} node{}", if nodes == 1 { "" } else { "s" });
                    let fits = named.chars().count() <= COUNT_COLUMNS.into();
                    Line { count: if fits { named } else { number }, busy: true }
                }
                Space::Lattice([x, y, z]) => {
                    let sides = format!("{x}×{y}×{z}");
                    let fits = sides.chars().count() <= COUNT_COLUMNS.into();
                    let cells = || figures::count(x.saturating_mul(y).saturating_mul(z) as u64);
                    Line { count: if fits { sides } else { cells() }, busy: true }
                }
            },
            Stage::View => match self.field {
                // A frame that is still blank.
                [0.0, 0.0] => Line::idle(),
                [across, down] => Line { count: format!("{across:.0}×{down:.0}°"), busy: true },
            },
            Stage::Ray => counted(rays),
            Stage::Clip => counted(counts.clipped_rays),
            Stage::Cell => mean(counts.cells_visited),
            Stage::Solid => mean(counts.primitive_tests),
            Stage::Csg => mean(counts.csg_evaluations),
            Stage::Shade => self.shading.map_or_else(
                || counted(counts.primary_hits),
                |shading| Line {
                    count: format!("eq. ({})", shading.number()),
                    busy: counts.primary_hits > 0,
                },
            ),
            Stage::Dither => {
                Line { count: "13".to_owned(), busy: rays > 0 || !self.times[Stage::Dither].is_zero() }
            }
            Stage::Display => {
                self.bytes.map_or_else(Line::idle, |bytes| Line { count: figures::bytes(bytes), busy: true })
            }
        }
    }

    /// The part of the whole time, in `0..=1`.
    fn share(&self, stage: Stage) -> f64 {
        let total = self.times.total();
        if total.is_zero() { 0.0 } else { self.times[stage].as_secs_f64() / total.as_secs_f64() }
    }
}

impl Line {
    fn idle() -> Self {
        Self { count: "-".to_owned(), busy: false }
    }

    fn at_work(step: WorkStep) -> Self {
        let count =
            step.percent.map_or_else(|| step.task.name().to_owned(), |percent| format!("{percent} %"));
        Self { count, busy: true }
    }
}

/// A bar in steps of half a column, rounded.
fn bar(share: f64, columns: u16) -> String {
    let whole = usize::from(columns) * 2;
    let steps = ((share * whole as f64).round() as usize).min(whole);
    let mut bar = "█".repeat(steps / 2);
    bar.push_str(if steps % 2 == 1 { "▌" } else { "" });
    bar
}

impl Widget for FlowChart {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        (&self).render(area, buffer);
    }
}

impl Widget for &FlowChart {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        let bar_columns = area.width.saturating_sub(NAME_COLUMNS + COUNT_COLUMNS + 1);
        for (y, stage) in (area.top()..area.bottom()).zip(Stage::ALL) {
            let step = self.working.filter(|step| step.task.stage() == stage);
            let line = match step {
                Some(step) => Line::at_work(step),
                None if self.counted => self.line(stage),
                None => Line::idle(),
            };
            let in_hand = self.in_hand.filter(|(in_hand, _)| *in_hand == stage);
            let style = match in_hand {
                Some((_, style)) => style,
                None if line.busy => self.lit,
                None => self.dim,
            };
            let text = format!(
                "{:>2}{}{:<8}{:>width$} ",
                stage.number(),
                if step.is_some() || in_hand.is_some() { '►' } else { ' ' },
                stage.name(),
                line.count,
                width = COUNT_COLUMNS.into()
            );
            let (x, _) = buffer.set_stringn(area.x, y, text, area.width.into(), style);
            let share =
                step.map_or_else(|| self.share(stage), |step| f64::from(step.percent.unwrap_or(0)) / 100.0);
            buffer.set_stringn(x, y, "░".repeat(bar_columns.into()), bar_columns.into(), self.dim);
            buffer.set_stringn(x, y, bar(share, bar_columns), bar_columns.into(), self.lit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Task;

    fn frame() -> Frame {
        let mut times = StageTimes::default();
        times[Stage::Cell] = Duration::from_millis(3);
        times[Stage::Solid] = Duration::from_millis(1);
        times[Stage::Shade] = Duration::from_micros(1);
        Frame {
            counts: Counts {
                primary_rays: 30_832,
                primary_hits: 8_000,
                shadow_rays: 8_000,
                clipped_rays: 8_114,
                cells_visited: 81_547,
                primitive_tests: 54_364,
                ..Counts::default()
            },
            times,
            objects: 9,
            space: Space::Lattice([4, 3, 5]),
            field: [40.0, 25.0],
            ..Frame::blank(Size::new(0, 0), Grid::from_values(Size::new(0, 0), Vec::new()))
        }
    }

    fn drawn(chart: &FlowChart, width: u16, height: u16) -> (Buffer, Vec<String>) {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
        chart.render(buffer.area, &mut buffer);
        let lines = buffer
            .content
            .chunks(usize::from(width).max(1))
            .map(|row| row.iter().map(ratatui_core::buffer::Cell::symbol).collect::<String>())
            .collect();
        (buffer, lines)
    }

    #[test]
    fn each_stage_has_its_count_and_its_share() {
        let chart = FlowChart::new(&frame()).shading(Shading::Phong).sent(1_946, Duration::ZERO);
        let (buffer, lines) = drawn(&chart, 24, 11);
        assert_eq!(
            lines,
            [
                " 1 OBJECTS        9 ░░░░",
                " 2 LATTICE    4×3×5 ░░░░",
                " 3 VIEW      40×25° ░░░░",
                " 4 RAY       38 832 ░░░░",
                " 5 CLIP       8 114 ░░░░",
                " 6 CELL     2.1/ray ███░",
                " 7 SOLID    1.4/ray █░░░",
                " 8 CSG            - ░░░░",
                " 9 SHADE    eq. (3) ░░░░",
                "10 DITHER        13 ░░░░",
                "11 DISPLAY   1.9 KB ░░░░",
            ]
        );
        assert_eq!(buffer[(0, 10)].fg, Color::Gray);
        assert_eq!(buffer[(3, 7)].fg, Color::DarkGray, "CSG did nothing");
    }

    #[test]
    fn the_stage_at_work_has_a_mark_and_a_bar() {
        let step = WorkStep { task: Task::Cutting, percent: Some(50) };
        let (_, lines) = drawn(&FlowChart::idle().working(Some(step)), 24, 3);
        assert_eq!(
            lines,
            [" 1 OBJECTS        - ░░░░", " 2►LATTICE     50 % ██░░", " 3 VIEW           - ░░░░"]
        );
        let (_, lines) = drawn(&FlowChart::idle().working(Some(WorkStep { percent: None, ..step })), 24, 2);
        assert_eq!(lines[1], " 2►LATTICE building ░░░░");
    }

    #[test]
    fn a_large_lattice_shows_its_cells() {
        let chart = FlowChart::new(&Frame { space: Space::Lattice([128, 128, 100]), ..frame() });
        assert!(drawn(&chart, 24, 2).1[1].contains(" 1.6 M"));
    }

    #[test]
    fn a_tree_shows_its_nodes() {
        for (nodes, shown) in [(1, "   1 node "), (34, "34 nodes "), (345, "     345 ")] {
            let chart = FlowChart::new(&Frame { space: Space::Tree(nodes), ..frame() });
            assert!(drawn(&chart, 24, 2).1[1].contains(shown), "{nodes}");
        }
    }

    #[test]
    fn no_area_is_too_small() {
        for (width, height) in [(0, 0), (1, 1), (5, 3), (19, 2), (20, 40)] {
            drawn(&FlowChart::new(&frame()), width, height);
        }
    }
}

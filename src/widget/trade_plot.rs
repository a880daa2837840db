//! The trade of time for accuracy as a chart.

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::{Color, Style};
use ratatui_core::symbols::Marker;
use ratatui_core::widgets::Widget;
use ratatui_widgets::chart::{Axis, Chart, Dataset, GraphType};

use crate::trade::{LogAxis, TradePlot};

/// What is on the front.
const FRONT: char = 'o';
/// What another setting beats.
const BEATEN: char = '·';
/// What shows another picture on purpose.
const OTHER: char = 'x';
/// The setting that is in use, wherever it is.
const OWN: char = '♦';

/// Log time across, log wrong levels up, a mark for each setting, the front as a line through its own. Wants
/// 40 columns and 10 rows; what does not fit is left out.
#[derive(Clone, Copy, Debug)]
pub struct TradePlotWidget<'a>(pub &'a TradePlot);

impl TradePlotWidget<'_> {
    /// What the marks mean, in a line.
    pub fn legend() -> String {
        format!(
            "{OWN} as asked   {FRONT} on the front   {BEATEN} beaten   {OTHER} another picture, on purpose"
        )
    }
}

impl Widget for TradePlotWidget<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let Self(plot) = self;
        let places = |is_drawn: &dyn Fn(usize) -> bool| -> Vec<(f64, f64)> {
            let drawn = plot.points.iter().enumerate().filter(|(place, _)| is_drawn(*place));
            drawn.map(|(_, point)| (point.time, point.wrong)).collect()
        };
        let line: Vec<(f64, f64)> =
            plot.front.iter().map(|&place| (plot.points[place].time, plot.points[place].wrong)).collect();
        let others = places(&|place| plot.points[place].is_another_picture);
        let front = places(&|place| plot.is_on_front(place));
        let beaten = places(&|place| !plot.points[place].is_another_picture && !plot.is_on_front(place));
        let own = places(&|place| place == plot.present);
        let marks = |data, mark, color| {
            Dataset::default()
                .data(data)
                .marker(Marker::Custom(mark))
                .graph_type(GraphType::Scatter)
                .style(Style::new().fg(color))
        };
        let through = Dataset::default()
            .data(&line)
            .marker(Marker::Braille)
            .graph_type(GraphType::Line)
            .style(Style::new().fg(Color::DarkGray));
        // The later are drawn over the earlier.
        Chart::new(vec![
            through,
            marks(&beaten, BEATEN, Color::Gray),
            marks(&others, OTHER, Color::DarkGray),
            marks(&front, FRONT, Color::White),
            marks(&own, OWN, Color::Yellow),
        ])
        .legend_position(None)
        .x_axis(axis("ms", plot.time))
        .y_axis(axis("% of levels wrong", plot.wrong))
        .render(area, buffer);
    }
}

fn axis(title: &str, axis: LogAxis) -> Axis<'_> {
    let labels: Vec<String> = axis.ticks().into_iter().map(|tick| tick.label).collect();
    Axis::default().title(title).bounds([axis.low, axis.high]).labels(labels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trade::PlotPoint;

    fn text(plot: &TradePlot, width: u16, height: u16) -> Vec<String> {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
        TradePlotWidget(plot).render(buffer.area, &mut buffer);
        let line = |y| (0..width).map(|x| buffer[(x, y)].symbol()).collect::<String>().trim_end().to_owned();
        (0..height).map(line).collect()
    }

    #[test]
    fn the_front_is_drawn_through_its_marks() {
        let point = |time: f64, wrong: f64| PlotPoint { time, wrong, is_another_picture: false };
        let plot = TradePlot {
            points: vec![
                point(0.5, 0.5),
                point(0.1, 0.9),
                point(1.4, -0.9),
                point(1.0, 0.6),
                PlotPoint { is_another_picture: true, ..point(0.3, -0.5) },
            ],
            front: vec![1, 0, 2],
            present: 0,
            time: LogAxis { low: 0.0, high: 1.5 },
            wrong: LogAxis { low: -1.0, high: 1.0 },
        };
        insta::assert_snapshot!(text(&plot, 60, 16).join("\n"));
        // However small, it is drawn or left out.
        for (width, height) in [(0, 0), (1, 1), (10, 3), (300, 2)] {
            text(&plot, width, height);
        }
        text(&TradePlot::default(), 60, 16);
    }
}

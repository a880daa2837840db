//! The plot of time against accuracy as SVG.

use std::fmt::Write;

use super::plot::{LogAxis, TradePlot};

/// Width and height, in pixels of a screen.
const SIZE: [f64; 2] = [640.0, 400.0];
/// Left, top, right and bottom of the field of marks.
const FIELD: [f64; 4] = [60.0, 20.0, 620.0, 350.0];

/// The colour of lines and marks: middle gray, which shows on light pages and on dark ones.
const INK: &str = "#808080";

/// Log time across, log wrong levels up: a grid of half decades, the front as a line, and for each setting a
/// mark: a large dot on the front, a small one where another beats it, a cross for another picture, and a
/// ring around the request's own.
pub fn svg(plot: &TradePlot) -> String {
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"{INK}\" stroke=\"none\" \
         stroke-width=\"1.5\">\n<title>Time of a picture against its wrong levels</title>\n"
    );
    grid(&mut svg, plot);
    let at = |place: usize| {
        let point = &plot.points[place];
        (across(plot.time, point.time), up(plot.wrong, point.wrong))
    };
    let line: String =
        plot.front.iter().map(|&place| at(place)).map(|(x, y)| format!("{x:.1},{y:.1} ")).collect();
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-opacity=\"0.6\"/>",
        line.trim_end()
    );
    for (place, point) in plot.points.iter().enumerate() {
        let (x, y) = at(place);
        let _ = if point.is_another_picture {
            let (left, right, above, below) = (x - 3.0, x + 3.0, y - 3.0, y + 3.0);
            writeln!(
                svg,
                "<path d=\"M{left:.1} {above:.1}L{right:.1} {below:.1}M{left:.1} {below:.1}L{right:.1} {above:.1}\" \
                 stroke=\"{INK}\" stroke-opacity=\"0.6\"/>"
            )
        } else {
            let radius = if plot.is_on_front(place) { 4.0 } else { 1.5 };
            writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>")
        };
    }
    if !plot.points.is_empty() {
        let (x, y) = at(0);
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\" fill=\"none\" stroke=\"{INK}\"/>");
    }
    svg.push_str("</svg>\n");
    svg
}

/// The lines of the half decades, their numbers, and what they are of.
fn grid(svg: &mut String, plot: &TradePlot) {
    let [left, top, right, bottom] = FIELD;
    let line = "stroke=\"#808080\" stroke-opacity=\"0.3\"";
    for tick in plot.time.ticks() {
        let x = across(plot.time, tick.at);
        let _ = writeln!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" {line}/>");
        let y = bottom + 16.0;
        let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", tick.label);
    }
    for tick in plot.wrong.ticks() {
        let y = up(plot.wrong, tick.at);
        let _ = writeln!(svg, "<path d=\"M{left} {y:.1}H{right}\" {line}/>");
        let (x, y) = (left - 6.0, y + 4.0);
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{}</text>", tick.label);
    }
    let (x, y) = (f64::midpoint(left, right), bottom + 38.0);
    let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">a picture, ms</text>");
    let y = f64::midpoint(top, bottom);
    let _ = writeln!(
        svg,
        "<text x=\"16\" y=\"{y}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {y})\">wrong levels, %</text>"
    );
}

fn across(axis: LogAxis, value: f64) -> f64 {
    let [left, _, right, _] = FIELD;
    left + axis.place(value) * (right - left)
}

fn up(axis: LogAxis, value: f64) -> f64 {
    let [_, top, _, bottom] = FIELD;
    bottom - axis.place(value) * (bottom - top)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trade::plot::PlotPoint;

    #[test]
    fn each_setting_has_its_mark() {
        let point = |time, wrong| PlotPoint { time, wrong, is_another_picture: false };
        let plot = TradePlot {
            points: vec![
                point(0.0, 1.0),
                point(1.0, 0.0),
                PlotPoint { is_another_picture: true, ..point(0.2, 0.9) },
            ],
            front: vec![0, 1],
            present: 0,
            time: LogAxis { low: 0.0, high: 1.0 },
            wrong: LogAxis { low: 0.0, high: 1.0 },
        };
        insta::assert_snapshot!(svg(&plot));
        assert!(svg(&TradePlot::default()).ends_with("</svg>\n"));
    }
}

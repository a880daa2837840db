//! Time against accuracy as points of a plot: what is drawn on a screen and into files alike.

use super::measurement::Measurement;
use super::sweep::Sweep;

/// A plot: log time across, log wrong levels up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TradePlot {
    /// All points, in the order of what was measured; the first is the request's own.
    pub points: Vec<PlotPoint>,
    /// The points on the front, from the fastest.
    pub front: Vec<usize>,
    /// The point of the setting that is in use.
    pub present: usize,
    /// Milliseconds of a picture.
    pub time: LogAxis,
    /// Dots with a wrong level, in percent.
    pub wrong: LogAxis,
}

/// One setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotPoint {
    /// The decimal logarithm of its milliseconds.
    pub time: f64,
    /// The decimal logarithm of the percentage of dots with a wrong level. Less than the reference knows is
    /// drawn as that much.
    pub wrong: f64,
    /// Whether it shows another picture on purpose.
    pub is_another_picture: bool,
}

/// An axis of decimal logarithms, from `low` to `high`, both multiples of a half.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LogAxis {
    /// Its one end.
    pub low: f64,
    /// Its other end, more.
    pub high: f64,
}

/// A place of an axis that has a number.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTick {
    /// The decimal logarithm.
    pub at: f64,
    /// The number, to two digits.
    pub label: String,
}

impl TradePlot {
    /// Of what was measured.
    pub fn new(sweep: &Sweep) -> Self {
        Self::of(&sweep.all, sweep.front(), sweep.reference.error().wrong)
    }

    /// Of settings, those on the front, and the least share of wrong levels that is known.
    pub fn of(all: &[Measurement], front: Vec<usize>, known: f64) -> Self {
        let point = |one: &Measurement| PlotPoint {
            time: libm::log10(one.cost().as_secs_f64().max(1e-9) * 1e3),
            wrong: libm::log10(one.wrong().max(known).max(1e-9) * 100.0),
            is_another_picture: one.is_another_picture,
        };
        let points: Vec<PlotPoint> = all.iter().map(point).collect();
        let time = LogAxis::around(points.iter().map(|point| point.time));
        let wrong = LogAxis::around(points.iter().map(|point| point.wrong));
        Self { points, front, present: 0, time, wrong }
    }

    /// Whether a point is on the front.
    pub fn is_on_front(&self, point: usize) -> bool {
        self.front.contains(&point)
    }
}

impl LogAxis {
    /// The shortest that holds all values, half a decade long at least.
    fn around(values: impl Iterator<Item = f64> + Clone) -> Self {
        let (least, most) = (values.clone().reduce(f64::min), values.reduce(f64::max));
        let (least, most) = (least.unwrap_or(0.0), most.unwrap_or(0.0));
        let low = (2.0 * least).floor() / 2.0;
        Self { low, high: ((2.0 * most).ceil() / 2.0).max(low + 0.5) }
    }

    /// The half decades, from the low end.
    pub fn ticks(&self) -> Vec<AxisTick> {
        let steps = (2.0 * (self.high - self.low)).round() as usize;
        let tick = |step: usize| {
            let at = self.low + step as f64 / 2.0;
            AxisTick { at, label: two_digits(libm::pow(10.0, at)) }
        };
        (0..=steps).map(tick).collect()
    }

    /// Where a value lies, from 0 at the low end to 1 at the high one.
    pub fn place(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

/// A number above 0 to two digits, without zeros at its end.
fn two_digits(number: f64) -> String {
    let decimals = (1.0 - libm::floor(libm::log10(number))).max(0.0) as usize;
    let text = format!("{number:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_labelled_by_half_decades() {
        let axis = LogAxis::around([-0.7, 1.2].into_iter());
        assert_eq!((axis.low, axis.high), (-1.0, 1.5));
        let labels: Vec<String> = axis.ticks().into_iter().map(|tick| tick.label).collect();
        assert_eq!(labels, ["0.1", "0.32", "1", "3.2", "10", "32"]);
        assert_eq!([axis.place(-1.0), axis.place(0.25), axis.place(1.5)], [0.0, 0.5, 1.0]);
        // A single value, and none, have an axis too.
        assert_eq!(LogAxis::around([2.0].into_iter()), LogAxis { low: 2.0, high: 2.5 });
        assert_eq!(LogAxis::around(std::iter::empty()), LogAxis { low: 0.0, high: 0.5 });
    }
}

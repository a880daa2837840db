//! What a picture is expected to cost, before it is drawn: what a sample of it did cost, times how much more
//! there is.

use crate::math::Size;
use crate::stage::{Counts, Stage, StageTimes};

use super::{EngineChoice, Plan};

/// What a stage is expected to cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// How often its work is done.
    pub count: f64,
    /// What is counted.
    pub of: &'static str,
    /// What one of them takes, in nanoseconds of one thread.
    pub each: f64,
    /// Whether threads share the work.
    pub shared: bool,
}

impl Cost {
    /// Milliseconds on so many threads, 1 or more.
    pub fn ms(&self, threads: usize) -> f64 {
        self.count * self.each / 1e6 / if self.shared { threads.max(1) as f64 } else { 1.0 }
    }
}

/// A part of a picture that was traced to see what the whole will cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Its dots.
    pub dots: usize,
    /// What was counted in it.
    pub counts: Counts,
    /// What its stages took, on one thread.
    pub times: StageTimes,
    /// What a dot takes to become characters, in nanoseconds; absent where none are wanted.
    pub composing: Option<f64>,
}

/// Digits of a count that is taken from a sample: more would pretend to know.
const DIGITS: f64 = 2.0;

impl Plan {
    /// What each stage from RAY to DITHER is expected to cost in a picture of `dots`, of which `sample` is a
    /// part: `None` where it is left out, or is done along with CELL.
    pub fn costs(&self, sample: &Sample, dots: Size) -> impl Fn(Stage) -> Option<Cost> + use<> {
        let (counts, times, composing) = (sample.counts, sample.times, sample.composing);
        let area = dots.area() as f64;
        let more = area / sample.dots.max(1) as f64;
        let fast = self.engine == EngineChoice::Fast;
        let is_all = sample.dots == dots.area();
        move |stage| {
            let of = |count: u64, of: &'static str, time: f64| {
                let whole = more * count as f64;
                let foreseen = if is_all { whole } else { rounded(whole) };
                (count > 0).then(|| Cost { count: foreseen, of, each: more * time / foreseen, shared: true })
            };
            let time = |stage: Stage| times[stage].as_secs_f64() * 1e9;
            // What no count stands for goes with the walk: of packets that is all up to SHADE.
            let with = |stage: Stage, count: u64| if count == 0 { time(stage) } else { 0.0 };
            let apart = with(Stage::Solid, counts.primitive_tests) + with(Stage::Csg, counts.csg_evaluations);
            match stage {
                Stage::Ray => {
                    // As many for each dot as in the sample, whatever is traced of it.
                    let count = (more * counts.primary_rays as f64).round();
                    let each = more * (time(Stage::Ray) + time(Stage::Clip)) / count;
                    (count > 0.0).then_some(Cost { count, of: "ray", each, shared: true })
                }
                Stage::Cell if fast => of(counts.rays(), "ray", time(Stage::Cell) + apart),
                Stage::Cell => of(counts.cells_visited, "step", time(Stage::Cell)),
                Stage::Solid => of(counts.primitive_tests, "test", time(Stage::Solid)),
                Stage::Csg => of(counts.csg_evaluations, "expression", time(Stage::Csg)),
                Stage::Shade => {
                    of(counts.primary_hits + counts.secondary_hits, "surface", time(Stage::Shade))
                }
                Stage::Dither => composing.map(|each| Cost { count: area, of: "dot", each, shared: true }),
                _ => None,
            }
        }
    }
}

/// A count to its first digits.
fn rounded(count: f64) -> f64 {
    let step = libm::pow(10.0, (libm::floor(libm::log10(count.max(1.0))) + 1.0 - DIGITS).max(0.0));
    (count / step).round() * step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_keep_their_first_digits() {
        for (count, kept) in [(0.4, 0.0), (7.0, 7.0), (99.4, 99.0), (994.0, 990.0), (12_345.0, 12_000.0)] {
            assert!((rounded(count) - kept).abs() < 1e-9 * count, "{count}");
        }
    }
}

//! The time that each stage takes.

use std::time::Instant;

use super::probe::Probe;
use super::{Stage, StageTimes};

/// Adds up the time spent in each stage, where it is started. Whether it is, is known only while the program
/// runs: what is traced is compiled once for both.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    times: StageTimes,
    /// The stage that the work belongs to, and since when; absent where nothing is timed.
    running: Option<(Stage, Instant)>,
}

impl Stopwatch {
    /// A watch that stands still.
    pub fn still() -> Self {
        Self::default()
    }

    /// A watch that runs, in `stage`.
    pub fn start(stage: Stage) -> Self {
        Self { times: StageTimes::default(), running: Some((stage, Instant::now())) }
    }

    /// The time of each stage since the start; none where it stood still.
    pub fn stop(mut self) -> StageTimes {
        if let Some((stage, _)) = self.running {
            self.at(stage);
        }
        self.times
    }

    fn add_lap(&mut self, stage: Stage) {
        if let Some((before, since)) = &mut self.running {
            let now = Instant::now();
            self.times[*before] += now - *since;
            (*before, *since) = (stage, now);
        }
    }
}

impl Probe for Stopwatch {
    #[inline]
    fn at(&mut self, stage: Stage) {
        if self.running.is_some() {
            self.add_lap(stage);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_watch_that_runs_has_times_and_they_are_of_the_stages_it_passed() {
        let mut still = Stopwatch::still();
        still.at(Stage::Cell);
        assert_eq!(still.stop(), StageTimes::default());
        let mut watch = Stopwatch::start(Stage::Ray);
        watch.at(Stage::Cell);
        let since = Instant::now();
        while since.elapsed().is_zero() {}
        let times = watch.stop();
        assert!(!times[Stage::Cell].is_zero());
        assert_eq!(times[Stage::Ray] + times[Stage::Cell], times.total());
    }
}

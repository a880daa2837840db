//! The front: the settings for which no other is both faster and more accurate (Pareto, 1906).

use std::time::Duration;

use super::measurement::Measurement;

/// The settings, by their places in `all` and from the fastest, that no other beats: each that is faster has
/// more wrong levels, by a share of more than `known`, that of the reference itself: less is not told apart.
///
/// Times have a spread, and which of two that are as fast ([`Measurement::is_as_fast_as`]) is the faster one
/// changes from run to run. So the fastest of those that are more accurate than what is on the front already
/// stands for all that are as fast as it: of these the most accurate is taken, and of several that are as
/// accurate as that one, the one nearest to what was asked for: with the fewest knobs turned, then the first
/// that was measured.
///
/// What shows another picture on purpose is no answer, and left out; so is what is neither more accurate than
/// the first of all, the request's own, nor faster, most of the time, than that ever was: no reason to turn a
/// knob. Of many knobs that change nothing in a scene one seems to be faster by chance.
pub fn front(all: &[Measurement], known: f64) -> Vec<usize> {
    let wrong = |place: usize| all[place].wrong();
    let is_answer = |place: usize| {
        let is_more_accurate = wrong(place) + known < wrong(0);
        let is_faster = all[place].times.middle_half()[1] < all[0].times.least();
        !all[place].is_another_picture && (place == 0 || is_more_accurate || is_faster)
    };
    let mut left: Vec<usize> = (0..all.len()).filter(|&place| is_answer(place)).collect();
    let mut found: Vec<usize> = Vec::new();
    while let Some(&fastest) = left.iter().min_by_key(|&&place| (all[place].cost(), place)) {
        let as_fast = || left.iter().copied().filter(|&place| all[place].is_as_fast_as(&all[fastest]));
        let least = as_fast().map(wrong).fold(f64::INFINITY, f64::min);
        let as_accurate = as_fast().filter(|&place| wrong(place) <= least + known);
        let Some(nearest) = as_accurate.min_by_key(|&place| (all[place].turned, place)) else { break };
        found.push(nearest);
        left.retain(|&place| wrong(place) + known < wrong(nearest));
    }
    // One whose times are spread widely may stand for faster ones, and then be slower than the next.
    found.sort_by_key(|&place| (all[place].cost(), place));
    let mut best = f64::INFINITY;
    found.retain(|&place| {
        let is_better = wrong(place) < best;
        best = best.min(wrong(place));
        is_better
    });
    found
}

/// What an answer has to keep to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wish {
    /// The most time for a picture.
    pub within: Option<Duration>,
    /// The largest share of dots with a wrong level, 0 to 1.
    pub error: Option<f64>,
}

impl Wish {
    /// Whether a setting keeps to it.
    pub fn is_met_by(&self, one: &Measurement) -> bool {
        self.within.is_none_or(|within| one.cost() <= within)
            && self.error.is_none_or(|error| one.wrong() <= error)
    }

    /// The setting on the front that meets it: with a limit of error the fastest, else the most accurate.
    /// `None` where there is none.
    pub fn recommended(&self, all: &[Measurement], known: f64) -> Option<usize> {
        let mut fitting = front(all, known).into_iter().filter(|&place| self.is_met_by(&all[place]));
        if self.error.is_some() { fitting.next() } else { fitting.next_back() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::GlyphMode;
    use crate::plan::Options;
    use crate::tone::Level;
    use crate::trade::layers::{Accuracy, LightError};
    use crate::trade::levels::LevelDifference;
    use crate::trade::setting::Setting;
    use crate::trade::timing::Times;

    /// A setting of some milliseconds that has so many of 100 levels wrong.
    fn measured(ms: u64, wrong: usize) -> Measurement {
        of_dots(100, wrong, &[ms as f64])
    }

    /// A setting whose pictures took some milliseconds, with so many of all levels wrong.
    fn of_dots(dots: usize, wrong: usize, ms: &[f64]) -> Measurement {
        let black = vec![Level::MIN; dots];
        let own: Vec<_> = (0..dots).map(|dot| if dot < wrong { Level::MAX } else { Level::MIN }).collect();
        let levels = LevelDifference::of(&own, &black);
        let mut times = Times::default();
        times.extend(ms.iter().map(|ms| Duration::from_secs_f64(ms / 1e3)));
        Measurement {
            setting: Setting { options: Options::default(), glyphs: GlyphMode::default() },
            times,
            accuracy: Accuracy {
                geometry: None,
                light: LightError { rms: 0.0, largest: 0.0, levels },
                characters: None,
            },
            is_another_picture: false,
            turned: 0,
        }
    }

    #[test]
    fn the_front_leaves_out_what_another_beats() {
        let mut all: Vec<_> = [(4, 5), (1, 9), (2, 9), (8, 1), (9, 3), (4, 6), (20, 0)]
            .map(|(ms, wrong)| measured(ms, wrong))
            .into();
        assert_eq!(front(&all, 0.0), [1, 0, 3, 6]);
        // What differs by 1 % is not told apart, nor by 4 %: then the first is no better than the fastest,
        // and only the last better than both.
        assert_eq!(front(&all, 0.01), [1, 0, 3]);
        assert_eq!(front(&all, 0.045), [1, 6]);
        all.push(measured(0, 0));
        all[7].is_another_picture = true;
        assert_eq!(front(&all, 0.0), [1, 0, 3, 6]);
        assert_eq!(front(&[], 0.0), [0; 0]);
    }

    /// Settings of `trade hanyang --cells 40x20 --seconds 8 --threads 1`, twice on a machine where eleven
    /// programs ran on two cores: how many knobs are turned, how many levels are wrong, and of each run the
    /// shortest, the middle and the longest time of the pictures in the middle.
    const TWO_RUNS: [(usize, usize, [[f64; 3]; 2]); 11] = [
        (0, 634, [[20.0, 27.9, 27.9], [19.8, 20.2, 20.2]]), // as asked
        (1, 634, [[10.1, 20.0, 28.4], [19.3, 20.0, 20.0]]), // --precision single
        (1, 406, [[51.9, 68.0, 88.0], [47.9, 51.7, 87.5]]), // --samples 2
        (1, 149, [[118.0, 136.0, 144.0], [122.3, 124.3, 127.7]]), // --aa adaptive --error 0.25
        (1, 638, [[18.7, 19.4, 21.7], [8.0, 16.0, 31.2]]),  // --cutoff 0.11
        (1, 634, [[19.7, 21.5, 26.4], [4.1, 19.8, 30.9]]),  // --threads 2
        (1, 797, [[18.8, 19.0, 26.6], [2.8, 18.0, 27.7]]),  // as asked --glyphs quadrant
        (1, 634, [[16.2, 20.0, 20.1], [4.8, 24.6, 24.8]]),  // --precision double
        (1, 182, [[125.3, 132.0, 139.2], [106.8, 128.9, 143.9]]), // --samples 3
        (1, 106, [[149.6, 161.2, 172.5], [161.7, 169.7, 172.0]]), // --aa adaptive --error 0.125
        (1, 667, [[16.0, 19.5, 22.6], [18.5, 20.0, 39.9]]), // --depth 1
    ];

    /// In the first run `--cutoff 0.11` stood on the front in place of what was asked for, with 0.06 % more
    /// levels wrong, since it was faster by chance.
    #[test]
    fn what_one_run_recommends_is_on_the_front_of_another() {
        let known = 0.006_338;
        let runs = [0, 1].map(|run| -> Vec<_> {
            let measured = |(turned, wrong, times): (usize, usize, [[f64; 3]; 2])| Measurement {
                turned,
                ..of_dots(6400, wrong, &times[run])
            };
            TWO_RUNS.map(measured).into()
        });
        let fronts = [0, 1].map(|run| front(&runs[run], known));
        let mut recommended = 0;
        for (run, other) in [(0, 1), (1, 0)] {
            for one in &runs[run] {
                let within = Wish { within: Some(one.cost()), error: None };
                let error = Wish { within: None, error: Some(one.wrong()) };
                for wish in [within, error] {
                    let Some(place) = wish.recommended(&runs[run], known) else { continue };
                    assert!(
                        fronts[other].contains(&place),
                        "{wish:?}: {place} is not on {:?}",
                        fronts[other]
                    );
                    recommended += 1;
                }
            }
        }
        assert!(recommended > TWO_RUNS.len(), "{recommended}");
        assert!(fronts[0].len() >= 4 && fronts[0].contains(&0), "{fronts:?}");
    }

    /// Of what is as fast, the most accurate is taken; of what is as accurate too, the nearest to what was
    /// asked for, whichever chance has made the fastest.
    #[test]
    fn times_that_are_one_do_not_decide() {
        let at = |turned, wrong, ms: [f64; 3]| Measurement { turned, ..of_dots(100, wrong, &ms) };
        let mut all = vec![at(0, 5, [10.0, 11.0, 12.0]), at(1, 5, [9.0, 10.0, 11.0])];
        assert_eq!(front(&all, 0.0), [0]);
        all.push(at(2, 4, [11.0, 11.5, 12.0]));
        assert_eq!(front(&all, 0.0), [2]);
        // Where that is not told apart, the nearest stays.
        assert_eq!(front(&all, 0.02), [0]);
        // What is faster than that ever was is taken, as accurate as it is.
        all.push(at(1, 5, [1.0, 2.0, 9.9]));
        assert_eq!(front(&all, 0.02), [3]);
    }

    #[test]
    fn a_wish_is_met_by_the_best_that_keeps_to_it() {
        let all: Vec<_> = [(4, 5), (1, 9), (8, 1)].map(|(ms, wrong)| measured(ms, wrong)).into();
        let ms = |ms| Some(Duration::from_millis(ms));
        let wish = |within, error| Wish { within, error }.recommended(&all, 0.0);
        assert_eq!(wish(ms(5), None), Some(0));
        assert_eq!(wish(ms(100), None), Some(2));
        assert_eq!(wish(None, Some(0.06)), Some(0));
        assert_eq!(wish(ms(100), Some(0.2)), Some(1));
        assert_eq!(wish(ms(5), Some(0.01)), None);
        assert_eq!(wish(None, None), Some(2));
    }
}

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
/// the first of all, the request's own, nor faster: no reason to turn a knob.
pub fn front(all: &[Measurement], known: f64) -> Vec<usize> {
    let wrong = |place: usize| all[place].wrong();
    let is_answer = |place: usize| {
        let is_more_accurate = wrong(place) + known < wrong(0);
        let is_faster = all[place].cost() < all[0].cost() && !all[place].is_as_fast_as(&all[0]);
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
        let black = [Level::MIN; 100];
        let own: Vec<_> = (0..100).map(|dot| if dot < wrong { Level::MAX } else { Level::MIN }).collect();
        let levels = LevelDifference::of(&own, &black);
        let mut times = Times::default();
        times.push(Duration::from_millis(ms));
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

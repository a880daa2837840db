//! When the light of a dot is known well enough.

use crate::shade::Channel;
use crate::tone::{Level, Tone};

/// So many standard deviations the mean of a dot is taken to be off at most. With 1.5 a dot that is called
/// decided has another level in one case of fifteen at the border; of 1, 1.5 and 2 it takes the fewest rays
/// for as many wrong levels as 16 rays for each dot leave (`benches/antialiasing`, on hanyang, temple,
/// glass and SPD tree; measured when a dot's light was the plain mean of its rays).
const DEVIATIONS: f64 = 1.5;

/// When a dot is decided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accuracy {
    /// The error that is small enough, as a share of a level, above 0.
    pub error: f64,
    pub tone: Tone,
    /// Whether the three primaries count, and not only the luminance.
    pub color: bool,
}

/// The least and the most light that may be in a dot, by part.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightRange {
    pub least: [f64; 3],
    pub most: [f64; 3],
}

impl Accuracy {
    /// The numbers of a light that count: those past the last are 0.
    pub fn parts<C: Channel>(self, light: C) -> [f64; 3] {
        if self.color && C::PARTS > 1 { light.rgb().to_array() } else { [light.gray(), 0.0, 0.0] }
    }

    /// Whether a light that is so far off its mean, in the root of the mean of squares, and somewhere between
    /// these, is as exact as that.
    pub fn is_met_by(self, mean: [f64; 3], deviation: [f64; 3], possible: &LightRange) -> bool {
        let between = |sign: f64| {
            let end = |part: usize| mean[part] + sign * DEVIATIONS * deviation[part];
            std::array::from_fn(|part| end(part).clamp(possible.least[part], possible.most[part]))
        };
        self.decides(&LightRange { least: between(-1.0), most: between(1.0) })
    }

    /// Whether the light of a dot, somewhere between these, stays in one level, or so near that it does not
    /// matter.
    pub fn decides(self, between: &LightRange) -> bool {
        between.least.into_iter().zip(between.most).all(|(least, most)| {
            let [least, most] = [least, most].map(|light| self.tone.shown(light));
            Level::nearest(least) == Level::nearest(most)
                || Level::position(most) - Level::position(least) <= 2.0 * self.error
        })
    }
}

impl LightRange {
    #[inline]
    pub fn of(parts: [f64; 3]) -> Self {
        Self { least: parts, most: parts }
    }

    #[inline]
    pub fn add(&mut self, parts: [f64; 3]) {
        for part in 0..3 {
            self.least[part] = self.least[part].min(parts[part]);
            self.most[part] = self.most[part].max(parts[part]);
        }
    }

    /// From each end half of the way to a light between them.
    pub fn halfway_to(&self, light: [f64; 3]) -> Self {
        let half = |end: [f64; 3]| std::array::from_fn(|part| f64::midpoint(end[part], light[part]));
        Self { least: half(self.least), most: half(self.most) }
    }

    /// How far it is from the least to the most.
    pub fn width(&self, part: usize) -> f64 {
        self.most[part] - self.least[part]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACCURACY: Accuracy = Accuracy { error: 1.0 / 16.0, tone: Tone::Lightness, color: false };

    fn between(least: f64, most: f64) -> LightRange {
        LightRange { least: [least, 0.0, 0.0], most: [most, 0.0, 0.0] }
    }

    #[test]
    fn a_level_is_decided_between_its_borders_and_nearly_on_them() {
        let level = Level::new(8).unwrap().light();
        assert!(ACCURACY.decides(&between(level - 0.03, level + 0.03)));
        // Its border with level 9 is at 0.4728.
        assert!(!ACCURACY.decides(&between(level, 0.49)));
        assert!(ACCURACY.decides(&between(0.4725, 0.4731)));
        // White may be as bright as it likes.
        assert!(ACCURACY.decides(&between(0.95, 1e300)));
    }
}

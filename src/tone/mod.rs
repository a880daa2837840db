//! Stage 10, DITHER: light in, levels 0 to 12 out.

mod lab;
mod level;
mod lightness;
mod matrix;
mod root;

pub use lab::{color_of_lab, lab_of_color, labs_of_colors};
pub use level::{GRAYS, Level};
pub use lightness::{
    light_of_lightness, light_of_srgb, lightness, lightness_in_single, lightnesses, srgb_of_light,
};
pub use matrix::{FOUR_GRAYS, INK_ONLY, Matrix};

use crate::math::DVec3;
use crate::shade::luminance;
use level::{BORDERS, LIGHTS};

/// How light becomes a level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tone {
    /// The level nearest in lightness (CIE L*).
    #[default]
    Lightness,
    /// Even steps of 1/12 in light, as in 1986.
    Even,
}

impl Tone {
    /// The light, 0 to 1, that the screen should show for a computed `light`, which is clamped to 0 to 1
    /// here.
    ///
    /// [`Tone::Lightness`] changes nothing more. [`Tone::Even`] bends light by straight pieces, so that k/12
    /// is shown as the light of level k, and the borders between the even steps fall on the borders in
    /// lightness: everything that comes after may then forget the tone. NaN, which no stage gives, stays NaN.
    #[inline]
    pub fn shown(self, light: f64) -> f64 {
        let light = light.clamp(0.0, 1.0);
        match self {
            Self::Lightness => light,
            Self::Even => {
                let half_steps = light * 2.0 * f64::from(Level::MAX.get());
                let below = half_steps as usize;
                let (low, high) = (even_knot(below), even_knot(below + 1));
                low + (high - low) * (half_steps - below as f64)
            }
        }
    }

    /// The same for the three primaries of a colour: their luminance is shown as it would be alone, then each
    /// is clamped.
    #[inline]
    pub fn shown_color(self, color: DVec3) -> DVec3 {
        let luminance = luminance(color);
        let scaled = match self {
            Self::Even if luminance > 0.0 => color * (self.shown(luminance) / luminance),
            _ => color,
        };
        scaled.clamp(DVec3::ZERO, DVec3::ONE)
    }

    /// The level that shows `light` (0 to 1; clamped). A light midway between two takes the lighter one; NaN
    /// takes level 0.
    #[inline]
    pub fn level(self, light: f64) -> Level {
        Level::nearest(self.shown(light))
    }
}

/// What is shown at `half_steps` / 24 under [`Tone::Even`]: a level's light, then the border above it, in
/// turn.
#[inline]
fn even_knot(half_steps: usize) -> f64 {
    let level = half_steps / 2;
    if half_steps.is_multiple_of(2) { LIGHTS.get(level) } else { BORDERS.get(level) }.copied().unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn each_level_is_its_own_nearest() {
        for level in Level::all() {
            assert_eq!(Tone::Lightness.level(level.light()), level);
            assert_eq!(Tone::Even.level(f64::from(level.get()) / 12.0), level);
            assert_eq!(Tone::Even.shown(f64::from(level.get()) / 12.0), level.light());
        }
    }

    #[test]
    fn light_outside_the_range_and_nan_have_a_level() {
        for tone in [Tone::Lightness, Tone::Even] {
            assert_eq!(tone.level(-1.0), Level::MIN);
            assert_eq!(tone.level(f64::NEG_INFINITY), Level::MIN);
            assert_eq!(tone.level(7.5), Level::MAX);
            assert_eq!(tone.level(f64::INFINITY), Level::MAX);
            assert_eq!(tone.level(f64::NAN), Level::MIN);
        }
    }

    proptest! {
        #[test]
        fn the_level_is_the_nearest_in_lightness(light in 0.0..=1.0) {
            let chosen = Tone::Lightness.level(light);
            let distance = |level: Level| (lightness(level.light()) - lightness(light)).abs();
            let least = Level::all().map(distance).fold(f64::INFINITY, f64::min);
            prop_assert!(distance(chosen) <= least + 1e-9);
        }

        #[test]
        fn the_even_level_is_the_nearest_twelfth(light in 0.0..=1.0) {
            let away = (f64::from(Tone::Even.level(light).get()) - light * 12.0).abs();
            prop_assert!(away <= 0.5 + 1e-12);
        }

        #[test]
        fn more_light_is_never_a_lower_level(a in 0.0..=1.0, b in 0.0..=1.0) {
            let (low, high) = if a < b { (a, b) } else { (b, a) };
            for tone in [Tone::Lightness, Tone::Even] {
                prop_assert!(tone.shown(low) <= tone.shown(high));
                prop_assert!(tone.level(low) <= tone.level(high));
            }
        }
    }
}

//! How far numbers, normals and lights are apart.

use crate::math::{DVec3, Grid, Size};
use crate::tone::{Tone, lightness};

/// A twelfth of white's CIE L*, 100: from a level to the next in the mean, though the 13 levels are not
/// evenly spaced.
const TWELFTH: f64 = 100.0 / 12.0;

/// So many numbers of 64 bits lie between two, the second among them: 0 for equals, the two zeros and two
/// that are not numbers; `u64::MAX` where one is not a number.
pub(super) fn ulps(a: f64, b: f64) -> u64 {
    if a == b || (a.is_nan() && b.is_nan()) {
        return 0;
    }
    if a.is_nan() || b.is_nan() {
        return u64::MAX;
    }
    // The bits of numbers of one sign are in their order; below 0 it is the other way round.
    let place = |x: f64| {
        let magnitude = x.abs().to_bits().cast_signed();
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b))
}

/// The angle between two directions of length 1, in degrees, 0 to 180; 0 between two that are 0.
pub(super) fn angle(a: DVec3, b: DVec3) -> f64 {
    // From the chord: the cosine of a small angle has no digits left.
    let half_chord = ((a - b).length() / 2.0).min(1.0);
    (2.0 * libm::asin(half_chord)).to_degrees()
}

/// How far two lights of 0 to 1 are apart, in twelfths of white's CIE L*, 0 to 12.
pub(super) fn steps_apart(a: f64, b: f64) -> f64 {
    (lightness(a) - lightness(b)).abs() / TWELFTH
}

/// The root of the mean square of what `apart` says of each two values; 0 of none.
///
/// # Panics
/// Both must have as many values.
pub(super) fn rms(own: &[f64], other: &[f64], apart: impl Fn(f64, f64) -> f64) -> f64 {
    assert_eq!(own.len(), other.len(), "values of the same dots");
    let squares = own.iter().zip(other).map(|(own, other)| apart(*own, *other) * apart(*own, *other));
    (squares.sum::<f64>() / own.len().max(1) as f64).sqrt()
}

/// The light that the tone shows, 0 to 1; NaN, which no stage gives, is no light.
pub(super) fn shown(tone: Tone, light: f64) -> f64 {
    tone.shown(if light.is_nan() { 0.0 } else { light })
}

/// Light as dots of another size of the same screen: a dot that covers several is each of them, several in
/// the place of one are their mean. Sizes are each other's multiples across and down.
pub(super) fn resized(light: &Grid<f64>, size: Size) -> Grid<f64> {
    let own = light.size();
    if own == size {
        return light.clone();
    }
    let range = |place: u32, own: u32, other: u32| {
        let first = u64::from(place) * u64::from(own) / u64::from(other);
        let after = u64::from(place + 1) * u64::from(own) / u64::from(other);
        first as u32..(after as u32).max(first as u32 + 1)
    };
    Grid::from_fn(size, |x, y| {
        let (mut sum, mut dots) = (0.0, 0.0);
        for row in range(y, own.height, size.height) {
            for column in range(x, own.width, size.width) {
                sum += light[(column, row)];
                dots += 1.0;
            }
        }
        sum / dots
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_the_last_place_are_counted_across_zero() {
        assert_eq!([ulps(1.0, 1.0), ulps(0.0, -0.0), ulps(f64::NAN, f64::NAN)], [0; 3]);
        assert_eq!([ulps(1.0, 1.0_f64.next_up()), ulps(1.0, 1.0_f64.next_down())], [1; 2]);
        assert_eq!(ulps(-f64::MIN_POSITIVE, f64::MIN_POSITIVE), 2 * f64::MIN_POSITIVE.to_bits());
        assert_eq!(ulps(1.0, 2.0), 1 << 52);
        assert_eq!(ulps(1.0, f64::NAN), u64::MAX);
    }

    #[test]
    fn small_angles_keep_their_digits() {
        for degrees in [1e-9, 0.1, 45.0, 90.0, 179.0, 180.0] {
            let (sin, cos) = libm::sincos(f64::to_radians(degrees));
            let found = angle(DVec3::X, DVec3::new(cos, sin, 0.0));
            // Rounding of the chord is 2⁻⁵³ of it; near 180° the arc sine makes its root of that.
            assert!((found - degrees).abs() <= 1e-12 * degrees + if degrees > 179.0 { 1e-5 } else { 0.0 });
        }
        assert_eq!(angle(DVec3::ZERO, DVec3::ZERO), 0.0);
    }

    #[test]
    fn dots_are_repeated_or_their_mean_is_taken() {
        let light = Grid::from_values(Size::new(2, 2), vec![0.0, 1.0, 0.5, 0.25]);
        let finer = resized(&light, Size::new(2, 4));
        assert_eq!(finer.values(), [0.0, 1.0, 0.0, 1.0, 0.5, 0.25, 0.5, 0.25]);
        assert_eq!(resized(&finer, light.size()), light);
        assert_eq!(resized(&light, Size::new(1, 1)).values(), [0.4375]);
        assert_eq!(resized(&light, Size::new(4, 1)).values(), [0.25, 0.25, 0.625, 0.625]);
    }

    #[test]
    fn black_and_white_are_twelve_steps_apart() {
        assert!((steps_apart(0.0, 1.0) - 12.0).abs() < 1e-12);
        assert_eq!(rms(&[0.0, 3.0], &[4.0, 3.0], |a, b| (a - b).abs()), 8.0_f64.sqrt());
    }
}

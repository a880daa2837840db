//! Directions without components that are too small to matter.

use crate::math::DVec3;

/// Components below this are 0: 2⁻⁴⁰⁰, about 4·10⁻¹²¹.
///
/// In the assembly's coordinates the world reaches to 2 along each axis, and a ray starts at most 10¹⁰⁰ along each
/// from it. Over such a way a component of 2⁻⁴⁰⁰ moves a ray by 10⁻²⁰ at most, far less than the rounding of any
/// coordinate of the world. And what is left has a reciprocal, whose products with the ways to planes are finite:
/// 10¹⁰⁰ · 2⁴⁰⁰ is about 10²²⁰. So no walk forms 0 · ∞.
const LEAST: f64 = f64::from_bits((1023 - 400) << 52);

/// The same direction, each component exactly 0 or large enough to divide by. Its length stays what it is within
/// rounding, 1.
#[inline]
#[must_use]
pub fn settled(d: DVec3) -> DVec3 {
    DVec3::select(d.abs().cmplt(DVec3::splat(LEAST)), DVec3::ZERO, d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_can_be_divided_by() {
        assert_eq!(LEAST, libm::pow(2.0, -400.0));
        let d = settled(DVec3::new(f64::MIN_POSITIVE, -LEAST, 1.0));
        assert_eq!(d, DVec3::new(0.0, -LEAST, 1.0));
        assert!((1e100 / d.y).is_finite());
        // One zero only: −0 is none.
        assert_eq!(
            settled(DVec3::new(-0.0, -5e-324, -1.0)).to_array().map(f64::to_bits),
            [0.0, 0.0, -1.0].map(f64::to_bits)
        );
    }
}

//! Directions without components that are rounding only.

use crate::math::{DVec3, Mask, Number, Vector};

/// What rounding leaves of a component that is 0: a direction is the sum of a few products of numbers up to
/// 1, eight roundings at most.
const NOISE: f64 = 4.0 * f64::EPSILON;

/// The same direction, each component exactly 0 or large enough to matter over `longest_path`, how far a ray
/// goes at most in the assembly's unit: what moves its end by less than `NOISE`, beside coordinates near 1,
/// is 0. The length of the direction stays 1 within rounding.
///
/// So a ray that is meant to run along a plane does, and does not pass through it at a place that nobody can
/// tell. And what is left can be divided by: the path is at most about 10¹⁰⁰, and no walk forms 0 · ∞.
#[inline]
#[must_use]
pub fn settled(d: DVec3, longest_path: f64) -> DVec3 {
    let d = all_settled(Vector::from(d), longest_path);
    DVec3::new(d.x, d.y, d.z)
}

/// [`settled`], for one direction or for several.
#[inline(always)]
#[must_use]
pub fn all_settled<N: Number>(d: Vector<N>, longest_path: f64) -> Vector<N> {
    let least = d.x.same(NOISE / longest_path.max(1.0));
    let zero = d.x.same(0.0);
    Vector {
        x: d.x.magnitude().is_below(least).choose(zero, d.x),
        y: d.y.magnitude().is_below(least).choose(zero, d.y),
        z: d.z.magnitude().is_below(least).choose(zero, d.z),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_matters() {
        let d = DVec3::new(1e-15, -8e-16, 1.0);
        assert_eq!(settled(d, 0.0), DVec3::new(1e-15, 0.0, 1.0));
        assert_eq!(settled(d, 100.0), d);
        let least = settled(DVec3::new(1e-115, f64::MIN_POSITIVE, 1.0), 1e100);
        assert!((1e100 / least.x).is_finite() && least.y == 0.0);
        // One zero only: −0 is none.
        let zeros = settled(DVec3::new(-0.0, -5e-324, -1.0), 1e100);
        assert_eq!(zeros.to_array().map(f64::to_bits), [0.0, 0.0, -1.0].map(f64::to_bits));
    }
}

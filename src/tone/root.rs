//! Cube roots of light, as exact as `libm`'s and sooner had.

use crate::math::two_product_in_range;

/// How far [`near_cube_root`] may be from the root, divided by the root: 2⁻⁴⁶. Its start is within 3.3 %
/// (Kahan's: a third of the number's bits), and a step of Halley's takes an error e to 2/3 e³: to 2.4·10⁻⁵,
/// then to 9.3·10⁻¹⁵; eight roundings come on top.
pub(super) const NEAR: f64 = 1.0 / (1_u64 << 46) as f64;

/// What, added to a third of the upper half of a number's bits, gives that of nearly its cube root (W. Kahan,
/// in FreeBSD's `s_cbrt.c`: (1023 − 1023/3 − 0.033) · 2²⁰).
const THIRD: u32 = 715_094_163;

/// The cube root of a normal number above 0, to within [`NEAR`].
#[inline]
pub(super) fn near_cube_root(x: f64) -> f64 {
    let halley = |y: f64| {
        let cube = y * y * y;
        y * (cube + 2.0 * x) / (2.0 * cube + x)
    };
    let high = (x.to_bits() >> 32) as u32 / 3 + THIRD;
    halley(halley(f64::from_bits(u64::from(high) << 32)))
}

/// The numbers nearest to the cube roots of `x`, which lie from 2⁻¹⁰ to 2¹⁰: what `libm::cbrt` gives. Several
/// are found side by side.
#[inline]
pub(super) fn cube_roots<const N: usize>(x: [f64; N]) -> [f64; N] {
    let (mut low, mut high) = (x, x);
    for (low, high) in low.iter_mut().zip(&mut high) {
        (*low, *high) = about_cube_root(*low);
    }
    if low == high { low } else { x.map(libm::cbrt) }
}

/// Two numbers about the cube root, equal where no third one can be the nearest to it.
#[inline]
fn about_cube_root(x: f64) -> (f64, f64) {
    let y = near_cube_root(x);
    // A step of Newton's from y, whose cube is taken in twice the bits.
    let (square, below_square) = two_product_in_range(y, y);
    let (cube, below_cube) = two_product_in_range(square, y);
    let step = ((x - cube) - below_cube - below_square * y) / (3.0 * square);
    // The step's own error is that of Newton's method, the square of y's, 2⁻⁹², and less than 2⁻⁹⁵ of
    // rounding.
    let error = y * (1.0 / (1_u64 << 45) as f64 / (1_u64 << 45) as f64);
    (y + (step - error), y + (step + error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn assert_root(x: f64) {
        let exact = libm::cbrt(x);
        assert_eq!(cube_roots([x])[0].to_bits(), exact.to_bits(), "{x}");
        assert!((near_cube_root(x) - exact).abs() <= NEAR * exact, "{x}");
    }

    /// Three octaves: the start's error is the same for each three.
    #[test]
    fn roots_are_those_of_libm() {
        const STEPS: u32 = 1 << 18;
        for k in 0..=STEPS {
            assert_root(1.0 + 7.0 * f64::from(k) / f64::from(STEPS));
        }
    }

    #[test]
    fn cubes_have_their_roots() {
        for k in 1..1000 {
            let root = f64::from(k) / 128.0;
            assert_eq!(cube_roots([root * root * root, 0.5]), [root, libm::cbrt(0.5)]);
        }
    }

    proptest! {
        #[test]
        fn roots_of_light_are_those_of_libm(x in 0.001..1.0) {
            assert_root(x);
        }
    }
}

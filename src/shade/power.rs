//! Powers of cosines: how a highlight falls off.

use std::f64::consts::{LN_2, LOG2_E, SQRT_2};

use crate::math::{Mask, Powers};

/// Past this the squares are as many as the steps of a logarithm.
const MOST: f64 = 1024.0;

/// 1.5 · 2⁵²: a number that is added to it, and taken out again, is rounded to a whole one.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The least exponent of a number that is not subnormal; highlights below that are none.
const LEAST: f64 = f64::MIN_EXP as f64 - 1.0;

/// Terms of 1 + z/3 + z²/5 + …, for z up to (√2 − 1)² / (√2 + 1)² < 0.0295: the next is below 2⁻⁵⁵.
const ATANH_TERMS: u32 = 11;

/// 1 / k!: terms of the exponential series, for arguments up to the half of ln 2. The next is below 2⁻⁵⁷.
const EXP: [f64; 14] = {
    let mut terms = [1.0; 14];
    let mut k = 1;
    while k < terms.len() {
        terms[k] = terms[k - 1] / k as f64;
        k += 1;
    }
    terms
};

/// Of each `x`, in 0..=1, the power `n` above 0; what it gives where `x` is none of these means nothing.
///
/// Most exponents are whole and small: a product of squares, each rounded once, then takes a part of the
/// time. All others go by the logarithm to base 2, whose error `n` magnifies: the answer is within 4·n·|log₂
/// x| + 8 roundings.
#[inline(always)]
pub(super) fn power<N: Powers>(x: N, n: f64) -> N {
    let whole = if n <= MOST { n as u32 } else { 0 };
    if whole > 0 && f64::from(whole) == n { by_squares(x, whole) } else { by_logarithm(x, n) }
}

#[inline(always)]
fn by_squares<N: Powers>(x: N, n: u32) -> N {
    let (mut left, mut square) = (n, x);
    while left & 1 == 0 {
        square = square * square;
        left >>= 1;
    }
    let mut product = square;
    left >>= 1;
    while left > 0 {
        square = square * square;
        if left & 1 == 1 {
            product = product * square;
        }
        left >>= 1;
    }
    product
}

#[inline(always)]
fn by_logarithm<N: Powers>(x: N, n: f64) -> N {
    let exponent = log2(x) * n;
    let none = !exponent.is_at_least(x.same(LEAST)) | x.is_below(x.same(f64::MIN_POSITIVE));
    none.choose(x.same(0.0), exp2(none.choose(x.same(0.0), exponent)))
}

/// The logarithm to base 2 of a number in 2⁻¹⁰²²..=1.
#[inline(always)]
fn log2<N: Powers>(x: N) -> N {
    let (exponent, fraction) = x.parts();
    let high = fraction.is_above(x.same(SQRT_2));
    let fraction = high.choose(fraction * 0.5, fraction);
    let exponent = high.choose(exponent + 1.0, exponent);
    // ln f = 2·atanh((f − 1) / (f + 1)), whose argument is small and exact in its numerator.
    let s = (fraction - 1.0) / (fraction + 1.0);
    let z = s * s;
    let mut sum = x.same(0.0);
    for k in (0..ATANH_TERMS).rev() {
        sum = sum * z + 1.0 / f64::from(2 * k + 1);
    }
    s * sum * (2.0 * LOG2_E) + exponent
}

/// 2 to the power of a number in −1022..=0.
#[inline(always)]
fn exp2<N: Powers>(y: N) -> N {
    let whole = y + ROUNDER - ROUNDER;
    let rest = (y - whole) * LN_2;
    let mut sum = y.same(0.0);
    for term in EXP.into_iter().rev() {
        sum = sum * rest + term;
    }
    sum * whole.exponential()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_those_of_the_library_within_their_roundings() {
        for n in [1.0, 2.0, 3.0, 7.5, 8.0, 24.0, 30.0827, 100.0, 1023.0, 1024.0, 1025.0, 1e6, 0.5, 1e-3] {
            for k in 1..=1000 {
                let x = f64::from(k) / 1000.0;
                let (found, expected) = (power(x, n), libm::pow(x, n));
                let roundings = 4.0 * n * libm::log2(x).abs().max(1.0) + 8.0;
                let off = roundings * f64::EPSILON * expected + f64::MIN_POSITIVE;
                assert!((found - expected).abs() <= off, "{x} {n}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_ends_are_exact_and_nothing_is_not_a_number() {
        for n in [0.3, 1.0, 7.5, 1e300, f64::MAX] {
            assert_eq!(power(1.0, n), 1.0);
            for x in [f64::MIN_POSITIVE, 5e-324, 1e-200, 0.999] {
                assert!((0.0..=1.0).contains(&power(x, n)), "{x} {n}");
            }
        }
        assert_eq!(power(0.5, 2000.0), 0.0);
    }
}

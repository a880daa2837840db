//! What a rounded operation loses.

use super::{DAffine3, DMat3, DVec3};

/// The sum of two numbers as it is rounded, and the rest: together they are the exact sum, unless it
/// overflows (Knuth: The Art of Computer Programming 2, 4.2.2, theorem B).
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The product of two numbers as it is rounded, and the rest: together they are the exact product, unless
/// that or its rest leaves the range of f64. By a fused multiply-add, which is the same on every platform.
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, libm::fma(a, b, -product))
}

/// The same bits for numbers between 2⁻⁴⁰⁰ and 2⁴⁰⁰, and for 0, by products and sums alone, several at a time
/// where it is inlined into a loop (T. J. Dekker, Numerische Mathematik 18, 1971).
#[inline]
pub fn two_product_in_range(a: f64, b: f64) -> (f64, f64) {
    let [(a_high, a_low), (b_high, b_low)] = [halves(a), halves(b)];
    let product = a * b;
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// The upper 26 bits of a number's 53, and the rest (Veltkamp's splitting).
#[inline]
fn halves(x: f64) -> (f64, f64) {
    const SPLIT: f64 = ((1 << 27) + 1) as f64;
    let scaled = x * SPLIT;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// `whole − a·b`, rounded about once.
pub fn rest_of_dot(a: DVec3, b: DVec3, whole: f64) -> f64 {
    let (mut sum, mut lost) = (whole, 0.0);
    for axis in 0..3 {
        let (product, below) = two_product(-a[axis], b[axis]);
        let (next, rest) = two_sum(sum, product);
        sum = next;
        lost += below + rest;
    }
    sum + lost
}

/// How far each number of a product of maps is from what the product of their numbers would be.
pub fn product_rest(outer: &DAffine3, inner: &DAffine3, product: &DAffine3) -> DAffine3 {
    let column = |inner: DVec3, product: DVec3| {
        DVec3::from_array([0, 1, 2].map(|row| rest_of_dot(outer.matrix3.row(row), inner, product[row]).abs()))
    };
    let columns = [0, 1, 2].map(|axis| column(inner.matrix3.col(axis), product.matrix3.col(axis)));
    // product − outer.translation is one number and a rest.
    let moved = [0, 1, 2].map(|row| two_sum(product.translation[row], -outer.translation[row]));
    let translation = column(inner.translation, DVec3::from_array(moved.map(|(sum, _)| sum)));
    DAffine3 {
        matrix3: DMat3::from_cols(columns[0], columns[1], columns[2]),
        translation: translation + DVec3::from_array(moved.map(|(_, rest)| rest.abs())),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn both_products_have_the_same_rest(
            (a, b) in (-1.0..1.0_f64, -1.0..1.0_f64),
            (up, down) in (-390..390_i32, -390..390_i32),
        ) {
            let (a, b) = (libm::scalbn(a, up), libm::scalbn(b, down));
            prop_assume!(a.abs() > 1e-118 && b.abs() > 1e-118);
            prop_assert_eq!(two_product(a, b), two_product_in_range(a, b));
        }
    }

    #[test]
    fn nothing_is_lost() {
        assert_eq!(two_sum(5e14, -5e14), (0.0, 0.0));
        assert_eq!(two_sum(1e16, 1.0), (1e16, 1.0));
        assert_eq!(two_sum(-1.0, 1e16), (1e16, -1.0));
        assert_eq!(two_sum(0.1, 0.2), (0.1 + 0.2, -f64::EPSILON / 8.0));
        let third = 1.0 / 3.0;
        assert_eq!(two_product(3.0, third), (1.0, -f64::EPSILON / 4.0));
        assert_eq!(
            rest_of_dot(DVec3::new(3.0, 1e16, -1e16), DVec3::new(third, 1.0, 1.0), 1.0),
            f64::EPSILON / 4.0
        );
    }

    #[test]
    fn a_product_of_maps_tells_what_each_number_lost() {
        let moved = |scale: f64, by: f64| DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::new(scale, 1.0, 1.0)),
            translation: DVec3::X * by,
        };
        // 3 · ⅓ is rounded to 1, and 1e16 + 1 to 1e16.
        let (outer, inner) = (moved(3.0, 1e16), moved(1.0 / 3.0, 1.0 / 3.0));
        let rest = product_rest(&outer, &inner, &(outer * inner));
        assert_eq!(rest.matrix3, DMat3::from_diagonal(DVec3::X * (f64::EPSILON / 4.0)));
        assert_eq!(rest.translation, DVec3::X * (1.0 - f64::EPSILON / 4.0));
        let whole = moved(3.0, 5e14);
        assert_eq!(product_rest(&whole, &whole, &(whole * whole)), DAffine3::ZERO);
    }
}

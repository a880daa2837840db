//! What a rounded operation loses.

/// The sum of two numbers as it is rounded, and the rest: together they are the exact sum, unless it overflows
/// (Knuth: The Art of Computer Programming 2, 4.2.2, theorem B).
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The product of two numbers as it is rounded, and the rest: together they are the exact product, unless that or its
/// rest leaves the range of f64 (Dekker 1971; by a fused multiply-add, which is the same on every platform).
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, libm::fma(a, b, -product))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost() {
        assert_eq!(two_sum(5e14, -5e14), (0.0, 0.0));
        assert_eq!(two_sum(1e16, 1.0), (1e16, 1.0));
        assert_eq!(two_sum(-1.0, 1e16), (1e16, -1.0));
        let (sum, rest) = two_sum(0.1, 0.2);
        assert!(rest != 0.0 && sum + rest == sum);
        let third = 1.0 / 3.0;
        assert_eq!(two_product(3.0, third), (1.0, -f64::EPSILON / 4.0));
    }
}

//! Numbers as a reader takes them in.

use crate::math::DVec3;

/// Decimal digits: what single precision holds, and a column of three fits a line.
const DIGITS: usize = 6;

/// A number rounded to [`DIGITS`] digits, without zeros at its end.
pub fn figure(value: f64) -> String {
    rounded(value, DIGITS)
}

/// A number rounded to so many digits, one at least, without zeros at its end.
pub fn rounded(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    // −0 is no other place than 0.
    let rounded = rounded + 0.0;
    if rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// A point or a direction.
pub fn triple(v: DVec3) -> String {
    format!("({}, {}, {})", figure(v.x), figure(v.y), figure(v.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits_and_no_zeros_at_their_end() {
        let all = [0.1 + 0.2, -0.0, 1.0, 1_234_567.8, 1e-5, -2.5e300, f64::INFINITY].map(figure);
        assert_eq!(all, ["0.3", "0", "1", "1234570", "1e-5", "-2.5e300", "inf"]);
    }
}

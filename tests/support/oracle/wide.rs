//! Numbers of about 106 bits: the unevaluated sum of two f64 (Dekker 1971; Knuth's two-sum). With so many
//! bits to spare, the textbook formulas are accurate enough, and nothing clever is shared with the program
//! under test.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Number;

/// `hi + lo`, where `hi` is the sum rounded to f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wide {
    hi: f64,
    lo: f64,
}

/// The exact sum of two numbers.
fn two_sum(a: f64, b: f64) -> Wide {
    let hi = a + b;
    let b_part = hi - a;
    Wide { hi, lo: (a - (hi - b_part)) + (b - b_part) }
}

impl Number for Wide {
    fn value(&self) -> f64 {
        self.hi
    }

    /// One Newton step from the f64 root doubles its bits.
    fn sqrt(&self) -> Self {
        if self.hi <= 0.0 {
            return Self::default();
        }
        let root = Self::from(self.hi.sqrt());
        root + (*self - root * root) / (root + root)
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        (self.hi, self.lo).partial_cmp(&(other.hi, other.lo))
    }
}

impl From<f64> for Wide {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let sum = two_sum(high.hi, high.lo + low.hi);
        two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let hi = self.hi * other.hi;
        let lo = self.hi.mul_add(other.hi, -hi) + (self.hi * other.lo + self.lo * other.hi);
        two_sum(hi, lo)
    }
}

impl Div for Wide {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = Self::from(self.hi / other.hi);
        let rest = self - first * other;
        let second = Self::from(rest.hi / other.hi);
        let rest = rest - second * other;
        first + second + Self::from(rest.hi / other.hi)
    }
}

#[test]
fn keeps_what_f64_loses() {
    let (big, small) = (Wide::from(1e16), Wide::from(1.0));
    assert_eq!((big + small - big).value(), 1.0);
    let third = small / Wide::from(3.0);
    assert!((third * Wide::from(3.0) - small).value().abs() < 1e-31);
    let root = Wide::from(2.0).sqrt();
    assert!((root * root - Wide::from(2.0)).value().abs() < 1e-30);
    // (1 + e)² − 1 − 2e = e², all of which f64 rounds away.
    let e = Wide::from(1e-12);
    let square = (small + e) * (small + e) - small - e - e;
    assert!((square.value() - 1e-24).abs() < 1e-30);
}

//! What the oracle's arithmetic must be able to do.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with more bits than f64 has; every f64 is one, exactly.
pub trait Number:
    Clone
    + Debug
    + PartialOrd
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest f64.
    fn value(&self) -> f64;

    /// The square root; 0 for numbers below 0.
    fn sqrt(&self) -> Self;

    /// Whether it is above, below or at 0, exactly: a number may be too small for its [`Number::value`].
    fn sign(&self) -> i32 {
        let zero = Self::from(0.0);
        i32::from(*self > zero) - i32::from(*self < zero)
    }

    fn is_zero(&self) -> bool {
        self.sign() == 0
    }

    fn abs(&self) -> Self {
        if self.sign() < 0 { -self.clone() } else { self.clone() }
    }
}

/// The sum of products `a[i] · b[i]`.
pub fn dot<N: Number, const K: usize>(a: &[N; K], b: &[N; K]) -> N {
    a.iter().zip(b).fold(N::from(0.0), |sum, (a, b)| sum + a.clone() * b.clone())
}

/// The vector product.
pub fn cross<N: Number>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].clone() * b[k].clone() - a[k].clone() * b[j].clone()
    })
}

/// The vector at length 1 in f64, at any scale; 0 stays 0.
pub fn unit<N: Number>(v: &[N; 3]) -> ray13::math::DVec3 {
    let largest = v.iter().fold(N::from(0.0), |most, x| if x.abs() > most { x.abs() } else { most });
    if largest.is_zero() {
        return ray13::math::DVec3::ZERO;
    }
    ray13::math::DVec3::from_array(v.clone().map(|x| (x / largest.clone()).value())).normalize()
}

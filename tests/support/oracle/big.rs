//! Numbers of 600 bits with exponents of 64: no length of f64, nor a product of many, is too large or too
//! small.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};

use super::number::Number;

/// Every operation rounds to the nearest number of this many bits. A determinant of f64 numbers of like size
/// needs 160; what cancels between a coefficient's square and a product is at most 2·log₂ of the ratios of
/// lengths, 60 bits for a distance of 1e9 radii, 80 more for axes as 1 to 1e6 twice over.
const BITS: usize = 600;

const CONTEXT: Context<HalfEven> = Context::new(BITS);

/// A number of [`BITS`] bits.
#[derive(Clone, Debug)]
pub struct Big(Repr<2>);

impl Big {
    fn rounded(result: dashu_float::FpResult<FBig<HalfEven, 2>>) -> Self {
        Self(CONTEXT.unwrap_fp(result).into_repr())
    }
}

impl From<f64> for Big {
    fn from(x: f64) -> Self {
        assert!(x.is_finite(), "{x} is no length");
        Self(Repr::try_from(x).expect("finite"))
    }
}

impl PartialEq for Big {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Add for Big {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded(CONTEXT.add(&self.0, &other.0))
    }
}

impl Sub for Big {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded(CONTEXT.sub(&self.0, &other.0))
    }
}

impl Mul for Big {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::rounded(CONTEXT.mul(&self.0, &other.0))
    }
}

impl Div for Big {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::rounded(CONTEXT.div(&self.0, &other.0))
    }
}

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Number for Big {
    fn value(&self) -> f64 {
        self.0.to_f64().value()
    }

    fn sqrt(&self) -> Self {
        if self.sign() <= 0 { Self::from(0.0) } else { Self::rounded(CONTEXT.sqrt(&self.0)) }
    }
}

#[test]
fn keeps_what_no_f64_can_hold() {
    let ten = |n: i32| libm::pow(10.0, f64::from(n));
    let (huge, tiny) = (Big::from(ten(300)), Big::from(ten(-300)));
    let product = huge.clone() * huge.clone() * huge.clone();
    assert_eq!((product.clone() / huge.clone() / huge.clone()).value(), ten(300));
    assert_eq!((product + tiny.clone() - tiny.clone()).value(), f64::INFINITY);
    assert!((tiny.clone() * tiny.clone()).sign() > 0 && (tiny.clone() * tiny.clone()).value() == 0.0);
    assert_eq!((tiny.clone() * tiny.clone()).sqrt(), tiny);
    assert!((Big::from(0.0) - Big::from(0.0)).is_zero() && -Big::from(0.0) == Big::from(0.0));
    assert_eq!(Big::from(-2.0).sqrt().sign(), 0);
    // The nearest f64, from both sides of the middle between two.
    let half_ulp = Big::from(f64::EPSILON / 2.0);
    let (one, little) = (Big::from(1.0), Big::from(ten(-100)));
    assert_eq!((one.clone() + half_ulp.clone() + little.clone()).value(), 1.0 + f64::EPSILON);
    assert_eq!((one + half_ulp - little).value(), 1.0);
}

//! Sixteen numbers of 24 bits side by side.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, mask32x16, u32x16};

use super::number::{LANES, Mask, Number};
use super::real::{Real, SimdReal, SimdRegister};

/// Numbers of 24 bits; what they are computed with is rounded to that first.
#[derive(Clone, Copy, Debug)]
pub struct F32x16<S: Simd>(f32x16<S>);

/// Answers to a question about each.
#[derive(Clone, Copy, Debug)]
pub struct F32x16Mask<S: Simd>(mask32x16<S>);

impl<S: Simd> Neg for F32x16<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $op:tt;)*) => {$(
        impl<S: Simd> $trait for F32x16<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }
        impl<S: Simd> $trait<f64> for F32x16<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                Self(self.0 $op other as f32)
            }
        }
    )*};
}
operators! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}

impl<S: Simd> Number for F32x16<S> {
    type Mask = F32x16Mask<S>;

    const EPSILON_RATIO: f64 = <f32 as Real>::EPSILON_RATIO;
    const IS_DOUBLE: bool = <f32 as Real>::IS_DOUBLE;
    const LEAST: f64 = f32::MIN_POSITIVE as f64;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        Self(f32x16::splat(self.0.simd, x as f32))
    }
    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn signed_as(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add_precise(factor.0, term.0))
    }
    #[inline(always)]
    fn is_below(self, other: Self) -> F32x16Mask<S> {
        F32x16Mask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn is_at_most(self, other: Self) -> F32x16Mask<S> {
        F32x16Mask(self.0.simd_le(other.0))
    }
    #[inline(always)]
    fn is_above(self, other: Self) -> F32x16Mask<S> {
        F32x16Mask(self.0.simd_gt(other.0))
    }
    #[inline(always)]
    fn is_at_least(self, other: Self) -> F32x16Mask<S> {
        F32x16Mask(self.0.simd_ge(other.0))
    }
    #[inline(always)]
    fn is_equal(self, other: Self) -> F32x16Mask<S> {
        F32x16Mask(self.0.simd_eq(other.0))
    }
}

impl Real for f32 {
    type SimdReal<S: Simd> = F32x16<S>;

    const LANES: usize = 2 * LANES;
    const EPSILON_RATIO: f64 = (Self::EPSILON as f64) / f64::EPSILON;
    const IS_DOUBLE: bool = false;
    const ZERO: Self = 0.0;
    const GREATEST: f64 = Self::MAX as f64;
    const INFINITY: Self = Self::INFINITY;

    #[inline(always)]
    fn nearest(x: f64) -> Self {
        x as Self
    }
}

impl<S: Simd> SimdRegister for F32x16<S> {
    type Real = f32;

    #[inline(always)]
    fn put_into(self, lanes: &mut [f32]) {
        self.0.store_slice(lanes);
    }
    #[inline(always)]
    fn least(self) -> f64 {
        f64::from(self.0.reduce_min())
    }
    #[inline(always)]
    fn greatest(self) -> f64 {
        f64::from(self.0.reduce_max())
    }
}

impl<S: Simd> SimdReal<S> for F32x16<S> {
    type Ids = u32x16<S>;

    #[inline(always)]
    fn all(simd: S, x: f64) -> Self {
        Self(f32x16::splat(simd, x as f32))
    }
    #[inline(always)]
    fn from_lanes(simd: S, lanes: &[f32]) -> Self {
        Self(f32x16::from_slice(simd, lanes))
    }
    #[inline(always)]
    fn answers(simd: S, bits: u64) -> F32x16Mask<S> {
        F32x16Mask(mask32x16::from_bitmask(simd, bits))
    }
    #[inline(always)]
    fn ids(self) -> u32x16<S> {
        self.0.to_int()
    }
}

impl<S: Simd> Mask<F32x16<S>> for F32x16Mask<S> {
    #[inline(always)]
    fn choose(self, yes: F32x16<S>, no: F32x16<S>) -> F32x16<S> {
        F32x16(self.0.select(yes.0, no.0))
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any_true()
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        self.0.to_bitmask()
    }
}

impl<S: Simd> BitAnd for F32x16Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<S: Simd> BitOr for F32x16Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<S: Simd> Not for F32x16Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

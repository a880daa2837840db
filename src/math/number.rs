//! One formula for one ray and for eight: a number that is an `f64`, or eight of them side by side.
//!
//! Every operation is one of IEEE 754's that is rounded correctly, so that each of the eight has the bits
//! that it would have as a single ray's, at every SIMD width. No approximate operation is among them, and no
//! minimum, whose answer to not-a-number differs between processors.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat, SimdMask, f64x8, mask64x8, u64x8};

/// How many rays are computed side by side.
pub const LANES: usize = 8;

/// How many rays a packet has at most: one bit of a word for each, and one register of numbers for each
/// eighth.
pub const PACKET: usize = 64;

/// Digits of a fraction behind its leading 1.
const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;

/// The fraction's bits of 1.
const ONE: u64 = 1.0_f64.to_bits();

/// 2⁵²: beside it a number below 2⁵² stands in the last bits as a whole one.
const WHOLE: f64 = (1_u64 << FRACTION) as f64;

/// What is added to an exponent that is stored.
const BIAS: f64 = (f64::MAX_EXP - 1) as f64;

/// One number, or [`LANES`] of them.
pub trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Answers to a question about each.
    type Mask: Mask<Self>;

    /// How many times as much is lost by a rounding as of an `f64`: the ratio of their machine epsilons.
    const EPSILON_RATIO: f64 = 1.0;
    /// Whether these are double precision. Single precision is a filter: where its answer is uncertain,
    /// double precision decides.
    const IS_DOUBLE: bool = true;
    /// Below this numbers lose digits.
    const LEAST: f64 = f64::MIN_POSITIVE;

    /// `x` for all: as many as there are in `self`.
    #[must_use]
    fn same(self, x: f64) -> Self;
    /// The square root.
    #[must_use]
    fn root(self) -> Self;
    /// The absolute value.
    #[must_use]
    fn magnitude(self) -> Self;
    /// The absolute value with the sign of another number.
    #[must_use]
    fn signed_as(self, sign: Self) -> Self;
    /// `self · factor + term`, rounded once: in software where the processor has no such operation.
    #[must_use]
    fn fused(self, factor: Self, term: Self) -> Self;
    /// `self < other`; false for not-a-number, as are all comparisons.
    fn is_below(self, other: Self) -> Self::Mask;
    /// `self ≤ other`.
    fn is_at_most(self, other: Self) -> Self::Mask;
    /// `self > other`.
    fn is_above(self, other: Self) -> Self::Mask;
    /// `self ≥ other`.
    fn is_at_least(self, other: Self) -> Self::Mask;
    /// `self = other`.
    fn is_equal(self, other: Self) -> Self::Mask;

    /// The larger; `other` where one is not a number.
    #[inline(always)]
    #[must_use]
    fn larger(self, other: Self) -> Self {
        self.is_above(other).choose(self, other)
    }
    /// The smaller; `other` where one is not a number.
    #[inline(always)]
    #[must_use]
    fn smaller(self, other: Self) -> Self {
        self.is_below(other).choose(self, other)
    }
}

/// Numbers of which powers are computed.
pub trait Powers: Number {
    /// Of a positive number that is not subnormal, `f · 2^e` with `1 ≤ f < 2`: the exponent e, and f.
    #[must_use]
    fn parts(self) -> (Self, Self);
    /// `2^self` for whole numbers of −1022 to 1023.
    #[must_use]
    fn exponential(self) -> Self;
}

/// Answers to a question about a [`Number`].
pub trait Mask<N>: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Of each, the one where the answer is yes, the other where it is no.
    fn choose(self, yes: N, no: N) -> N;
    /// Whether any answer is yes.
    fn any(self) -> bool;
    /// The answers as bits, the first the lowest.
    fn bits(self) -> u64;
}

impl Number for f64 {
    type Mask = bool;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn signed_as(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        libm::fma(self, factor, term)
    }
    #[inline(always)]
    fn is_below(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn is_at_most(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn is_above(self, other: Self) -> bool {
        self > other
    }
    #[inline(always)]
    fn is_at_least(self, other: Self) -> bool {
        self >= other
    }
    #[inline(always)]
    fn is_equal(self, other: Self) -> bool {
        self == other
    }
}

impl Powers for f64 {
    #[inline(always)]
    fn parts(self) -> (Self, Self) {
        let bits = self.to_bits();
        let exponent = Self::from_bits(bits >> FRACTION | WHOLE.to_bits()) - (WHOLE + BIAS);
        (exponent, Self::from_bits(bits & !(u64::MAX << FRACTION) | ONE))
    }
    #[inline(always)]
    fn exponential(self) -> Self {
        Self::from_bits((self + (WHOLE + BIAS)).to_bits() << FRACTION)
    }
}

impl Mask<f64> for bool {
    #[inline(always)]
    fn choose(self, yes: f64, no: f64) -> f64 {
        if self { yes } else { no }
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        u64::from(self)
    }
}

impl<S: Simd> Number for f64x8<S> {
    type Mask = mask64x8<S>;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        Self::splat(self.simd, x)
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn signed_as(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        self.mul_add_precise(factor, term)
    }
    #[inline(always)]
    fn is_below(self, other: Self) -> mask64x8<S> {
        self.simd_lt(other)
    }
    #[inline(always)]
    fn is_at_most(self, other: Self) -> mask64x8<S> {
        self.simd_le(other)
    }
    #[inline(always)]
    fn is_above(self, other: Self) -> mask64x8<S> {
        self.simd_gt(other)
    }
    #[inline(always)]
    fn is_at_least(self, other: Self) -> mask64x8<S> {
        self.simd_ge(other)
    }
    #[inline(always)]
    fn is_equal(self, other: Self) -> mask64x8<S> {
        self.simd_eq(other)
    }
}

impl<S: Simd> Powers for f64x8<S> {
    #[inline(always)]
    fn parts(self) -> (Self, Self) {
        let bits: u64x8<S> = self.bitcast();
        let exponent: Self = ((bits >> FRACTION) | WHOLE.to_bits()).bitcast();
        let fraction: Self = ((bits & !(u64::MAX << FRACTION)) | ONE).bitcast();
        (exponent - (WHOLE + BIAS), fraction)
    }
    #[inline(always)]
    fn exponential(self) -> Self {
        let bits: u64x8<S> = (self + (WHOLE + BIAS)).bitcast();
        (bits << FRACTION).bitcast()
    }
}

impl<S: Simd> Mask<f64x8<S>> for mask64x8<S> {
    #[inline(always)]
    fn choose(self, yes: f64x8<S>, no: f64x8<S>) -> f64x8<S> {
        self.select(yes, no)
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.any_true()
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        self.to_bitmask()
    }
}

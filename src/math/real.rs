//! The precision of the numbers of a packet: that of `f64`, or that of `f32`, of which a register holds twice
//! as many.

use std::fmt::Debug;

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8, u32x8};

use super::number::{LANES, Mask, Number, PACKET};

/// From here on, up to its double, the numbers of double precision are the integers.
const INTEGERS: f64 = (1_u64 << 52) as f64;

/// A number of a ray in a packet.
pub trait Real: Copy + Debug + Default + Into<f64> + Send + Sync + 'static {
    /// As many as a register holds, of 512 bits.
    type SimdReal<S: Simd>: SimdReal<S> + SimdRegister<Real = Self>;

    /// How many rays are computed side by side.
    const LANES: usize;
    /// Registers of numbers in a packet.
    const REGISTERS: usize = PACKET / Self::LANES;
    /// A bit for each ray of the first register.
    const REGISTER_BITS: u64 = (1 << Self::LANES) - 1;
    /// [`Number::EPSILON_RATIO`]. Maps, starts and directions come rounded once from `f64`; the rest of each
    /// chain of roundings is the same.
    const EPSILON_RATIO: f64;
    /// [`Number::IS_DOUBLE`].
    const IS_DOUBLE: bool;
    /// 0.
    const ZERO: Self;
    /// The greatest number.
    const GREATEST: f64;
    /// What is beyond all numbers.
    const INFINITY: Self;

    /// The nearest.
    fn nearest(x: f64) -> Self;

    /// The same number for all rays of a register.
    #[inline(always)]
    fn all<S: Simd>(simd: S, x: f64) -> Self::SimdReal<S> {
        Self::SimdReal::<S>::all(simd, x)
    }

    /// The answers of a register, below [`Real::REGISTERS`], out of a bit for each ray of a packet.
    #[inline(always)]
    fn mask_of<S: Simd>(simd: S, bits: u64, register: usize) -> RealMask<Self, S> {
        Self::SimdReal::<S>::answers(simd, bits >> (register * Self::LANES) & Self::REGISTER_BITS)
    }

    /// A bit for each ray of a packet, out of the answers of a register.
    #[inline(always)]
    fn bits_of<M: Mask<Self::SimdReal<S>>, S: Simd>(_: S, answers: M, register: usize) -> u64 {
        answers.bits() << (register * Self::LANES)
    }

    /// Whether any ray of a register is among these.
    #[inline(always)]
    fn has_any(bits: u64, register: usize) -> bool {
        bits >> (register * Self::LANES) & Self::REGISTER_BITS != 0
    }
}

/// Answers to a question about the rays of a register.
pub type RealMask<T, S> = <<T as Real>::SimdReal<S> as Number>::Mask;

/// The ids of the rays of a register.
pub type RealIds<T, S> = <<T as Real>::SimdReal<S> as SimdReal<S>>::Ids;

/// Numbers that fill a register.
pub trait SimdRegister {
    /// One of them.
    type Real;

    /// Writes them to as many lanes as a register has.
    fn put_into(self, lanes: &mut [Self::Real]);
    /// The least; none may be not-a-number.
    fn least(self) -> f64;
    /// The greatest; none may be not-a-number.
    fn greatest(self) -> f64;
}

/// As many ids as a register has lanes.
pub trait SimdIds<S: Simd>: Copy {
    /// The same for all.
    fn all(simd: S, id: u32) -> Self;
    /// Those of as many lanes as a register has.
    fn from_lanes(simd: S, lanes: &[u32]) -> Self;
    /// Writes those whose bits are set to as many lanes as a register has.
    fn put_into(self, simd: S, lanes: &mut [u32], bits: u64);
    /// A bit for each that is the same as in another register.
    fn equal_bits(self, other: Self) -> u64;
}

/// A register of numbers.
pub trait SimdReal<S: Simd>: Number + SimdRegister {
    /// An id for each.
    type Ids: SimdIds<S>;

    /// The same for all.
    fn all(simd: S, x: f64) -> Self;
    /// Those of as many lanes as a register has.
    fn from_lanes(simd: S, lanes: &[Self::Real]) -> Self;
    /// Answers out of a bit for each.
    fn answers(simd: S, bits: u64) -> Self::Mask;
    /// Numbers that are ids, whole and 0 or more, as ids: below 2²⁴ in single precision, below 2³² in double.
    fn ids(self) -> Self::Ids;
}

impl Real for f64 {
    type SimdReal<S: Simd> = f64x8<S>;

    const LANES: usize = LANES;
    const EPSILON_RATIO: f64 = 1.0;
    const IS_DOUBLE: bool = true;
    const ZERO: Self = 0.0;
    const GREATEST: f64 = Self::MAX;
    const INFINITY: Self = Self::INFINITY;

    #[inline(always)]
    fn nearest(x: f64) -> Self {
        x
    }
}

impl<S: Simd> SimdRegister for f64x8<S> {
    type Real = f64;

    #[inline(always)]
    fn put_into(self, lanes: &mut [f64]) {
        self.store_slice(lanes);
    }
    #[inline(always)]
    fn least(self) -> f64 {
        self.reduce_min()
    }
    #[inline(always)]
    fn greatest(self) -> f64 {
        self.reduce_max()
    }
}

impl<S: Simd> SimdReal<S> for f64x8<S> {
    type Ids = u32x8<S>;

    #[inline(always)]
    fn all(simd: S, x: f64) -> Self {
        Self::splat(simd, x)
    }
    #[inline(always)]
    fn from_lanes(simd: S, lanes: &[f64]) -> Self {
        Self::from_slice(simd, lanes)
    }
    #[inline(always)]
    fn answers(simd: S, bits: u64) -> mask64x8<S> {
        mask64x8::from_bitmask(simd, bits)
    }
    #[inline(always)]
    fn ids(self) -> u32x8<S> {
        // Between 2⁵² and 2⁵³ the lowest digits of a number are those of an integer: no conversion that
        // saturates is as quick.
        let shifted: [f64; LANES] = (self + INTEGERS).into();
        let mut ids = [0; LANES];
        for lane in 0..LANES {
            ids[lane] = shifted[lane].to_bits() as u32;
        }
        u32x8::from_slice(self.simd, &ids)
    }
}

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
    const ROWS: usize = PACKET / Self::LANES;
    /// A bit for each ray of the first row.
    const ROW: u64 = (1 << Self::LANES) - 1;
    /// How many times as much is lost by a rounding as of an `f64`. Maps, starts and directions come rounded
    /// once from `f64`; the rest of each chain of roundings is the same.
    const COARSER: f64;
    /// [`Number::DECIDES`].
    const DECIDES: bool;
    /// 0.
    const ZERO: Self;
    /// The greatest number.
    const GREATEST: f64;
    /// What is beyond all numbers.
    const INFINITY: Self;

    /// The nearest.
    fn nearest(x: f64) -> Self;

    /// The same number for all rays of a row.
    #[inline(always)]
    fn all<S: Simd>(simd: S, x: f64) -> Self::SimdReal<S> {
        Self::SimdReal::<S>::all(simd, x)
    }

    /// The answers of a row, below [`Real::ROWS`], out of a bit for each ray of a packet.
    #[inline(always)]
    fn row_of<S: Simd>(simd: S, bits: u64, row: usize) -> RealMask<Self, S> {
        Self::SimdReal::<S>::answers(simd, bits >> (row * Self::LANES) & Self::ROW)
    }

    /// A bit for each ray of a packet, out of the answers of a row.
    #[inline(always)]
    fn bits_of<M: Mask<Self::SimdReal<S>>, S: Simd>(_: S, answers: M, row: usize) -> u64 {
        answers.bits() << (row * Self::LANES)
    }

    /// Whether any ray of a row is among these.
    #[inline(always)]
    fn has_any(bits: u64, row: usize) -> bool {
        bits >> (row * Self::LANES) & Self::ROW != 0
    }
}

/// Answers to a question about the rays of a row.
pub type RealMask<T, S> = <<T as Real>::SimdReal<S> as Number>::Mask;

/// The ids of the rays of a row.
pub type RealIds<T, S> = <<T as Real>::SimdReal<S> as SimdReal<S>>::Ids;

/// Numbers that fill a row.
pub trait SimdRegister {
    /// One of them.
    type Real;

    /// Puts them into a row, all of it.
    fn put_into(self, row: &mut [Self::Real]);
    /// The least; none may be not-a-number.
    fn least(self) -> f64;
    /// The greatest; none may be not-a-number.
    fn greatest(self) -> f64;
}

/// The ids of a row, in a register.
pub trait SimdIds<S: Simd>: Copy {
    /// The same for all.
    fn all(simd: S, id: u32) -> Self;
    /// Those of a row, all of it.
    fn of_row(simd: S, row: &[u32]) -> Self;
    /// Puts those whose bits are set into a row.
    fn put_into(self, simd: S, row: &mut [u32], bits: u64);
    /// A bit for each that is the same as in another register.
    fn equal_bits(self, other: Self) -> u64;
}

/// The numbers of a row, in a register.
pub trait SimdReal<S: Simd>: Number + SimdRegister {
    /// An id for each.
    type Ids: SimdIds<S>;

    /// The same for all.
    fn all(simd: S, x: f64) -> Self;
    /// Those of a row, all of it.
    fn of_row(simd: S, row: &[Self::Real]) -> Self;
    /// Answers out of a bit for each.
    fn answers(simd: S, bits: u64) -> Self::Mask;
    /// Numbers that are ids, whole and 0 or more, as ids: below 2²⁴ in single precision, below 2³² in double.
    fn ids(self) -> Self::Ids;
}

impl Real for f64 {
    type SimdReal<S: Simd> = f64x8<S>;

    const LANES: usize = LANES;
    const COARSER: f64 = 1.0;
    const DECIDES: bool = true;
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
    fn put_into(self, row: &mut [f64]) {
        self.store_slice(row);
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
    fn of_row(simd: S, row: &[f64]) -> Self {
        Self::from_slice(simd, row)
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

//! Ids of the rays of a packet, one for each lane: of objects, primitives and faces.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, mask32x8, mask32x16, u32x8, u32x16};

use super::packet::Lanes;
use super::real::{Real, RealIds, SimdIds};

macro_rules! ids {
    ($ids:ident $mask:ident) => {
        impl<S: Simd> SimdIds<S> for $ids<S> {
            #[inline(always)]
            fn all(simd: S, id: u32) -> Self {
                Self::splat(simd, id)
            }
            #[inline(always)]
            fn from_lanes(simd: S, lanes: &[u32]) -> Self {
                Self::from_slice(simd, lanes)
            }
            #[inline(always)]
            fn put_into(self, simd: S, lanes: &mut [u32], bits: u64) {
                let kept = Self::from_slice(simd, lanes);
                $mask::from_bitmask(simd, bits).select(self, kept).store_slice(lanes);
            }
            #[inline(always)]
            fn equal_bits(self, other: Self) -> u64 {
                self.simd_eq(other).to_bitmask()
            }
        }
    };
}
ids!(u32x8 mask32x8);
ids!(u32x16 mask32x16);

impl Lanes<u32> {
    /// Those of register `register`, below [`Real::REGISTERS`] of `T`.
    #[inline(always)]
    pub fn ids<T: Real, S: Simd>(&self, simd: S, register: usize) -> RealIds<T, S> {
        RealIds::<T, S>::from_lanes(simd, &self.0[register * T::LANES..][..T::LANES])
    }

    /// Sets those of a register of `T` that are among `rays`, a bit for each of the packet.
    #[inline(always)]
    pub fn put_ids<T: Real, S: Simd>(&mut self, simd: S, register: usize, rays: u64, ids: RealIds<T, S>) {
        let shift = register * T::LANES;
        ids.put_into(simd, &mut self.0[shift..][..T::LANES], rays >> shift & T::REGISTER_BITS);
    }

    /// Which of the packet's rays have an id, a bit for each.
    #[inline(always)]
    pub fn rays_of<S: Simd>(&self, simd: S, id: u32) -> u64 {
        let id = u32x16::splat(simd, id);
        let mut rays = 0;
        for register in 0..<f32 as Real>::REGISTERS {
            rays |= self.ids::<f32, S>(simd, register).equal_bits(id) << (register * <f32 as Real>::LANES);
        }
        rays
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use super::*;
    use crate::math::{PACKET, SimdReal, dispatch};

    #[test]
    fn ids_of_any_size_are_kept_where_they_are_put() {
        for level in [Level::new(), Level::baseline()] {
            let mut lanes = Lanes(std::array::from_fn::<u32, PACKET, _>(|lane| lane as u32 / 3));
            dispatch!(level, simd => {
                assert_eq!(lanes.rays_of(simd, 7), 0b111 << 21);
                lanes.put_ids::<f64, _>(simd, 7, 0b1010 << 56, RealIds::<f64, _>::all(simd, u32::MAX));
                lanes.put_ids::<f32, _>(simd, 0, 0b1001, <f32 as Real>::all(simd, 65_535.0).ids());
                lanes.put_ids::<f64, _>(simd, 1, 1 << 8, f64::all(simd, 16_777_217.0).ids());
            });
            let expected = std::array::from_fn(|lane| match lane {
                57 | 59 => u32::MAX,
                0 | 3 => 65_535,
                8 => 16_777_217,
                _ => lane as u32 / 3,
            });
            assert_eq!(lanes.0, expected);
        }
    }
}

//! The rays of a bundle in half the digits: which of them certainly miss a ball, sixteen at a time.
//!
//! Most rays of a bundle that are asked about a small ball miss it. They are told apart by numbers of 24 bits, with a
//! bound on what these lose, and only the others are computed in full.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16};

use crate::math::{BUNDLE, Bundle, DVec3};

/// Rays in a register.
const WIDTH: usize = 16;

/// What may be lost of the distance between a ray and a point, as a share of the way from the bundle's first ray to
/// that point and of how far the bundle's rays start from each other: the start and the point are rounded (2 units of
/// 2⁻²⁴), their difference (1), the dot product and its share of the direction (each three products, two sums and a
/// rounded direction: 2 · 6), the product and the sum that move the start (2), and the square (4) and its root (half of
/// that): 24, rounded up to 32.
const LOST: f64 = 32.0 / 16_777_216.0;

/// Rays of a bundle, seen from the start of its first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Thin {
    o: [[f32; BUNDLE]; 3],
    d: [[f32; BUNDLE]; 3],
    base: DVec3,
    /// How far the others start from there at most, added up over the axes.
    extent: f64,
}

impl Thin {
    /// No rays.
    pub const EMPTY: Self =
        Self { o: [[0.0; BUNDLE]; 3], d: [[0.0; BUNDLE]; 3], base: DVec3::ZERO, extent: 0.0 };

    /// The rays of a closed bundle.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, bundle: &Bundle) {
        self.extent = 0.0;
        for axis in 0..3 {
            let base = bundle.o[axis].0[0];
            self.base[axis] = base;
            for lane in 0..BUNDLE {
                self.o[axis][lane] = (bundle.o[axis].0[lane] - base) as f32;
                self.d[axis][lane] = bundle.d[axis].0[lane] as f32;
            }
            let mut most = f32x16::splat(simd, 0.0);
            for row in 0..BUNDLE / WIDTH {
                let o = f32x16::from_slice(simd, &self.o[axis][row * WIDTH..][..WIDTH]).abs();
                most = o.simd_gt(most).select(o, most);
            }
            let most = most.to_array().into_iter().fold(0.0, |most, x| if x > most { x } else { most });
            self.extent += f64::from(most);
        }
    }

    /// The rays whose lines may come within `radius` of a point; all others do not.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, center: DVec3, radius: f64) -> u64 {
        let from_base = center - self.base;
        let far = from_base.abs().element_sum() + self.extent;
        let reach = (radius + LOST * far) as f32;
        // The radius itself, and its square, are rounded.
        let limit = f32x16::splat(simd, reach * reach * (1.0 + 4.0 * f32::EPSILON));
        let cx = f32x16::splat(simd, from_base.x as f32);
        let cy = f32x16::splat(simd, from_base.y as f32);
        let cz = f32x16::splat(simd, from_base.z as f32);
        let mut rays = 0;
        for row in 0..BUNDLE / WIDTH {
            let at = row * WIDTH..(row + 1) * WIDTH;
            let x = f32x16::from_slice(simd, &self.o[0][at.clone()]) - cx;
            let y = f32x16::from_slice(simd, &self.o[1][at.clone()]) - cy;
            let z = f32x16::from_slice(simd, &self.o[2][at.clone()]) - cz;
            let dx = f32x16::from_slice(simd, &self.d[0][at.clone()]);
            let dy = f32x16::from_slice(simd, &self.d[1][at.clone()]);
            let dz = f32x16::from_slice(simd, &self.d[2][at]);
            let t = x * dx + y * dy + z * dz;
            let (x, y, z) = (x - t * dx, y - t * dy, z - t * dz);
            // What is not a number is not certain.
            let beside = (x * x + y * y + z * z).simd_gt(limit);
            rays |= (!beside).to_bitmask() << (row * WIDTH);
        }
        rays
    }
}

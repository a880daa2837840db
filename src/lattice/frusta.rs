//! The frustums of a tile's packets, sixteen side by side: which of them may meet one box.

use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16};

use super::frustum::{Frustum, lost};

/// Frustums in a frusta.
pub const FRUSTA: usize = 16;

/// One plane of each frustum.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
struct Planes {
    normal: [[f32; FRUSTA]; 3],
    offset: [f32; FRUSTA],
    /// The lengths of the normals, or more.
    length: [f32; FRUSTA],
}

/// Frustums side by side.
#[derive(Clone, Debug)]
pub struct FrustumSoa {
    planes: [Planes; 6],
    /// A point is no nearer to the start of any ray than what it lies behind the last plane, and this.
    start: [f32; FRUSTA],
    /// Which frustums are there, a bit for each.
    present: u16,
}

/// Which frustums of a frusta may meet a box, a bit for each, and how near it is at least to the start of any
/// ray of each.
#[derive(Clone, Copy, Debug)]
pub struct FrustaHits {
    /// The first is the lowest bit.
    pub frustums: u16,
    /// At least so far away, for each.
    pub near: [f32; FRUSTA],
}

impl Planes {
    #[inline(always)]
    fn normals<S: Simd>(&self, simd: S) -> [f32x16<S>; 3] {
        let [x, y, z] = &self.normal;
        [f32x16::from_slice(simd, x), f32x16::from_slice(simd, y), f32x16::from_slice(simd, z)]
    }
}

impl Default for FrustumSoa {
    /// No frustum at all.
    fn default() -> Self {
        let planes =
            Planes { normal: [[0.0; FRUSTA]; 3], offset: [f32::INFINITY; FRUSTA], length: [0.0; FRUSTA] };
        Self { planes: std::array::from_fn(|_| planes.clone()), start: [0.0; FRUSTA], present: 0 }
    }
}

impl FrustumSoa {
    /// Sets the frustums, up to [`FRUSTA`] of them; those that are absent, or left over, meet nothing.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, frustums: &[Option<Frustum>]) {
        self.present = 0;
        for (lane, frustum) in frustums.iter().enumerate().take(FRUSTA) {
            let Some(frustum) = frustum else { continue };
            self.present |= 1 << lane;
            let (planes, start) = frustum.planes();
            let backward = planes[5].0;
            for (k, (normal, offset)) in planes.into_iter().enumerate() {
                let to = &mut self.planes[k];
                for axis in 0..3 {
                    to.normal[axis][lane] = normal[axis] as f32;
                }
                to.offset[lane] = (offset - lost(normal)) as f32;
            }
            self.start[lane] = (start + lost(backward)) as f32;
        }
        // Three products, two sums, the root, and the normal itself: 5 roundings, and one of the last
        // product.
        let up = f32x16::splat(simd, 1.0 + 4.0 * f32::EPSILON);
        for planes in &mut self.planes {
            let [x, y, z] = planes.normals(simd);
            let length = (x * x + y * y + z * z).sqrt() * up;
            length.store_slice(&mut planes.length);
        }
    }

    /// Which of the frustums may meet a box.
    #[inline(always)]
    pub fn meets<S: Simd>(&self, simd: S, lo: [f32; 3], hi: [f32; 3]) -> FrustaHits {
        let (lx, hx) = (f32x16::splat(simd, lo[0]), f32x16::splat(simd, hi[0]));
        let (ly, hy) = (f32x16::splat(simd, lo[1]), f32x16::splat(simd, hi[1]));
        let (lz, hz) = (f32x16::splat(simd, lo[2]), f32x16::splat(simd, hi[2]));
        let mut met = u64::from(self.present);
        let mut last = lx;
        for planes in &self.planes {
            let [x, y, z] = planes.normals(simd);
            // Of two corners along an axis the one farther along the normal.
            let foremost = (x * lx).max(x * hx) + (y * ly).max(y * hy) + (z * lz).max(z * hz);
            let behind = foremost.simd_lt(f32x16::from_slice(simd, &planes.offset));
            met &= (!behind).to_bitmask();
            last = foremost;
        }
        let near = -last - f32x16::from_slice(simd, &self.start);
        FrustaHits { frustums: met as u16, near: near.to_array() }
    }

    /// Which of the frustums may meet a ball. A dot product with a normal takes fewer roundings here than for
    /// a box.
    #[inline(always)]
    pub fn meets_ball<S: Simd>(&self, simd: S, center: [f32; 3], radius: f32) -> FrustaHits {
        let [x, y, z] = center;
        let (x, y, z) = (f32x16::splat(simd, x), f32x16::splat(simd, y), f32x16::splat(simd, z));
        let radius = f32x16::splat(simd, radius);
        let mut met = u64::from(self.present);
        let mut last = x;
        for planes in &self.planes {
            let [nx, ny, nz] = planes.normals(simd);
            let foremost = nx * x + ny * y + nz * z + f32x16::from_slice(simd, &planes.length) * radius;
            let behind = foremost.simd_lt(f32x16::from_slice(simd, &planes.offset));
            met &= (!behind).to_bitmask();
            last = foremost;
        }
        let near = -last - f32x16::from_slice(simd, &self.start);
        FrustaHits { frustums: met as u16, near: near.to_array() }
    }
}

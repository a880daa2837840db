//! The rays of a bundle in half the digits: which of them certainly miss a ball, a box or a bar, sixteen at a time.
//!
//! Most rays of a bundle that are asked about a small solid miss it. They are told apart by numbers of 24 bits, with a
//! bound on what these lose, and only the others are computed in full.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16};

use crate::math::{BUNDLE, Bundle, DVec3};
use crate::solid::Bar;

/// Rays in a register.
const WIDTH: usize = 16;

/// Registers of rays in a bundle.
const THIN_ROWS: usize = BUNDLE / WIDTH;

/// Half an ulp of a number near 1.
const HALF_ULP: f64 = 1.0 / 16_777_216.0;

/// What may be lost of the distance between a ray and a point, as a share of the way from the bundle's first ray to
/// that point and of how far the bundle's rays start from each other: the start and the point are rounded (2 units of
/// 2⁻²⁴), their difference (1), the dot product and its share of the direction (each three products, two sums and a
/// rounded direction: 2 · 6), the product and the sum that move the start (2), and the square (4) and its root (half of
/// that): 24, rounded up to 32.
const LOST: f64 = 32.0 * HALF_ULP;

/// What may be lost of a ray's way to a side of a box, in the same share, where it is taken for the place of that side:
/// the start, the middle of the box and half its size are rounded (3), the difference of the first two (1), the direction,
/// its inverse and the products with it (2 · 3), and the sum of the products (1): 11, rounded up to 16.
const LOST_OF_SIDE: f64 = 16.0 * HALF_ULP;

/// What may be lost of the product of two lines, in the same share: of the ray's moment, whose start and direction are
/// rounded (2), the products and their difference (2); of the bar's direction (1), the product of both (1) and three sums
/// (3): 9, and of the other half, with a moment that is rounded, less. Rounded up to 16.
const LOST_OF_PRODUCT: f64 = 16.0 * HALF_ULP;

/// What may be lost of the square of the sine of the angle between two directions: both are rounded (2), each product of
/// the cosine and its sums are (3), its square doubles that and is rounded (11), and the difference (1): 12, rounded up
/// to 16.
const LOST_OF_SINE: f64 = 16.0 * HALF_ULP;

/// On its whole way through the world, which is no longer than 2⁴, a ray that is slower than this along an axis does
/// not move by what is lost of the place of any box: 2⁻²⁰ of a size that is more than rounding of f64 is.
const STILL: f32 = 1.0 / (1_u128 << 100) as f32;

/// Rays within the world start within this; what starts elsewhere, or nowhere, is asked in full.
const WITHIN: f32 = 64.0;

/// Rays of a bundle, seen from the start of its first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Thin {
    o: [[f32; BUNDLE]; 3],
    d: [[f32; BUNDLE]; 3],
    /// The inverse of the direction, and the moment `o × d`.
    inverse: [[f32; BUNDLE]; 3],
    moment: [[f32; BUNDLE]; 3],
    /// How far each looks.
    limit: [f32; BUNDLE],
    base: DVec3,
    /// How far the others start from there at most, added up over the axes.
    extent: f64,
    /// The rays that are to be asked in full, whatever they are asked about.
    odd: u64,
    known: bool,
}

impl Thin {
    /// No rays.
    pub const EMPTY: Self = Self {
        o: [[0.0; BUNDLE]; 3],
        d: [[0.0; BUNDLE]; 3],
        inverse: [[0.0; BUNDLE]; 3],
        moment: [[0.0; BUNDLE]; 3],
        limit: [0.0; BUNDLE],
        base: DVec3::ZERO,
        extent: 0.0,
        odd: 0,
        known: false,
    };

    /// Whether they have been set since they were forgotten.
    pub fn is_known(&self) -> bool {
        self.known
    }

    /// Forgets them.
    pub fn forget(&mut self) {
        self.known = false;
    }

    /// The rays of a closed bundle, which look as far as they can.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, bundle: &Bundle) {
        (self.extent, self.odd, self.known) = (0.0, 0, true);
        self.limit = [f32::INFINITY; BUNDLE];
        for axis in 0..3 {
            let base = bundle.o[axis].0[0];
            self.base[axis] = base;
            for lane in 0..BUNDLE {
                self.o[axis][lane] = (bundle.o[axis].0[lane] - base) as f32;
                self.d[axis][lane] = bundle.d[axis].0[lane] as f32;
            }
            let mut most = f32x16::splat(simd, 0.0);
            for row in 0..THIN_ROWS {
                let o = row_of(simd, &self.o[axis], row).abs();
                most = o.simd_gt(most).select(o, most);
            }
            self.extent += f64::from(most.reduce_max());
        }
        self.set_lines(simd);
    }

    /// The rays look no farther than this, and what is lost of it.
    #[inline(always)]
    pub fn look(&mut self, limit: impl Fn(usize) -> f64) {
        for lane in 0..BUNDLE {
            // Rounded twice, by half an ulp.
            self.limit[lane] = limit(lane) as f32 * (1.0 + 2.0 * f32::EPSILON);
        }
    }

    /// What only boxes and bars ask for.
    #[inline(always)]
    fn set_lines<S: Simd>(&mut self, simd: S) {
        if !self.base.abs().cmplt(DVec3::splat(f64::from(WITHIN))).all() {
            self.odd = u64::MAX;
        }
        let (one, still) = (f32x16::splat(simd, 1.0), f32x16::splat(simd, STILL));
        let within = f32x16::splat(simd, WITHIN);
        for row in 0..THIN_ROWS {
            let [o, d] = [
                [row_of(simd, &self.o[0], row), row_of(simd, &self.o[1], row), row_of(simd, &self.o[2], row)],
                [row_of(simd, &self.d[0], row), row_of(simd, &self.d[1], row), row_of(simd, &self.d[2], row)],
            ];
            for axis in 0..3 {
                let plain = o[axis].abs().simd_lt(within) & d[axis].abs().simd_lt(within);
                self.odd |= (!plain).to_bitmask() << (row * WIDTH);
                let inverse = d[axis].abs().simd_lt(still).select(one / still, one / d[axis]);
                inverse.store_slice(&mut self.inverse[axis][row * WIDTH..][..WIDTH]);
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                let moment = o[next] * d[last] - o[last] * d[next];
                moment.store_slice(&mut self.moment[axis][row * WIDTH..][..WIDTH]);
            }
        }
    }

    /// Those of some rays whose lines may come within `radius` of a point; all others do not.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, center: DVec3, radius: f64, wanted: u64) -> u64 {
        let from_base = center - self.base;
        let far = from_base.abs().element_sum() + self.extent;
        let reach = (radius + LOST * far) as f32;
        // The radius itself, and its square, are rounded.
        let limit = f32x16::splat(simd, reach * reach * (1.0 + 4.0 * f32::EPSILON));
        let cx = f32x16::splat(simd, from_base.x as f32);
        let cy = f32x16::splat(simd, from_base.y as f32);
        let cz = f32x16::splat(simd, from_base.z as f32);
        let mut rays = 0;
        for row in 0..THIN_ROWS {
            if (wanted >> (row * WIDTH)) as u16 == 0 {
                continue;
            }
            let x = row_of(simd, &self.o[0], row) - cx;
            let y = row_of(simd, &self.o[1], row) - cy;
            let z = row_of(simd, &self.o[2], row) - cz;
            let dx = row_of(simd, &self.d[0], row);
            let dy = row_of(simd, &self.d[1], row);
            let dz = row_of(simd, &self.d[2], row);
            let t = x * dx + y * dy + z * dz;
            let (x, y, z) = (x - t * dx, y - t * dy, z - t * dz);
            // What is not a number is not certain.
            let beside = (x * x + y * y + z * z).simd_gt(limit);
            rays |= (!beside).to_bitmask() << (row * WIDTH);
        }
        rays & wanted
    }

    /// Those of some rays that may pass a box, ahead of their starts and no farther than they look; all others do not
    /// come nearer to it than `slack`.
    #[inline(always)]
    pub fn passing<S: Simd>(&self, simd: S, sides: (DVec3, DVec3), slack: f64, wanted: u64) -> u64 {
        let slabs = self.slabs(simd, sides, slack);
        let mut rays = 0;
        for row in 0..THIN_ROWS {
            if (wanted >> (row * WIDTH)) as u16 != 0 {
                let (near, end) = self.through(simd, &slabs, row);
                rays |= (!near.simd_gt(end)).to_bitmask() << (row * WIDTH);
            }
        }
        (rays | self.odd) & wanted
    }

    /// Between which distances some rays pass a box, all of them, as far as they look.
    #[inline(always)]
    pub fn reach<S: Simd>(&self, simd: S, sides: (DVec3, DVec3), slack: f64, passing: u64) -> (f64, f64) {
        if self.odd & passing != 0 {
            return (0.0, f64::INFINITY);
        }
        let slabs = self.slabs(simd, sides, slack);
        let (mut from, mut to) = (f32x16::splat(simd, f32::INFINITY), f32x16::splat(simd, 0.0));
        for row in 0..THIN_ROWS {
            let (near, end) = self.through(simd, &slabs, row);
            let beside = near.simd_gt(end);
            (from, to) = (from.min(beside.select(from, near)), to.max(beside.select(to, end)));
        }
        (f64::from(from.reduce_min()), f64::from(to.reduce_max()))
    }

    /// A box as its middle and half its size, and what is lost of it.
    #[inline(always)]
    fn slabs<S: Simd>(&self, simd: S, (lo, hi): (DVec3, DVec3), slack: f64) -> [[f32x16<S>; 3]; 2] {
        let (middle, half) = (0.5 * lo + 0.5 * hi - self.base, 0.5 * hi - 0.5 * lo + slack);
        let far = (middle.abs() + half).element_sum() + self.extent;
        [splats(simd, middle), splats(simd, half + LOST_OF_SIDE * far)]
    }

    /// Where the rays of a row come into a box, and where they leave it or look no farther: those that miss it the other
    /// way round. Of rays that are odd that means nothing.
    #[inline(always)]
    fn through<S: Simd>(
        &self,
        simd: S,
        [middle, half]: &[[f32x16<S>; 3]; 2],
        row: usize,
    ) -> (f32x16<S>, f32x16<S>) {
        let (mut near, mut end) = (f32x16::splat(simd, 0.0), row_of(simd, &self.limit, row));
        for axis in 0..3 {
            let inverse = row_of(simd, &self.inverse[axis], row);
            let t = (middle[axis] - row_of(simd, &self.o[axis], row)) * inverse;
            let way = half[axis] * inverse.abs();
            (near, end) = (near.max(t - way), end.min(t + way));
        }
        (near, end)
    }

    /// Those of some rays whose lines may come within a bar's radius of its axis, be it as long as it will; all others do
    /// not.
    #[inline(always)]
    pub fn beside<S: Simd>(&self, simd: S, bar: &Bar, slack: f64, wanted: u64) -> u64 {
        let (from_base, along, radius) = (bar.middle - self.base, bar.along, bar.radius + slack);
        // The product of two lines, by their moments, is their distance times the sine of the angle between them.
        let moment = along.cross(from_base);
        let lost = LOST_OF_PRODUCT * (from_base.abs().element_sum() + self.extent);
        let square = radius * radius;
        let least = LOST_OF_SINE * square + (2.0 * radius + lost) * lost;
        let up = 1.0 + 8.0 * f32::EPSILON;
        let (square, least) =
            (f32x16::splat(simd, square as f32 * up), f32x16::splat(simd, least as f32 * up));
        let ([ax, ay, az], [mx, my, mz]) = (splats(simd, along), splats(simd, moment));
        let mut rays = 0;
        for row in 0..THIN_ROWS {
            if (wanted >> (row * WIDTH)) as u16 == 0 {
                continue;
            }
            let dx = row_of(simd, &self.d[0], row);
            let dy = row_of(simd, &self.d[1], row);
            let dz = row_of(simd, &self.d[2], row);
            let cosine = ax * dx + ay * dy + az * dz;
            let product = (row_of(simd, &self.moment[0], row) * ax - mx * dx)
                + (row_of(simd, &self.moment[1], row) * ay - my * dy)
                + (row_of(simd, &self.moment[2], row) * az - mz * dz);
            let sine = f32x16::splat(simd, 1.0) - cosine * cosine;
            let beside = (product * product).simd_gt(square * sine + least);
            rays |= (!beside).to_bitmask() << (row * WIDTH);
        }
        (rays | self.odd) & wanted
    }
}

/// A vector for sixteen.
#[inline(always)]
fn splats<S: Simd>(simd: S, v: DVec3) -> [f32x16<S>; 3] {
    [f32x16::splat(simd, v.x as f32), f32x16::splat(simd, v.y as f32), f32x16::splat(simd, v.z as f32)]
}

/// Sixteen of a number of each ray.
#[inline(always)]
fn row_of<S: Simd>(simd: S, numbers: &[f32; BUNDLE], row: usize) -> f32x16<S> {
    f32x16::from_slice(simd, &numbers[row * WIDTH..][..WIDTH])
}

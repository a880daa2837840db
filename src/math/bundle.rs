//! Rays that are traced together.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f64x8, mask64x8};

use super::number::LANES;
use super::vector::{Rays, Vector};
use super::{DVec3, Ray};

/// How many rays a bundle has at most: one bit of a word for each, and one register of numbers for each eighth.
pub const BUNDLE: usize = 64;

/// Registers of numbers in a bundle.
pub const ROWS: usize = BUNDLE / LANES;

/// One number of each ray of a bundle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Column(pub [f64; BUNDLE]);

/// Rays side by side.
#[derive(Clone, Debug)]
pub struct Bundle {
    /// Where they start, by axis.
    pub o: [Column; 3],
    /// Where they go, by axis.
    pub d: [Column; 3],
    /// Which are there, the first the lowest bit. The numbers of the others are those of one that is.
    pub live: u64,
}

impl Column {
    /// The same for all.
    pub const fn filled(x: f64) -> Self {
        Self([x; BUNDLE])
    }

    /// Eight of them: those of row `row`, below [`ROWS`].
    #[inline(always)]
    pub fn row(&self, row: usize) -> [f64; LANES] {
        std::array::from_fn(|lane| self.0[row * LANES + lane])
    }

    /// The same in a register.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, row: usize) -> f64x8<S> {
        f64x8::from_slice(simd, &self.0[row * LANES..][..LANES])
    }

    /// Sets some of eight.
    #[inline(always)]
    pub fn put<S: Simd>(&mut self, simd: S, row: usize, which: mask64x8<S>, x: f64x8<S>) {
        self.store(row, which.select(x, self.load(simd, row)));
    }

    /// The largest; none of them may be not-a-number.
    #[inline(always)]
    pub fn largest<S: Simd>(&self, simd: S) -> f64 {
        let mut most = self.load(simd, 0);
        for row in 1..ROWS {
            most = most.max(self.load(simd, row));
        }
        most.reduce_max()
    }

    /// Gives those whose bit is not among `kept` the number of another, `from`.
    #[inline(always)]
    pub fn fill_rest<S: Simd>(&mut self, simd: S, kept: u64, from: usize) {
        let x = f64x8::splat(simd, self.0[from]);
        for row in 0..ROWS {
            if (kept >> (row * LANES)) as u8 != u8::MAX {
                self.put(simd, row, row_of(simd, !kept, row), x);
            }
        }
    }

    /// Sets eight of them.
    #[inline(always)]
    pub fn store<S: Simd>(&mut self, row: usize, x: f64x8<S>) {
        x.store_slice(&mut self.0[row * LANES..][..LANES]);
    }
}

/// A ray among bundles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The number of its bundle.
    pub bundle: usize,
    /// Its place there, below [`BUNDLE`].
    pub lane: usize,
}

/// The rays of a bundle whose bits are set, the lowest first.
#[inline(always)]
pub fn lanes(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        let some = bits != 0;
        bits &= bits.wrapping_sub(1);
        some.then_some(lane)
    })
}

/// The places of the rays of a bundle whose bits are set.
#[inline(always)]
pub fn places(bundle: usize, bits: u64) -> impl Iterator<Item = Place> {
    lanes(bits).map(move |lane| Place { bundle, lane })
}

/// The answers of a row, below [`ROWS`], out of a bit for each ray of a bundle.
#[inline(always)]
pub fn row_of<S: Simd>(simd: S, bits: u64, row: usize) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, bits >> (row * LANES) & 0xFF)
}

/// A vector of each ray of a bundle.
pub trait Columns {
    /// Eight of them: those of row `row`, below [`ROWS`].
    fn load<S: Simd>(&self, simd: S, row: usize) -> Vector<f64x8<S>>;
    /// Sets eight of them.
    fn store<S: Simd>(&mut self, row: usize, v: Vector<f64x8<S>>);
    /// One of them.
    fn get(&self, lane: usize) -> DVec3;
    /// Sets one of them.
    fn set(&mut self, lane: usize, v: DVec3);
}

impl Columns for [Column; 3] {
    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, row: usize) -> Vector<f64x8<S>> {
        let [x, y, z] = self;
        Vector { x: x.load(simd, row), y: y.load(simd, row), z: z.load(simd, row) }
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, row: usize, v: Vector<f64x8<S>>) {
        self[0].store(row, v.x);
        self[1].store(row, v.y);
        self[2].store(row, v.z);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> DVec3 {
        DVec3::new(self[0].0[lane], self[1].0[lane], self[2].0[lane])
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, v: DVec3) {
        for axis in 0..3 {
            self[axis].0[lane] = v[axis];
        }
    }
}

impl Bundle {
    /// No rays.
    pub const EMPTY: Self = Self { o: [Column::filled(0.0); 3], d: [Column::filled(0.0); 3], live: 0 };

    /// Eight rays: those of row `row`, below [`ROWS`].
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, row: usize) -> Rays<f64x8<S>> {
        Rays { o: self.o.load(simd, row), d: self.d.load(simd, row) }
    }

    /// One of the rays.
    pub fn ray(&self, lane: usize) -> Ray {
        Ray::new(self.o.get(lane), self.d.get(lane))
    }

    /// Puts a ray in its place.
    #[inline]
    pub fn set(&mut self, lane: usize, ray: &Ray) {
        self.o.set(lane, ray.o);
        self.d.set(lane, ray.d);
        self.live |= 1 << lane;
    }

    /// Gives those that are not there the numbers of the first that is: bounds around all are bounds around the live.
    #[inline(always)]
    pub fn close<S: Simd>(&mut self, simd: S) {
        if self.live == 0 || self.live == u64::MAX {
            return;
        }
        let first = self.live.trailing_zeros() as usize;
        for axis in 0..3 {
            self.o[axis].fill_rest(simd, self.live, first);
            self.d[axis].fill_rest(simd, self.live, first);
        }
    }

    /// The bits of the live rays in a row.
    #[inline(always)]
    pub fn live_in(&self, row: usize) -> u8 {
        (self.live >> (row * LANES)) as u8
    }
}

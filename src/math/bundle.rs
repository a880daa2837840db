//! Rays that are traced together.

use fearless_simd::{Simd, SimdBase, SimdMask, mask64x8};

use super::digits::{Answers, Digits, Row, Wide};
use super::number::{LANES, Mask};
use super::vector::{Rays, Vector};
use super::{DVec3, Ray};

/// How many rays a bundle has at most: one bit of a word for each, and one register of numbers for each eighth.
pub const BUNDLE: usize = 64;

/// Registers of numbers in a bundle.
pub const ROWS: usize = BUNDLE / LANES;

/// The most numbers of a row.
const MOST_LANES: usize = 2 * LANES;

/// One number of each ray of a bundle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Column<T = f64>(pub [T; BUNDLE]);

/// Rays side by side.
#[derive(Clone, Debug)]
pub struct Bundle<T = f64> {
    /// Where they start, by axis.
    pub o: [Column<T>; 3],
    /// Where they go, by axis.
    pub d: [Column<T>; 3],
    /// Which are there, the first the lowest bit. The numbers of the others are those of one that is.
    pub live: u64,
}

impl<T: Copy> Column<T> {
    /// The same for all.
    #[inline]
    pub const fn filled(x: T) -> Self {
        Self([x; BUNDLE])
    }
}

impl<T: Digits> Column<T> {
    /// Those of row `row`, below [`Digits::ROWS`], in a register.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, row: usize) -> T::Wide<S> {
        T::Wide::<S>::of_row(simd, &self.0[row * T::LANES..][..T::LANES])
    }

    /// The numbers of a row of `U`, below `U::ROWS`, each rounded to the nearest `U`.
    #[inline(always)]
    pub fn load_nearest<U: Digits, S: Simd>(&self, simd: S, row: usize) -> U::Wide<S> {
        let mut numbers = [U::ZERO; MOST_LANES];
        let own = &self.0[row * U::LANES..][..U::LANES];
        for (to, from) in numbers.iter_mut().zip(own) {
            *to = U::nearest((*from).into());
        }
        U::Wide::<S>::of_row(simd, &numbers[..U::LANES])
    }

    /// Sets a row of them.
    #[inline(always)]
    pub fn store(&mut self, row: usize, x: impl Row<Digits = T>) {
        x.put_into(&mut self.0[row * T::LANES..][..T::LANES]);
    }

    /// Sets some of a row.
    #[inline(always)]
    pub fn put<S: Simd>(&mut self, simd: S, row: usize, which: Answers<T, S>, x: T::Wide<S>) {
        self.store(row, which.choose(x, self.load(simd, row)));
    }

    /// Gives those whose bit is not among `kept` the number of another, `from`.
    #[inline(always)]
    pub fn fill_rest<S: Simd>(&mut self, simd: S, kept: u64, from: usize) {
        let x = T::Wide::<S>::all(simd, self.0[from].into());
        for row in 0..T::ROWS {
            if T::has_any(!kept, row) {
                self.put(simd, row, T::row_of(simd, !kept, row), x);
            }
        }
    }

    /// Sets each to the nearest of another's.
    #[inline(always)]
    pub fn set_nearest<U: Digits>(&mut self, other: &Column<U>) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            *to = T::nearest((*from).into());
        }
    }
}

impl Column {
    /// Eight of them: those of row `row`, below [`ROWS`].
    #[inline(always)]
    pub fn row(&self, row: usize) -> [f64; LANES] {
        let mut numbers = [0.0; LANES];
        numbers.copy_from_slice(&self.0[row * LANES..][..LANES]);
        numbers
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
pub trait Columns<T: Digits> {
    /// Those of row `row`, below [`Digits::ROWS`].
    fn load<S: Simd>(&self, simd: S, row: usize) -> Vector<T::Wide<S>>;
    /// Sets a row of them.
    fn store(&mut self, row: usize, v: Vector<impl Row<Digits = T>>);
    /// One of them.
    fn get(&self, lane: usize) -> DVec3;
    /// Sets one of them.
    fn set(&mut self, lane: usize, v: DVec3);
}

impl<T: Digits> Columns<T> for [Column<T>; 3] {
    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, row: usize) -> Vector<T::Wide<S>> {
        let [x, y, z] = self;
        Vector { x: x.load(simd, row), y: y.load(simd, row), z: z.load(simd, row) }
    }

    #[inline(always)]
    fn store(&mut self, row: usize, v: Vector<impl Row<Digits = T>>) {
        self[0].store(row, v.x);
        self[1].store(row, v.y);
        self[2].store(row, v.z);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> DVec3 {
        let [x, y, z] = self;
        DVec3::new(x.0[lane].into(), y.0[lane].into(), z.0[lane].into())
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, v: DVec3) {
        for axis in 0..3 {
            self[axis].0[lane] = T::nearest(v[axis]);
        }
    }
}

impl<T: Digits> Bundle<T> {
    /// No rays.
    pub const EMPTY: Self =
        Self { o: [Column::filled(T::ZERO); 3], d: [Column::filled(T::ZERO); 3], live: 0 };

    /// The rays of row `row`, below [`Digits::ROWS`].
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, row: usize) -> Rays<T::Wide<S>> {
        Rays { o: self.o.load(simd, row), d: self.d.load(simd, row) }
    }

    /// One of the rays.
    #[inline]
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

    /// Sets each ray to the nearest of another bundle's.
    #[inline(always)]
    pub fn set_nearest<U: Digits>(&mut self, other: &Bundle<U>) {
        for axis in 0..3 {
            self.o[axis].set_nearest(&other.o[axis]);
            self.d[axis].set_nearest(&other.d[axis]);
        }
        self.live = other.live;
    }

    /// Whether any of the live rays is in a row.
    #[inline(always)]
    pub fn has_live(&self, row: usize) -> bool {
        T::has_any(self.live, row)
    }
}

//! Rays that are traced together.

use fearless_simd::{Simd, SimdBase, SimdMask, mask64x8};

use super::number::{LANES, Mask, PACKET};
use super::real::{Real, RealMask, SimdReal, SimdRegister};
use super::vector::{Rays, Vector};
use super::{DVec3, Ray};

/// Registers of numbers in a packet.
pub const REGISTERS: usize = PACKET / LANES;

/// The most numbers that a register holds.
const MOST_LANES: usize = 2 * LANES;

/// One number of each ray of a packet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes<T = f64>(pub [T; PACKET]);

/// Rays side by side.
#[derive(Clone, Debug)]
pub struct RayPacket<T = f64> {
    /// Where they start, by axis.
    pub o: [Lanes<T>; 3],
    /// Where they go, by axis.
    pub d: [Lanes<T>; 3],
    /// Which are there, the first the lowest bit. The numbers of the others are those of one that is.
    pub live: u64,
}

impl<T: Copy> Lanes<T> {
    /// The same for all.
    #[inline]
    pub const fn filled(x: T) -> Self {
        Self([x; PACKET])
    }
}

impl<T: Real> Lanes<T> {
    /// The numbers of register `register`, below [`Real::REGISTERS`].
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, register: usize) -> T::SimdReal<S> {
        T::SimdReal::<S>::from_lanes(simd, &self.0[register * T::LANES..][..T::LANES])
    }

    /// The numbers of a register of `U`, below `U::REGISTERS`, each rounded to the nearest `U`.
    #[inline(always)]
    pub fn load_nearest<U: Real, S: Simd>(&self, simd: S, register: usize) -> U::SimdReal<S> {
        let mut numbers = [U::ZERO; MOST_LANES];
        let own = &self.0[register * U::LANES..][..U::LANES];
        for (to, from) in numbers.iter_mut().zip(own) {
            *to = U::nearest((*from).into());
        }
        U::SimdReal::<S>::from_lanes(simd, &numbers[..U::LANES])
    }

    /// Sets those of a register.
    #[inline(always)]
    pub fn store(&mut self, register: usize, x: impl SimdRegister<Real = T>) {
        x.put_into(&mut self.0[register * T::LANES..][..T::LANES]);
    }

    /// Sets those of a register that are among `which`.
    #[inline(always)]
    pub fn put<S: Simd>(&mut self, simd: S, register: usize, which: RealMask<T, S>, x: T::SimdReal<S>) {
        self.store(register, which.choose(x, self.load(simd, register)));
    }

    /// Gives those whose bit is not among `kept` the number of another, `from`.
    #[inline(always)]
    pub fn fill_rest<S: Simd>(&mut self, simd: S, kept: u64, from: usize) {
        let x = T::SimdReal::<S>::all(simd, self.0[from].into());
        for register in 0..T::REGISTERS {
            if T::has_any(!kept, register) {
                self.put(simd, register, T::mask_of(simd, !kept, register), x);
            }
        }
    }

    /// Sets each to the nearest of another's.
    #[inline(always)]
    pub fn set_nearest<U: Real>(&mut self, other: &Lanes<U>) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            *to = T::nearest((*from).into());
        }
    }
}

impl Lanes {
    /// The eight numbers of register `register`, below [`REGISTERS`].
    #[inline(always)]
    pub fn register(&self, register: usize) -> [f64; LANES] {
        let mut numbers = [0.0; LANES];
        numbers.copy_from_slice(&self.0[register * LANES..][..LANES]);
        numbers
    }

    /// The largest; none of them may be not-a-number.
    #[inline(always)]
    pub fn largest<S: Simd>(&self, simd: S) -> f64 {
        let mut most = self.load(simd, 0);
        for register in 1..REGISTERS {
            most = most.max(self.load(simd, register));
        }
        most.reduce_max()
    }
}

/// A ray among packets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayIndex {
    /// The number of its packet.
    pub packet: usize,
    /// Its place there, below [`PACKET`].
    pub lane: usize,
}

/// The rays of a packet whose bits are set, the lowest first.
#[inline(always)]
pub fn lanes(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        let some = bits != 0;
        bits &= bits.wrapping_sub(1);
        some.then_some(lane)
    })
}

/// The places of the rays of a packet whose bits are set.
#[inline(always)]
pub fn places(packet: usize, bits: u64) -> impl Iterator<Item = RayIndex> {
    lanes(bits).map(move |lane| RayIndex { packet, lane })
}

/// The answers of a register, below [`REGISTERS`], out of a bit for each ray of a packet.
#[inline(always)]
pub fn mask_of<S: Simd>(simd: S, bits: u64, register: usize) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, bits >> (register * LANES) & 0xFF)
}

/// A vector of each ray of a packet.
pub trait LaneVector<T: Real> {
    /// Those of register `register`, below [`Real::REGISTERS`].
    fn load<S: Simd>(&self, simd: S, register: usize) -> Vector<T::SimdReal<S>>;
    /// Sets those of a register.
    fn store(&mut self, register: usize, v: Vector<impl SimdRegister<Real = T>>);
    /// One of them.
    fn get(&self, lane: usize) -> DVec3;
    /// Sets one of them.
    fn set(&mut self, lane: usize, v: DVec3);
}

impl<T: Real> LaneVector<T> for [Lanes<T>; 3] {
    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, register: usize) -> Vector<T::SimdReal<S>> {
        let [x, y, z] = self;
        Vector { x: x.load(simd, register), y: y.load(simd, register), z: z.load(simd, register) }
    }

    #[inline(always)]
    fn store(&mut self, register: usize, v: Vector<impl SimdRegister<Real = T>>) {
        self[0].store(register, v.x);
        self[1].store(register, v.y);
        self[2].store(register, v.z);
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

impl<T: Real> RayPacket<T> {
    /// No rays.
    pub const EMPTY: Self = Self { o: [Lanes::filled(T::ZERO); 3], d: [Lanes::filled(T::ZERO); 3], live: 0 };

    /// The rays of register `register`, below [`Real::REGISTERS`].
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, register: usize) -> Rays<T::SimdReal<S>> {
        Rays { o: self.o.load(simd, register), d: self.d.load(simd, register) }
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

    /// Gives those that are not there the numbers of the first that is: bounds around all are bounds around
    /// the live.
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

    /// Sets each ray to the nearest of another packet's.
    #[inline(always)]
    pub fn set_nearest<U: Real>(&mut self, other: &RayPacket<U>) {
        for axis in 0..3 {
            self.o[axis].set_nearest(&other.o[axis]);
            self.d[axis].set_nearest(&other.d[axis]);
        }
        self.live = other.live;
    }

    /// Whether any of the live rays is in a register.
    #[inline(always)]
    pub fn has_live(&self, register: usize) -> bool {
        T::has_any(self.live, register)
    }
}

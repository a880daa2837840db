//! The nearest hits of a packet, as far as they are known.

use fearless_simd::Simd;

use crate::math::{Lanes, Mask, Number, RayPacket, Real, RealIds, RealMask, SimdIds, SimdReal, SimdRegister};
use crate::solid::Crossing;

use super::super::hit::Hit;

/// How many of their errors may lie between two hits that are one place: as [`slack`](crate::lattice::slack)
/// is so many times what solids may be off.
const COINCIDENT_WITHIN: f64 = 4.0;

/// What each ray of a packet met first.
#[derive(Clone, Debug)]
pub struct PacketHits<T = f64> {
    /// The distance; infinite where nothing was met.
    pub t: Lanes<T>,
    /// How far that may be off.
    pub error: Lanes<T>,
    /// The distance of the next object's surface; in single precision a lower bound of it.
    pub second: Lanes<T>,
    /// The object, by its index in the assembly.
    pub object: Lanes<u32>,
    /// The primitive, by its index in the assembly.
    pub primitive: Lanes<u32>,
    /// The face of the primitive.
    pub surface: Lanes<u32>,
    /// Which rays go into the object there, a bit for each.
    pub entering: u64,
    /// Which rays are left to the exact engine, a bit for each.
    pub uncertain: u64,
    /// Which rays are incoherent, and left to a stream.
    pub incoherent: u64,
}

impl<T: Real> Default for PacketHits<T> {
    #[inline]
    fn default() -> Self {
        Self::NOTHING
    }
}

impl<T: Real> PacketHits<T> {
    /// Nothing was met yet.
    pub const NOTHING: Self = Self {
        t: Lanes::filled(T::INFINITY),
        error: Lanes::filled(T::ZERO),
        second: Lanes::filled(T::INFINITY),
        object: Lanes::filled(0),
        primitive: Lanes::filled(0),
        surface: Lanes::filled(0),
        entering: 0,
        uncertain: 0,
        incoherent: 0,
    };

    /// Marks every ray as meeting nothing.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.t = Lanes::filled(T::INFINITY);
        self.second = Lanes::filled(T::INFINITY);
        self.clear_ray_bits();
    }

    /// Clears `entering`, `uncertain` and `incoherent`; keeps the columns of hits.
    #[inline]
    pub(super) fn clear_ray_bits(&mut self) {
        (self.entering, self.uncertain, self.incoherent) = (0, 0, 0);
    }
}

impl PacketHits {
    /// Marks one ray as meeting nothing.
    #[inline]
    pub(super) fn forget(&mut self, lane: usize) {
        (self.t.0[lane], self.second.0[lane]) = (f64::INFINITY, f64::INFINITY);
        self.uncertain &= !(1 << lane);
    }

    /// Takes a crossing of one ray with an object, if nothing nearer was met.
    #[inline]
    pub(super) fn offer_one(&mut self, lane: usize, object: u32, crossing: &Crossing) {
        let best = self.t.0[lane];
        self.second.0[lane] = self.second.0[lane].min(best.max(crossing.t));
        if crossing.t < best {
            self.t.0[lane] = crossing.t;
            self.error.0[lane] = crossing.error;
            self.object.0[lane] = object;
            self.primitive.0[lane] = crossing.primitive;
            self.surface.0[lane] = crossing.surface;
            self.entering = self.entering & !(1 << lane) | u64::from(crossing.entering) << lane;
        }
    }

    /// Sets what one ray met.
    pub fn set(&mut self, lane: usize, hit: Option<&Hit>) {
        let Some(hit) = hit else {
            self.t.0[lane] = f64::INFINITY;
            return;
        };
        self.t.0[lane] = hit.t;
        self.error.0[lane] = hit.error;
        self.object.0[lane] = hit.object;
        self.primitive.0[lane] = hit.primitive;
        self.surface.0[lane] = hit.surface;
        self.entering = self.entering & !(1 << lane) | u64::from(hit.entering) << lane;
    }

    /// Copies what all met, rounded to the nearest number of this precision.
    #[inline(always)]
    pub(super) fn set_nearest<T: Real>(&mut self, other: &PacketHits<T>) {
        self.t.set_nearest(&other.t);
        self.error.set_nearest(&other.error);
        self.object = other.object;
        self.primitive = other.primitive;
        self.surface = other.surface;
        (self.entering, self.uncertain, self.incoherent) =
            (other.entering, other.uncertain, other.incoherent);
    }
}

impl<T: Real> PacketHits<T> {
    /// Takes crossings of some rays of a register with an object, where nothing nearer was met.
    #[inline(always)]
    pub fn offer<S: Simd>(&mut self, simd: S, register: usize, met: &HitCandidate<T, S>) {
        let (best, second) = (self.t.load(simd, register), self.second.load(simd, register));
        let t = met.any.choose(met.t, T::all(simd, f64::INFINITY));
        let nearer = t.is_below(best);
        let other = if T::IS_DOUBLE {
            t.larger(best)
        } else {
            nearer.choose(
                best - self.error.load(simd, register) * COINCIDENT_WITHIN,
                t - met.error * COINCIDENT_WITHIN,
            )
        };
        self.second.store(register, other.smaller(second));
        if !nearer.any() {
            return;
        }
        self.t.put(simd, register, nearer, t);
        self.error.put(simd, register, nearer, met.error);
        let bits = T::bits_of(simd, nearer, register);
        self.object.put_ids::<T, S>(simd, register, bits, RealIds::<T, S>::all(simd, met.object));
        self.primitive.put_ids::<T, S>(simd, register, bits, met.primitive);
        self.surface.put_ids::<T, S>(simd, register, bits, met.surface.ids());
        self.entering = self.entering & !bits | T::bits_of(simd, met.entering, register) & bits;
    }

    /// Up to where something may be in one place with what the rays of a register met first. In double
    /// precision that is said by how far solids may be off; in single also by the slope at which it was met,
    /// as what is flush with it is.
    #[inline(always)]
    fn reach<S: Simd>(&self, simd: S, register: usize) -> T::SimdReal<S> {
        let t = self.t.load(simd, register);
        if T::IS_DOUBLE { t } else { t + self.error.load(simd, register) * COINCIDENT_WITHIN }
    }

    /// The same for one ray.
    #[inline(always)]
    pub(super) fn reach_of(&self, lane: usize) -> f64 {
        let t = self.t.0[lane].into();
        if T::IS_DOUBLE { t } else { t + COINCIDENT_WITHIN * self.error.0[lane].into() }
    }

    /// Leaves the rays that met two objects within `slack` to the exact engine.
    #[inline(always)]
    pub fn mark_ties<S: Simd>(&mut self, simd: S, slack: f64) {
        for register in 0..T::REGISTERS {
            let t = self.t.load(simd, register);
            let close = self.second.load(simd, register).is_at_most(self.reach(simd, register) + slack)
                & t.is_below(T::all(simd, f64::INFINITY));
            self.uncertain |= T::bits_of(simd, close, register);
        }
    }

    /// The greatest distance at which any of the rays may still meet something.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S, packet: &RayPacket<T>) -> f64 {
        // What lanes met that are not live means nothing: the surfaces that they leave are not set.
        let nowhere = T::all(simd, f64::NEG_INFINITY);
        let mut most = nowhere;
        for register in 0..T::REGISTERS {
            if packet.has_live(register) {
                let t = T::mask_of(simd, packet.live, register).choose(self.reach(simd, register), nowhere);
                most = t.larger(most);
            }
        }
        most.greatest()
    }
}

/// Crossings of a register with one object.
#[derive(Clone, Copy)]
pub struct HitCandidate<T: Real, S: Simd> {
    /// Which rays have one.
    pub any: RealMask<T, S>,
    /// Where.
    pub t: T::SimdReal<S>,
    /// How far that may be off.
    pub error: T::SimdReal<S>,
    /// Whether the ray goes into the object there.
    pub entering: RealMask<T, S>,
    /// The object.
    pub object: u32,
    /// The primitive.
    pub primitive: RealIds<T, S>,
    /// The face.
    pub surface: Faces<T, S>,
}

/// The faces of a primitive that the rays of a register cross.
#[derive(Clone, Copy)]
pub enum Faces<T: Real, S: Simd> {
    /// By their ids.
    Ids(RealIds<T, S>),
    /// As the kernels compute them, by numbers that are ids: only those of hits are worth converting.
    Numbers(T::SimdReal<S>),
}

impl<T: Real, S: Simd> Faces<T, S> {
    /// Their ids.
    #[inline(always)]
    fn ids(self) -> RealIds<T, S> {
        match self {
            Self::Ids(ids) => ids,
            Self::Numbers(numbers) => numbers.ids(),
        }
    }
}

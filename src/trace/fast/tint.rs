//! Glass between the lit points of a tile and one light.
//!
//! A glass object takes its share of the light once, however often a ray crosses its surface, and whatever else is on the
//! way: so what a ray meets of it first is all there is to know. Where there are two on one way, the ray is asked alone.

use fearless_simd::Simd;

use crate::lattice::FAN;
use crate::math::{Column, lanes};
use crate::solid::Departures;

use super::Fast;
use super::memory::TileMemory;
use super::outset::Outset;
use super::shaft::{Shaft, Shone};

/// What glass leaves of the light of a shaft's rays.
#[derive(Clone, Debug)]
pub struct Tint {
    /// Which of the rays meet glass.
    pub rays: u64,
    /// What is left of their light.
    pub share: Column,
}

/// How an object treats light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clarity {
    /// It lets none through.
    Opaque,
    /// All of it lets some through.
    Clear,
    /// Parts of it do.
    Mixed,
}

impl Tint {
    /// None.
    pub const NONE: Self = Self { rays: 0, share: Column::filled(1.0) };

    /// Forgets all.
    pub fn clear(&mut self) {
        self.rays = 0;
    }

    /// Forgets what some rays met.
    pub(super) fn forget(&mut self, rays: u64) {
        self.rays &= !rays;
    }

    /// A ray meets glass that leaves so much of its light. Answers whether that is certain.
    fn add(&mut self, lane: usize, left: f64) -> bool {
        let bit = 1 << lane;
        if self.rays & bit == 0 {
            self.rays |= bit;
            self.share.0[lane] = left;
            return true;
        }
        // Where one of two has a surface at which the other's is crossed again, the order tells what light is left.
        false
    }
}

impl Shaft {
    /// A ray first meets a glass object at a distance that may be off by `error`, and this is left of its light there.
    pub(super) fn glass(
        &mut self,
        lane: usize,
        (t, error): (f64, f64),
        clarity: Clarity,
        left: f64,
        slack: f64,
    ) {
        let distance = self.distance.0[lane];
        // Seen from the glass before it, both may be off by as much again.
        let off = 2.0 * error + slack;
        if t - off > distance {
            return;
        }
        let certain = clarity == Clarity::Clear && t + off < distance;
        if !(certain && self.tint.add(lane, left)) {
            self.unsure |= 1 << lane;
        }
    }
}

impl Fast<'_> {
    /// Glass in the way of a light; `about` is the object, and which rays may pass its box.
    pub(super) fn glass_in_shaft<S: Simd>(
        &self,
        simd: S,
        about: (u32, u64),
        shaft: &mut Shaft,
        (departures, lamp): (&Departures, &Shone),
        memory: &mut TileMemory,
        k: usize,
    ) {
        let mut met = std::mem::take(&mut memory.met);
        met.clear();
        memory.far.resize(FAN, 0.0);
        memory.far[k] = shaft.distance.largest(simd);
        let outset = Outset { rays: &shaft.rays, departures: Some(departures) };
        self.object_of_bundle(simd, about, outset, &mut met, memory, k);
        shaft.unsure |= met.unsure & shaft.rays.live;
        let clarity = lamp.clarity.get(about.0 as usize).copied().unwrap_or(Clarity::Opaque);
        for lane in lanes(shaft.open()) {
            let at = (met.t.0[lane], met.error.0[lane]);
            if at.0 < f64::INFINITY {
                let left = lamp.lets_through[met.primitive.0[lane] as usize];
                shaft.glass(lane, at, clarity, left, self.slack);
            }
        }
        memory.met = met;
    }
}

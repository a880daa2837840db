//! Glass between the lit points of a tile and one light.
//!
//! A glass object takes its share of the light once, however often a ray crosses its surface, and whatever else is on the
//! way: so what a ray meets of it first is all there is to know. Where there are two on one way that are not apart, or more,
//! the ray is asked alone.

use fearless_simd::Simd;

use crate::lattice::FAN;
use crate::math::{BUNDLE, Bounds, Column, DVec3, lanes};
use crate::solid::{Departures, WORLD};

use super::Fast;
use super::memory::TileMemory;
use super::outset::Outset;
use super::shaft::{Shaft, Shone};
use super::thin::Slabs;

/// What glass leaves of the light of a shaft's rays.
#[derive(Clone, Debug)]
pub struct Tint {
    /// Which of the rays meet glass.
    pub rays: u64,
    /// What is left of their light.
    pub share: Column,
    /// The objects that they meet, by their numbers.
    met: [[u32; BUNDLE]; MOST],
}

/// The most glass objects of which what is left of a ray's light is known here: two numbers have one product, whichever
/// comes first, and three have not.
const MOST: usize = 2;

/// No object: there are fewer.
const NONE: u32 = u32::MAX;

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
    pub const NONE: Self = Self { rays: 0, share: Column::filled(1.0), met: [[NONE; BUNDLE]; MOST] };

    /// Forgets all.
    pub fn clear(&mut self) {
        self.rays = 0;
    }

    /// Forgets what some rays met.
    pub(super) fn forget(&mut self, rays: u64) {
        self.rays &= !rays;
    }

    /// A ray meets a glass object that leaves so much of its light. Answers whether that is certain.
    fn add(&mut self, lane: usize, object: u32, left: f64, apart: impl Fn(u32) -> bool) -> bool {
        let bit = 1 << lane;
        if self.rays & bit == 0 {
            self.rays |= bit;
            self.share.0[lane] = left;
            (self.met[0][lane], self.met[1][lane]) = (object, NONE);
            return true;
        }
        // Where one of two has a surface at which the other's is crossed again, the order tells what light is left.
        if self.met[1][lane] != NONE || !apart(self.met[0][lane]) {
            return false;
        }
        self.met[1][lane] = object;
        self.share.0[lane] *= left;
        true
    }
}

impl Shaft {
    /// A ray first meets a glass object at a distance that may be off by `error`, and this is left of its light there.
    pub(super) fn glass(&mut self, lane: usize, met: &Pane, slack: f64, apart: impl Fn(u32) -> bool) {
        let distance = self.distance.0[lane];
        // Seen from the glass before it, both may be off by as much again.
        let off = 2.0 * met.error + slack;
        if met.t - off > distance {
            return;
        }
        let certain = met.clear && met.t + off < distance;
        if !(certain && self.tint.add(lane, met.object, met.left, apart)) {
            self.unsure |= 1 << lane;
        }
    }
}

/// What a ray meets first of a glass object.
pub(super) struct Pane {
    pub object: u32,
    pub t: f64,
    pub error: f64,
    /// What is left of the ray's light.
    pub left: f64,
    /// The ray meets nothing of the object that is opaque.
    pub clear: bool,
}

impl Shone<'_> {
    /// A box around what is opaque of a glass object, if anything is; no surface of that is farther outside than `slack`.
    pub(super) fn dark_of(&self, object: u32, slack: f64) -> Option<Bounds> {
        let is_mixed = self.clarity.get(object as usize) == Some(&Clarity::Mixed);
        is_mixed.then(|| self.dark[object as usize].padded(DVec3::splat(slack)))
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
        let dark = match lamp.dark_of(about.0, self.slack) {
            Some(Bounds { lo, hi }) => {
                let thin = &memory.thin[k];
                simd.vectorize(
                    #[inline(always)]
                    || thin.passing(simd, &Slabs::around(simd, lo, hi, self.slack), shaft.open()),
                )
            }
            None => 0,
        };
        for lane in lanes(shaft.open()) {
            let (t, error) = (met.t.0[lane], met.error.0[lane]);
            if t < f64::INFINITY {
                let left = lamp.lets_through[met.primitive.0[lane] as usize];
                let pane = Pane { object: about.0, t, error, left, clear: dark >> lane & 1 == 0 };
                shaft.glass(lane, &pane, self.slack, |other| self.apart(other, about.0));
            }
        }
        memory.met = met;
    }

    /// Whether two objects are so far apart that no crossing with one can seem to lie where one with the other does.
    pub(super) fn apart(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|object| &self.assembly.objects[object as usize].bounds);
        let gap = (a.lo - b.hi).max(b.lo - a.hi).max_element();
        // Where a ray grazes something round, whose radius is at most that of the world, the square of half the chord is
        // off by twice the product of that radius and what a surface is off.
        let off = self.assembly.off;
        gap > 2.0 * (off + (2.0 * WORLD * off).sqrt()) + self.slack
    }
}

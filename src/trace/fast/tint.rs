//! Glass between the lit points of a tile and one light.
//!
//! A glass object takes its share of the light once, however often a ray crosses its surface, and whatever else is on the
//! way: so what a ray meets of it first is all there is to know, as long as nothing else is crossed in the same place: the
//! light is followed from surface to surface, and what is left behind there might be passed over. Where there are three on
//! one way the ray is asked alone: which comes first makes a difference in the last digit.

use fearless_simd::Simd;

use crate::lattice::FAN;
use crate::math::{BUNDLE, Bounds, Column, DVec3, Ray, lanes};
use crate::solid::{Departures, WORLD};
use crate::stage::{Meter, Silent};

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
    /// Which of them meet a second glass object, of which it is not known yet whether it is met where the first is crossed.
    close: u64,
    /// The objects that they meet, by their numbers.
    met: [[u32; BUNDLE]; MOST],
    /// Where the first was met, and where the farther one of two, each with how far that may be off.
    at: [[Column; 2]; MOST],
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
    pub const NONE: Self = Self {
        rays: 0,
        share: Column::filled(1.0),
        close: 0,
        met: [[NONE; BUNDLE]; MOST],
        at: [[Column::filled(0.0); 2]; MOST],
    };

    /// Forgets all.
    pub fn clear(&mut self) {
        (self.rays, self.close) = (0, 0);
    }

    /// Forgets what some rays met.
    pub(super) fn forget(&mut self, rays: u64) {
        self.rays &= !rays;
        self.close &= !rays;
    }

    /// A ray meets a glass object. Answers whether what is left of its light is certain, or will be as soon as those that are
    /// `close` are told apart.
    fn add(&mut self, lane: usize, pane: &Pane, slack: f64, apart: impl Fn(u32) -> bool) -> bool {
        let bit = 1 << lane;
        let [first, farther] = &mut self.at;
        if self.rays & bit == 0 {
            self.rays |= bit;
            self.share.0[lane] = pane.left;
            (self.met[0][lane], self.met[1][lane]) = (pane.object, NONE);
            (first[0].0[lane], first[1].0[lane]) = (pane.t, pane.error);
            return true;
        }
        if self.met[1][lane] != NONE {
            return false;
        }
        self.met[1][lane] = pane.object;
        self.share.0[lane] *= pane.left;
        if !apart(self.met[0][lane]) {
            let (t, error) = (first[0].0[lane], first[1].0[lane]);
            // Seen from any surface before it, each may be off by as much again.
            let off = 2.0 * (error + pane.error) + slack;
            if (t - pane.t).abs() <= 2.0 * off {
                return false;
            }
            if t > pane.t {
                (self.met[0][lane], self.met[1][lane]) = (pane.object, self.met[0][lane]);
            }
            (farther[0].0[lane], farther[1].0[lane]) = (t.max(pane.t), off);
            self.close |= bit;
        }
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
        if !(certain && self.tint.add(lane, met, slack, apart)) {
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

    /// Tells apart where the rays of some shafts meet a second glass object, and where they cross the first: those of which it
    /// is not certain are unsure.
    pub(super) fn settle_glass(&self, shafts: &mut [Shaft], memory: &mut TileMemory) {
        let mut meter = Meter::new(Silent);
        for shaft in shafts {
            let close = std::mem::take(&mut shaft.tint.close) & !(shaft.blocked | shaft.unsure);
            for lane in lanes(close) {
                let ray = shaft.rays.ray(lane);
                let [_, [t, off]] = &shaft.tint.at;
                let (t, off) = (t.0[lane], off.0[lane]);
                // From a little before the second, the first is next crossed well behind it, if at all.
                let ray = Ray::new(ray.at(t - off), ray.d);
                let (first, to) = (shaft.tint.met[0][lane], 4.0 * off);
                let next = self.exact.object(first, &ray, None, to, memory.apart.scratch(), &mut meter);
                let is_certain = next.is_none_or(|next| next.t - next.error > 2.0 * off);
                shaft.unsure |= u64::from(!is_certain) << lane;
            }
        }
        memory.counts += meter.counts;
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

//! Rays that have no company: those of bundles that were given up, many on their way at once.
//!
//! Each finds what it finds alone. Where that is more than one thing in one place, it is asked of the exact engine.

use crate::lattice::{Meeting, Stream, Ways};
use crate::math::{BUNDLE, Bundle, Ray};
use crate::solid::{Crossing, Departure, Departures, Form, Scratch};
use crate::stage::{Counts, Meter, Silent};

use super::Fast;
use super::memory::TileMemory;
use super::nearest::Nearest;
use super::shaft::{Shaft, Shone};
use super::tint::Clarity;

/// A ray's place: its bundle, and its lane there.
#[derive(Clone, Copy, Debug)]
struct Place {
    bundle: usize,
    lane: usize,
}

/// Memory for rays without company.
#[derive(Debug, Default)]
pub struct Apart {
    stream: Stream,
    /// By ray, [`BUNDLE`] times its bundle's number and its lane.
    places: Vec<u32>,
    scratch: Scratch,
}

impl Apart {
    fn clear(&mut self) {
        self.stream.clear();
        self.places.clear();
    }

    /// One more ray, that looks as far as `to`.
    fn push(&mut self, Place { bundle, lane }: Place, ray: &Ray, to: f64) {
        self.stream.push(ray, to);
        self.places.push((bundle * BUNDLE + lane) as u32);
    }
}

/// The places of some rays of a bundle.
fn places(bundle: usize, mut rays: u64) -> impl Iterator<Item = Place> {
    std::iter::from_fn(move || {
        let lane = rays.trailing_zeros() as usize;
        (rays != 0).then(|| {
            rays &= rays - 1;
            Place { bundle, lane }
        })
    })
}

/// What rays without company are asked about.
trait Asking {
    /// The ray, and the surface that it leaves.
    fn ray(&self, at: Place) -> (Ray, Option<Departure>);
    /// How far a crossing with an object may be to matter.
    fn to(&self, at: Place, object: u32) -> f64;
    /// A crossing with an object. Answers how far the ray still looks: below 0 where no farther at all.
    fn meet(&mut self, at: Place, object: u32, crossing: &Crossing) -> f64;
}

/// What rays meet first.
struct First<'a> {
    bundles: &'a [Bundle],
    departures: Option<&'a [Departures]>,
    nearest: &'a mut [Nearest],
    slack: f64,
}

impl Asking for First<'_> {
    #[inline]
    fn ray(&self, Place { bundle, lane }: Place) -> (Ray, Option<Departure>) {
        (self.bundles[bundle].ray(lane), self.departures.map(|all| all[bundle].get(lane)))
    }

    #[inline]
    fn to(&self, Place { bundle, lane }: Place, _: u32) -> f64 {
        self.nearest[bundle].t.0[lane] + self.slack
    }

    #[inline]
    fn meet(&mut self, Place { bundle, lane }: Place, object: u32, crossing: &Crossing) -> f64 {
        self.nearest[bundle].offer_one(lane, object, crossing);
        self.nearest[bundle].t.0[lane] + self.slack
    }
}

/// What stands between surfaces and a light.
struct Blocked<'a> {
    shafts: &'a mut [Shaft],
    departures: &'a [Departures],
    lamp: &'a Shone<'a>,
    slack: f64,
}

impl Asking for Blocked<'_> {
    #[inline]
    fn ray(&self, Place { bundle, lane }: Place) -> (Ray, Option<Departure>) {
        (self.shafts[bundle].rays.ray(lane), Some(self.departures[bundle].get(lane)))
    }

    #[inline]
    fn to(&self, Place { bundle, lane }: Place, object: u32) -> f64 {
        match self.lamp.clarity.get(object as usize) {
            Some(Clarity::Clear | Clarity::Mixed) => f64::INFINITY,
            _ => self.shafts[bundle].distance.0[lane],
        }
    }

    #[inline]
    fn meet(&mut self, Place { bundle, lane }: Place, object: u32, crossing: &Crossing) -> f64 {
        let (shaft, bit) = (&mut self.shafts[bundle], 1 << lane);
        let distance = shaft.distance.0[lane];
        match self.lamp.clarity.get(object as usize).copied() {
            Some(clarity @ (Clarity::Clear | Clarity::Mixed)) => {
                let left = self.lamp.lets_through[crossing.primitive as usize];
                shaft.glass(lane, (crossing.t, crossing.error), clarity, left, self.slack);
            }
            // Where a ray leaves glass and an opaque solid together, the glass has the say.
            Some(Clarity::Opaque) if !crossing.entering && shaft.blocks(lane, crossing) => {
                shaft.unsure |= bit;
            }
            _ if shaft.blocks(lane, crossing) => shaft.blocked |= bit,
            _ => {}
        }
        if (shaft.blocked | shaft.unsure) & bit != 0 { -1.0 } else { distance + self.slack }
    }
}

impl Fast<'_> {
    /// The first hits of the rays of some bundles that have no company: those in [`Nearest::apart`].
    pub fn first_apart(
        &self,
        bundles: &[Bundle],
        departures: Option<&[Departures]>,
        nearest: &mut [Nearest],
        memory: &mut TileMemory,
    ) {
        let TileMemory { apart, counts, .. } = memory;
        apart.clear();
        for (k, (bundle, found)) in bundles.iter().zip(&mut *nearest).enumerate() {
            for at in places(k, found.apart) {
                found.forget(at.lane);
                if departures.is_some_and(|all| self.from_mesh(&all[k], at.lane)) {
                    found.unsure |= 1 << at.lane;
                } else {
                    apart.push(at, &bundle.ray(at.lane), f64::INFINITY);
                }
            }
        }
        let mut asking = First { bundles, departures, nearest, slack: self.slack };
        self.ask_stream(apart, &mut asking, counts);
        for found in nearest {
            for Place { lane, .. } in places(0, std::mem::take(&mut found.apart)) {
                let t = found.t.0[lane];
                let close = found.second.0[lane] <= t + self.slack && t < f64::INFINITY;
                found.unsure |= u64::from(close) << lane;
            }
        }
    }

    /// Which of the rays towards a light that have no company, those in [`Shaft::apart`], are blocked, and what glass leaves
    /// of the light of the others.
    pub fn blocked_apart(
        &self,
        shafts: &mut [Shaft],
        departures: &[Departures],
        lamp: &Shone,
        memory: &mut TileMemory,
    ) {
        let TileMemory { apart, counts, .. } = memory;
        apart.clear();
        for (k, shaft) in shafts.iter_mut().enumerate() {
            shaft.tint.forget(shaft.apart);
            for at in places(k, std::mem::take(&mut shaft.apart)) {
                if self.from_mesh(&departures[k], at.lane) {
                    shaft.unsure |= 1 << at.lane;
                } else {
                    apart.push(at, &shaft.rays.ray(at.lane), shaft.distance.0[at.lane] + self.slack);
                }
            }
        }
        let mut asking = Blocked { shafts, departures, lamp, slack: self.slack };
        self.ask_stream(apart, &mut asking, counts);
    }

    /// Whether a ray leaves a mesh, which has many faces: of those nothing is noted for a bundle.
    fn from_mesh(&self, departures: &Departures, lane: usize) -> bool {
        let primitive = departures.primitive.0[lane];
        primitive >= 0.0 && matches!(self.assembly.primitives[primitive as usize].form, Form::Mesh(_))
    }

    /// Asks all rays of a stream.
    fn ask_stream(&self, apart: &mut Apart, asking: &mut impl Asking, counts: &mut Counts) {
        let Apart { stream, places, scratch } = apart;
        let mut visited = 0;
        let mut meter = Meter::new(Silent);
        self.boxes.walk_stream(stream, &mut visited, &mut |met: &[Meeting], ways: &mut Ways| {
            for meeting in met {
                if !ways.matters(meeting) {
                    continue;
                }
                let Meeting { ray: number, object, .. } = *meeting;
                let place = places[number as usize] as usize;
                let at = Place { bundle: place / BUNDLE, lane: place % BUNDLE };
                let (ray, departure) = asking.ray(at);
                let to = asking.to(at, object);
                if let Some(crossing) = self.exact.object(object, &ray, departure, to, scratch, &mut meter) {
                    ways.look(number, asking.meet(at, object, &crossing));
                }
            }
        });
        *counts += meter.counts;
        counts.cells_visited += visited;
    }
}

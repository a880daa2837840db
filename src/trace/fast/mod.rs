//! The fast engine: the rays of a tile side by side, with the bits that the exact engine finds for each alone.
//!
//! A tile of rays is bounded by frustums, which walk a hierarchy of boxes; what they leave is computed for eight rays
//! at a time, by the same formulas in the same order. Where a ray's answer needs more than that, two surfaces in one
//! place or a solid that is not convex, the exact engine is asked for that ray; and so are rays that have no
//! company.

mod company;
mod first;
mod memory;
mod nearest;
mod shaft;
mod slices;
mod thin;
mod walk;

use fearless_simd::{Level, Simd, dispatch};

use crate::lattice::{Boxes, Structure, SubLattices, slack};
use crate::math::{Bundle, Column, Columns, ROWS, Ray};
use crate::solid::{Assembly, Crossing, Departure, Departures};
use crate::stage::{Meter, Probe};

use super::exact::all_moved_nearer;
use super::{Engine, Exact, Hit, Memory};

pub use memory::TileMemory;
pub use nearest::Nearest;
pub use shaft::{Shaft, Shone};

/// The engine for tiles of rays, over an assembly and a hierarchy of its boxes.
#[derive(Clone, Copy, Debug)]
pub struct Fast<'a> {
    exact: Exact<'a>,
    assembly: &'a Assembly,
    boxes: &'a Boxes,
    subs: &'a SubLattices,
    /// How far apart two hits may seem that are one place.
    slack: f64,
    level: Level,
}

impl<'a> Fast<'a> {
    /// An engine over an assembly, at the SIMD width of this processor.
    pub fn new(assembly: &'a Assembly, boxes: &'a Boxes, subs: &'a SubLattices) -> Self {
        let exact = Exact::new(assembly, Structure::Boxes(boxes, subs));
        Self { exact, assembly, boxes, subs, slack: slack(assembly.off), level: Level::new() }
    }

    /// The same engine at another SIMD width. It finds the same bits.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The SIMD width.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Moves the starts of rays from the eye near to the world. Answers the way there, in two parts that are to be added
    /// to a distance, the second first.
    pub fn approach(&self, bundle: &mut Bundle) -> [Column; 2] {
        let mut ways = [Column::filled(0.0); 2];
        dispatch!(self.level, simd => approached(simd, bundle, &mut ways));
        ways
    }

    /// The first hits of a tile of rays from the eye, by bundles that are [closed](Bundle::close). Those that are
    /// unsure, and those that meet two objects in one place, are to be asked of [`Engine::first`] one by one.
    pub fn first_of(&self, bundles: &[Bundle], nearest: &mut [Nearest], memory: &mut TileMemory) {
        dispatch!(self.level, simd => self.first_of_tile(simd, bundles, nearest, memory));
        for (bundle, found) in bundles.iter().zip(nearest) {
            for lane in 0..crate::math::BUNDLE {
                let close = found.second.0[lane] <= found.t.0[lane] + self.slack;
                found.unsure |= u64::from(close && found.t.0[lane] < f64::INFINITY) << lane;
            }
            found.unsure &= bundle.live;
        }
    }

    /// Which rays of a tile towards one light are blocked, and which meet something that lets light through. Those that are unsure are to be asked of
    /// [`Engine::blocked`] one by one.
    pub fn blocked_of(
        &self,
        shafts: &mut [Shaft],
        departures: &[Departures],
        lamp: &Shone,
        memory: &mut TileMemory,
    ) {
        let mut company = std::mem::take(&mut memory.company);
        if dispatch!(self.level, simd => company.would_help(simd, shafts, lamp.at)) {
            company.gather(shafts, departures);
            self.blocked_in_company(&mut company.shafts, &company.departures, lamp, memory);
            company.scatter(shafts);
        } else {
            self.blocked_in_company(shafts, departures, lamp, memory);
        }
        memory.company = company;
    }

    fn blocked_in_company(
        &self,
        shafts: &mut [Shaft],
        departures: &[Departures],
        lamp: &Shone,
        memory: &mut TileMemory,
    ) {
        dispatch!(self.level, simd => self.blocked_of_tile(simd, shafts, departures, lamp, memory));
    }
}

#[inline(always)]
fn approached<S: Simd>(simd: S, bundle: &mut Bundle, ways: &mut [Column; 2]) {
    for row in 0..ROWS {
        let (near, [far, left]) = all_moved_nearer(&bundle.load(simd, row));
        bundle.o.store(row, near.o);
        ways[0].store(row, far);
        ways[1].store(row, left);
    }
}

impl Engine for Fast<'_> {
    type Memory = Memory;

    fn memory(&self) -> Memory {
        self.exact.memory()
    }

    fn first(&self, ray: &Ray, memory: &mut Memory, meter: &mut Meter<impl Probe>) -> Option<Hit> {
        self.exact.first(ray, memory, meter)
    }

    fn next(
        &self,
        ray: &Ray,
        departure: Departure,
        memory: &mut Memory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Hit> {
        self.exact.next(ray, departure, memory, meter)
    }

    fn together<'m>(&self, memory: &'m Memory) -> &'m [(u32, Crossing)] {
        self.exact.together(memory)
    }

    fn blocked(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Memory,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        self.exact.blocked(ray, departure, distance, memory, meter)
    }
}

//! The light of a tile: what [`super::surface`] does for one ray, for bundles of them.
//!
//! All rays of one generation are traced before any is shaded ([`super::lamps`]); then those that are sent on
//! ([`super::sends`]) are the next generation. When there are no more, the light that arrives goes the same way back. Only
//! where a ray must tell two surfaces in one place apart, it goes its way alone.

use std::ops::Range;
use std::sync::OnceLock;

use crate::lattice::FAN;
use crate::math::{Bundle, Column, Columns, DVec3, LANES, Place, Ray, places};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Fast, Hit, Shaft, TileMemory};
use crate::view::Sight;

use super::channel::Channel;
use super::hits::{BlockHits, TileHits};
use super::lit::Lit;
use super::path::Sent;
use super::surface::{Memory, Met, Seen, Shader};
use super::wave::{Leg, Wave};

/// What shading a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileShading<C> {
    pub(super) trace: TileMemory,
    /// By generation.
    pub(super) waves: Vec<Wave<C>>,
    pub(super) shafts: Vec<Shaft>,
    pub(super) lit: Vec<Lit>,
}

impl<C> Default for TileShading<C> {
    fn default() -> Self {
        let (trace, shafts, lit) = (TileMemory::default(), Vec::new(), Vec::new());
        Self { trace, waves: Vec::new(), shafts, lit }
    }
}

impl<C: Channel> TileShading<C> {
    /// Another tile, of so many bundles.
    fn start(&mut self, bundles: usize) {
        if self.waves.is_empty() {
            self.waves.push(Wave::new(0));
        }
        let first = &mut self.waves[0];
        first.rays.resize(bundles, Bundle::EMPTY);
        first.before.resize(bundles, [Column::filled(0.0); 2]);
        first.make_room();
    }

    /// The light that arrives along the rays of a row of a bundle.
    #[inline]
    pub fn light(&self, bundle: usize, row: usize) -> [C; LANES] {
        self.waves[0].row_of_light(bundle, row)
    }

    /// What one ray of a bundle saw.
    #[inline]
    pub fn seen(&self, bundle: usize, lane: usize) -> Option<Seen> {
        let first = &self.waves[0];
        (first.found(bundle) >> lane & 1 == 1).then(|| {
            let Met { hit, normal, .. } = first.met(Place { bundle, lane });
            Seen { t: hit.t, object: hit.object, normal }
        })
    }
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// Finds what the rays of a tile see. What those from the eye met is taken from `kept`, which was set by the same sight of
    /// the same solids, or put there; where there is no such place, it is not kept.
    pub fn tile(
        &self,
        sight: &Sight,
        kept: Option<&OnceLock<TileHits>>,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        tile.start(sight.blocks());
        tile.waves[0].inside = memory.media.start(&self.around_eye);
        match kept.map(|kept| (kept, kept.get())) {
            None => self.see(sight, None, tile, memory, meter),
            Some((_, Some(hits))) => self.recall(sight, hits, tile, memory, meter),
            Some((kept, None)) => {
                let mut hits = TileHits::default();
                self.see(sight, Some(&mut hits), tile, memory, meter);
                // Whoever was sooner set the same.
                let _ = kept.set(hits);
            }
        }
        self.shade(0, tile, memory, meter);
        let mut last = 0;
        while self.send(last, tile, memory, meter) {
            last += 1;
            self.meet(last, tile, memory, meter);
            self.shade(last, tile, memory, meter);
        }
        for generation in (1..=last).rev() {
            self.arrive(generation, tile);
        }
        meter.counts += std::mem::take(tile.trace.counts_mut());
    }

    /// Finds what the rays from the eye meet. Those of blocks in whose way there is nothing are not even made.
    fn see(
        &self,
        sight: &Sight,
        mut keep: Option<&mut TileHits>,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let TileShading { trace, waves, .. } = tile;
        let wave = &mut waves[0];
        let count = wave.rays.len();
        let Wave { rays, before, nearest, .. } = &mut *wave;
        let mut make = |k: usize, rays: &mut Bundle| {
            meter.at(Stage::Ray);
            self.set_out(sight, k, rays, &mut before[k]);
            meter.at(Stage::Cell);
        };
        let made = self.engine.first_seen(sight, rays, &mut make, &mut nearest[..count], trace);
        self.engine.first_apart(&wave.rays, None, &mut wave.nearest[..count], trace);
        for k in 0..count {
            meter.counts.primary_rays += u64::from(sight.block(k).live().count_ones());
            if made >> k & 1 == 0 {
                wave.surfaces[k].forget();
                continue;
            }
            let unsure = std::mem::take(&mut wave.nearest[k].unsure);
            let mut alone = Vec::new();
            self.see_alone(sight, (k, unsure), wave, &mut alone, memory, meter);
            self.know(wave, k, &alone);
            let found = wave.found(k);
            meter.counts.primary_hits += u64::from(found.count_ones());
            if let Some(hits) = keep.as_mut().filter(|_| found != 0) {
                hits.keep(k, BlockHits::new(&wave.nearest[k], wave.known[k], &alone));
            }
        }
    }

    /// Makes the rays from the eye through a block.
    pub(super) fn set_out(&self, sight: &Sight, k: usize, rays: &mut Bundle, before: &mut [Column; 2]) {
        sight.rays(k, self.engine.level(), rays);
        self.engine.approach(rays, before);
    }

    /// Finds what some rays from the eye through a block meet, one after the other, and adds it to `alone`.
    pub(super) fn see_alone(
        &self,
        sight: &Sight,
        (k, some): (usize, u64),
        wave: &mut Wave<C>,
        alone: &mut Vec<(Place, Met)>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        for at in places(k, some) {
            let ray = Ray::new(sight.eye, wave.rays[k].d.get(at.lane));
            let hit = self.engine.first(&ray, &mut memory.engine, meter);
            let inside = wave.inside.clone();
            let sent = || Sent { ray, travelled: 0.0, weight: 1.0, generation: 0, inside };
            if let Some(met) = self.take(wave, at, sent, hit, memory, meter) {
                alone.push((at, met));
            }
        }
    }

    /// Finds what the rays meet that were sent on.
    fn meet(
        &self,
        generation: usize,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let TileShading { trace, waves, .. } = tile;
        let wave = &mut waves[generation];
        wave.bundle_legs(self.engine.level());
        wave.make_room();
        let kinds = std::mem::take(&mut wave.kinds);
        for kind in &kinds {
            let mut ask = |wave: &mut Wave<C>, bundles: Range<usize>| {
                let (rays, from) = (&wave.rays[bundles.clone()], &wave.from[bundles.clone()]);
                self.engine.first_of(rays, Some(from), &mut wave.nearest[bundles], trace)
            };
            let Range { mut start, end } = kind.bundles();
            // What curved surfaces send on runs apart: the first bundle shows it.
            let together = start < end && ask(wave, start..start + 1) == 0;
            start += 1;
            while start < end {
                let some = start..(start + FAN).min(end);
                start = some.end;
                if together {
                    ask(wave, some);
                } else {
                    for k in some {
                        wave.nearest[k].clear();
                        wave.nearest[k].apart = wave.rays[k].live;
                    }
                }
            }
        }
        let count = wave.rays.len();
        self.engine.first_apart(&wave.rays, Some(&wave.from[..count]), &mut wave.nearest[..count], trace);
        for kind in &kinds {
            for (number, leg) in kind.rays.iter().enumerate() {
                let at = kind.place(number);
                if wave.nearest[at.bundle].unsure >> at.lane & 1 == 1 {
                    let Leg { sent, departure } = leg;
                    let hit = self.engine.next(&sent.ray, *departure, &mut memory.engine, meter);
                    self.take(wave, at, || sent.clone(), hit, memory, meter);
                }
            }
        }
        for nearest in &mut wave.nearest {
            nearest.unsure = 0;
        }
        wave.kinds = kinds;
        for k in 0..wave.rays.len() {
            self.know(wave, k, &[]);
            meter.counts.secondary_rays += u64::from(wave.rays[k].live.count_ones());
            meter.counts.secondary_hits += u64::from(wave.found(k).count_ones());
        }
        meter.at(Stage::Shade);
    }

    /// What one ray met that was asked about alone. Where that is more than one surface in one place, its light is found
    /// at once.
    fn take(
        &self,
        wave: &mut Wave<C>,
        at: Place,
        sent: impl FnOnce() -> Sent,
        hit: Option<Hit>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Met> {
        wave.nearest[at.bundle].set(at.lane, hit.as_ref());
        let hit = hit?;
        if self.engine.together(&memory.engine).len() == 1 {
            return Some(Met { hit, p: hit.p, normal: DVec3::ZERO });
        }
        let sent = sent();
        meter.at(Stage::Shade);
        let met = self.met(&sent.ray, hit, memory);
        let light = self.light(&sent, &met, memory, meter);
        meter.at(Stage::Cell);
        wave.nearest[at.bundle].set(at.lane, Some(&met.hit));
        wave.set_light(at, light);
        wave.known[at.bundle] |= 1 << at.lane;
        Some(met)
    }

    /// The surfaces that a bundle met. `alone` are rays whose numbers were found alone.
    pub(super) fn know(&self, wave: &mut Wave<C>, k: usize, alone: &[(Place, Met)]) {
        let level = self.engine.level();
        let Wave { rays, before, nearest, surfaces, departures, known, .. } = wave;
        let (bundle, nearest, surfaces) = (&rays[k], &nearest[k], &mut surfaces[k]);
        surfaces.points(bundle, &before[k], nearest, level);
        surfaces.hits &= !known[k];
        for (Place { lane, .. }, met) in alone {
            surfaces.p.set(*lane, met.p);
            surfaces.way.0[*lane] = met.hit.t;
        }
        surfaces.know(bundle, nearest, self.assembly, &mut departures[k], level);
        for at in places(k, surfaces.patches) {
            let (primitive, surface) =
                (nearest.primitive.0[at.lane] as u32, nearest.surface.0[at.lane] as u32);
            let p = surfaces.p.get(at.lane);
            let normal = self.assembly.turned_normal(primitive, surface, p, bundle.d.get(at.lane));
            surfaces.normal.set(at.lane, normal);
            let hit = Hit { t: 0.0, error: 0.0, p, object: 0, primitive, surface, entering: true };
            departures[k].set(at.lane, &self.departure(&hit, p, normal));
        }
        for (Place { lane, .. }, met) in alone.iter().filter(|(at, _)| known[k] >> at.lane & 1 == 1) {
            surfaces.normal.set(*lane, met.normal);
        }
    }
}

//! The light of a tile: what [`super::surface`] does for one ray, for packets of them.
//!
//! All rays of one generation are traced before any is shaded ([`super::lamps`]); then those that are sent on
//! ([`super::sends`]) are the next generation. When there are no more, the light that arrives goes the same way back. Only
//! where a ray must tell two surfaces in one place apart, it goes its way alone.

use std::ops::Range;
use std::sync::OnceLock;

use crate::lattice::FRUSTA;
use crate::math::{DVec3, LANES, LaneVector, Lanes, Ray, RayIndex, RayPacket, places};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Fast, Hit, ShadowPacket, TileMemory};
use crate::view::TileCamera;

use super::channel::Channel;
use super::hits::{BlockHits, TileHits};
use super::lit::Lit;
use super::path::PathState;
use super::surface::{Memory, PrimaryHit, Shader, SurfaceInteraction};
use super::wavefront::{QueuedRay, Wavefront};

/// What shading a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileShading<C> {
    pub(super) trace: TileMemory,
    /// By generation.
    pub(super) waves: Vec<Wavefront<C>>,
    pub(super) shadow_packets: Vec<ShadowPacket>,
    pub(super) lit: Vec<Lit>,
}

impl<C> Default for TileShading<C> {
    fn default() -> Self {
        let (trace, shadow_packets, lit) = (TileMemory::default(), Vec::new(), Vec::new());
        Self { trace, waves: Vec::new(), shadow_packets, lit }
    }
}

impl<C: Channel> TileShading<C> {
    /// Another tile, of so many packets.
    fn start(&mut self, packets: usize) {
        if self.waves.is_empty() {
            self.waves.push(Wavefront::new(0));
        }
        let first = &mut self.waves[0];
        first.rays.resize(packets, RayPacket::EMPTY);
        first.before.resize(packets, [Lanes::filled(0.0); 2]);
        first.make_room();
    }

    /// The light that arrives along the rays of a row of a packet.
    #[inline]
    pub fn light(&self, packet: usize, row: usize) -> [C; LANES] {
        self.waves[0].row_of_light(packet, row)
    }

    /// What one ray of a packet saw.
    #[inline]
    pub fn seen(&self, packet: usize, lane: usize) -> Option<PrimaryHit> {
        let first = &self.waves[0];
        (first.found(packet) >> lane & 1 == 1).then(|| {
            let SurfaceInteraction { hit, normal, .. } = first.met(RayIndex { packet, lane });
            PrimaryHit { t: hit.t, object: hit.object, normal }
        })
    }
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// Finds what the rays of a tile see. What those from the eye met is taken from `kept`, which was set by the same sight of
    /// the same solids, or put there; where there is no such place, it is not kept.
    pub fn tile(
        &self,
        sight: &TileCamera,
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
        sight: &TileCamera,
        mut keep: Option<&mut TileHits>,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let TileShading { trace, waves, .. } = tile;
        let wave = &mut waves[0];
        let count = wave.rays.len();
        let Wavefront { rays, before, nearest, .. } = &mut *wave;
        let mut make = |k: usize, rays: &mut RayPacket| {
            meter.at(Stage::Ray);
            self.set_out(sight, k, rays, &mut before[k]);
            meter.at(Stage::Cell);
        };
        let made = self.engine.first_seen(sight, rays, &mut make, &mut nearest[..count], trace);
        self.engine.first_of_incoherent(&wave.rays, None, &mut wave.nearest[..count], trace);
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
    pub(super) fn set_out(
        &self,
        sight: &TileCamera,
        k: usize,
        rays: &mut RayPacket,
        before: &mut [Lanes; 2],
    ) {
        sight.rays(k, self.engine.level(), rays);
        self.engine.approach(rays, before);
    }

    /// Finds what some rays from the eye through a block meet, one after the other, and adds it to `alone`.
    pub(super) fn see_alone(
        &self,
        sight: &TileCamera,
        (k, some): (usize, u64),
        wave: &mut Wavefront<C>,
        alone: &mut Vec<(RayIndex, SurfaceInteraction)>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        for at in places(k, some) {
            let ray = Ray::new(sight.eye, wave.rays[k].d.get(at.lane));
            let hit = self.engine.first(&ray, &mut memory.engine, meter);
            let inside = wave.inside.clone();
            let sent = || PathState { ray, travelled: 0.0, weight: 1.0, generation: 0, inside };
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
        wave.packet_legs(self.engine.level());
        wave.make_room();
        let kinds = std::mem::take(&mut wave.kinds);
        for kind in &kinds {
            let mut ask = |wave: &mut Wavefront<C>, packets: Range<usize>| {
                let (rays, from) = (&wave.rays[packets.clone()], &wave.from[packets.clone()]);
                self.engine.first_of(rays, Some(from), &mut wave.nearest[packets], trace)
            };
            let Range { mut start, end } = kind.packets();
            // What curved surfaces send on runs apart: the first packet shows it.
            let together = start < end && ask(wave, start..start + 1) == 0;
            start += 1;
            while start < end {
                let some = start..(start + FRUSTA).min(end);
                start = some.end;
                if together {
                    ask(wave, some);
                } else {
                    for k in some {
                        wave.nearest[k].clear();
                        wave.nearest[k].incoherent = wave.rays[k].live;
                    }
                }
            }
        }
        let count = wave.rays.len();
        self.engine.first_of_incoherent(
            &wave.rays,
            Some(&wave.from[..count]),
            &mut wave.nearest[..count],
            trace,
        );
        for kind in &kinds {
            for (number, leg) in kind.rays.iter().enumerate() {
                let at = kind.place(number);
                if wave.nearest[at.packet].unsure >> at.lane & 1 == 1 {
                    let QueuedRay { sent, departure } = leg;
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
        wave: &mut Wavefront<C>,
        at: RayIndex,
        sent: impl FnOnce() -> PathState,
        hit: Option<Hit>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<SurfaceInteraction> {
        wave.nearest[at.packet].set(at.lane, hit.as_ref());
        let hit = hit?;
        if self.engine.together(&memory.engine).len() == 1 {
            return Some(SurfaceInteraction { hit, p: hit.p, normal: DVec3::ZERO });
        }
        let sent = sent();
        meter.at(Stage::Shade);
        let met = self.met(&sent.ray, hit, memory);
        let light = self.light(&sent, &met, memory, meter);
        meter.at(Stage::Cell);
        wave.nearest[at.packet].set(at.lane, Some(&met.hit));
        wave.set_light(at, light);
        wave.known[at.packet] |= 1 << at.lane;
        Some(met)
    }

    /// The surfaces that a packet met. `alone` are rays whose numbers were found alone.
    pub(super) fn know(&self, wave: &mut Wavefront<C>, k: usize, alone: &[(RayIndex, SurfaceInteraction)]) {
        let level = self.engine.level();
        let Wavefront { rays, before, nearest, surfaces, departures, known, .. } = wave;
        let (packet, nearest, surfaces) = (&rays[k], &nearest[k], &mut surfaces[k]);
        surfaces.points(packet, &before[k], nearest, level);
        surfaces.hits &= !known[k];
        for (RayIndex { lane, .. }, met) in alone {
            surfaces.p.set(*lane, met.p);
            surfaces.way.0[*lane] = met.hit.t;
        }
        surfaces.know(packet, nearest, self.assembly, &mut departures[k], level);
        for at in places(k, surfaces.patches) {
            let (primitive, surface) = (nearest.primitive.0[at.lane], nearest.surface.0[at.lane]);
            let p = surfaces.p.get(at.lane);
            let normal = self.assembly.turned_normal(primitive, surface, p, packet.d.get(at.lane));
            surfaces.normal.set(at.lane, normal);
            let hit = Hit { t: 0.0, error: 0.0, p, object: 0, primitive, surface, entering: true };
            departures[k].set(at.lane, &self.departure(&hit, p, normal));
        }
        for (RayIndex { lane, .. }, met) in alone.iter().filter(|(at, _)| known[k] >> at.lane & 1 == 1) {
            surfaces.normal.set(*lane, met.normal);
        }
    }
}

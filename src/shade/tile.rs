//! The light of a tile: what [`super::surface`] does for one ray, for bundles of them.
//!
//! All rays of one generation are traced before any is shaded, and their lit points ask for one light after the other,
//! so that the rays towards it run side by side; then those that are sent on are the next generation. When there are no
//! more, the light that arrives goes the same way back. Only where a ray must tell two surfaces in one place apart, it goes
//! its way alone.

use std::ops::Range;

use crate::lattice::FAN;
use crate::math::{Bundle, Column, Columns, DVec3, LANES, Ray};
use crate::solid::{Crossing, Departure, Form};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Fast, Hit, Shaft, Shone, TileMemory};

use super::channel::Channel;
use super::lit::{Gathering, Lit, Needs, add_everywhere, before_lamps};
use super::media::{Media, OUTSIDE};
use super::path::{Onward, Sent};
use super::surface::{Finish, Lamp, Memory, Met, Seen, Shader};
use super::surfaces::Surfaces;
use super::wave::{Arrival, Leg, Legs, Place, Wave};

/// So few rays that are sent on take less time one by one than a bundle of them does.
const FEW_LEGS: usize = 6;

/// The most rays that a generation is let grow to, 16 times as many as a tile has dots: at each glass surface there may be
/// two for one. Those past it go alone.
const MOST_LEGS: usize = 16 * 1024;

/// What shading a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileShading<C> {
    trace: TileMemory,
    /// By generation.
    waves: Vec<Wave<C>>,
    shafts: Vec<Shaft>,
    lit: Vec<Lit>,
}

impl<C> Default for TileShading<C> {
    fn default() -> Self {
        let (trace, shafts, lit) = (TileMemory::default(), Vec::new(), Vec::new());
        Self { trace, waves: Vec::new(), shafts, lit }
    }
}

impl<C: Channel> TileShading<C> {
    /// Another tile, of so many bundles.
    pub fn start(&mut self, bundles: usize) {
        if self.waves.is_empty() {
            self.waves.push(Wave::new(0));
        }
        let first = &mut self.waves[0];
        first.rays.resize(bundles, Bundle::EMPTY);
        first.before.resize(bundles, [Column::filled(0.0); 2]);
    }

    /// The place of a bundle of rays from the eye, `bundle` below what the tile was started with: they start near the world,
    /// after a way in two parts that are to be added to a distance, the second first.
    pub fn sight(&mut self, bundle: usize) -> (&mut Bundle, &mut [Column; 2]) {
        let first = &mut self.waves[0];
        (&mut first.rays[bundle], &mut first.before[bundle])
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
        let met = first.surfaces[bundle].hits | first.known[bundle];
        (met >> lane & 1 == 1).then(|| {
            let Met { hit, normal, .. } = first.met(Place { bundle, lane });
            Seen { t: hit.t, object: hit.object, normal }
        })
    }
}

/// The places of bits among the rays of a bundle.
fn places(bundle: usize, mut bits: u64) -> impl Iterator<Item = Place> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            Place { bundle, lane }
        })
    })
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// Finds what the rays of a tile see; `eye` is where they all start.
    pub fn tile(
        &self,
        eye: DVec3,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        tile.waves[0].inside = memory.media.start(&self.around_eye);
        tile.waves[0].make_room();
        self.see(eye, tile, memory, meter);
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

    /// Finds what the rays from the eye meet.
    fn see(
        &self,
        eye: DVec3,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let TileShading { trace, waves, .. } = tile;
        let wave = &mut waves[0];
        let count = wave.rays.len();
        self.engine.first_of(&wave.rays, None, &mut wave.nearest[..count], trace);
        self.engine.first_apart(&wave.rays, None, &mut wave.nearest[..count], trace);
        for k in 0..wave.rays.len() {
            let unsure = std::mem::take(&mut wave.nearest[k].unsure);
            let mut alone = Vec::new();
            for at in places(k, unsure) {
                let ray = Ray::new(eye, wave.rays[k].d.get(at.lane));
                let hit = self.engine.first(&ray, &mut memory.engine, meter);
                let inside = wave.inside.clone();
                let sent = || Sent { ray, travelled: 0.0, weight: 1.0, generation: 0, inside };
                if let Some(met) = self.take(wave, at, sent, hit, memory, meter) {
                    alone.push((at, met));
                }
            }
            self.know(wave, k, &alone);
            let met = u64::from((wave.surfaces[k].hits | wave.known[k]).count_ones());
            meter.counts.primary_rays += u64::from(wave.rays[k].live.count_ones());
            meter.counts.primary_hits += met;
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
            let met = u64::from((wave.surfaces[k].hits | wave.known[k]).count_ones());
            meter.counts.secondary_rays += u64::from(wave.rays[k].live.count_ones());
            meter.counts.secondary_hits += met;
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
    fn know(&self, wave: &mut Wave<C>, k: usize, alone: &[(Place, Met)]) {
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

    /// The light that a generation's surfaces send back of themselves.
    fn shade(
        &self,
        generation: usize,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Shade);
        let wave = &mut tile.waves[generation];
        for k in 0..wave.rays.len() {
            let (hits, known) = (wave.surfaces[k].hits, wave.known[k]);
            for (part, light) in wave.light_mut(k).iter_mut().enumerate() {
                before_lamps(self.background.part(part), hits, known, light, self.engine.level());
            }
        }
        for lamp in 0..self.lamps.len() {
            self.lamp(lamp, generation, tile, memory, meter);
        }
        let wave = &mut tile.waves[generation];
        let unit = self.assembly.datum.unit;
        let Wave { rays, surfaces, light, .. } = wave;
        for (Surfaces { materials, way, .. }, light) in
            surfaces[..rays.len()].iter().zip(light.chunks_mut(C::PARTS))
        {
            for &(material, lanes) in materials {
                let ambient = self.ambient * self.finishes[material as usize].color;
                let gathering = Gathering { depth: self.depth, unit, ambient };
                gathering.gather(lanes, way, light, self.engine.level());
            }
        }
    }

    /// Adds what one lamp gives.
    fn lamp(
        &self,
        lamp: usize,
        generation: usize,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        let level = self.engine.level();
        let Lamp { at: place, light: shed } = self.lamps[lamp];
        let TileShading { trace, waves, shafts, lit } = tile;
        let wave = &mut waves[generation];
        let count = wave.rays.len();
        if shafts.len() < count {
            shafts.resize(count, Shaft::EMPTY);
            lit.resize(count, Lit::NONE);
        }
        let shafts = &mut shafts[..count];
        for k in 0..count {
            let shines = self.made_so(&wave.surfaces[k], |finish| finish.kd > 0.0 || finish.ks > 0.0);
            let highlights = self.made_so(&wave.surfaces[k], |finish| finish.ks > 0.0) != 0;
            let asked = (shines, Needs { shadows: self.shadows, highlights });
            lit[k].light(place, &wave.rays[k], &wave.surfaces[k], asked, &mut shafts[k], level);
        }
        if self.shadows {
            meter.at(Stage::Cell);
            let (clarity, lets_through) = (&self.clarity[..], &self.lets_through[..]);
            let shone = Shone { at: place, clarity, lets_through };
            if wave.apart {
                shafts.iter_mut().for_each(Shaft::give_up);
                self.engine.blocked_apart(shafts, &wave.departures, &shone, trace);
            } else {
                // What curved surfaces send on mostly runs apart, towards one lamp as towards another.
                wave.apart =
                    self.engine.blocked_of(shafts, &wave.departures, &shone, trace) && generation > 0;
            }
            meter.at(Stage::Shade);
        }
        for (k, shaft) in shafts.iter().enumerate() {
            let asked = shaft.rays.live;
            let mut reached = asked;
            let mut dimmed = false;
            if self.shadows {
                let blocked = asked & shaft.blocked;
                let sure = shaft.tint.rays & !self.from_surfaces(wave, k, shaft.tint.rays);
                let alone = asked & !blocked & (shaft.unsure | shaft.tint.rays & !sure);
                let tinted = asked & !blocked & !alone & sure;
                meter.counts.shadow_rays += u64::from((asked & !alone).count_ones());
                meter.counts.shadow_hits += u64::from((blocked | tinted).count_ones());
                reached &= !blocked;
                for at in places(k, tinted) {
                    lit[k].visible.0[at.lane] = shaft.tint.share.0[at.lane];
                    dimmed = true;
                }
                for at in places(k, alone) {
                    let (ray, distance) = (shaft.rays.ray(at.lane), shaft.distance.0[at.lane]);
                    let visible = self.visibility(&ray, wave.departure(at), distance, memory, meter);
                    lit[k].visible.0[at.lane] = visible;
                    dimmed |= visible != 1.0;
                    if visible == 0.0 {
                        reached &= !(1 << at.lane);
                    }
                }
            }
            let Wave { surfaces, light, .. } = &mut *wave;
            let sum = &mut light[k * C::PARTS..][..C::PARTS];
            for &(material, lanes) in &surfaces[k].materials {
                let finish = &self.finishes[material as usize];
                lit[k].add(shed, finish, lanes & reached, dimmed, sum, level);
            }
            if dimmed {
                lit[k].visible = Column::filled(1.0);
            }
        }
    }

    /// Which of some rays of a bundle met a surface that bounds no solid. Beyond glass such a surface may seem to lie ahead
    /// of a ray that left it: how far it may be off its place knows no bound, and is not asked about any more.
    fn from_surfaces(&self, wave: &Wave<C>, k: usize, rays: u64) -> u64 {
        let met = |at: &Place| self.is_surface(wave.nearest[k].primitive.0[at.lane] as u32);
        places(k, rays).filter(met).fold(0, |rays, at| rays | 1 << at.lane)
    }

    /// The rays of a bundle that met a material of some kind.
    fn made_so(&self, surfaces: &Surfaces, kind: impl Fn(&Finish<C>) -> bool) -> u64 {
        let materials = surfaces.materials.iter();
        let of_kind = materials.filter(|(material, _)| kind(&self.finishes[*material as usize]));
        of_kind.fold(0, |rays, (_, lanes)| rays | lanes)
    }

    /// Sends the rays on that a generation's surfaces send. Answers whether there is another generation; the light of few
    /// rays arrives at once.
    fn send(
        &self,
        generation: usize,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        if tile.waves.len() == generation + 1 {
            tile.waves.push(Wave::new(generation as u32 + 1));
        }
        let (before, behind) = tile.waves.split_at_mut(generation + 1);
        let (wave, next) = (&mut before[generation], &mut behind[0]);
        next.clear_legs();
        let followed = wave.generation < self.generations;
        for k in 0..wave.rays.len() {
            // Where a mirror ray is not followed, nobody asks for its direction.
            let unfollowed = |finish: &Finish<C>| !followed && finish.kr > 0.0 && finish.kt == 0.0;
            let Wave { surfaces, light, .. } = &mut *wave;
            for &(material, lanes) in &surfaces[k].materials {
                let finish = &self.finishes[material as usize];
                if unfollowed(finish) {
                    let arriving = self.ambient * finish.kr;
                    add_everywhere(
                        arriving,
                        lanes,
                        &mut light[k * C::PARTS..][..C::PARTS],
                        self.engine.level(),
                    );
                    meter.counts.truncated_rays += u64::from(lanes.count_ones());
                }
            }
            let sends = |finish: &Finish<C>| (finish.kr > 0.0 || finish.kt > 0.0) && !unfollowed(finish);
            let senders = self.made_so(&wave.surfaces[k], sends);
            for at in places(k, senders) {
                if next.legs() < MOST_LEGS {
                    self.send_on(wave, at, next, &mut memory.media, meter);
                } else {
                    self.send_alone(wave, at, memory, meter);
                }
            }
        }
        if next.legs() > FEW_LEGS {
            return true;
        }
        for Legs { rays, arrivals, .. } in &next.kinds {
            for arrival in arrivals {
                let light = match arrival.leg {
                    None => self.ambient,
                    Some(leg) => {
                        let Leg { sent, departure } = &rays[leg as usize];
                        self.arriving(sent, *departure, memory, meter)
                    }
                };
                wave.add(arrival, light);
            }
        }
        false
    }

    /// The light of one surface, with all that it sends on.
    fn send_alone(
        &self,
        wave: &mut Wave<C>,
        at: Place,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        let met = wave.met(at);
        let Hit { t, error, object, primitive, surface, entering, .. } = met.hit;
        let (weight, inside) = wave.standing(at);
        let inside = inside.clone();
        let together = [(object, Crossing { t, error, primitive, surface, entering })];
        let change = self.change_at(&inside, &together, &mut memory.media);
        // The whole way is counted as that of this ray.
        let ray = wave.rays[at.bundle].ray(at.lane);
        let sent = Sent { ray, travelled: 0.0, weight, generation: wave.generation, inside };
        let light = self.sending_surface(&sent, &met, &change, wave.light(at), memory, meter);
        wave.set_light(at, light);
    }

    /// Sends on what one surface does.
    fn send_on(
        &self,
        wave: &Wave<C>,
        at: Place,
        next: &mut Wave<C>,
        media: &mut Media,
        meter: &mut Meter<impl Probe>,
    ) {
        let Met { hit, p, normal } = wave.met(at);
        let finish = self.finish(&hit);
        let (weight, inside) = wave.standing(at);
        let change = (finish.kt > 0.0).then(|| {
            let Hit { t, error, primitive, surface, entering, .. } = hit;
            let together = [(hit.object, Crossing { t, error, primitive, surface, entering })];
            self.change_at(inside, &together, media)
        });
        let (before, behind) = change.as_ref().map_or((OUTSIDE, OUTSIDE), |c| (c.before, c.behind));
        let onward = Onward::new(wave.rays[at.bundle].d.get(at.lane), normal, finish, before, behind);
        let back = wave.departure(at);
        let through = || match self.assembly.primitives[hit.primitive as usize].form {
            Form::Patch(_) => self.departure(&hit, p, -normal),
            _ => Departure { inward: !back.inward, ..back },
        };
        let beyond = change.map_or_else(|| inside.clone(), |change| change.list);
        let mirror = onward.mirror.map(|onward| (onward, back, inside.clone()));
        let snell = onward.snell.map(|onward| (onward, through(), beyond));
        for (kind, sent) in [mirror, snell].into_iter().enumerate() {
            let Some(((d, share), departure, inside)) = sent else { continue };
            let generation = wave.generation + 1;
            let weight = weight * share;
            let Legs { rays, arrivals, .. } = &mut next.kinds[kind];
            if generation > self.generations || weight < self.least_weight {
                meter.counts.truncated_rays += 1;
                arrivals.push(Arrival { at, share, leg: None });
            } else {
                arrivals.push(Arrival { at, share, leg: Some(rays.len() as u32) });
                let sent = Sent { ray: Ray::new(p, d), travelled: hit.t, weight, generation, inside };
                rays.push(Leg { sent, departure });
            }
        }
    }

    /// The light of a generation arrives at the one before it.
    fn arrive(&self, generation: usize, tile: &mut TileShading<C>) {
        let (before, behind) = tile.waves.split_at_mut(generation);
        let (wave, next) = (&mut before[generation - 1], &behind[0]);
        for kind in &next.kinds {
            for arrival in &kind.arrivals {
                let light = arrival.leg.map_or(self.ambient, |leg| next.light(kind.place(leg as usize)));
                wave.add(arrival, light);
            }
        }
    }
}

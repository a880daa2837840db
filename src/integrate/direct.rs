//! Direct light on the surfaces of one generation: one lamp after the other, so that the shadow rays towards
//! it run side by side.

use crate::math::{Lanes, lanes, places};
use crate::shade::{Channel, Illumination, Lamp, Lit, LitQuery, ResolvedMaterial, Surfaces, before_lamps};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{ShadowPacket, ShadowQuery};

use super::wavefront::Wavefront;
use super::wavefront_integrator::WavefrontIntegrator;
use super::wavefront_scratch::{WavefrontMemory, WavefrontScratch};

/// Of a packet's rays towards a lamp, those that it reaches.
struct Reached {
    /// A bit for each.
    lanes: u64,
    /// Whether glass takes a share of any.
    dimmed: bool,
}

impl<C: Channel> WavefrontIntegrator<'_, C> {
    /// Finds the light that a generation's surfaces send back of themselves.
    pub(super) fn shade_generation(
        &self,
        generation: usize,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Shade);
        let (level, illumination) = (self.engine.level(), self.illumination());
        let wave = &mut memory.tile.waves[generation];
        for k in 0..wave.rays.len() {
            wave.begin_histories(k);
            let (hits, known) = (wave.surfaces[k].hits, wave.resolved_singly[k]);
            for (part, light) in wave.light_mut(k).iter_mut().enumerate() {
                before_lamps(illumination.background.part(part), hits, known, light, level);
            }
        }
        for lamp in &illumination.lamps {
            self.add_lamp(lamp, generation, memory, meter);
        }
        let Wavefront { rays, surfaces, light, .. } = &mut memory.tile.waves[generation];
        for (Surfaces { materials, path_length, .. }, light) in
            surfaces[..rays.len()].iter().zip(light.chunks_mut(C::PARTS))
        {
            for &(material, lanes) in materials {
                let gathering = illumination.gathering(&illumination.materials[material as usize]);
                gathering.gather(lanes, path_length, light, level);
            }
        }
    }

    /// Adds what one lamp gives.
    fn add_lamp(
        &self,
        lamp: &Lamp<C>,
        generation: usize,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        self.find_lit(lamp, generation, &mut memory.tile, meter);
        let count = memory.tile.waves[generation].rays.len();
        for k in 0..count {
            let asked = memory.tile.shadow_packets[k].rays.live;
            if asked == 0 {
                let unlit = Reached { lanes: 0, dimmed: false };
                keep_visibility(&unlit, k, generation, &mut memory.tile);
                continue;
            }
            let mut reached = Reached { lanes: asked, dimmed: false };
            if self.illumination().shadows {
                reached = self.reached(k, generation, memory, meter);
            }
            keep_visibility(&reached, k, generation, &mut memory.tile);
            let WavefrontScratch { waves, lit, .. } = &mut memory.tile;
            let (Wavefront { surfaces, light, .. }, lit) = (&mut waves[generation], &mut lit[k]);
            let sum = &mut light[k * C::PARTS..][..C::PARTS];
            for &(material, lanes) in &surfaces[k].materials {
                let material = &self.illumination().materials[material as usize];
                let lanes = lanes & reached.lanes;
                lit.add(lamp.light, material, lanes, reached.dimmed, sum, self.engine.level());
            }
            if reached.dimmed {
                lit.visible = Lanes::filled(1.0);
            }
        }
    }

    /// Finds which surfaces a lamp shines on, and traces the rays towards it.
    fn find_lit(
        &self,
        lamp: &Lamp<C>,
        generation: usize,
        tile: &mut WavefrontScratch<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let (level, illumination) = (self.engine.level(), self.illumination());
        let Illumination { shadows, opacity, dark, lets_through, .. } = illumination;
        let WavefrontScratch { trace, waves, shadow_packets, lit, .. } = tile;
        let wave = &mut waves[generation];
        let count = wave.rays.len();
        if shadow_packets.len() < count {
            shadow_packets.resize(count, ShadowPacket::EMPTY);
            lit.resize(count, Lit::NONE);
        }
        let shadow_packets = &mut shadow_packets[..count];
        for k in 0..count {
            let surfaces = &wave.surfaces[k];
            if surfaces.hits == 0 {
                shadow_packets[k].clear();
                continue;
            }
            let query = LitQuery {
                lamp: lamp.at,
                lanes: self.made_of(surfaces, ResolvedMaterial::is_lit),
                shadows: *shadows,
                highlights: self.made_of(surfaces, |material| material.ks > 0.0) != 0,
            };
            lit[k].light(&query, &wave.rays[k], surfaces, &mut shadow_packets[k], level);
        }
        if *shadows {
            meter.at(Stage::Cell);
            let query = ShadowQuery { at: lamp.at, opacity, dark, lets_through };
            if wave.incoherent {
                self.engine.blocked_of_incoherent(shadow_packets, &wave.departures, &query, trace);
            } else {
                // What curved surfaces send on is mostly incoherent, towards one lamp as towards another.
                wave.incoherent =
                    self.engine.blocked_of(shadow_packets, &wave.departures, &query, trace) && generation > 0;
            }
            meter.at(Stage::Shade);
        }
    }

    /// Which rays of a shadow packet reach the lamp; rays of which the packet is uncertain are traced one by
    /// one.
    fn reached(
        &self,
        k: usize,
        generation: usize,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) -> Reached {
        let WavefrontMemory { single, tile: WavefrontScratch { waves, shadow_packets, lit, .. } } = memory;
        let (shadow_packet, lit) = (&shadow_packets[k], &mut lit[k]);
        let asked = shadow_packet.rays.live;
        let blocked = asked & shadow_packet.blocked;
        let uncertain = asked & !blocked & shadow_packet.uncertain;
        let tinted = asked & !blocked & !uncertain & shadow_packet.tint.rays;
        meter.counts.shadow_rays += u64::from((asked & !uncertain).count_ones());
        meter.counts.shadow_hits += u64::from((blocked | tinted).count_ones());
        let mut reached = Reached { lanes: asked & !blocked, dimmed: tinted != 0 };
        for at in places(k, tinted) {
            lit.visible.0[at.lane] = shadow_packet.tint.share.0[at.lane];
        }
        for at in places(k, uncertain) {
            let (ray, distance) = (shadow_packet.rays.ray(at.lane), shadow_packet.distance.0[at.lane]);
            let departure = waves[generation].departure(at);
            let visible = self.single.visibility(&ray, departure, distance, single, meter);
            lit.visible.0[at.lane] = visible;
            reached.dimmed |= visible != 1.0;
            if visible == 0.0 {
                reached.lanes &= !(1 << at.lane);
            }
        }
        reached
    }

    /// The rays of a packet that met a material of some kind.
    pub(super) fn made_of(&self, surfaces: &Surfaces, kind: impl Fn(&ResolvedMaterial<C>) -> bool) -> u64 {
        let materials = &self.illumination().materials;
        let of_kind = surfaces.materials.iter().filter(|(material, _)| kind(&materials[*material as usize]));
        of_kind.fold(0, |rays, (_, lanes)| rays | lanes)
    }
}

/// Adds to the histories of a packet's rays, where they are kept, how much of a lamp each surface sees.
fn keep_visibility<C: Channel>(
    reached: &Reached,
    k: usize,
    generation: usize,
    tile: &mut WavefrontScratch<C>,
) {
    let Wavefront { surfaces, histories, .. } = &mut tile.waves[generation];
    let Some(histories) = histories.get_mut(k) else { return };
    for lane in lanes(surfaces[k].hits) {
        let visible = if reached.lanes >> lane & 1 == 1 { tile.lit[k].visible.0[lane] } else { 0.0 };
        histories[lane] = histories[lane].lit(visible);
    }
}

//! The light that the surfaces of one generation send back of themselves: their lit points ask for one lamp after the
//! other, so that the rays towards it run side by side.

use crate::math::{Lanes, places};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Fast, ShadowPacket, ShadowQuery};

use super::channel::Channel;
use super::lit::{Gathering, Lit, Needs, before_lamps};
use super::surface::{Lamp, Memory, ResolvedMaterial, Shader};
use super::surfaces::Surfaces;
use super::tile::TileShading;
use super::wavefront::Wavefront;

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// The light that a generation's surfaces send back of themselves.
    pub(super) fn shade(
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
        let unit = self.assembly.scene_frame.unit;
        let Wavefront { rays, surfaces, light, .. } = wave;
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
        let TileShading { trace, waves, shadow_packets, lit } = tile;
        let wave = &mut waves[generation];
        let count = wave.rays.len();
        if shadow_packets.len() < count {
            shadow_packets.resize(count, ShadowPacket::EMPTY);
            lit.resize(count, Lit::NONE);
        }
        let shadow_packets = &mut shadow_packets[..count];
        for k in 0..count {
            if wave.surfaces[k].hits == 0 {
                shadow_packets[k].clear();
                continue;
            }
            let shines = self.made_so(&wave.surfaces[k], |finish| finish.kd > 0.0 || finish.ks > 0.0);
            let highlights = self.made_so(&wave.surfaces[k], |finish| finish.ks > 0.0) != 0;
            let asked = (shines, Needs { shadows: self.shadows, highlights });
            lit[k].light(place, &wave.rays[k], &wave.surfaces[k], asked, &mut shadow_packets[k], level);
        }
        if self.shadows {
            meter.at(Stage::Cell);
            let shone = ShadowQuery {
                at: place,
                opacity: &self.opacity,
                dark: &self.dark,
                lets_through: &self.lets_through,
            };
            if wave.apart {
                self.engine.blocked_of_incoherent(shadow_packets, &wave.departures, &shone, trace);
            } else {
                // What curved surfaces send on mostly runs apart, towards one lamp as towards another.
                wave.apart =
                    self.engine.blocked_of(shadow_packets, &wave.departures, &shone, trace) && generation > 0;
            }
            meter.at(Stage::Shade);
        }
        for (k, shadow_packet) in
            shadow_packets.iter().enumerate().filter(|(_, shadow_packet)| shadow_packet.rays.live != 0)
        {
            let asked = shadow_packet.rays.live;
            let mut reached = asked;
            let mut dimmed = false;
            if self.shadows {
                let blocked = asked & shadow_packet.blocked;
                let alone = asked & !blocked & shadow_packet.unsure;
                let tinted = asked & !blocked & !alone & shadow_packet.tint.rays;
                meter.counts.shadow_rays += u64::from((asked & !alone).count_ones());
                meter.counts.shadow_hits += u64::from((blocked | tinted).count_ones());
                reached &= !blocked;
                for at in places(k, tinted) {
                    lit[k].visible.0[at.lane] = shadow_packet.tint.share.0[at.lane];
                    dimmed = true;
                }
                for at in places(k, alone) {
                    let (ray, distance) =
                        (shadow_packet.rays.ray(at.lane), shadow_packet.distance.0[at.lane]);
                    let visible = self.visibility(&ray, wave.departure(at), distance, memory, meter);
                    lit[k].visible.0[at.lane] = visible;
                    dimmed |= visible != 1.0;
                    if visible == 0.0 {
                        reached &= !(1 << at.lane);
                    }
                }
            }
            let Wavefront { surfaces, light, .. } = &mut *wave;
            let sum = &mut light[k * C::PARTS..][..C::PARTS];
            for &(material, lanes) in &surfaces[k].materials {
                let finish = &self.finishes[material as usize];
                lit[k].add(shed, finish, lanes & reached, dimmed, sum, level);
            }
            if dimmed {
                lit[k].visible = Lanes::filled(1.0);
            }
        }
    }

    /// The rays of a packet that met a material of some kind.
    pub(super) fn made_so(&self, surfaces: &Surfaces, kind: impl Fn(&ResolvedMaterial<C>) -> bool) -> u64 {
        let materials = surfaces.materials.iter();
        let of_kind = materials.filter(|(material, _)| kind(&self.finishes[*material as usize]));
        of_kind.fold(0, |rays, (_, lanes)| rays | lanes)
    }
}

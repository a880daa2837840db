//! The light that the surfaces of one generation send back of themselves: their lit points ask for one lamp after the
//! other, so that the rays towards it run side by side.

use crate::math::{Column, places};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Fast, Shaft, Shone};

use super::channel::Channel;
use super::lit::{Gathering, Lit, Needs, before_lamps};
use super::surface::{Finish, Lamp, Memory, Shader};
use super::surfaces::Surfaces;
use super::tile::TileShading;
use super::wave::Wave;

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
            if wave.surfaces[k].hits == 0 {
                shafts[k].clear();
                continue;
            }
            let shines = self.made_so(&wave.surfaces[k], |finish| finish.kd > 0.0 || finish.ks > 0.0);
            let highlights = self.made_so(&wave.surfaces[k], |finish| finish.ks > 0.0) != 0;
            let asked = (shines, Needs { shadows: self.shadows, highlights });
            lit[k].light(place, &wave.rays[k], &wave.surfaces[k], asked, &mut shafts[k], level);
        }
        if self.shadows {
            meter.at(Stage::Cell);
            let shone = Shone {
                at: place,
                clarity: &self.clarity,
                dark: &self.dark,
                lets_through: &self.lets_through,
            };
            if wave.apart {
                self.engine.blocked_alone(shafts, &wave.departures, &shone, trace);
            } else {
                // What curved surfaces send on mostly runs apart, towards one lamp as towards another.
                wave.apart =
                    self.engine.blocked_of(shafts, &wave.departures, &shone, trace) && generation > 0;
            }
            meter.at(Stage::Shade);
        }
        for (k, shaft) in shafts.iter().enumerate().filter(|(_, shaft)| shaft.rays.live != 0) {
            let asked = shaft.rays.live;
            let mut reached = asked;
            let mut dimmed = false;
            if self.shadows {
                let blocked = asked & shaft.blocked;
                let alone = asked & !blocked & shaft.unsure;
                let tinted = asked & !blocked & !alone & shaft.tint.rays;
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

    /// The rays of a bundle that met a material of some kind.
    pub(super) fn made_so(&self, surfaces: &Surfaces, kind: impl Fn(&Finish<C>) -> bool) -> u64 {
        let materials = surfaces.materials.iter();
        let of_kind = materials.filter(|(material, _)| kind(&self.finishes[*material as usize]));
        of_kind.fold(0, |rays, (_, lanes)| rays | lanes)
    }
}

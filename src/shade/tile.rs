//! The light of a tile: what [`super::surface`] does for one ray, for bundles of them.
//!
//! All rays of a tile are traced before any is shaded, and the lit points of the tile ask for one light after the
//! other, so that the rays towards it run side by side. Where a dot needs a ray of its own, to see in a mirror or through
//! glass or to tell two surfaces apart, it goes its way alone.

use crate::math::{BUNDLE, Bundle, Column, Columns, DVec3, Ray};
use crate::solid::{Crossing, Departures};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Fast, Hit, Nearest, Shaft, TileMemory};

use super::channel::Channel;
use super::path::Sent;
use super::surface::{Memory, Met, Seen, Shader, View};

/// Rays from the eye, as a tile of them is traced.
#[derive(Debug, Default)]
pub struct Sight {
    /// The same rays from a start near the world.
    pub bundles: Vec<Bundle>,
    /// The way there, in two parts, of each.
    pub ways: Vec<[Column; 2]>,
}

/// What shading a tile needs, used again for every tile.
#[derive(Debug, Default)]
pub struct TileShading {
    trace: TileMemory,
    nearest: Vec<Nearest>,
    points: Vec<[Column; 3]>,
    normals: Vec<[Column; 3]>,
    departures: Vec<Departures>,
    shafts: Vec<Shaft>,
    facing: Vec<Column>,
    cosine: Vec<Column>,
}

impl Sight {
    /// Room for so many bundles, all empty.
    pub fn clear(&mut self, bundles: usize) {
        self.bundles.clear();
        self.bundles.resize(bundles, Bundle::EMPTY);
        self.ways.resize(bundles, [Column::filled(0.0); 2]);
    }

    /// Puts a ray from the eye in its place.
    #[inline]
    pub fn set(&mut self, bundle: usize, lane: usize, (near, way): (Ray, [f64; 2])) {
        self.bundles[bundle].set(lane, &near);
        let [far, left] = &mut self.ways[bundle];
        (far.0[lane], left.0[lane]) = (way[0], way[1]);
    }
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// What the rays of a tile see; `eye` is where they all start, and `put` is called for each live one with its
    /// bundle and its place in it.
    pub fn tile(
        &self,
        eye: DVec3,
        sight: &mut Sight,
        tile: &mut TileShading,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
        mut put: impl FnMut(usize, usize, View<C>),
    ) {
        meter.at(Stage::Cell);
        let bundles = &mut sight.bundles[..];
        bundles.iter_mut().for_each(Bundle::close);
        let count = bundles.len();
        tile.nearest.resize(count, Nearest::NOTHING);
        self.engine.first_of(bundles, &mut tile.nearest, &mut tile.trace);
        meter.at(Stage::Shade);
        let mut sums = vec![[C::DARK; BUNDLE]; count];
        let hits = self.meet(bundles, tile);
        for lamp in 0..self.lamps.len() {
            self.lamp(lamp, bundles, &hits, tile, memory, &mut sums, meter);
        }
        for (k, bundle) in bundles.iter().enumerate() {
            let mut rest = bundle.live;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let bit = 1 << lane;
                if tile.nearest[k].unsure & bit != 0 {
                    let ray = Ray::new(eye, bundle.d.get(lane));
                    put(k, lane, self.view(&ray, memory, meter));
                    continue;
                }
                meter.counts.primary_rays += 1;
                if hits[k] & bit == 0 {
                    put(k, lane, View { light: self.background, seen: None });
                    continue;
                }
                meter.counts.primary_hits += 1;
                let [far, left] = &sight.ways[k];
                let met = met(tile, k, lane, [far.0[lane], left.0[lane]]);
                let own = self.gathered(sums[k][lane], &met, met.hit.t);
                let finish = self.finish(&met.hit);
                let light = if finish.kr > 0.0 || finish.kt > 0.0 {
                    self.alone(&bundle.ray(lane), &met, own, memory, meter)
                } else {
                    own
                };
                let seen = Seen { t: met.hit.t, object: met.hit.object, normal: met.normal };
                put(k, lane, View { light, seen: Some(seen) });
            }
        }
        meter.counts += std::mem::take(tile.trace.counts_mut());
    }

    /// The surfaces that were met: their points, normals and departures. Answers which rays met one.
    fn meet(&self, bundles: &[Bundle], tile: &mut TileShading) -> Vec<u64> {
        let count = bundles.len();
        tile.points.resize(count, [Column::filled(0.0); 3]);
        tile.normals.resize(count, [Column::filled(0.0); 3]);
        tile.departures.resize(count, Departures::NONE);
        let mut hits = vec![0; count];
        for (k, bundle) in bundles.iter().enumerate() {
            let nearest = &tile.nearest[k];
            let departures = &mut tile.departures[k];
            departures.inward = 0;
            let mut rest = bundle.live & !nearest.unsure;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let t = nearest.t.0[lane];
                if t == f64::INFINITY {
                    continue;
                }
                hits[k] |= 1 << lane;
                let ray = bundle.ray(lane);
                let p = ray.at(t);
                let (primitive, surface) = (nearest.primitive.0[lane] as u32, nearest.surface.0[lane] as u32);
                let normal = self.assembly.turned_normal(primitive, surface, p, ray.d);
                tile.points[k].set(lane, p);
                tile.normals[k].set(lane, normal);
                let hit = Hit { t, error: 0.0, p, object: 0, primitive, surface, entering: true };
                departures.set(lane, &self.departure(&hit, p, normal));
            }
        }
        hits
    }

    /// Adds what one lamp gives.
    fn lamp(
        &self,
        lamp: usize,
        bundles: &[Bundle],
        hits: &[u64],
        tile: &mut TileShading,
        memory: &mut Memory<Fast<'e>>,
        sums: &mut [[C; BUNDLE]],
        meter: &mut Meter<impl Probe>,
    ) {
        let count = bundles.len();
        tile.shafts.resize(count, Shaft::EMPTY);
        tile.facing.resize(count, Column::filled(0.0));
        tile.cosine.resize(count, Column::filled(0.0));
        for (k, bundle) in bundles.iter().enumerate() {
            let shaft = &mut tile.shafts[k];
            (shaft.rays.live, shaft.blocked, shaft.unsure) = (0, 0, 0);
            let mut rest = hits[k];
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let (p, normal) = (tile.points[k].get(lane), tile.normals[k].get(lane));
                let primitive = tile.nearest[k].primitive.0[lane] as u32;
                let finish = self.finish_of(primitive);
                let Some(ray) = self.towards(lamp, p, normal) else { continue };
                if finish.kd > 0.0 || finish.ks > 0.0 {
                    tile.facing[k].0[lane] = ray.facing;
                    tile.cosine[k].0[lane] = ray.mirrored_cosine(normal, bundle.d.get(lane));
                    shaft.distance.0[lane] = ray.distance;
                    shaft.rays.set(lane, &Ray::new(p, ray.d));
                }
            }
            shaft.rays.close();
            if shaft.rays.live != 0 {
                let first = shaft.distance.0[shaft.rays.live.trailing_zeros() as usize];
                for lane in 0..BUNDLE {
                    if shaft.rays.live >> lane & 1 == 0 {
                        shaft.distance.0[lane] = first;
                    }
                }
            }
        }
        if self.shadows {
            meter.at(Stage::Cell);
            self.engine.blocked_of(&mut tile.shafts, &tile.departures, &mut tile.trace);
            meter.at(Stage::Shade);
        }
        for (k, shaft) in tile.shafts.iter().enumerate() {
            let mut rest = shaft.rays.live;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let bit = 1 << lane;
                let mut visible = 1.0;
                if self.shadows {
                    let blocked = shaft.blocked & bit != 0;
                    if shaft.unsure & bit != 0 || (blocked && self.glass) {
                        let met = met(tile, k, lane, [0.0; 2]);
                        let departure = self.departure(&met.hit, met.p, met.normal);
                        let (ray, distance) = (shaft.rays.ray(lane), shaft.distance.0[lane]);
                        visible = self.visibility(&ray, departure, distance, memory, meter);
                    } else {
                        meter.counts.shadow_rays += 1;
                        meter.counts.shadow_hits += u64::from(blocked);
                        visible = if blocked { 0.0 } else { 1.0 };
                    }
                    if visible == 0.0 {
                        continue;
                    }
                }
                let finish = self.finish_of(tile.nearest[k].primitive.0[lane] as u32);
                let (facing, cosine) = (tile.facing[k].0[lane], tile.cosine[k].0[lane]);
                let share = self.share(finish, facing, cosine) * visible;
                sums[k][lane] = (sums[k][lane] + self.lamps[lamp].light * share).limited();
            }
        }
    }

    /// The light of a surface that sends rays on.
    fn alone(
        &self,
        ray: &Ray,
        met: &Met,
        own: C,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let inside = memory.media.start(&self.around_eye);
        let Hit { t, error, object, primitive, surface, entering, .. } = met.hit;
        let together = [(object, Crossing { t, error, primitive, surface, entering })];
        let change = self.change_at(&inside, &together, &mut memory.media);
        let sent = Sent { ray: *ray, travelled: 0.0, weight: 1.0, generation: 0, inside };
        self.sending_surface(&sent, met, change, own, memory, meter)
    }
}

/// A surface that was met, as one ray meets it.
fn met(tile: &TileShading, k: usize, lane: usize, [far, left]: [f64; 2]) -> Met {
    let nearest = &tile.nearest[k];
    let p = tile.points[k].get(lane);
    let hit = Hit {
        t: far + (left + nearest.t.0[lane]),
        error: 0.0,
        p,
        object: nearest.object.0[lane] as u32,
        primitive: nearest.primitive.0[lane] as u32,
        surface: nearest.surface.0[lane] as u32,
        entering: nearest.entering >> lane & 1 == 1,
    };
    Met { hit, p, normal: tile.normals[k].get(lane) }
}

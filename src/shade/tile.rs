//! The light of a tile: what [`super::surface`] does for one ray, for bundles of them.
//!
//! All rays of a tile are traced before any is shaded, and the lit points of the tile ask for one light after the
//! other, so that the rays towards it run side by side. Where a dot needs a ray of its own, to see in a mirror or through
//! glass or to tell two surfaces apart, it goes its way alone.

use crate::math::{BUNDLE, Bundle, Column, Columns, DVec3, Ray};
use crate::solid::{Crossing, Departures, Form};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Fast, Hit, Nearest, Shaft, Shone, TileMemory};

use super::channel::Channel;
use super::lit::{Lit, Surfaces};
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

/// What all points of one side of a primitive have in common.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// [`Form::off`] of the primitive.
    off: f64,
    /// 1 where it answers light, 0 where it does not.
    shines: f64,
    finish: u32,
    normal: Normal,
}

/// How the normals of one side of a primitive are known.
#[derive(Clone, Copy, Debug)]
enum Normal {
    /// Away from a centre, at so great a distance.
    From(DVec3, f64),
    /// The same everywhere.
    Flat(DVec3),
    /// Interpolated.
    Patched,
    /// Another at each point.
    Curved,
}

/// What shading a tile needs, used again for every tile.
#[derive(Debug, Default)]
pub struct TileShading {
    trace: TileMemory,
    nearest: Vec<Nearest>,
    surfaces: Vec<Surfaces>,
    departures: Vec<Departures>,
    shafts: Vec<Shaft>,
    lit: Vec<Lit>,
}

impl Sight {
    /// No rays.
    pub fn clear(&mut self) {
        self.bundles.clear();
        self.ways.clear();
    }

    /// Adds a bundle of rays, and the way to where they start.
    pub fn push(&mut self, bundle: Bundle, way: [Column; 2]) {
        self.bundles.push(bundle);
        self.ways.push(way);
    }
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// What the rays of a tile see; `eye` is where they all start, and `put` is called for each live one with its
    /// bundle and its place in it.
    pub fn tile(
        &self,
        eye: DVec3,
        sight: &Sight,
        tile: &mut TileShading,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
        mut put: impl FnMut(usize, usize, View<C>),
    ) {
        meter.at(Stage::Cell);
        let bundles = &sight.bundles[..];
        let count = bundles.len();
        tile.nearest.resize(count, Nearest::NOTHING);
        self.engine.first_of(bundles, &mut tile.nearest, &mut tile.trace);
        meter.at(Stage::Shade);
        let mut sums = vec![[C::DARK; BUNDLE]; count];
        let hits = self.meet(bundles, tile);
        for lamp in 0..self.lamps.len() {
            self.lamp(lamp, bundles, tile, memory, &mut sums, meter);
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

    /// What all points of one side of a primitive have in common.
    fn side(&self, primitive: u32, surface: u32) -> Side {
        let form = &self.assembly.primitives[primitive as usize].form;
        let finish = self.finish_of(primitive);
        let normal = match form {
            Form::Ball(ball) => Normal::From(ball.center, ball.radius),
            Form::AxisBox(_) | Form::SkewBox(_) | Form::Facets(_) | Form::Mesh(_) | Form::Face(_) => {
                Normal::Flat(form.normal(DVec3::ZERO, surface))
            }
            Form::Patch(_) => Normal::Patched,
            Form::Round(_) | Form::Tube(_) => Normal::Curved,
        };
        let shines = if finish.kd > 0.0 || finish.ks > 0.0 { 1.0 } else { 0.0 };
        Side { off: form.off(), shines, finish: self.assembly.material(primitive).0, normal }
    }

    /// The surfaces that were met: their points, normals and departures. Answers which rays met one.
    fn meet(&self, bundles: &[Bundle], tile: &mut TileShading) -> Vec<u64> {
        let count = bundles.len();
        tile.surfaces.resize(count, Surfaces::NONE);
        tile.departures.resize(count, Departures::NONE);
        let mut hits = Vec::with_capacity(count);
        for (k, bundle) in bundles.iter().enumerate() {
            let surfaces = &mut tile.surfaces[k];
            surfaces.met(bundle, &tile.nearest[k], self.engine.level());
            let (mut balls, mut patches) = (0_u64, 0_u64);
            let departures = &mut tile.departures[k];
            let mut rest = surfaces.hits;
            // Neighbours mostly see the same face.
            let mut last = None;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let (primitive, surface) =
                    (tile.nearest[k].primitive.0[lane], tile.nearest[k].surface.0[lane]);
                let seen = match last {
                    Some((before, seen)) if before == (primitive, surface) => seen,
                    _ => self.side(primitive as u32, surface as u32),
                };
                last = Some(((primitive, surface), seen));
                departures.primitive.0[lane] = primitive;
                departures.off.0[lane] = seen.off;
                surfaces.shines.0[lane] = seen.shines;
                surfaces.finish[lane] = seen.finish;
                match seen.normal {
                    Normal::From(center, radius) => {
                        balls |= 1 << lane;
                        surfaces.normal.set(lane, center);
                        surfaces.radius.0[lane] = radius;
                    }
                    Normal::Flat(normal) => surfaces.normal.set(lane, normal),
                    Normal::Patched => patches |= 1 << lane,
                    Normal::Curved => {
                        let form = &self.assembly.primitives[primitive as usize].form;
                        surfaces.normal.set(lane, form.normal(surfaces.p.get(lane), surface as u32));
                    }
                }
            }
            let inward = surfaces.turn(bundle, balls, self.engine.level());
            tile.departures[k].inward = inward;
            while patches != 0 {
                let lane = patches.trailing_zeros() as usize;
                patches &= patches - 1;
                let (p, nearest) = (surfaces.p.get(lane), &tile.nearest[k]);
                let (primitive, surface) = (nearest.primitive.0[lane] as u32, nearest.surface.0[lane] as u32);
                let normal = self.assembly.turned_normal(primitive, surface, p, bundle.d.get(lane));
                surfaces.normal.set(lane, normal);
                let hit = Hit { t: 0.0, error: 0.0, p, object: 0, primitive, surface, entering: true };
                tile.departures[k].set(lane, &self.departure(&hit, p, normal));
            }
            hits.push(surfaces.hits);
        }
        hits
    }

    /// Adds what one lamp gives.
    fn lamp(
        &self,
        lamp: usize,
        bundles: &[Bundle],
        tile: &mut TileShading,
        memory: &mut Memory<Fast<'e>>,
        sums: &mut [[C; BUNDLE]],
        meter: &mut Meter<impl Probe>,
    ) {
        let count = bundles.len();
        tile.shafts.resize(count, Shaft::EMPTY);
        tile.lit.resize(count, Lit::NONE);
        for (k, bundle) in bundles.iter().enumerate() {
            let shaft = &mut tile.shafts[k];
            tile.lit[k].light(self.lamps[lamp].at, bundle, &tile.surfaces[k], shaft, self.engine.level());
        }
        if self.shadows {
            meter.at(Stage::Cell);
            let shone = Shone { at: self.lamps[lamp].at, clear: &self.clear };
            self.engine.blocked_of(&mut tile.shafts, &tile.departures, &shone, &mut tile.trace);
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
                    if !blocked && (shaft.unsure | shaft.tinted) & bit != 0 {
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
                let finish = &self.finishes[tile.surfaces[k].finish[lane] as usize];
                let (facing, cosine) = (tile.lit[k].facing.0[lane], tile.lit[k].cosine.0[lane]);
                let share = Self::share(finish, facing, cosine) * visible;
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
        self.sending_surface(&sent, met, &change, own, memory, meter)
    }
}

/// A surface that was met, as one ray meets it.
fn met(tile: &TileShading, k: usize, lane: usize, [far, left]: [f64; 2]) -> Met {
    let nearest = &tile.nearest[k];
    let p = tile.surfaces[k].p.get(lane);
    let hit = Hit {
        t: far + (left + nearest.t.0[lane]),
        error: 0.0,
        p,
        object: nearest.object.0[lane] as u32,
        primitive: nearest.primitive.0[lane] as u32,
        surface: nearest.surface.0[lane] as u32,
        entering: nearest.entering >> lane & 1 == 1,
    };
    Met { hit, p, normal: tile.surfaces[k].normal.get(lane) }
}

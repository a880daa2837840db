//! The rays that the surfaces of one generation send on, and the light that arrives along them.

use crate::math::{DVec3, LaneVector, Ray, RayIndex, places};
use crate::solid::{Departure, WorldShape};
use crate::stage::{Meter, Probe};
use crate::trace::Fast;

use super::channel::Channel;
use super::lit::add_everywhere;
use super::media::{Media, MediumStack, OUTSIDE};
use super::path::{PathState, ScatteredRays};
use super::surface::{Memory, ResolvedMaterial, Shader, SurfaceInteraction};
use super::tile::TileShading;
use super::wavefront::{Arrival, QueuedRay, RayQueue, Wavefront};

/// So few rays that are sent on take less time one by one than a packet of them does.
const FEW_QUEUED: usize = 6;

/// The most rays that a generation is let grow to, 16 times as many as a tile has dots: at each glass surface there may be
/// two for one. Those past it go alone.
const MOST_QUEUED: usize = 16 * 1024;

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// Sends the rays on that a generation's surfaces send. Answers whether there is another generation; the light of few
    /// rays arrives at once.
    pub(super) fn send(
        &self,
        generation: usize,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        if tile.waves.len() == generation + 1 {
            tile.waves.push(Wavefront::new(generation as u32 + 1));
        }
        let (before, behind) = tile.waves.split_at_mut(generation + 1);
        let (wave, next) = (&mut before[generation], &mut behind[0]);
        next.clear_legs();
        let followed = wave.generation < self.generations;
        for k in 0..wave.rays.len() {
            // Where a mirror ray is not followed, nobody asks for its direction.
            let unfollowed = |finish: &ResolvedMaterial<C>| !followed && finish.kr > 0.0 && finish.kt == 0.0;
            let Wavefront { surfaces, light, .. } = &mut *wave;
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
            let sends =
                |finish: &ResolvedMaterial<C>| (finish.kr > 0.0 || finish.kt > 0.0) && !unfollowed(finish);
            let senders = self.made_so(&wave.surfaces[k], sends);
            for at in places(k, senders) {
                if next.legs() < MOST_QUEUED {
                    self.send_on(wave, at, next, &mut memory.media, meter);
                } else {
                    self.send_alone(wave, at, memory, meter);
                }
            }
        }
        if next.legs() > FEW_QUEUED {
            return true;
        }
        for RayQueue { rays, arrivals, .. } in &next.kinds {
            for arrival in arrivals {
                let light = match arrival.leg {
                    None => self.ambient,
                    Some(leg) => {
                        let QueuedRay { sent, departure } = &rays[leg as usize];
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
        wave: &mut Wavefront<C>,
        at: RayIndex,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        let met = wave.met(at);
        let (weight, inside) = wave.standing(at);
        let inside = inside.clone();
        let together = [(met.hit.object, met.hit.crossing())];
        let change = self.change_at(&inside, &together, &mut memory.media);
        // The whole way is counted as that of this ray.
        let ray = wave.rays[at.packet].ray(at.lane);
        let sent = PathState { ray, travelled: 0.0, weight, generation: wave.generation, inside };
        let light = self.sending_surface(&sent, &met, &change, wave.light(at), memory, meter);
        wave.set_light(at, light);
    }

    /// Sends on what one surface does.
    fn send_on(
        &self,
        wave: &Wavefront<C>,
        at: RayIndex,
        next: &mut Wavefront<C>,
        media: &mut Media,
        meter: &mut Meter<impl Probe>,
    ) {
        let SurfaceInteraction { hit, p, normal } = wave.met(at);
        let finish = self.finish(&hit);
        let (weight, inside) = wave.standing(at);
        let change =
            (finish.kt > 0.0).then(|| self.change_at(inside, &[(hit.object, hit.crossing())], media));
        let (before, behind) = change.as_ref().map_or((OUTSIDE, OUTSIDE), |c| (c.before, c.behind));
        let onward = ScatteredRays::new(wave.rays[at.packet].d.get(at.lane), normal, finish, before, behind);
        let back = wave.departure(at);
        let through = || match self.assembly.primitives[hit.primitive as usize].form {
            WorldShape::Patch(_) => self.departure(&hit, p, -normal),
            _ => Departure { inward: !back.inward, ..back },
        };
        let [mirrors, snells] = &mut next.kinds;
        let generation = wave.generation + 1;
        let mut send =
            |kind: &mut RayQueue, d: DVec3, share: f64, departure: Departure, inside: MediumStack| {
                let RayQueue { rays, arrivals, .. } = kind;
                let weight = weight * share;
                if generation > self.generations || weight < self.least_weight {
                    meter.counts.truncated_rays += 1;
                    arrivals.push(Arrival { at, share, leg: None });
                } else {
                    arrivals.push(Arrival { at, share, leg: Some(rays.len() as u32) });
                    let sent =
                        PathState { ray: Ray::new(p, d), travelled: hit.t, weight, generation, inside };
                    rays.push(QueuedRay { sent, departure });
                }
            };
        if let Some((d, share)) = onward.mirror {
            send(mirrors, d, share, back, inside.clone());
        }
        if let Some((d, share)) = onward.snell {
            let beyond = change.map_or_else(|| inside.clone(), |change| change.list);
            send(snells, d, share, through(), beyond);
        }
    }

    /// The light of a generation arrives at the one before it.
    pub(super) fn arrive(&self, generation: usize, tile: &mut TileShading<C>) {
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

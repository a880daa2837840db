//! The rays that the surfaces of one generation send on, and the light that arrives along them.

use crate::math::{LaneVector, Ray, RayIndex, lanes, places};
use crate::shade::{
    Channel, Media, MediumStack, OUTSIDE, ResolvedMaterial, Scattered, ScatteredRays, SurfaceInteraction,
    add_everywhere,
};
use crate::solid::{Departure, WorldShape};
use crate::stage::{Meter, Probe};
use crate::trace::RayMemory;

use super::history::History;
use super::path_state::PathState;
use super::ray_integrator::PathMemory;
use super::wavefront::{Arrival, QueuedRay, RayQueue, Wavefront};
use super::wavefront_integrator::WavefrontIntegrator;
use super::wavefront_scratch::{WavefrontMemory, WavefrontScratch};

/// Up to so many scattered rays are traced one by one, which takes less time than a packet of them.
const FEW_QUEUED: usize = 6;

/// The most rays that a generation is let grow to, 16 times as many as a tile has dots: at each glass surface
/// there may be two for one. Those past it are followed singly.
const MOST_QUEUED: usize = 16 * 1024;

impl<C: Channel> WavefrontIntegrator<'_, C> {
    /// Sends the rays on that a generation's surfaces send. Answers whether there is another generation; the
    /// light of few rays arrives at once.
    pub(super) fn scatter(
        &self,
        generation: usize,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        let WavefrontMemory { single, tile } = memory;
        if tile.waves.len() == generation + 1 {
            tile.waves.push(Wavefront::new(generation as u32 + 1));
        }
        let (before, behind) = tile.waves.split_at_mut(generation + 1);
        let (wave, next) = (&mut before[generation], &mut behind[0]);
        next.clear_queues();
        let followed = wave.generation < self.single.generations;
        // The direction of a mirror ray that is not followed is not needed.
        let unfollowed =
            |material: &ResolvedMaterial<C>| !followed && material.kr > 0.0 && material.kt == 0.0;
        for k in 0..wave.rays.len() {
            let Wavefront { surfaces, light, histories, .. } = &mut *wave;
            for &(material, sent) in &surfaces[k].materials {
                let material = &self.illumination().materials[material as usize];
                if unfollowed(material) {
                    let arriving = self.illumination().ambient * material.kr;
                    let light = &mut light[k * C::PARTS..][..C::PARTS];
                    add_everywhere(arriving, sent, light, self.engine.level());
                    if let Some(histories) = histories.get_mut(k) {
                        for lane in lanes(sent) {
                            histories[lane] = histories[lane].sent_on(History::TRUNCATED);
                        }
                    }
                    meter.counts.truncated_rays += u64::from(sent.count_ones());
                }
            }
            let scatters = |material: &ResolvedMaterial<C>| material.scatters() && !unfollowed(material);
            let senders = self.made_of(&wave.surfaces[k], scatters);
            for at in places(k, senders) {
                if next.queued() < MOST_QUEUED {
                    self.queue_scattered(wave, at, next, &mut single.media, meter);
                } else {
                    self.follow_scattered(wave, at, single, meter);
                }
            }
        }
        if next.queued() > FEW_QUEUED {
            return true;
        }
        for RayQueue { rays, arrivals, .. } in &next.queues {
            for arrival in arrivals {
                let light = match arrival.ray {
                    None => {
                        single.history = History::TRUNCATED;
                        self.illumination().ambient
                    }
                    Some(ray) => {
                        let QueuedRay { sent, departure } = &rays[ray as usize];
                        self.single.arriving(sent, *departure, single, meter)
                    }
                };
                wave.add(arrival, light);
                wave.change_history(arrival.at, |history| history.sent_on(single.history));
            }
        }
        false
    }

    /// Finds the light of one surface with all that it sends on, ray by ray.
    fn follow_scattered(
        &self,
        wave: &mut Wavefront<C>,
        at: RayIndex,
        memory: &mut PathMemory<RayMemory>,
        meter: &mut Meter<impl Probe>,
    ) {
        let met = wave.met(at);
        let (weight, inside) = wave.weight_and_media(at);
        let inside = inside.clone();
        let together = [(met.hit.object, met.hit.crossing())];
        let transition = self.single.transition_at(&inside, &together, &mut memory.media);
        // The distance of the hit is that from the eye already.
        let ray = wave.rays[at.packet].ray(at.lane);
        let sent = PathState { ray, travelled: 0.0, weight, generation: wave.generation, inside };
        wave.change_history(at, |history| {
            memory.history = history;
            history
        });
        let light = self.single.scattered_light(&sent, &met, &transition, wave.light(at), memory, meter);
        wave.set_light(at, light);
        wave.change_history(at, |_| memory.history);
    }

    /// Puts the rays that one surface sends on into the queues of the next generation.
    fn queue_scattered(
        &self,
        wave: &Wavefront<C>,
        at: RayIndex,
        next: &mut Wavefront<C>,
        media: &mut Media,
        meter: &mut Meter<impl Probe>,
    ) {
        let met = wave.met(at);
        let SurfaceInteraction { hit, p, normal } = met;
        let material = self.illumination().material_at(&met);
        let (weight, inside) = wave.weight_and_media(at);
        let transition = (material.kt > 0.0)
            .then(|| self.single.transition_at(inside, &[(hit.object, hit.crossing())], media));
        let (before, behind) = transition.as_ref().map_or((OUTSIDE, OUTSIDE), |t| (t.before, t.behind));
        let d = wave.rays[at.packet].d.get(at.lane);
        let rays = ScatteredRays::new(d, normal, material, before, behind);
        let back = wave.departure(at);
        let through = || match self.illumination().assembly.primitives[hit.primitive as usize].form {
            WorldShape::Patch(_) => self.illumination().departure(&hit, p, -normal),
            _ => Departure { inward: !back.inward, ..back },
        };
        let [mirrors, snells] = &mut next.queues;
        let generation = wave.generation + 1;
        let mut send =
            |queue: &mut RayQueue, onward: Scattered, departure: Departure, inside: MediumStack| {
                let RayQueue { rays, arrivals, .. } = queue;
                let Scattered { d, share } = onward;
                let weight = weight * share;
                if self.single.is_followed(generation, weight) {
                    arrivals.push(Arrival { at, share, ray: Some(rays.len() as u32) });
                    let sent =
                        PathState { ray: Ray::new(p, d), travelled: hit.t, weight, generation, inside };
                    rays.push(QueuedRay { sent, departure });
                } else {
                    meter.counts.truncated_rays += 1;
                    arrivals.push(Arrival { at, share, ray: None });
                }
            };
        if let Some(mirror) = rays.mirror {
            send(mirrors, mirror, back, inside.clone());
        }
        if let Some(snell) = rays.snell {
            let beyond = transition.map_or_else(|| inside.clone(), |transition| transition.list);
            send(snells, snell, through(), beyond);
        }
    }

    /// Adds the light of a generation to that of the one before it.
    pub(super) fn arrive(&self, generation: usize, tile: &mut WavefrontScratch<C>) {
        let (before, behind) = tile.waves.split_at_mut(generation);
        let (wave, next) = (&mut before[generation - 1], &behind[0]);
        for queue in &next.queues {
            for arrival in &queue.arrivals {
                let (light, history) = match arrival.ray {
                    None => (self.illumination().ambient, History::TRUNCATED),
                    Some(ray) => {
                        let at = queue.place(ray as usize);
                        (next.light(at), next.history_or_miss(at))
                    }
                };
                wave.add(arrival, light);
                wave.change_history(arrival.at, |before| before.sent_on(history));
            }
        }
    }
}

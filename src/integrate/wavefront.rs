//! One generation of a tile's rays: those from the eye, or the mirror and Snell rays that the generation
//! before it sends on.

use std::ops::Range;

use fearless_simd::Level;

use crate::math::{LANES, LaneVector, Lanes, PACKET, RayIndex, RayPacket, dispatch, lanes};
use crate::shade::{Channel, MediumStack, SurfaceInteraction, Surfaces};
use crate::solid::{Departure, Departures};
use crate::trace::{Hit, PacketHits};

use super::history::History;
use super::path_state::PathState;

/// A ray that is sent on.
#[derive(Clone, Debug)]
pub(super) struct QueuedRay {
    pub sent: PathState,
    pub departure: Departure,
}

/// What arrives along a ray that a surface sends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    /// The ray of the generation before that met the surface.
    pub at: RayIndex,
    /// The share of the light that the surface sends back.
    pub share: f64,
    /// The ray, by its number in its queue; `None` for one that is not followed.
    pub ray: Option<u32>,
}

/// Mirror rays, or Snell rays.
#[derive(Debug, Default)]
pub(super) struct RayQueue {
    pub rays: Vec<QueuedRay>,
    pub arrivals: Vec<Arrival>,
    /// The number of their first packet.
    first: usize,
}

/// The rays of one generation, and what they met.
#[derive(Debug)]
pub(super) struct Wavefront<C> {
    /// 0 for rays from the eye.
    pub generation: u32,
    /// The glass that rays from the eye start in.
    pub inside: MediumStack,
    pub rays: Vec<RayPacket>,
    /// The path length from the eye to where each ray starts, in two parts that are to be added to a
    /// distance, the second first.
    pub before: Vec<[Lanes; 2]>,
    /// The surfaces that the rays leave; of no meaning for rays from the eye.
    pub from: Vec<Departures>,
    pub nearest: Vec<PacketHits>,
    pub surfaces: Vec<Surfaces>,
    /// The surfaces that were met, for rays that leave them to the sides that these came from.
    pub departures: Vec<Departures>,
    /// The light that arrives along each ray, whole as soon as that is known: a column for each part, packet
    /// by packet.
    pub light: Vec<Lanes>,
    /// The histories of the rays that met anything, where they are kept.
    pub histories: Vec<[History; PACKET]>,
    /// The rays that met several surfaces in one place, a bit for each: their surface is known already, and
    /// its light, where light is asked for.
    pub resolved_singly: Vec<u64>,
    /// The mirror rays of this generation, and its Snell rays; none in the first.
    pub queues: [RayQueue; 2],
    /// Whether its rays are so incoherent that those towards the lamps are better traced as a stream.
    pub incoherent: bool,
    parts: std::marker::PhantomData<C>,
}

impl RayQueue {
    /// Their packets.
    #[inline]
    pub fn packets(&self) -> Range<usize> {
        self.first..self.first + self.rays.len().div_ceil(PACKET)
    }

    /// The place of a queued ray.
    #[inline]
    pub fn place(&self, ray: usize) -> RayIndex {
        RayIndex { packet: self.first + ray / PACKET, lane: ray % PACKET }
    }
}

impl<C> Wavefront<C> {
    /// Returns a generation of no rays yet.
    pub fn new(generation: u32) -> Self {
        Self {
            generation,
            inside: 0..0,
            rays: Vec::new(),
            before: Vec::new(),
            from: Vec::new(),
            nearest: Vec::new(),
            surfaces: Vec::new(),
            departures: Vec::new(),
            light: Vec::new(),
            histories: Vec::new(),
            resolved_singly: Vec::new(),
            queues: Default::default(),
            incoherent: false,
            parts: std::marker::PhantomData,
        }
    }
}

impl<C: Channel> Wavefront<C> {
    /// Makes room for what its packets meet, at least as much.
    pub fn make_room(&mut self) {
        let count = self.rays.len();
        if self.nearest.len() < count {
            self.nearest.resize(count, PacketHits::NOTHING);
            self.surfaces.resize(count, Surfaces::NONE);
            self.departures.resize(count, Departures::NONE);
            self.light.resize(count * C::PARTS, Lanes::filled(0.0));
        }
        self.incoherent = false;
        self.resolved_singly.clear();
        self.resolved_singly.resize(count, 0);
    }

    /// Forgets the rays that were sent on to it.
    #[inline]
    pub fn clear_queues(&mut self) {
        for queue in &mut self.queues {
            queue.rays.clear();
            queue.arrivals.clear();
        }
    }

    /// Counts the rays that were sent on to it.
    #[inline]
    pub fn queued(&self) -> usize {
        self.queues.iter().map(|queue| queue.rays.len()).sum()
    }

    /// Puts the rays that were sent on into packets, each kind into its own.
    pub fn pack_queues(&mut self, level: Level) {
        let mut k = 0;
        for queue in &mut self.queues {
            queue.first = k;
            k = queue.packets().end;
        }
        self.rays.resize(k, RayPacket::EMPTY);
        if self.from.len() < k {
            self.before.resize(k, [Lanes::filled(0.0); 2]);
            self.from.resize(k, Departures::NONE);
        }
        for queue in &self.queues {
            for (k, queued) in queue.packets().zip(queue.rays.chunks(PACKET)) {
                let (packet, [before, _], from) = (&mut self.rays[k], &mut self.before[k], &mut self.from[k]);
                packet.live = 0;
                for (lane, ray) in queued.iter().enumerate() {
                    packet.set(lane, &ray.sent.ray);
                    before.0[lane] = ray.sent.travelled;
                    from.set(lane, &ray.departure);
                }
                dispatch!(level, simd => packet.close(simd));
            }
        }
    }

    /// Returns the light of a packet, a column for each part.
    #[inline]
    pub fn light_mut(&mut self, packet: usize) -> &mut [Lanes] {
        &mut self.light[packet * C::PARTS..][..C::PARTS]
    }

    /// The light that arrives along one ray.
    #[inline]
    pub fn light(&self, at: RayIndex) -> C {
        let mut parts = [0.0; 3];
        for (part, column) in self.light[at.packet * C::PARTS..][..C::PARTS].iter().enumerate() {
            parts[part] = column.0[at.lane];
        }
        C::from_parts(parts)
    }

    /// The light that arrives along the rays of a row.
    #[inline]
    pub fn row_of_light(&self, packet: usize, row: usize) -> [C; LANES] {
        C::of_register(&self.light[packet * C::PARTS..][..C::PARTS], row)
    }

    /// Sets the light that arrives along one ray.
    #[inline]
    pub fn set_light(&mut self, at: RayIndex, light: C) {
        for (part, column) in self.light_mut(at.packet).iter_mut().enumerate() {
            column.0[at.lane] = light.part(part);
        }
    }

    /// Adds the light that arrives along a ray which was sent on.
    #[inline]
    pub fn add(&mut self, arrival: &Arrival, light: C) {
        let sum = (self.light(arrival.at) + light * arrival.share).limited();
        self.set_light(arrival.at, sum);
    }

    /// The share of one ray's light that reaches the eye, and the glass that it starts in.
    #[inline]
    pub fn weight_and_media(&self, at: RayIndex) -> (f64, &MediumStack) {
        self.queued_ray(at).map_or((1.0, &self.inside), |QueuedRay { sent, .. }| (sent.weight, &sent.inside))
    }

    /// The ray as it was sent on; none from the eye.
    #[inline]
    fn queued_ray(&self, at: RayIndex) -> Option<&QueuedRay> {
        let [mirror, snell] = &self.queues;
        let queue = if at.packet < snell.first { mirror } else { snell };
        queue.rays.get((at.packet - queue.first) * PACKET + at.lane)
    }

    /// The surface that one ray met, for a ray that leaves it to the side that the other came from.
    #[inline]
    pub fn departure(&self, at: RayIndex) -> Departure {
        let surface = self.nearest[at.packet].surface.0[at.lane];
        Departure { surface, ..self.departures[at.packet].get(at.lane) }
    }

    /// The history of any ray; that of a miss where histories are not kept.
    #[inline]
    pub fn history_or_miss(&self, at: RayIndex) -> History {
        let met = self.found(at.packet) >> at.lane & 1 == 1;
        self.histories.get(at.packet).filter(|_| met).map_or(History::MISS, |packet| packet[at.lane])
    }

    /// Changes the history of one ray, where histories are kept.
    #[inline]
    pub fn change_history(&mut self, at: RayIndex, change: impl FnOnce(History) -> History) {
        if let Some(histories) = self.histories.get_mut(at.packet) {
            histories[at.lane] = change(histories[at.lane]);
        }
    }

    /// Makes room for the histories of its rays, or for none.
    pub fn keep_histories(&mut self, kept: bool) {
        self.histories.resize(if kept { self.rays.len() } else { 0 }, [History::MISS; PACKET]);
    }

    /// Begins the history of the rays of packet `k` that met a surface which is not lit yet.
    pub fn begin_histories(&mut self, k: usize) {
        let Some(histories) = self.histories.get_mut(k) else { return };
        let nearest = &self.nearest[k];
        for lane in lanes(self.surfaces[k].hits) {
            histories[lane] =
                History::hit(nearest.object.0[lane], nearest.primitive.0[lane], nearest.surface.0[lane]);
        }
    }

    /// Which rays of a packet met something, a bit for each.
    #[inline]
    pub fn found(&self, packet: usize) -> u64 {
        self.surfaces[packet].hits | self.resolved_singly[packet]
    }

    /// What one ray met; the distance is that from the eye.
    #[inline]
    pub fn met(&self, at: RayIndex) -> SurfaceInteraction {
        let RayIndex { packet, lane } = at;
        let (nearest, surfaces) = (&self.nearest[packet], &self.surfaces[packet]);
        let p = surfaces.p.get(lane);
        let hit = Hit {
            t: surfaces.path_length.0[lane],
            error: 0.0,
            p,
            object: nearest.object.0[lane],
            primitive: nearest.primitive.0[lane],
            surface: nearest.surface.0[lane],
            entering: nearest.entering >> lane & 1 == 1,
        };
        SurfaceInteraction { hit, p, normal: surfaces.normal.get(lane) }
    }
}

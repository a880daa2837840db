//! The fast engine's answers: rays in packets, and those that are uncertain one by one.

use fearless_simd::dispatch;
use ray13::frame::Frame;
use ray13::math::{DVec3, Lanes, PACKET, Ray, RayPacket, Size};
use ray13::plan::{EngineChoice, Options, PrecisionChoice};
use ray13::scene::{Camera, Primitive, Scene};
use ray13::solid::{Departure, Departures};
use ray13::stage::{Meter, Silent};
use ray13::trace::{Fast, Hit, PacketHits, RayEngine, ShadowPacket, ShadowQuery, TileMemory};

use crate::conformance::engine::{Cut, ExactEngine, Found, Range, Start, Subject, drawn};

/// Rays of a packet here: one less than it can hold, since a whole one is taken for a block of dots, whose
/// corners bound the rest.
const RAYS: usize = PACKET - 1;

/// Packets of a tile.
const PACKETS: usize = 16;

/// The fast engine, whatever the cut: it has boxes of its own.
#[derive(Debug)]
pub struct FastEngine(ExactEngine);

impl FastEngine {
    fn engine(&self) -> Fast<'_> {
        Fast::new(&self.0.assembly, &self.0.boxes, &self.0.subs)
    }

    /// The answers for as many rays as a tile has, all of which leave a surface, or none.
    fn first_of_tile(&self, rays: &[(Ray, Option<Departure>)], tile: &mut TileMemory) -> Vec<Option<Found>> {
        let engine = self.engine();
        let (mut memory, mut meter) = (engine.exact().memory(), Meter::new(Silent));
        let (mut packets, mut from) = (Vec::new(), Vec::new());
        for part in rays.chunks(RAYS) {
            let (mut packet, mut departures) = (RayPacket::EMPTY, Departures::NONE);
            for (lane, (ray, departure)) in part.iter().enumerate() {
                packet.set(lane, ray);
                if let Some(departure) = departure {
                    departures.set(lane, departure);
                }
            }
            dispatch!(engine.level(), simd => packet.close(simd));
            packets.push(packet);
            from.push(departures);
        }
        let leave = rays.iter().all(|(_, departure)| departure.is_some());
        let mut ways = vec![[Lanes::filled(0.0); 2]; packets.len()];
        if !leave {
            for (packet, way) in packets.iter_mut().zip(&mut ways) {
                engine.approach(packet, way);
            }
        }
        let mut nearest = vec![PacketHits::NOTHING; packets.len()];
        let from = leave.then_some(&from[..]);
        engine.first_of(&packets, from, &mut nearest, tile);
        engine.first_of_incoherent(&packets, from, &mut nearest, tile);
        let mut answer = |(place, (ray, departure)): (usize, &(Ray, Option<Departure>))| {
            let (k, lane) = (place / RAYS, place % RAYS);
            // What the exact engine says of its error holds for the same bits.
            let alone = match departure {
                None => engine.exact().first(ray, &mut memory, &mut meter),
                Some(departure) => engine.exact().next(ray, *departure, &mut memory, &mut meter),
            };
            let met = &nearest[k];
            if met.uncertain >> lane & 1 == 1 {
                return alone;
            }
            let (t, [far, left]) = (met.t.0[lane], &ways[k]);
            t.is_finite().then(|| Hit {
                t: far.0[lane] + (left.0[lane] + t),
                error: alone.map_or(0.0, |hit| hit.error),
                p: packets[k].ray(lane).at(t),
                object: met.object.0[lane],
                primitive: met.primitive.0[lane],
                surface: met.surface.0[lane],
                entering: met.entering >> lane & 1 == 1,
            })
        };
        rays.iter().enumerate().map(|ray| answer(ray).map(|hit| self.0.found(hit))).collect()
    }

    fn first_of(&self, rays: &[(Ray, Option<Departure>)]) -> Vec<Option<Found>> {
        let mut tile = TileMemory::default();
        rays.chunks(RAYS * PACKETS).flat_map(|rays| self.first_of_tile(rays, &mut tile)).collect()
    }
}

impl Subject for FastEngine {
    /// That of the exact engine, which it asks where it is uncertain.
    const RANGE: Range = ExactEngine::RANGE;

    /// It goes through boxes whatever it is told.
    const CUTS: &'static [Cut] = &[Cut::Boxes];

    fn new(scene: &Scene, cut: Cut) -> Self {
        Self(ExactEngine::new(scene, cut))
    }

    fn first(&self, rays: &[Ray]) -> Vec<Option<Found>> {
        let rays: Vec<_> = rays.iter().map(|ray| (self.0.assembly.ray(ray), None)).collect();
        self.first_of(&rays)
    }

    fn next(&self, starts: &[Start]) -> Vec<Option<Found>> {
        let rays = starts.iter().map(|start| {
            let (ray, departure) = self.0.leaving(start);
            (ray, Some(departure))
        });
        self.first_of(&rays.collect::<Vec<_>>())
    }

    /// Each towards a light of its own.
    fn blocked(&self, starts: &[(Start, f64)]) -> Vec<bool> {
        let engine = self.engine();
        let (mut memory, mut meter) = (engine.exact().memory(), Meter::new(Silent));
        let mut tile = TileMemory::default();
        let mut blocked = |start: &Start, distance: f64| {
            let (ray, departure) = self.0.leaving(start);
            let distance = distance / self.0.assembly.scene_frame.unit;
            let mut shadow_packet = ShadowPacket::EMPTY;
            shadow_packet.rays.set(0, &ray);
            shadow_packet.distance.0[0] = distance;
            dispatch!(engine.level(), simd => shadow_packet.close(simd));
            let mut departures = Departures::NONE;
            departures.set(0, &departure);
            let mut shadow_packets = [shadow_packet];
            let lamp = ShadowQuery { at: ray.at(distance), opacity: &[], dark: &[], lets_through: &[] };
            engine.blocked_of(&mut shadow_packets, &[departures], &lamp, &mut tile);
            if shadow_packets[0].uncertain & 1 == 1 {
                return engine.exact().blocked(&ray, departure, distance, &mut memory, &mut meter);
            }
            shadow_packets[0].blocked & 1 == 1
        };
        starts.iter().map(|(start, distance)| blocked(start, *distance)).collect()
    }

    fn inward(&self, start: &Start) -> bool {
        self.0.inward(start)
    }

    fn rim(&self, primitive: &Primitive, ray: &Ray) -> DVec3 {
        self.0.rim(primitive, ray)
    }

    fn draw(scene: &Scene, camera: &Camera, dots: Size, _: Cut) -> Frame {
        drawn(
            scene,
            camera,
            dots,
            Options { engine: EngineChoice::Fast, precision: PrecisionChoice::Double, ..Options::default() },
        )
    }
}

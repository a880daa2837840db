//! The rays of a tile: those that surfaces scatter are there, those from the eye are made where they may meet
//! anything.

use fearless_simd::{Level, Simd};

use crate::lattice::{Basis, FRUSTA, Frustum, FrustumSoa, Spread};
use crate::math::{LaneVector, Lanes, RayPacket, Real, RealIds, SimdIds, SimdReal};
use crate::solid::{Departures, RayStarts};
use crate::stage::{Probe, Stage};

use super::super::exact::most_moved;
use super::packet_hits::PacketHits;
use super::primary_packets::PrimaryPackets;

/// A packet, and the surfaces that its rays leave: none from the eye. In the precision in which it is traced,
/// and in double.
#[derive(Clone, Copy)]
pub(super) struct PacketSource<'a, T = f64> {
    pub rays: &'a RayPacket<T>,
    pub departures: Option<&'a Departures<T>>,
    pub full_rays: &'a RayPacket,
    pub full_departures: Option<&'a Departures>,
}

impl<'a> PacketSource<'a> {
    /// One in double precision.
    pub fn new(rays: &'a RayPacket, departures: Option<&'a Departures>) -> Self {
        Self { rays, departures, full_rays: rays, full_departures: departures }
    }
}

impl<'a, T: Real> PacketSource<'a, T> {
    /// The same in double precision.
    pub fn full(&self) -> PacketSource<'a> {
        PacketSource::new(self.full_rays, self.full_departures)
    }

    /// Which rays leave a primitive to the outside, a bit for each: what is convex, or a surface, they do not
    /// meet again.
    #[inline]
    pub fn leaving<S: Simd>(&self, simd: S, primitive: u32) -> u64 {
        self.departures.map_or(0, |departures| departures.leaving(simd, primitive))
    }

    /// The surfaces that the rays of a register start on, as seen from a primitive.
    #[inline(always)]
    pub fn starts<S: Simd>(&self, simd: S, register: usize, primitive: u32) -> RayStarts<T::SimdReal<S>> {
        let no = T::mask_of(simd, 0, register);
        let Some(departures) = self.departures else {
            return RayStarts { here: no, inward: no, place_error: None };
        };
        let primitive = RealIds::<T, S>::all(simd, primitive);
        RayStarts {
            here: T::SimdReal::<S>::answers(
                simd,
                departures.primitive.ids::<T, S>(simd, register).equal_bits(primitive),
            ),
            inward: T::mask_of(simd, departures.inward, register),
            place_error: Some(departures.place_error.load(simd, register)),
        }
    }
}

/// The packets of a tile, up to [`FRUSTA`] of them.
pub(super) enum PacketSources<'a, 'b> {
    /// Packets that are [closed](RayPacket::close), and the surfaces that the rays of each leave.
    Made { packets: &'a [RayPacket], departures: Option<&'a [Departures]> },
    /// The blocks of a tile, whose rays are still to be made. `probe` is told when they are.
    Primary { packets: &'a mut PrimaryPackets<'b>, level: Level, probe: &'a mut dyn Probe },
}

/// The packets of a tile in the precision in which they are traced, and what they meet.
pub(super) struct TracedPackets<'a, T> {
    /// Their rays, where those are not the tile's own ([`super::precision::Precision::take`]).
    pub own: &'a mut [RayPacket<T>],
    /// What they meet: as many as there are packets.
    pub nearest: &'a mut [PacketHits<T>],
}

/// What became of the packets of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct TracedTile {
    /// Those that may have met anything, a bit for each. Of the others, if they are still to be made, it is
    /// only known that none of their rays is uncertain or incoherent.
    pub touched: u16,
    /// How many were given up as incoherent.
    pub given_up: usize,
}

impl PacketSources<'_, '_> {
    /// Whether a packet has no live ray. Those that are still to be made have some.
    pub fn is_blind(&self, k: usize) -> bool {
        matches!(self, Self::Made { packets, .. } if packets[k].live == 0)
    }

    /// Makes the rays of a packet, if that is to be done late.
    pub fn make(&mut self, k: usize) {
        if let Self::Primary { packets, level, probe } = self {
            probe.at(Stage::Ray);
            packets.make(k, *level);
            probe.at(Stage::Cell);
        }
    }

    /// One of them, which was made.
    #[inline(always)]
    pub fn get(&self, k: usize) -> PacketSource<'_> {
        match self {
            Self::Made { packets, departures } => {
                PacketSource::new(&packets[k], departures.map(|all| &all[k]))
            }
            Self::Primary { packets, .. } => PacketSource::new(&packets.rays[k], None),
        }
    }

    /// The frustum around them all.
    #[inline(always)]
    pub fn whole<S: Simd>(&self, simd: S) -> Frustum {
        match self {
            Self::Made { packets, .. } => around(simd, packets),
            Self::Primary { packets: PrimaryPackets { camera, .. }, .. } => {
                let ends = camera.ends();
                Frustum::between(camera.eye, ends, most_moved(camera.eye, &ends), &Basis::of_corners(ends))
            }
        }
    }

    /// Sets `frusta` to the frustums of each.
    #[inline(always)]
    pub fn spread<S: Simd>(
        &self,
        simd: S,
        level: Level,
        frustums: &mut Vec<Option<Frustum>>,
        frusta: &mut FrustumSoa,
    ) {
        frustums.clear();
        match self {
            Self::Made { packets, .. } => {
                // Not by `map`, whose closure is compiled by itself, for any processor.
                for packet in *packets {
                    frustums.push(Some(around(simd, std::slice::from_ref(packet))));
                }
            }
            Self::Primary { packets: PrimaryPackets { camera, .. }, .. } => {
                // The sides of all blocks run along those of the tile.
                let ends = camera.ends();
                let basis = Basis::of_corners(ends);
                // Rays of one tile differ little in how far they are moved.
                let moved = most_moved(camera.eye, &ends);
                let mut corners = [Lanes::filled(0.0); 3];
                camera.corners(level, &mut corners);
                for k in 0..camera.packets().min(FRUSTA) {
                    let ends = [0, 1, 2, 3].map(|corner| corners.get(4 * k + corner));
                    frustums.push(Some(Frustum::between(camera.eye, ends, moved, &basis)));
                }
            }
        }
        frusta.set(simd, frustums);
    }
}

/// The frustum around rays of any kind.
#[inline(always)]
fn around<S: Simd>(simd: S, packets: &[RayPacket]) -> Frustum {
    Frustum::around(simd, packets.iter().map(|packet| (packet, None)), Spread::Diverging)
}

#[cfg(test)]
mod tests {
    use fearless_simd::{SimdBase, f32x8};
    use proptest::prelude::*;

    use super::super::super::exact::all_moved_nearer;
    use super::*;
    use crate::math::{DVec3, REGISTERS, Size, dispatch, lanes};
    use crate::scene::{Camera, FieldSpan};
    use crate::stage::Silent;
    use crate::view::{Picture, PinholeCamera, TileCamera, TileRays, tiles};

    fn direction() -> impl Strategy<Value = DVec3> {
        let coordinate = || prop_oneof![-1.0..1.0_f64, (-1..=1_i8).prop_map(f64::from)];
        (coordinate(), coordinate(), coordinate())
            .prop_map(|(x, y, z)| DVec3::new(x, y, z).normalize_or(DVec3::X))
    }

    proptest! {
        #[test]
        fn what_a_ray_from_the_eye_meets_its_frustums_meet_no_farther(
            (from, look, up) in (direction(), direction(), direction()),
            // The eye in the world, near it, or far away, with a field as wide as that, or any.
            (exponent, wide_exponent) in (-1.0..9.0_f64, -1.0..1.0_f64),
            any_field in prop_oneof![Just(None), (0.01..179.0_f64).prop_map(Some)],
            (width, height) in (1..80_u32, 1..80_u32),
            off in (-0.5..0.5_f64, -0.5..0.5_f64),
            pick in 0..64_usize,
        ) {
            let distance = libm::pow(10.0, exponent);
            let eye = from * distance;
            let narrow = 2.0 * libm::atan(libm::pow(10.0, wide_exponent) / distance).to_degrees();
            let field = any_field.unwrap_or(narrow).min(179.0);
            let camera = Camera {
                name: None, eye, target: look * 0.3, up, field: [field; 2], span: FieldSpan::Edges, zoom: 1.0,
            };
            prop_assume!(eye.distance(camera.target) > 1e-3);
            let pinhole = PinholeCamera::new(&camera, &Picture { dots: Size::new(width, height), dot_aspect: 1.0 });
            let all = tiles(Size::new(width, height));
            let tile = all[pick % all.len()];
            let sight = TileCamera {
                pinhole: &pinhole,
                tile,
                rays: TileRays::EachDot([off.0, off.1]),
                eye,
                longest_path: distance + 4.0,
            };
            let mut packets = vec![RayPacket::EMPTY; sight.packets()];
            let level = Level::new();
            for (k, packet) in packets.iter_mut().enumerate() {
                sight.rays(k, level, packet);
                dispatch!(level, simd => for register in 0..REGISTERS {
                    let (near, _) = all_moved_nearer(&packet.load(simd, register));
                    packet.o.store(register, near.o);
                });
            }
            let (mut rays, mut before) = (packets.clone(), Vec::new());
            let mut unmade = PrimaryPackets { camera: &sight, rays: &mut rays, before: &mut before };
            let sources = PacketSources::Primary { packets: &mut unmade, level, probe: &mut Silent };
            let (mut frustums, mut frusta) = (Vec::new(), FrustumSoa::default());
            let whole = dispatch!(level, simd => {
                sources.spread(simd, level, &mut frustums, &mut frusta);
                sources.whole(simd)
            });
            for (k, packet) in packets.iter().enumerate() {
                for lane in lanes(packet.live) {
                    let ray = packet.ray(lane);
                    for t in [0.0, 0.3, 2.0, 3.5, 5.0, 8.0] {
                        let p = ray.at(t);
                        if p.abs().max_element() > 2.0 {
                            continue;
                        }
                        // As boxes are: rounded outward, and a little more.
                        let lo = [p.x, p.y, p.z].map(|x| (x - 1e-6) as f32);
                        let hi = [p.x, p.y, p.z].map(|x| (x + 1e-6) as f32);
                        let (met, near) = dispatch!(level, simd => {
                            let eight = |x: [f32; 3]| x.map(|x| f32x8::splat(simd, x));
                            let met = whole.meets_boxes(simd, &eight(lo), &eight(hi));
                            let near: [f32; 8] = met.near.into();
                            (met.boxes, near[0])
                        });
                        prop_assert_eq!(met & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(near) <= t, "{} {}", near, t);
                        let met = dispatch!(level, simd => frusta.meets(simd, lo, hi));
                        prop_assert_eq!(met.frustums >> k & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(met.near[k]) <= t, "{} {}", met.near[k], t);
                        let center = [p.x, p.y, p.z].map(|x| x as f32);
                        let met = dispatch!(level, simd => frusta.meets_ball(simd, center, 1e-6));
                        prop_assert_eq!(met.frustums >> k & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(met.near[k]) <= t, "{} {}", met.near[k], t);
                    }
                }
            }
        }
    }
}

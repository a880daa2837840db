//! Other reordering for the rays towards a light: those that lie side by side seen from the light.
//!
//! Neighbours in the picture that start on things one behind the other are far from each other in the light's
//! view, and what stands between them is in the way of neither. Sorted by that view, the rays of a tile make
//! thin shadow packets again. Each ray finds what it finds in any packet.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::lattice::LONGEST_PATH;
use crate::math::{DVec3, LaneVector, Lanes, Number, PACKET, REGISTERS, lanes};
use crate::solid::Departures;

use super::shadow_packet::ShadowPacket;

/// Cells across the light's view of a tile: as many in all as a tile has rays.
const CELLS: usize = 32;

/// Shadow packets wider than this on average, as a share of their tile, are to be put together anew: those of
/// one surface, sixteen to a tile, are a quarter of it, and a little more where they lie askew.
const WIDE: f64 = 0.3;

/// Rays put together anew.
#[derive(Debug, Default)]
pub struct RayReordering {
    /// By shadow packet: where its rays are in the light's view.
    seen: Vec<[Lanes; 2]>,
    /// The lower corner of the part of the view that holds all, and how large it is.
    corner: [f64; 2],
    size: [f64; 2],
    /// By cell: where its rays start in `order`.
    starts: Vec<u16>,
    /// The rays by cells: the number of the shadow packet, and six bits for the lane.
    order: Vec<u16>,
    /// The new shadow packets, as many as `order` fills; there may be more.
    shadow_packets: Vec<ShadowPacket>,
    /// By new shadow packet: what its rays leave.
    departures: Vec<Departures>,
}

impl RayReordering {
    /// Looks at the rays from where they go, and answers whether they are better put together anew.
    #[inline(always)]
    pub fn would_help<S: Simd>(&mut self, simd: S, shadow_packets: &[ShadowPacket], lamp: DVec3) -> bool {
        let live = || shadow_packets.iter().filter(|shadow_packet| shadow_packet.rays.live != 0);
        let mut sum = DVec3::ZERO;
        for shadow_packet in live() {
            sum += shadow_packet.rays.d.get(0) + shadow_packet.rays.d.get(PACKET - 1);
        }
        let (u, v) = sum.normalize_or(DVec3::X).any_orthonormal_pair();
        // Near a light the view is one of directions, far from it of places.
        let near = lamp.abs().max_element() <= LONGEST_PATH;
        let infinite = f64x8::splat(simd, f64::INFINITY);
        let (mut from, mut to) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (mut widths, mut count) = (0.0, 0.0);
        self.seen.resize(shadow_packets.len(), [Lanes::filled(0.0); 2]);
        for (shadow_packet, seen) in shadow_packets.iter().zip(&mut self.seen) {
            if shadow_packet.rays.live == 0 {
                continue;
            }
            count += 1.0;
            let (mut low, mut high) = ([infinite; 2], [-infinite; 2]);
            for register in 0..REGISTERS {
                let p = if near {
                    shadow_packet.rays.d.load(simd, register)
                } else {
                    shadow_packet.rays.o.load(simd, register)
                };
                let at = [p.dot_one(u), p.dot_one(v)];
                for k in 0..2 {
                    seen[k].store(register, at[k]);
                    (low[k], high[k]) = (at[k].smaller(low[k]), at[k].larger(high[k]));
                }
            }
            for k in 0..2 {
                let (low, high) = (low[k].reduce_min(), high[k].reduce_max());
                widths += high - low;
                (from[k], to[k]) = (from[k].min(low), to[k].max(high));
            }
        }
        self.corner = from;
        self.size = [to[0] - from[0], to[1] - from[1]];
        widths > WIDE * count * (self.size[0] + self.size[1])
    }

    /// Puts the rays together anew.
    #[inline(always)]
    pub fn gather<S: Simd>(&mut self, simd: S, shadow_packets: &[ShadowPacket], departures: &[Departures]) {
        let scale = CELLS as f64 / self.size[0].max(self.size[1]);
        // Digits of both numbers in turn: cells side by side are mostly near in that order (Morton).
        let spread = |x: f64| {
            let x = ((x * scale) as usize).min(CELLS - 1);
            (0..5).fold(0, |sum, bit| sum | (x >> bit & 1) << (2 * bit))
        };
        let cell = |seen: &[Lanes; 2], lane: usize| {
            spread(seen[0].0[lane] - self.corner[0]) | spread(seen[1].0[lane] - self.corner[1]) << 1
        };
        self.starts.clear();
        self.starts.resize(CELLS * CELLS + 1, 0);
        let mut count = 0;
        for (shadow_packet, seen) in shadow_packets.iter().zip(&self.seen) {
            for lane in lanes(shadow_packet.rays.live) {
                self.starts[cell(seen, lane) + 1] += 1;
                count += 1;
            }
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.order.resize(count, 0);
        for (k, (shadow_packet, seen)) in shadow_packets.iter().zip(&self.seen).enumerate() {
            for lane in lanes(shadow_packet.rays.live) {
                let start = &mut self.starts[cell(seen, lane)];
                self.order[*start as usize] = (k * PACKET + lane) as u16;
                *start += 1;
            }
        }
        let needed = count.div_ceil(PACKET);
        if self.shadow_packets.len() < needed {
            self.shadow_packets.resize(needed, ShadowPacket::EMPTY);
            self.departures.resize(needed, Departures::NONE);
        }
        let groups = self.order.chunks(PACKET);
        for ((to, left), group) in self.shadow_packets.iter_mut().zip(&mut self.departures).zip(groups) {
            to.clear();
            left.inward = 0;
            for (lane, &ray) in group.iter().enumerate() {
                let (k, own) = place(ray);
                let (from, leaves) = (&shadow_packets[k], &departures[k]);
                for axis in 0..3 {
                    to.rays.o[axis].0[lane] = from.rays.o[axis].0[own];
                    to.rays.d[axis].0[lane] = from.rays.d[axis].0[own];
                }
                to.distance.0[lane] = from.distance.0[own];
                left.primitive.0[lane] = leaves.primitive.0[own];
                left.surface.0[lane] = leaves.surface.0[own];
                left.place_error.0[lane] = leaves.place_error.0[own];
                left.inward |= (leaves.inward >> own & 1) << lane;
                to.rays.live |= 1 << lane;
            }
            to.close(simd);
        }
    }

    /// The new shadow packets, and what their rays leave.
    pub fn shadow_packets(&mut self) -> (&mut [ShadowPacket], &[Departures]) {
        let count = self.order.len().div_ceil(PACKET);
        (&mut self.shadow_packets[..count], &self.departures[..count])
    }

    /// Gives each ray back what was found for it.
    pub fn scatter(&self, shadow_packets: &mut [ShadowPacket]) {
        for (from, group) in self.shadow_packets.iter().zip(self.order.chunks(PACKET)) {
            for lane in lanes(from.blocked | from.tint.rays | from.uncertain) {
                let (k, own) = place(group[lane]);
                let to = &mut shadow_packets[k];
                to.blocked |= (from.blocked >> lane & 1) << own;
                to.uncertain |= (from.uncertain >> lane & 1) << own;
                to.tint.rays |= (from.tint.rays >> lane & 1) << own;
                to.tint.share.0[own] = from.tint.share.0[lane];
            }
        }
    }
}

/// The shadow packet of a ray, and its lane there.
fn place(ray: u16) -> (usize, usize) {
    (ray as usize / PACKET, ray as usize % PACKET)
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use super::*;
    use crate::math::{Ray, dispatch};

    #[test]
    fn rays_that_were_mixed_are_sorted_by_the_lights_view_and_get_their_own_answers() {
        let lamp = DVec3::new(0.0, 0.0, 8.0);
        // Every shadow packet reaches over the whole view; every third ray is missing.
        let start = |k: usize, lane: usize| {
            let place = (lane * 16 + k) * 389 % 1024;
            DVec3::new((place % 32) as f64 / 32.0, (place / 32) as f64 / 32.0, 0.0)
        };
        let mut shadow_packets = vec![ShadowPacket::EMPTY; 16];
        let mut departures = vec![Departures::NONE; 16];
        for (k, (shadow_packet, left)) in shadow_packets.iter_mut().zip(&mut departures).enumerate() {
            for lane in (0..PACKET).filter(|lane| (lane + k) % 3 != 0) {
                let o = start(k, lane);
                shadow_packet.rays.set(lane, &Ray::new(o, (lamp - o).normalize()));
                shadow_packet.distance.0[lane] = (lamp - o).length();
                left.primitive.0[lane] = (k * PACKET + lane) as u32;
            }
            dispatch!(Level::new(), simd => shadow_packet.close(simd));
        }
        let mut reordering = RayReordering::default();
        assert!(dispatch!(Level::new(), simd => reordering.would_help(simd, &shadow_packets, lamp)));
        dispatch!(Level::new(), simd => reordering.gather(simd, &shadow_packets, &departures));
        let rays: u32 = shadow_packets.iter().map(|shadow_packet| shadow_packet.rays.live.count_ones()).sum();
        let (new, leave) = reordering.shadow_packets();
        assert_eq!(new.len(), (rays as usize).div_ceil(PACKET));
        for (shadow_packet, left) in new.iter_mut().zip(leave) {
            for lane in lanes(shadow_packet.rays.live) {
                let ray = left.primitive.0[lane] as usize;
                assert_eq!(shadow_packet.rays.o.get(lane), start(ray / PACKET, ray % PACKET));
                shadow_packet.blocked |= u64::from(ray.is_multiple_of(2)) << lane;
                shadow_packet.uncertain |= u64::from(ray.is_multiple_of(5)) << lane;
            }
        }
        reordering.scatter(&mut shadow_packets);
        for (k, shadow_packet) in shadow_packets.iter().enumerate() {
            for lane in 0..PACKET {
                let (ray, live) = (k * PACKET + lane, shadow_packet.rays.live >> lane & 1 == 1);
                assert_eq!(shadow_packet.blocked >> lane & 1 == 1, live && ray.is_multiple_of(2));
                assert_eq!(shadow_packet.uncertain >> lane & 1 == 1, live && ray.is_multiple_of(5));
            }
        }
    }

    #[test]
    fn shadow_packets_of_one_surface_stay_together() {
        let lamp = DVec3::new(0.0, 0.0, 8.0);
        let mut shadow_packets = vec![ShadowPacket::EMPTY; 16];
        for (k, shadow_packet) in shadow_packets.iter_mut().enumerate() {
            for lane in 0..PACKET {
                let (x, y) = (k % 4 * 8 + lane % 8, k / 4 * 8 + lane / 8);
                let o = DVec3::new(x as f64 / 32.0, y as f64 / 32.0, 0.0);
                shadow_packet.rays.set(lane, &Ray::new(o, (lamp - o).normalize()));
            }
        }
        let mut reordering = RayReordering::default();
        assert!(!dispatch!(Level::new(), simd => reordering.would_help(simd, &shadow_packets, lamp)));
    }
}

//! The fast engine: the rays of a tile side by side, with the bits that the exact engine finds for each
//! single ray, unless single precision is enough.
//!
//! A tile of rays is bounded by frustums, which walk a hierarchy of boxes; what they leave is computed for
//! eight rays at a time, by the same formulas in the same order. Rays that are incoherent are traced as a
//! stream. Where a ray's answer needs more than that, two surfaces in one place above all, that ray is left
//! to the exact engine.

mod bezier;
mod blocked;
mod cell_rays;
mod cells;
mod composite;
mod first;
mod glass;
mod incoherent;
mod memory;
mod mesh;
mod mesh_walk;
mod object;
mod packet_culler;
mod packet_hits;
mod precision;
mod primary_packets;
mod ranked;
mod reordering;
mod shadow_packet;
mod sink;
mod source;
mod stream;
mod transmittance;
mod walk;

use fearless_simd::{Level, Simd};

use crate::lattice::{Bvh8, FRUSTA, Structure, SubLattices, slack};
use crate::math::{Lanes, PACKET, RayPacket, Real, dispatch};
use crate::solid::{Assembly, Departures};
use crate::stage::Probe;

use super::Exact;

use precision::Precision;
use source::{PacketSources, TracedPackets, TracedTile};

pub use memory::TileMemory;
pub use packet_hits::PacketHits;
pub use primary_packets::PrimaryPackets;
pub use shadow_packet::{ShadowPacket, ShadowQuery};
pub use transmittance::{OpacityClass, Transmittance};

/// So few rays of a tile towards a light take less time one by one than bringing them together does: what
/// would not fill two packets.
const FEW_OF_TILE: u32 = 2 * PACKET as u32;

/// The engine for tiles of rays, over an assembly and a hierarchy of its boxes.
#[derive(Clone, Copy, Debug)]
pub struct Fast<'a> {
    exact: Exact<'a>,
    assembly: &'a Assembly,
    boxes: &'a Bvh8,
    subs: &'a SubLattices,
    /// How far two hits may seem to be from each other that are one place.
    slack: f64,
    level: Level,
    /// Whether rays from the eye are traced in single precision.
    singles: bool,
}

impl<'a> Fast<'a> {
    /// An engine over an assembly, at the SIMD width of this processor.
    pub fn new(assembly: &'a Assembly, boxes: &'a Bvh8, subs: &'a SubLattices) -> Self {
        let exact = Exact::new(assembly, Structure::Boxes(boxes, subs));
        Self {
            exact,
            assembly,
            boxes,
            subs,
            slack: slack(assembly.place_error),
            level: Level::new(),
            singles: false,
        }
    }

    /// The same engine at another SIMD width. It finds the same bits.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The same engine that traces rays from the eye in single precision: what they meet first is off its
    /// place by up to [`Real::EPSILON_RATIO`] times as much. Where it is uncertain which of two things is met
    /// first, double precision decides.
    #[must_use]
    pub fn in_singles(self, singles: bool) -> Self {
        Self { singles, ..self }
    }

    /// How far two hits may seem to be from each other that are one place, in this precision.
    fn slack_of<T: Real>(&self) -> f64 {
        self.slack * T::EPSILON_RATIO
    }

    /// The engine that is asked for single rays, over the same boxes.
    pub fn exact(&self) -> &Exact<'a> {
        &self.exact
    }

    /// The SIMD width.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Moves the starts of rays from the eye near to the world. Sets the path lengths there, in two parts
    /// that are to be added to a distance, the second first.
    pub fn approach(&self, packet: &mut RayPacket, before: &mut [Lanes; 2]) {
        primary_packets::approach(packet, before, self.level);
    }

    /// The first hits of a tile of rays, by packets that are [closed](RayPacket::close), up to [`FRUSTA`] of
    /// them; `departures` are the surfaces that the rays of each leave, none for rays from the eye. Those
    /// that are uncertain, and those that meet two objects in one place, are left to
    /// [`super::RayEngine::first`] or [`super::RayEngine::next`], one by one. Answers how many packets had so
    /// many objects between their rays that they were given up.
    pub fn first_of(
        &self,
        packets: &[RayPacket],
        departures: Option<&[Departures]>,
        nearest: &mut [PacketHits],
        memory: &mut TileMemory,
    ) -> usize {
        let sources = &mut PacketSources::Made { packets, departures };
        self.first_of_sources::<f64>(sources, &mut TracedPackets { own: &mut [], nearest }, memory).given_up
    }

    /// The first hits of the rays from the eye through a tile, as [`Fast::first_of`] finds them. `nearest`
    /// has as many as the tile has blocks. The rays of a block are made where they may meet anything; the
    /// answer has a bit for each block whose are. Of the others nothing is to be read. `probe` is told when
    /// rays are made.
    pub fn first_seen(
        &self,
        packets: &mut PrimaryPackets,
        nearest: &mut [PacketHits],
        memory: &mut TileMemory,
        probe: &mut dyn Probe,
    ) -> u16 {
        let sources = &mut PacketSources::Primary { packets, level: self.level, probe };
        if !self.singles {
            let traced = &mut TracedPackets { own: &mut [], nearest };
            return self.first_of_sources::<f64>(sources, traced, memory).touched;
        }
        let (mut own, mut met) =
            (std::mem::take(&mut memory.singles.rays), std::mem::take(&mut memory.singles.nearest));
        own.resize(nearest.len(), RayPacket::EMPTY);
        met.resize(nearest.len(), PacketHits::NOTHING);
        let traced = &mut TracedPackets { own: &mut own, nearest: &mut met };
        let touched = self.first_of_sources::<f32>(sources, traced, memory).touched;
        dispatch!(self.level, simd => for (k, found) in nearest.iter_mut().enumerate() {
            found.clear_ray_bits();
            if touched >> k & 1 == 1 {
                simd.vectorize(
                    #[inline(always)]
                    || found.set_nearest(&met[k]),
                );
            }
        });
        (memory.singles.rays, memory.singles.nearest) = (own, met);
        touched
    }

    fn first_of_sources<T: Precision>(
        &self,
        sources: &mut PacketSources,
        traced: &mut TracedPackets<T>,
        memory: &mut TileMemory,
    ) -> TracedTile {
        dispatch!(self.level, simd => {
            let tile = self.first_of_tile(simd, sources, traced, memory);
            let nearest = traced.nearest.iter_mut().enumerate();
            for (k, found) in nearest.filter(|(k, _)| tile.touched >> k & 1 == 1) {
                found.mark_ties(simd, self.slack_of::<T>());
                found.uncertain &= sources.get(k).rays.live & !found.incoherent;
            }
            tile
        })
    }

    /// Which rays towards one light are blocked, and what glass leaves of the light of the others. Those that
    /// are uncertain are left to [`super::RayEngine::blocked`], one by one. Answers whether most shadow
    /// packets had so many objects between their rays that they were given up.
    pub fn blocked_of(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) -> bool {
        let rays: u32 = shadow_packets.iter().map(|shadow_packet| shadow_packet.rays.live.count_ones()).sum();
        if rays < FEW_OF_TILE {
            self.blocked_of_incoherent(shadow_packets, departures, lamp, memory);
            return false;
        }
        let mut reordering = std::mem::take(&mut memory.reordering);
        let helps = dispatch!(self.level, simd => reordering.would_help(simd, shadow_packets, lamp.at));
        let incoherent = if helps {
            dispatch!(self.level, simd => reordering.gather(simd, shadow_packets, departures));
            let (new, leave) = reordering.shadow_packets();
            let incoherent = self.blocked_in_order(new, leave, lamp, memory);
            reordering.scatter(shadow_packets);
            incoherent
        } else {
            self.blocked_in_order(shadow_packets, departures, lamp, memory)
        };
        memory.reordering = reordering;
        incoherent
    }

    fn blocked_in_order(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) -> bool {
        let mut incoherent = false;
        for (shadow_packets, departures) in shadow_packets.chunks_mut(FRUSTA).zip(departures.chunks(FRUSTA)) {
            if incoherent {
                shadow_packets.iter_mut().for_each(ShadowPacket::give_up);
                continue;
            }
            let live = shadow_packets.iter().filter(|shadow_packet| shadow_packet.rays.live != 0).count();
            let given_up = dispatch!(self.level, simd => self.blocked_of_tile(simd, shadow_packets, departures, lamp, memory));
            incoherent = 2 * given_up > live;
        }
        self.stream_blocked(shadow_packets, departures, lamp, memory);
        incoherent
    }
}

//! Memory of a worker that lights tiles by wavefronts.

use crate::math::{Lanes, RayPacket};
use crate::shade::{Channel, Lit};
use crate::trace::{RayMemory, ShadowPacket, TileMemory};

use super::ray_integrator::PathMemory;
use super::wavefront::Wavefront;

/// What lighting a tile takes, used again for every tile and every picture.
#[derive(Debug)]
pub struct WavefrontScratch<C> {
    pub(super) trace: TileMemory,
    /// By generation.
    pub(super) waves: Vec<Wavefront<C>>,
    pub(super) shadow_packets: Vec<ShadowPacket>,
    pub(super) lit: Vec<Lit>,
    /// Whether the histories of rays are kept.
    pub(super) keeps_histories: bool,
}

/// Memory of one worker.
#[derive(Debug)]
pub struct WavefrontMemory<C> {
    pub(super) single: PathMemory<RayMemory>,
    pub(super) tile: WavefrontScratch<C>,
}

impl<C> Default for WavefrontScratch<C> {
    fn default() -> Self {
        let (trace, shadow_packets, lit) = (TileMemory::default(), Vec::new(), Vec::new());
        Self { trace, waves: Vec::new(), shadow_packets, lit, keeps_histories: false }
    }
}

impl<C: Channel> WavefrontScratch<C> {
    /// Makes room for the rays from the eye of another tile, so many packets.
    pub(super) fn start(&mut self, packets: usize) {
        if self.waves.is_empty() {
            self.waves.push(Wavefront::new(0));
        }
        let first = &mut self.waves[0];
        first.rays.resize(packets, RayPacket::EMPTY);
        first.before.resize(packets, [Lanes::filled(0.0); 2]);
        first.make_room();
        first.keep_histories(self.keeps_histories);
    }
}

//! What the rays from the eye through a tile met, kept: while view and solids stay, light is computed anew without tracing
//! them.

use crate::math::{DVec3, PACKET, RayIndex};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Fast, Hit, PacketHits};
use crate::view::TileCamera;

use super::channel::Channel;
use super::surface::{Memory, Shader, SurfaceInteraction};
use super::tile::TileShading;

/// What the rays from the eye through a tile met. It depends on nothing but the view and the solids: not on lights, on what
/// the solids are made of, nor on what is computed of them. It takes 21 bytes for each dot of the blocks that see anything.
#[derive(Debug, Default)]
pub struct TileHits {
    /// The blocks that see anything, a bit for each.
    seeing: u16,
    /// What these see, in their order.
    blocks: Vec<BlockHits>,
}

/// What the rays of one block met, as [`PacketHits`] has it.
#[derive(Debug)]
pub(super) struct BlockHits {
    t: [f64; PACKET],
    object: [u32; PACKET],
    primitive: [u32; PACKET],
    surface: [u32; PACKET],
    entering: u64,
    /// Rays that met more than one surface in one place: which of them shows, and what is behind it, are questions of
    /// material.
    together: u64,
    /// Where rays met a surface that were traced alone: their distances are whole ways from the eye, which do not give the
    /// place back.
    alone: Vec<(usize, DVec3)>,
}

impl TileHits {
    /// Keeps what a block sees, the next one that sees anything.
    #[inline]
    pub(super) fn keep(&mut self, block: usize, hits: BlockHits) {
        self.seeing |= 1 << block;
        self.blocks.push(hits);
    }
}

impl BlockHits {
    /// Of what is known of a packet. `alone` are rays that were traced alone, `together` those among them whose light is known
    /// already.
    pub fn new(nearest: &PacketHits, together: u64, alone: &[(RayIndex, SurfaceInteraction)]) -> Self {
        let single = alone.iter().filter(|(at, _)| together >> at.lane & 1 == 0);
        Self {
            t: nearest.t.0,
            object: nearest.object.0,
            primitive: nearest.primitive.0,
            surface: nearest.surface.0,
            entering: nearest.entering,
            together,
            alone: single.map(|(at, met)| (at.lane, met.p)).collect(),
        }
    }

    /// Says so to the packet `k`. Answers which rays met what when they were traced alone.
    fn tell(&self, k: usize, nearest: &mut PacketHits) -> Vec<(RayIndex, SurfaceInteraction)> {
        nearest.t.0 = self.t;
        nearest.object.0 = self.object;
        nearest.primitive.0 = self.primitive;
        nearest.surface.0 = self.surface;
        (nearest.entering, nearest.unsure) = (self.entering, 0);
        let met = |&(lane, p): &(usize, DVec3)| {
            let hit = Hit {
                t: self.t[lane],
                error: 0.0,
                p,
                object: self.object[lane],
                primitive: self.primitive[lane],
                surface: self.surface[lane],
                entering: self.entering >> lane & 1 == 1,
            };
            (RayIndex { packet: k, lane }, SurfaceInteraction { hit, p, normal: DVec3::ZERO })
        };
        self.alone.iter().map(met).collect()
    }
}

impl<'e, C: Channel> Shader<'_, Fast<'e>, C> {
    /// Takes over what the rays from the eye met. Only those are traced again that met more than one surface in one place.
    pub(super) fn recall(
        &self,
        sight: &TileCamera,
        hits: &TileHits,
        tile: &mut TileShading<C>,
        memory: &mut Memory<Fast<'e>>,
        meter: &mut Meter<impl Probe>,
    ) {
        let wave = &mut tile.waves[0];
        let mut blocks = hits.blocks.iter();
        for k in 0..wave.rays.len() {
            let Some(block) = (hits.seeing >> k & 1 == 1).then(|| blocks.next()).flatten() else {
                wave.surfaces[k].forget();
                continue;
            };
            meter.at(Stage::Ray);
            self.set_out(sight, k, &mut wave.rays[k], &mut wave.before[k]);
            meter.at(Stage::Shade);
            let mut alone = block.tell(k, &mut wave.nearest[k]);
            self.see_alone(sight, (k, block.together), wave, &mut alone, memory, meter);
            self.know(wave, k, &alone);
            meter.counts.primary_rays += u64::from(block.together.count_ones());
            meter.counts.primary_hits += u64::from(wave.found(k).count_ones());
        }
    }
}

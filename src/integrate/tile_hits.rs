//! What the rays from the eye through a tile met, kept: while view and solids stay, light is computed anew
//! without tracing them.

use crate::math::{DVec3, PACKET, RayIndex};
use crate::shade::SurfaceInteraction;
use crate::trace::{Hit, PacketHits};

/// What the rays from the eye through a tile met. It depends on nothing but the view and the solids: not on
/// lights, on what the solids are made of, nor on what is computed of them. It takes 21 bytes for each dot of
/// the blocks that see anything.
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
    /// Rays that met more than one surface in one place: which of them shows, and what is behind it, are
    /// questions of material.
    pub together: u64,
    /// By lane: where rays met a surface that were traced singly. Their distances are whole path lengths from
    /// the eye, which do not give the place back.
    singles: Vec<(usize, DVec3)>,
}

impl TileHits {
    /// Keeps what a block sees, the next one that sees anything.
    #[inline]
    pub(super) fn keep(&mut self, block: usize, hits: BlockHits) {
        self.seeing |= 1 << block;
        self.blocks.push(hits);
    }

    /// By block, as many as `count`: what it saw, if anything.
    pub(super) fn by_block(&self, count: usize) -> impl Iterator<Item = Option<&BlockHits>> {
        let mut blocks = self.blocks.iter();
        (0..count).map(move |k| if self.seeing >> k & 1 == 1 { blocks.next() } else { None })
    }
}

impl BlockHits {
    /// What a packet met. `met_singly` is what rays met that were traced singly, `together` has a bit for
    /// those among them that met several surfaces in one place.
    pub fn new(nearest: &PacketHits, together: u64, met_singly: &[(RayIndex, SurfaceInteraction)]) -> Self {
        let single = met_singly.iter().filter(|(at, _)| together >> at.lane & 1 == 0);
        Self {
            t: nearest.t.0,
            object: nearest.object.0,
            primitive: nearest.primitive.0,
            surface: nearest.surface.0,
            entering: nearest.entering,
            together,
            singles: single.map(|(at, met)| (at.lane, met.p)).collect(),
        }
    }

    /// Sets the hits of packet `k`. Answers what its rays met that were traced singly.
    pub fn restore(&self, k: usize, nearest: &mut PacketHits) -> Vec<(RayIndex, SurfaceInteraction)> {
        nearest.t.0 = self.t;
        nearest.object.0 = self.object;
        nearest.primitive.0 = self.primitive;
        nearest.surface.0 = self.surface;
        (nearest.entering, nearest.uncertain) = (self.entering, 0);
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
        self.singles.iter().map(met).collect()
    }
}

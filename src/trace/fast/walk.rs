//! The walk of a tile's frustums through the hierarchy of boxes, the same for what rays meet first and for
//! whether anything stands in their way: a [`TileVisitor`] says what differs.
//!
//! The frustum of the whole tile is tested against the boxes of each node once. Where it meets objects, the
//! frustums of the packets are tested against each, all at once; the visitor intersects the packets that are
//! left.

use fearless_simd::{Simd, f32x8};

use crate::lattice::{BoundingSphere, Bvh8, BvhChild, FRUSTA, Frustum, FrustumHits, FrustumSoa, Node};
use crate::math::RayPacket;

use super::memory::{StackItem, TileMemory};
use super::packet_culler::{PacketCuller, Slabs, wide};
use super::ranked::push_ranked;

/// What a walk looks for.
pub(super) trait TileVisitor<S: Simd> {
    /// The packets that may still meet something that matters, a bit for each.
    fn open(&self) -> u16;

    /// Whether what is ranked so is farther away than anything that still matters to any packet.
    fn is_beyond(&self, rank: f64, memory: &TileMemory) -> bool;

    /// Sets the frustums of the packets in `memory`, before the first of them is tested.
    fn spread(&mut self, _: S, _: &mut TileMemory) {}

    /// In which order nodes are walked, the lowest first, by how near they are at least to the start of any
    /// ray.
    fn rank(near: f32x8<S>) -> f32x8<S>;

    /// Whether an object that is a ball is culled by its bounding sphere in place of its box.
    fn takes_ball(&self, object: u32) -> bool;

    /// Intersects packet `k` with an object that its frustum may meet, no nearer to any ray's start than
    /// `near`.
    fn visit(&mut self, simd: S, target: &Target<S>, k: usize, near: f32, memory: &mut TileMemory);
}

/// An object whose box some packets may meet.
pub(super) struct Target<S: Simd> {
    /// By its index in the assembly.
    pub object: u32,
    ball: Option<BoundingSphere>,
    slabs: Slabs<S>,
    slack: f64,
}

impl<S: Simd> Target<S> {
    /// Which of some rays may come into the object's box, or its ball, within their limits; and which
    /// certainly go into the ball there.
    #[inline(always)]
    pub fn cull(&self, simd: S, culler: &mut PacketCuller, packet: &RayPacket, wanted: u64) -> (u64, u64) {
        if let Some(ball) = &self.ball {
            culler.set_points(simd, packet);
            culler.ball(simd, ball, self.slack, wanted)
        } else {
            culler.set_lines(simd, packet);
            (culler.passing(simd, &self.slabs, wanted), 0)
        }
    }
}

/// Walks the boxes with the frustum `whole` around all packets. Boxes are taken to be larger by `slack`.
#[inline(always)]
pub(super) fn walk_tile<S: Simd, V: TileVisitor<S>>(
    simd: S,
    boxes: &Bvh8,
    whole: &Frustum,
    slack: f64,
    visitor: &mut V,
    memory: &mut TileMemory,
) {
    memory.stack.clear();
    memory.stack.push(StackItem::root(visitor.open()));
    let mut spread = false;
    while let Some(StackItem { rank, node, frustums }) = memory.stack.pop() {
        let frustums = frustums & visitor.open();
        if frustums == 0 || visitor.is_beyond(rank, memory) {
            continue;
        }
        let node = &boxes.nodes()[node as usize];
        memory.counts.cells_visited += 1;
        let (lo, hi) = node.sides(simd);
        let met = whole.meets_boxes(simd, &lo, &hi);
        if met.boxes == 0 {
            continue;
        }
        if !spread {
            spread = true;
            visitor.spread(simd, memory);
        }
        let mut objects = met.boxes & !node.inner();
        while objects != 0 {
            let slot = objects.trailing_zeros() as usize;
            objects &= objects - 1;
            let Some(BvhChild::Object(object)) = node.child(slot) else { continue };
            let (lo, hi) = node.corners(slot);
            let ball = node.ball(slot).filter(
                #[inline(always)]
                |_| visitor.takes_ball(object),
            );
            let met = match &ball {
                Some(ball) => memory.frusta.meets_ball(simd, ball.center, ball.outer),
                None => memory.frusta.meets(simd, lo, hi),
            };
            let mut packets = met.frustums & frustums & visitor.open();
            if packets == 0 {
                continue;
            }
            let slabs = Slabs::around(simd, wide(lo), wide(hi), slack);
            let target = Target { object, ball, slabs, slack };
            while packets != 0 {
                let k = packets.trailing_zeros() as usize;
                packets &= packets - 1;
                visitor.visit(simd, &target, k, met.near[k], memory);
            }
            if visitor.open() == 0 {
                return;
            }
        }
        let TileMemory { frusta, stack, .. } = memory;
        let ranked = FrustumHits { near: V::rank(met.near), ..met };
        push_lowest_last(simd, stack, node, &ranked, frusta, frustums & visitor.open());
    }
}

/// Puts the nodes among a node's children that were met, and that some of the frustums may meet, on the
/// stack, the one of the lowest rank last.
#[inline(always)]
fn push_lowest_last<S: Simd>(
    simd: S,
    stack: &mut Vec<StackItem>,
    node: &Node,
    ranked: &FrustumHits<S>,
    frusta: &FrustumSoa,
    frustums: u16,
) {
    let first = stack.len();
    let mut left = ranked.boxes & node.inner();
    while left != 0 {
        let slot = left.trailing_zeros() as usize;
        left &= left - 1;
        let Some(BvhChild::Node(index)) = node.child(slot) else { continue };
        let (lo, hi) = node.corners(slot);
        let frustums = frusta.meets(simd, lo, hi).frustums & frustums;
        if frustums == 0 {
            continue;
        }
        let rank = f64::from(ranked.near[slot]);
        push_ranked(
            stack,
            first,
            StackItem { rank, node: index, frustums },
            #[inline(always)]
            |item| item.rank,
        );
    }
}

/// How many objects each packet may still be intersected with before it is given up as incoherent.
#[derive(Clone, Copy, Debug)]
pub(super) struct TestBudget([u32; FRUSTA]);

impl TestBudget {
    /// Nothing for any.
    pub const NONE: Self = Self([0; FRUSTA]);

    /// Gives packet `k` so many objects for each of its rays.
    #[inline(always)]
    pub fn grant(&mut self, k: usize, objects: u32, rays: u64) {
        self.0[k] = objects * rays.count_ones();
    }

    /// Takes one object from what packet `k` has. False where nothing is left.
    #[inline(always)]
    pub fn spend(&mut self, k: usize) -> bool {
        let left = self.0[k].checked_sub(1);
        self.0[k] = left.unwrap_or(0);
        left.is_some()
    }
}

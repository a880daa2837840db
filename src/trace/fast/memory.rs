//! Memory of one worker.

use crate::lattice::{FRUSTA, Frustum, FrustumSoa};
use crate::math::{RayPacket, Real};
use crate::solid::{
    BezierPacket, MeshLists, MeshPacket, PacketCrossings, PacketRange, PacketScratch, PacketShear,
    PrunedExpr, Pruning,
};
use crate::stage::Counts;

use super::cell_rays::{CellItem, CellRays};
use super::incoherent::IncoherentRays;
use super::mesh_walk::{KnownStart, MeshWalks};
use super::packet_culler::PacketCuller;
use super::packet_hits::PacketHits;
use super::reordering::RayReordering;

/// What tracing a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileMemory {
    /// By packet: its frustum; `None` where it is not traced.
    pub(super) frustums: Vec<Option<Frustum>>,
    /// By packet: what its rays meet beyond this distance cannot matter.
    pub(super) far: Vec<f64>,
    /// By packet: its rays in single precision, for culling.
    pub(super) cullers: Vec<PacketCuller>,
    pub(super) frusta: FrustumSoa,
    pub(super) reordering: RayReordering,
    pub(super) incoherent: IncoherentRays,
    /// By packet: the planes across its rays, where they were needed.
    pub(super) sheared: Vec<PacketShear>,
    /// Nodes to be walked.
    pub(super) stack: Vec<StackItem>,
    pub(super) doubles: PrecisionScratch<f64>,
    pub(super) singles: PrecisionScratch<f32>,
    /// What is to be walked of an object's cells.
    pub(super) cell_stack: Vec<CellItem>,
    /// By leaf of an expression: the rays that may meet it.
    pub(super) near: Vec<u64>,
    /// The objects of the tile whose cells are walked at once, since slices took too much work.
    pub(super) in_cells: Vec<u32>,
    /// The rays that are intersected with a mesh, and their walks through it.
    pub(super) mesh: Box<MeshPacket>,
    pub(super) mesh_walks: MeshWalks,
    /// The rays that are intersected with Bézier patches.
    pub(super) bezier: Box<BezierPacket>,
    /// What they cross of a mesh that is an operand.
    pub(super) mesh_lists: Box<MeshLists>,
    /// Whether the frustums end at a light.
    pub(super) ends_at_light: bool,
    /// Where rays to a mesh started last, if that is known.
    pub(super) mesh_start: Option<KnownStart>,
    /// What rays meet of one object.
    pub(super) met: Box<PacketHits>,
    pub(super) pruning: Pruning,
    /// Pruned expressions that are not in use.
    pub(super) pruned: Vec<PrunedExpr>,
    pub(super) counts: Counts,
}

/// A node that is to be walked.
#[derive(Clone, Copy, Debug)]
pub(super) struct StackItem {
    /// The lowest is walked first.
    pub rank: f64,
    /// Its index.
    pub node: u32,
    /// Which frustums may meet it, a bit for each.
    pub frustums: u16,
}

impl StackItem {
    /// The root, for these frustums.
    pub fn root(frustums: u16) -> Self {
        Self { rank: f64::NEG_INFINITY, node: 0, frustums }
    }
}

/// Memory for packets that are traced in one precision.
#[derive(Debug)]
pub(super) struct PrecisionScratch<T> {
    pub csg: PacketScratch<T>,
    pub found: Box<PacketCrossings<T>>,
    pub cells: CellRays<T>,
    /// What is met first in the cells of one object: for the one that is asked about.
    pub of_object: Vec<PacketHits<T>>,
    /// The part of each ray that is asked for.
    pub reach: Box<PacketRange<T>>,
    /// By packet: its rays, and what they met, where those of the tile are in another precision.
    pub rays: Vec<RayPacket<T>>,
    pub nearest: Vec<PacketHits<T>>,
}

impl<T: Real> Default for PrecisionScratch<T> {
    fn default() -> Self {
        Self {
            csg: PacketScratch::default(),
            found: Box::new(PacketCrossings::NONE),
            cells: CellRays::default(),
            of_object: Vec::new(),
            reach: Box::new(PacketRange::NONE),
            rays: Vec::new(),
            nearest: Vec::new(),
        }
    }
}

impl TileMemory {
    /// What was counted since it was last taken.
    pub fn counts_mut(&mut self) -> &mut Counts {
        &mut self.counts
    }

    /// Forgets the planes across the rays of the last tile, and which objects were walked by cells.
    pub(super) fn forget_tile(&mut self) {
        self.in_cells.clear();
        self.mesh_walks.forget_tile();
        self.mesh_start = None;
        self.sheared.iter_mut().for_each(PacketShear::forget);
    }
}

impl Default for TileMemory {
    fn default() -> Self {
        Self {
            frustums: Vec::new(),
            far: Vec::new(),
            cullers: vec![PacketCuller::EMPTY; FRUSTA],
            frusta: FrustumSoa::default(),
            reordering: RayReordering::default(),
            incoherent: IncoherentRays::default(),
            sheared: vec![PacketShear::UNKNOWN; FRUSTA],
            stack: Vec::new(),
            doubles: PrecisionScratch::default(),
            singles: PrecisionScratch::default(),
            cell_stack: Vec::new(),
            near: Vec::new(),
            in_cells: Vec::new(),
            mesh: Box::new(MeshPacket::EMPTY),
            mesh_walks: MeshWalks::default(),
            bezier: Box::new(BezierPacket::EMPTY),
            mesh_lists: Box::new(MeshLists::EMPTY),
            ends_at_light: false,
            mesh_start: None,
            met: Box::default(),
            pruning: Pruning::default(),
            pruned: Vec::new(),
            counts: Counts::default(),
        }
    }
}

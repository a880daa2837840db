//! The lattice at every size: lattices of at most 4 × 4 × 4 cells within lattices.
//!
//! Each node cuts its box by up to three planes across each axis, chosen among its objects' bounds by
//! surface-area cost. A bit mask says which of its cells hold something; a cell that does is a few objects,
//! or a node. Planes at bounds leave empty space in cells of its own, which a ray steps over by one bit.
//!
//! An object that reaches into several cells is pointed to from each, but never from more than
//! [`MOST_POINTERS`]: it carries an allowance, which its cells share, and where that runs out it stays with
//! the node and is tested when a ray enters the node. Memory is linear in the objects, whatever their
//! overlap.

mod build;
mod cut;
mod walk;

use crate::math::Bounds;
use crate::solid::Assembly;

/// Cells along each axis of a node.
const SIDE: usize = 4;

/// The most pointers to one object. Eight let a small object lie across the corner of a node's cells; 64 let
/// that happen on two levels.
pub const MOST_POINTERS: u32 = 64;

/// Lattices within lattices over a whole scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    nodes: Vec<Node>,
    cells: Vec<Cell>,
    pointers: Vec<u32>,
}

/// One small lattice.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    /// The inner planes across x, y and z; only the first `cuts` of each are there.
    planes: [[f64; SIDE - 1]; 3],
    cuts: [u8; 3],
    /// Bit `x + 4y + 16z` is set where that cell holds something.
    full: u64,
    /// The full cells stand here in order of their bits.
    first_cell: u32,
    /// Objects that stay with the node.
    own: Pointers,
}

/// What a full cell holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cell {
    Objects(Pointers),
    Node(u32),
}

/// A stretch of the list of pointers to objects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Pointers {
    start: u32,
    count: u32,
}

impl Tree {
    /// Cuts the world of an assembly.
    pub fn new(assembly: &Assembly) -> Self {
        let boxes: Vec<Bounds> = assembly.objects.iter().map(|o| o.bounds).collect();
        build::built(&boxes, &assembly.limit, build::SHARED)
    }

    /// How many small lattices there are.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// How many pointers to objects there are.
    pub fn pointers(&self) -> usize {
        self.pointers.len()
    }

    /// Memory held, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.cells[..]) + size_of_val(&self.pointers[..])
    }

    fn list(&self, pointers: Pointers) -> &[u32] {
        &self.pointers[pointers.start as usize..][..pointers.count as usize]
    }
}

//! Stages 2, 5 and 6, LATTICE, CLIP and CELL: the world cut into cells at every object's bounds, and rays
//! walking through them.
//!
//! The paper's lists, by its own words: the lattice-coordinate lists are [`Planes`]; the lattice list (cell
//! number → object pointers) is [`Lattice::objects_in`]; the object list is
//! [`crate::solid::Assembly::objects`], each composite one with its [`SubLattice`]; the sub-object list is
//! [`crate::solid::Assembly::primitives`].

mod bounding_sphere;
mod bvh;
mod cells;
mod clip;
mod frusta;
mod frustum;
mod loose_octree;
mod planes;
mod slopes;
mod structure;
mod sub;
mod tree;

pub use crate::bvh::{BoxVisitor, Bvh8, BvhChild, Candidate, Node, Stream, StreamRays, WIDE};
pub use bounding_sphere::{BoundingSphere, ROOM};
pub use cells::{CellLine, CellsVisitor, CsgCells};
pub use clip::{Outcode, entry};
pub use frusta::{FRUSTA, FrustaHits, FrustumSoa};
pub use frustum::{Frustum, FrustumHits, LONGEST_PATH};
pub use loose_octree::{LooseOctree, MANY};
pub use planes::{CellStep, Planes, SLACK, slack};
pub use slopes::{Basis, Spread};
pub use structure::Structure;
pub use sub::{SubLattice, SubLattices};
pub use tree::{MOST_POINTERS, Tree};

use std::ops::ControlFlow;

use crate::math::Ray;
use crate::solid::Assembly;

/// The most cells, and pointers to objects from them, that a lattice may have: 80 MB.
pub const BUDGET: f64 = 1e7;

/// The paper's lattice over a whole scene.
#[derive(Clone, Debug)]
pub struct Lattice {
    planes: Planes,
    /// By cell: where its objects start in `pointers`; one more than there are cells.
    starts: Vec<u32>,
    pointers: Vec<u32>,
}

/// A lattice would need more than [`BUDGET`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the lattice would have {cells:.2e} cells and {pointers:.2e} object pointers, more than its budget of {BUDGET:.0e} in all"
)]
pub struct OverBudget {
    /// Cells that it would have.
    pub cells: f64,
    /// Pointers from cells to objects that it would have.
    pub pointers: f64,
}

impl Lattice {
    /// Cuts the world of an assembly.
    pub fn new(assembly: &Assembly) -> Result<Self, OverBudget> {
        let planes = Planes::new(assembly.objects.iter().map(|o| o.bounds), &assembly.limit);
        let ranges: Vec<_> = assembly.objects.iter().map(|o| planes.reach(&o.bounds)).collect();
        let cells = planes.cells();
        let pointers: f64 =
            ranges.iter().map(|r| r.iter().map(|(from, to)| (to - from + 1) as f64).product::<f64>()).sum();
        if cells + pointers > BUDGET {
            return Err(OverBudget { cells, pointers });
        }
        let mut starts = vec![0_u32; cells as usize + 1];
        for_each_cell(&planes, &ranges, |_, cell| starts[cell + 1] += 1);
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut ends = starts.clone();
        let mut list = vec![0; pointers as usize];
        for_each_cell(&planes, &ranges, |object, cell| {
            list[ends[cell] as usize] = object as u32;
            ends[cell] += 1;
        });
        Ok(Self { planes, starts, pointers: list })
    }

    /// The objects that reach into a cell, ascending.
    #[inline]
    pub fn objects_in(&self, cell: usize) -> &[u32] {
        &self.pointers[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The lattice-coordinate lists.
    pub fn planes(&self) -> &Planes {
        &self.planes
    }

    /// Calls `visit` with the objects of each cell that the ray passes between `from` and `to`, in order,
    /// until it breaks. `visit` returns how far the ray still matters: cells that begin beyond that are not
    /// visited.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        mut visit: impl FnMut(&[u32], CellStep) -> ControlFlow<B, f64>,
    ) -> Option<B> {
        let mut farthest = to;
        let found = self.planes.walk(ray, from, to, |step| {
            if step.from > farthest {
                return ControlFlow::Break(None);
            }
            match visit(self.objects_in(step.cell), step) {
                ControlFlow::Break(value) => ControlFlow::Break(Some(value)),
                ControlFlow::Continue(still) => {
                    farthest = still;
                    ControlFlow::Continue(())
                }
            }
        });
        found.flatten()
    }
}

fn for_each_cell(planes: &Planes, ranges: &[[(usize, usize); 3]], mut f: impl FnMut(usize, usize)) {
    for (object, [x, y, z]) in ranges.iter().enumerate() {
        for k in z.0..=z.1 {
            for j in y.0..=y.1 {
                for i in x.0..=x.1 {
                    f(object, planes.number([i, j, k]));
                }
            }
        }
    }
}

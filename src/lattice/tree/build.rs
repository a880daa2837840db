//! Building the tree, from the root.

use rayon::prelude::*;

use crate::math::Bounds;

use super::cut::{Cuts, cheapest};
use super::{Cell, MOST_POINTERS, Node, Pointers, SIDE, Tree};

/// Nodes within nodes: at 64 cells each, past any number of objects unless they lie in one another.
const DEEPEST: u32 = 24;

/// A node of more objects than this has its cells filled by all threads; below it a cell takes less than
/// handing it over.
pub const SHARED: usize = 8192;

/// An object that is sorted into cells.
#[derive(Clone, Copy)]
struct Part {
    object: u32,
    /// How many pointers to it may be made from here on.
    allowance: u32,
}

/// The tree over these boxes, numbered as they stand. Nodes of more than `shared` objects are filled by all
/// threads of the pool at hand, which changes nothing about the tree.
pub fn built(boxes: &[Bounds], limit: &Bounds, shared: usize) -> Tree {
    let mut tree = Tree::default();
    let parts: Vec<Part> =
        (0..boxes.len() as u32).map(|object| Part { object, allowance: MOST_POINTERS }).collect();
    let mut builder = Builder { boxes, shared, tree: &mut tree };
    if let Cell::Objects(own) = builder.cell(&parts, limit, 0) {
        // The root is a node in any case: one without cells, whose objects are its own.
        tree.nodes.push(Node { planes: [[0.0; 3]; 3], cuts: [0; 3], full: 0, first_cell: 0, own });
    }
    tree.nodes.shrink_to_fit();
    tree.cells.shrink_to_fit();
    tree.pointers.shrink_to_fit();
    tree
}

struct Builder<'a> {
    boxes: &'a [Bounds],
    shared: usize,
    tree: &'a mut Tree,
}

impl Builder<'_> {
    /// A cell of the box `b` that holds these parts: a node where cutting pays, else a list.
    fn cell(&mut self, parts: &[Part], b: &Bounds, depth: u32) -> Cell {
        if parts.len() > 1 && depth < DEEPEST {
            // Bounds as far as they lie in this cell: what sticks out is no reason to cut here.
            let boxes: Vec<Bounds> = parts.iter().map(|p| self.boxes[p.object as usize].meet(b)).collect();
            if let Some(cuts) = cheapest(&boxes, b) {
                return self.node(parts, b, &cuts, depth);
            }
        }
        Cell::Objects(self.list(parts.iter().map(|p| p.object)))
    }

    fn node(&mut self, parts: &[Part], b: &Bounds, cuts: &Cuts, depth: u32) -> Cell {
        let index = self.tree.nodes.len();
        let held = Held::new(parts, self.boxes, cuts);
        let own = self.list(held.own.iter().copied());
        let first_cell = self.tree.cells.len();
        let full = held.full();
        let (planes, counts) = laid_out(cuts);
        self.tree.nodes.push(Node { planes, cuts: counts, full, first_cell: first_cell as u32, own });
        // Room for this node's cells, which stand together, before its children add theirs.
        self.tree.cells.extend((0..full.count_ones()).map(|_| Cell::Node(0)));
        let cells: Vec<usize> = (0..CELLS).filter(|bit| full >> bit & 1 == 1).collect();
        if parts.len() > self.shared {
            let (boxes, shared) = (self.boxes, self.shared);
            let grow = |&bit: &usize| {
                let mut tree = Tree::default();
                let mut builder = Builder { boxes, shared, tree: &mut tree };
                let cell = builder.cell(held.of(bit), &cell_box(cuts, b, bit), depth + 1);
                (cell, tree)
            };
            let grown: Vec<(Cell, Tree)> = cells.par_iter().map(grow).collect();
            for (place, (cell, tree)) in grown.into_iter().enumerate() {
                self.tree.cells[first_cell + place] = self.graft(cell, tree);
            }
        } else {
            for (place, &bit) in cells.iter().enumerate() {
                let cell = self.cell(held.of(bit), &cell_box(cuts, b, bit), depth + 1);
                self.tree.cells[first_cell + place] = cell;
            }
        }
        Cell::Node(index as u32)
    }

    /// Takes over a tree that was built separately, and the cell that it fills. The whole is the same as if
    /// it had grown here.
    fn graft(&mut self, cell: Cell, grown: Tree) -> Cell {
        let (nodes, cells) = (self.tree.nodes.len() as u32, self.tree.cells.len() as u32);
        let pointers = self.tree.pointers.len() as u32;
        let moved = |p: Pointers| Pointers { start: p.start + pointers, ..p };
        let moved_cell = |cell: Cell| match cell {
            Cell::Objects(list) => Cell::Objects(moved(list)),
            Cell::Node(index) => Cell::Node(index + nodes),
        };
        let moved_node = |n: Node| Node { first_cell: n.first_cell + cells, own: moved(n.own), ..n };
        self.tree.nodes.extend(grown.nodes.into_iter().map(moved_node));
        self.tree.cells.extend(grown.cells.into_iter().map(moved_cell));
        self.tree.pointers.extend(grown.pointers);
        moved_cell(cell)
    }

    fn list(&mut self, objects: impl Iterator<Item = u32>) -> Pointers {
        let start = self.tree.pointers.len() as u32;
        self.tree.pointers.extend(objects);
        Pointers { start, count: self.tree.pointers.len() as u32 - start }
    }
}

/// Cells of a node.
const CELLS: usize = SIDE * SIDE * SIDE;

/// The planes and their number across each axis, as a node keeps them.
fn laid_out(cuts: &Cuts) -> ([[f64; SIDE - 1]; 3], [u8; 3]) {
    let (mut planes, mut counts) = ([[0.0; SIDE - 1]; 3], [0; 3]);
    for axis in 0..3 {
        let list = &cuts.planes[axis];
        counts[axis] = list.len() as u8;
        planes[axis][..list.len()].copy_from_slice(list);
    }
    (planes, counts)
}

/// What the cells of a node hold.
struct Held {
    /// The parts of all cells, one cell after the other.
    parts: Vec<Part>,
    /// By cell: where its parts start; one more than there are cells.
    starts: [u32; CELLS + 1],
    /// Objects that stay with the node.
    own: Vec<u32>,
}

impl Held {
    /// Deals the parts out to the cells that they reach into.
    fn new(parts: &[Part], boxes: &[Bounds], cuts: &Cuts) -> Self {
        let mut own = Vec::new();
        let mut dealt = Vec::with_capacity(parts.len());
        let mut starts = [0; CELLS + 1];
        for &part in parts {
            let range = reach(cuts, &boxes[part.object as usize]);
            let cells = range.iter().map(|(from, to)| (to - from + 1) as u32).product::<u32>();
            if cells > part.allowance {
                own.push(part.object);
                continue;
            }
            dealt.push((range, Part { allowance: part.allowance / cells, ..part }));
            for (bit, _) in cells_of(range) {
                starts[bit + 1] += 1;
            }
        }
        for bit in 0..CELLS {
            starts[bit + 1] += starts[bit];
        }
        let mut ends = starts;
        let mut parts = vec![Part { object: 0, allowance: 0 }; starts[CELLS] as usize];
        for (range, part) in dealt {
            for (bit, _) in cells_of(range) {
                parts[ends[bit] as usize] = part;
                ends[bit] += 1;
            }
        }
        Self { parts, starts, own }
    }

    fn of(&self, bit: usize) -> &[Part] {
        &self.parts[self.starts[bit] as usize..self.starts[bit + 1] as usize]
    }

    /// Bit by bit: whether the cell holds anything.
    fn full(&self) -> u64 {
        (0..CELLS).filter(|&bit| !self.of(bit).is_empty()).fold(0, |mask, bit| mask | 1 << bit)
    }
}

/// The first and last slab that a box reaches into, along each axis; slab i ends at plane i.
fn reach(cuts: &Cuts, b: &Bounds) -> [(usize, usize); 3] {
    [0, 1, 2].map(|axis| {
        let planes = &cuts.planes[axis];
        let first = planes.partition_point(|&p| p <= b.lo[axis]);
        (first, planes.partition_point(|&p| p < b.hi[axis]).max(first))
    })
}

/// The cells of a range, with their bits.
fn cells_of(range: [(usize, usize); 3]) -> impl Iterator<Item = (usize, [usize; 3])> {
    let [x, y, z] = range;
    (z.0..=z.1).flat_map(move |k| {
        (y.0..=y.1).flat_map(move |j| (x.0..=x.1).map(move |i| (i + SIDE * (j + SIDE * k), [i, j, k])))
    })
}

/// The box of a cell.
fn cell_box(cuts: &Cuts, b: &Bounds, bit: usize) -> Bounds {
    let at = [bit % SIDE, bit / SIDE % SIDE, bit / (SIDE * SIDE)];
    let mut inner = *b;
    for axis in 0..3 {
        let planes = &cuts.planes[axis];
        if at[axis] > 0 {
            inner.lo[axis] = planes[at[axis] - 1];
        }
        if at[axis] < planes.len() {
            inner.hi[axis] = planes[at[axis]];
        }
    }
    inner
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DVec3;

    #[test]
    fn a_tree_that_grew_in_parts_is_the_same() {
        let boxes: Vec<Bounds> = (0..3000)
            .map(|i| {
                let p = DVec3::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97), f64::from(i * 71 % 89));
                Bounds::new(p / 101.0, p / 101.0 + 0.03)
            })
            .collect();
        let limit = boxes.iter().fold(Bounds::EMPTY, |all, b| all.join(b));
        let whole = built(&boxes, &limit, usize::MAX);
        assert!(whole.nodes.len() > 50, "{}", whole.nodes.len());
        for shared in [0, 20, 500] {
            assert_eq!(built(&boxes, &limit, shared), whole, "{shared}");
        }
    }
}

//! Building the tree, from the root.

use crate::math::Bounds;

use super::cut::{Cuts, cheapest};
use super::{Cell, MOST_POINTERS, Node, Pointers, SIDE, Tree};

/// Nodes within nodes: at 64 cells each, past any number of objects unless they lie in one another.
const DEEPEST: u32 = 24;

/// An object on its way down.
#[derive(Clone, Copy)]
struct Part {
    object: u32,
    /// How many pointers to it may be made from here on.
    allowance: u32,
}

/// The tree over these boxes, numbered as they stand.
pub fn built(boxes: &[Bounds], limit: &Bounds) -> Tree {
    let mut tree = Tree { nodes: Vec::new(), cells: Vec::new(), pointers: Vec::new() };
    let parts: Vec<Part> =
        (0..boxes.len() as u32).map(|object| Part { object, allowance: MOST_POINTERS }).collect();
    let mut builder = Builder { boxes, tree: &mut tree };
    if let Cell::Objects(own) = builder.cell(parts, limit, 0) {
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
    tree: &'a mut Tree,
}

impl Builder<'_> {
    /// A cell of the box `b` that holds these parts: a node where cutting pays, else a list.
    fn cell(&mut self, parts: Vec<Part>, b: &Bounds, depth: u32) -> Cell {
        if parts.len() > 1 && depth < DEEPEST {
            // Bounds as far as they lie in this cell: what sticks out is no reason to cut here.
            let boxes: Vec<Bounds> = parts.iter().map(|p| self.boxes[p.object as usize].meet(b)).collect();
            if let Some(cuts) = cheapest(&boxes, b) {
                return self.node(parts, b, &cuts, depth);
            }
        }
        Cell::Objects(self.list(parts.iter().map(|p| p.object)))
    }

    fn node(&mut self, parts: Vec<Part>, b: &Bounds, cuts: &Cuts, depth: u32) -> Cell {
        let index = self.tree.nodes.len();
        let mut planes = [[0.0; SIDE - 1]; 3];
        let mut counts = [0; 3];
        for axis in 0..3 {
            counts[axis] = cuts.planes[axis].len() as u8;
            planes[axis][..cuts.planes[axis].len()].copy_from_slice(&cuts.planes[axis]);
        }
        let mut held: [Vec<Part>; SIDE * SIDE * SIDE] = std::array::from_fn(|_| Vec::new());
        let mut own = Vec::new();
        for part in parts {
            let range = reach(cuts, &self.boxes[part.object as usize]);
            let cells = range.iter().map(|(from, to)| (to - from + 1) as u32).product::<u32>();
            if cells > part.allowance {
                own.push(part.object);
                continue;
            }
            let inside = Part { allowance: part.allowance / cells, ..part };
            for (bit, _) in cells_of(range) {
                held[bit].push(inside);
            }
        }
        let own = self.list(own.into_iter());
        let full =
            held.iter().enumerate().filter(|(_, list)| !list.is_empty()).fold(0, |m, (bit, _)| m | 1 << bit);
        let first_cell = self.tree.cells.len() as u32;
        self.tree.nodes.push(Node { planes, cuts: counts, full, first_cell, own });
        // Room for this node's cells, which stand together, before its children add theirs.
        self.tree.cells.extend((0..full.count_ones()).map(|_| Cell::Node(0)));
        let mut place = first_cell as usize;
        for (bit, list) in held.into_iter().enumerate() {
            if !list.is_empty() {
                let inner = cell_box(cuts, b, bit);
                self.tree.cells[place] = self.cell(list, &inner, depth + 1);
                place += 1;
            }
        }
        Cell::Node(index as u32)
    }

    fn list(&mut self, objects: impl Iterator<Item = u32>) -> Pointers {
        let start = self.tree.pointers.len() as u32;
        self.tree.pointers.extend(objects);
        Pointers { start, count: self.tree.pointers.len() as u32 - start }
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

//! Rays through the tree, nearest cells first.

use std::ops::ControlFlow;

use crate::math::{DVec3, Ray};

use super::super::planes::CellStep;
use super::{Cell, Node, SIDE, Tree};

/// The distance in the mask between neighbours along each axis.
const STRIDE: [u32; 3] = [1, SIDE as u32, (SIDE * SIDE) as u32];

/// What stays the same for all nodes that a ray passes.
struct Walk<'a, 'v, V> {
    tree: &'a Tree,
    ray: &'a Ray,
    /// 1 / d; infinite, and not used, where the ray runs along an axis' planes. Elsewhere it is finite
    /// ([`crate::view::settled`]), so that a start on a plane gives 0.
    inverse: DVec3,
    visit: &'v mut V,
    /// How far the ray still matters.
    farthest: f64,
}

impl Tree {
    /// Calls `visit` with the objects of each full cell that the ray passes between `from` and `to`, and of
    /// each node when it is entered, in order, until it breaks. `visit` returns how far the ray still
    /// matters: cells that begin beyond that are not visited.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        mut visit: impl FnMut(&[u32], CellStep) -> ControlFlow<B, f64>,
    ) -> Option<B> {
        let inverse = ray.d.recip();
        let mut walk = Walk { tree: self, ray, inverse, visit: &mut visit, farthest: to };
        // The root is the first node, for it is made before its cells.
        match walk.node(&self.nodes[0], from, to) {
            ControlFlow::Break(value) => Some(value),
            ControlFlow::Continue(()) => None,
        }
    }
}

impl<B, V: FnMut(&[u32], CellStep) -> ControlFlow<B, f64>> Walk<'_, '_, V> {
    fn node(&mut self, node: &Node, from: f64, to: f64) -> ControlFlow<B> {
        self.farthest = (self.visit)(self.tree.list(node.own), CellStep { cell: 0, from, to })?;
        if node.full == 0 {
            return ControlFlow::Continue(());
        }
        let start = self.ray.at(from);
        let mut at = [0_u8; 3];
        let mut next = [f64::INFINITY; 3];
        let mut bit = 0;
        for axis in 0..3 {
            let planes = &node.planes[axis][..node.cuts[axis] as usize];
            at[axis] = planes.iter().filter(|&&p| p <= start[axis]).count() as u8;
            bit += u32::from(at[axis]) * STRIDE[axis];
            next[axis] = self.leaves_at(node, axis, at[axis]);
        }
        let mut now = from;
        loop {
            let axis = if next[0] <= next[1] && next[0] <= next[2] {
                0
            } else if next[1] <= next[2] {
                1
            } else {
                2
            };
            // Rounding may put the next plane a little behind the start.
            let end = next[axis].max(now).min(to);
            if now > self.farthest {
                return ControlFlow::Continue(());
            }
            if node.full >> bit & 1 == 1 {
                let before = (node.full & ((1 << bit) - 1)).count_ones();
                match self.tree.cells[(node.first_cell + before) as usize] {
                    Cell::Objects(list) => {
                        let step = CellStep { cell: bit as usize, from: now, to: end };
                        self.farthest = (self.visit)(self.tree.list(list), step)?;
                    }
                    Cell::Node(index) => self.node(&self.tree.nodes[index as usize], now, end)?,
                }
            }
            if next[axis] >= to {
                return ControlFlow::Continue(());
            }
            now = end;
            if self.ray.d[axis] > 0.0 {
                at[axis] += 1;
                bit += STRIDE[axis];
            } else {
                at[axis] -= 1;
                bit -= STRIDE[axis];
            }
            next[axis] = self.leaves_at(node, axis, at[axis]);
        }
    }

    /// Where the ray leaves a slab; infinite where it leaves the node first.
    #[inline]
    fn leaves_at(&self, node: &Node, axis: usize, slab: u8) -> f64 {
        let d = self.ray.d[axis];
        let cuts = node.cuts[axis];
        let plane = if d > 0.0 && slab < cuts {
            slab
        } else if d < 0.0 && slab > 0 {
            slab - 1
        } else {
            return f64::INFINITY;
        };
        (node.planes[axis][plane as usize] - self.ray.o[axis]) * self.inverse[axis]
    }
}

//! A bounding volume hierarchy, eight boxes to a node side by side: single rays and frustums of rays are
//! tested against all eight at once. Boxes stand around the objects of a scene, the parts of a large solid,
//! or the triangles of a mesh.
//!
//! Lattice and tree cut space, and point to an object from every cell that it reaches into. Here the objects
//! are parted instead: each has one place, and boxes may overlap. So nothing is tested twice, memory is known
//! beforehand, and a test against a node is a few operations on eight numbers each.

mod build;
mod build_primitive;
mod node;
mod rounding;
mod split;
mod stream;
mod walk;

use fearless_simd::Level;

use crate::math::{Bounds, DVec3};

pub use build_primitive::BuildPrimitive;
pub use node::{BvhChild, Node, WIDE};
pub use rounding::MARGIN;
pub use stream::{Candidate, Stream, StreamRays};
pub use walk::BoxVisitor;

/// Boxes around boxes.
#[derive(Clone, Debug)]
pub struct Bvh8 {
    /// The root is the first.
    nodes: Vec<Node>,
    /// What the processor can do.
    level: Level,
}

impl PartialEq for Bvh8 {
    fn eq(&self, other: &Self) -> bool {
        self.nodes == other.nodes
    }
}

impl Bvh8 {
    /// Parts boxes, each an object by its place among them. They are padded by `margin`.
    pub fn of_boxes(boxes: &[Bounds], margin: f64) -> Self {
        let margin = DVec3::splat(margin);
        Self::over(boxes.len(), |number| BuildPrimitive::new(&boxes[number].padded(margin), number as u32))
    }

    /// The hierarchy over the boxes of so many objects.
    pub fn over(count: usize, reach: impl Fn(usize) -> BuildPrimitive + Send + Sync) -> Self {
        let level = Level::new();
        Self { nodes: build::built(level, count, reach), level }
    }

    /// All nodes. The root is the first; where there are no objects it is empty.
    #[inline]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Numbers the objects anew, in the order in which they stand in the nodes, so that those of one node are
    /// neighbours. Returns their old numbers by the new ones.
    pub fn renumber(&mut self) -> Vec<u32> {
        let mut old = Vec::new();
        for node in &mut self.nodes {
            node.renumber(&mut old);
        }
        old
    }

    /// Whether a point lies in the box of any object.
    pub fn has_near(&self, p: DVec3) -> bool {
        let p = [p.x as f32, p.y as f32, p.z as f32];
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let node: &Node = &self.nodes[index as usize];
            for slot in 0..node.len() {
                let (lo, hi) = node.corners(slot);
                if (0..3).all(|axis| lo[axis] <= p[axis] && p[axis] <= hi[axis]) {
                    match node.child(slot) {
                        Some(BvhChild::Node(index)) => stack.push(index),
                        _ => return true,
                    }
                }
            }
        }
        false
    }

    /// Memory held, in bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..])
    }
}

#[cfg(test)]
mod tests;

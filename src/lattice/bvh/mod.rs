//! A bounding volume hierarchy, eight boxes to a node side by side: single rays and frustums of rays are
//! tested against all eight at once.
//!
//! Lattice and tree cut space, and point to an object from every cell that it reaches into. Here the objects
//! are parted instead: each has one place, and boxes may overlap. So nothing is tested twice, memory is known
//! beforehand, and a test against a node is a few operations on eight numbers each.

mod bounding_sphere;
mod build;
mod build_primitive;
mod node;
mod rounding;
mod split;
mod stream;
mod walk;

use fearless_simd::Level;

use crate::math::{Bounds, DVec3};
use crate::solid::Assembly;

use super::planes::slack;

use build_primitive::BuildPrimitive;

pub use bounding_sphere::{BoundingSphere, ROOM};
pub use node::{BvhChild, Node, WIDE};
pub use stream::{Candidate, Stream, StreamRays};
pub use walk::BoxVisitor;

/// Boxes around boxes over a whole scene.
#[derive(Clone, Debug)]
pub struct Bvh8 {
    /// The root is the first.
    nodes: Vec<Node>,
    /// What the processor can do.
    level: Level,
}

impl Bvh8 {
    /// Parts the objects of an assembly. Their boxes are padded by [`slack`], so that no ray that meets an
    /// object by its own computation misses the object's box by rounding.
    pub fn new(assembly: &Assembly) -> Self {
        let margin = DVec3::splat(slack(assembly.place_error));
        let objects = &assembly.objects;
        Self::over(objects.len(), |object| {
            let reach = BuildPrimitive::new(&objects[object].bounds.padded(margin), object as u32);
            if BoundingSphere::is_in(&reach, assembly) { reach.round() } else { reach }
        })
    }

    /// Parts boxes, each an object by its place among them. They are padded by `margin`.
    pub fn of_boxes(boxes: &[Bounds], margin: f64) -> Self {
        let margin = DVec3::splat(margin);
        Self::over(boxes.len(), |number| BuildPrimitive::new(&boxes[number].padded(margin), number as u32))
    }

    /// The hierarchy over the boxes of so many objects.
    fn over(count: usize, reach: impl Fn(usize) -> BuildPrimitive + Send + Sync) -> Self {
        let level = Level::new();
        Self { nodes: build::built(level, count, reach), level }
    }

    /// All nodes. The root is the first; where there are no objects it is empty.
    #[inline]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Memory held, in bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..])
    }
}

#[cfg(test)]
mod tests;

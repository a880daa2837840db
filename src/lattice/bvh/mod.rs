//! A hierarchy of boxes, eight side by side: what single rays and frustums of rays ask at once.
//!
//! Lattice and tree cut space, and point to an object from every cell that it reaches into. Here the objects are
//! parted instead: each has one place, and boxes may overlap. So nothing is tested twice, memory is known beforehand,
//! and a node is asked by a few operations on eight numbers each.

mod bounding_sphere;
mod build;
mod build_primitive;
mod split;
mod stream;
mod walk;

use fearless_simd::{Level, Simd, SimdBase, f32x8};

use crate::math::{Bounds, DVec3};
use crate::solid::Assembly;

use super::planes::slack;

use build_primitive::BuildPrimitive;

pub use bounding_sphere::{BoundingSphere, ROOM};
pub use stream::{Candidate, Stream, StreamRays};

/// Children of a node: as many as the registers of most processors have numbers, of 32 bits each.
pub const WIDE: usize = 8;

/// How far the sides of boxes are moved outward, so that single precision are enough to ask whether a ray meets them.
///
/// A ray starts within [`WORLD`](crate::solid::WORLD), 6, of the origin and a box ends within 2.01 of it on each axis, what
/// may be [`slack`] with it. Rounding to 24 bits moves the start by at most 2⁻²², and the difference, which is below 16,
/// by 2⁻²¹. The inverse of the direction and the product are off by a share of 2⁻²⁴ each, which is as if the side stood
/// elsewhere by 2 · 2⁻²⁴ of at most 8.01. In all that is less than 8 · 2⁻²².
const MARGIN: f64 = 1.0 / 524_288.0;

/// Marks a child that is a node.
const INNER: u32 = 1 << 31;

/// Eight boxes side by side, by axis, so that one operation asks all of them. The first [`Node::len`] slots are
/// filled, ascending along the longest axis of the node; an empty one has `lo = ∞` and `hi = −∞`, which no ray and no
/// frustum meets.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Node {
    /// Along x, y and z the smallest coordinates and the largest, [`MARGIN`] outside those of what stands there.
    sides: [[[f32; WIDE]; 2]; 3],
    /// Indices, with [`INNER`] where they are of nodes.
    children: [u32; WIDE],
    /// Bit `slot` is set where the child is a node.
    inner: u8,
    /// Bit `slot` is set where the child is a ball ([`BoundingSphere`]).
    round: u8,
    len: u8,
}

/// What stands in a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// A node, by its index in [`Bvh8::nodes`].
    Node(u32),
    /// An object, by its index in the assembly.
    Object(u32),
}

impl Child {
    #[inline]
    fn of(child: u32) -> Self {
        if child & INNER == 0 { Self::Object(child) } else { Self::Node(child & !INNER) }
    }
}

/// The largest number of single precision that is not above `x`.
#[inline(always)]
fn lower(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The smallest number of single precision that is not below `x`.
#[inline(always)]
fn upper(x: f64) -> f32 {
    -lower(-x)
}

impl Node {
    const EMPTY: Self = Self {
        sides: [[[f32::INFINITY; WIDE], [f32::NEG_INFINITY; WIDE]]; 3],
        children: [0; WIDE],
        inner: 0,
        round: 0,
        len: 0,
    };

    /// How many slots are filled.
    #[inline]
    pub fn len(&self) -> usize {
        usize::from(self.len)
    }

    /// Whether no slot is filled: only the root of no objects.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The lower and the upper sides of its boxes, by axis.
    #[inline(always)]
    pub fn sides<S: Simd>(&self, simd: S) -> ([f32x8<S>; 3], [f32x8<S>; 3]) {
        let [[lx, hx], [ly, hy], [lz, hz]] = &self.sides;
        (
            [f32x8::from_slice(simd, lx), f32x8::from_slice(simd, ly), f32x8::from_slice(simd, lz)],
            [f32x8::from_slice(simd, hx), f32x8::from_slice(simd, hy), f32x8::from_slice(simd, hz)],
        )
    }

    /// The lower and the upper corner of a slot's box.
    #[inline(always)]
    pub fn corners(&self, slot: usize) -> ([f32; 3], [f32; 3]) {
        let [[lx, hx], [ly, hy], [lz, hz]] = &self.sides;
        ([lx[slot], ly[slot], lz[slot]], [hx[slot], hy[slot], hz[slot]])
    }

    /// A bit for each slot in which a node stands.
    #[inline]
    pub fn inner(&self) -> u8 {
        self.inner
    }

    /// What stands in a slot, `slot < WIDE`; `None` where it is empty.
    #[inline]
    pub fn child(&self, slot: usize) -> Option<Child> {
        (slot < self.len()).then(|| Child::of(self.children[slot]))
    }

    /// The box of a slot.
    pub fn bounds(&self, slot: usize) -> Bounds {
        let (lo, hi) = self.corners(slot);
        Bounds::new(DVec3::from_array(lo.map(f64::from)), DVec3::from_array(hi.map(f64::from)))
    }

    fn push(&mut self, reach: &BuildPrimitive, child: Child) {
        let slot = self.len();
        for (axis, [lo, hi]) in self.sides.iter_mut().enumerate() {
            [lo[slot], hi[slot]] = reach.sides(axis);
        }
        match child {
            Child::Object(index) => {
                self.children[slot] = index;
                self.round |= u8::from(reach.is_round()) << slot;
            }
            Child::Node(index) => {
                self.children[slot] = index | INNER;
                self.inner |= 1 << slot;
            }
        }
        self.len += 1;
    }
}

/// Boxes around boxes over a whole scene.
#[derive(Clone, Debug)]
pub struct Bvh8 {
    /// The root is the first.
    nodes: Vec<Node>,
    /// What the processor can do.
    level: Level,
}

impl Bvh8 {
    /// Parts the objects of an assembly. Their boxes are padded by [`slack`], so that no ray that meets an object by
    /// its own computation misses the object's box by rounding.
    pub fn new(assembly: &Assembly) -> Self {
        let margin = DVec3::splat(slack(assembly.off));
        let objects = &assembly.objects;
        Self::over(objects.len(), |object| {
            let reach = BuildPrimitive::new(&objects[object].bounds.padded(margin), object as u32);
            if BoundingSphere::is_in(&reach, assembly) { reach.round() } else { reach }
        })
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

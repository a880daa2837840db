//! A node of the hierarchy: the boxes of up to eight children.

use fearless_simd::{Simd, SimdBase, f32x8};

use crate::math::{Bounds, DVec3};

use super::build_primitive::BuildPrimitive;

/// Children of a node: as many as the registers of most processors have numbers, of 32 bits each.
pub const WIDE: usize = 8;

/// Marks a child that is a node.
pub(super) const INNER: u32 = 1 << 31;

/// Eight boxes side by side, by axis, so that one operation tests all of them. The first [`Node::len`] slots
/// are filled, ascending along the longest axis of the node; an empty one has `lo = ∞` and `hi = −∞`, which
/// no ray and no frustum meets.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Node {
    /// Along x, y and z the smallest coordinates and the largest, [`MARGIN`](super::rounding::MARGIN) outside
    /// those of what stands there.
    pub(super) sides: [[[f32; WIDE]; 2]; 3],
    /// Indices, with [`INNER`] where they are of nodes.
    pub(super) children: [u32; WIDE],
    /// Bit `slot` is set where the child is a node.
    pub(super) inner: u8,
    /// Bit `slot` is set where the child is a ball that its box tells.
    pub(super) round: u8,
    pub(super) len: u8,
}

/// What stands in a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BvhChild {
    /// A node, by its index in [`Bvh8::nodes`](super::Bvh8::nodes).
    Node(u32),
    /// An object, by its index in the assembly.
    Object(u32),
}

impl BvhChild {
    #[inline]
    fn of(child: u32) -> Self {
        if child & INNER == 0 { Self::Object(child) } else { Self::Node(child & !INNER) }
    }
}

impl Node {
    pub(super) const EMPTY: Self = Self {
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
    pub fn child(&self, slot: usize) -> Option<BvhChild> {
        (slot < self.len()).then(|| BvhChild::of(self.children[slot]))
    }

    /// The box of a slot.
    pub fn bounds(&self, slot: usize) -> Bounds {
        let (lo, hi) = self.corners(slot);
        Bounds::new(DVec3::from_array(lo.map(f64::from)), DVec3::from_array(hi.map(f64::from)))
    }

    /// Whether the box of an object says all about its shape, as [`BuildPrimitive::round`] noted.
    #[inline(always)]
    pub fn is_round(&self, slot: usize) -> bool {
        self.round >> slot & 1 == 1
    }

    /// Numbers the objects in it from the length of `old` on, and appends the numbers that they had.
    pub(super) fn renumber(&mut self, old: &mut Vec<u32>) {
        for slot in 0..self.len() {
            if self.inner >> slot & 1 == 0 {
                let new = old.len() as u32;
                old.push(std::mem::replace(&mut self.children[slot], new));
            }
        }
    }

    /// Fills the next slot.
    pub(super) fn push(&mut self, reach: &BuildPrimitive, child: BvhChild) {
        let slot = self.len();
        for (axis, [lo, hi]) in self.sides.iter_mut().enumerate() {
            [lo[slot], hi[slot]] = reach.sides(axis);
        }
        match child {
            BvhChild::Object(index) => {
                self.children[slot] = index;
                self.round |= u8::from(reach.is_round()) << slot;
            }
            BvhChild::Node(index) => {
                self.children[slot] = index | INNER;
                self.inner |= 1 << slot;
            }
        }
        self.len += 1;
    }
}

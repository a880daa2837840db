//! Single rays through the hierarchy.

use std::ops::ControlFlow;

use fearless_simd::{Simd, SimdBase, SimdMask, f32x8};

use crate::math::{Ray, dispatch};

use super::Bvh8;
use super::node::{INNER, Node, WIDE};
use super::rounding::{lower, upper};

/// Nodes that a stack holds in place: at most seven more for each level of the tree, and one or two mostly.
pub(super) const STACK: usize = 64;

/// Nodes that are to be walked, the next one last. Those that came long before are kept on the heap.
struct NodeStack<T> {
    near: [T; STACK],
    /// At most [`STACK`].
    len: usize,
    before: Vec<T>,
}

impl<T: Copy> NodeStack<T> {
    #[inline(always)]
    fn new(none: T) -> Self {
        Self { near: [none; STACK], len: 0, before: Vec::new() }
    }

    /// Makes room for the children of a node.
    #[inline(always)]
    fn make_room(&mut self) {
        if self.len > STACK - WIDE {
            self.before.extend_from_slice(&self.near[..self.len]);
            self.len = 0;
        }
    }

    /// Adds both, or only the first, or none, without a branch, which no processor could predict. There is
    /// room.
    #[inline(always)]
    fn push(&mut self, both: [T; 2], count: u32) {
        self.near[self.len % STACK] = both[0];
        self.near[(self.len + 1) % STACK] = both[1];
        self.len += count.min(2) as usize;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<T> {
        match self.len.checked_sub(1) {
            Some(last) => {
                self.len = last;
                Some(self.near[last % STACK])
            }
            None => self.before.pop(),
        }
    }
}

/// A node that is to be walked.
#[derive(Clone, Copy)]
struct StackEntry {
    /// Where the ray enters its box, or before.
    from: f32,
    node: u32,
}

/// A ray in single precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayF32 {
    o: [f32; 3],
    /// 1 / d, and the largest number where that is larger.
    ///
    /// A difference of 0 times that is 0, so no product is not a number. Where it is too small, the padding
    /// is far enough: a box whose planes the ray lies between is entered before its start and left far behind
    /// its end, and one beside it is not.
    inverse: [f32; 3],
    /// Which of the two sides along each axis the ray comes to first.
    first: [u32; 3],
    from: f32,
}

impl RayF32 {
    #[inline(always)]
    pub fn new(ray: &Ray, from: f64) -> Self {
        let Ray { o, d } = *ray;
        Self {
            o: [o.x as f32, o.y as f32, o.z as f32],
            inverse: [inverse(d.x), inverse(d.y), inverse(d.z)],
            first: [u32::from(d.x < 0.0), u32::from(d.y < 0.0), u32::from(d.z < 0.0)],
            from: lower(from),
        }
    }
}

/// A ray as it is tested against eight boxes.
pub(super) struct RaySimd<S: Simd> {
    o: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    first: [u32; 3],
    from: f32x8<S>,
}

impl<S: Simd> RaySimd<S> {
    #[inline(always)]
    pub fn new(simd: S, ray: &RayF32) -> Self {
        // Not by `map`, nor by a closure, which are compiled by themselves, for any processor.
        let ([ox, oy, oz], [x, y, z]) = (ray.o, ray.inverse);
        Self {
            o: [f32x8::splat(simd, ox), f32x8::splat(simd, oy), f32x8::splat(simd, oz)],
            inverse: [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)],
            first: ray.first,
            from: f32x8::splat(simd, ray.from),
        }
    }

    /// Where the ray enters the boxes of a node before `to`, or before, and a bit for each that it meets.
    /// What rounding may do is in the boxes ([`MARGIN`](super::rounding::MARGIN)). Nothing here is not a
    /// number.
    #[inline(always)]
    pub fn meets(&self, simd: S, node: &Node, to: f32x8<S>) -> (f32x8<S>, u32) {
        let [near_x, far_x] = self.slab(simd, node, 0);
        let [near_y, far_y] = self.slab(simd, node, 1);
        let [near_z, far_z] = self.slab(simd, node, 2);
        let enter = near_x.max(near_y).max(near_z.max(self.from));
        let leave = far_x.min(far_y).min(far_z.min(to));
        (enter, enter.simd_le(leave).to_bitmask() as u32)
    }

    /// Between which distances the ray is between the two sides along an axis.
    #[inline(always)]
    fn slab(&self, simd: S, node: &Node, axis: usize) -> [f32x8<S>; 2] {
        let (sides, first) = (&node.sides[axis], self.first[axis] as usize);
        let (near, far) = (&sides[first & 1], &sides[(first & 1) ^ 1]);
        let (o, inverse) = (self.o[axis], self.inverse[axis]);
        [(f32x8::from_slice(simd, near) - o) * inverse, (f32x8::from_slice(simd, far) - o) * inverse]
    }
}

/// 1 / d, where that is a number of single precision.
#[inline(always)]
fn inverse(d: f64) -> f32 {
    if d == 0.0 { f32::MAX } else { (d.recip() as f32).clamp(f32::MIN, f32::MAX) }
}

/// The first two slots among the bits, any where there are fewer, and the bits of the others.
#[inline(always)]
pub(super) fn first_two(bits: u32) -> ([usize; 2], u32) {
    let others = bits & bits.wrapping_sub(1);
    let slots = [bits.trailing_zeros() as usize % WIDE, others.trailing_zeros() as usize % WIDE];
    (slots, others & others.wrapping_sub(1))
}

/// What becomes of the boxes that a single ray meets. A closure is a visitor that does not care for nodes.
pub trait BoxVisitor<B> {
    /// Takes a node that the ray comes into at `from`, or behind that.
    #[inline(always)]
    fn enter(&mut self, from: f64) {
        let _ = from;
    }

    /// Takes an object whose box the ray comes into at `from`, or behind that. Returns how far the ray still
    /// matters, or breaks the walk off. Not to be inlined, so that what it does is not compiled for every
    /// kind of processor.
    fn visit(&mut self, object: u32, from: f64) -> ControlFlow<B, f64>;
}

impl<B, F: FnMut(u32, f64) -> ControlFlow<B, f64>> BoxVisitor<B> for F {
    #[inline(never)]
    fn visit(&mut self, object: u32, from: f64) -> ControlFlow<B, f64> {
        self(object, from)
    }
}

impl Bvh8 {
    /// Visits each object whose box the ray meets between `from` and `to`, until that breaks; of the nodes in
    /// a node the nearest first. Boxes that begin beyond what still matters are not visited.
    pub fn walk<B>(&self, ray: &Ray, from: f64, to: f64, visitor: &mut impl BoxVisitor<B>) -> Option<B> {
        dispatch!(self.level, simd => walk_nearest(simd, &self.nodes, ray, &Range { from, to }, visitor))
    }

    /// Visits each object whose box the ray meets before `to`, in no order, until that breaks. How far the
    /// ray still matters is not asked.
    pub fn walk_any<B>(&self, ray: &Ray, to: f64, visitor: &mut impl BoxVisitor<B>) -> Option<B> {
        let range = &Range { from: 0.0, to };
        dispatch!(self.level, simd => walk_unordered(simd, &self.nodes, ray, range, visitor))
    }

    /// Visits each object whose box the whole line of the ray meets, before its start too, in no order, until
    /// that breaks. How far the line still matters is not asked.
    pub fn walk_line<B>(&self, ray: &Ray, visitor: &mut impl BoxVisitor<B>) -> Option<B> {
        let range = &Range { from: f64::NEG_INFINITY, to: f64::INFINITY };
        dispatch!(self.level, simd => walk_unordered(simd, &self.nodes, ray, range, visitor))
    }
}

/// Part of a ray.
struct Range {
    from: f64,
    to: f64,
}

#[inline(always)]
fn walk_nearest<S: Simd, B>(
    simd: S,
    nodes: &[Node],
    ray: &Ray,
    &Range { from, to }: &Range,
    visitor: &mut impl BoxVisitor<B>,
) -> Option<B> {
    let ray = RaySimd::new(simd, &RayF32::new(ray, from));
    let mut end = upper(to);
    let mut stack = NodeStack::new(StackEntry { from: 0.0, node: 0 });
    let mut next = StackEntry { from: lower(from), node: 0 };
    loop {
        if next.from <= end {
            visitor.enter(f64::from(next.from));
            let node = &nodes[next.node as usize];
            let (enter, met) = ray.meets(simd, node, f32x8::splat(simd, end));
            let enter: [f32; WIDE] = enter.into();
            let mut objects = met & !u32::from(node.inner);
            while objects != 0 {
                let slot = objects.trailing_zeros() as usize % WIDE;
                objects &= objects - 1;
                if enter[slot] <= end {
                    match visitor.visit(node.children[slot], f64::from(enter[slot])) {
                        ControlFlow::Break(value) => return Some(value),
                        ControlFlow::Continue(farthest) => end = upper(farthest),
                    }
                }
            }
            push_nearest_last(&mut stack, node, &enter, met & u32::from(node.inner));
        }
        next = stack.pop()?;
    }
}

/// Pushes the nodes among a node's children that were met, the nearest last.
#[inline(always)]
fn push_nearest_last(stack: &mut NodeStack<StackEntry>, node: &Node, enter: &[f32; WIDE], met: u32) {
    stack.make_room();
    let first = stack.len;
    let (slots, mut rest) = first_two(met);
    let count = met.count_ones();
    let a = StackEntry { from: enter[slots[0]], node: node.children[slots[0]] & !INNER };
    let b = StackEntry { from: enter[slots[1]], node: node.children[slots[1]] & !INNER };
    let both = if count > 1 && a.from < b.from { [b, a] } else { [a, b] };
    stack.push(both, count);
    while rest != 0 {
        let slot = rest.trailing_zeros() as usize % WIDE;
        rest &= rest - 1;
        let from = enter[slot];
        let mut place = stack.len % STACK;
        while place > first && stack.near[place - 1].from < from {
            stack.near[place] = stack.near[place - 1];
            place -= 1;
        }
        stack.near[place] = StackEntry { from, node: node.children[slot] & !INNER };
        stack.len += 1;
    }
}

#[inline(always)]
fn walk_unordered<S: Simd, B>(
    simd: S,
    nodes: &[Node],
    ray: &Ray,
    &Range { from, to }: &Range,
    visitor: &mut impl BoxVisitor<B>,
) -> Option<B> {
    let ray = RaySimd::new(simd, &RayF32::new(ray, from));
    let end = f32x8::splat(simd, upper(to));
    let mut stack = NodeStack::new(0);
    let mut next = Some(0);
    while let Some(first) = next {
        // Two at once take little longer than one: each step of a test depends on the one before it.
        let second = stack.pop();
        let two = [&nodes[first as usize], &nodes[second.unwrap_or(first) as usize]];
        let (_, met) = ray.meets(simd, two[0], end);
        let (_, also_met) = ray.meets(simd, two[1], end);
        visitor.enter(0.0);
        if second.is_some() {
            visitor.enter(0.0);
        }
        let met = [met, if second.is_some() { also_met } else { 0 }];
        for k in 0..2 {
            let mut objects = met[k] & !u32::from(two[k].inner);
            while objects != 0 {
                let slot = objects.trailing_zeros() as usize % WIDE;
                objects &= objects - 1;
                if let ControlFlow::Break(value) = visitor.visit(two[k].children[slot], 0.0) {
                    return Some(value);
                }
            }
        }
        for k in 0..2 {
            let (node, met) = (two[k], met[k] & u32::from(two[k].inner));
            stack.make_room();
            let ([a, b], mut rest) = first_two(met);
            stack.push([node.children[a] & !INNER, node.children[b] & !INNER], met.count_ones());
            while rest != 0 {
                let slot = rest.trailing_zeros() as usize % WIDE;
                rest &= rest - 1;
                stack.push([node.children[slot] & !INNER, 0], 1);
            }
        }
        next = stack.pop();
    }
    None
}

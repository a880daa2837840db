//! Single rays through the hierarchy, nearest boxes first.

use std::ops::ControlFlow;

use fearless_simd::{Select, Simd, SimdBase, dispatch, f64x8};

use crate::math::Ray;

use super::super::planes::Step;
use super::{Boxes, Child, Node, WIDE};

/// Boxes that may wait in place: at most seven more wait for each node on the way down, and two or three mostly.
const WAITING: usize = 48;

/// What a ray may enter.
#[derive(Clone, Copy)]
struct Box {
    /// Where it does.
    from: f64,
    child: Child,
}

impl Box {
    /// All bits are 0, which is the fastest to write.
    const NONE: Self = Self { from: 0.0, child: Child::Node(0) };
}

/// Boxes that wait, the nearest of each node last. Those past [`WAITING`] have memory of their own.
struct Waiting {
    near: [Box; WAITING],
    len: usize,
    more: Vec<Box>,
}

impl Waiting {
    fn new() -> Self {
        Self { near: [Box::NONE; WAITING], len: 0, more: Vec::new() }
    }

    #[inline(always)]
    fn push(&mut self, waits: Box) {
        if let Some(place) = self.near.get_mut(self.len) {
            *place = waits;
            self.len += 1;
        } else {
            self.more.push(waits);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Box> {
        if self.len == WAITING
            && let Some(last) = self.more.pop()
        {
            return Some(last);
        }
        self.len = self.len.checked_sub(1)?;
        self.near.get(self.len).copied()
    }
}

/// A ray as the boxes are asked about it.
struct Asked<S: Simd> {
    o: [f64x8<S>; 3],
    /// 1 / d, and the largest number where the ray runs along an axis' planes.
    ///
    /// A difference of 0 times that is 0, so no product is not a number: a box whose planes the ray lies between is
    /// entered before its start and left far behind its end, and one beside it is not. Only on a plane either may come out,
    /// and rounding: the padding, at least 256 ulps of 1, is far more than that.
    inverse: [f64x8<S>; 3],
    upward: [bool; 3],
}

impl<S: Simd> Asked<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray) -> Self {
        let Ray { o, d } = *ray;
        let inverse = |d: f64| if d == 0.0 { f64::MAX } else { d.recip() };
        let [x, y, z] = [inverse(d.x), inverse(d.y), inverse(d.z)];
        // Not by `map`, which is compiled by itself, for any processor.
        Self {
            o: [f64x8::splat(simd, o.x), f64x8::splat(simd, o.y), f64x8::splat(simd, o.z)],
            inverse: [f64x8::splat(simd, x), f64x8::splat(simd, y), f64x8::splat(simd, z)],
            upward: [d.x >= 0.0, d.y >= 0.0, d.z >= 0.0],
        }
    }

    /// Where the ray enters the boxes of a node between `from` and `to`, and a bit for each that it meets.
    ///
    /// A distance is rounded three times, which is as if the plane stood elsewhere by less than two
    /// [`f64::EPSILON`] of its distance from the ray's start, at most 16 ulps of 1. The boxes are padded by more.
    #[inline(always)]
    fn meets(&self, simd: S, node: &Node, from: f64, to: f64) -> (f64x8<S>, u64) {
        let mut enter = f64x8::splat(simd, from);
        let mut leave = f64x8::splat(simd, to);
        for axis in 0..3 {
            let (near, far) = if self.upward[axis] {
                (&node.lo[axis], &node.hi[axis])
            } else {
                (&node.hi[axis], &node.lo[axis])
            };
            let near = (f64x8::from_slice(simd, near) - self.o[axis]) * self.inverse[axis];
            let far = (f64x8::from_slice(simd, far) - self.o[axis]) * self.inverse[axis];
            enter = near.simd_gt(enter).select(near, enter);
            leave = far.simd_lt(leave).select(far, leave);
        }
        (enter, fearless_simd::SimdMask::to_bitmask(enter.simd_le(leave)))
    }
}

impl Boxes {
    /// Calls `visit` with each object whose box the ray meets between `from` and `to`, until it breaks; nearest first
    /// among the boxes of a node. `visit` returns how far the ray still matters: boxes that begin beyond that are not
    /// visited. [`Step::from`] is where the ray enters the object's box, or before; [`Step::to`] how far it matters.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        cells_visited: &mut u64,
        mut visit: impl FnMut(&[u32], Step) -> ControlFlow<B, f64>,
    ) -> Option<B> {
        // Behind a pointer, so that not all that a visit does is compiled for every kind of processor.
        let visit: &mut Visit<B> = &mut visit;
        dispatch!(self.level, simd => walked(simd, &self.nodes, ray, [from, to], cells_visited, visit))
    }
}

type Visit<'a, B> = dyn FnMut(&[u32], Step) -> ControlFlow<B, f64> + 'a;

#[inline(always)]
fn walked<S: Simd, B>(
    simd: S,
    nodes: &[Node],
    ray: &Ray,
    [from, mut to]: [f64; 2],
    cells_visited: &mut u64,
    visit: &mut Visit<B>,
) -> Option<B> {
    let asked = Asked::new(simd, ray);
    let mut waiting = Waiting::new();
    let mut next = Some(Box { from, child: Child::Node(0) });
    while let Some(Box { from: enters, child }) = next {
        if enters > to {
            next = waiting.pop();
            continue;
        }
        match child {
            Child::Object(object) => {
                match visit(&[object], Step { cell: object as usize, from: enters, to }) {
                    ControlFlow::Break(value) => return Some(value),
                    ControlFlow::Continue(farthest) => to = farthest,
                }
                next = waiting.pop();
            }
            Child::Node(index) => {
                *cells_visited += 1;
                let node = &nodes[index as usize];
                let (enter, met) = asked.meets(simd, node, from, to);
                next = sorted(node, &enter.into(), met, &mut waiting);
            }
        }
    }
    None
}

/// Puts the boxes that are met with those that wait, the nearest last, which is returned instead: the next one of all.
#[inline(always)]
fn sorted(node: &Node, enter: &[f64; WIDE], mut met: u64, waiting: &mut Waiting) -> Option<Box> {
    let mut taken = [(0.0, 0_usize); WIDE];
    let mut len = 0;
    while met != 0 {
        let slot = (met.trailing_zeros() as usize) & (WIDE - 1);
        met &= met - 1;
        let from = enter[slot];
        // Few are met: they are sorted as they come, the farthest first.
        let mut place = len;
        while place > 0 && taken[place - 1].0 <= from {
            taken[place] = taken[place - 1];
            place -= 1;
        }
        taken[place] = (from, slot);
        len += 1;
    }
    let Some(last) = len.checked_sub(1) else { return waiting.pop() };
    for &(from, slot) in &taken[..last] {
        waiting.push(Box { from, child: node.filled(slot) });
    }
    let (from, slot) = taken[last];
    Some(Box { from, child: node.filled(slot) })
}

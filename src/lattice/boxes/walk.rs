//! Single rays through the hierarchy, nearest boxes first.

use std::ops::ControlFlow;

use fearless_simd::{Select, Simd, SimdBase, SimdMask, dispatch, f32x8};

use crate::math::Ray;

use super::super::planes::Step;
use super::{Boxes, Child, INNER, Node, WIDE};

/// Boxes that may wait in place: at most seven more wait for each node on the way down, and two or three mostly.
const WAITING: usize = 64;

/// What a ray may enter.
#[derive(Clone, Copy)]
struct Box {
    /// Where it does, or before.
    from: f32,
    /// As [`Node::children`].
    child: u32,
}

impl Box {
    /// All bits are 0, which is the fastest to write.
    const NONE: Self = Self { from: 0.0, child: 0 };
}

/// Boxes that wait, the nearest of each node last. Those that came long before have memory of their own.
struct Waiting {
    near: [Box; WAITING],
    /// At most [`WAITING`].
    len: usize,
    before: Vec<Box>,
}

impl Waiting {
    #[inline(always)]
    fn new() -> Self {
        Self { near: [Box::NONE; WAITING], len: 0, before: Vec::new() }
    }

    /// Makes room for the boxes of a node.
    #[inline(always)]
    fn make_room(&mut self) {
        if self.len > WAITING - WIDE {
            self.before.extend_from_slice(&self.near[..self.len]);
            self.len = 0;
        }
    }

    /// Adds a box of the node whose first one was added at `first`. There is room.
    #[inline(always)]
    fn push(&mut self, waits: Box, first: usize) {
        let mut place = self.len % WAITING;
        while place > first && self.near[place - 1].from < waits.from {
            self.near[place] = self.near[place - 1];
            place -= 1;
        }
        self.near[place] = waits;
        self.len += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Box> {
        match self.len.checked_sub(1) {
            Some(last) => {
                self.len = last;
                Some(self.near[last % WAITING])
            }
            None => self.before.pop(),
        }
    }
}

/// A ray as the boxes are asked about it.
struct Asked<S: Simd> {
    o: [f32x8<S>; 3],
    /// 1 / d, and the largest number where that is larger.
    ///
    /// A difference of 0 times that is 0, so no product is not a number. Where it is too small, the padding is far enough:
    /// a box whose planes the ray lies between is entered before its start and left far behind its end, and one beside it
    /// is not.
    inverse: [f32x8<S>; 3],
    upward: [bool; 3],
}

impl<S: Simd> Asked<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray) -> Self {
        let Ray { o, d } = *ray;
        // Not by `map`, nor by a closure, which are compiled by themselves, for any processor.
        let [x, y, z] = [inverse(d.x), inverse(d.y), inverse(d.z)];
        Self {
            o: [
                f32x8::splat(simd, o.x as f32),
                f32x8::splat(simd, o.y as f32),
                f32x8::splat(simd, o.z as f32),
            ],
            inverse: [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)],
            upward: [d.x >= 0.0, d.y >= 0.0, d.z >= 0.0],
        }
    }

    /// Where the ray enters the boxes of a node between `from` and `to`, or before, and a bit for each that it meets.
    /// What rounding may do is in the boxes ([`MARGIN`](super::MARGIN)).
    #[inline(always)]
    fn meets(&self, simd: S, node: &Node, from: f32, to: f32) -> (f32x8<S>, u64) {
        let mut enter = f32x8::splat(simd, from);
        let mut leave = f32x8::splat(simd, to);
        for axis in 0..3 {
            let (near, far) = if self.upward[axis] {
                (&node.lo[axis], &node.hi[axis])
            } else {
                (&node.hi[axis], &node.lo[axis])
            };
            let near = (f32x8::from_slice(simd, near) - self.o[axis]) * self.inverse[axis];
            let far = (f32x8::from_slice(simd, far) - self.o[axis]) * self.inverse[axis];
            enter = near.simd_gt(enter).select(near, enter);
            leave = far.simd_lt(leave).select(far, leave);
        }
        (enter, enter.simd_le(leave).to_bitmask())
    }
}

/// 1 / d, where that is a number of half the digits.
#[inline(always)]
fn inverse(d: f64) -> f32 {
    if d == 0.0 { f32::MAX } else { (d.recip() as f32).clamp(f32::MIN, f32::MAX) }
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
        mut visit: impl FnMut(u32, Step) -> ControlFlow<B, f64>,
    ) -> Option<B> {
        // Behind a pointer, so that not all that a visit does is compiled for every kind of processor.
        let visit: &mut Visit<B> = &mut visit;
        dispatch!(self.level, simd => walked(simd, &self.nodes, ray, [from, to], cells_visited, visit))
    }
}

type Visit<'a, B> = dyn FnMut(u32, Step) -> ControlFlow<B, f64> + 'a;

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
    let start = super::lower(from);
    let mut visited = 0;
    let mut waiting = Waiting::new();
    let mut next = Box { from: start, child: INNER };
    let mut end = -super::lower(-to);
    let found = loop {
        if next.from <= end {
            match Child::of(next.child) {
                Child::Object(object) => {
                    let step = Step { cell: object as usize, from: f64::from(next.from), to };
                    match visit(object, step) {
                        ControlFlow::Break(value) => break Some(value),
                        ControlFlow::Continue(farthest) => {
                            to = farthest;
                            end = -super::lower(-to);
                        }
                    }
                }
                Child::Node(index) => {
                    visited += 1;
                    let node = &nodes[index as usize];
                    let (enter, met) = asked.meets(simd, node, start, end);
                    if met != 0 {
                        next = nearest(node, &enter.into(), met, &mut waiting);
                        continue;
                    }
                }
            }
        }
        let Some(last) = waiting.pop() else { break None };
        next = last;
    };
    *cells_visited += visited;
    found
}

/// The nearest of the boxes that are met, one at least. The others wait, the nearest last.
#[inline(always)]
fn nearest(node: &Node, enter: &[f32; WIDE], met: u64, waiting: &mut Waiting) -> Box {
    waiting.make_room();
    let first = waiting.len;
    let slot = met.trailing_zeros() as usize % WIDE;
    let mut nearest = Box { from: enter[slot], child: node.children[slot] };
    let mut rest = met & (met - 1);
    while rest != 0 {
        let slot = rest.trailing_zeros() as usize % WIDE;
        rest &= rest - 1;
        let mut waits = Box { from: enter[slot], child: node.children[slot] };
        if waits.from < nearest.from {
            std::mem::swap(&mut waits, &mut nearest);
        }
        waiting.push(waits, first);
    }
    nearest
}

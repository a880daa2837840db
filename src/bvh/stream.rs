//! Incoherent rays through the hierarchy, many under way at once.
//!
//! A single ray stalls: on the memory of the node that it is tested against next, and on branches that no
//! processor can predict. So each of many takes one step in its turn, and the others' steps fill the stalls
//! of one.

use fearless_simd::{Simd, SimdBase, f32x8};

use crate::math::{Ray, dispatch};

use super::Bvh8;
use super::node::{INNER, Node, WIDE};
use super::rounding::upper;
use super::walk::{RayF32, RaySimd, STACK, first_two};

/// Rays that are under way at once: their stacks have room in the nearest cache.
const ABREAST: usize = 24;

/// A ray and an object whose box it meets.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// By its number among the rays.
    pub ray: u32,
    /// By its index in the assembly.
    pub object: u32,
    /// Where the ray enters the box, or before.
    pub near: f32,
}

/// The rays, and how far away what each meets may be to matter.
#[derive(Debug, Default)]
pub struct StreamRays {
    rays: Vec<RayF32>,
    ends: Vec<f32>,
}

/// Rays, and the memory of their walk, used again for the next.
#[derive(Debug, Default)]
pub struct Stream {
    rays: StreamRays,
    walkers: Vec<Walker>,
    steps: Steps,
    met: Vec<Candidate>,
}

/// A ray that is under way.
#[derive(Debug)]
struct Walker {
    ray: u32,
    node: u32,
    /// Behind a pointer: the last takes the place of one that is done.
    stack: Box<NodeStack>,
}

/// What each ray that is under way meets in the next step: where it enters each box, and a bit for each.
#[derive(Debug, Default)]
struct Steps {
    enter: [[f32; WIDE]; ABREAST],
    met: [u32; ABREAST],
}

/// A node that is to be walked by a ray, which enters its box at a distance of 0 or more, or before: the bits
/// of that distance above those of the index, so that of two the smaller is the nearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PackedNode(u64);

impl PackedNode {
    /// Farther than all nodes, and beyond the end of any ray: its distance is not a number.
    const NONE: Self = Self(u64::MAX);

    #[inline(always)]
    fn new(from: f32, child: u32) -> Self {
        Self(u64::from(from.to_bits()) << 32 | u64::from(child & !INNER))
    }

    #[inline(always)]
    fn from(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    fn node(self) -> u32 {
        self.0 as u32
    }
}

/// The nodes that are to be walked by one ray, the next one last; the lowest stands for none.
#[derive(Debug)]
struct NodeStack {
    near: [PackedNode; STACK],
    /// At least 1, at most [`STACK`].
    len: usize,
    /// Those that came long before.
    before: Vec<PackedNode>,
}

impl NodeStack {
    const EMPTY: Self = Self { near: [PackedNode::NONE; STACK], len: 1, before: Vec::new() };

    /// Pushes the nodes among a node's children that a ray meets, and pops the nearest of them, or the last
    /// of the stack where it meets none. The only branch is whether there are more than two: no other could
    /// be predicted.
    #[inline(always)]
    fn step(&mut self, node: &Node, enter: &[f32; WIDE], met: u32) -> PackedNode {
        if self.len > STACK - WIDE {
            self.before.extend_from_slice(&self.near[1..self.len]);
            self.len = 1;
        }
        let (slots, mut rest) = first_two(met);
        let count = met.count_ones();
        let a = PackedNode::new(enter[slots[0]], node.children[slots[0]]);
        let b = PackedNode::new(enter[slots[1]], node.children[slots[1]]);
        let b = if count > 1 { b } else { PackedNode::NONE };
        let mut nearest = a.min(b);
        self.near[self.len % STACK] = a.max(b);
        self.len += usize::from(count > 1);
        while rest != 0 {
            let slot = rest.trailing_zeros() as usize % WIDE;
            rest &= rest - 1;
            let c = PackedNode::new(enter[slot], node.children[slot]);
            self.near[self.len % STACK] = nearest.max(c);
            self.len += 1;
            nearest = nearest.min(c);
        }
        let last = self.near[(self.len - 1) % STACK];
        self.len -= usize::from(count == 0);
        if count == 0 { last } else { nearest }
    }

    /// Pops the last node; none where the stack is empty.
    #[inline]
    fn pop(&mut self) -> PackedNode {
        if self.len > 1 {
            self.len -= 1;
            self.near[self.len % STACK]
        } else {
            self.len = 1;
            self.before.pop().unwrap_or(PackedNode::NONE)
        }
    }
}

impl StreamRays {
    /// How many rays there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Sets how far away what a ray meets may be to matter; below 0 where nothing matters any more.
    #[inline]
    pub fn limit(&mut self, ray: u32, to: f64) {
        self.ends[ray as usize] = upper(to);
    }

    /// Whether a candidate still matters.
    #[inline]
    pub fn matters(&self, candidate: &Candidate) -> bool {
        candidate.near <= self.ends[candidate.ray as usize]
    }
}

impl Stream {
    /// Takes all rays out.
    #[inline]
    pub fn clear(&mut self) {
        self.rays.rays.clear();
        self.rays.ends.clear();
    }

    /// Adds a ray that meets nothing that matters beyond `to`.
    #[inline(always)]
    pub fn push(&mut self, ray: &Ray, to: f64) {
        self.rays.rays.push(RayF32::new(ray, 0.0));
        self.rays.ends.push(upper(to));
    }

    /// The rays.
    #[inline]
    pub fn rays(&self) -> &StreamRays {
        &self.rays
    }
}

impl Bvh8 {
    /// Calls `visit` again and again with some rays and the objects whose boxes they meet, each pair once, of
    /// one ray the nearer nodes first; at last with none. `visit` says by [`StreamRays::limit`] how far a ray
    /// still matters.
    #[inline]
    pub fn walk_stream(
        &self,
        stream: &mut Stream,
        cells_visited: &mut u64,
        visit: &mut dyn FnMut(&[Candidate], &mut StreamRays),
    ) {
        dispatch!(self.level, simd => walk_all(simd, &self.nodes, stream, cells_visited, visit));
    }
}

#[inline(always)]
fn walk_all<S: Simd>(
    simd: S,
    nodes: &[Node],
    Stream { rays: all, walkers, steps, met }: &mut Stream,
    cells_visited: &mut u64,
    visit: &mut dyn FnMut(&[Candidate], &mut StreamRays),
) {
    let rays = all.len() as u32;
    let mut started = rays.min(ABREAST as u32);
    let mut active = started as usize;
    while walkers.len() < active {
        walkers.push(Walker { ray: 0, node: 0, stack: Box::new(NodeStack::EMPTY) });
    }
    for (ray, walker) in walkers.iter_mut().enumerate().take(active) {
        (walker.ray, walker.node) = (ray as u32, 0);
    }
    met.resize(ABREAST * WIDE, Candidate { ray: 0, object: 0, near: 0.0 });
    while active != 0 {
        *cells_visited += active as u64;
        // All nodes are tested before anything depends on a result, so that their memory is fetched at once.
        for (k, Walker { ray, node, .. }) in walkers[..active].iter().enumerate() {
            let (ray, end) = (&all.rays[*ray as usize], all.ends[*ray as usize]);
            let here = &nodes[*node as usize];
            let (enter, met) = RaySimd::new(simd, ray).meets(simd, here, f32x8::splat(simd, end));
            enter.store_slice(&mut steps.enter[k]);
            steps.met[k] = met;
        }
        let mut count = 0;
        let mut k = 0;
        while k < active {
            let Walker { ray, node, stack } = &mut walkers[k];
            let end = all.ends[*ray as usize];
            let here = &nodes[*node as usize];
            let (enter, bits) = (&steps.enter[k], steps.met[k]);
            let objects = bits & !u32::from(here.inner);
            // The first two are written whether they are there or not.
            let (slots, mut rest) = first_two(objects);
            let place = &mut met[count..count + WIDE];
            for (to, slot) in place.iter_mut().zip(slots) {
                *to = Candidate { ray: *ray, object: here.children[slot], near: enter[slot] };
            }
            let mut next = 2;
            while rest != 0 {
                let slot = rest.trailing_zeros() as usize % WIDE;
                rest &= rest - 1;
                place[next % WIDE] = Candidate { ray: *ray, object: here.children[slot], near: enter[slot] };
                next += 1;
            }
            count += objects.count_ones() as usize;
            let mut next_node = stack.step(here, enter, bits & u32::from(here.inner));
            k += 1;
            if next_node.from() <= end {
                *node = next_node.node();
                continue;
            }
            // Seldom: the next node lies behind what the ray met, or there is none.
            stack.len = stack.len.max(1);
            loop {
                next_node = stack.pop();
                if next_node.from() <= end || next_node == PackedNode::NONE {
                    break;
                }
            }
            if next_node != PackedNode::NONE {
                *node = next_node.node();
            } else if started < rays {
                (*ray, *node) = (started, 0);
                started += 1;
            } else {
                k -= 1;
                active -= 1;
                walkers.swap(k, active);
                // The last has taken this one's place.
                steps.enter[k] = steps.enter[active];
                steps.met[k] = steps.met[active];
            }
        }
        if count != 0 {
            visit(&met[..count], all);
        }
    }
    visit(&[], all);
}

//! Rays without reordering through the hierarchy, many on their way at once.
//!
//! A single ray waits: for the node that it asks next, and for the processor, which can not guess what it meets. So each
//! of many takes one step in its turn, and what one waits for the others do meanwhile.

use fearless_simd::{Simd, SimdBase, dispatch, f32x8};

use crate::math::Ray;

use super::walk::{RayF32, RaySimd, WAITING, first_two};
use super::{Bvh8, INNER, Node, WIDE, upper};

/// Rays that are on their way at once: what waits for them has room in the nearest memory.
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

/// The rays, and how far each still looks.
#[derive(Debug, Default)]
pub struct StreamRays {
    ways: Vec<RayF32>,
    ends: Vec<f32>,
}

/// Rays, and the memory of their walk, used again for the next.
#[derive(Debug, Default)]
pub struct Stream {
    ways: StreamRays,
    walkers: Vec<Walker>,
    steps: Steps,
    met: Vec<Candidate>,
}

/// One of those that are on their way.
#[derive(Debug)]
struct Walker {
    ray: u32,
    node: u32,
    /// Behind a pointer: the last takes the place of one that is done.
    waiting: Box<Waiting>,
}

/// What each of those that are on their way meets in the next step: where it enters each box, and a bit for each.
#[derive(Debug, Default)]
struct Steps {
    enter: [[f32; WIDE]; ABREAST],
    met: [u32; ABREAST],
}

/// A node that waits for a ray, which enters its box at a distance of 0 or more, or before: the bits of that distance
/// above those of the index, so that of two the smaller is the nearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Ahead(u64);

impl Ahead {
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

/// The nodes that wait for one ray, the next one last; below them there is none.
#[derive(Debug)]
struct Waiting {
    near: [Ahead; WAITING],
    /// At least 1, at most [`WAITING`].
    len: usize,
    /// Those that came long before.
    before: Vec<Ahead>,
}

impl Waiting {
    const NOTHING: Self = Self { near: [Ahead::NONE; WAITING], len: 1, before: Vec::new() };

    /// Of the nodes among a node's children that a ray meets the nearest, or what waited for it; the others wait. What it
    /// meets is known by chance only, so that nothing is asked here but whether there are more than two.
    #[inline(always)]
    fn step(&mut self, node: &Node, enter: &[f32; WIDE], met: u32) -> Ahead {
        if self.len > WAITING - WIDE {
            self.before.extend_from_slice(&self.near[1..self.len]);
            self.len = 1;
        }
        let (slots, mut rest) = first_two(met);
        let count = met.count_ones();
        let a = Ahead::new(enter[slots[0]], node.children[slots[0]]);
        let b = Ahead::new(enter[slots[1]], node.children[slots[1]]);
        let b = if count > 1 { b } else { Ahead::NONE };
        let mut nearest = a.min(b);
        self.near[self.len % WAITING] = a.max(b);
        self.len += usize::from(count > 1);
        while rest != 0 {
            let slot = rest.trailing_zeros() as usize % WIDE;
            rest &= rest - 1;
            let c = Ahead::new(enter[slot], node.children[slot]);
            self.near[self.len % WAITING] = nearest.max(c);
            self.len += 1;
            nearest = nearest.min(c);
        }
        let last = self.near[(self.len - 1) % WAITING];
        self.len -= usize::from(count == 0);
        if count == 0 { last } else { nearest }
    }

    /// The last that waits, none where nothing does.
    #[inline]
    fn pop(&mut self) -> Ahead {
        if self.len > 1 {
            self.len -= 1;
            self.near[self.len % WAITING]
        } else {
            self.len = 1;
            self.before.pop().unwrap_or(Ahead::NONE)
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
    /// Forgets all rays.
    #[inline]
    pub fn clear(&mut self) {
        self.ways.ways.clear();
        self.ways.ends.clear();
    }

    /// One more ray, that looks as far as `to`.
    #[inline(always)]
    pub fn push(&mut self, ray: &Ray, to: f64) {
        self.ways.ways.push(RayF32::new(ray, 0.0));
        self.ways.ends.push(upper(to));
    }

    /// The rays.
    #[inline]
    pub fn ways(&self) -> &StreamRays {
        &self.ways
    }
}

impl Bvh8 {
    /// Calls `visit` again and again with some rays and the objects whose boxes they meet, each pair once, of one ray the
    /// nearer nodes first; at last with none. `visit` says by [`StreamRays::limit`] how far a ray still matters.
    #[inline]
    pub fn walk_stream(
        &self,
        stream: &mut Stream,
        cells_visited: &mut u64,
        visit: &mut dyn FnMut(&[Candidate], &mut StreamRays),
    ) {
        dispatch!(self.level, simd => walked(simd, &self.nodes, stream, cells_visited, visit));
    }
}

#[inline(always)]
fn walked<S: Simd>(
    simd: S,
    nodes: &[Node],
    Stream { ways, walkers, steps, met }: &mut Stream,
    cells_visited: &mut u64,
    visit: &mut dyn FnMut(&[Candidate], &mut StreamRays),
) {
    let rays = ways.len() as u32;
    let mut started = rays.min(ABREAST as u32);
    let mut active = started as usize;
    while walkers.len() < active {
        walkers.push(Walker { ray: 0, node: 0, waiting: Box::new(Waiting::NOTHING) });
    }
    for (ray, walker) in walkers.iter_mut().enumerate().take(active) {
        (walker.ray, walker.node) = (ray as u32, 0);
    }
    met.resize(ABREAST * WIDE, Candidate { ray: 0, object: 0, near: 0.0 });
    while active != 0 {
        *cells_visited += active as u64;
        // All nodes are asked before anything depends on an answer, so that none waits for the memory of another.
        for (k, Walker { ray, node, .. }) in walkers[..active].iter().enumerate() {
            let (way, end) = (&ways.ways[*ray as usize], ways.ends[*ray as usize]);
            let here = &nodes[*node as usize];
            let (enter, met) = RaySimd::new(simd, way).meets(simd, here, f32x8::splat(simd, end));
            enter.store_slice(&mut steps.enter[k]);
            steps.met[k] = met;
        }
        let mut count = 0;
        let mut k = 0;
        while k < active {
            let Walker { ray, node, waiting } = &mut walkers[k];
            let end = ways.ends[*ray as usize];
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
            let mut ahead = waiting.step(here, enter, bits & u32::from(here.inner));
            k += 1;
            if ahead.from() <= end {
                *node = ahead.node();
                continue;
            }
            // Seldom: what waits lies behind what the ray met, or nothing does.
            waiting.len = waiting.len.max(1);
            loop {
                ahead = waiting.pop();
                if ahead.from() <= end || ahead == Ahead::NONE {
                    break;
                }
            }
            if ahead != Ahead::NONE {
                *node = ahead.node();
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
            visit(&met[..count], ways);
        }
    }
    visit(&[], ways);
}

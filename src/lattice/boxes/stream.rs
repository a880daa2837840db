//! Rays without company through the hierarchy, many on their way at once.
//!
//! A single ray waits: for the node that it asks next, and for the processor, which can not guess what it meets. So each
//! of many takes one step in its turn, and what one waits for the others do meanwhile.

use fearless_simd::{Simd, SimdBase, dispatch, f32x8};

use crate::math::Ray;

use super::walk::{Ahead, Asked, Waiting, Way, first_two, push_nearest_last};
use super::{Boxes, Node, WIDE, upper};

/// Rays that are on their way at once: what waits for them has room in the nearest memory.
const ABREAST: usize = 24;

/// A ray and an object whose box it meets.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// By its number among the rays.
    pub ray: u32,
    /// By its index in the assembly.
    pub object: u32,
    /// Where the ray enters the box, or before.
    pub near: f32,
}

/// The rays, and how far each still looks.
#[derive(Debug, Default)]
pub struct Ways {
    ways: Vec<Way>,
    ends: Vec<f32>,
}

/// One of those that are on their way.
#[derive(Debug)]
struct Walker {
    ray: u32,
    node: u32,
    waiting: Waiting<Ahead>,
}

/// Rays, and the memory of their walk, used again for the next.
#[derive(Debug, Default)]
pub struct Stream {
    ways: Ways,
    walkers: Vec<Walker>,
    steps: Steps,
    met: Vec<Meeting>,
}

/// What each of those that are on their way meets in the next step: where it enters each box, and a bit for each.
#[derive(Debug, Default)]
struct Steps {
    enter: [[f32; WIDE]; ABREAST],
    met: [u32; ABREAST],
}

impl Ways {
    /// How many rays there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// A ray looks no farther than this; below 0 it looks for nothing any more.
    #[inline]
    pub fn look(&mut self, ray: u32, to: f64) {
        self.ends[ray as usize] = upper(to);
    }

    /// Whether a meeting still matters.
    #[inline]
    pub fn matters(&self, meeting: &Meeting) -> bool {
        meeting.near <= self.ends[meeting.ray as usize]
    }
}

impl Stream {
    /// Forgets all rays.
    pub fn clear(&mut self) {
        self.ways.ways.clear();
        self.ways.ends.clear();
    }

    /// One more ray, that looks as far as `to`.
    pub fn push(&mut self, ray: &Ray, to: f64) {
        self.ways.ways.push(Way::new(ray, 0.0));
        self.ways.ends.push(upper(to));
    }

    /// The rays.
    pub fn ways(&self) -> &Ways {
        &self.ways
    }
}

impl Boxes {
    /// Calls `visit` again and again with some rays and the objects whose boxes they meet, each pair once, of one ray the
    /// nearer nodes first; at last with none. `visit` says by [`Ways::look`] how far a ray still matters.
    pub fn walk_stream(
        &self,
        stream: &mut Stream,
        cells_visited: &mut u64,
        visit: &mut dyn FnMut(&[Meeting], &mut Ways),
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
    visit: &mut dyn FnMut(&[Meeting], &mut Ways),
) {
    let rays = ways.len() as u32;
    let mut started = rays.min(ABREAST as u32);
    let mut active = started as usize;
    while walkers.len() < active {
        let waiting = Waiting::new(Ahead { from: 0.0, node: 0 });
        walkers.push(Walker { ray: 0, node: 0, waiting });
    }
    for (ray, walker) in walkers.iter_mut().enumerate().take(active) {
        (walker.ray, walker.node) = (ray as u32, 0);
    }
    met.resize(ABREAST * WIDE, Meeting { ray: 0, object: 0, near: 0.0 });
    while active != 0 {
        *cells_visited += active as u64;
        // All nodes are asked before anything depends on an answer, so that none waits for the memory of another.
        for (k, Walker { ray, node, .. }) in walkers[..active].iter().enumerate() {
            let (way, end) = (&ways.ways[*ray as usize], ways.ends[*ray as usize]);
            let here = &nodes[*node as usize];
            let (enter, met) = Asked::new(simd, way).meets(simd, here, f32x8::splat(simd, end));
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
            // The first two are written whether they are there or not: that is known by chance only.
            let objects = bits & !u32::from(here.inner);
            let (slots, mut rest) = first_two(objects);
            let place = &mut met[count..count + WIDE];
            for (to, slot) in place.iter_mut().zip(slots) {
                *to = Meeting { ray: *ray, object: here.children[slot], near: enter[slot] };
            }
            let mut next = 2;
            while rest != 0 {
                let slot = rest.trailing_zeros() as usize % WIDE;
                rest &= rest - 1;
                place[next % WIDE] = Meeting { ray: *ray, object: here.children[slot], near: enter[slot] };
                next += 1;
            }
            count += objects.count_ones() as usize;
            push_nearest_last(waiting, here, enter, bits & u32::from(here.inner));
            loop {
                match waiting.pop() {
                    Some(ahead) if ahead.from <= end => {
                        *node = ahead.node;
                        k += 1;
                        break;
                    }
                    Some(_) => {}
                    None if started < rays => {
                        (*ray, *node) = (started, 0);
                        started += 1;
                        k += 1;
                        break;
                    }
                    None => {
                        active -= 1;
                        walkers.swap(k, active);
                        // The last has taken this one's place.
                        steps.enter[k] = steps.enter[active];
                        steps.met[k] = steps.met[active];
                        break;
                    }
                }
            }
        }
        if count != 0 {
            visit(&met[..count], ways);
        }
    }
    visit(&[], ways);
}

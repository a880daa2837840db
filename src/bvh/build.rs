//! Building the hierarchy: from the top by surface-area cost in two parts each, then joined to nodes of
//! eight.
//!
//! Which of the parts in two become nodes is the choice of the least area in all, by dynamic programming over
//! the slots that a part may fill (H. Ylitie, T. Karras, S. Laine: Efficient incoherent ray traversal on GPUs
//! through compressed wide BVHs, 2017).

use std::borrow::Cow;

use crate::math::dispatch;
use fearless_simd::Level;
use rayon::prelude::*;

use super::build_primitive::{About, BuildPrimitive};
use super::node::{BvhChild, Node, WIDE};
use super::split::parted;

/// Up to this many objects stay together: they fill a node, which tests them all at once.
const FEW: usize = WIDE;

/// A part of up to this many objects becomes nodes as soon as it is parted, so that what was needed to part
/// it is in memory for few parts at a time; larger ones are parted by all threads.
const SETTLED: usize = 4096;

/// The nodes over the boxes of `count` objects; the root is the first. Neither the number of threads nor the
/// level changes anything about them.
pub fn built(level: Level, count: usize, reach: impl Fn(usize) -> BuildPrimitive + Send + Sync) -> Vec<Node> {
    // What is few is not worth the way to other threads: a scene may have thousands of small meshes.
    let are_few = count <= SETTLED;
    let mut items: Vec<BuildPrimitive> = Vec::new();
    if are_few {
        items.extend((0..count).map(reach));
    } else {
        (0..count).into_par_iter().with_min_len(SETTLED).map(reach).collect_into_vec(&mut items);
    }
    let mut nodes = Vec::new();
    if items.is_empty() {
        nodes.push(Node::EMPTY);
        return nodes;
    }
    let of_all = |items: &[BuildPrimitive]| dispatch!(level, simd => About::all(simd, items));
    let about = if are_few {
        of_all(&items)
    } else {
        let all = items.par_chunks(SETTLED).map(of_all);
        all.reduce(|| About::NOTHING, |a, b| dispatch!(level, simd => a.with(simd, &b)))
    };
    if are_few {
        lay(&grown(level, &mut items, &about, 0), &mut nodes);
        return nodes;
    }
    let root = settled(level, &mut items, &about, 0);
    // Nodes take more than what they were made of, which is in them all by now.
    drop(items);
    lay(&root, &mut nodes);
    nodes
}

/// A part of the objects.
struct Grown<'a> {
    reach: BuildPrimitive,
    /// The area of the nodes that it takes where it may fill up to 1, 2, … slots.
    cost: [f64; WIDE],
    /// How many of so many slots its first half fills; 0 where it is not opened.
    first: [u8; WIDE],
    kind: Kind<'a>,
}

enum Kind<'a> {
    /// A few objects.
    Few(Cow<'a, [BuildPrimitive]>),
    Halves(Box<[Grown<'a>; 2]>),
    /// Nodes already, the root first.
    Settled(Vec<Node>),
}

/// Parts a range of boxes, one at least.
fn grown<'a>(level: Level, items: &'a mut [BuildPrimitive], about: &About, depth: u32) -> Grown<'a> {
    if items.len() <= FEW {
        return few(about, Cow::Borrowed(items));
    }
    let (middle, lower, upper) = parted(level, items, about, depth);
    let (low, high) = items.split_at_mut(middle);
    joined(about.reach, grown(level, low, &lower, depth + 1), grown(level, high, &upper, depth + 1))
}

/// The same by all threads; a part of up to [`SETTLED`] objects is nodes at once.
fn settled(level: Level, items: &mut [BuildPrimitive], about: &About, depth: u32) -> Grown<'static> {
    let count = items.len();
    if count <= FEW {
        return few(about, Cow::Owned(items.to_vec()));
    }
    if count <= SETTLED {
        let part = grown(level, items, about, depth);
        let mut nodes = Vec::with_capacity(count / FEW);
        lay(&part, &mut nodes);
        let whole = part.cost[0];
        return Grown {
            reach: about.reach,
            cost: [whole; WIDE],
            first: [0; WIDE],
            kind: Kind::Settled(nodes),
        };
    }
    let (middle, lower, upper) = parted(level, items, about, depth);
    let (low, high) = items.split_at_mut(middle);
    let (low, high) =
        rayon::join(|| settled(level, low, &lower, depth + 1), || settled(level, high, &upper, depth + 1));
    joined(about.reach, low, high)
}

/// A part of a few objects.
fn few<'a>(about: &About, items: Cow<'a, [BuildPrimitive]>) -> Grown<'a> {
    let whole = about.reach.area();
    let cost = std::array::from_fn(|slots| if slots + 1 >= items.len() { 0.0 } else { whole });
    Grown { reach: about.reach, cost, first: [0; WIDE], kind: Kind::Few(items) }
}

/// Two halves as one part, with the cheapest split of any number of slots.
fn joined<'a>(reach: BuildPrimitive, low: Grown<'a>, high: Grown<'a>) -> Grown<'a> {
    let mut cost = [0.0; WIDE];
    let mut first = [0; WIDE];
    for slots in (2..=WIDE).rev() {
        let mut best = f64::INFINITY;
        let mut share = 1;
        for k in 1..slots {
            let sum = low.cost[k - 1] + high.cost[slots - k - 1];
            if sum < best {
                (best, share) = (sum, k as u8);
            }
        }
        (cost[slots - 1], first[slots - 1]) = (best, share);
    }
    // One slot: a node of its own, which has all slots. It may be cheaper than a few slots of its parent.
    cost[0] = cost[WIDE - 1] + reach.area();
    for slots in 1..WIDE - 1 {
        if cost[0] < cost[slots] {
            (cost[slots], first[slots]) = (cost[0], 0);
        }
    }
    Grown { reach, cost, first, kind: Kind::Halves(Box::new([low, high])) }
}

/// What fills a slot.
#[derive(Clone, Copy)]
enum Filling<'a> {
    Object(u32),
    Part(&'a Grown<'a>),
}

#[derive(Clone, Copy)]
struct Slot<'a> {
    reach: BuildPrimitive,
    filling: Filling<'a>,
}

/// The slots of a node that are being filled.
struct Slots<'a> {
    filled: [Option<Slot<'a>>; WIDE],
    len: usize,
}

impl<'a> Slots<'a> {
    fn push(&mut self, reach: BuildPrimitive, filling: Filling<'a>) {
        self.filled[self.len] = Some(Slot { reach, filling });
        self.len += 1;
    }

    /// Fills up to `most` slots with a part.
    fn take(&mut self, part: &'a Grown<'a>, most: usize) {
        match &part.kind {
            Kind::Few(items) if items.len() <= most => {
                for item in &**items {
                    self.push(*item, Filling::Object(item.object()));
                }
            }
            Kind::Halves(halves) if most > 1 && part.first[most - 1] > 0 => {
                let first = usize::from(part.first[most - 1]);
                self.take(&halves[0], first);
                self.take(&halves[1], most - first);
            }
            _ => self.push(part.reach, Filling::Part(part)),
        }
    }
}

/// Lays a part out as nodes; the first one added holds all of it.
fn lay(part: &Grown, nodes: &mut Vec<Node>) {
    let index = nodes.len();
    if let Kind::Settled(own) = &part.kind {
        let offset = index as u32;
        nodes.extend(own.iter().map(|node| {
            let mut node = *node;
            for slot in (0..node.len()).filter(|slot| node.inner >> slot & 1 == 1) {
                node.children[slot] += offset;
            }
            node
        }));
        return;
    }
    let mut slots = Slots { filled: [None; WIDE], len: 0 };
    slots.take(part, WIDE);
    let axis = part.reach.edges().max_position();
    // Only the centres are moved: the slots are large.
    let mut order = [(0.0, 0); WIDE];
    for (number, slot) in slots.filled.iter().flatten().enumerate() {
        order[number] = (slot.reach.center(axis), number);
    }
    let order = &mut order[..slots.len];
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    nodes.push(Node::EMPTY);
    for slot in order.iter().filter_map(|&(_, n)| slots.filled[n]) {
        let child = match slot.filling {
            Filling::Object(object) => BvhChild::Object(object),
            Filling::Part(part) => {
                let child = nodes.len() as u32;
                lay(part, nodes);
                BvhChild::Node(child)
            }
        };
        nodes[index].push(&slot.reach, child);
    }
}

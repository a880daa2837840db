//! Building the hierarchy: from the top by surface-area cost in two parts each, then joined to nodes of eight.
//!
//! Where to part is looked for among a few bins of the boxes' centres (I. Wald: On fast construction of SAH-based
//! bounding volume hierarchies, 2007). Which of the parts in two become nodes is the choice of the least area in all,
//! by dynamic programming over the slots that a part may fill (H. Ylitie, T. Karras, S. Laine: Efficient incoherent
//! ray traversal on GPUs through compressed wide BVHs, 2017).

use crate::math::{Bounds, DVec3};

use super::{Child, Node, WIDE};

/// Up to this many objects stay together: they fill a node, which tells them apart at once.
const FEW: usize = WIDE;

/// A part of up to this many objects becomes nodes as soon as it is parted, so that what was needed to part it is in
/// memory for few parts at a time; larger ones are parted by all threads.
const SETTLED: usize = 4096;

/// Up to this many objects centres are binned along every axis, past it along the axis where they reach farthest: of
/// very many that is the best nearly always.
const EVERY_AXIS: usize = 1024;

/// The most bins of centres. Twice as many change the cost by less than a hundredth.
const BINS: usize = 16;

/// Sizes are told apart down to this power of 1/4 of the largest.
const POWERS: usize = 3;

/// Past this depth parts are halved by number, so that no input makes the hierarchy deeper than that and 32.
const DEEPEST: u32 = 64;

/// A box as how far it reaches: along −x, −y, −z, x, y and z. Two are joined by one operation on all six.
#[derive(Clone, Copy)]
struct Reach([f64; 6]);

impl Reach {
    const NOTHING: Self = Self([f64::NEG_INFINITY; 6]);

    fn new(b: &Bounds) -> Self {
        Self([-b.lo.x, -b.lo.y, -b.lo.z, b.hi.x, b.hi.y, b.hi.z])
    }

    fn bounds(&self) -> Bounds {
        let [x, y, z, ..] = self.0;
        Bounds::new(-DVec3::new(x, y, z), DVec3::from_slice(&self.0[3..]))
    }

    #[inline]
    fn join(&mut self, other: &Self) {
        for (own, other) in self.0.iter_mut().zip(other.0) {
            *own = if other > *own { other } else { *own };
        }
    }

    #[inline]
    fn edge(&self, axis: usize) -> f64 {
        self.0[axis] + self.0[axis + 3]
    }

    #[inline]
    fn longest_edge(&self) -> f64 {
        let longer = |a: f64, b: f64| if a > b { a } else { b };
        longer(longer(self.edge(0), self.edge(1)), self.edge(2))
    }

    /// The axis of the longest edge.
    fn longest(&self) -> usize {
        DVec3::new(self.edge(0), self.edge(1), self.edge(2)).max_position()
    }

    /// Twice the centre.
    #[inline]
    fn center(&self, axis: usize) -> f64 {
        self.0[axis + 3] - self.0[axis]
    }

    /// Half the surface, where it is not empty.
    #[inline]
    fn area(&self) -> f64 {
        let [x, y, z] = [self.edge(0), self.edge(1), self.edge(2)];
        x * y + y * z + z * x
    }
}

/// A box on its way down.
#[derive(Clone, Copy)]
struct Item {
    reach: Reach,
    object: u32,
}

/// The nodes over these boxes, numbered as they come; the root is the first. The number of threads changes nothing
/// about them.
pub fn built(boxes: impl Iterator<Item = Bounds>) -> Vec<Node> {
    let mut items: Vec<Item> =
        (0..).zip(boxes).map(|(object, b)| Item { reach: Reach::new(&b), object }).collect();
    let mut nodes = Vec::new();
    if items.is_empty() {
        nodes.push(Node::EMPTY);
    } else {
        let about = About::all(&items);
        lay(&grown(&mut items, &about, 0), &mut nodes);
    }
    nodes
}

/// What is known of a range of items.
#[derive(Clone, Copy)]
struct About {
    reach: Reach,
    /// How far the centres reach, twice.
    centers: Reach,
    /// The longest edge of any of them.
    longest: f64,
}

impl About {
    const NOTHING: Self = Self { reach: Reach::NOTHING, centers: Reach::NOTHING, longest: 0.0 };

    fn all(items: &[Item]) -> Self {
        let mut about = Self::NOTHING;
        for item in items {
            about.add(item);
        }
        about
    }

    #[inline]
    fn add(&mut self, item: &Item) {
        let [x, y, z] = [item.reach.center(0), item.reach.center(1), item.reach.center(2)];
        self.reach.join(&item.reach);
        self.centers.join(&Reach([-x, -y, -z, x, y, z]));
        let edge = item.reach.longest_edge();
        if edge > self.longest {
            self.longest = edge;
        }
    }
}

/// A part of the objects.
struct Grown<'a> {
    reach: Reach,
    /// The area of the nodes that it takes where it may fill up to 1, 2, … slots.
    cost: [f64; WIDE],
    /// How many of so many slots its first half fills; 0 where it is not opened.
    first: [u8; WIDE],
    kind: Kind<'a>,
}

enum Kind<'a> {
    /// A few objects.
    Few(&'a [Item]),
    Halves(Box<[Grown<'a>; 2]>),
    /// Nodes already, the root first.
    Settled(Vec<Node>),
}

/// Parts a range of items, one at least.
fn grown<'a>(items: &'a mut [Item], about: &About, depth: u32) -> Grown<'a> {
    let count = items.len();
    if count <= FEW {
        let whole = about.reach.area();
        let cost = std::array::from_fn(|slots| if slots + 1 >= count { 0.0 } else { whole });
        return Grown { reach: about.reach, cost, first: [0; WIDE], kind: Kind::Few(items) };
    }
    let (middle, lower, upper) = parted(items, about, depth);
    let (low, high) = items.split_at_mut(middle);
    let (low, high) = if count > SETTLED {
        rayon::join(|| settled(low, &lower, depth + 1), || settled(high, &upper, depth + 1))
    } else {
        (grown(low, &lower, depth + 1), grown(high, &upper, depth + 1))
    };
    joined(about.reach, low, high)
}

/// The same; a part of up to [`SETTLED`] objects is nodes at once.
fn settled<'a>(items: &'a mut [Item], about: &About, depth: u32) -> Grown<'a> {
    let count = items.len();
    let part = grown(items, about, depth);
    if !(WIDE + 1..=SETTLED).contains(&count) {
        return part;
    }
    let mut nodes = Vec::with_capacity(count / FEW);
    lay(&part, &mut nodes);
    let whole = part.cost[0];
    Grown { reach: about.reach, cost: [whole; WIDE], first: [0; WIDE], kind: Kind::Settled(nodes) }
}

/// Two halves as one part, with the cheapest way to share any number of slots.
fn joined<'a>(reach: Reach, low: Grown<'a>, high: Grown<'a>) -> Grown<'a> {
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
    reach: Reach,
    filling: Filling<'a>,
}

/// The slots of a node on the way to be filled.
struct Slots<'a> {
    filled: [Option<Slot<'a>>; WIDE],
    len: usize,
}

impl<'a> Slots<'a> {
    fn push(&mut self, reach: Reach, filling: Filling<'a>) {
        self.filled[self.len] = Some(Slot { reach, filling });
        self.len += 1;
    }

    /// Fills up to `most` slots with a part.
    fn take(&mut self, part: &'a Grown<'a>, most: usize) {
        match &part.kind {
            Kind::Few(items) if items.len() <= most => {
                for item in *items {
                    self.push(item.reach, Filling::Object(item.object));
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
    let axis = part.reach.longest();
    let center = |slot: &Option<Slot>| slot.map_or(0.0, |s| s.reach.center(axis));
    let filled = &mut slots.filled[..slots.len];
    filled.sort_by(|a, b| center(a).total_cmp(&center(b)));
    nodes.push(Node::EMPTY);
    for slot in filled.iter().flatten() {
        let child = match slot.filling {
            Filling::Object(object) => Child::Object(object),
            Filling::Part(part) => {
                let child = nodes.len() as u32;
                lay(part, nodes);
                Child::Node(child)
            }
        };
        nodes[index].push(&slot.reach.bounds(), child);
    }
}

/// Orders a range of two items or more so that the first `n` are one part and the others the other; returns `n`, at
/// least 1 and less than all, and what is known of both.
fn parted(items: &mut [Item], about: &About, depth: u32) -> (usize, About, About) {
    let split = if depth < DEEPEST { cheapest(items, about) } else { None };
    if let Some(split) = split {
        // Without a branch, which no processor could foretell.
        let mut both = [About::NOTHING; 2];
        let mut middle = 0;
        for place in 0..items.len() {
            let low = split.is_low(&items[place]);
            both[usize::from(low)].add(&items[place]);
            items.swap(place, middle);
            middle += usize::from(low);
        }
        let [upper, lower] = both;
        if middle > 0 && middle < items.len() {
            return (middle, lower, upper);
        }
    }
    let middle = items.len() / 2;
    (middle, About::all(&items[..middle]), About::all(&items[middle..]))
}

/// By what items are told apart.
#[derive(Clone, Copy)]
enum Key {
    Center(usize),
    /// The longest edge: sets a floor apart from what stands on it.
    Size,
}

/// The bins of one key.
#[derive(Clone, Copy)]
struct Scale {
    key: Key,
    low: f64,
    per_bin: f64,
    last: usize,
}

impl Scale {
    #[inline]
    fn bin(&self, item: &Item) -> usize {
        match self.key {
            // Not-a-number becomes 0. Converting to 32 bits is faster than to 64.
            Key::Center(axis) => {
                (((item.reach.center(axis) - self.low) * self.per_bin) as u32 as usize).min(self.last)
            }
            // Bins by powers of four, from the longest down.
            Key::Size => {
                let mut edge = self.low;
                let own = item.reach.longest_edge();
                let mut bin = 0;
                while bin < self.last && own < edge * 0.25 {
                    edge *= 0.25;
                    bin += 1;
                }
                bin
            }
        }
    }
}

/// Which items go where.
#[derive(Clone, Copy)]
struct Split {
    scale: Scale,
    /// The last bin of the lower part.
    last: usize,
}

impl Split {
    #[inline]
    fn is_low(&self, item: &Item) -> bool {
        self.scale.bin(item) <= self.last
    }
}

#[derive(Clone, Copy)]
struct Bin {
    reach: Reach,
    count: u32,
}

impl Bin {
    const NOTHING: Self = Self { reach: Reach::NOTHING, count: 0 };

    #[inline]
    fn add(&mut self, reach: &Reach, count: u32) {
        self.reach.join(reach);
        self.count += count;
    }

    fn cost(&self) -> f64 {
        f64::from(self.count.div_ceil(FEW as u32)) * self.reach.area()
    }
}

/// The split of the least cost, each part's full nodes times its area; `None` where no key tells the items apart.
fn cheapest(items: &[Item], about: &About) -> Option<Split> {
    // Few items need few bins: there is hardly more than one to a bin.
    let last = (items.len() / 2).min(BINS) - 1;
    let along = |axis: usize| {
        let (low, reach) = (-about.centers.0[axis], about.centers.edge(axis));
        // Where all centres are one, so is their bin.
        let per_bin = if reach > 0.0 { (last + 1) as f64 / reach } else { 0.0 };
        Scale { key: Key::Center(axis), low, per_bin, last }
    };
    let mut best: Option<(f64, Split)> = None;
    let mut look = |scale: Scale, bins: &[Bin]| {
        if let Some((cost, last)) = swept(bins)
            && best.is_none_or(|(least, _)| cost < least)
        {
            best = Some((cost, Split { scale, last }));
        }
    };
    if items.len() <= EVERY_AXIS {
        let scales = [0, 1, 2].map(along);
        for (scale, bins) in scales.into_iter().zip(&binned(items, &scales)) {
            look(scale, &bins[..=last]);
        }
    } else {
        let scale = along(about.centers.longest());
        look(scale, &binned(items, &[scale])[0][..=last]);
    }
    // Only what is as long as a good part of the range is worth to be set apart.
    if about.longest > 0.5 * about.reach.longest_edge() {
        let scale = Scale { key: Key::Size, low: about.longest, per_bin: 1.0, last: POWERS };
        look(scale, &binned(items, &[scale])[0][..=POWERS]);
    }
    best.map(|(_, split)| split)
}

/// The bins of several scales at once.
#[inline]
fn binned<const N: usize>(items: &[Item], scales: &[Scale; N]) -> [[Bin; BINS]; N] {
    let mut bins = [[Bin::NOTHING; BINS]; N];
    for item in items {
        for (scale, bins) in scales.iter().zip(&mut bins) {
            bins[scale.bin(item)].add(&item.reach, 1);
        }
    }
    bins
}

/// The cheapest place to split: its cost, and the last bin of the lower part.
fn swept(bins: &[Bin]) -> Option<(f64, usize)> {
    let mut above = [f64::INFINITY; BINS];
    let mut upper = Bin::NOTHING;
    for place in (1..bins.len()).rev() {
        if bins[place].count > 0 {
            upper.add(&bins[place].reach, bins[place].count);
        }
        above[place] = if upper.count > 0 { upper.cost() } else { f64::INFINITY };
    }
    let mut lower = Bin::NOTHING;
    let mut best = None;
    for place in 0..bins.len() - 1 {
        if bins[place].count == 0 {
            continue;
        }
        lower.add(&bins[place].reach, bins[place].count);
        let cost = lower.cost() + above[place + 1];
        if cost < best.map_or(f64::INFINITY, |(least, _)| least) {
            best = Some((cost, place));
        }
    }
    best
}

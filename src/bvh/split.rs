//! Parting a range of boxes in two where that costs least.
//!
//! Where to part is looked for among a few bins of the boxes' centres (I. Wald: On fast construction of
//! SAH-based bounding volume hierarchies, 2007).

use crate::math::dispatch;
use fearless_simd::{Level, Simd, SimdBase, f32x4};
use rayon::prelude::*;

use super::build_primitive::{About, BuildPrimitive};
use super::node::WIDE;

/// Up to this many objects centres are binned along every axis, past it along the axis where they reach
/// farthest: of very many that is the best nearly always.
const EVERY_AXIS: usize = 128;

/// The most bins of centres. Twice as many change the cost by less than a hundredth.
const BINS: usize = 16;

/// Sizes are distinguished down to this power of 1/4 of the largest.
const POWERS: usize = 3;

/// Past this depth parts are halved by number, so that no input makes the hierarchy deeper than that and 32.
const DEEPEST: u32 = 64;

/// Ranges past this many are binned and parted in stretches of so many, by all threads; so many are in the
/// nearer caches of a processor.
const STRETCH: usize = 8192;

/// Orders a range of two boxes or more so that the first `n` are one part and the others the other; returns
/// `n`, at least 1 and less than all, and what is known of both.
pub fn parted(
    level: Level,
    items: &mut [BuildPrimitive],
    about: &About,
    depth: u32,
) -> (usize, About, About) {
    let split = if depth < DEEPEST { cheapest(level, items, about) } else { None };
    if let Some(split) = split {
        let (middle, lower, upper) = split.parted(level, items);
        if middle > 0 && middle < items.len() {
            return (middle, lower, upper);
        }
    }
    let middle = items.len() / 2;
    let all = |items: &[BuildPrimitive]| dispatch!(level, simd => About::all(simd, items));
    (middle, all(&items[..middle]), all(&items[middle..]))
}

/// By what boxes are sorted.
#[derive(Clone, Copy)]
enum Key {
    Center(usize),
    /// The longest edge: separates a floor from what stands on it.
    Size,
}

/// The bins of one key.
#[derive(Clone, Copy)]
struct Scale {
    key: Key,
    low: f32,
    per_bin: f32,
    last: usize,
}

impl Scale {
    #[inline(always)]
    fn along(axis: usize, about: &About, last: usize) -> Self {
        let (low, high) = about.centers(axis);
        let reach = high - low;
        // Where all centres are one, so is their bin.
        let per_bin = if reach > 0.0 { (last + 1) as f32 / reach } else { 0.0 };
        Self { key: Key::Center(axis), low, per_bin, last }
    }

    #[inline(always)]
    fn bin(&self, item: &BuildPrimitive) -> usize {
        match self.key {
            Key::Center(axis) => self.bin_along(axis, item),
            // Bins by powers of four, from the longest down.
            Key::Size => {
                let mut edge = self.low;
                let own = item.longest();
                let mut bin = 0;
                while bin < self.last && own < edge * 0.25 {
                    edge *= 0.25;
                    bin += 1;
                }
                bin
            }
        }
    }

    #[inline(always)]
    fn bin_along(&self, axis: usize, item: &BuildPrimitive) -> usize {
        self.whole((item.center(axis) - self.low) * self.per_bin)
    }

    /// Not-a-number becomes 0. Converting to 32 bits is faster than to 64.
    #[inline(always)]
    fn whole(&self, place: f32) -> usize {
        (place as u32 as usize).min(self.last)
    }
}

/// Which boxes go where.
#[derive(Clone, Copy)]
struct Split {
    scale: Scale,
    /// The last bin of the lower part.
    last: usize,
}

impl Split {
    /// Brings the lower part of a range before the upper, and tells how many it has and about both.
    fn parted(&self, level: Level, items: &mut [BuildPrimitive]) -> (usize, About, About) {
        if items.len() <= STRETCH {
            return dispatch!(level, simd => self.parted_at_once(simd, items));
        }
        let stretches: Vec<(usize, About, About)> = items
            .par_chunks_mut(STRETCH)
            .map(|items| dispatch!(level, simd => self.parted_at_once(simd, items)))
            .collect();
        let lows: Vec<usize> = stretches.iter().map(|&(low, ..)| low).collect();
        let middle = lows.iter().sum();
        exchange(items, middle, &lows);
        let nothing = (About::NOTHING, About::NOTHING);
        let (lower, upper) = stretches.iter().fold(nothing, |(lower, upper), (_, low, high)| {
            dispatch!(level, simd => (lower.with(simd, low), upper.with(simd, high)))
        });
        (middle, lower, upper)
    }

    #[inline(always)]
    fn parted_at_once<S: Simd>(&self, simd: S, items: &mut [BuildPrimitive]) -> (usize, About, About) {
        let scale = &self.scale;
        // Each key by itself, so that the loop does not branch on it.
        let middle = match scale.key {
            Key::Center(axis) => self.moved(items, |item| scale.bin_along(axis % 3, item)),
            Key::Size => self.moved(items, |item| scale.bin(item)),
        };
        let (low, high) = items.split_at(middle);
        (middle, About::all(simd, low), About::all(simd, high))
    }

    #[inline(always)]
    fn moved(&self, items: &mut [BuildPrimitive], bin: impl Fn(&BuildPrimitive) -> usize) -> usize {
        // Without a branch, which no processor could foretell.
        let mut middle = 0;
        for place in 0..items.len() {
            let low = bin(&items[place]) <= self.last;
            items.swap(place, middle);
            middle += usize::from(low);
        }
        middle
    }
}

/// Brings all lower parts before all upper ones, where each stretch begins with its lower part, of `lows`
/// boxes. What stands on the wrong side of the middle is exchanged in the order in which it stands there.
fn exchange(items: &mut [BuildPrimitive], middle: usize, lows: &[usize]) {
    let (left, right) = items.split_at_mut(middle);
    // The stretch in which the middle is.
    let (cut, before) = (middle / STRETCH, middle % STRETCH);
    let (rest, right) = right.split_at_mut((STRETCH - before).min(right.len()));
    let rest_low = lows.get(cut).map_or(0, |low| low.saturating_sub(before));
    let mut high = left.chunks_mut(STRETCH).zip(lows).map(|(items, &low)| {
        let low = low.min(items.len());
        &mut items[low..]
    });
    let mut low = std::iter::once(&mut rest[..rest_low]).chain(
        right.chunks_mut(STRETCH).zip(lows.iter().skip(cut + 1)).map(|(items, &low)| &mut items[..low]),
    );
    let mut pairs = Vec::with_capacity(2 * lows.len());
    let (mut a, mut b): (&mut [BuildPrimitive], &mut [BuildPrimitive]) = (&mut [], &mut []);
    loop {
        while a.is_empty() {
            let Some(next) = high.next() else { break };
            a = next;
        }
        while b.is_empty() {
            let Some(next) = low.next() else { break };
            b = next;
        }
        let len = a.len().min(b.len());
        if len == 0 {
            break;
        }
        let (own_a, own_b);
        (own_a, a) = a.split_at_mut(len);
        (own_b, b) = b.split_at_mut(len);
        pairs.push((own_a, own_b));
    }
    pairs.into_par_iter().for_each(|(a, b)| a.swap_with_slice(b));
}

/// The bins of one key, filled.
#[derive(Clone, Copy)]
struct Bins {
    reach: [BuildPrimitive; BINS],
    count: [u32; BINS],
}

impl Bins {
    const NOTHING: Self = Self { reach: [BuildPrimitive::NOTHING; BINS], count: [0; BINS] };

    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, bin: usize, reach: &BuildPrimitive, count: u32) {
        // So that no check is left.
        let bin = bin % BINS;
        self.reach[bin].join(simd, reach);
        self.count[bin] += count;
    }

    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, scale: &Scale, items: &[BuildPrimitive]) {
        match scale.key {
            Key::Center(axis) => {
                for item in items {
                    self.add(simd, scale.bin_along(axis % 3, item), item, 1);
                }
            }
            Key::Size => {
                for item in items {
                    self.add(simd, scale.bin(item), item, 1);
                }
            }
        }
    }

    #[inline(always)]
    fn with<S: Simd>(mut self, simd: S, other: &Self) -> Self {
        for bin in 0..BINS {
            self.add(simd, bin, &other.reach[bin], other.count[bin]);
        }
        self
    }

    /// The bins of a range that may be long.
    fn of(level: Level, scale: &Scale, items: &[BuildPrimitive]) -> Self {
        let one = |items: &[BuildPrimitive]| {
            let mut bins = Self::NOTHING;
            dispatch!(level, simd => bins.fill(simd, scale, items));
            bins
        };
        if items.len() <= STRETCH {
            return one(items);
        }
        items
            .par_chunks(STRETCH)
            .map(one)
            .reduce(|| Self::NOTHING, |a, b| dispatch!(level, simd => a.with(simd, &b)))
    }

    /// The cheapest place to split: its cost, and the last bin of the lower part.
    #[inline(always)]
    fn swept<S: Simd>(&self, simd: S, last: usize) -> Option<(f64, usize)> {
        let mut above = [f64::INFINITY; BINS];
        let (mut reach, mut count) = (BuildPrimitive::NOTHING, 0);
        for place in (1..=last).rev() {
            if self.count[place] > 0 {
                reach.join(simd, &self.reach[place]);
                count += self.count[place];
            }
            above[place] = if count > 0 { cost(&reach, count) } else { f64::INFINITY };
        }
        let (mut reach, mut count) = (BuildPrimitive::NOTHING, 0);
        let mut best = None;
        let mut least = f64::INFINITY;
        for place in 0..last {
            if self.count[place] == 0 {
                continue;
            }
            reach.join(simd, &self.reach[place]);
            count += self.count[place];
            let cost = cost(&reach, count) + above[place + 1];
            if cost < least {
                least = cost;
                best = Some((cost, place));
            }
        }
        best
    }
}

/// A part's full nodes times its area.
#[inline(always)]
fn cost(reach: &BuildPrimitive, count: u32) -> f64 {
    f64::from(count.div_ceil(WIDE as u32)) * reach.area()
}

/// The split of the least cost; `None` where no key distinguishes the boxes.
fn cheapest(level: Level, items: &[BuildPrimitive], about: &About) -> Option<Split> {
    // Few objects need few bins: there is hardly more than one to a bin.
    let last = (items.len() / 2).min(BINS) - 1;
    let by_center = if items.len() <= EVERY_AXIS {
        dispatch!(level, simd => by_every_axis(simd, items, about, last))
    } else {
        let scale = Scale::along(about.widest(), about, last);
        let bins = Bins::of(level, &scale, items);
        dispatch!(level, simd => bins.swept(simd, last)).map(|(cost, last)| (cost, Split { scale, last }))
    };
    // Only what is as long as a good part of the range is worth to be separated.
    let longest = about.reach.longest();
    if f64::from(longest) > 0.5 * about.reach.edges().max_element() {
        let scale = Scale { key: Key::Size, low: longest, per_bin: 1.0, last: POWERS };
        let bins = Bins::of(level, &scale, items);
        if let Some((cost, last)) = dispatch!(level, simd => bins.swept(simd, POWERS))
            && by_center.is_none_or(|(least, _)| cost < least)
        {
            return Some(Split { scale, last });
        }
    }
    by_center.map(|(_, split)| split)
}

/// The cheapest split of few boxes by their centres, and its cost.
#[inline(always)]
fn by_every_axis<S: Simd>(
    simd: S,
    items: &[BuildPrimitive],
    about: &About,
    last: usize,
) -> Option<(f64, Split)> {
    let [x, y, z] =
        [Scale::along(0, about, last), Scale::along(1, about, last), Scale::along(2, about, last)];
    let low = f32x4::from_slice(simd, &[x.low, y.low, z.low, 0.0]);
    let per_bin = f32x4::from_slice(simd, &[x.per_bin, y.per_bin, z.per_bin, 0.0]);
    let mut bins = [Bins::NOTHING; 3];
    for item in items {
        let mut places = [0.0; 4];
        ((item.centers(simd) - low) * per_bin).store_slice(&mut places);
        for axis in 0..3 {
            bins[axis].add(simd, x.whole(places[axis]), item, 1);
        }
    }
    let mut best: Option<(f64, Split)> = None;
    for (scale, bins) in [x, y, z].into_iter().zip(&bins) {
        if let Some((cost, last)) = bins.swept(simd, last)
            && best.is_none_or(|(least, _)| cost < least)
        {
            best = Some((cost, Split { scale, last }));
        }
    }
    best
}

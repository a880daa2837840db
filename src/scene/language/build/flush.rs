//! Flat sides that were printed apart and may have been meant as one plane.
//!
//! OpenSCAD prints six digits of each number, so that a side is known to an interval. A map that stands above
//! two sides moves both alike, so that its digits are of no account between them: sides are compared from the
//! innermost maps outwards, and those whose intervals have a plane in common are one plane from there on.

use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

use super::Builder;
use super::chain::PrintedMap;
use super::context::Context;
use super::printed::{AXES, PrintedPrimitive};
use crate::math::{DAffine3, DVec3, Placement};
use crate::scene::{Digits, Primitive};

/// Normals that agree to so many parts of 1 are one: what six digits make different differs by 5 · 10⁻⁷ at
/// least, and rounding by less than 10⁻¹⁴.
const OF_NORMAL: f64 = (1 << 30) as f64;

/// What is said of faces that were moved.
const FLUSH: &str = "taken as flush with others, from which six digits do not tell them apart; \
                     `--digits exact` takes them as they are written";

/// Planes in one place that are barred from each other, as the two sides of a thin plate are: so many are
/// looked at for one that another side may be in.
const LOOK_BACK: usize = 8;

/// Steps that an object may take, maps by sides: some seconds.
const MOST_STEPS: usize = 1 << 27;

impl Builder {
    /// Notes what six digits leave open of a primitive that `local` gives its size, where something is cut.
    pub(super) fn note_digits(&mut self, primitive: &Primitive, local: &DAffine3, context: &Context) {
        if self.digits == Digits::Exact || !self.is_operand() {
            return;
        }
        if let Some(printed) = PrintedPrimitive::new(primitive, local, &context.maps) {
            self.memory.take(size_of::<PrintedPrimitive>() as u64);
            self.printed.add(primitive, printed);
        }
    }

    /// Makes one plane of the sides that may be one by six digits, object by object, and says so.
    pub(super) fn flush(&mut self) {
        if self.printed.is_empty() {
            return;
        }
        let (mut count, mut is_whole) = (0, true);
        for object in &mut self.scene.objects {
            let mut primitives = Vec::new();
            object.solid.each_mut(&mut |primitive| primitives.push(primitive));
            let mut sides = Vec::new();
            for (primitive, leaf) in primitives.iter().zip(0..) {
                if let Some(printed) = self.printed.take(primitive) {
                    sides.extend(PrintedSide::all_of(leaf, primitive, &printed));
                }
            }
            match flushed(&mut primitives, &sides) {
                Some(moved) => count += moved,
                None => is_whole = false,
            }
        }
        match count {
            0 => {}
            1 => self.scene.notes.push(format!("one face {FLUSH}")),
            _ => self.scene.notes.push(format!("{count} faces {FLUSH}")),
        }
        if !is_whole {
            let why = "an object has too many faces to look which of them six digits do not tell apart";
            self.scene.notes.push(format!("{why}: they stay as they are written"));
        }
    }
}

/// A flat side of a primitive.
#[derive(Clone, Debug)]
struct PrintedSide {
    /// Which primitive, in file order.
    leaf: u32,
    axis: usize,
    upper: bool,
    /// Its plane: the points with `normal · p = at`.
    normal: DVec3,
    at: f64,
    /// How far `at` grows with a step along the axis in the shape's own coordinates.
    along: f64,
    /// Nearer than this it is in the same place.
    rounded: f64,
    /// How far `at` may be off by the size of the primitive, and by each map, the outermost first.
    off: f64,
    maps: Rc<[(usize, f64)]>,
}

impl PrintedSide {
    /// The flat sides of a primitive.
    fn all_of(leaf: u32, primitive: &Primitive, printed: &PrintedPrimitive) -> Vec<Self> {
        let (m, b) = (&primitive.map.matrix3, primitive.shape.bounds());
        let mut sides = Vec::new();
        for axis in AXES {
            let across = m.col((axis + 1) % 3).cross(m.col((axis + 2) % 3)).normalize_or_zero();
            // The same for both sides of a plane: the first part of it that is not 0 is positive.
            let rounded = (across * OF_NORMAL).round();
            let first = AXES.into_iter().map(|k| rounded[k]).find(|&part| part != 0.0);
            let normal = if first.is_some_and(|part| part < 0.0) { -across } else { across };
            let along = normal.dot(m.col(axis));
            for (end, upper) in [(b.lo, false), (b.hi, true)] {
                let Some((off, maps)) = printed.side(axis, usize::from(upper)) else { continue };
                let within = |map: &PrintedMap| (map.id, normal.abs().dot(map.off));
                let at = normal.dot(primitive.map.translation) + along * end[axis];
                let maps: Rc<[_]> = maps.iter().map(within).collect();
                let off = off * along.abs();
                let rounded = normal.abs().dot(primitive.map_error());
                if at.is_finite() && along != 0.0 && off.is_finite() {
                    sides.push(Self { leaf, axis, upper, normal, at, along, rounded, off, maps });
                }
            }
        }
        sides
    }

    /// How far it may be moved, in the shape's own coordinates.
    fn loose(&self) -> f64 {
        (self.off + self.maps.iter().map(|&(_, off)| off).sum::<f64>()) / self.along.abs()
    }

    fn key(&self) -> [i64; 3] {
        (self.normal * OF_NORMAL).round().to_array().map(|part| part as i64)
    }
}

/// Sides that are one plane, as far as was looked.
#[derive(Debug)]
struct Plane {
    key: [i64; 3],
    /// Where it may be.
    lo: f64,
    hi: f64,
    /// Where the side that is known best has it, and how well that is known.
    at: f64,
    best: f64,
    /// By how much rounding may have moved `at`, `lo` and `hi`.
    rounded: f64,
    /// By their indices, ascending.
    sides: Vec<usize>,
    leaves: HashSet<u32>,
    maps: Rc<[(usize, f64)]>,
    /// The maps that its sides stand below, of those that are looked at.
    below: HashSet<usize>,
}

impl Plane {
    fn of((index, side): (usize, &PrintedSide)) -> Self {
        Self {
            key: side.key(),
            lo: side.at - side.off,
            hi: side.at + side.off,
            at: side.at,
            best: side.off,
            // Each map widens the interval, by a sum that rounds to half an ulp.
            rounded: side.rounded + side.at.abs() * ((side.maps.len() + 2) as f64 * f64::EPSILON),
            sides: vec![index],
            leaves: HashSet::from([side.leaf]),
            maps: Rc::clone(&side.maps),
            below: HashSet::new(),
        }
    }

    /// Whether both may be one. Two sides of a primitive never are: how thick it is was printed by itself.
    /// Nor are sides that stand below one map and were told apart there. Intervals that only touch have no
    /// number in common: what lies half way between 1.33333 and 1.33334 is always printed as one of them.
    fn may_be(&self, other: &Self) -> bool {
        let has_common = self.hi.min(other.hi) - self.lo.max(other.lo) > self.rounded + other.rounded;
        // Of the two roundings the smaller: a side that is off by more than another is wide is in no one's
        // place.
        (has_common || (self.at - other.at).abs() <= self.rounded.min(other.rounded))
            && self.leaves.is_disjoint(&other.leaves)
            && self.below.is_disjoint(&other.below)
    }

    fn join(&mut self, other: Self) {
        (self.lo, self.hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if other.best < self.best {
            (self.at, self.best) = (other.at, other.best);
        }
        // Those that are in one place but for rounding may have no number in common.
        if self.lo > self.hi {
            (self.lo, self.hi) = (self.at, self.at);
        }
        self.rounded = self.rounded.min(other.rounded);
        self.sides.extend(other.sides);
        self.leaves.extend(other.leaves);
        self.below.extend(other.below);
    }
}

/// Moves sides that may be one plane into one, each by no more than its digits leave open. Answers how many
/// were moved; nothing where that would take too long.
fn flushed(primitives: &mut [&mut Primitive], sides: &[PrintedSide]) -> Option<usize> {
    let deepest = sides.iter().map(|side| side.maps.len()).max().unwrap_or(0);
    if sides.len().saturating_mul(deepest + 1) > MOST_STEPS {
        return None;
    }
    let mut planes: Vec<Plane> = sides.iter().enumerate().map(Plane::of).collect();
    let ids = |plane: &Plane| plane.maps.iter().map(|&(id, _)| id).collect::<Vec<_>>();
    planes.sort_by_cached_key(|plane| (plane.key, ids(plane)));
    for depth in (0..=deepest).rev() {
        for plane in planes.iter_mut().filter(|plane| plane.maps.len() > depth) {
            plane.below = HashSet::from([plane.maps[depth].0]);
            let off = plane.sides.iter().map(|&side| sides[side].maps[depth].1).fold(0.0, f64::max);
            (plane.lo, plane.hi, plane.best) = (plane.lo - off, plane.hi + off, plane.best + off);
        }
        planes = joined(planes, depth);
    }
    let mut moves: BTreeMap<(u32, usize), [Option<f64>; 2]> = BTreeMap::new();
    for plane in planes.iter().filter(|plane| plane.sides.len() > 1) {
        let at = plane.at.clamp(plane.lo, plane.hi);
        let any_far = plane.sides.iter().any(|&side| (sides[side].at - at).abs() > sides[side].rounded);
        // Sides that are one plane already stay so: they follow no other side of their primitives.
        for side in plane.sides.iter().map(|&side| &sides[side]) {
            let step = if any_far { (at - side.at) / side.along } else { 0.0 };
            moves.entry((side.leaf, side.axis)).or_default()[usize::from(side.upper)] = Some(step);
        }
    }
    moves.retain(|_, steps| steps.iter().any(|step| step.is_some_and(|step| step != 0.0)));
    if moves.is_empty() {
        return Some(0);
    }
    let by_place: BTreeMap<_, &PrintedSide> =
        sides.iter().map(|side| ((side.leaf, side.axis, side.upper), side)).collect();
    let mut count = 0;
    for ((leaf, axis), steps) in moves {
        let is_far = |upper: usize, step: Option<f64>| {
            let side = by_place.get(&(leaf, axis, upper == 1));
            side.zip(step).is_some_and(|(side, step)| (step * side.along).abs() > side.rounded)
        };
        let moved = (0..2).filter(|&upper| is_far(upper, steps[upper])).count();
        // Where only one side has to move the other goes with it, as far as it may: how thick the primitive
        // is was printed, too.
        let follow = |step: f64, upper: bool| {
            // 0 also where the numbers end, and that is not a number.
            let most = by_place.get(&(leaf, axis, upper)).map_or(0.0, |side| side.loose()).max(0.0);
            Some(step.clamp(-most, most))
        };
        let steps = match steps {
            [Some(low), None] => [Some(low), follow(low, true)],
            [None, Some(high)] => [follow(high, false), Some(high)],
            both => both,
        };
        if let [Some(low), Some(high)] = steps
            && stretch(primitives[leaf as usize], axis, low, high)
        {
            count += moved;
        }
    }
    Some(count)
}

/// Joins the planes that may be one, of those that stand below the same maps down to a depth, and side by
/// side.
fn joined(planes: Vec<Plane>, depth: usize) -> Vec<Plane> {
    let is_run = |a: &Plane, b: &Plane| {
        let mut pairs = a.maps.iter().zip(b.maps.iter()).take(depth);
        a.key == b.key && a.maps.len().min(b.maps.len()) >= depth && pairs.all(|(a, b)| a.0 == b.0)
    };
    let mut all: Vec<Plane> = Vec::with_capacity(planes.len());
    let mut rest = planes.into_iter().peekable();
    while let Some(first) = rest.next() {
        let mut run = vec![first];
        while let Some(next) = rest.next_if(|next| is_run(&run[0], next)) {
            run.push(next);
        }
        run.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.sides[0].cmp(&b.sides[0])));
        let start = all.len();
        for plane in run {
            match all[start..].iter_mut().rev().take(LOOK_BACK).find(|other| other.may_be(&plane)) {
                Some(other) => other.join(plane),
                None => all.push(plane),
            }
        }
    }
    all
}

/// Moves the lower and the upper side of a primitive by a step each along an axis of its shape. Not where
/// that would make a plate of another thickness than was printed.
fn stretch(primitive: &mut Primitive, axis: usize, low: f64, high: f64) -> bool {
    let b = primitive.shape.bounds();
    let (lo, hi) = (b.lo[axis], b.hi[axis]);
    let share = (hi + high - (lo + low)) / (hi - lo);
    // What two planes would make of a plate that is thinner than its place is known is no plate.
    if !(0.5..=2.0).contains(&share) {
        return false;
    }
    let mut map = primitive.map;
    let along = map.matrix3.col(axis);
    *map.matrix3.col_mut(axis) = along * share;
    map.translation += along * (lo + low - lo * share);
    if Placement::new(&map).is_none() {
        return false;
    }
    primitive.map = map;
    // Four products and three sums, of half an ulp each.
    let rounded = primitive.shape.bounds().mapped(&primitive.map).farthest() * (4.0 * f64::EPSILON);
    let error = primitive.map_error() + rounded;
    *primitive = primitive.clone().with_map_error(error);
    true
}

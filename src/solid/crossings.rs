//! Stage 8, CSG, for a packet of rays: the first place along each where an expression changes.
//!
//! It does what [`super::crossing`] does for one ray, and finds the same bits where it has double precision:
//! the crossings of all primitives, those that are one place with the first of them toggled together, until
//! the expression's value changes. Instead of a sorted list there is a bit for each ray: of a crossing that
//! is yet to come, of a primitive that the place is inside, of an operator that is true there. So an operator
//! is one operation on a word for all rays.

use fearless_simd::Simd;

use crate::math::{Mask, Number, Real, RealIds, RealMask, SimdIds, SimdReal};

use super::crossing::{PlaceError, have_one_slope, start_of};
use super::csg_query::{CsgQuery, Departures, PacketCrossings, PacketRange};
use super::expression::Leaf;
use super::mesh_lists::MeshLists;
use super::mesh_spans::{KnownMesh, MeshLearning, MeshSpans};
use super::operator_bits::{decides, evaluate};
use super::primitive::WorldPrimitive;
use super::prune::ExprView;
use super::single::decide_single;
use super::span_cache::{CachedSpans, SpanCache, SpanEnds};

/// Memory that is used again for every packet.
#[derive(Clone, Debug, Default)]
pub struct PacketScratch<T> {
    known: SpanCache<T>,
    meshes: MeshSpans<T>,
    /// Where the leaves' spans are, those of one leaf side by side.
    places: Vec<SpanPlace>,
    /// By leaf: the rays that are inside; and those that the place toggles.
    inside: Vec<u64>,
    flipped: Vec<u64>,
    /// By operator: the rays for which it is true, before the place and behind it.
    before: Vec<u64>,
    behind: Vec<u64>,
}

impl<T: Real> PacketScratch<T> {
    /// Another packet follows, or the same from other surfaces.
    pub fn start(&mut self) {
        self.known.clear();
        self.meshes.clear();
    }

    /// Whether the spans of the packet's rays in a mesh are known.
    pub fn knows_mesh(&self, primitive: u32) -> bool {
        self.meshes.find(primitive).is_some()
    }
}

impl PacketScratch<f64> {
    /// Makes room for the spans in so many more meshes, where that takes forgetting all.
    pub fn make_room_for_meshes(&mut self, more: usize) {
        self.meshes.make_room(more);
    }

    /// Computes the spans in a mesh of those rays that will ask for them.
    pub fn learn_mesh<S: Simd>(&mut self, simd: S, of: &MeshLearning, lists: &MeshLists) {
        self.meshes.learn(simd, of, lists);
    }
}

/// The place of some spans of a leaf: in a mesh, or in a convex primitive.
#[derive(Clone, Copy, Debug)]
struct SpanPlace {
    leaf: usize,
    place: usize,
    is_mesh: bool,
}

/// The first crossings of an expression of solids.
///
/// Rays whose expression has a mesh that is not [known](PacketScratch::knows_mesh) are uncertain, all of
/// them.
pub fn first_of_expressions<S: Simd, T: Real>(
    simd: S,
    asked: &CsgQuery<T>,
    expression: ExprView,
    primitives: &[WorldPrimitive],
    scratch: &mut PacketScratch<T>,
    found: &mut PacketCrossings<T>,
) {
    let wanted = asked.wanted;
    (found.any, found.uncertain, found.entering) = (0, 0, 0);
    let form = |leaf: usize| &primitives[expression.leaves[leaf].primitive as usize].form;
    let leaves = expression.leaves.len();
    let is_known = |primitive: u32| scratch.meshes.find(primitive).is_some();
    if (0..leaves).any(|leaf| !form(leaf).is_convex() && !is_known(expression.leaves[leaf].primitive)) {
        found.uncertain = wanted;
        return;
    }
    let PacketScratch { known, meshes, places, .. } = scratch;
    let near = |leaf: usize| wanted & asked.near.get(leaf).copied().unwrap_or(u64::MAX);
    let (mut some, mut uncertain, mut has_mesh) = (0, 0, false);
    places.clear();
    known.make_room(leaves);
    for (leaf, &Leaf { primitive, .. }) in expression.leaves.iter().enumerate() {
        if let Some(&KnownMesh { first, count, .. }) = meshes.find(primitive) {
            has_mesh = true;
            for place in first..first + count {
                let spans = &mut meshes.spans()[place];
                some |= simd.vectorize(
                    #[inline(always)]
                    || spans.look(simd, near(leaf), asked.reach),
                );
                places.push(SpanPlace { leaf, place, is_mesh: true });
            }
            continue;
        }
        let asked = CsgQuery { wanted: near(leaf), ..*asked };
        let (place, [ahead, may]) = known.look(simd, &asked, primitive, form(leaf));
        places.push(SpanPlace { leaf, place: place as usize, is_mesh: false });
        some |= ahead;
        uncertain |= may;
    }
    found.uncertain = uncertain;
    decide_all(simd, asked, some & !uncertain, expression, scratch, found);
    if has_mesh {
        for (leaf, &Leaf { primitive, .. }) in expression.leaves.iter().enumerate() {
            if let Some(mesh) = scratch.meshes.find(primitive) {
                found.uncertain |= mesh.uncertain(asked, near(leaf), found);
            }
        }
        found.any &= !found.uncertain;
    }
}

/// Decides what some rays cross first, given their spans in all leaves.
#[inline]
fn decide_all<S: Simd, T: Real>(
    simd: S,
    asked: &CsgQuery<T>,
    some: u64,
    expression: ExprView,
    scratch: &mut PacketScratch<T>,
    found: &mut PacketCrossings<T>,
) {
    if some == 0 {
        return;
    }
    if let ([leaf], &[SpanPlace { place, is_mesh, .. }]) = (expression.leaves, &scratch.places[..]) {
        let spans = if is_mesh { scratch.meshes.spans() } else { scratch.known.spans() };
        let (known, negated) = (&spans[place], expression.is_negated());
        simd.vectorize(
            #[inline(always)]
            || decide_single(simd, asked, some, known, leaf.primitive, negated, found),
        );
        return;
    }
    simd.vectorize(
        #[inline(always)]
        || decide(simd, asked, some, expression, scratch, found),
    );
}

/// The spans of an expression's leaves.
struct Leaves<'a, T> {
    spans: &'a mut [CachedSpans<T>],
    meshes: &'a mut [CachedSpans<T>],
    places: &'a [SpanPlace],
}

impl<T> Leaves<'_, T> {
    #[inline(always)]
    fn of(&self, number: usize) -> &CachedSpans<T> {
        let SpanPlace { place, is_mesh, .. } = self.places[number];
        if is_mesh { &self.meshes[place] } else { &self.spans[place] }
    }

    #[inline(always)]
    fn of_mut(&mut self, number: usize) -> &mut CachedSpans<T> {
        let SpanPlace { place, is_mesh, .. } = self.places[number];
        if is_mesh { &mut self.meshes[place] } else { &mut self.spans[place] }
    }
}

#[inline(always)]
fn decide<S: Simd, T: Real>(
    simd: S,
    asked: &CsgQuery<T>,
    mut open: u64,
    expression: ExprView,
    scratch: &mut PacketScratch<T>,
    found: &mut PacketCrossings<T>,
) {
    let CsgQuery { departures, reach, .. } = *asked;
    let leaves = expression.leaves.len();
    let PacketScratch { known, meshes, places, inside, flipped, before, behind } = scratch;
    let mut sides = Leaves { spans: known.spans(), meshes: meshes.spans(), places };
    // Of an expression that is one primitive.
    let negated = if expression.nodes.is_empty() && expression.is_negated() { u64::MAX } else { 0 };
    inside.clear();
    inside.resize(leaves, 0);
    flipped.resize(leaves, 0);
    evaluate(expression, inside, before);
    while open != 0 {
        let mut done = 0;
        let mut early = 0;
        for row in 0..T::REGISTERS {
            if T::has_any(open, row) {
                let [ended, earlier, uncertain] = next_place(simd, row, open, &mut sides, departures, reach);
                done |= ended | uncertain;
                early |= earlier;
                found.uncertain |= uncertain;
            }
        }
        open &= !done;
        flipped.fill(0);
        for (number, &SpanPlace { leaf, .. }) in places.iter().enumerate() {
            let CachedSpans { enter, leave, .. } = sides.of_mut(number);
            flipped[leaf] ^= (enter.crossing ^ leave.crossing) & open;
            enter.ahead &= !enter.crossing;
            leave.ahead &= !leave.crossing;
        }
        for leaf in 0..leaves {
            inside[leaf] ^= flipped[leaf];
        }
        let value =
            |nodes: &[u64], inside: &[u64]| nodes.first().map_or_else(|| inside[0] ^ negated, |&root| root);
        evaluate(expression, inside, behind);
        let now = value(behind, inside);
        // Of an expression that is one primitive, what is inside has just been toggled.
        let changed = if before.is_empty() { flipped[0] } else { before[0] ^ now };
        let shown = changed & open & !early;
        if shown != 0 {
            let mut left = shown;
            let (mut last, mut why) = (usize::MAX, 0);
            for (number, &SpanPlace { leaf, .. }) in places.iter().enumerate() {
                if leaf != last {
                    why = left & decides(expression, leaf, inside, flipped, before, behind);
                    left &= !why;
                    last = leaf;
                }
                if why == 0 {
                    continue;
                }
                // The nearest of those that a ray crosses in this place.
                for side in sides.of(number).sides() {
                    take(simd, side, why & side.crossing, expression.leaves[leaf].primitive, found);
                    why &= !side.crossing;
                }
            }
            found.uncertain |= left;
            found.any |= shown & !left;
            found.entering |= shown & now;
            open &= !shown;
        }
        std::mem::swap(before, behind);
    }
}

/// The first crossing that is yet to come on each ray of a row, and all that are one place with it. Answers
/// which rays have none within reach, and whose place is passed over: it lies at the start of the ray, or
/// before the reach; and of which double precision are to decide what is one place.
#[inline(always)]
fn next_place<S: Simd, T: Real>(
    simd: S,
    row: usize,
    open: u64,
    sides: &mut Leaves<T>,
    departures: Option<&Departures<T>>,
    reach: &PacketRange<T>,
) -> [u64; 3] {
    let shift = row * T::LANES;
    let (infinite, zero) = (T::all(simd, f64::INFINITY), T::all(simd, 0.0));
    let (mut t, mut error, mut place_error, mut rounding_share) = (infinite, zero, zero, zero);
    for number in 0..sides.places.len() {
        let known = sides.of(number);
        for side in known.sides() {
            if !T::has_any(side.ahead, row) {
                continue;
            }
            let their_t = side.t.load(simd, row);
            let sooner = T::mask_of(simd, side.ahead, row) & their_t.is_below(t);
            t = sooner.choose(their_t, t);
            error = sooner.choose(side.error.load(simd, row), error);
            place_error = sooner.choose(T::all(simd, known.place_error), place_error);
            rounding_share = sooner.choose(T::all(simd, known.rounding_share), rounding_share);
        }
    }
    let start = start_of(
        error,
        PlaceError { bound: place_error, rounding_share },
        departures.map(|d| d.place_error.load(simd, row)),
    );
    let open = T::mask_of(simd, open, row);
    let ended = open & (t.is_equal(infinite) | t.is_above(reach.to.load(simd, row)));
    let (asking, limit) = (open & !ended, t + error);
    // The first itself reaches back to its place; mostly no other does.
    let none = T::mask_of(simd, 0, row);
    let (mut some, mut more) = (none, none);
    for number in 0..sides.places.len() {
        for side in sides.of_mut(number).sides_mut() {
            if !T::has_any(side.ahead, row) {
                side.crossing &= !(T::REGISTER_BITS << shift);
                continue;
            }
            let earliest = side.t.load(simd, row) - side.error.load(simd, row);
            let reaches = T::mask_of(simd, side.ahead, row) & asking & earliest.is_at_most(limit);
            more = more | (some & reaches);
            some = some | reaches;
            side.crossing = side.crossing & !(T::REGISTER_BITS << shift) | reaches.bits() << shift;
        }
    }
    let mut uncertain = 0;
    let all_before = if !T::IS_DOUBLE {
        let at_start = asking & t.magnitude().is_at_most(start);
        uncertain = T::bits_of(simd, more | at_start, row);
        t.is_below(reach.from.load(simd, row))
    } else if more.any() {
        one_place(simd, row, asking, sides, FirstEnds { t, error, place_error }, reach)
    } else {
        t.is_below(reach.from.load(simd, row))
    };
    let early = asking & (t.is_at_most(start) | all_before);
    [T::bits_of(simd, ended, row), T::bits_of(simd, early, row), uncertain]
}

/// The first crossing that is yet to come on each ray of a row: where, how far that may be off, and how far
/// its primitive may be off its place.
#[derive(Clone, Copy)]
struct FirstEnds<N> {
    t: N,
    error: N,
    place_error: N,
}

/// Which crossings of those that reach back to the first of a row, where several do, are one place with it.
/// Answers where all of these are before the reach.
#[inline(always)]
fn one_place<S: Simd, T: Real>(
    simd: S,
    row: usize,
    asking: RealMask<T, S>,
    sides: &mut Leaves<T>,
    first: FirstEnds<T::SimdReal<S>>,
    reach: &PacketRange<T>,
) -> RealMask<T, S> {
    let FirstEnds { t, error, place_error } = first;
    let shift = row * T::LANES;
    let (infinite, zero) = (T::all(simd, f64::INFINITY), T::all(simd, 0.0));
    let limit = t + error;
    // In the order of their distances the place ends before the first that does not reach back to it.
    let mut end = infinite;
    for number in 0..sides.places.len() {
        for side in sides.of(number).sides() {
            let their_t = side.t.load(simd, row);
            let apart =
                T::mask_of(simd, side.ahead, row) & (their_t - side.error.load(simd, row)).is_above(limit);
            end = (apart & their_t.is_below(end)).choose(their_t, end);
        }
    }
    let mut all_before = asking;
    for number in 0..sides.places.len() {
        let known = sides.of_mut(number);
        let own = T::all(simd, known.place_error);
        for side in known.sides_mut() {
            if !T::has_any(side.crossing, row) {
                continue;
            }
            let (their_t, their_error) = (side.t.load(simd, row), side.error.load(simd, row));
            let exact = error.is_equal(zero) | their_error.is_equal(zero);
            let now = T::mask_of(simd, side.crossing, row)
                & their_t.is_below(end)
                & (have_one_slope(place_error / error, own / their_error) | exact);
            all_before = all_before & (!now | their_t.is_below(reach.from.load(simd, row)));
            side.crossing = side.crossing & !(T::REGISTER_BITS << shift) | now.bits() << shift;
        }
    }
    all_before
}

/// The crossing of some rays with one side is the one that is asked for.
#[inline(always)]
fn take<S: Simd, T: Real>(
    simd: S,
    side: &SpanEnds<T>,
    lanes: u64,
    primitive: u32,
    found: &mut PacketCrossings<T>,
) {
    if lanes == 0 {
        return;
    }
    for row in 0..T::REGISTERS {
        if !T::has_any(lanes, row) {
            continue;
        }
        let which = T::mask_of(simd, lanes, row);
        found.t.put(simd, row, which, side.t.load(simd, row));
        found.error.put(simd, row, which, side.error.load(simd, row));
        found.surface.put_ids::<T, S>(simd, row, lanes, side.surface.load(simd, row).ids());
        found.primitive.put_ids::<T, S>(simd, row, lanes, RealIds::<T, S>::all(simd, primitive));
    }
}

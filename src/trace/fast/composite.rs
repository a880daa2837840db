//! A packet of rays against a composite object: the rays are cut into slices, nearest first, and each slice
//! is intersected with what the object's expression is there.

use fearless_simd::Simd;

use crate::lattice::{LooseOctree, MANY, SLACK};
use crate::math::{Bounds, DVec3, Mask, Number, RayPacket, Rays, Real, SimdRegister};
use crate::solid::{Classification, CsgQuery, ExprView, TRange, WorldPrimitive, first_of_expressions};

use super::Fast;
use super::memory::{PrecisionScratch, TileMemory};
use super::mesh_walk::AskingRays;
use super::precision::Precision;
use super::sink::{HitSink, SOME_LEAVES, offer_crossings};
use super::source::PacketSource;

/// Where rays have been cut so often, or oftener, up to [`SOME_LEAVES`] are evaluated at once, whatever
/// [`HitSink::FEW_LEAVES`].
const CUTS: u32 = 2;

/// How often the rays' range in an object is halved at most: into 64 slices, about as many as a sub-lattice
/// has cells.
const HALVINGS: u32 = 6;

/// Slices are given up where, for one packet, they are pruned from more primitives than this all together:
/// an object that is cut into cells has those, which take as long as some ten slices.
const MOST_WORK: usize = 512;

/// The expression of a whole object, and its classifications by cells.
pub(super) type Whole<'a> = (&'a LooseOctree, ExprView<'a>);

/// Rays that may meet a composite object.
pub(super) struct CompositeTest<'a, S, T, H> {
    pub fast: &'a Fast<'a>,
    pub simd: S,
    pub source: PacketSource<'a, T>,
    pub object: u32,
    /// The packet's number in the tile, and which of its rays may meet the object, a bit for each.
    pub k: usize,
    pub asked: u64,
    pub whole: Option<Whole<'a>>,
    /// The rays that have not met the object yet, a bit for each.
    pub open: u64,
    /// How many primitives slices were pruned from; and where that became too many.
    pub work: usize,
    pub given_up: Option<f64>,
    pub sink: &'a mut H,
}

impl<S: Simd, T: Precision, H: HitSink<T>> CompositeTest<'_, S, T, H> {
    /// Finds what the rays meet first between two distances. Answers up to where nothing is left to be
    /// found: before the second where slices take too much work.
    pub fn trace(&mut self, expression: ExprView, from: f64, to: f64, memory: &mut TileMemory) -> f64 {
        self.slice(expression, from, to, HALVINGS, memory);
        self.given_up.unwrap_or(f64::INFINITY)
    }

    fn slice(&mut self, expression: ExprView, from: f64, to: f64, halvings: u32, memory: &mut TileMemory) {
        if self.open == 0 || from > to || self.given_up.is_some() {
            return;
        }
        let primitives = &self.fast.assembly.primitives;
        // A crossing may be computed `slack` outside its slice; twice that keeps its whole cluster.
        let margin = DVec3::splat(2.0 * self.fast.slack_of::<T>());
        let b = bounds_between(self.simd, self.source.rays, self.open, from, to).padded(margin);
        let Some(expression) = least_known(self.whole, expression, primitives, &b) else { return };
        let middle = 0.5 * (from + to);
        // The range is cut before much is pruned: shorter slices begin with less.
        if expression.leaves.len() > 2 * MANY && halvings > 0 {
            self.slice(expression, from, middle, halvings - 1, memory);
            self.slice(expression, middle, to, halvings - 1, memory);
            return;
        }
        if self.whole.is_some() {
            self.work += expression.leaves.len();
            if self.work > MOST_WORK {
                self.given_up = Some(from);
                return;
            }
        }
        let mut pruned = memory.pruned.pop().unwrap_or_default();
        if expression.pruned(primitives, &b, &mut memory.pruning, &mut pruned) == Classification::Mixed {
            let left = ExprView::from(&pruned);
            let few = if halvings + CUTS > HALVINGS { H::FEW_LEAVES } else { SOME_LEAVES };
            if left.leaves.len() <= few || halvings == 0 {
                self.evaluate(left, from, to, memory);
            } else {
                self.slice(left, from, middle, halvings - 1, memory);
                self.slice(left, middle, to, halvings - 1, memory);
            }
        }
        memory.pruned.push(pruned);
    }

    /// Offers what the open rays meet of an expression between two distances; where this precision does not
    /// decide, by double.
    fn evaluate(&mut self, expression: ExprView, from: f64, to: f64, memory: &mut TileMemory) {
        let slack = SLACK * T::EPSILON_RATIO;
        let reach = TRange { from: from - slack, to: to + slack };
        let mut uncertain = self.evaluate_in(self.source, self.open, expression, reach, memory);
        if uncertain != 0 && !T::IS_DOUBLE {
            uncertain = self.evaluate_in(self.source.full(), uncertain, expression, reach, memory);
        }
        self.sink.mark_uncertain(uncertain);
        self.open &= !uncertain;
    }

    /// Offers what some rays meet of an expression; answers for which this precision does not decide.
    fn evaluate_in<U: Precision>(
        &mut self,
        source: PacketSource<U>,
        wanted: u64,
        expression: ExprView,
        reach: TRange,
        memory: &mut TileMemory,
    ) -> u64 {
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        if U::IS_DOUBLE {
            let asking = AskingRays { k: self.k, wanted: self.asked };
            self.fast.know_meshes(self.simd, expression, source.full(), asking, memory);
        }
        let PacketSource { rays: packet, departures, .. } = source;
        let PrecisionScratch { csg, found, reach: part, .. } = U::scratch(memory);
        part.fill(reach);
        let query = CsgQuery { packet, wanted, departures, reach: part, near: &[] };
        first_of_expressions(self.simd, &query, expression, &self.fast.assembly.primitives, csg, found);
        self.open &= !found.any;
        offer_crossings(self.simd, found, self.object, self.sink);
        found.uncertain
    }
}

/// What an expression in a box is to be pruned from: what is left of it already, or of the whole object in a
/// cell around the box, whichever is less; none where there is no surface in that cell.
fn least_known<'e>(
    whole: Option<Whole<'e>>,
    left: ExprView<'e>,
    primitives: &[WorldPrimitive],
    b: &Bounds,
) -> Option<ExprView<'e>> {
    let Some((loose, whole)) = whole.filter(|_| left.leaves.len() >= MANY) else { return Some(left) };
    let around = loose.around(whole, primitives, b)?;
    Some(if around.leaves.len() < left.leaves.len() { around } else { left })
}

/// The box around some rays of a packet between two distances.
fn bounds_between<S: Simd, T: Real>(simd: S, packet: &RayPacket<T>, rays: u64, from: f64, to: f64) -> Bounds {
    simd.vectorize(
        #[inline(always)]
        || {
            let infinite = T::all(simd, f64::INFINITY);
            let (mut lo, mut hi) = ([infinite; 3], [-infinite; 3]);
            for row in 0..T::REGISTERS {
                if !T::has_any(rays, row) {
                    continue;
                }
                let wanted = T::mask_of(simd, rays, row);
                let Rays { o, d } = packet.load(simd, row);
                for axis in 0..3 {
                    let (o, d) = (o.along(axis), d.along(axis));
                    // The end may be no number, where that is infinitely far and the ray does not move: then
                    // it is the start.
                    let (start, end) = (o + d * from, o + d * to);
                    lo[axis] = wanted.choose(end.smaller(start).smaller(lo[axis]), lo[axis]);
                    hi[axis] = wanted.choose(end.larger(start).larger(hi[axis]), hi[axis]);
                }
            }
            let (lo, hi) = (
                [lo[0].least(), lo[1].least(), lo[2].least()],
                [hi[0].greatest(), hi[1].greatest(), hi[2].greatest()],
            );
            Bounds::new(DVec3::from_array(lo), DVec3::from_array(hi))
        },
    )
}

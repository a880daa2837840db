//! A packet of rays against a composite object that is cut into cells: its frustum finds those on the way,
//! nearest first, and the rays that pass one are intersected with what the object's expression is there.
//!
//! Where few rays pass each cell, they go on one by one.

use fearless_simd::Simd;

use crate::lattice::{BvhChild, CsgCells, Frustum, SLACK};
use crate::math::{Ray, lanes};
use crate::solid::{Classification, CsgQuery, Departures, ExprView, PrunedExpr, first_of_expressions};
use crate::stage::{Meter, Silent};

use super::Fast;
use super::cell_rays::{CellItem, Clip};
use super::memory::{PrecisionScratch, TileMemory};
use super::mesh_walk::AskingRays;
use super::packet_culler::Slabs;
use super::packet_hits::PacketHits;
use super::precision::Precision;
use super::ranked::push_ranked;
use super::sink::{HitSink, offer_crossings, offer_hits};
use super::source::PacketSource;

/// A packet is given up where, of its first cells, fewer than so many rays pass each: a cell costs as much
/// for a packet as for so many rays one by one.
const FEW_RAYS: u32 = 2;

/// So many cells are looked at before a packet is given up.
const FIRST_CELLS: u32 = 4;

/// Rays that may meet a composite object.
pub(super) struct CellsTest<'a, S, T> {
    pub fast: &'a Fast<'a>,
    pub simd: S,
    pub source: PacketSource<'a, T>,
    pub object: u32,
    pub cells: &'a CsgCells,
    /// The packet's number in the tile.
    pub k: usize,
    /// Which of its rays may meet the object, a bit for each.
    pub asked: u64,
    /// What lies nearer was looked at; what lies farther away does not matter.
    pub start: f64,
    pub farthest: f64,
    /// The rays of which it is still asked, a bit for each; and those that are to be asked one by one.
    pub open: u64,
    pub uncertain: u64,
}

/// Rays that may meet an expression in a cell.
#[derive(Clone, Copy)]
struct Asked<'a> {
    rays: u64,
    cell: u32,
    expression: ExprView<'a>,
    /// By leaf: which of them may meet it.
    near: &'a [u64],
}

impl<S: Simd, T: Precision> CellsTest<'_, S, T> {
    /// Finds what the rays meet first.
    pub fn trace(&mut self, sink: &mut impl HitSink<T>, memory: &mut TileMemory) {
        let Some(frustum) = memory.frustums[self.k] else { return };
        let mut hits = T::scratch(memory).of_object.pop().unwrap_or_default();
        hits.clear();
        memory.doubles.cells.start();
        memory.singles.cells.start();
        memory.doubles.csg.start();
        memory.singles.csg.start();
        let limits = memory.cullers[self.k].limits();
        let mut stack = std::mem::take(&mut memory.cell_stack);
        self.walk(&frustum, &mut stack, &mut hits, memory);
        memory.cell_stack = stack;
        memory.cullers[self.k].restore(limits);
        sink.mark_uncertain(self.uncertain);
        offer_hits(self.simd, &hits, u64::MAX, self.object, sink);
        T::scratch(memory).of_object.push(hits);
    }

    fn walk(
        &mut self,
        frustum: &Frustum,
        stack: &mut Vec<CellItem>,
        hits: &mut PacketHits<T>,
        memory: &mut TileMemory,
    ) {
        let slack = self.fast.slack_of::<T>();
        let (mut far, mut met, mut cells, mut passed) = (self.farthest, 0, 0, 0);
        stack.clear();
        stack.push(CellItem { near: f32::NEG_INFINITY, number: 0, is_cell: false });
        while let Some(CellItem { near, number, is_cell }) = stack.pop() {
            // What is not a number is not known to be farther.
            if f64::from(near) > far + slack {
                continue;
            }
            if !is_cell {
                memory.counts.cells_visited += 1;
                self.simd.vectorize(
                    #[inline(always)]
                    || open_node(self.simd, self.cells, number, frustum, stack),
                );
                continue;
            }
            let b = self.cells.bounds(number);
            let (simd, culler, open) = (self.simd, &memory.cullers[self.k], self.open);
            let rays = simd.vectorize(
                #[inline(always)]
                || culler.passing(simd, &Slabs::around(simd, b.lo, b.hi, slack), open),
            );
            if rays == 0 {
                continue;
            }
            (cells, passed) = (cells + 1, passed + rays.count_ones());
            if cells >= FIRST_CELLS && passed < FEW_RAYS * cells {
                self.one_by_one(hits, memory);
                return;
            }
            let found = self.evaluate(number, rays, hits, memory);
            if found != 0 {
                memory.cullers[self.k].shorten(found, |lane| hits.reach_of(lane) + slack);
                met |= found;
                // As long as one has met nothing, all may matter.
                if self.open & !met == 0 {
                    far = self.farthest_open(hits);
                }
            }
            if self.open == 0 {
                return;
            }
        }
    }

    /// Up to where anything still matters to any of the open rays.
    fn farthest_open(&self, hits: &PacketHits<T>) -> f64 {
        lanes(self.open).map(|lane| hits.reach_of(lane)).fold(f64::NEG_INFINITY, f64::max).min(self.farthest)
    }

    /// Asks what some rays meet in a cell; answers which may have met anything.
    fn evaluate(&mut self, cell: u32, rays: u64, hits: &mut PacketHits<T>, memory: &mut TileMemory) -> u64 {
        let expression = self.cells.expression(cell);
        let mut near = std::mem::take(&mut memory.near);
        let missed = self.find_near(cell, expression, rays, &mut near, memory);
        let mut met = 0;
        if missed == 0 {
            met = self.evaluate_left(&Asked { rays, cell, expression, near: &near }, hits, memory);
        } else {
            let mut left = memory.pruned.pop().unwrap_or_default();
            if expression.without(missed, &mut memory.pruning, &mut left) == Classification::Mixed {
                keep_near(expression, &left, &mut near);
                let expression = ExprView::from(&left);
                met = self.evaluate_left(&Asked { rays, cell, expression, near: &near }, hits, memory);
            }
            memory.pruned.push(left);
        }
        memory.near = near;
        met
    }

    /// Finds which of some rays may meet each primitive of a cell in it: to be sure of that takes a fraction
    /// of the time that their spans take. Answers which primitives none of them meets, a bit for each, of up
    /// to 64.
    fn find_near(
        &self,
        cell: u32,
        expression: ExprView,
        rays: u64,
        near: &mut Vec<u64>,
        memory: &TileMemory,
    ) -> u64 {
        let (simd, culler) = (self.simd, &memory.cullers[self.k]);
        let margin = 2.0 * self.fast.slack_of::<T>();
        near.clear();
        simd.vectorize(
            #[inline(always)]
            || {
                for leaf in expression.leaves {
                    let b = self.cells.part(cell, leaf);
                    near.push(culler.passing(simd, &Slabs::around(simd, b.lo, b.hi, margin), rays));
                }
            },
        );
        near.iter()
            .take(64)
            .enumerate()
            .fold(0, |missed, (leaf, &rays)| missed | u64::from(rays == 0) << leaf)
    }

    /// The same of what is left of the cell's expression.
    fn evaluate_left(&mut self, asked: &Asked, hits: &mut PacketHits<T>, memory: &mut TileMemory) -> u64 {
        let holds = T::IS_DOUBLE || self.cells.margin() >= 2.0 * self.fast.slack_of::<T>();
        let (mut met, mut uncertain) = (0, asked.rays);
        if holds {
            (met, uncertain) = self.evaluate_in(self.source, asked, hits, memory);
        }
        if uncertain != 0 && !T::IS_DOUBLE {
            let more;
            let again = Asked { rays: uncertain, ..*asked };
            (more, uncertain) = self.evaluate_in(self.source.full(), &again, hits, memory);
            met |= more;
        }
        self.uncertain |= uncertain;
        self.open &= !uncertain;
        met
    }

    /// The same in one precision; answers also for which that does not decide.
    fn evaluate_in<U: Precision>(
        &self,
        source: PacketSource<U>,
        &Asked { rays, cell, expression, near }: &Asked,
        hits: &mut PacketHits<T>,
        memory: &mut TileMemory,
    ) -> (u64, u64) {
        let simd = self.simd;
        if U::IS_DOUBLE {
            let asking = AskingRays { k: self.k, wanted: self.asked };
            self.fast.know_meshes(simd, expression, source.full(), asking, memory);
        }
        let PrecisionScratch { csg, found, cells, .. } = U::scratch(memory);
        let (packet, b, start) = (source.rays, self.cells.bounds(cell), self.start);
        let wanted = simd.vectorize(
            #[inline(always)]
            || cells.clip(simd, packet, rays, &Clip { b, start, slack: SLACK * U::EPSILON_RATIO }),
        );
        if wanted == 0 {
            return (0, 0);
        }
        let query = CsgQuery { packet, wanted, departures: source.departures, reach: &cells.reach, near };
        first_of_expressions(simd, &query, expression, &self.fast.assembly.primitives, csg, found);
        offer_crossings(simd, found, self.object, hits);
        let (any, uncertain) = (found.any, found.uncertain);
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        (any, uncertain)
    }

    /// Finds what the open rays meet one after the other.
    fn one_by_one(&mut self, hits: &mut PacketHits<T>, memory: &mut TileMemory) {
        let scratch = &mut memory.incoherent.scratch;
        let mut meter = Meter::new(Silent);
        let PacketSource { full_rays, full_departures, .. } = self.source;
        let found = &mut *memory.doubles.found;
        found.any = 0;
        found.entering = 0;
        for lane in lanes(self.open) {
            let departure = full_departures.filter(|all| all.primitive.0[lane] != Departures::NOWHERE);
            let departure = departure.map(|all| all.get(lane));
            let to = hits.reach_of(lane).min(self.farthest);
            let ray: Ray = full_rays.ray(lane);
            if let Some(crossing) =
                self.fast.exact.object(self.object, &ray, departure, to, scratch, &mut meter)
            {
                found.set(lane, &crossing);
            }
        }
        memory.counts += meter.counts;
        offer_crossings(self.simd, &memory.doubles.found, self.object, hits);
        self.open = 0;
    }
}

/// Keeps of the rays near each leaf of an expression those near the leaves that are left of it.
fn keep_near(expression: ExprView, left: &PrunedExpr, near: &mut Vec<u64>) {
    let mut kept = 0;
    for (number, leaf) in expression.leaves.iter().enumerate() {
        if left.leaves.get(kept).is_some_and(|other| other.primitive == leaf.primitive) {
            near[kept] = near[number];
            kept += 1;
        }
    }
    near.truncate(kept);
}

/// Puts what a packet's frustum meets of a node's children on the stack, the nearest last.
#[inline(always)]
fn open_node<S: Simd>(simd: S, cells: &CsgCells, node: u32, frustum: &Frustum, stack: &mut Vec<CellItem>) {
    let node = &cells.boxes().nodes()[node as usize];
    let (lo, hi) = node.sides(simd);
    let met = frustum.meets_boxes(simd, &lo, &hi);
    let (first, inner) = (stack.len(), node.inner());
    let mut left = met.boxes;
    while left != 0 {
        let slot = left.trailing_zeros() as usize;
        left &= left - 1;
        let Some(child) = node.child(slot) else { continue };
        let (is_cell, number) = match child {
            BvhChild::Object(cell) => (true, cell),
            BvhChild::Node(node) => (false, node),
        };
        debug_assert_eq!(is_cell, inner >> slot & 1 == 0);
        let item = CellItem { near: met.near[slot], number, is_cell };
        push_ranked(
            stack,
            first,
            item,
            #[inline(always)]
            |item| item.near,
        );
    }
}

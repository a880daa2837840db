//! What stands between the lit points of a tile and one light.
//!
//! The rays towards a light run together, so that the frustum around them, with its apex at the light, is a shaft. It
//! walks the boxes as the frustum of the rays from the eye does; which of two things stands in the way does not matter,
//! and a ray that is blocked asks no more.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8};

use crate::lattice::{Beam, Child, SLACK, Spread};
use crate::math::{Bundle, Column, DVec3, LANES, Mask, Number, ROWS, Rays};
use crate::solid::{
    Body, Departures, Firsts, Flat, Form, Found, Left, Reach, Spans, Starts, first_of_expressions,
    firsts_of_spans, firsts_of_surface,
};

use super::Fast;
use super::first::{FEW, HALVINGS};
use super::memory::TileMemory;
use super::walk::{asking, bounds_between, push_nearest_last, through};

/// Rays towards a light.
#[derive(Clone, Debug)]
pub struct Shaft {
    /// The rays; those that are live ask.
    pub rays: Bundle,
    /// How far away the light is.
    pub distance: Column,
    /// Which of the rays are blocked.
    pub blocked: u64,
    /// Which are to be asked one by one.
    pub unsure: u64,
}

impl Shaft {
    /// No rays.
    pub const EMPTY: Self =
        Self { rays: Bundle::EMPTY, distance: Column::filled(0.0), blocked: 0, unsure: 0 };

    /// Gives those that do not ask the numbers of the first that does ([`Bundle::close`]).
    pub fn close(&mut self) {
        self.rays.close();
        if self.rays.live != 0 {
            let first = self.distance.0[self.rays.live.trailing_zeros() as usize];
            for (lane, distance) in self.distance.0.iter_mut().enumerate() {
                if self.rays.live >> lane & 1 == 0 {
                    *distance = first;
                }
            }
        }
    }

    /// The rays that are neither blocked nor unsure.
    #[inline(always)]
    fn open(&self) -> u64 {
        self.rays.live & !(self.blocked | self.unsure)
    }

    /// Notes the rays that meet something before they reach the light.
    fn block(&mut self, found: &Found) {
        let mut met = found.any;
        while met != 0 {
            let lane = met.trailing_zeros() as usize;
            met &= met - 1;
            let blocks = found.t.0[lane] + found.error.0[lane] < self.distance.0[lane];
            self.blocked |= u64::from(blocks) << lane;
        }
    }
}

impl Fast<'_> {
    /// Finds which rays towards a light are blocked. `departures` has the surfaces that they leave.
    #[inline(always)]
    pub(super) fn blocked_of_tile<S: Simd>(
        &self,
        simd: S,
        shafts: &mut [Shaft],
        departures: &[Departures],
        memory: &mut TileMemory,
    ) {
        let bundles = || shafts.iter().map(|shaft| (&shaft.rays, Some(&shaft.distance)));
        let whole = Beam::around(simd, bundles(), Spread::Together);
        memory.beams.clear();
        for one in bundles() {
            memory.beams.push(Beam::around(simd, std::iter::once(one), Spread::Together));
        }
        memory.forget_sheared(shafts.len());
        memory.stack.clear();
        memory.stack.push((f64::NEG_INFINITY, 0));
        while let Some((_, node)) = memory.stack.pop() {
            let node = &self.boxes.nodes()[node as usize];
            memory.counts.cells_visited += 1;
            let (lo, hi) = node.sides(simd);
            let met = whole.meets_boxes(simd, &lo, &hi);
            let objects = met.boxes & !node.inner();
            if objects != 0 {
                let mut all_blocked = true;
                for (k, shaft) in shafts.iter_mut().enumerate() {
                    if shaft.open() == 0 {
                        continue;
                    }
                    let mut left = memory.beams[k].meets_boxes(simd, &lo, &hi).boxes & objects;
                    while left != 0 {
                        let slot = left.trailing_zeros() as usize;
                        left &= left - 1;
                        if let Some(Child::Object(object)) = node.child(slot) {
                            self.object_in_shaft(simd, object, shaft, &departures[k], memory, k);
                        }
                    }
                    all_blocked &= shaft.open() == 0;
                }
                if all_blocked {
                    return;
                }
            }
            push_nearest_last(&mut memory.stack, node, &met);
        }
    }

    fn object_in_shaft<S: Simd>(
        &self,
        simd: S,
        object: u32,
        shaft: &mut Shaft,
        departures: &Departures,
        memory: &mut TileMemory,
        k: usize,
    ) {
        let primitives = &self.assembly.primitives;
        let own = &self.assembly.objects[object as usize];
        match &own.body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                single(simd, &primitives[*index as usize].form, shaft, departures, *index);
            }
            Body::Surface(index) => {
                memory.counts.primitive_tests += 1;
                let primitive = &primitives[*index as usize];
                let TileMemory { sheared, found, .. } = memory;
                let bounds = own.bounds.padded(DVec3::splat(self.slack));
                let wanted = asking(simd, &shaft.rays, &primitive.form, &bounds) & shaft.open();
                let sheared = &mut sheared[k];
                let departures = Some(departures);
                firsts_of_surface(simd, &shaft.rays, wanted, (primitive, *index), departures, sheared, found);
                shaft.block(found);
            }
            Body::Composite { whole, .. } => {
                let bounds = own.bounds.padded(DVec3::splat(self.slack));
                let Some((open, from, to)) = through(simd, &shaft.rays, &bounds) else { return };
                let to = to.min(shaft.distance.0.iter().copied().fold(0.0, f64::max));
                let open = open & shaft.open();
                let mut slicing = Slicing { fast: self, simd, shaft, departures, open };
                slicing.slice(Flat::from(&**whole), (from, to), HALVINGS, memory);
            }
        }
    }
}

/// Whose way is cut into slices.
struct Slicing<'a, S> {
    fast: &'a Fast<'a>,
    simd: S,
    shaft: &'a mut Shaft,
    departures: &'a Departures,
    /// The rays that have not met the object yet.
    open: u64,
}

impl<S: Simd> Slicing<'_, S> {
    fn slice(&mut self, expression: Flat, (from, to): (f64, f64), halvings: u32, memory: &mut TileMemory) {
        if self.open == 0 || from > to {
            return;
        }
        let primitives = &self.fast.assembly.primitives;
        // As for the rays from the eye.
        let margin = DVec3::splat(2.0 * self.fast.slack);
        let b = bounds_between(self.simd, &self.shaft.rays, from, to).padded(margin);
        let mut remains = memory.remains.pop().unwrap_or_default();
        if expression.pruned(primitives, &b, &mut memory.pruning, &mut remains) == Left::Some {
            let left = Flat::from(&remains);
            if left.leaves.len() <= FEW || halvings == 0 {
                self.ask(left, (from, to), memory);
            } else {
                let middle = 0.5 * (from + to);
                self.slice(left, (from, middle), halvings - 1, memory);
                self.slice(left, (middle, to), halvings - 1, memory);
            }
        }
        memory.remains.push(remains);
    }

    fn ask(&mut self, expression: Flat, (from, to): (f64, f64), memory: &mut TileMemory) {
        let (simd, shaft) = (self.simd, &mut *self.shaft);
        let reach = Reach { from: from - SLACK, to: to + SLACK };
        let primitives = &self.fast.assembly.primitives;
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        let TileMemory { scratch, found, .. } = memory;
        let departures = Some(self.departures);
        first_of_expressions(
            simd,
            &shaft.rays,
            self.open,
            expression,
            primitives,
            departures,
            reach,
            scratch,
            found,
        );
        shaft.unsure |= found.unsure;
        self.open &= !(found.unsure | found.any);
        shaft.block(found);
    }
}

/// One convex primitive that is an object.
fn single<S: Simd>(simd: S, form: &Form, shaft: &mut Shaft, departures: &Departures, index: u32) {
    #[inline(always)]
    fn rows<S: Simd>(
        simd: S,
        (form, departures, index): (&Form, &Departures, u32),
        shaft: &mut Shaft,
        spans: impl Fn(&Rays<f64x8<S>>) -> Spans<f64x8<S>>,
    ) {
        let open = shaft.open();
        for row in 0..ROWS {
            if (open >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let spans = spans(&shaft.rays.load(simd, row));
            if !spans.any.any() {
                continue;
            }
            let bits = |word: u64| mask64x8::from_bitmask(simd, word >> (row * LANES) & 0xFF);
            let here = departures.primitive.load(simd, row).is_equal(f64x8::splat(simd, f64::from(index)));
            let off = Some(departures.off.load(simd, row));
            let starts = Starts { here, inward: bits(departures.inward), off };
            let Firsts { end, any, .. } = firsts_of_spans(spans, form, &starts);
            let blocked = any & (end.t + end.error).is_below(shaft.distance.load(simd, row));
            shaft.blocked |= u64::from(blocked.bits()) << (row * LANES) & open;
        }
    }
    let about = (form, departures, index);
    match form {
        Form::Ball(ball) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        shaft,
                        #[inline(always)]
                        |rays| ball.spans(rays),
                    )
                },
            );
        }
        Form::AxisBox(slabs) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        shaft,
                        #[inline(always)]
                        |rays| slabs.spans(rays),
                    )
                },
            );
        }
        Form::SkewBox(slabs) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        shaft,
                        #[inline(always)]
                        |rays| slabs.spans(rays),
                    )
                },
            );
        }
        Form::Round(round) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        shaft,
                        #[inline(always)]
                        |rays| round.spans(rays),
                    )
                },
            );
        }
        Form::Facets(facets) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        shaft,
                        #[inline(always)]
                        |rays| facets.spans(rays),
                    )
                },
            );
        }
        Form::Mesh(_) | Form::Face(_) | Form::Patch(_) | Form::Tube(_) => {}
    }
}

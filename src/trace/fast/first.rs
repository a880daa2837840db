//! What the rays of a tile meet first.
//!
//! The frustum of the whole tile walks the boxes once, nearest first. Where it meets objects, each bundle of the tile
//! asks with a frustum of its own, and the objects that are left are asked by eight rays at a time. What lies behind
//! the farthest hit of all rays is never looked at.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8};

use crate::lattice::{Beam, Child, SLACK, Spread};
use crate::math::{Bundle, DVec3, LANES, Mask, Number, ROWS, Rays};
use crate::solid::{
    Body, Firsts, Flat, Form, Found, Left, Reach, Spans, Starts, first_of_expressions, firsts_of_spans,
    firsts_of_surface,
};

use super::Fast;
use super::memory::TileMemory;
use super::nearest::{Nearest, Offer};
use super::walk::{asking, bounds_between, push_nearest_last, through};

/// The most leaves of an expression that are asked at once, rather than the way being cut into shorter slices: more
/// cost more than a slice does.
pub(super) const FEW: usize = 4;

/// How often the way through an object is halved at most: into 64 slices, about as many as a sub-lattice has cells.
pub(super) const HALVINGS: u32 = 6;

impl Fast<'_> {
    /// The first hits of the rays of a tile. `nearest` has as many as there are bundles.
    #[inline(always)]
    pub(super) fn first_of_tile<S: Simd>(
        &self,
        simd: S,
        bundles: &[Bundle],
        nearest: &mut [Nearest],
        memory: &mut TileMemory,
    ) {
        let whole = Beam::around(simd, bundles.iter().map(|bundle| (bundle, None)), Spread::Apart);
        let TileMemory { beams, .. } = memory;
        beams.clear();
        for bundle in bundles {
            beams.push(Beam::around(simd, std::iter::once((bundle, None)), Spread::Apart));
        }
        memory.forget_sheared(bundles.len());
        let TileMemory { far, stack, .. } = memory;
        far.clear();
        far.extend(bundles.iter().map(|b| if b.live == 0 { f64::NEG_INFINITY } else { f64::INFINITY }));
        for found in &mut *nearest {
            found.clear();
        }
        stack.clear();
        stack.push((f64::NEG_INFINITY, 0));
        while let Some((near, node)) = memory.stack.pop() {
            let farthest = memory.far.iter().fold(f64::NEG_INFINITY, |most, &far| f64::max(most, far));
            if near > farthest + self.slack {
                continue;
            }
            let node = &self.boxes.nodes()[node as usize];
            memory.counts.cells_visited += 1;
            let (lo, hi) = node.sides(simd);
            let met = whole.meets_boxes(simd, &lo, &hi);
            let objects = met.boxes & !node.inner();
            if objects != 0 {
                for (k, bundle) in bundles.iter().enumerate() {
                    let own = memory.beams[k].meets_boxes(simd, &lo, &hi);
                    let ahead = own.near.is_at_most(f64x8::splat(simd, memory.far[k] + self.slack));
                    let mut left = own.boxes & objects & ahead.bits();
                    while left != 0 {
                        let slot = left.trailing_zeros() as usize;
                        left &= left - 1;
                        let Some(Child::Object(object)) = node.child(slot) else { continue };
                        if own.near[slot] <= memory.far[k] + self.slack {
                            self.object_of_bundle(simd, object, bundle, &mut nearest[k], memory, k);
                            memory.far[k] = nearest[k].farthest(simd, bundle);
                        }
                    }
                }
            }
            push_nearest_last(&mut memory.stack, node, &met);
        }
    }

    /// The first hits of a bundle with one object.
    fn object_of_bundle<S: Simd>(
        &self,
        simd: S,
        object: u32,
        bundle: &Bundle,
        nearest: &mut Nearest,
        memory: &mut TileMemory,
        k: usize,
    ) {
        let primitives = &self.assembly.primitives;
        match &self.assembly.objects[object as usize].body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                single(simd, &primitives[*index as usize].form, bundle, nearest, object, *index);
            }
            Body::Surface(index) => {
                memory.counts.primitive_tests += 1;
                let primitive = &primitives[*index as usize];
                let TileMemory { sheared, found, .. } = memory;
                let sheared = &mut sheared[k];
                let bounds = self.assembly.objects[object as usize].bounds.padded(DVec3::splat(self.slack));
                let wanted = asking(simd, bundle, &primitive.form, &bounds);
                firsts_of_surface(simd, bundle, wanted, (primitive, *index), None, sheared, found);
                if found.any != 0 {
                    offer_found(simd, found, object, nearest);
                }
            }
            Body::Composite { whole, .. } => {
                let to = memory.far[k] + self.slack;
                self.composite(simd, object, Flat::from(&**whole), bundle, to, nearest, memory);
            }
        }
    }

    /// The first hits of a bundle with a composite object, as far as `to`: its way through the object's box in slices,
    /// each with what the expression is there.
    fn composite<S: Simd>(
        &self,
        simd: S,
        object: u32,
        expression: Flat,
        bundle: &Bundle,
        to: f64,
        nearest: &mut Nearest,
        memory: &mut TileMemory,
    ) {
        let bounds = &self.assembly.objects[object as usize].bounds.padded(DVec3::splat(self.slack));
        let Some((open, from, end)) = through(simd, bundle, bounds) else { return };
        let mut slicing = Slicing { fast: self, simd, bundle, object, open, nearest };
        slicing.slice(expression, (from, end.min(to)), HALVINGS, memory);
    }
}

/// Whose way is cut into slices.
struct Slicing<'a, S> {
    fast: &'a Fast<'a>,
    simd: S,
    bundle: &'a Bundle,
    object: u32,
    /// The rays that have not met the object yet.
    open: u64,
    nearest: &'a mut Nearest,
}

impl<S: Simd> Slicing<'_, S> {
    /// Looks at the way from `from` to `to`, nearest slices first.
    fn slice(&mut self, expression: Flat, (from, to): (f64, f64), halvings: u32, memory: &mut TileMemory) {
        if self.open == 0 || from > to {
            return;
        }
        let primitives = &self.fast.assembly.primitives;
        // A crossing may be computed `slack` outside its slice; twice that keeps its whole cluster.
        let margin = DVec3::splat(2.0 * self.fast.slack);
        let b = bounds_between(self.simd, self.bundle, from, to).padded(margin);
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
        let (simd, bundle) = (self.simd, self.bundle);
        let reach = Reach { from: from - SLACK, to: to + SLACK };
        let primitives = &self.fast.assembly.primitives;
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        let TileMemory { scratch, found, .. } = memory;
        first_of_expressions(simd, bundle, self.open, expression, primitives, None, reach, scratch, found);
        self.nearest.unsure |= found.unsure;
        self.open &= !(found.unsure | found.any);
        if found.any != 0 {
            offer_found(simd, found, self.object, self.nearest);
        }
    }
}

/// Offers what an expression's crossings are.
fn offer_found<S: Simd>(simd: S, found: &Found, object: u32, nearest: &mut Nearest) {
    simd.vectorize(
        #[inline(always)]
        || {
            for row in 0..ROWS {
                if (found.any >> (row * LANES)) as u8 == 0 {
                    continue;
                }
                let bits = |word: u64| mask64x8::from_bitmask(simd, word >> (row * LANES) & 0xFF);
                let met = Offer {
                    any: bits(found.any),
                    t: found.t.load(simd, row),
                    entering: bits(found.entering),
                    object,
                    primitive: found.primitive.load(simd, row),
                    surface: found.surface.load(simd, row),
                };
                nearest.offer(simd, row, &met);
            }
        },
    );
}

/// One convex primitive that is an object.
fn single<S: Simd>(simd: S, form: &Form, bundle: &Bundle, nearest: &mut Nearest, object: u32, index: u32) {
    #[inline(always)]
    fn rows<S: Simd>(
        simd: S,
        (form, bundle, object, index): (&Form, &Bundle, u32, u32),
        nearest: &mut Nearest,
        spans: impl Fn(&Rays<f64x8<S>>) -> Spans<f64x8<S>>,
    ) {
        let no = mask64x8::splat(simd, false);
        let starts = Starts { here: no, inward: no, off: None };
        for row in 0..ROWS {
            if bundle.live_in(row) == 0 {
                continue;
            }
            let spans = spans(&bundle.load(simd, row));
            if !spans.any.any() {
                continue;
            }
            let Firsts { end, entering, any } = firsts_of_spans(spans, form, &starts);
            let primitive = f64x8::splat(simd, f64::from(index));
            let met = Offer { any, t: end.t, entering, object, primitive, surface: end.surface };
            nearest.offer(simd, row, &met);
        }
    }
    let about = (form, bundle, object, index);
    match form {
        Form::Ball(ball) => {
            simd.vectorize(
                #[inline(always)]
                || {
                    rows(
                        simd,
                        about,
                        nearest,
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
                        nearest,
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
                        nearest,
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
                        nearest,
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
                        nearest,
                        #[inline(always)]
                        |rays| facets.spans(rays),
                    )
                },
            );
        }
        Form::Mesh(_) | Form::Face(_) | Form::Patch(_) | Form::Tube(_) => {}
    }
}

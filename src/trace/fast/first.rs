//! What the rays of a tile meet first.
//!
//! The frustum of the whole tile walks the boxes once, nearest first. Where it meets objects, each bundle of the tile
//! asks with a frustum of its own, and the objects that are left are asked by eight rays at a time. What lies behind
//! the farthest hit of all rays is never looked at.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8};

use crate::lattice::{Beam, Child, SLACK, Spread};
use crate::math::{Bounds, Bundle, Columns, DVec3, LANES, Mask, Number, ROWS, Rays, row_of};
use crate::solid::{
    Asked, Ball, Body, Firsts, Flat, Form, Found, Reach, Spans, Starts, first_of_expressions,
    firsts_of_spans, firsts_of_surface, with_spans,
};

use super::Fast;
use super::memory::TileMemory;
use super::nearest::{Nearest, Offer};
use super::slices::{Slices, slices};
use super::thin::{Slabs, Thin};
use super::walk::{asking, bounds_between, push_nearest_last, reach};

/// The most objects that the bundles of a tile are asked about, one after the other. So many take about a tenth of the
/// time that the tile's rays take one by one: where a dot holds many objects, rays have no company.
const CROWD: u64 = 1536;

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
        let whole = beam_of_tile(simd, bundles);
        let TileMemory { beams, thin, fan, .. } = memory;
        beams.clear();
        for bundle in bundles {
            beams.push(beam_of(simd, bundle));
        }
        fan.set(beams);
        thin.resize(bundles.len(), Thin::EMPTY);
        thin.iter_mut().for_each(Thin::forget);
        memory.forget_sheared(bundles.len());
        let TileMemory { far, stack, .. } = memory;
        far.clear();
        far.extend(bundles.iter().map(|b| if b.live == 0 { f64::NEG_INFINITY } else { f64::INFINITY }));
        for found in &mut *nearest {
            found.clear();
        }
        stack.clear();
        stack.push((f64::NEG_INFINITY, 0));
        let mut asked = 0;
        while let Some((near, node)) = memory.stack.pop() {
            let farthest = memory.far.iter().fold(f64::NEG_INFINITY, |most, &far| f64::max(most, far));
            if near > farthest + self.slack {
                continue;
            }
            let node = &self.boxes.nodes()[node as usize];
            memory.counts.cells_visited += 1;
            let (lo, hi) = node.sides(simd);
            let met = whole.meets_boxes(simd, &lo, &hi);
            let mut objects = met.boxes & !node.inner();
            while objects != 0 {
                let slot = objects.trailing_zeros() as usize;
                objects &= objects - 1;
                let Some(Child::Object(object)) = node.child(slot) else { continue };
                let (lo, hi) = node.corners(slot);
                let met = memory.fan.meets(simd, lo, hi);
                let slabs = Slabs::around(simd, DVec3::from_array(lo), DVec3::from_array(hi), self.slack);
                let mut left = met.frustums;
                while left != 0 {
                    let k = left.trailing_zeros() as usize;
                    left &= left - 1;
                    // What is not a number is not known to be farther.
                    let behind = f64::from(met.near[k]) > memory.far[k] + self.slack;
                    if !behind {
                        asked += 1;
                        let (bundle, nearest) = (&bundles[k], &mut nearest[k]);
                        if !memory.thin[k].is_known() {
                            memory.thin[k].set(simd, bundle);
                        }
                        let passing = memory.thin[k].passing(simd, &slabs, bundle.live);
                        if passing != 0
                            && self.object_of_bundle(simd, (object, passing), bundle, nearest, memory, k)
                        {
                            memory.far[k] = nearest.farthest(simd, bundle);
                            memory.thin[k].look(
                                #[inline(always)]
                                |lane| nearest.t.0[lane] + self.slack,
                            );
                        }
                    }
                }
            }
            if asked > CROWD {
                for (found, bundle) in nearest.iter_mut().zip(bundles) {
                    found.unsure = bundle.live;
                }
                return;
            }
            push_nearest_last(&mut memory.stack, node, &met);
        }
    }

    /// The first hits of a bundle with one object, whose box some of its rays may pass. Answers whether any ray came near it.
    fn object_of_bundle<S: Simd>(
        &self,
        simd: S,
        (object, passing): (u32, u64),
        bundle: &Bundle,
        nearest: &mut Nearest,
        memory: &mut TileMemory,
        k: usize,
    ) -> bool {
        let primitives = &self.assembly.primitives;
        let own = &self.assembly.objects[object as usize];
        match &own.body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                let form = &primitives[*index as usize].form;
                if let Form::Ball(ball) = form {
                    let thin = &memory.thin[k];
                    return simd.vectorize(
                        #[inline(always)]
                        || {
                            let near = thin.near(simd, ball.center, ball.radius, passing);
                            ball_of_bundle(simd, (ball, form), near, bundle, nearest, [object, *index]);
                            near != 0
                        },
                    );
                }
                single(simd, form, (bundle, passing), nearest, [object, *index]);
                true
            }
            Body::Surface(index) => {
                memory.counts.primitive_tests += 1;
                let primitive = &primitives[*index as usize];
                let TileMemory { thin, sheared, found, .. } = memory;
                let sheared = &mut sheared[k];
                let wanted = asking(simd, &thin[k], &primitive.form, self.slack, passing);
                if wanted == 0 {
                    return false;
                }
                firsts_of_surface(simd, bundle, wanted, (primitive, *index), None, sheared, found);
                if found.any != 0 {
                    offer_found(simd, found, object, nearest);
                }
                found.any != 0
            }
            Body::Composite { whole, .. } => {
                let (from, to) = reach(simd, &memory.thin[k], &own.bounds, self.slack, passing);
                let way = (passing, from, to.min(memory.far[k] + self.slack));
                self.composite(simd, (object, Flat::from(&**whole)), bundle, way, nearest, memory);
                true
            }
        }
    }

    /// The first hits of a bundle with a composite object: its way through the object's box in slices, each with what the
    /// expression is there.
    fn composite<S: Simd>(
        &self,
        simd: S,
        (object, expression): (u32, Flat),
        bundle: &Bundle,
        (open, from, to): (u64, f64, f64),
        nearest: &mut Nearest,
        memory: &mut TileMemory,
    ) {
        memory.scratch.start();
        let whole = self.subs.loose(object).map(|loose| (loose, expression));
        let mut slicing = Slicing { fast: self, simd, bundle, object, open, nearest };
        slices(self, whole, &mut slicing, expression, (from, to), memory);
    }
}

/// The first hits of the rays of a bundle that are near a ball.
#[inline(always)]
fn ball_of_bundle<S: Simd>(
    simd: S,
    (ball, form): (&Ball, &Form),
    near: u64,
    bundle: &Bundle,
    nearest: &mut Nearest,
    [object, index]: [u32; 2],
) {
    let no = mask64x8::splat(simd, false);
    let zero = f64x8::splat(simd, 0.0);
    let primitive = f64x8::splat(simd, f64::from(index));
    let start = f64x8::splat(simd, 2.0 * ball.most_error());
    for row in 0..ROWS {
        if (near >> (row * LANES)) as u8 == 0 {
            continue;
        }
        let spans = ball.spans(&bundle.load(simd, row));
        if !spans.any.any() {
            continue;
        }
        let ahead = spans.enter.t.is_above(start);
        let met = if (spans.any & !ahead).any() {
            let starts = Starts { here: no, inward: no, off: None };
            let Firsts { end, entering, any } = firsts_of_spans(spans, form, &starts);
            Offer { any, t: end.t, entering, object, primitive, surface: zero }
        } else {
            Offer { any: spans.any, t: spans.enter.t, entering: !no, object, primitive, surface: zero }
        };
        nearest.offer(simd, row, &met);
    }
}

/// The frustum of a block of rays from the eye: that of its corners, where all start in the eye itself.
#[inline(always)]
fn beam_of<S: Simd>(simd: S, bundle: &Bundle) -> Beam {
    match corners(bundle, [0, 7, 56, 63]) {
        Some((o, d)) => Beam::between(o, d),
        None => Beam::around(simd, std::iter::once((bundle, None)), Spread::Apart),
    }
}

/// The frustum of a tile of four by four blocks, or of what there is at the rim of the picture.
#[inline(always)]
fn beam_of_tile<S: Simd>(simd: S, bundles: &[Bundle]) -> Beam {
    if bundles.len() == 16 {
        let ends = [(0, 0), (3, 7), (12, 56), (15, 63)].map(|(k, lane)| corners(&bundles[k], [lane; 4]));
        if let [Some((o, a)), Some((p, b)), Some((q, c)), Some((r, d))] = ends
            && o == p
            && o == q
            && o == r
        {
            return Beam::between(o, [a[0], b[0], c[0], d[0]]);
        }
    }
    Beam::around(simd, bundles.iter().map(|bundle| (bundle, None)), Spread::Apart)
}

/// Where a whole block of rays starts, and where four of them go; `None` where rays are missing, or have been moved
/// nearer to the world, each along its own way.
fn corners(bundle: &Bundle, lanes: [usize; 4]) -> Option<(DVec3, [DVec3; 4])> {
    let o = bundle.o.get(0);
    let one = [7, 56, 63].into_iter().all(|lane| bundle.o.get(lane) == o);
    (bundle.live == u64::MAX && one).then(|| (o, lanes.map(|lane| bundle.d.get(lane))))
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

impl<S: Simd> Slices for Slicing<'_, S> {
    fn open(&self) -> u64 {
        self.open
    }

    fn bounds(&self, from: f64, to: f64) -> Bounds {
        bounds_between(self.simd, self.bundle, from, to)
    }

    fn ask(&mut self, expression: Flat, (from, to): (f64, f64), memory: &mut TileMemory) {
        let (simd, bundle) = (self.simd, self.bundle);
        let reach = Reach { from: from - SLACK, to: to + SLACK };
        let primitives = &self.fast.assembly.primitives;
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        let TileMemory { scratch, found, .. } = memory;
        let asked = Asked { bundle, wanted: self.open, departures: None, reach };
        first_of_expressions(simd, &asked, expression, primitives, scratch, found);
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
                let met = Offer {
                    any: row_of(simd, found.any, row),
                    t: found.t.load(simd, row),
                    entering: row_of(simd, found.entering, row),
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
fn single<S: Simd>(
    simd: S,
    form: &Form,
    (bundle, wanted): (&Bundle, u64),
    nearest: &mut Nearest,
    [object, index]: [u32; 2],
) {
    #[inline(always)]
    fn rows<S: Simd>(
        simd: S,
        (form, bundle, wanted, object, index): (&Form, &Bundle, u64, u32, u32),
        nearest: &mut Nearest,
        spans: impl Fn(&Rays<f64x8<S>>) -> Spans<f64x8<S>>,
    ) {
        let no = mask64x8::splat(simd, false);
        let starts = Starts { here: no, inward: no, off: None };
        for row in 0..ROWS {
            if (wanted >> (row * LANES)) as u8 == 0 {
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
    let about = (form, bundle, wanted, object, index);
    with_spans!(simd, form, rows, about, nearest);
}

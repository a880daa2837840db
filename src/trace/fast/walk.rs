//! What every walk of a tile does.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::lattice::{Child, Met, Node, highest, lowest};
use crate::math::{Bounds, Bundle, DVec3, LANES, Mask, Number, ROWS};
use crate::solid::Form;

/// Puts the nodes among a node's children that were met on the stack, the nearest last.
#[inline(always)]
pub fn push_nearest_last<S: Simd>(stack: &mut Vec<(f64, u32)>, node: &Node, met: &Met<S>) {
    let first = stack.len();
    let mut left = met.boxes & node.inner();
    while left != 0 {
        let slot = left.trailing_zeros() as usize;
        left &= left - 1;
        if let Some(Child::Node(index)) = node.child(slot) {
            let near = f64::from(met.near[slot]);
            let mut place = stack.len();
            stack.push((near, index));
            while place > first && stack[place - 1].0 < near {
                stack.swap(place - 1, place);
                place -= 1;
            }
        }
    }
}

/// Which rays of a bundle pass a box, and between which distances all of these do; `None` where no ray does.
pub fn through<S: Simd>(simd: S, bundle: &Bundle, b: &Bounds) -> Option<(u64, f64, f64)> {
    simd.vectorize(
        #[inline(always)]
        || {
            let (mut any, mut from, mut to) = (0, f64::INFINITY, f64::NEG_INFINITY);
            for row in 0..ROWS {
                let live = bundle.live_in(row);
                if live == 0 {
                    continue;
                }
                let rays = bundle.load(simd, row);
                let zero = rays.o.x.same(0.0);
                let (mut near, mut far) = (zero, zero.same(f64::INFINITY));
                for axis in 0..3 {
                    let (o, d) = (rays.o.along(axis), rays.d.along(axis));
                    let inverse = zero.same(1.0) / d;
                    let (low, high) = ((-o + b.lo[axis]) * inverse, (-o + b.hi[axis]) * inverse);
                    // Along a face 0 · ∞ is no number, and both comparisons keep what is known.
                    near = low.smaller(high).is_above(near).choose(low.smaller(high), near);
                    far = low.larger(high).is_below(far).choose(low.larger(high), far);
                }
                let bits = near.is_at_most(far).bits() & live;
                any |= u64::from(bits) << (row * LANES);
                let mut left = bits;
                while left != 0 {
                    let lane = left.trailing_zeros() as usize;
                    left &= left - 1;
                    (from, to) = (from.min(near[lane]), to.max(far[lane]));
                }
            }
            (any != 0).then_some((any, from, to))
        },
    )
}

/// Which rays of a bundle are to be asked whether they meet a surface within a box. A polygon is as soon asked itself.
pub fn asking<S: Simd>(simd: S, bundle: &Bundle, form: &Form, b: &Bounds) -> u64 {
    match form {
        Form::Tube(_) => through(simd, bundle, b).map_or(0, |(any, ..)| any),
        _ => bundle.live,
    }
}

/// The box around the way of all rays of a bundle between two distances.
pub fn bounds_between<S: Simd>(simd: S, bundle: &Bundle, from: f64, to: f64) -> Bounds {
    simd.vectorize(
        #[inline(always)]
        || {
            let infinite = f64x8::splat(simd, f64::INFINITY);
            let (mut lo, mut hi) = ([infinite; 3], [-infinite; 3]);
            for row in 0..ROWS {
                if bundle.live_in(row) == 0 {
                    continue;
                }
                let rays = bundle.load(simd, row);
                for t in [from, to] {
                    let p = rays.at(infinite.same(t));
                    for axis in 0..3 {
                        lo[axis] = p.along(axis).smaller(lo[axis]);
                        hi[axis] = p.along(axis).larger(hi[axis]);
                    }
                }
            }
            let (lo, hi) = (
                [lowest(lo[0]), lowest(lo[1]), lowest(lo[2])],
                [highest(hi[0]), highest(hi[1]), highest(hi[2])],
            );
            Bounds::new(DVec3::from_array(lo), DVec3::from_array(hi))
        },
    )
}

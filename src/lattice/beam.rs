//! The frustum around a bundle of rays: what it does not meet, none of the rays meets.

use fearless_simd::{Simd, SimdBase, SimdMask, f32x8, f64x8};

use crate::math::{Bundle, Column, Columns, DVec3, Number, ROWS};
use crate::solid::WORLD;

/// A ray within the world, from anywhere that it may start at, has left it after so much of its way: the diameter of
/// a ball of radius [`WORLD`].
pub const WAY: f64 = 2.0 * WORLD;

/// How far rounding may put a dot product with a plane's normal off its place, for a normal whose components add up to
/// 1: three products and two sums of numbers up to [`WORLD`] + [`WAY`], on either side of the comparison, and the
/// point itself, a product and a sum. Ten roundings, rounded up to 16 half-ulps.
const ROUNDED: f64 = 8.0 * f64::EPSILON * (WORLD + WAY);

/// What half the digits lose of a dot product with a plane's normal, as a share of what the normal's components add up
/// to: six products and five sums of rounded numbers, for points within 2.01 of the origin on each axis, and the offset:
/// 14 roundings of numbers up to 2.01, rounded up to 32 · 2⁻²⁴. A difference with the place of a start, which is within
/// [`WORLD`], takes 16 · 2⁻²⁴ more; but three products and two sums are all that is there before it.
const LOST: f64 = 32.0 / 16_777_216.0;

/// The least cosine between a ray and the beam's axis: past 78° off the slopes, and with them the planes, say little.
const COHERENT: f64 = 0.2;

/// A plane; points in front of it have `normal · p ≥ offset`.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// Everything is in front.
    const NOWHERE: Self = Self { normal: DVec3::ZERO, offset: f64::NEG_INFINITY };

    /// Of eight boxes side by side, how far the foremost point of each lies along the normal.
    #[inline(always)]
    fn foremost<S: Simd>(&self, lo: &[f32x8<S>; 3], hi: &[f32x8<S>; 3]) -> f32x8<S> {
        let n = self.normal;
        let x = if n.x > 0.0 { hi[0] } else { lo[0] };
        let y = if n.y > 0.0 { hi[1] } else { lo[1] };
        let z = if n.z > 0.0 { hi[2] } else { lo[2] };
        x * n.x as f32 + y * n.y as f32 + z * n.z as f32
    }

    /// The offset that [`Self::foremost`] is to be compared with.
    #[inline(always)]
    fn before(&self) -> f32 {
        (self.offset - lost(self.normal)) as f32
    }
}

/// How a bundle of rays spreads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// From one point, or in no order: planes through the outermost rays.
    Apart,
    /// Towards one point at the end of each.
    Together,
}

/// The space that a bundle of rays passes, bounded by planes.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    sides: [Plane; 4],
    axis: DVec3,
    /// Nothing that lies behind these along the axis is met.
    first: f64,
    last: f64,
    /// A point `p` is no nearer to the start of any ray than `axis · p − start`.
    start: f64,
}

/// Boxes that a beam meets, one bit for each, and how near each is at least to any ray's start.
#[derive(Clone, Copy, Debug)]
pub struct Met<S: Simd> {
    /// The first box is the lowest bit.
    pub boxes: u8,
    /// At least so far away, for each.
    pub near: f32x8<S>,
}

/// Lights farther away than this are no apex for planes: what rounding makes of their place would be more than what
/// the planes are moved outward by.
const NEAR: f64 = WAY;

impl Beam {
    /// The beam of rays that start in one point and lie between four of them.
    pub fn between(o: DVec3, corners: [DVec3; 4]) -> Self {
        let axis = (corners[0] + corners[1] + corners[2] + corners[3]).normalize_or(DVec3::X);
        let u = (corners[1] - corners[0]).cross(axis).normalize_or(axis.any_orthonormal_vector());
        let u = u.cross(axis).normalize_or(u);
        let across = [u, axis.cross(u)];
        let (mut low, mut high, mut least) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], f64::INFINITY);
        for d in corners {
            let w = d.dot(axis);
            least = least.min(w);
            for slot in 0..2 {
                let slope = d.dot(across[slot]) / w;
                (low[slot], high[slot]) = (low[slot].min(slope), high[slot].max(slope));
            }
        }
        let mut sides = [Plane::NOWHERE; 4];
        if least > COHERENT {
            for slot in 0..2 {
                let normals = [across[slot] - low[slot] * axis, high[slot] * axis - across[slot]];
                for (side, normal) in sides[2 * slot..].iter_mut().zip(normals) {
                    *side = Plane { normal, offset: normal.dot(o) - margin(normal) };
                }
            }
        }
        let (at, off) = (axis.dot(o), margin(axis));
        Self { sides, axis, first: at - off, last: at + WAY + off, start: at + off }
    }

    /// The beam around the live rays of some bundles, which all go to one point.
    #[inline(always)]
    pub fn towards<'b, S: Simd>(
        simd: S,
        bundles: impl Iterator<Item = (&'b Bundle, &'b Column)> + Clone,
        apex: DVec3,
    ) -> Self {
        if apex.abs().max_element() > NEAR {
            let bundles = bundles.map(|(bundle, distance)| (bundle, Some(distance)));
            return Self::around(simd, bundles, Spread::Together);
        }
        let mut sum = DVec3::ZERO;
        for (bundle, _) in bundles.clone() {
            if bundle.live != 0 {
                // Corners and middle: enough for a direction in between.
                for lane in [0, 7, 27, 36, 56, 63] {
                    sum += bundle.d.get(lane);
                }
            }
        }
        let axis = sum.normalize_or(DVec3::X);
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);
        let infinite = f64x8::splat(simd, f64::INFINITY);
        let (mut low, mut high, mut least) = ([infinite; 2], [-infinite; 2], infinite);
        let (mut nearest, mut farthest) = (infinite, -infinite);
        for (bundle, _) in bundles {
            if bundle.live == 0 {
                continue;
            }
            for row in 0..ROWS {
                let rays = bundle.load(simd, row);
                let w = rays.d.dot_one(axis);
                least = w.smaller(least);
                let inverse = w.same(1.0) / w;
                let slopes = [rays.d.dot_one(u) * inverse, rays.d.dot_one(v) * inverse];
                for slot in 0..2 {
                    low[slot] = slopes[slot].smaller(low[slot]);
                    high[slot] = slopes[slot].larger(high[slot]);
                }
                let at = rays.o.dot_one(axis);
                nearest = at.smaller(nearest);
                farthest = at.larger(farthest);
            }
        }
        let mut sides = [Plane::NOWHERE; 4];
        if lowest(least) > COHERENT {
            for slot in 0..2 {
                let across = [u, v][slot];
                // Seen from the apex, what comes from one side lies on the other.
                let normals = [across - highest(high[slot]) * axis, lowest(low[slot]) * axis - across];
                for k in 0..2 {
                    let normal = normals[k];
                    sides[2 * slot + k] = Plane { normal, offset: normal.dot(apex) - margin(normal) };
                }
            }
        }
        let (at, off) = (axis.dot(apex), margin(axis));
        let (nearest, farthest) = (lowest(nearest), highest(farthest));
        Self { sides, axis, first: nearest - off, last: at.max(farthest) + off, start: farthest + off }
    }

    /// The beam around the live rays of some bundles, as far as `reach` of each.
    #[inline(always)]
    pub fn around<'b, S: Simd>(
        simd: S,
        bundles: impl Iterator<Item = (&'b Bundle, Option<&'b Column>)> + Clone,
        spread: Spread,
    ) -> Self {
        let live = || bundles.clone().filter(|(bundle, _)| bundle.live != 0);
        let mut sum = DVec3::ZERO;
        for (bundle, _) in live() {
            // Corners and middle: enough for a direction in between.
            for lane in [0, 7, 27, 36, 56, 63] {
                sum += bundle.d.get(lane);
            }
        }
        let axis = sum.normalize_or(DVec3::X);
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);

        let infinite = f64x8::splat(simd, f64::INFINITY);
        let (mut low, mut high, mut least) = ([infinite; 2], [-infinite; 2], infinite);
        for (bundle, _) in live() {
            for row in 0..ROWS {
                let d = bundle.d.load(simd, row);
                let w = d.dot_one(axis);
                least = w.smaller(least);
                let inverse = w.same(1.0) / w;
                let slopes = [d.dot_one(u) * inverse, d.dot_one(v) * inverse];
                for slot in 0..2 {
                    low[slot] = slopes[slot].smaller(low[slot]);
                    high[slot] = slopes[slot].larger(high[slot]);
                }
            }
        }
        let coherent = lowest(least) > COHERENT;
        let mut normals = [DVec3::ZERO; 4];
        if coherent {
            for slot in 0..2 {
                let across = [u, v][slot];
                let (low, high) = (lowest(low[slot]), highest(high[slot]));
                let (below, above) = if spread == Spread::Apart { (low, high) } else { (high, low) };
                normals[2 * slot] = across - below * axis;
                normals[2 * slot + 1] = above * axis - across;
            }
        }
        let mut offsets = [infinite; 4];
        let (mut first, mut last, mut start) = (infinite, -infinite, -infinite);
        for (bundle, reach) in bundles.filter(|(bundle, _)| bundle.live != 0) {
            for row in 0..ROWS {
                let rays = bundle.load(simd, row);
                let mut way = f64x8::splat(simd, WAY);
                if let Some(reach) = reach {
                    way = reach.load(simd, row).smaller(way);
                }
                // Of a segment the ends are the outermost.
                for k in 0..4 {
                    let (at, on) = (rays.o.dot_one(normals[k]), rays.d.dot_one(normals[k]) * way);
                    offsets[k] = at.smaller(at + on).smaller(offsets[k]);
                }
                let (at, on) = (rays.o.dot_one(axis), rays.d.dot_one(axis) * way);
                first = at.smaller(at + on).smaller(first);
                last = at.larger(at + on).larger(last);
                start = at.larger(start);
            }
        }
        let sides = std::array::from_fn(|k| {
            if coherent {
                Plane { normal: normals[k], offset: lowest(offsets[k]) - margin(normals[k]) }
            } else {
                Plane::NOWHERE
            }
        });
        let off = margin(axis);
        let (first, last, start) = (lowest(first) - off, highest(last) + off, highest(start) + off);
        Self { sides, axis, first, last, start }
    }

    /// All its planes, each a normal and an offset below which nothing is met: the four sides, the first and the last
    /// along its axis. And what is to be taken from the place of a point along the axis to know how near it is at
    /// least to the start of any ray.
    pub fn planes(&self) -> ([(DVec3, f64); 6], f64) {
        let [a, b, c, d] = self.sides.map(|side| (side.normal, side.offset));
        ([a, b, c, d, (self.axis, self.first), (-self.axis, -self.last)], self.start)
    }

    /// Which of eight boxes, by axis, the beam may meet. An empty one, whose sides are the wrong way round, is never met.
    #[inline(always)]
    pub fn meets_boxes<S: Simd>(&self, simd: S, lo: &[f32x8<S>; 3], hi: &[f32x8<S>; 3]) -> Met<S> {
        let mut met = lo[0].simd_le(hi[0]);
        for side in &self.sides {
            met &= !side.foremost(lo, hi).simd_lt(f32x8::splat(simd, side.before()));
        }
        let forward = Plane { normal: self.axis, offset: self.first };
        let backward = Plane { normal: -self.axis, offset: -self.last };
        let (farthest, nearest) = (forward.foremost(lo, hi), backward.foremost(lo, hi));
        met &= !farthest.simd_lt(f32x8::splat(simd, forward.before()))
            & !nearest.simd_lt(f32x8::splat(simd, backward.before()));
        let start = (self.start + lost(self.axis)) as f32;
        Met { boxes: met.to_bitmask() as u8, near: -nearest - start }
    }
}

/// The least of eight.
#[inline(always)]
pub fn lowest<S: Simd>(x: f64x8<S>) -> f64 {
    x.to_array().into_iter().fold(f64::INFINITY, |least, x| if x < least { x } else { least })
}

/// The greatest of eight.
#[inline(always)]
pub fn highest<S: Simd>(x: f64x8<S>) -> f64 {
    -lowest(-x)
}

/// How far a plane is moved outward where it is compared with half the digits.
#[inline(always)]
pub(super) fn lost(normal: DVec3) -> f64 {
    LOST * normal.abs().element_sum()
}

/// How far a plane is moved outward for what rounding may do.
fn margin(normal: DVec3) -> f64 {
    ROUNDED * normal.abs().element_sum()
}

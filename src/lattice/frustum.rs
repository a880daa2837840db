//! The frustum around a packet of rays: what it does not meet, none of the rays meets.

use fearless_simd::{Simd, SimdBase, SimdMask, f32x8, f64x8};

use crate::math::{DVec3, LaneVector, Lanes, Number, REGISTERS, RayPacket};
use crate::solid::WORLD;

use super::slopes::{Basis, COHERENT, Slopes, Spread, highest, lowest};

/// A ray within the world, from anywhere that it may start at, has left it after this length: the diameter of
/// a ball of radius [`WORLD`].
pub const LONGEST_PATH: f64 = 2.0 * WORLD;

/// How far rounding may put a dot product with a plane's normal off its place, for a normal whose components
/// add up to 1: three products and two sums of numbers up to [`WORLD`] + [`LONGEST_PATH`], on either side of
/// the comparison, and the point itself, a product and a sum. Ten roundings, rounded up to 16 half-ulps.
const ROUNDED: f64 = 8.0 * f64::EPSILON * (WORLD + LONGEST_PATH);

/// What single precision lose of a dot product with a plane's normal, as a share of what the normal's
/// components add up to: six products and five sums of rounded numbers, for points within 2.01 of the origin
/// on each axis, and the offset: 14 roundings of numbers up to 2.01, rounded up to 32 · 2⁻²⁴. A difference
/// with the place of a start, which is within [`WORLD`], takes 16 · 2⁻²⁴ more; but three products and two
/// sums are all that is there before it.
const LOST: f64 = 32.0 / 16_777_216.0;

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

/// The space that a packet of rays passes, bounded by planes.
#[derive(Clone, Copy, Debug)]
pub struct Frustum {
    sides: [Plane; 4],
    axis: DVec3,
    /// Nothing that lies behind these along the axis is met.
    first: f64,
    last: f64,
    /// A point `p` is no nearer to the start of any ray than `axis · p − start`.
    start: f64,
}

/// Boxes that a frustum meets, one bit for each, and how near each is at least to any ray's start.
#[derive(Clone, Copy, Debug)]
pub struct FrustumHits<S: Simd> {
    /// The first box is the lowest bit.
    pub boxes: u8,
    /// At least so far away, for each.
    pub near: f32x8<S>,
}

/// Lights farther away than this are no apex for planes: what rounding makes of their place would be a
/// thousandth of what single precision lose ([`LOST`]).
const NEAR: f64 = (1_u32 << 20) as f64;

/// Planes through one point.
#[inline(always)]
fn through(point: DVec3, normals: [DVec3; 4]) -> [Plane; 4] {
    let [a, b, c, d] = normals;
    let plane = |normal: DVec3| Plane { normal, offset: normal.dot(point) - margin_at(normal, point) };
    [plane(a), plane(b), plane(c), plane(d)]
}

/// The rays of a packet to one point, as far as they matter to a frustum.
#[derive(Clone, Copy, Debug)]
struct Extents {
    slopes: Slopes,
    /// Where the rays start along the axis.
    nearest: f64,
    farthest: f64,
}

impl Extents {
    const NONE: Self = Self { slopes: Slopes::NONE, nearest: f64::INFINITY, farthest: f64::NEG_INFINITY };

    #[inline(always)]
    fn of<S: Simd>(simd: S, packet: &RayPacket, basis: &Basis) -> Self {
        let infinite = f64x8::splat(simd, f64::INFINITY);
        let (mut nearest, mut farthest) = (infinite, -infinite);
        for register in 0..REGISTERS {
            let at = packet.o.load(simd, register).dot_one(basis.axis);
            nearest = at.smaller(nearest);
            farthest = at.larger(farthest);
        }
        let slopes = Slopes::of(simd, packet, basis);
        Self { slopes, nearest: lowest(nearest), farthest: highest(farthest) }
    }

    #[inline(always)]
    fn join(&mut self, other: &Self) {
        self.slopes.join(&other.slopes);
        self.nearest = self.nearest.min(other.nearest);
        self.farthest = self.farthest.max(other.farthest);
    }

    #[inline(always)]
    fn frustum(&self, basis: &Basis, apex: DVec3) -> Frustum {
        let axis = basis.axis;
        let (at, off) = (axis.dot(apex), margin_at(axis, apex));
        Frustum {
            sides: (self.slopes.normals(basis, Spread::Converging))
                .map_or([Plane::NOWHERE; 4], |normals| through(apex, normals)),
            axis,
            // Some may go backward.
            first: at.min(self.nearest) - off,
            last: at.max(self.farthest) + off,
            start: self.farthest + off,
        }
    }
}

impl Frustum {
    /// The frustum of rays from one point, however far away, that lie between four of them. Those that come
    /// from far start nearer, moved by up to `moved`. The sides run along those of `basis`, unless the rays
    /// go elsewhere.
    pub fn between(o: DVec3, corners: [DVec3; 4], moved: f64, basis: &Basis) -> Self {
        let (mut basis, mut slopes) = (*basis, Slopes::between(&corners, basis));
        if slopes.least <= COHERENT {
            basis = Basis::of_corners(corners);
            slopes = Slopes::between(&corners, &basis);
        }
        let axis = basis.axis;
        let Some(normals) = slopes.normals(&basis, Spread::Diverging) else {
            // Some may even go backward.
            let (sides, all) = ([Plane::NOWHERE; 4], f64::INFINITY);
            return Self { sides, axis, first: -all, last: all, start: all };
        };
        let (at, far) = (axis.dot(o), margin_at(axis, o));
        // Nothing that is met lies beyond the world.
        let last = at.max(0.0) + LONGEST_PATH + far;
        Self { sides: through(o, normals), axis, first: at - far, last, start: at + moved + far }
    }

    /// The frustums around packets that all go to one point, each with how far, and the frustum around them
    /// all. There is none for what is absent, or has no live ray.
    #[inline(always)]
    pub fn towards<'b, S: Simd>(
        simd: S,
        packets: &(impl Iterator<Item = Option<(&'b RayPacket, &'b Lanes)>> + Clone),
        apex: DVec3,
        frustums: &mut Vec<Option<Self>>,
    ) -> Self {
        frustums.clear();
        let live = || packets.clone().map(|b| b.filter(|(packet, _)| packet.live != 0));
        if apex.abs().max_element() > NEAR {
            let far = live().flatten().map(|(packet, distance)| (packet, Some(distance)));
            let all = Self::around(simd, far, Spread::Converging);
            for packet in live() {
                frustums.push(packet.map(
                    #[inline(always)]
                    |(packet, distance)| {
                        Self::around(simd, std::iter::once((packet, Some(distance))), Spread::Converging)
                    },
                ));
            }
            return all;
        }
        let basis = Basis::along(live().flatten().map(|(packet, _)| packet));
        let mut all = Extents::NONE;
        for packet in live() {
            let Some((packet, _)) = packet else {
                frustums.push(None);
                continue;
            };
            let extents = Extents::of(simd, packet, &basis);
            all.join(&extents);
            frustums.push(Some(extents.frustum(&basis, apex)));
        }
        all.frustum(&basis, apex)
    }

    /// The frustum around the live rays of some packets, as far as `reach` of each.
    #[inline(always)]
    pub fn around<'b, S: Simd>(
        simd: S,
        packets: impl Iterator<Item = (&'b RayPacket, Option<&'b Lanes>)> + Clone,
        spread: Spread,
    ) -> Self {
        let live = || packets.clone().filter(|(packet, _)| packet.live != 0);
        let basis = Basis::along(live().map(|(packet, _)| packet));
        let mut slopes = Slopes::NONE;
        for (packet, _) in live() {
            slopes.join(&Slopes::of(simd, packet, &basis));
        }
        let axis = basis.axis;
        let coherent = slopes.normals(&basis, spread);
        let normals = coherent.unwrap_or_default();
        let infinite = f64x8::splat(simd, f64::INFINITY);
        let mut offsets = [infinite; 4];
        let (mut first, mut last, mut start) = (infinite, -infinite, -infinite);
        for (packet, reach) in packets.filter(|(packet, _)| packet.live != 0) {
            for register in 0..REGISTERS {
                let rays = packet.load(simd, register);
                let mut length = f64x8::splat(simd, LONGEST_PATH);
                if let Some(reach) = reach {
                    length = reach.load(simd, register).smaller(length);
                }
                // Of a segment the ends are the outermost.
                for k in 0..4 {
                    let (at, on) = (rays.o.dot_one(normals[k]), rays.d.dot_one(normals[k]) * length);
                    offsets[k] = at.smaller(at + on).smaller(offsets[k]);
                }
                let (at, on) = (rays.o.dot_one(axis), rays.d.dot_one(axis) * length);
                first = at.smaller(at + on).smaller(first);
                last = at.larger(at + on).larger(last);
                start = at.larger(start);
            }
        }
        let sides = std::array::from_fn(|k| {
            if coherent.is_some() {
                Plane { normal: normals[k], offset: lowest(offsets[k]) - margin(normals[k]) }
            } else {
                Plane::NOWHERE
            }
        });
        let off = margin(axis);
        let (first, last, start) = (lowest(first) - off, highest(last) + off, highest(start) + off);
        Self { sides, axis, first, last, start }
    }

    /// All its planes, each a normal and an offset below which nothing is met: the four sides, the first and
    /// the last along its axis. And what is to be taken from the place of a point along the axis to know how
    /// near it is at least to the start of any ray.
    #[inline]
    pub fn planes(&self) -> ([(DVec3, f64); 6], f64) {
        let [a, b, c, d] = &self.sides;
        let side = |side: &Plane| (side.normal, side.offset);
        ([side(a), side(b), side(c), side(d), (self.axis, self.first), (-self.axis, -self.last)], self.start)
    }

    /// Which of eight boxes, by axis, the frustum may meet. An empty one, whose sides are swapped, is never
    /// met.
    #[inline(always)]
    pub fn meets_boxes<S: Simd>(&self, simd: S, lo: &[f32x8<S>; 3], hi: &[f32x8<S>; 3]) -> FrustumHits<S> {
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
        FrustumHits { boxes: met.to_bitmask() as u8, near: -nearest - start }
    }
}

/// How far a plane is moved outward where it is compared in single precision.
#[inline(always)]
pub(super) fn lost(normal: DVec3) -> f64 {
    LOST * normal.abs().element_sum()
}

/// How far a plane is moved outward for what rounding may do.
fn margin(normal: DVec3) -> f64 {
    ROUNDED * normal.abs().element_sum()
}

/// The same, for a plane through a point that may be far away, and through corners seen from there: three
/// products and two sums of numbers as large as that; and what the eight roundings of a direction's
/// component, of a ray and of a corner, are at the other end of such a length. 21 roundings, rounded up to 32
/// half-ulps.
fn margin_at(normal: DVec3, point: DVec3) -> f64 {
    let farther = 16.0 * f64::EPSILON * point.abs().max_element();
    (ROUNDED + farther) * normal.abs().element_sum()
}

//! A triangle against the rays of a packet, sixteen at a time in single precision.
//!
//! A ray passes a triangle's three edges on one side, or not: the sign of a product of six numbers each
//! (Plücker coordinates, seen from the first ray's start, where most of them are small). Beside each product
//! stands a bound of what rounding takes from it, and from what the exact decision ([`super::ray_shear`])
//! itself rounds. So a triangle is certainly crossed, certainly missed, or in doubt: close to an edge, edge
//! on, or at the ray's start.

use fearless_simd::{Simd, SimdBase, SimdMask, f32x16, mask32x16};

use crate::math::{DVec3, PACKET, ROW, ROWS, RayPacket, row_of, splats};

use super::ray_shear::STEEP;

/// Half an ulp of a number near 1, in single precision.
pub(super) const HALF_ULP: f64 = 1.0 / 16_777_216.0;

/// What is lost of the product of a direction and an edge's moment, as a share of that moment's components
/// added up: both are rounded (2), each product (1) and five sums (5): 8, rounded up to 10.
const LOST_OF_MOMENT: f64 = 10.0 * HALF_ULP;

/// What is lost of the product of a ray's moment and an edge, as a share of the edge's components added up
/// and of how far starts lie from the first: a moment is a difference of two such lengths, of rounded starts
/// and directions (2), the products (1) and the difference (1), twice; the edge is rounded (1), the product
/// (1), and five sums (5). 2 · 4 + 2 · 7 is 22, rounded up to 24.
const LOST_OF_EDGE: f64 = 24.0 * HALF_ULP;

/// What double precision loses of the same products, here and in the exact decision, as a share of the square
/// of how far corners may lie from a start: each corner's place across the ray takes five roundings, the area
/// of two of them three more, here a moment takes six; of two corners, 28 half-ulps, rounded up to 32.
const LOST_OF_SQUARE: f64 = 16.0 * f64::EPSILON;

/// What is lost of a distance, as a share of it and of the inverse of the sine: the product of direction and
/// normal (both rounded, three products, two sums: 5), the height over the plane (2), the inverse and its
/// product (2): 9, rounded up to 10.
const LOST_OF_DISTANCE: f64 = 10.0 * HALF_ULP;

/// The same as a share of how far starts lie from the first: 2 roundings, the product and three sums are 6,
/// and one of the height; rounded up to 8.
const LOST_OF_START: f64 = 8.0 * HALF_ULP;

/// A triangle lower than this share of its longest edge is never certain: its normal is mostly rounding.
const FLAT: f64 = 1.0 / 65_536.0;

/// What that leaves of a distance, as a share of the longest edge: 2⁻⁵⁰ over [`FLAT`] and the least sine.
const LOST_OF_PLANE: f64 = 1.0 / 4_194_304.0;

/// Edges shorter than this, or longer, are never certain: squares of squares of them are not far from the
/// limits of single precision.
const PLAIN_EDGES: std::ops::Range<f64> = 1e-15..64.0;

/// Starts farther from the origin than this are not those of rays within the world.
const WITHIN: f64 = 16.0;

/// Rays of a packet, seen from the start of its first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct RayColumns {
    o: [[f32; PACKET]; 3],
    d: [[f32; PACKET]; 3],
    moment: [[f32; PACKET]; 3],
    pub starts: Starts,
}

/// Where rays start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Starts {
    /// Where the first does.
    base: DVec3,
    /// How far they lie from there at most, along any axis.
    pub spread: f64,
    /// What is lost of a distance besides a share of itself, over the sine of the angle.
    pub lost: f64,
}

impl RayColumns {
    /// No rays.
    pub const EMPTY: Self = Self {
        o: [[0.0; PACKET]; 3],
        d: [[0.0; PACKET]; 3],
        moment: [[0.0; PACKET]; 3],
        starts: Starts { base: DVec3::ZERO, spread: 0.0, lost: 0.0 },
    };

    /// Takes the rays of a packet, of whose distances so much is lost, besides what rounding of their starts
    /// takes. False where they are not all within the world: nothing can be said then.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, packet: &RayPacket, lost: f64) -> bool {
        let mut spread = 0.0_f64;
        for axis in 0..3 {
            let base = packet.o[axis].0[0];
            self.starts.base[axis] = base;
            let mut farthest = base.abs();
            for lane in 0..PACKET {
                let o = packet.o[axis].0[lane] - base;
                self.o[axis][lane] = o as f32;
                self.d[axis][lane] = packet.d[axis].0[lane] as f32;
                let o = o.abs();
                farthest = if o > farthest { o } else { farthest };
                spread = if o > spread { o } else { spread };
            }
            // What is not a number is not within.
            let is_within = farthest < WITHIN;
            if !is_within {
                return false;
            }
        }
        (self.starts.spread, self.starts.lost) = (spread, LOST_OF_START * spread + lost);
        if spread > 0.0 {
            for row in 0..ROWS {
                let (o, d) = (rows(simd, &self.o, row), rows(simd, &self.d, row));
                for axis in 0..3 {
                    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                    let moment = o[next] * d[last] - o[last] * d[next];
                    moment.store_slice(&mut self.moment[axis][row * ROW..][..ROW]);
                }
            }
        }
        true
    }
}

/// A triangle, for sixteen rays.
pub(super) struct SplatTriangle<S: Simd> {
    /// A side is certain above this.
    bound: f32x16<S>,
    /// Which product of direction and normal is steep.
    steep: f32x16<S>,
    /// How high the plane lies over the base, by the normal.
    height: f32x16<S>,
    /// The normal's components added up.
    area: f32x16<S>,
    /// [`Starts::lost`].
    lost: f32x16<S>,
    lost_of_plane: f32x16<S>,
    moments: [[f32x16<S>; 3]; 3],
    edges: [[f32x16<S>; 3]; 3],
    normal: [f32x16<S>; 3],
}

/// How the rays of a row pass a triangle.
pub(super) struct TestedRow<S: Simd> {
    /// Whose lines certainly pass through it.
    pub inside: mask32x16<S>,
    /// Which certainly cross it ahead of their starts.
    pub hit: mask32x16<S>,
    /// Which may cross it ahead of their starts, or not.
    pub doubt: mask32x16<S>,
    /// Which are steep enough for `t` to mean anything.
    pub is_steep: mask32x16<S>,
    pub t: f32x16<S>,
    pub error: f32x16<S>,
}

impl<S: Simd> SplatTriangle<S> {
    /// What is the same of a triangle for all rays.
    #[inline(always)]
    pub fn new(simd: S, [a, b, c]: [DVec3; 3], starts: &Starts) -> Self {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ab.cross(c - a);
        let (a, b, c) = (a - starts.base, b - starts.base, c - starts.base);
        let (m_ab, m_bc, m_ca) = (a.cross(ab), b.cross(bc), c.cross(ca));
        let longest = larger(larger(one_norm(ab), one_norm(bc)), one_norm(ca));
        let far = larger(larger(one_norm(a), one_norm(b)), one_norm(c)) + starts.spread;
        let moment = larger(larger(one_norm(m_ab), one_norm(m_bc)), one_norm(m_ca));
        let bound =
            LOST_OF_MOMENT * moment + LOST_OF_EDGE * starts.spread * longest + LOST_OF_SQUARE * far * far;
        let area = one_norm(normal);
        // Else never steep.
        let is_plain = area > FLAT * longest * longest && PLAIN_EDGES.contains(&longest);
        let steep = if is_plain { 2.0 * STEEP * area } else { f64::INFINITY };
        Self {
            bound: f32x16::splat(simd, bound as f32),
            steep: f32x16::splat(simd, steep as f32),
            height: f32x16::splat(simd, a.dot(normal) as f32),
            area: f32x16::splat(simd, area as f32),
            lost: f32x16::splat(simd, starts.lost as f32),
            lost_of_plane: f32x16::splat(simd, (LOST_OF_PLANE * longest) as f32),
            moments: [splats(simd, m_ab), splats(simd, m_bc), splats(simd, m_ca)],
            edges: [splats(simd, ab), splats(simd, bc), splats(simd, ca)],
            normal: splats(simd, normal),
        }
    }

    /// How the rays of a row pass a triangle; nothing where all certainly pass beside it.
    #[inline(always)]
    pub fn test(&self, simd: S, rays: &RayColumns, row: usize) -> Option<TestedRow<S>> {
        let is_spread = rays.starts.spread > 0.0;
        let d = rows(simd, &rays.d, row);
        let mut sides = [dot(&d, &self.moments[0]), dot(&d, &self.moments[1]), dot(&d, &self.moments[2])];
        if is_spread {
            let m = rows(simd, &rays.moment, row);
            sides[0] += dot(&m, &self.edges[0]);
            sides[1] += dot(&m, &self.edges[1]);
            sides[2] += dot(&m, &self.edges[2]);
        }
        let least = sides[0].min(sides[1]).min(sides[2]);
        let most = sides[0].max(sides[1]).max(sides[2]);
        let maybe = !(most.simd_gt(self.bound) & least.simd_lt(-self.bound));
        if !maybe.any_true() {
            return None;
        }
        let inside = maybe & (least.simd_gt(self.bound) | most.simd_lt(-self.bound));
        let towards = dot(&d, &self.normal);
        let inverse = f32x16::splat(simd, 1.0) / towards;
        let mut height = self.height;
        if is_spread {
            height -= dot(&rows(simd, &rays.o, row), &self.normal);
        }
        let t = height * inverse;
        let share = f32x16::splat(simd, LOST_OF_DISTANCE as f32);
        let error = inverse.abs() * self.area * (t.abs() * share + self.lost) + self.lost_of_plane;
        let is_steep = towards.abs().simd_gt(self.steep);
        let certain = is_steep & inside;
        let hit = certain & t.simd_gt(error);
        let doubt = maybe & !(hit | (certain & t.simd_lt(-error)));
        Some(TestedRow { inside, hit, doubt, is_steep, t, error })
    }
}

/// The length of a vector as its components add up, without their signs.
#[inline(always)]
fn one_norm(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// The larger of two numbers.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Sixteen of a vector of each ray.
#[inline(always)]
fn rows<S: Simd>(simd: S, numbers: &[[f32; PACKET]; 3], row: usize) -> [f32x16<S>; 3] {
    [row_of(simd, &numbers[0], row), row_of(simd, &numbers[1], row), row_of(simd, &numbers[2], row)]
}

#[inline(always)]
fn dot<S: Simd>(a: &[f32x16<S>; 3], b: &[f32x16<S>; 3]) -> f32x16<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

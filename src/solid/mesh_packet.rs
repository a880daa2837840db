//! The rays of a packet against the triangles of a mesh, sixteen at a time in single precision.
//!
//! A ray passes a triangle's three edges on one side, or not: the sign of a product of six numbers each
//! (Plücker coordinates, seen from the first ray's start, where most of them are small). Beside each product
//! stands a bound of what rounding takes from it, and from what the exact decision ([`super::ray_shear`])
//! itself rounds. So a triangle is certainly crossed, certainly missed, or in doubt: close to an edge, edge
//! on, or at the ray's start. A ray's answer counts where one crossing is certain, and no other one, nor any
//! doubt, lies so near before or behind it that both could be one place. All other rays are asked one by one.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

use crate::math::{DVec3, Lanes, PACKET, ROW, ROWS, RayPacket, lanes, row_of, splats};

use super::csg_query::Departures;
use super::mesh_lists::MeshLists;
use super::ray_shear::{ONE_PLACE, STEEP};

/// Half an ulp of a number near 1, in single precision.
const HALF_ULP: f64 = 1.0 / 16_777_216.0;

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

/// Stands for no triangle.
const NONE: u32 = u32::MAX;

/// Rays of a packet, seen from the start of its first, and what each crosses first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct MeshPacket {
    o: [[f32; PACKET]; 3],
    d: [[f32; PACKET]; 3],
    moment: [[f32; PACKET]; 3],
    /// The distance of the first certain crossing, or how far the ray matters; below all numbers for a ray
    /// that is not asked about. And how far it may be off.
    t: [f32; PACKET],
    error: [f32; PACKET],
    /// What else the ray crosses, or may cross, is no nearer than this.
    second: [f32; PACKET],
    surface: Lanes<u32>,
    /// The triangle that each ray leaves.
    leaves: Lanes<u32>,
    /// Whether any ray leaves one.
    any_leaves: bool,
    base: DVec3,
    /// How far starts lie from `base` at most, along any axis.
    spread: f64,
    /// What is lost of a distance besides a share of itself, over the sine of the angle.
    lost: f64,
}

/// A triangle, for sixteen rays.
struct SplatTriangle<S: Simd> {
    /// A side is certain above this.
    bound: f32x16<S>,
    /// Which product of direction and normal is steep.
    steep: f32x16<S>,
    /// How high the plane lies over the base, by the normal.
    height: f32x16<S>,
    /// The normal's components added up.
    area: f32x16<S>,
    /// [`MeshPacket::lost`].
    lost: f32x16<S>,
    lost_of_plane: f32x16<S>,
    moments: [[f32x16<S>; 3]; 3],
    edges: [[f32x16<S>; 3]; 3],
    normal: [f32x16<S>; 3],
}

/// How the rays of a row pass a triangle.
struct TestedRow<S: Simd> {
    /// Whose lines certainly pass through it.
    inside: mask32x16<S>,
    /// Which certainly cross it ahead of their starts.
    hit: mask32x16<S>,
    /// Which may cross it ahead of their starts, or not.
    doubt: mask32x16<S>,
    /// Which are steep enough for `t` to mean anything.
    is_steep: mask32x16<S>,
    t: f32x16<S>,
    error: f32x16<S>,
}

/// What is certain of the rays of a packet, a bit for each.
#[derive(Clone, Copy, Debug)]
pub struct MeshAnswer {
    /// Which certainly cross the mesh.
    pub hits: u64,
    /// Which are to be asked one by one.
    pub uncertain: u64,
}

/// Which rays of a packet ask, and what is known of them.
#[derive(Clone, Copy, Debug)]
pub struct MeshQuery<'a> {
    /// The rays, closed.
    pub packet: &'a RayPacket,
    /// Those that ask, a bit for each.
    pub wanted: u64,
    /// The surfaces that they leave; none for rays from the eye.
    pub departures: Option<&'a Departures>,
    /// The mesh, by its index among the primitives.
    pub primitive: u32,
    /// How far away what they meet may be to matter.
    pub limits: &'a [f32; PACKET],
    /// How far any primitive may be off its place.
    pub place_error: f64,
    /// How far one may be off whose surface may be one place with the mesh's.
    pub neighbour_error: f64,
}

impl MeshPacket {
    /// No rays.
    pub const EMPTY: Self = Self {
        o: [[0.0; PACKET]; 3],
        d: [[0.0; PACKET]; 3],
        moment: [[0.0; PACKET]; 3],
        t: [f32::NEG_INFINITY; PACKET],
        error: [0.0; PACKET],
        second: [f32::INFINITY; PACKET],
        surface: Lanes::filled(NONE),
        leaves: Lanes::filled(NONE),
        any_leaves: false,
        base: DVec3::ZERO,
        spread: 0.0,
        lost: 0.0,
    };

    /// Takes the rays of a packet. False where they are not all within the world: nothing can be said then.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, query: &MeshQuery) -> bool {
        let MeshQuery { packet, wanted, departures, primitive, limits, place_error, neighbour_error } =
            *query;
        let mut spread = 0.0_f64;
        for axis in 0..3 {
            let base = packet.o[axis].0[0];
            self.base[axis] = base;
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
        self.spread = spread;
        self.lost = LOST_OF_START * spread + ONE_PLACE * neighbour_error + 4.0 * place_error;
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
        // Limits are up to four roundings and a slack of four times `place_error` beyond what they stand for.
        let apart = (8.0 * place_error + f64::from(f32::MIN_POSITIVE)) as f32;
        for lane in 0..PACKET {
            let asks = wanted >> lane & 1 == 1;
            self.t[lane] = if asks { limits[lane] } else { f32::NEG_INFINITY };
            let lost = self.t[lane] * (16.0 * HALF_ULP as f32) + apart;
            self.error[lane] = if lost.is_finite() { lost } else { 0.0 };
            self.second[lane] = f32::INFINITY;
        }
        self.surface = Lanes::filled(NONE);
        self.any_leaves = false;
        if let Some(departures) = departures {
            let (here, _) = departures.here(simd, primitive);
            if here != 0 {
                self.any_leaves = true;
                for lane in 0..PACKET {
                    let is_here = here >> lane & 1 == 1;
                    self.leaves.0[lane] = if is_here { departures.surface.0[lane] } else { NONE };
                }
            }
        }
        true
    }

    /// How far any of the rays still matters.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S) -> f32 {
        let mut most = f32x16::splat(simd, f32::NEG_INFINITY);
        for row in 0..ROWS {
            most = most.max(row_of(simd, &self.t, row) + row_of(simd, &self.error, row));
        }
        most.reduce_max()
    }

    /// What is the same of a triangle for all rays.
    #[inline(always)]
    fn broadcast<S: Simd>(&self, simd: S, [a, b, c]: [DVec3; 3]) -> SplatTriangle<S> {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ab.cross(c - a);
        let (a, b, c) = (a - self.base, b - self.base, c - self.base);
        let (m_ab, m_bc, m_ca) = (a.cross(ab), b.cross(bc), c.cross(ca));
        let longest = larger(larger(one_norm(ab), one_norm(bc)), one_norm(ca));
        let far = larger(larger(one_norm(a), one_norm(b)), one_norm(c)) + self.spread;
        let moment = larger(larger(one_norm(m_ab), one_norm(m_bc)), one_norm(m_ca));
        let bound =
            LOST_OF_MOMENT * moment + LOST_OF_EDGE * self.spread * longest + LOST_OF_SQUARE * far * far;
        let area = one_norm(normal);
        // Else never steep.
        let is_plain = area > FLAT * longest * longest && PLAIN_EDGES.contains(&longest);
        let steep = if is_plain { 2.0 * STEEP * area } else { f64::INFINITY };
        SplatTriangle {
            bound: f32x16::splat(simd, bound as f32),
            steep: f32x16::splat(simd, steep as f32),
            height: f32x16::splat(simd, a.dot(normal) as f32),
            area: f32x16::splat(simd, area as f32),
            lost: f32x16::splat(simd, self.lost as f32),
            lost_of_plane: f32x16::splat(simd, (LOST_OF_PLANE * longest) as f32),
            moments: [splats(simd, m_ab), splats(simd, m_bc), splats(simd, m_ca)],
            edges: [splats(simd, ab), splats(simd, bc), splats(simd, ca)],
            normal: splats(simd, normal),
        }
    }

    /// How the rays of a row pass a triangle; nothing where all certainly pass beside it.
    #[inline(always)]
    fn test<S: Simd>(&self, simd: S, of: &SplatTriangle<S>, row: usize) -> Option<TestedRow<S>> {
        let is_spread = self.spread > 0.0;
        let d = rows(simd, &self.d, row);
        let mut sides = [dot(&d, &of.moments[0]), dot(&d, &of.moments[1]), dot(&d, &of.moments[2])];
        if is_spread {
            let m = rows(simd, &self.moment, row);
            sides[0] += dot(&m, &of.edges[0]);
            sides[1] += dot(&m, &of.edges[1]);
            sides[2] += dot(&m, &of.edges[2]);
        }
        let least = sides[0].min(sides[1]).min(sides[2]);
        let most = sides[0].max(sides[1]).max(sides[2]);
        let maybe = !(most.simd_gt(of.bound) & least.simd_lt(-of.bound));
        if !maybe.any_true() {
            return None;
        }
        let inside = maybe & (least.simd_gt(of.bound) | most.simd_lt(-of.bound));
        let towards = dot(&d, &of.normal);
        let inverse = f32x16::splat(simd, 1.0) / towards;
        let mut height = of.height;
        if is_spread {
            height -= dot(&rows(simd, &self.o, row), &of.normal);
        }
        let t = height * inverse;
        let share = f32x16::splat(simd, LOST_OF_DISTANCE as f32);
        let error = inverse.abs() * of.area * (t.abs() * share + of.lost) + of.lost_of_plane;
        let is_steep = towards.abs().simd_gt(of.steep);
        let certain = is_steep & inside;
        let hit = certain & t.simd_gt(error);
        let doubt = maybe & !(hit | (certain & t.simd_lt(-error)));
        Some(TestedRow { inside, hit, doubt, is_steep, t, error })
    }

    /// Intersects the rays with a triangle, whose box lies no nearer to any start than `near`.
    #[inline(always)]
    pub fn intersect<S: Simd>(&mut self, simd: S, corners: [DVec3; 3], surface: u32, near: f32) {
        let triangle = self.broadcast(simd, corners);
        let near = f32x16::splat(simd, near);
        for row in 0..ROWS {
            let Some(tested) = self.test(simd, &triangle, row) else { continue };
            let TestedRow { mut hit, mut doubt, is_steep, t, error, .. } = tested;
            if self.any_leaves {
                let others = !self.leaving(simd, surface, row);
                (hit, doubt) = (hit & others, doubt & others);
            }
            let (best, best_error) = (row_of(simd, &self.t, row), row_of(simd, &self.error, row));
            let nearer = hit & t.simd_lt(best);
            let other = nearer.select(best - best_error, t - error);
            let doubtful = is_steep.select(t - error, near);
            let second = row_of(simd, &self.second, row);
            let second = (hit & other.simd_lt(second)).select(other, second);
            let second = (doubt & !second.simd_lt(doubtful)).select(doubtful, second);
            second.store_slice(&mut self.second[row * ROW..][..ROW]);
            if nearer.any_true() {
                nearer.select(t, best).store_slice(&mut self.t[row * ROW..][..ROW]);
                nearer.select(error, best_error).store_slice(&mut self.error[row * ROW..][..ROW]);
                let surfaces = &mut self.surface.0[row * ROW..][..ROW];
                let known = u32x16::from_slice(simd, surfaces);
                nearer.select(u32x16::splat(simd, surface), known).store_slice(surfaces);
            }
        }
    }

    /// Adds a triangle that rays cross, within their limits, to `lists`; its box lies no nearer to any start
    /// than `near`.
    #[inline(always)]
    pub fn list<S: Simd>(
        &self,
        simd: S,
        corners: [DVec3; 3],
        surface: u32,
        near: f32,
        lists: &mut MeshLists,
    ) {
        let triangle = self.broadcast(simd, corners);
        let near = f32x16::splat(simd, near);
        for row in 0..ROWS {
            let Some(tested) = self.test(simd, &triangle, row) else { continue };
            let TestedRow { inside, mut hit, mut doubt, is_steep, t, error } = tested;
            if self.any_leaves {
                let own = self.leaving(simd, surface, row);
                lists.left |= (own & inside).to_bitmask() << (row * ROW);
                (hit, doubt) = (hit & !own, doubt & !own);
            }
            let limit = row_of(simd, &self.t, row) + row_of(simd, &self.error, row);
            let from = is_steep.select(t - error, near);
            let matters = !from.simd_gt(limit);
            let (hit, doubt) = ((hit & matters).to_bitmask(), (doubt & matters).to_bitmask());
            for lane in lanes(hit) {
                lists.push(row * ROW + lane, surface);
            }
            if doubt != 0 {
                let from: [f32; ROW] = from.into();
                for lane in lanes(doubt) {
                    lists.doubt(row * ROW + lane, from[lane]);
                }
            }
        }
    }

    /// Which rays of a row leave a triangle.
    #[inline(always)]
    fn leaving<S: Simd>(&self, simd: S, surface: u32, row: usize) -> mask32x16<S> {
        let leaves = u32x16::from_slice(simd, &self.leaves.0[row * ROW..][..ROW]);
        leaves.simd_eq(u32x16::splat(simd, surface))
    }

    /// What was found.
    #[inline(always)]
    pub fn answer<S: Simd>(&self, simd: S) -> MeshAnswer {
        let (mut hits, mut uncertain) = (0, 0);
        for row in 0..ROWS {
            let t = row_of(simd, &self.t, row);
            let asked = t.simd_gt(f32x16::splat(simd, f32::NEG_INFINITY));
            let apart = row_of(simd, &self.second, row).simd_gt(t + row_of(simd, &self.error, row));
            let nothing = row_of(simd, &self.second, row).simd_ge(f32x16::splat(simd, f32::INFINITY));
            let surface = u32x16::from_slice(simd, &self.surface.0[row * ROW..][..ROW]);
            let none = surface.simd_eq(u32x16::splat(simd, NONE));
            uncertain |= (asked & !(apart | nothing)).to_bitmask() << (row * ROW);
            hits |= (asked & (apart | nothing) & !none).to_bitmask() << (row * ROW);
        }
        MeshAnswer { hits, uncertain }
    }

    /// How far one of the rays matters, and how far that may be off.
    #[inline]
    pub fn limit_of(&self, lane: usize) -> [f64; 2] {
        [f64::from(self.t[lane]), f64::from(self.error[lane])]
    }

    /// Sets which triangle one of the rays crosses.
    #[inline]
    pub fn put(&mut self, lane: usize, surface: u32) {
        self.surface.0[lane] = surface;
    }

    /// The triangles that rays with a hit cross.
    #[inline]
    pub fn surfaces(&self) -> &Lanes<u32> {
        &self.surface
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

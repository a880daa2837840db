//! The rays of a packet against the triangles of a mesh, in single precision: what each crosses first, or all
//! that it crosses.
//!
//! Each triangle is certainly crossed, certainly missed, or in doubt ([`super::mesh_triangle`]). A ray's
//! answer counts where one crossing is certain, and no other one, nor any doubt, lies so near before or
//! behind it that both could be one place. All other rays are asked one by one.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

use crate::math::{DVec3, Lanes, PACKET, ROW, ROWS, RayPacket, lanes, row_of};

use super::csg_query::Departures;
use super::mesh_lists::MeshLists;
use super::mesh_triangle::{HALF_ULP, RayColumns, SplatTriangle, TestedRow};
use super::ray_shear::ONE_PLACE;

/// Stands for no triangle.
const NONE: u32 = u32::MAX;

/// Rays of a packet, seen from the start of its first, and what each crosses first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct MeshPacket {
    rays: RayColumns,
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
        rays: RayColumns::EMPTY,
        t: [f32::NEG_INFINITY; PACKET],
        error: [0.0; PACKET],
        second: [f32::INFINITY; PACKET],
        surface: Lanes::filled(NONE),
        leaves: Lanes::filled(NONE),
        any_leaves: false,
    };

    /// Takes the rays of a packet. False where they are not all within the world: nothing can be said then.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, query: &MeshQuery) -> bool {
        let MeshQuery { packet, wanted, departures, primitive, limits, place_error, neighbour_error } =
            *query;
        if !self.rays.set(simd, packet, ONE_PLACE * neighbour_error + 4.0 * place_error) {
            return false;
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

    /// Intersects the rays with a triangle, whose box lies no nearer to any start than `near`.
    #[inline(always)]
    pub fn intersect<S: Simd>(&mut self, simd: S, corners: [DVec3; 3], surface: u32, near: f32) {
        let triangle = SplatTriangle::new(simd, corners, &self.rays.starts);
        let near = f32x16::splat(simd, near);
        for row in 0..ROWS {
            let Some(tested) = triangle.test(simd, &self.rays, row) else { continue };
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
        let triangle = SplatTriangle::new(simd, corners, &self.rays.starts);
        let near = f32x16::splat(simd, near);
        for row in 0..ROWS {
            let Some(tested) = triangle.test(simd, &self.rays, row) else { continue };
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

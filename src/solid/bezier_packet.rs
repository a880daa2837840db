//! The rays of a packet against the pieces of Bézier patches, eight at a time, by the formula of one ray
//! ([`super::bezier_steep`]). A ray of which that says nothing is asked of the piece by itself.

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::math::{LANES, Lanes, Mask, Number, PACKET, REGISTERS, RayPacket, lanes, mask_of};

use super::bezier::BezierSurface;
use super::bezier_piece::LyingPiece;
use super::crossing::{PlaceError, start_of};
use super::csg_query::{Departures, PacketCrossings};
use super::packet_shear::PacketShear;
use super::span::End;

/// Rays of a packet that ask what they cross first of patches.
#[derive(Clone, Copy, Debug)]
pub struct BezierQuery<'a> {
    /// The patches, and their index among the primitives.
    pub patches: &'a BezierSurface,
    /// Their index among the primitives.
    pub primitive: u32,
    /// The rays.
    pub packet: &'a RayPacket,
    /// Which of them ask, a bit for each.
    pub wanted: u64,
    /// The surfaces that they leave; none for rays from the eye.
    pub departures: Option<&'a Departures>,
    /// How far away what they meet may be to matter.
    pub limits: &'a [f32; PACKET],
}

/// What each ray of a packet crosses first of patches, as far as they were looked at.
#[derive(Clone, Debug)]
pub struct BezierPacket {
    t: Lanes,
    error: Lanes,
    /// What else the ray crosses ahead of its start is no nearer than this.
    second: Lanes,
    /// What it crosses at its start, or before, reaches no farther than this.
    behind: Lanes,
    /// How far the ray matters; below all numbers for one that is not asked about.
    limit: Lanes,
    surface: Lanes<u32>,
    /// Which rays come against the normals of what they cross, a bit for each.
    against: u64,
}

impl BezierPacket {
    /// No rays.
    pub const EMPTY: Self = Self {
        t: Lanes::filled(f64::INFINITY),
        error: Lanes::filled(0.0),
        second: Lanes::filled(f64::INFINITY),
        behind: Lanes::filled(f64::NEG_INFINITY),
        limit: Lanes::filled(f64::NEG_INFINITY),
        surface: Lanes::filled(0),
        against: 0,
    };

    /// Takes the rays of a packet, which have crossed nothing yet.
    pub fn set(&mut self, query: &BezierQuery) {
        *self = Self::EMPTY;
        for lane in lanes(query.wanted) {
            self.limit.0[lane] = f64::from(query.limits[lane]);
        }
    }

    /// How far any of the rays still matters.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S) -> f32 {
        let mut most = f64x8::splat(simd, f64::NEG_INFINITY);
        for register in 0..REGISTERS {
            // A cluster reaches as far behind its first crossing as that may be off, and others as well.
            let to = self.t.load(simd, register) + self.error.load(simd, register) * 4.0;
            most = to.smaller(self.limit.load(simd, register)).larger(most);
        }
        // Up to 16 half an ulp is less than this.
        (most.reduce_max() + 1e-6) as f32
    }

    /// Intersects the rays with a piece. `shear` are the planes across them.
    #[inline(always)]
    pub fn visit<S: Simd>(&mut self, simd: S, query: &BezierQuery, shear: &mut PacketShear, number: u32) {
        shear.know(simd, query.packet);
        self.visit_along::<S, 0>(simd, query, shear, number);
        self.visit_along::<S, 1>(simd, query, shear, number);
        self.visit_along::<S, 2>(simd, query, shear, number);
    }

    /// For the rays that go farthest along axis `MAIN`.
    #[inline(always)]
    fn visit_along<S: Simd, const MAIN: usize>(
        &mut self,
        simd: S,
        query: &BezierQuery,
        shear: &PacketShear,
        number: u32,
    ) {
        let BezierQuery { patches, packet, .. } = *query;
        let asking = query.wanted & shear.main(MAIN);
        if asking == 0 {
            return;
        }
        let (LyingPiece { piece, flatness, shell }, fine) = patches.piece(number);
        for register in 0..REGISTERS {
            let own = asking >> (register * LANES) & 0xFF;
            if own == 0 {
                continue;
            }
            let rays = packet.load(simd, register);
            let own = mask_of(simd, asking, register) & !shell.is_beside(rays.o, rays.d);
            if !own.any() {
                continue;
            }
            let row = shear.load::<S, MAIN>(simd, packet, register);
            let zero = f64x8::splat(simd, 0.0);
            let mut nets = [[zero; 16]; 3];
            for (i, &p) in piece.points.iter().enumerate() {
                let [x, y, along] = row.sheared(p);
                (nets[0][i], nets[1][i], nets[2][i]) = (x, y, along);
            }
            let d = rays.d;
            let met = flatness.meet(&nets, d, MAIN, fine);
            let hits = met.hits & own;
            if hits.any() {
                let step = d.along(MAIN);
                let crossed = Crossed {
                    hits,
                    t: met.along / step,
                    error: patches.error_of(met.slope, step),
                    against: d.dot_one(flatness.axis).is_below(zero),
                };
                self.take(simd, query, register, &crossed, |lane| {
                    let (u, v): ([f64; LANES], [f64; LANES]) = (met.uv[0].into(), met.uv[1].into());
                    patches.surface(number, [u[lane], v[lane]])
                });
            }
            let uncertain = (own & !met.hits & !met.beside).bits();
            for lane in lanes(uncertain) {
                self.ask(query, register * LANES + lane, number);
            }
        }
    }

    /// Takes what some rays of a register cross.
    #[inline(always)]
    fn take<S: Simd>(
        &mut self,
        simd: S,
        query: &BezierQuery,
        register: usize,
        crossed: &Crossed<S>,
        surface: impl Fn(usize) -> u32,
    ) {
        let &Crossed { hits, t, error, against } = crossed;
        let (bound, rounding_share) = (query.patches.place_error(), 1.0);
        let own = PlaceError { bound, rounding_share };
        let start = start_of(error, own, query.departures.map(|d| d.place_error.load(simd, register)));
        let ahead = hits & t.is_above(start);
        let behind = self.behind.load(simd, register);
        self.behind.store(register, (hits & !ahead).choose((t + error).larger(behind), behind));
        let (best, best_error) = (self.t.load(simd, register), self.error.load(simd, register));
        let nearer = ahead & t.is_below(best);
        let other = nearer.choose(best - best_error, t - error);
        let second = self.second.load(simd, register);
        self.second.store(register, ahead.choose(other.smaller(second), second));
        let nearer_bits = nearer.bits();
        if nearer_bits != 0 {
            self.t.store(register, nearer.choose(t, best));
            self.error.store(register, nearer.choose(error, best_error));
            for lane in lanes(nearer_bits) {
                self.surface.0[register * LANES + lane] = surface(lane);
            }
            let shift = register * LANES;
            self.against = self.against & !(nearer_bits << shift) | ((nearer & against).bits() << shift);
        }
    }

    /// Asks one ray of a piece by itself.
    #[inline(never)]
    fn ask(&mut self, query: &BezierQuery, lane: usize, number: u32) {
        let ray = query.packet.ray(lane);
        let own = PlaceError { bound: query.patches.place_error(), rounding_share: 1.0 };
        let departure = query.departures.map(|d| d.place_error.0[lane]);
        query.patches.cross_uncertain(number, &ray, &mut |End { t, error, surface }| {
            if t <= start_of(error, own, departure) {
                self.behind.0[lane] = self.behind.0[lane].max(t + error);
                return;
            }
            let (best, best_error) = (self.t.0[lane], self.error.0[lane]);
            let other = if t < best { best - best_error } else { t - error };
            self.second.0[lane] = self.second.0[lane].min(other);
            if t < best {
                (self.t.0[lane], self.error.0[lane], self.surface.0[lane]) = (t, error, surface);
                let against = query.patches.normal(ray.at(t), surface).dot(ray.d) < 0.0;
                self.against = self.against & !(1 << lane) | u64::from(against) << lane;
            }
        });
    }

    /// Sets what was found: the nearest crossings that are one place with no other. What a ray crosses of a
    /// surface that bounds nothing is its nearest in any case. `found.entering` are those that come against
    /// the normals.
    pub fn answer(&self, query: &BezierQuery, found: &mut PacketCrossings) {
        (found.any, found.uncertain, found.entering) = (0, 0, self.against);
        for lane in lanes(query.wanted) {
            let (t, error) = (self.t.0[lane], self.error.0[lane]);
            if t < f64::INFINITY {
                let is_alone = t + error < self.second.0[lane] && t - error > self.behind.0[lane];
                let is_certain = is_alone || !query.patches.is_closed();
                found.any |= u64::from(is_certain) << lane;
                found.uncertain |= u64::from(!is_certain) << lane;
            }
        }
        (found.t, found.error, found.surface) = (self.t, self.error, self.surface);
        found.primitive = Lanes::filled(query.primitive);
    }
}

/// What some rays of a register cross.
struct Crossed<S: Simd> {
    hits: fearless_simd::mask64x8<S>,
    t: f64x8<S>,
    error: f64x8<S>,
    against: fearless_simd::mask64x8<S>,
}

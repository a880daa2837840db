//! How the surfaces that a packet met lie to a lamp, and the light that they get from it: what [`super::surface`] computes
//! for one, in the same order, for eight at a time.

use fearless_simd::{Level, Select, Simd, SimdBase, dispatch, f64x8};

use crate::math::{DVec3, LANES, LaneVector, Lanes, Mask, Number, ROWS, RayPacket, row_of};
use crate::trace::ShadowPacket;
use crate::view::all_settled;

use super::channel::{Channel, limited};
use super::direction::WITHIN;
use super::power::power;
use super::surface::{NEAREST, ResolvedMaterial};
use super::surfaces::Surfaces;

/// What is asked about the way to a lamp, beside which surfaces face it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    /// Whether anything stands in it.
    pub shadows: bool,
    /// How near the mirrored light comes to the eye.
    pub highlights: bool,
}

/// How the surfaces of a packet lie to a lamp.
#[derive(Clone, Debug)]
pub(super) struct Lit {
    /// `L·N`.
    facing: Lanes,
    /// The cosine of the angle between the mirrored light and the way to the eye, at most 1.
    cosine: Lanes,
    /// V, where anything lets light through.
    pub visible: Lanes,
}

impl Lit {
    pub const NONE: Self =
        Self { facing: Lanes::filled(0.0), cosine: Lanes::filled(0.0), visible: Lanes::filled(1.0) };

    /// The ways from the surfaces to a lamp. Those among `shines` that face it ask for it.
    pub fn light(
        &mut self,
        lamp: DVec3,
        packet: &RayPacket,
        surfaces: &Surfaces,
        (shines, needs): (u64, Needs),
        shadow_packet: &mut ShadowPacket,
        level: Level,
    ) {
        shadow_packet.clear();
        if shines != 0 {
            dispatch!(level, simd => self.lit(simd, lamp, packet, surfaces, (shines, needs), shadow_packet));
        }
    }

    #[inline(always)]
    fn lit<S: Simd>(
        &mut self,
        simd: S,
        lamp: DVec3,
        packet: &RayPacket,
        surfaces: &Surfaces,
        (shines, needs): (u64, Needs),
        shadow_packet: &mut ShadowPacket,
    ) {
        for row in 0..ROWS {
            if (shines >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let p = surfaces.p.load(simd, row);
            let normal = surfaces.normal.load(simd, row);
            let way = p.same(lamp) - p;
            let distance = way.length();
            let d = all_settled(way / distance, WITHIN);
            let facing = d.dot(normal);
            let zero = f64x8::splat(simd, 0.0);
            let asks = facing.is_above(zero) & !distance.is_below(zero.same(NEAREST));
            self.facing.store(row, facing);
            if needs.highlights {
                let mirrored = normal * (facing * 2.0) - d;
                let cosine = -mirrored.dot(packet.d.load(simd, row));
                let one = zero.same(1.0);
                self.cosine.store(row, cosine.is_above(one).select(one, cosine));
            }
            if needs.shadows {
                shadow_packet.rays.o.store(row, p);
                shadow_packet.rays.d.store(row, d);
                shadow_packet.distance.store(row, distance);
            }
            shadow_packet.rays.live |= asks.bits() << (row * LANES);
        }
        shadow_packet.rays.live &= shines;
        if needs.shadows {
            shadow_packet.close(simd);
        }
    }

    /// Adds what a lamp of this light gives to the rays of `lanes`, which met a surface of one material. `sum` has a column
    /// for each part of light. `dimmed`: V is not 1 everywhere.
    pub fn add<C: Channel>(
        &self,
        light: C,
        finish: &ResolvedMaterial<C>,
        lanes: u64,
        dimmed: bool,
        sum: &mut [Lanes],
        level: Level,
    ) {
        dispatch!(level, simd => self.added(simd, light, finish, lanes, dimmed, sum));
    }

    #[inline(always)]
    fn added<S: Simd, C: Channel>(
        &self,
        simd: S,
        light: C,
        finish: &ResolvedMaterial<C>,
        lanes: u64,
        dimmed: bool,
        sum: &mut [Lanes],
    ) {
        let zero = f64x8::splat(simd, 0.0);
        for row in 0..ROWS {
            if (lanes >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let which = row_of(simd, lanes, row);
            let diffuse = self.facing.load(simd, row) * finish.kd;
            let mut highlight = zero;
            if finish.ks > 0.0 {
                let cosine = self.cosine.load(simd, row);
                let towards = which & cosine.is_above(zero);
                if towards.any() {
                    highlight = towards.choose(power(cosine, finish.n) * finish.ks, zero);
                }
            }
            for part in 0..C::PARTS {
                let mut share = diffuse * finish.color.part(part) + highlight;
                if dimmed {
                    share *= self.visible.load(simd, row);
                }
                let more = limited(sum[part].load(simd, row) + share * light.part(part));
                sum[part].put(simd, row, which, more);
            }
        }
    }
}

/// The light of the rays of a packet before any lamp gave some: what is `missed` for those that are not among `hits`, and
/// for those that are nothing. Of the `known` it stays.
pub(super) fn before_lamps(missed: f64, hits: u64, known: u64, light: &mut Lanes, level: Level) {
    #[inline(always)]
    fn set<S: Simd>(simd: S, missed: f64, hits: u64, known: u64, light: &mut Lanes) {
        let zero = f64x8::splat(simd, 0.0);
        for row in 0..ROWS {
            let own = row_of(simd, hits, row).choose(zero, zero.same(missed));
            light.put(simd, row, row_of(simd, !known, row), own);
        }
    }
    dispatch!(level, simd => set(simd, missed, hits, known, light));
}

/// Adds the same light to that of all rays of `lanes`.
pub(super) fn add_everywhere<C: Channel>(light: C, lanes: u64, sum: &mut [Lanes], level: Level) {
    #[inline(always)]
    fn added<S: Simd>(simd: S, light: f64, lanes: u64, sum: &mut Lanes) {
        for row in 0..ROWS {
            sum.put(simd, row, row_of(simd, lanes, row), limited(sum.load(simd, row) + light));
        }
    }
    for (part, sum) in sum.iter_mut().enumerate() {
        dispatch!(level, simd => added(simd, light.part(part), lanes, sum));
    }
}

/// From the sums over all lamps to the light of a surface: what is left of it after the way from the eye, and the light from
/// all around.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gathering<C> {
    /// The constant of the depth term, in the scene's unit.
    pub depth: Option<f64>,
    /// The assembly's unit in the scene's.
    pub unit: f64,
    /// Ambient light, as the surface sends it on.
    pub ambient: C,
}

impl<C: Channel> Gathering<C> {
    /// Of the rays of `lanes`.
    pub fn gather(&self, lanes: u64, way: &Lanes, sum: &mut [Lanes], level: Level) {
        dispatch!(level, simd => self.gathered(simd, lanes, way, sum));
    }

    #[inline(always)]
    fn gathered<S: Simd>(&self, simd: S, lanes: u64, way: &Lanes, sum: &mut [Lanes]) {
        for row in 0..ROWS {
            if (lanes >> (row * LANES)) as u8 == 0 {
                continue;
            }
            for part in 0..C::PARTS {
                let mut light = sum[part].load(simd, row);
                if let Some(k) = self.depth {
                    light = limited(light / (way.load(simd, row) * self.unit + k));
                }
                let ambient = light.same(self.ambient.part(part));
                sum[part].put(simd, row, row_of(simd, lanes, row), limited(ambient + light));
            }
        }
    }
}

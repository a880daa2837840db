//! The light of a packet's surfaces, eight at a time, by the formulas of [`super::lamp`] and
//! [`super::material`].

use fearless_simd::{Level, Simd, SimdBase, f64x8};

use crate::math::{DVec3, LANES, LaneVector, Lanes, Mask, Number, REGISTERS, RayPacket, dispatch, mask_of};
use crate::trace::ShadowPacket;

use super::channel::{Channel, limited};
use super::lamp::Towards;
use super::material::{Reflected, ResolvedMaterial};
use super::surfaces::Surfaces;

/// Which surfaces of a packet may get light from a lamp, and what has to be known of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LitQuery {
    /// Where the lamp is, in the assembly's coordinates.
    pub lamp: DVec3,
    /// The rays that met what reflects light, a bit for each.
    pub lanes: u64,
    /// Whether anything may stand in the way.
    pub shadows: bool,
    /// Whether highlights are computed, which need the angle between the mirrored light and the ray.
    pub highlights: bool,
}

/// How the surfaces of a packet lie to a lamp.
#[derive(Clone, Debug)]
pub(crate) struct Lit {
    /// `L·N`.
    facing: Lanes,
    /// The cosine of the angle between the mirrored light and the direction to the eye, at most 1.
    cosine: Lanes,
    /// V, where anything lets light through.
    pub visible: Lanes,
}

impl Lit {
    pub const NONE: Self =
        Self { facing: Lanes::filled(0.0), cosine: Lanes::filled(0.0), visible: Lanes::filled(1.0) };

    /// Finds the directions from the surfaces to a lamp. Those that it shines on become the rays of
    /// `shadow_packet`.
    pub fn light(
        &mut self,
        query: &LitQuery,
        packet: &RayPacket,
        surfaces: &Surfaces,
        shadow_packet: &mut ShadowPacket,
        level: Level,
    ) {
        shadow_packet.clear();
        if query.lanes != 0 {
            dispatch!(level, simd => self.lit(simd, query, packet, surfaces, shadow_packet));
        }
    }

    #[inline(always)]
    fn lit<S: Simd>(
        &mut self,
        simd: S,
        query: &LitQuery,
        packet: &RayPacket,
        surfaces: &Surfaces,
        shadow_packet: &mut ShadowPacket,
    ) {
        for register in 0..REGISTERS {
            if (query.lanes >> (register * LANES)) as u8 == 0 {
                continue;
            }
            let p = surfaces.p.load(simd, register);
            let normal = surfaces.normal.load(simd, register);
            let towards = Towards::new(query.lamp, p, normal);
            self.facing.store(register, towards.facing);
            if query.highlights {
                self.cosine.store(register, towards.mirrored_cosine(normal, packet.d.load(simd, register)));
            }
            if query.shadows {
                shadow_packet.rays.o.store(register, p);
                shadow_packet.rays.d.store(register, towards.d);
                shadow_packet.distance.store(register, towards.distance);
            }
            shadow_packet.rays.live |= towards.shines().bits() << (register * LANES);
        }
        shadow_packet.rays.live &= query.lanes;
        if query.shadows {
            shadow_packet.close(simd);
        }
    }

    /// Adds what a lamp of this light gives to the rays of `lanes`, which met a surface of one material.
    /// `sum` has a column for each part of light. `dimmed`: V is not 1 everywhere.
    pub fn add<C: Channel>(
        &self,
        light: C,
        material: &ResolvedMaterial<C>,
        lanes: u64,
        dimmed: bool,
        sum: &mut [Lanes],
        level: Level,
    ) {
        dispatch!(level, simd => self.added(simd, light, material, lanes, dimmed, sum));
    }

    #[inline(always)]
    fn added<S: Simd, C: Channel>(
        &self,
        simd: S,
        light: C,
        material: &ResolvedMaterial<C>,
        lanes: u64,
        dimmed: bool,
        sum: &mut [Lanes],
    ) {
        for register in 0..REGISTERS {
            if (lanes >> (register * LANES)) as u8 == 0 {
                continue;
            }
            let which = mask_of(simd, lanes, register);
            let diffuse = material.diffuse(self.facing.load(simd, register));
            let mut highlight = f64x8::splat(simd, 0.0);
            if material.ks > 0.0 {
                highlight = material.highlight(self.cosine.load(simd, register), which);
            }
            let visible = if dimmed { Some(self.visible.load(simd, register)) } else { None };
            let reflected = Reflected { diffuse, highlight, visible };
            for part in 0..C::PARTS {
                let before = sum[part].load(simd, register);
                let after = reflected.add_to(before, material.color.part(part), light.part(part));
                sum[part].put(simd, register, which, after);
            }
        }
    }
}

/// The light of the rays of a packet before any lamp gave some: what is `missed` for those that are not among
/// `hits`, and for those that are nothing. Of the `known` it stays.
pub(crate) fn before_lamps(missed: f64, hits: u64, known: u64, light: &mut Lanes, level: Level) {
    #[inline(always)]
    fn set<S: Simd>(simd: S, missed: f64, hits: u64, known: u64, light: &mut Lanes) {
        let zero = f64x8::splat(simd, 0.0);
        for register in 0..REGISTERS {
            let own = mask_of(simd, hits, register).choose(zero, zero.same(missed));
            light.put(simd, register, mask_of(simd, !known, register), own);
        }
    }
    dispatch!(level, simd => set(simd, missed, hits, known, light));
}

/// Adds the same light to that of all rays of `lanes`.
pub(crate) fn add_everywhere<C: Channel>(light: C, lanes: u64, sum: &mut [Lanes], level: Level) {
    #[inline(always)]
    fn added<S: Simd>(simd: S, light: f64, lanes: u64, sum: &mut Lanes) {
        for register in 0..REGISTERS {
            sum.put(
                simd,
                register,
                mask_of(simd, lanes, register),
                limited(sum.load(simd, register) + light),
            );
        }
    }
    for (part, sum) in sum.iter_mut().enumerate() {
        dispatch!(level, simd => added(simd, light.part(part), lanes, sum));
    }
}

/// From the sums over all lamps to the light of surfaces of one material: what is left of it after the way
/// from the eye, and the light from all around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gathering<C> {
    /// The constant of the depth term, in the scene's unit.
    pub depth: Option<f64>,
    /// The assembly's unit in the scene's.
    pub unit: f64,
    /// Ambient light, as the surface sends it on.
    pub ambient: C,
}

impl<C: Channel> Gathering<C> {
    /// Gathers one part of the light; `path_length` is that from the eye, in the assembly's unit.
    #[inline(always)]
    pub fn part<N: Number>(&self, part: usize, sum: N, path_length: N) -> N {
        let left = match self.depth {
            Some(k) => limited(sum / (path_length * self.unit + k)),
            None => sum,
        };
        limited(left + self.ambient.part(part))
    }

    /// Gathers the light of the rays of `lanes`, in place.
    pub fn gather(&self, lanes: u64, path_length: &Lanes, sum: &mut [Lanes], level: Level) {
        dispatch!(level, simd => self.gathered(simd, lanes, path_length, sum));
    }

    #[inline(always)]
    fn gathered<S: Simd>(&self, simd: S, lanes: u64, path_length: &Lanes, sum: &mut [Lanes]) {
        for register in 0..REGISTERS {
            if (lanes >> (register * LANES)) as u8 == 0 {
                continue;
            }
            for part in 0..C::PARTS {
                let light = self.part(part, sum[part].load(simd, register), path_length.load(simd, register));
                sum[part].put(simd, register, mask_of(simd, lanes, register), light);
            }
        }
    }
}

//! How the surfaces that a bundle met lie to the rays and to a lamp: what [`super::surface`] computes for one, in the
//! same order, for eight at a time.

use fearless_simd::{Level, Select, Simd, SimdBase, SimdMask, dispatch, f64x8, mask64x8};

use crate::math::{BUNDLE, Bundle, Column, Columns, DVec3, LANES, Mask, Number, ROWS, Vector};
use crate::trace::{Nearest, Shaft};
use crate::view::all_settled;

use super::direction::WITHIN;
use super::surface::NEAREST;

/// The surfaces that a bundle met.
#[derive(Clone, Debug)]
pub(super) struct Surfaces {
    /// Which rays met one.
    pub hits: u64,
    /// Where.
    pub p: [Column; 3],
    /// Before [`Surfaces::turn`] the surface's own normal, or the centre of a ball; then the normal, turned to the side that
    /// the ray comes from, of length 1.
    pub normal: [Column; 3],
    /// Of a ball.
    pub radius: Column,
    /// 1 where the surface answers light, 0 where it does not.
    pub shines: Column,
    /// The number of its material.
    pub finish: [u32; BUNDLE],
}

/// How the surfaces of a bundle lie to a lamp.
#[derive(Clone, Debug)]
pub(super) struct Lit {
    /// `L·N`.
    pub facing: Column,
    /// The cosine of the angle between the mirrored light and the way to the eye, at most 1.
    pub cosine: Column,
}

impl Surfaces {
    pub const NONE: Self = Self {
        hits: 0,
        p: [Column::filled(0.0); 3],
        normal: [Column::filled(0.0); 3],
        radius: Column::filled(1.0),
        shines: Column::filled(0.0),
        finish: [0; BUNDLE],
    };

    /// The points at which rays met something.
    pub fn met(&mut self, bundle: &Bundle, nearest: &Nearest, level: Level) {
        dispatch!(level, simd => self.points(simd, bundle, nearest));
        self.hits &= bundle.live & !nearest.unsure;
    }

    #[inline(always)]
    fn points<S: Simd>(&mut self, simd: S, bundle: &Bundle, nearest: &Nearest) {
        self.hits = 0;
        for row in 0..ROWS {
            let t = nearest.t.load(simd, row);
            let met = t.is_below(t.same(f64::INFINITY));
            self.hits |= u64::from(met.bits()) << (row * LANES);
            self.p.store(row, bundle.load(simd, row).at(t));
        }
    }

    /// Turns the normals to the side that the rays come from. Answers for which rays that is the inside. The normals of
    /// `balls` are still their centres.
    pub fn turn(&mut self, bundle: &Bundle, balls: u64, level: Level) -> u64 {
        dispatch!(level, simd => self.turned(simd, bundle, balls))
    }

    #[inline(always)]
    fn turned<S: Simd>(&mut self, simd: S, bundle: &Bundle, balls: u64) -> u64 {
        let mut inward = 0;
        for row in 0..ROWS {
            if (self.hits >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let d = bundle.d.load(simd, row);
            let own = self.normal.load(simd, row);
            let from_center = self.p.load(simd, row) - own;
            let radius = self.radius.load(simd, row);
            let of_ball =
                Vector { x: from_center.x / radius, y: from_center.y / radius, z: from_center.z / radius };
            let is_ball: mask64x8<S> = mask64x8::from_bitmask(simd, balls >> (row * LANES) & 0xFF);
            let own = Vector::choose(is_ball, of_ball, own);
            // As `normalize_or`: a length that is 0, or not finite, gives the fallback.
            let inverse = own.x.same(1.0) / own.length();
            let zero = own.x.same(0.0);
            let usable = inverse.is_below(zero.same(f64::INFINITY)) & inverse.is_above(zero);
            let normal = Vector::choose(usable, own * inverse, -d);
            let away = normal.dot(d).is_above(zero);
            self.normal.store(row, Vector::choose(away, -normal, normal));
            inward |= u64::from(away.bits()) << (row * LANES);
        }
        inward
    }
}

impl Lit {
    pub const NONE: Self = Self { facing: Column::filled(0.0), cosine: Column::filled(0.0) };

    /// The ways from the surfaces to a lamp. Those that face it ask for it.
    pub fn light(
        &mut self,
        lamp: DVec3,
        bundle: &Bundle,
        surfaces: &Surfaces,
        shaft: &mut Shaft,
        level: Level,
    ) {
        (shaft.rays.live, shaft.blocked, shaft.tinted) = (0, 0, 0);
        (shaft.leaving, shaft.unsure) = (0, 0);
        if surfaces.hits == 0 {
            return;
        }
        dispatch!(level, simd => self.lit(simd, lamp, bundle, surfaces, shaft));
        shaft.rays.live &= surfaces.hits;
        shaft.close();
    }

    #[inline(always)]
    fn lit<S: Simd>(
        &mut self,
        simd: S,
        lamp: DVec3,
        bundle: &Bundle,
        surfaces: &Surfaces,
        shaft: &mut Shaft,
    ) {
        for row in 0..ROWS {
            if (surfaces.hits >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let p = surfaces.p.load(simd, row);
            let normal = surfaces.normal.load(simd, row);
            let way = p.same(lamp) - p;
            let distance = way.length();
            let d = Vector { x: way.x / distance, y: way.y / distance, z: way.z / distance };
            let d = all_settled(d, WITHIN);
            let facing = d.dot(normal);
            let zero = f64x8::splat(simd, 0.0);
            let asks = facing.is_above(zero)
                & !distance.is_below(zero.same(NEAREST))
                & surfaces.shines.load(simd, row).is_above(zero);
            let mirrored = normal * (facing * 2.0) - d;
            let cosine = -mirrored.dot(bundle.d.load(simd, row));
            let one = zero.same(1.0);
            self.facing.store(row, facing);
            self.cosine.store(row, cosine.is_above(one).select(one, cosine));
            shaft.rays.o.store(row, p);
            shaft.rays.d.store(row, d);
            shaft.distance.store(row, distance);
            shaft.rays.live |= u64::from(asks.bits()) << (row * LANES);
        }
    }
}

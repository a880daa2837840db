//! Curved solids in their unit space: ellipsoids, and cylinders, cones and truncated cones of any slant.

use crate::math::{Bounds, DMat3, DVec3, Mask, Number, Placement, Rays, Vector};

use super::classification::Classification;
use super::span::{Ends, STILL, Spans};
use super::taper::Taper;
use super::unit_space::{Centred, UnitSpace};

/// The other face numbers of a truncated cone.
const BOTTOM: u32 = 1;
const TOP: u32 = 2;

/// A unit sphere or truncated cone under an affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    space: UnitSpace,
    /// From unit directions to world directions.
    linear: DMat3,
    profile: Profile,
}

/// The outline that is turned about the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Profile {
    Sphere,
    Cone(Taper),
}

impl Quadric {
    /// The unit sphere at `place`, which may be off by `map_error`.
    pub fn ellipsoid(place: &Placement, map_error: DVec3) -> Self {
        Self { space: UnitSpace::new(place, map_error), linear: place.linear, profile: Profile::Sphere }
    }

    /// The unit truncated cone at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and
    /// `top` at z = 1.
    pub fn cone(place: &Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        let profile = Profile::Cone(Taper::new(bottom, top));
        Self { space: UnitSpace::new(place, map_error), linear: place.linear, profile }
    }

    /// Where each ray is inside. A chord that rounding could have made counts as none.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        let rays = self.space.centred(rays);
        match &self.profile {
            Profile::Sphere => sphere_spans(&rays),
            Profile::Cone(taper) => cone_spans(&rays, taper),
        }
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.space.place_error
    }

    /// The share of its errors that our own rounding may have made.
    pub fn rounding_share(&self) -> f64 {
        self.space.rounding_share
    }

    /// The outward normals at points of the surface, of length 1; along the axis at the apex of a cone.
    #[inline(always)]
    pub fn normals<N: Number>(&self, p: Vector<N>, surface: u32) -> Vector<N> {
        let q = self.space.points(p);
        self.space.normals(match (self.profile, surface) {
            (Profile::Sphere, _) => q,
            (Profile::Cone(_), BOTTOM) => q.same(DVec3::NEG_Z),
            (Profile::Cone(_), TOP) => q.same(DVec3::Z),
            (Profile::Cone(taper), _) => taper.gradient(q),
        })
    }

    /// How far two parallel planes around it are apart at least, or less: every profile holds a ball of
    /// diameter 1, and a map shrinks no vector by more than the norm of its inverse.
    pub fn thickness(&self) -> f64 {
        1.0 / self.space.norm()
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        let center = self.space.center;
        match self.profile {
            Profile::Sphere => {
                let half = DVec3::from_array([0, 1, 2].map(|axis| self.linear.row(axis).length()));
                Bounds::new(center - half, center + half)
            }
            Profile::Cone(taper) => taper.bounds(&self.linear, center),
        }
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let unit = self.linear.transpose() * v;
        let reach = match self.profile {
            Profile::Sphere => unit.length(),
            Profile::Cone(taper) => taper.support(unit),
        };
        self.space.center.dot(v) + reach
    }

    /// How it lies to a box.
    pub fn classify(&self, b: &Bounds) -> Classification {
        let u = self.space.bounds(b);
        match self.profile {
            Profile::Sphere => {
                Classification::of(DVec3::ZERO.clamp(u.lo, u.hi).length_squared() > 1.0, || {
                    u.farthest().length_squared() < 1.0
                })
            }
            Profile::Cone(taper) => Classification::of(taper.misses(&u), || taper.covers(&u)),
        }
    }
}

#[inline(always)]
fn sphere_spans<N: Number>(rays: &Centred<N>) -> Spans<N> {
    let l_squared = rays.o.length_squared();
    // Moving the ray by at most e, `unit_error`, changes the square of the half-chord by 2·o·e.
    let across = rays.o.magnitude().dot_one(rays.unit_error);
    let one = rays.t.same(1.0);
    // Of single precision what is lost is no longer so small that its square can be left out.
    let grazing = if N::IS_DOUBLE { across * 2.0 } else { across * 2.0 + rays.unit_error.length_squared() };
    let near_enough = l_squared.is_at_most(if N::IS_DOUBLE { one } else { one + grazing });
    if !near_enough.any() {
        return Spans::none(rays.t);
    }
    let l = l_squared.root();
    let half_squared = (-l + 1.0) * (l + 1.0);
    let least = if N::IS_DOUBLE { across * 2.0 * rays.rounding_share } else { grazing };
    let any = near_enough & half_squared.is_above(least);
    let root = half_squared.root();
    let slowness = rays.t.same(1.0) / rays.d_squared.root();
    let half = root * slowness;
    // The crossing q = o ± half·d, moved by e, moves along the ray by |q|·e over q·d, and |q·d| = speed
    // · root. Half a chord that the map's own error could have made is off by no more than all of that.
    let sideways = half_squared.is_below(across * 2.0).choose((across * 2.0).root(), across / root);
    let error = (sideways + rays.d.magnitude().dot_one(rays.unit_error) * slowness) * slowness;
    let surface = rays.t.same(0.0);
    Spans {
        enter: Ends { t: rays.t - half, error, surface },
        leave: Ends { t: rays.t + half, error, surface },
        any,
        may: if N::IS_DOUBLE { any } else { near_enough },
    }
}

/// The lines against the side, then against `|z| ≤ 1`.
#[inline(always)]
fn cone_spans<N: Number>(rays: &Centred<N>, taper: &Taper) -> Spans<N> {
    let (o, d) = (rays.o, rays.d);
    let mut spans = Spans::line(rays.t);
    let zero = rays.t.same(0.0);
    let still = d.z.magnitude().is_below(zero.same(STILL * N::LEAST));
    let inside = o.z.is_at_least(rays.t.same(-1.0)) & o.z.is_below(rays.t.same(1.0));
    spans.any = !rays.pass_by();
    spans.may = spans.any;
    spans.keep(
        !still | inside,
        #[inline(always)]
        || still & (o.z.magnitude() - 1.0).magnitude().is_at_most(zero.same(rays.unit_error.z)),
    );
    if !spans.may.any() {
        return spans;
    }
    let inverse = zero.same(1.0) / d.z;
    let (low, high) = ((-o.z - 1.0) * inverse, (-o.z + 1.0) * inverse);
    let (error, forward) = (inverse.magnitude() * rays.unit_error.z, d.z.is_above(zero));
    let (bottom, top) = (zero.same(f64::from(BOTTOM)), zero.same(f64::from(TOP)));
    let enter = still.choose(zero.same(f64::NEG_INFINITY), forward.choose(low, high));
    let leave = still.choose(zero.same(f64::INFINITY), forward.choose(high, low));
    spans.clip(
        Ends { t: rays.t + enter, error, surface: forward.choose(bottom, top) },
        Ends { t: rays.t + leave, error, surface: forward.choose(top, bottom) },
    );
    let side = taper.sides(rays);
    spans.any = spans.any & side.any;
    spans.may = spans.may & side.may;
    spans.clip(
        Ends { t: rays.t + side.enter.t, ..side.enter },
        Ends { t: rays.t + side.leave.t, ..side.leave },
    );
    spans.if_any(
        rays.rounding_share,
        #[inline(always)]
        |surface| surface.smaller(bottom),
    )
}

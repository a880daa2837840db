//! Curved solids in their unit space: ellipsoids, and cylinders, cones and frustums of any slant.

use crate::math::{Bounds, DMat3, DVec3, Placement, Ray};

use super::span::{End, Span};
use super::taper::{SIDE, Taper};
use super::unit_space::{Centred, UnitSpace};

/// The other face numbers of a frustum.
const BOTTOM: u32 = 1;
const TOP: u32 = 2;

/// A unit sphere or frustum under an affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    space: UnitSpace,
    /// From unit directions to world directions.
    linear: DMat3,
    profile: Profile,
}

/// The outline that is turned about the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Profile {
    Sphere,
    Frustum(Taper),
}

impl Round {
    /// The unit sphere at `place`, which may be off by `map_error`.
    pub fn ellipsoid(place: &Placement, map_error: DVec3) -> Self {
        Self { space: UnitSpace::new(place, map_error), linear: place.linear, profile: Profile::Sphere }
    }

    /// The unit frustum at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn frustum(place: &Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        let profile = Profile::Frustum(Taper::new(bottom, top));
        Self { space: UnitSpace::new(place, map_error), linear: place.linear, profile }
    }

    /// Where the ray is inside. A chord that rounding could have made counts as none.
    #[inline]
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let ray = self.space.centred(ray);
        match self.profile {
            Profile::Sphere => sphere_span(&ray),
            Profile::Frustum(taper) => frustum_span(&ray, taper),
        }
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn off(&self) -> f64 {
        self.space.displacement
    }

    /// The share of its errors that our own rounding may have made.
    pub fn seeming(&self) -> f64 {
        self.space.seeming
    }

    /// The outward normal at a point of the surface, of length 1; along the axis at the apex of a cone.
    pub fn normal(&self, p: DVec3, surface: u32) -> DVec3 {
        let q = self.space.point(p);
        self.space.normal(match (self.profile, surface) {
            (Profile::Sphere, _) => q,
            (Profile::Frustum(_), BOTTOM) => DVec3::NEG_Z,
            (Profile::Frustum(_), TOP) => DVec3::Z,
            (Profile::Frustum(taper), _) => taper.gradient(q),
        })
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        let center = self.space.center;
        match self.profile {
            Profile::Sphere => {
                let half = DVec3::from_array([0, 1, 2].map(|axis| self.linear.row(axis).length()));
                Bounds::new(center - half, center + half)
            }
            Profile::Frustum(taper) => taper.bounds(&self.linear, center),
        }
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let unit = self.linear.transpose() * v;
        let reach = match self.profile {
            Profile::Sphere => unit.length(),
            Profile::Frustum(taper) => taper.support(unit),
        };
        self.space.center.dot(v) + reach
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        let u = self.space.bounds(b);
        match self.profile {
            Profile::Sphere => DVec3::ZERO.clamp(u.lo, u.hi).length_squared() > 1.0,
            Profile::Frustum(taper) => taper.misses(&u),
        }
    }

    /// Whether the box is certainly inside.
    pub fn covers(&self, b: &Bounds) -> bool {
        let u = self.space.bounds(b);
        match self.profile {
            Profile::Sphere => u.farthest().length_squared() < 1.0,
            Profile::Frustum(taper) => taper.covers(&u),
        }
    }
}

fn sphere_span(ray: &Centred) -> Option<Span> {
    let l_squared = ray.o.length_squared();
    if l_squared > 1.0 {
        return None;
    }
    let l = l_squared.sqrt();
    let half_squared = (1.0 - l) * (1.0 + l);
    // Moving the ray by at most `off` changes the square of the half-chord by 2·o·off.
    let across = ray.o.abs().dot(ray.off);
    if half_squared.is_nan() || half_squared <= 2.0 * across * ray.seeming {
        return None;
    }
    let root = half_squared.sqrt();
    let speed = ray.d_squared.sqrt();
    let half = root / speed;
    // The crossing q = o ± half·d, moved by `off`, moves along the ray by |q|·off over q·d, and |q·d| = speed · root.
    // Half a chord that the map's own error could have made is off by no more than all of that.
    let sideways = if half_squared < 2.0 * across { (2.0 * across).sqrt() } else { across / root };
    let error = (sideways + ray.d.abs().dot(ray.off) / speed) / speed;
    Some(Span {
        enter: End { t: ray.t - half, error, surface: 0 },
        leave: End { t: ray.t + half, error, surface: 0 },
    })
}

/// The line against the side, then against `|z| ≤ 1`.
fn frustum_span(ray: &Centred, taper: Taper) -> Option<Span> {
    let (o, d) = (ray.o, ray.d);
    if ray.passes_by() {
        return None;
    }
    let mut span = Span::LINE;
    let end = |t: f64, error: f64, surface: u32| End { t: ray.t + t, error, surface };
    if d.z == 0.0 {
        if !(-1.0..1.0).contains(&o.z) {
            return None;
        }
    } else {
        let (low, high) = ((-1.0 - o.z) / d.z, (1.0 - o.z) / d.z);
        let error = ray.off.z / d.z.abs();
        if d.z > 0.0 {
            span.clip(end(low, error, BOTTOM), end(high, error, TOP));
        } else {
            span.clip(end(high, error, TOP), end(low, error, BOTTOM));
        }
    }
    let side = taper.side(ray)?;
    span.clip(end(side.enter.t, side.enter.error, SIDE), end(side.leave.t, side.leave.error, SIDE));
    span.if_any(ray.seeming, |surface| surface.min(BOTTOM))
}

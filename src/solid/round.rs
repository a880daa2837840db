//! Curved solids in their unit space: ellipsoids, and cylinders, cones and frustums of any slant.

use crate::math::{Bounds, DVec3, Placement, Ray};

use super::span::{End, Span, rounding_at};

/// The face numbers of a frustum.
pub(super) const SIDE: u32 = 0;
const BOTTOM: u32 = 1;
const TOP: u32 = 2;

/// A unit sphere or frustum under an affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    place: Placement,
    profile: Profile,
    /// How far a point of it may be off its place, by its map and by our own rounding, along each axis of the unit space: a
    /// coin has a sharp rim however thin it is, and a needle a sharp tip.
    off: DVec3,
    /// The same in the world, for all of it.
    displacement: f64,
    /// The least share of it that is our own rounding.
    seeming: f64,
}

/// The outline that is turned about the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Profile {
    Sphere,
    /// `r(z) = middle + slope · z` for `|z| ≤ 1`.
    Frustum {
        middle: f64,
        slope: f64,
    },
}

/// Where a line crosses the side of a frustum between its caps.
#[derive(Clone, Copy, Debug, Default)]
pub struct SideCrossings {
    /// Into it.
    pub enter: Option<End>,
    /// Out of it.
    pub leave: Option<End>,
    /// Whether the line crosses the whole cone, beyond the caps too, only once.
    pub one_way: bool,
}

/// A ray in the unit space, re-centred: `o` is its point closest to the unit origin.
struct Centred {
    o: DVec3,
    d: DVec3,
    d_squared: f64,
    /// `t` of the closest point.
    t: f64,
    /// How far `o` may be off along each axis.
    off: DVec3,
    /// The share of it that is our own rounding.
    seeming: f64,
}

impl Round {
    /// The unit sphere at `place`, which may be off by `map_error`.
    pub fn ellipsoid(place: Placement, map_error: DVec3) -> Self {
        Self::new(place, Profile::Sphere, map_error)
    }

    /// The unit frustum at `place`, which may be off by `map_error`, of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn frustum(place: Placement, bottom: f64, top: f64, map_error: DVec3) -> Self {
        let profile = Profile::Frustum { middle: 0.5 * bottom + 0.5 * top, slope: 0.5 * top - 0.5 * bottom };
        Self::new(place, profile, map_error)
    }

    fn new(place: Placement, profile: Profile, map_error: DVec3) -> Self {
        let rows = [place.inverse.row(0), place.inverse.row(1), place.inverse.row(2)];
        let seen = rounding_at(place.center.length());
        let off = rows.map(|row| seen * row.length() + row.abs().dot(map_error));
        let seeming = (0..3).map(|i| seen * rows[i].length() / off[i]).fold(1.0, f64::min);
        let displacement = seen + map_error.length();
        Self { place, profile, off: DVec3::from_array(off), displacement, seeming }
    }

    /// Where the ray is inside. A chord that rounding could have made counts as none.
    #[inline]
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let ray = self.centred(ray);
        match self.profile {
            Profile::Sphere => sphere_span(&ray),
            Profile::Frustum { middle, slope } => frustum_span(&ray, middle, slope),
        }
    }

    /// Where the line crosses the side of a frustum: into it, and out of it. A line with only one crossing, which is
    /// steeper than the side or parallel to it, has only one of them.
    pub fn side_crossings(&self, ray: &Ray) -> SideCrossings {
        let ray = self.centred(ray);
        let Profile::Frustum { middle, slope } = self.profile else { return SideCrossings::default() };
        if ray.passes_by() {
            return SideCrossings::default();
        }
        let Some(side) = side_span(&ray, middle, slope) else { return SideCrossings::default() };
        let [enter, leave] = [side.enter, side.leave].map(|end| {
            let z = ray.o.z + end.t * ray.d.z;
            (end.t.is_finite() && z.abs() <= 1.0).then_some(End { t: ray.t + end.t, ..end })
        });
        SideCrossings { enter, leave, one_way: !side.enter.t.is_finite() || !side.leave.t.is_finite() }
    }

    fn centred(&self, ray: &Ray) -> Centred {
        let from_center = ray.o - self.place.center;
        let o = self.place.inverse * from_center;
        let d = self.place.inverse * ray.d;
        let d_squared = d.length_squared();
        let first = -o.dot(d) / d_squared;
        let o = o + first * d;
        let second = -o.dot(d) / d_squared;
        let o = o + second * d;
        Centred { o, d, d_squared, t: first + second, off: self.off, seeming: self.seeming }
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn off(&self) -> f64 {
        self.displacement
    }

    /// The share of its errors that our own rounding may have made.
    pub fn seeming(&self) -> f64 {
        self.seeming
    }

    /// The outward normal at a point of the surface, of length 1; along the axis at the apex of a cone.
    pub fn normal(&self, p: DVec3, surface: u32) -> DVec3 {
        let q = self.place.inverse * (p - self.place.center);
        let gradient = match (self.profile, surface) {
            (Profile::Sphere, _) => q,
            (Profile::Frustum { .. }, BOTTOM) => DVec3::NEG_Z,
            (Profile::Frustum { .. }, TOP) => DVec3::Z,
            (Profile::Frustum { middle, slope }, _) => {
                // The gradient of x² + y² − r(z)², with r taken from the point's own distance to the axis:
                // on the surface they are equal, and this one can not turn inward.
                let r = libm::hypot(q.x, q.y);
                let side = DVec3::new(q.x, q.y, -slope * r);
                if r > 0.0 && (middle + slope * q.z > 0.0 || r > f64::EPSILON) {
                    side
                } else {
                    DVec3::Z * if slope < 0.0 { 1.0 } else { -1.0 }
                }
            }
        };
        // A normal goes through the transposed inverse; scaled first, so that no square overflows.
        let normal = self.place.inverse.transpose() * gradient;
        let size = normal.abs().max_element();
        (normal / size).normalize_or(DVec3::Z)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        let linear = self.place.linear;
        let rows = [linear.row(0), linear.row(1), linear.row(2)];
        match self.profile {
            Profile::Sphere => {
                let half = DVec3::from_array(rows.map(DVec3::length));
                Bounds::new(self.place.center - half, self.place.center + half)
            }
            Profile::Frustum { middle, slope } => {
                // The two discs: centre ± axis, half-width r · |(x, y) part of the row|.
                let disc = |z: f64| {
                    let r = middle + slope * z;
                    let half = DVec3::from_array(rows.map(|row| r * libm::hypot(row.x, row.y)));
                    let center = self.place.center + linear.z_axis * z;
                    Bounds::new(center - half, center + half)
                };
                disc(-1.0).join(&disc(1.0))
            }
        }
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let unit = self.place.linear.transpose() * v;
        let reach = match self.profile {
            Profile::Sphere => unit.length(),
            Profile::Frustum { middle, slope } => {
                let disc = |z: f64| (middle + slope * z) * libm::hypot(unit.x, unit.y) + z * unit.z;
                disc(-1.0).max(disc(1.0))
            }
        };
        self.place.center.dot(v) + reach
    }

    /// How the box lies in the unit space: the box around it there.
    fn unit_bounds(&self, b: &Bounds) -> Bounds {
        let inverse = &self.place.inverse;
        let center = *inverse * (b.center() - self.place.center);
        let half = inverse.x_axis.abs() * b.half().x
            + inverse.y_axis.abs() * b.half().y
            + inverse.z_axis.abs() * b.half().z;
        Bounds::new(center - half, center + half)
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        let u = self.unit_bounds(b);
        let nearest = DVec3::ZERO.clamp(u.lo, u.hi);
        match self.profile {
            Profile::Sphere => nearest.length_squared() > 1.0,
            Profile::Frustum { middle, slope } => {
                let widest = middle + (slope * u.lo.z.max(-1.0)).max(slope * u.hi.z.min(1.0));
                u.lo.z > 1.0 || u.hi.z < -1.0 || nearest.truncate().length() > widest
            }
        }
    }

    /// Whether the box is certainly inside.
    pub fn covers(&self, b: &Bounds) -> bool {
        let u = self.unit_bounds(b);
        let farthest = u.farthest();
        match self.profile {
            Profile::Sphere => farthest.length_squared() < 1.0,
            Profile::Frustum { middle, slope } => {
                let narrowest = middle + (slope * u.lo.z).min(slope * u.hi.z);
                farthest.z < 1.0 && farthest.truncate().length() < narrowest
            }
        }
    }
}

impl Centred {
    /// Whether the line is certainly beside the frustum, which lies within √2 of the unit origin.
    fn passes_by(&self) -> bool {
        let off = self.off.element_sum();
        // (√2 + off)² with 4 for 2√2.
        self.o.length_squared() > 2.0 + off * (4.0 + off)
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
fn frustum_span(ray: &Centred, middle: f64, slope: f64) -> Option<Span> {
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
    let side = side_span(ray, middle, slope)?;
    span.clip(end(side.enter.t, side.enter.error, SIDE), end(side.leave.t, side.leave.error, SIDE));
    span.if_any(ray.seeming, |surface| surface.min(BOTTOM))
}

/// The line against `x² + y² ≤ ρ²`, `ρ = middle + slope · z ≥ 0`: where it is inside, counted from its point closest
/// to the unit origin. An end that there is not is infinite.
fn side_span(ray: &Centred, middle: f64, slope: f64) -> Option<Span> {
    let (o, d) = (ray.o, ray.d);
    let (rho, d_rho) = (middle + slope * o.z, slope * d.z);
    let a = d.x * d.x + d.y * d.y - d_rho * d_rho;
    let b = o.x * d.x + o.y * d.y - rho * d_rho;
    let c = o.x * o.x + o.y * o.y - rho * rho;
    // b² − ac by Lagrange's identity for the form x² + y² − ρ²: differences of products of nearby lengths,
    // never of their squares.
    let across = d.x * o.y - d.y * o.x;
    let along = (squared(d.x * rho - d_rho * o.x) + squared(d.y * rho - d_rho * o.y)).sqrt();
    let discriminant = (along - across.abs()) * (along + across.abs());
    // A point moved by `off` changes the form x² + y² − ρ² by (2|x| + off.x)·off.x, and so for y and ρ: near an apex
    // hardly at all, and at the long end of an ellipse by the long axis' off only.
    let off = DVec3::new(ray.off.x, ray.off.y, slope.abs() * ray.off.z);
    let form_off = |t: f64, off: DVec3| {
        let p = DVec3::new(o.x + t * d.x, o.y + t * d.y, rho + t * d_rho);
        (2.0 * p.abs() + off).dot(off)
    };
    // A chord is none where the form at its middle, −discriminant / a at t = −b / a, may be 0.
    let is_chord = || discriminant > 0.0 && discriminant > a * form_off(-b / a, ray.seeming * off);
    if discriminant.is_nan() || (a > 0.0 && !is_chord()) {
        return None;
    }
    // A line along or inside the cone always crosses it: below 0 there is rounding only.
    let root = discriminant.max(0.0).sqrt();
    // The root of a number that is off by `form_off · |a|` is off by that over twice the root, and never by more than
    // the root of that: all there is to say at the apex, where the root is 0.
    let error = |t: f64| {
        let form_off = form_off(t, off);
        if discriminant < form_off * a.abs() { (form_off / a.abs()).sqrt() } else { 0.5 * form_off / root }
    };
    // The root whose terms do not cancel, and the other from the product c / a.
    let q = -(b + root.copysign(b));
    let (t1, t2) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
    let (low, high) = if t1 < t2 { (t1, t2) } else { (t2, t1) };
    let end = |t: f64, error: f64| End { t, error, surface: SIDE };
    if a > 0.0 {
        Some(Span { enter: end(low, error(low)), leave: end(high, error(high)) })
    } else if a < 0.0 {
        // Steeper than the side: one crossing per nappe; only the one with ρ ≥ 0 is the solid's.
        Some(if d_rho > 0.0 {
            Span { enter: end(high, error(high)), ..Span::LINE }
        } else {
            Span { leave: end(low, error(low)), ..Span::LINE }
        })
    } else if b != 0.0 {
        // Parallel to the side, or to the axis of a cylinder: 2bt + c ≤ 0.
        let t = -0.5 * c / b;
        let end = end(t, 0.5 * form_off(t, off) / b.abs());
        Some(if b > 0.0 { Span { leave: end, ..Span::LINE } } else { Span { enter: end, ..Span::LINE } })
    } else {
        (c < 0.0).then_some(Span::LINE)
    }
}

fn squared(x: f64) -> f64 {
    x * x
}

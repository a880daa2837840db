//! The outline of a frustum: a radius that is linear in z, turned about the z axis.

use crate::math::{Bounds, DMat3, DVec3};

use super::span::{End, Span};
use super::unit_space::Centred;

/// The face number of the side of a frustum.
pub(super) const SIDE: u32 = 0;

/// `r(z) = middle + slope · z` for `|z| ≤ 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taper {
    middle: f64,
    slope: f64,
}

impl Taper {
    /// Of radius `bottom` at z = −1 and `top` at z = 1.
    pub fn new(bottom: f64, top: f64) -> Self {
        Self { middle: 0.5 * bottom + 0.5 * top, slope: 0.5 * top - 0.5 * bottom }
    }

    /// Outward from the side at a point of it; along the axis at the apex of a cone.
    pub fn gradient(&self, q: DVec3) -> DVec3 {
        let Self { middle, slope } = *self;
        // The gradient of x² + y² − r(z)², with r taken from the point's own distance to the axis: on the surface they
        // are equal, and this one can not turn inward.
        let r = libm::hypot(q.x, q.y);
        let side = DVec3::new(q.x, q.y, -slope * r);
        if r > 0.0 && (middle + slope * q.z > 0.0 || r > f64::EPSILON) {
            side
        } else {
            DVec3::Z * if slope < 0.0 { 1.0 } else { -1.0 }
        }
    }

    /// The box around it under a map.
    pub fn bounds(&self, linear: &DMat3, origin: DVec3) -> Bounds {
        let rows = [linear.row(0), linear.row(1), linear.row(2)];
        // The two discs: centre ± axis, half-width r · |(x, y) part of the row|.
        let disc = |z: f64| {
            let r = self.middle + self.slope * z;
            let half = DVec3::from_array(rows.map(|row| r * libm::hypot(row.x, row.y)));
            let center = origin + linear.z_axis * z;
            Bounds::new(center - half, center + half)
        };
        disc(-1.0).join(&disc(1.0))
    }

    /// How far it reaches along `v`: the greatest `q · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let disc = |z: f64| (self.middle + self.slope * z) * libm::hypot(v.x, v.y) + z * v.z;
        disc(-1.0).max(disc(1.0))
    }

    /// Whether a box is certainly outside.
    pub fn misses(&self, u: &Bounds) -> bool {
        let nearest = DVec3::ZERO.clamp(u.lo, u.hi);
        let widest = self.middle + (self.slope * u.lo.z.max(-1.0)).max(self.slope * u.hi.z.min(1.0));
        u.lo.z > 1.0 || u.hi.z < -1.0 || nearest.truncate().length() > widest
    }

    /// Whether a box is certainly inside.
    pub fn covers(&self, u: &Bounds) -> bool {
        let farthest = u.farthest();
        let narrowest = self.middle + (self.slope * u.lo.z).min(self.slope * u.hi.z);
        farthest.z < 1.0 && farthest.truncate().length() < narrowest
    }

    /// The line against `x² + y² ≤ ρ²`, `ρ = middle + slope · z ≥ 0`: where it is inside, counted from its point closest
    /// to the unit origin. An end that there is not is infinite.
    #[inline]
    pub fn side(&self, ray: &Centred) -> Option<Span> {
        let Self { middle, slope } = *self;
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
            if discriminant < form_off * a.abs() {
                (form_off / a.abs()).sqrt()
            } else {
                0.5 * form_off / root
            }
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
}

fn squared(x: f64) -> f64 {
    x * x
}

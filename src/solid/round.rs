//! Curved solids in their unit space: ellipsoids, and cylinders, cones and frustums of any slant.

use crate::math::{Bounds, DVec3, Mask, Number, Placement, Rays, Vector};

use super::span::{Ends, Spans, rounding_at};

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
#[derive(Clone, Copy, Debug)]
pub struct SideCrossings<N: Number> {
    /// Into it.
    pub enter: Ends<N>,
    /// Whether there is such a place.
    pub enters: N::Mask,
    /// Out of it.
    pub leave: Ends<N>,
    /// Whether there is such a place.
    pub leaves: N::Mask,
    /// Whether the line crosses the whole cone, beyond the caps too, only once.
    pub one_way: N::Mask,
}

impl<N: Number> SideCrossings<N> {
    #[inline(always)]
    fn none(like: N) -> Self {
        let Spans { enter, leave, any } = Spans::none(like);
        Self { enter, enters: any, leave, leaves: any, one_way: any }
    }
}

/// Rays in the unit space, re-centred: `o` is the point of each that is closest to the unit origin.
struct Centred<N> {
    o: Vector<N>,
    d: Vector<N>,
    d_squared: N,
    /// `t` of the closest point.
    t: N,
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

    /// Where each ray is inside. A chord that rounding could have made counts as none.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        let rays = self.centred(rays);
        match self.profile {
            Profile::Sphere => sphere_spans(&rays),
            Profile::Frustum { middle, slope } => frustum_spans(&rays, middle, slope),
        }
    }

    /// Where each line crosses the side of a frustum: into it, and out of it. A line with only one crossing, which is
    /// steeper than the side or parallel to it, has only one of them. The side of an ellipsoid is never crossed.
    #[inline(always)]
    pub fn side_crossings<N: Number>(&self, rays: &Rays<N>) -> SideCrossings<N> {
        let rays = self.centred(rays);
        let near = !rays.pass_by();
        if !near.any() {
            return SideCrossings::none(rays.t);
        }
        let (middle, slope) = match self.profile {
            Profile::Frustum { middle, slope } => (middle, slope),
            Profile::Sphere => (f64::NAN, 0.0),
        };
        let side = side_spans(&rays, middle, slope);
        let met = side.any & near;
        SideCrossings {
            enter: Ends { t: rays.t + side.enter.t, ..side.enter },
            enters: met & rays.between_caps(side.enter.t),
            leave: Ends { t: rays.t + side.leave.t, ..side.leave },
            leaves: met & rays.between_caps(side.leave.t),
            one_way: met & !(is_finite(side.enter.t) & is_finite(side.leave.t)),
        }
    }

    #[inline(always)]
    fn centred<N: Number>(&self, rays: &Rays<N>) -> Centred<N> {
        let from_center = rays.o - self.place.center;
        let o = from_center.mapped(&self.place.inverse);
        let d = rays.d.mapped(&self.place.inverse);
        let d_squared = d.length_squared();
        let first = -o.dot(d) / d_squared;
        let o = o + d * first;
        let second = -o.dot(d) / d_squared;
        let o = o + d * second;
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

#[inline(always)]
fn is_finite<N: Number>(t: N) -> N::Mask {
    t.magnitude().is_below(t.same(f64::INFINITY))
}

impl<N: Number> Centred<N> {
    /// Whether a place on the line, so far from its point closest to the unit origin, lies between the caps.
    #[inline(always)]
    fn between_caps(&self, t: N) -> N::Mask {
        let z = self.o.z + t * self.d.z;
        is_finite(t) & z.magnitude().is_at_most(z.same(1.0))
    }

    /// Whether the line is certainly beside the frustum, which lies within √2 of the unit origin.
    #[inline(always)]
    fn pass_by(&self) -> N::Mask {
        let off = self.off.element_sum();
        // (√2 + off)² with 4 for 2√2.
        self.o.length_squared().is_above(self.t.same(2.0 + off * (4.0 + off)))
    }
}

#[inline(always)]
fn sphere_spans<N: Number>(rays: &Centred<N>) -> Spans<N> {
    let l_squared = rays.o.length_squared();
    let near_enough = l_squared.is_at_most(rays.t.same(1.0));
    if !near_enough.any() {
        return Spans::none(rays.t);
    }
    let l = l_squared.root();
    let half_squared = (-l + 1.0) * (l + 1.0);
    // Moving the ray by at most `off` changes the square of the half-chord by 2·o·off.
    let across = rays.o.magnitude().dot_one(rays.off);
    let any = near_enough & half_squared.is_above(across * 2.0 * rays.seeming);
    let root = half_squared.root();
    let speed = rays.d_squared.root();
    let half = root / speed;
    // The crossing q = o ± half·d, moved by `off`, moves along the ray by |q|·off over q·d, and |q·d| = speed · root.
    // Half a chord that the map's own error could have made is off by no more than all of that.
    let sideways = half_squared.is_below(across * 2.0).choose((across * 2.0).root(), across / root);
    let error = (sideways + rays.d.magnitude().dot_one(rays.off) / speed) / speed;
    let surface = rays.t.same(0.0);
    Spans {
        enter: Ends { t: rays.t - half, error, surface },
        leave: Ends { t: rays.t + half, error, surface },
        any,
    }
}

/// The lines against the side, then against `|z| ≤ 1`.
#[inline(always)]
fn frustum_spans<N: Number>(rays: &Centred<N>, middle: f64, slope: f64) -> Spans<N> {
    let (o, d) = (rays.o, rays.d);
    let mut spans = Spans::line(rays.t);
    let zero = rays.t.same(0.0);
    let still = d.z.is_equal(zero);
    let inside = o.z.is_at_least(rays.t.same(-1.0)) & o.z.is_below(rays.t.same(1.0));
    spans.any = !rays.pass_by() & (!still | inside);
    if !spans.any.any() {
        return spans;
    }
    let (low, high) = ((-o.z - 1.0) / d.z, (-o.z + 1.0) / d.z);
    let (error, forward) = (zero.same(rays.off.z) / d.z.magnitude(), d.z.is_above(zero));
    let (bottom, top) = (zero.same(f64::from(BOTTOM)), zero.same(f64::from(TOP)));
    let enter = still.choose(zero.same(f64::NEG_INFINITY), forward.choose(low, high));
    let leave = still.choose(zero.same(f64::INFINITY), forward.choose(high, low));
    spans.clip(
        Ends { t: rays.t + enter, error, surface: forward.choose(bottom, top) },
        Ends { t: rays.t + leave, error, surface: forward.choose(top, bottom) },
    );
    let side = side_spans(rays, middle, slope);
    spans.any = spans.any & side.any;
    spans.clip(
        Ends { t: rays.t + side.enter.t, ..side.enter },
        Ends { t: rays.t + side.leave.t, ..side.leave },
    );
    spans.if_any(
        rays.seeming,
        #[inline(always)]
        |surface| surface.smaller(bottom),
    )
}

/// The lines against `x² + y² ≤ ρ²`, `ρ = middle + slope · z ≥ 0`: where each is inside, counted from its point closest
/// to the unit origin. An end that there is not is infinite.
#[inline(always)]
fn side_spans<N: Number>(rays: &Centred<N>, middle: f64, slope: f64) -> Spans<N> {
    let (o, d) = (rays.o, rays.d);
    let (rho, d_rho) = (o.z * slope + middle, d.z * slope);
    let a = d.x * d.x + d.y * d.y - d_rho * d_rho;
    let b = o.x * d.x + o.y * d.y - rho * d_rho;
    let c = o.x * o.x + o.y * o.y - rho * rho;
    // b² − ac by Lagrange's identity for the form x² + y² − ρ²: differences of products of nearby lengths,
    // never of their squares.
    let across = d.x * o.y - d.y * o.x;
    let along = (squared(d.x * rho - d_rho * o.x) + squared(d.y * rho - d_rho * o.y)).root();
    let discriminant = (along - across.magnitude()) * (along + across.magnitude());
    // A point moved by `off` changes the form x² + y² − ρ² by (2|x| + off.x)·off.x, and so for y and ρ: near an apex
    // hardly at all, and at the long end of an ellipse by the long axis' off only.
    let off = DVec3::new(rays.off.x, rays.off.y, slope.abs() * rays.off.z);
    let form = Rays { o: Vector { z: rho, ..o }, d: Vector { z: d_rho, ..d } };
    let zero = rays.t.same(0.0);
    let (crosses, steeper) = (a.is_above(zero), a.is_below(zero));
    // A chord is none where the form at its middle, −discriminant / a at t = −b / a, may be 0.
    let is_chord =
        discriminant.is_above(zero) & discriminant.is_above(a * form_off(&form, -b / a, rays.seeming * off));
    let is_number = discriminant.is_equal(discriminant);
    let met = is_number & (!crosses | is_chord);
    if !met.any() {
        return Spans::none(rays.t);
    }
    // A line along or inside the cone always crosses it: below 0 there is rounding only.
    let root = discriminant.larger(zero).root();
    // The root whose terms do not cancel, and the other from the product c / a.
    let q = -(b + root.signed_as(b));
    let none = q.is_equal(zero);
    let (t1, t2) = (none.choose(zero, q / a), none.choose(zero, c / q));
    let ordered = t1.is_below(t2);
    let (low, high) = (ordered.choose(t1, t2), ordered.choose(t2, t1));
    let surface = rays.t.same(f64::from(SIDE));
    let steepness = a.magnitude();
    let [low_error, high_error] = [
        end_error(form_off(&form, low, off), steepness, discriminant, root),
        end_error(form_off(&form, high, off), steepness, discriminant, root),
    ];
    let low = Ends { t: low, error: low_error, surface };
    let high = Ends { t: high, error: high_error, surface };
    if !(met & !crosses).any() {
        return Spans { enter: low, leave: high, any: met };
    }
    // Parallel to the side, or to the axis of a cylinder: 2bt + c ≤ 0.
    let t = c * -0.5 / b;
    let once = Ends { t, error: form_off(&form, t, off) * 0.5 / b.magnitude(), surface };
    let line = Spans::line(rays.t);
    // Steeper than the side: one crossing per nappe; only the one with ρ ≥ 0 is the solid's.
    let widens = d_rho.is_above(zero);
    let slanted = !b.is_equal(zero);
    let leaves = b.is_above(zero);
    let enter = Ends::choose(slanted & !leaves, once, line.enter);
    let leave = Ends::choose(slanted & leaves, once, line.leave);
    let enter = Ends::choose(steeper, Ends::choose(widens, high, line.enter), enter);
    let leave = Ends::choose(steeper, Ends::choose(widens, line.leave, low), leave);
    Spans {
        enter: Ends::choose(crosses, low, enter),
        leave: Ends::choose(crosses, high, leave),
        any: met & (crosses | steeper | slanted | c.is_below(zero)),
    }
}

/// How much the form x² + y² − ρ² changes at a place on each line that is moved by `off`; `lines` are (x, y, ρ).
#[inline(always)]
fn form_off<N: Number>(lines: &Rays<N>, t: N, off: DVec3) -> N {
    let p = lines.at(t).magnitude();
    Vector { x: p.x * 2.0 + off.x, y: p.y * 2.0 + off.y, z: p.z * 2.0 + off.z }.dot_one(off)
}

/// How far the end of a chord may be off along its line, by how much the form may be there.
///
/// The root of a number that is off by `form_off · |a|` is off by that over twice the root, and never by more than the
/// root of that: all there is to say at the apex, where the root is 0.
#[inline(always)]
fn end_error<N: Number>(form_off: N, a: N, discriminant: N, root: N) -> N {
    discriminant.is_below(form_off * a).choose((form_off / a).root(), form_off * 0.5 / root)
}

#[inline(always)]
fn squared<N: Number>(x: N) -> N {
    x * x
}

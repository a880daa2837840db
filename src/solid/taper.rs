//! The outline of a truncated cone: a radius that is linear in z, turned about the z axis.

use crate::math::{Bounds, DMat3, DVec3, Mask, Number, Rays, Vector};

use super::span::{Ends, STILL, Spans};
use super::unit_space::Centred;

/// The face number of the side of a truncated cone.
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

    /// Outward from the side at points of it; along the axis at the apex of a cone.
    #[inline(always)]
    pub fn gradient<N: Number>(&self, q: Vector<N>) -> Vector<N> {
        let Self { middle, slope } = *self;
        // The gradient of x² + y² − r(z)², with r taken from the point's own distance to the axis: on the
        // surface they are equal, and this one can not turn inward.
        let r = (q.x * q.x + q.y * q.y).root();
        let zero = r.same(0.0);
        let aside =
            r.is_above(zero) & ((q.z * slope + middle).is_above(zero) | r.is_above(r.same(f64::EPSILON)));
        let apex = q.same(DVec3::Z * if slope < 0.0 { 1.0 } else { -1.0 });
        Vector::choose(aside, Vector { z: r * -slope, ..q }, apex)
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

    /// The radius in the middle, and by how much it grows from there to the top.
    #[inline(always)]
    pub fn numbers(&self) -> [f64; 2] {
        [self.middle, self.slope]
    }

    /// The lines against `x² + y² ≤ ρ²`: as [`Tapers::sides`].
    #[inline(always)]
    pub fn sides<N: Number>(&self, rays: &Centred<N>) -> Spans<N> {
        let tapers = Tapers { middle: rays.t.same(self.middle), slope: rays.t.same(self.slope) };
        let lines = Rays { o: rays.o, d: rays.d };
        let (unit_error, rounding_share) = (rays.o.same(rays.unit_error), rays.t.same(rays.rounding_share));
        if self.slope == 0.0 {
            tapers.of_kind::<true>(&lines, unit_error, rounding_share)
        } else {
            tapers.of_kind::<false>(&lines, unit_error, rounding_share)
        }
    }
}

/// A taper for each of as many rays as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tapers<N> {
    pub middle: N,
    pub slope: N,
}

impl<N: Number> Tapers<N> {
    /// The lines against `x² + y² ≤ ρ²`, `ρ = middle + slope · z ≥ 0`: where each is inside, counted from its
    /// start, the point closest to the unit origin, which may be `unit_error` from its place;
    /// `rounding_share` is the share of that that is our own rounding. An end that there is not is infinite.
    #[inline(always)]
    pub fn sides(&self, rays: &Rays<N>, unit_error: Vector<N>, rounding_share: N) -> Spans<N> {
        self.of_kind::<false>(rays, unit_error, rounding_share)
    }

    /// The same. `STRAIGHT`: all slopes are 0, and the terms that have them are left out.
    #[inline(always)]
    fn of_kind<const STRAIGHT: bool>(
        &self,
        rays: &Rays<N>,
        unit_error: Vector<N>,
        rounding_share: N,
    ) -> Spans<N> {
        let Self { middle, slope } = *self;
        let Rays { o, d } = *rays;
        let zero = middle.same(0.0);
        let (rho, d_rho) = if STRAIGHT { (middle, zero) } else { (o.z * slope + middle, d.z * slope) };
        let (mut a, mut b) = (d.x * d.x + d.y * d.y, o.x * d.x + o.y * d.y);
        if !STRAIGHT {
            (a, b) = (a - d_rho * d_rho, b - rho * d_rho);
        }
        let c = o.x * o.x + o.y * o.y - rho * rho;
        // b² − ac by Lagrange's identity for the form x² + y² − ρ²: differences of products of nearby
        // lengths, never of their squares.
        let across = d.x * o.y - d.y * o.x;
        let (mut x, mut y) = (d.x * rho, d.y * rho);
        if !STRAIGHT {
            (x, y) = (x - d_rho * o.x, y - d_rho * o.y);
        }
        let along = (squared(x) + squared(y)).root();
        let discriminant = (along - across.magnitude()) * (along + across.magnitude());
        let unit_error =
            if STRAIGHT { unit_error } else { Vector { z: slope.magnitude() * unit_error.z, ..unit_error } };
        let form = SideForm::<N, STRAIGHT> { o: Vector { z: rho, ..o }, d: Vector { z: d_rho, ..d } };
        // Where 1 / a overflows the line is parallel to the side.
        let still = zero.same(STILL * N::LEAST);
        let (crosses, steeper) = (a.is_above(still), a.is_below(-still));
        let inverse = zero.same(1.0) / a;
        // A chord is none where the form at its middle, −discriminant / a at t = −b / a, may be 0.
        let known = if N::IS_DOUBLE { unit_error * rounding_share } else { unit_error };
        let least = a * form.error(-b * inverse, known);
        let is_chord = discriminant.is_above(zero) & discriminant.is_above(least);
        let is_number = discriminant.is_equal(discriminant);
        let met = is_number & (!crosses | is_chord);
        let may_meet =
            if N::IS_DOUBLE { met } else { is_number & (!crosses | discriminant.is_above(-least)) };
        if !may_meet.any() {
            return Spans::none(middle);
        }
        // A line along or inside the cone always crosses it: below 0 there is rounding only.
        let root = discriminant.larger(zero).root();
        // The root whose terms do not cancel, and the other from the product c / a.
        let q = -(b + root.signed_as(b));
        let none = q.is_equal(zero);
        let (t1, t2) = (none.choose(zero, q * inverse), none.choose(zero, c / q));
        let ordered = t1.is_below(t2);
        let (low, high) = (ordered.choose(t1, t2), ordered.choose(t2, t1));
        let surface = middle.same(f64::from(SIDE));
        let roots = Roots {
            discriminant,
            half_inverse: zero.same(0.5) / root,
            a: a.magnitude(),
            inverse: inverse.magnitude(),
        };
        let low = Ends { t: low, error: form.root_error(low, unit_error, &roots), surface };
        let high = Ends { t: high, error: form.root_error(high, unit_error, &roots), surface };
        if !(may_meet & !crosses).any() {
            return Spans { enter: low, leave: high, any: met, may: may_meet };
        }
        // Parallel to the side, or to the axis of a cylinder: 2bt + c ≤ 0.
        let t = c * -0.5 / b;
        let once = Ends { t, error: form.error(t, unit_error) * 0.5 / b.magnitude(), surface };
        let line = Spans::line(middle);
        let slanted = !b.is_equal(zero);
        let leaves = b.is_above(zero);
        let mut enter = Ends::choose(slanted & !leaves, once, line.enter);
        let mut leave = Ends::choose(slanted & leaves, once, line.leave);
        if !STRAIGHT {
            // Steeper than the side: one crossing per nappe; only the one with ρ ≥ 0 is the solid's.
            let widens = d_rho.is_above(zero);
            enter = Ends::choose(steeper, Ends::choose(widens, high, line.enter), enter);
            leave = Ends::choose(steeper, Ends::choose(widens, line.leave, low), leave);
        }
        let mut spans = Spans {
            enter: Ends::choose(crosses, low, enter),
            leave: Ends::choose(crosses, high, leave),
            any: met,
            may: may_meet,
        };
        let runs_beside = !(crosses | steeper | slanted);
        spans.keep(
            !runs_beside | c.is_below(zero),
            #[inline(always)]
            || runs_beside & c.magnitude().is_at_most(form.error(zero, unit_error)),
        );
        spans
    }
}

/// The form x² + y² − ρ² along lines; ρ is the third component, and known exactly where it is `STRAIGHT`.
struct SideForm<N, const STRAIGHT: bool> {
    o: Vector<N>,
    d: Vector<N>,
}

impl<N: Number, const STRAIGHT: bool> SideForm<N, STRAIGHT> {
    /// How much a point at `t` that is moved by e, `unit_error`, changes the form: by (2|x| + e.x)·e.x, and
    /// so for y and ρ. Near an apex hardly at all, and at the long end of an ellipse by that of the long axis
    /// only.
    #[inline(always)]
    fn error(&self, t: N, unit_error: Vector<N>) -> N {
        if STRAIGHT {
            let (x, y) = ((self.o.x + self.d.x * t).magnitude(), (self.o.y + self.d.y * t).magnitude());
            return (x * 2.0 + unit_error.x) * unit_error.x + (y * 2.0 + unit_error.y) * unit_error.y;
        }
        let p = (self.o + self.d * t).magnitude();
        Vector { x: p.x * 2.0 + unit_error.x, y: p.y * 2.0 + unit_error.y, z: p.z * 2.0 + unit_error.z }
            .dot(unit_error)
    }

    /// How far a root at `t` may be off. The root of a number that is off by `form_error · |a|` is off by
    /// that over twice the root, and never by more than the root of that: all there is to say at the apex,
    /// where the root is 0.
    #[inline(always)]
    fn root_error(&self, t: N, unit_error: Vector<N>, roots: &Roots<N>) -> N {
        let Roots { discriminant, half_inverse, a, inverse } = *roots;
        let form_error = self.error(t, unit_error);
        let (grazing, error) = (discriminant.is_below(form_error * a), form_error * half_inverse);
        if grazing.any() { grazing.choose((form_error * inverse).root(), error) } else { error }
    }
}

/// What both roots of a form have in common.
struct Roots<N> {
    discriminant: N,
    /// Half of 1 over its root.
    half_inverse: N,
    /// |a|, and 1 over that.
    a: N,
    inverse: N,
}

#[inline(always)]
fn squared<N: Number>(x: N) -> N {
    x * x
}

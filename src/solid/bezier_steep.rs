//! Rays that meet a piece of a Bézier patch steeply: once at most, and where, for one ray or for several at a
//! time.
//!
//! Every normal of a piece lies near its axis. A ray that is not square to any of them crosses the piece once
//! at most, and so it is for the surface a quarter of the piece beyond its rim. So where Newton's method ends
//! inside, the ray crosses the piece; where it ends outside, it does not. Nearer to the rim than rounding may
//! have moved that, nothing is said here: the rim itself decides ([`super::bezier_cell`]).

use crate::math::{DVec3, Mask, Number, Vector};

use super::bezier_cell::evaluated;

/// How a piece lies; of one that is bent too much, or has hardly an area, nothing is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flatness {
    /// Of length 1: all normals, of length 1, of the piece and a quarter beyond are within `spread` of it, or
    /// of its opposite.
    pub axis: DVec3,
    pub spread: f64,
    /// Rays are steep whose directions are so long along the axis.
    pub steep: f64,
    /// How far the first step from the middle may end from the parameters of a crossing, where the ray is
    /// square to the piece; more by its slope where it is not.
    slip: f64,
    /// The same of parameters that the rim may be off by.
    margin: f64,
    /// A line this far from all control points certainly passes beside the piece.
    apart: f64,
}

/// Where rays meet a piece.
pub(super) struct Steep<N: Number> {
    /// Which certainly cross it.
    pub hits: N::Mask,
    /// Which certainly do not.
    pub beside: N::Mask,
    /// Where along the axis that the ray goes farthest on.
    pub along: N,
    /// The length of the normals, at most, over their component along the ray.
    pub slope: N,
    pub uv: [N; 2],
}

/// A chord may be this much steeper than the surface is: so much more is said of a crossing's error then.
const SHARE: f64 = 4.0;

/// Rays whose sine to the axis is below this are never steep: their crossings are known hardly better than
/// halving would know them.
const LEAST_SINE: f64 = 1.0 / 256.0;

/// A piece with less area than this share of the square of its edges is too thin for Newton's method.
const THIN: f64 = 1.0 / 4096.0;

/// How far beyond the rim normals are looked at, as a share of a piece.
const BEYOND: f64 = 0.25;

/// What rounding may take from a first step: far less than a millionth of a piece, whose area is
/// [`THIN`] at least and whose slope 1/[`LEAST_SINE`] at most: 2¹² · 2⁸ roundings of 2⁻⁵² each, some ten
/// times over.
const ROUNDED: f64 = 1e-6;

/// Values of the polynomials that are looked at: the first step ends within a few hundredths of a piece, and
/// each one more squares that.
const STEPS: usize = 6;

impl Flatness {
    const UNKNOWN: Self =
        Self { axis: DVec3::ZERO, spread: 0.0, steep: f64::INFINITY, slip: 0.0, margin: 0.0, apart: 0.0 };

    /// Of a piece with these control points, which may be off by `place_error`. A line farther `apart` from
    /// them than this passes beside.
    pub fn of(points: &[DVec3; 16], place_error: f64, apart: f64) -> Self {
        let wide = extended(points);
        let steps = |stride: usize, places: [usize; 12]| places.map(|i| wide[i + stride] - wide[i]);
        let by_u = steps(1, [0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14]);
        let by_v = steps(4, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
        let longest = |steps: &[DVec3; 12]| steps.iter().map(|s| s.length_squared()).fold(0.0, f64::max);
        let normals = || by_u.iter().flat_map(|u| by_v.iter().map(|v| u.cross(*v)));
        let axis = normals().sum::<DVec3>().normalize_or_zero();
        let (mut least, mut spread) = (f64::INFINITY, 0.0_f64);
        for normal in normals() {
            let length = normal.length();
            least = least.min(length);
            spread = spread.max((normal / length - axis).length());
        }
        // Control points of the extended piece are half as far apart again as those of the piece.
        let squares = longest(&by_u) + longest(&by_v);
        // What is not a number is not known.
        let is_plain = least > THIN * squares && spread < 0.5;
        if !is_plain {
            return Self { axis, apart, ..Self::UNKNOWN };
        }
        // The inverse of a Jacobian is no larger than its entries over its determinant.
        let stretch = 1.0 + 2.0 * BEYOND;
        let inverse = stretch * (squares.sqrt() * 3.0) / (least * 9.0);
        let slip = inverse * bend(points);
        let margin = 4.0 * inverse * place_error;
        let steep = LEAST_SINE.max(spread * SHARE / (SHARE - 1.0));
        Self { axis, spread, steep, slip, margin, apart }
    }

    /// Where rays of directions `d`, which go farthest on axis `main`, meet the piece whose control points
    /// these are: across the rays `x` and `y`, and `along` that axis. A crossing is found to within `fine`.
    #[inline(always)]
    pub fn meet<N: Number>(
        &self,
        [x, y, along]: &[[N; 16]; 3],
        d: Vector<N>,
        main: usize,
        fine: f64,
    ) -> Steep<N> {
        let zero = d.x.same(0.0);
        let mut beside = is_one_side(x) | is_one_side(y);
        let towards = d.dot_one(self.axis);
        let sine = towards.magnitude();
        let is_steep = sine.is_at_least(zero.same(self.steep));
        if (!is_steep & !beside).any() {
            // Seen edge on the piece is thin across its normals.
            let across = d.same(self.axis) - d * towards;
            let (a, b) = (across.along((main + 1) % 3), across.along((main + 2) % 3));
            beside = beside | is_apart(x, y, [a, b], self.apart);
        }
        let mut live = is_steep & !beside;
        let slope = zero.same(1.0) / (sine - self.spread);
        let mut met =
            Steep { hits: zero.is_above(zero), beside, along: zero, slope, uv: [zero.same(0.5); 2] };
        if !live.any() {
            return met;
        }
        let [mut u, mut v] = met.uv;
        let mut found = met.hits;
        for step in 0..STEPS {
            let [at_x, x_u, x_v] = evaluated(x, [u, v]);
            let [at_y, y_u, y_v] = evaluated(y, [u, v]);
            let is_there = at_x.magnitude().larger(at_y.magnitude()).is_at_most(zero.same(fine));
            found = found | (live & is_there);
            live = live & !is_there;
            if !live.any() {
                break;
            }
            let area = x_u * y_v - x_v * y_u;
            u = live.choose(u - (at_x * y_v - at_y * x_v) / area, u);
            v = live.choose(v - (at_y * x_u - at_x * y_u) / area, v);
            let far = if step == 0 { slope * self.slip + ROUNDED } else { zero.same(BEYOND) };
            let outside = is_outside(u, v, far);
            if step == 0 {
                met.beside = met.beside | (live & outside);
            }
            live = live & !outside;
        }
        let margin = slope * self.margin;
        let inside = !is_outside(u, v, -margin);
        met.hits = found & inside;
        met.beside = met.beside | (found & is_outside(u, v, margin));
        met.uv = [u, v];
        if met.hits.any() {
            [met.along, ..] = evaluated(along, met.uv);
        }
        met
    }
}

/// Whether parameters are beyond the rim of a piece by more than `far`.
#[inline(always)]
fn is_outside<N: Number>(u: N, v: N, far: N) -> N::Mask {
    let (low, high) = (-far, far + 1.0);
    u.is_below(low) | u.is_above(high) | v.is_below(low) | v.is_above(high)
}

/// Whether no points, or all, are above 0.
#[inline(always)]
fn is_one_side<N: Number>(net: &[N; 16]) -> N::Mask {
    let (mut least, mut most) = (net[0], net[0]);
    for &x in &net[1..] {
        (least, most) = (x.smaller(least), x.larger(most));
    }
    let zero = least.same(0.0);
    least.is_above(zero) | most.is_at_most(zero)
}

/// Whether all points lie on one side of the line through the origin of the plane whose normal is `across`,
/// farther from it than `apart`.
#[inline(always)]
fn is_apart<N: Number>(x: &[N; 16], y: &[N; 16], across: [N; 2], apart: f64) -> N::Mask {
    let height = |i: usize| x[i] * across[0] + y[i] * across[1];
    let (mut least, mut most) = (height(0), height(0));
    for i in 1..16 {
        let height = x[i] * across[0] + y[i] * across[1];
        (least, most) = (height.smaller(least), height.larger(most));
    }
    let apart = least.same(apart);
    least.is_above(apart) | most.is_below(-apart)
}

/// The control points of the same surface from a quarter before each parameter's least to a quarter beyond
/// its greatest.
fn extended(points: &[DVec3; 16]) -> [DVec3; 16] {
    let mut wide = *points;
    // The blossom of a cubic: the control points of the part from a to b are its values at aaa, aab, abb and
    // bbb.
    let blossom = |p: [DVec3; 4], at: [f64; 3]| {
        let mut p = p;
        for (round, t) in at.into_iter().enumerate() {
            for i in 0..3 - round {
                p[i] = p[i] * (1.0 - t) + p[i + 1] * t;
            }
        }
        p[0]
    };
    let (a, b) = (-BEYOND, 1.0 + BEYOND);
    let along = |p: [DVec3; 4]| [[a, a, a], [a, a, b], [a, b, b], [b, b, b]].map(|at| blossom(p, at));
    for line in 0..4 {
        let row = along([0, 1, 2, 3].map(|i| wide[4 * line + i]));
        wide[4 * line..4 * line + 4].copy_from_slice(&row);
    }
    for line in 0..4 {
        let column = along([0, 1, 2, 3].map(|i| wide[4 * i + line]));
        for (i, p) in column.into_iter().enumerate() {
            wide[4 * i + line] = p;
        }
    }
    wide
}

/// How far a piece lies from the plane that touches it in its middle, and that plane's own parameters, at
/// most.
fn bend(points: &[DVec3; 16]) -> f64 {
    let nets = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
    let values = nets.map(|net| evaluated(&net, [0.5, 0.5]));
    let part = |i: usize| DVec3::new(values[0][i], values[1][i], values[2][i]);
    let flat = |i: usize| {
        let (u, v) = ((i % 4) as f64 / 3.0 - 0.5, (i / 4) as f64 / 3.0 - 0.5);
        part(0) + part(1) * u + part(2) * v
    };
    (0..16).map(|i| points[i].distance(flat(i))).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent(height: f64) -> [DVec3; 16] {
        std::array::from_fn(|i| {
            let (x, y) = ((i % 4) as f64 / 3.0, (i / 4) as f64 / 3.0);
            DVec3::new(x, y, height * (x * y - 0.5 * x * x))
        })
    }

    fn nets(points: &[DVec3; 16], o: DVec3) -> [[f64; 16]; 3] {
        [points.map(|p| p.x - o.x), points.map(|p| p.y - o.y), points.map(|p| p.z - o.z)]
    }

    #[test]
    fn a_ray_down_onto_a_piece_is_decided_all_over() {
        let points = bent(0.2);
        let flatness = Flatness::of(&points, 1e-15, 4e-15);
        assert!(flatness.spread < 0.3 && flatness.steep < 0.5, "{flatness:?}");
        for (x, y) in
            [(0.5, 0.5), (0.01, 0.99), (0.3, 0.8), (1.01, 0.5), (-0.4, 0.2), (3.0, 3.0), (0.5, -0.001)]
        {
            let met = flatness.meet(&nets(&points, DVec3::new(x, y, 5.0)), DVec3::NEG_Z.into(), 2, 1e-15);
            let inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
            assert_eq!((met.hits, met.beside), (inside, !inside), "{x} {y}");
            if inside {
                assert!((met.uv[0] - x).abs() < 1e-14 && (met.uv[1] - y).abs() < 1e-14, "{:?}", met.uv);
            }
        }
    }

    #[test]
    fn nothing_is_said_through_the_rim_or_along_the_piece() {
        let points = bent(0.3);
        let flatness = Flatness::of(&points, 1e-15, 4e-15);
        let from = DVec3::new(0.0, 0.5, 5.0);
        let onto_rim = flatness.meet(&nets(&points, from), DVec3::NEG_Z.into(), 2, 1e-15);
        assert!(!onto_rim.hits && !onto_rim.beside);
        // Along x, its nets being those across x.
        let [x, y, z] = nets(&points, DVec3::new(-5.0, 0.5, 0.01));
        let along = flatness.meet(&[y, z, x], DVec3::X.into(), 0, 1e-15);
        assert!(!along.hits && !along.beside);
        // A ray along it, but above.
        let [x, y, z] = nets(&points, DVec3::new(-5.0, 0.5, 1.0));
        assert!(flatness.meet(&[y, z, x], DVec3::X.into(), 0, 1e-15).beside);
    }

    #[test]
    fn of_a_piece_that_is_folded_or_flat_to_a_line_nothing_is_known() {
        assert_eq!(Flatness::of(&bent(20.0), 1e-15, 4e-15).steep, f64::INFINITY);
        let line: [DVec3; 16] = std::array::from_fn(|i| DVec3::X * i as f64);
        assert_eq!(Flatness::of(&line, 1e-15, 4e-15).steep, f64::INFINITY);
        assert_eq!(Flatness::of(&[DVec3::ONE; 16], 1e-15, 4e-15).steep, f64::INFINITY);
    }
}

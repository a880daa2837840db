//! A part of a Bézier patch in the plane across a ray, as it is halved towards where the ray crosses it.

use crate::math::Number;

use super::bezier_edge::{HALVINGS, PlaneCubic, halves};

/// The Bézier points of a coordinate of a bicubic patch, those of one row side by side: `u` grows along a
/// row, `v` from row to row.
pub(super) type Net = [f64; 16];

/// A part of a patch. The ray is the line of the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Across the ray, on two axes of the world sheared along it.
    pub x: Net,
    pub y: Net,
    /// Along the axis that the ray goes farthest on.
    pub along: Net,
    /// The least parameters, and how often the patch was halved along each.
    start: [f64; 2],
    halved: [u8; 2],
}

/// How steeply a ray may meet a cell that it can not cross twice: the least and the greatest that the length
/// of a normal is, over its component along the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    pub least: f64,
    pub most: f64,
}

/// Where a ray crosses a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    /// Its place along the axis that the ray goes farthest on.
    pub along: f64,
    /// The parameters of the patch.
    pub uv: [f64; 2],
}

/// A product of two differences has the sign of its rounded value, less another such, where that is larger
/// than this share of their magnitudes: two roundings of half an ulp for the differences of each, one for
/// each product and one for the sum make 4 half-ulps, rounded up to 6.
const SIGN: f64 = 3.0 * f64::EPSILON;

/// Steps of Newton's method before a cell is rather halved: it doubles the digits at each, from one on.
const STEPS: usize = 7;

/// How far beyond the rim of a cell its polynomial is followed: a crossing that the rim's rounding gave to
/// this cell may lie a rounding outside of it.
const BEYOND: f64 = 1.0 / 64.0;

#[inline(always)]
fn halves_along_u(net: &Net) -> [Net; 2] {
    let mut both = [[0.0; 16]; 2];
    for row in 0..4 {
        let [a, b] = halves([net[4 * row], net[4 * row + 1], net[4 * row + 2], net[4 * row + 3]]);
        both[0][4 * row..4 * row + 4].copy_from_slice(&a);
        both[1][4 * row..4 * row + 4].copy_from_slice(&b);
    }
    both
}

#[inline(always)]
fn halves_along_v(net: &Net) -> [Net; 2] {
    let mut both = [[0.0; 16]; 2];
    for column in 0..4 {
        let parts = halves([net[column], net[4 + column], net[8 + column], net[12 + column]]);
        for (half, part) in both.iter_mut().zip(parts) {
            for row in 0..4 {
                half[4 * row + column] = part[row];
            }
        }
    }
    both
}

/// Both halves of a net along `u`, axis 0, or `v`, axis 1.
#[inline(always)]
pub(super) fn net_halves(net: &Net, axis: usize) -> [Net; 2] {
    if axis == 0 { halves_along_u(net) } else { halves_along_v(net) }
}

/// The difference of neighbours along a row, or from row to row.
#[inline(always)]
fn along_u(net: &Net, i: usize) -> f64 {
    let at = 4 * (i / 3) + i % 3;
    net[at + 1] - net[at]
}

#[inline(always)]
fn along_v(net: &Net, i: usize) -> f64 {
    net[i + 4] - net[i]
}

/// The least and the greatest of a net.
#[inline(always)]
pub(super) fn range(net: &Net) -> [f64; 2] {
    net.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)])
}

/// The weights of the control points of a cubic curve at a parameter, and those of their differences in its
/// derivative.
#[inline(always)]
fn weights<N: Number>(t: N) -> ([N; 4], [N; 3]) {
    let s = -t + 1.0;
    let (ss, st, tt) = (s * s, s * t, t * t);
    ([ss * s, ss * t * 3.0, st * t * 3.0, tt * t], [ss * 3.0, st * 6.0, tt * 3.0])
}

/// The value and both derivatives of a bicubic polynomial, or of several, each at parameters of its own.
#[inline(always)]
pub(super) fn evaluated<N: Number>(net: &[N; 16], [u, v]: [N; 2]) -> [N; 3] {
    let ((bu, du), (bv, dv)) = (weights(u), weights(v));
    let (mut rows, mut slopes) = ([u; 4], [u; 4]);
    for row in 0..4 {
        let p = &net[4 * row..4 * row + 4];
        rows[row] = bu[0] * p[0] + bu[1] * p[1] + bu[2] * p[2] + bu[3] * p[3];
        slopes[row] = du[0] * (p[1] - p[0]) + du[1] * (p[2] - p[1]) + du[2] * (p[3] - p[2]);
    }
    let value = bv[0] * rows[0] + bv[1] * rows[1] + bv[2] * rows[2] + bv[3] * rows[3];
    let by_u = bv[0] * slopes[0] + bv[1] * slopes[1] + bv[2] * slopes[2] + bv[3] * slopes[3];
    let by_v = dv[0] * (rows[1] - rows[0]) + dv[1] * (rows[2] - rows[1]) + dv[2] * (rows[3] - rows[2]);
    [value, by_u, by_v]
}

impl Cell {
    /// The whole of a patch.
    pub fn whole(x: Net, y: Net, along: Net) -> Self {
        Self { x, y, along, start: [0.0; 2], halved: [0; 2] }
    }

    /// Whether the ray passes beside all points of the cell, and so beside every part of it: to the bit, as
    /// the cell's rim has it ([`PlaneCubic::crosses_odd`]).
    #[inline]
    pub fn is_beside(&self) -> bool {
        let one_side = |net: &Net| {
            let above = net.iter().filter(|&&x| x > 0.0).count();
            above == 0 || above == net.len()
        };
        one_side(&self.x) || one_side(&self.y)
    }

    /// Whether the rim goes around the ray an odd number of times: then the ray crosses the cell, an odd
    /// number of times too.
    pub fn is_crossed_odd(&self) -> bool {
        let [by_u, by_v] = self.halved;
        let side = |at: [usize; 4], halved: u8| {
            PlaneCubic { x: at.map(|i| self.x[i]), y: at.map(|i| self.y[i]) }.crosses_odd(halved)
        };
        side([0, 1, 2, 3], by_u)
            ^ side([12, 13, 14, 15], by_u)
            ^ side([0, 4, 8, 12], by_v)
            ^ side([3, 7, 11, 15], by_v)
    }

    /// The greatest difference of neighbours along `u` and along `v`, across the ray. All points are within
    /// three times their sum of each other, and halving the cell halves the one.
    fn steps(&self) -> [f64; 2] {
        let most = |step: fn(&Net, usize) -> f64| {
            (0..12).fold(0.0, |most: f64, i| most.max(step(&self.x, i).abs().max(step(&self.y, i).abs())))
        };
        [most(along_u), most(along_v)]
    }

    /// Both halves along the parameter that the cell is longer by; none where all of it lies within `fine` of
    /// a straight line across the ray, or it was halved too often.
    pub fn halves(&self, fine: f64) -> Option<[Self; 2]> {
        let [by_u, by_v] = self.steps();
        let can = self.halved.map(|times| times < HALVINGS);
        let axis = match can {
            [true, true] => usize::from(by_v > by_u),
            [true, false] => 0,
            [false, true] => 1,
            [false, false] => return None,
        };
        if self.is_thin(fine) {
            return None;
        }
        let parts = [&self.x, &self.y, &self.along].map(|net| net_halves(net, axis));
        let mut halved = self.halved;
        halved[axis] += 1;
        let half = |k: usize| {
            let mut start = self.start;
            start[axis] += if k == 0 { 0.0 } else { self.size(axis) * 0.5 };
            Self { x: parts[0][k], y: parts[1][k], along: parts[2][k], start, halved }
        };
        Some([half(0), half(1)])
    }

    /// The length of the cell along a parameter.
    fn size(&self, axis: usize) -> f64 {
        libm::ldexp(1.0, -i32::from(self.halved[axis]))
    }

    /// Whether all points lie within `fine` of the line through the two corners that are farthest apart.
    fn is_thin(&self, fine: f64) -> bool {
        let corner = |a: usize, b: usize| [self.x[b] - self.x[a], self.y[b] - self.y[a]];
        let long = self.longest_way();
        let square = |[x, y]: [f64; 2]| x * x + y * y;
        let limit = fine * square(long).sqrt();
        (0..16).all(|i| {
            let p = corner(0, i);
            if limit == 0.0 {
                square(p) <= fine * fine
            } else {
                (p[0] * long[1] - p[1] * long[0]).abs() <= limit
            }
        })
    }

    /// Whether no ray of this direction can cross the cell twice.
    ///
    /// Two points of the cell differ by a mean of its differences along `u` times the step in `u`, and one of
    /// those along `v` times the step in `v`. Where each of the former turns the same way round to each of
    /// the latter as seen along the ray, so do the means, and the points are not on one ray. Along a side
    /// that is one point differences are 0, and of no weight elsewhere.
    pub fn is_crossed_once(&self) -> bool {
        let [by_u, by_v] = self.differences();
        let mut turns = [true; 2];
        for i in 0..12 {
            let u = [by_u[0][i], by_u[1][i]];
            // All of a row, without a branch, so that several are compared at a time.
            let [mut left, mut right] = [true; 2];
            for j in 0..12 {
                let (up, down) = (u[0] * by_v[1][j], u[1] * by_v[0][j]);
                let (across, bound) = (up - down, SIGN * (up.abs() + down.abs()));
                // What is not a number is not known to turn.
                left &= across > bound;
                right &= across < -bound;
            }
            turns = [turns[0] & left, turns[1] & right];
            if turns == [false; 2] {
                return false;
            }
        }
        true
    }

    /// The slopes of the cell, if no ray of this direction can cross it twice. The same weights as above make
    /// the normals of pairs of differences a normal of the chord: a chord from one point to another, and so
    /// the way that a crossing moves with the surface, is no steeper than the steepest pair.
    pub fn slopes(&self, shear: [f64; 2]) -> Slopes {
        let [by_u, by_v] = self.differences();
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for i in 0..12 {
            let u = [by_u[0][i], by_u[1][i], by_u[2][i]];
            let mut squares = [0.0; 12];
            for (j, square) in squares.iter_mut().enumerate() {
                let v = [by_v[0][j], by_v[1][j], by_v[2][j]];
                let across = u[0] * v[1] - u[1] * v[0];
                let [x, y] = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]];
                // In the world: what the shear did to points its transpose undoes to normals.
                let main = across - shear[0] * x - shear[1] * y;
                *square = (main * main + x * x + y * y) / (across * across);
            }
            for square in squares {
                (least, most) = (least.min(square), most.max(square));
            }
        }
        Slopes { least: least.sqrt(), most: most.sqrt() }
    }

    /// The differences of neighbours along `u` and along `v`, by axis. One that is 0 is left out: another
    /// stands in its place.
    fn differences(&self) -> [[[f64; 12]; 3]; 2] {
        let mut both = [[[0.0; 12]; 3]; 2];
        for (axis, net) in [&self.x, &self.y, &self.along].into_iter().enumerate() {
            for i in 0..12 {
                both[0][axis][i] = along_u(net, i);
                both[1][axis][i] = along_v(net, i);
            }
        }
        for all in &mut both {
            let is_none =
                |all: &[[f64; 12]; 3], i: usize| all[0][i] == 0.0 && all[1][i] == 0.0 && all[2][i] == 0.0;
            let Some(some) = (0..12).find(|&i| !is_none(all, i)) else { continue };
            for i in 0..12 {
                if is_none(all, i) {
                    for steps in all.iter_mut() {
                        steps[i] = steps[some];
                    }
                }
            }
        }
        both
    }

    /// Whether all points lie on one side of a line through the ray that runs as the longest way between
    /// corners does, farther from it than `apart`.
    pub fn is_apart(&self, apart: f64) -> bool {
        let [x, y] = self.longest_way();
        let limit = apart * (x * x + y * y).sqrt();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..16 {
            let height = self.y[i] * x - self.x[i] * y;
            least = if height < least { height } else { least };
            most = if height > most { height } else { most };
        }
        least > limit || most < -limit
    }

    /// Across the ray, from the corner to the corner that are farthest apart.
    fn longest_way(&self) -> [f64; 2] {
        let square = |[x, y]: [f64; 2]| x * x + y * y;
        let way = |a: usize, b: usize| [self.x[b] - self.x[a], self.y[b] - self.y[a]];
        let ways = [way(0, 15), way(3, 12), way(0, 3), way(0, 12)];
        ways.into_iter().fold([0.0; 2], |a, b| if square(b) > square(a) { b } else { a })
    }

    /// Where the ray crosses the cell, which it does once, to within `fine`; none where Newton's method does
    /// not say so.
    pub fn root(&self, fine: f64) -> Option<Root> {
        let [mut u, mut v] = [0.5; 2];
        for _ in 0..STEPS {
            let [x, x_u, x_v] = evaluated(&self.x, [u, v]);
            let [y, y_u, y_v] = evaluated(&self.y, [u, v]);
            if x.abs().max(y.abs()) <= fine {
                let [along, ..] = evaluated(&self.along, [u, v]);
                let at = |axis: usize, t: f64| (self.start[axis] + t * self.size(axis)).clamp(0.0, 1.0);
                return Some(Root { along, uv: [at(0, u), at(1, v)] });
            }
            let across = x_u * y_v - x_v * y_u;
            u = (u - (x * y_v - x_v * y) / across).clamp(-BEYOND, 1.0 + BEYOND);
            v = (v - (x_u * y - x * y_u) / across).clamp(-BEYOND, 1.0 + BEYOND);
        }
        None
    }

    /// The parameters of its middle.
    pub fn middle(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.start[axis] + 0.5 * self.size(axis))
    }
}

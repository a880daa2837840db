//! How often a cubic curve crosses a half-line of the plane, odd or even, so that all who share the curve
//! count alike.
//!
//! Halving a Bézier curve takes means of two numbers only. A rounded mean lies between the two, and does not
//! depend on their order. So the points of a half lie within those of the whole to the bit; whoever walks
//! the curve from its other end finds the same halves; and what the points of a curve say of it, all of its
//! parts say as well. Halved often enough, a curve is a chain of straight pieces, whose crossings are decided
//! exactly: all answers below are those of that chain, however early they are given.

use robust::Coord;

use super::ray_shear::is_right;

/// So often a curve is halved before its pieces count as straight. A piece then is shorter than a rounding of
/// the curve it came from, twice over.
pub(super) const HALVINGS: u8 = 54;

/// A cubic curve in the plane by its Bézier points.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneCubic {
    pub x: [f64; 4],
    pub y: [f64; 4],
}

/// Half the sum: between both, and the same in either order.
#[inline(always)]
pub(super) fn mean(a: f64, b: f64) -> f64 {
    (a + b) * 0.5
}

/// The Bézier points of both halves of a cubic curve (de Casteljau).
#[inline(always)]
pub(super) fn halves([a, b, c, d]: [f64; 4]) -> [[f64; 4]; 2] {
    let (ab, bc, cd) = (mean(a, b), mean(b, c), mean(c, d));
    let (abc, bcd) = (mean(ab, bc), mean(bc, cd));
    let middle = mean(abc, bcd);
    [[a, ab, abc, middle], [middle, bcd, cd, d]]
}

impl PlaneCubic {
    /// Whether the curve crosses the half-line to the right of the origin an odd number of times, given how
    /// often it was halved already. The origin counts as moved by (ε, ε²).
    pub fn crosses_odd(&self, halved: u8) -> bool {
        // Both halves of a curve are rarely undecided together: seldom more than a few are open.
        let mut open = Vec::new();
        let (mut piece, mut depth, mut odd) = (*self, halved, false);
        loop {
            if let Some(is_odd) = piece.decided(depth) {
                odd ^= is_odd;
                let Some(next) = open.pop() else { return odd };
                (piece, depth) = next;
            } else {
                let ([x, x_end], [y, y_end]) = (halves(piece.x), halves(piece.y));
                open.push((Self { x: x_end, y: y_end }, depth + 1));
                (piece, depth) = (Self { x, y }, depth + 1);
            }
        }
    }

    /// The answer, where the points of the curve give it.
    #[inline]
    fn decided(&self, halved: u8) -> Option<bool> {
        let above = self.y.map(|y| y > 0.0);
        if above == [true; 4] || above == [false; 4] {
            return Some(false);
        }
        let right = self.x.map(|x| x > 0.0);
        if right == [false; 4] {
            return Some(false);
        }
        if right == [true; 4] {
            return Some(above[0] != above[3]);
        }
        let end = |i: usize| Coord { x: self.x[i], y: self.y[i] };
        (halved >= HALVINGS).then(|| is_right(end(0), end(3)))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0_f64, -1e-15..1e-15_f64, Just(0.0), Just(-0.0)]
    }

    fn curve() -> impl Strategy<Value = PlaneCubic> {
        let four = || [coordinate(), coordinate(), coordinate(), coordinate()];
        (four(), four()).prop_map(|(x, y)| PlaneCubic { x, y })
    }

    /// The halves, and the curve from its other end.
    fn parts(c: &PlaneCubic) -> [PlaneCubic; 2] {
        let ([x, x_end], [y, y_end]) = (halves(c.x), halves(c.y));
        [PlaneCubic { x, y }, PlaneCubic { x: x_end, y: y_end }]
    }

    proptest! {
        #[test]
        fn halves_and_the_other_way_round_count_alike(curve in curve()) {
            let whole = curve.crosses_odd(0);
            let [first, second] = parts(&curve);
            prop_assert_eq!(whole, first.crosses_odd(1) ^ second.crosses_odd(1));
            let (mut x, mut y) = (curve.x, curve.y);
            x.reverse();
            y.reverse();
            prop_assert_eq!(whole, PlaneCubic { x, y }.crosses_odd(0));
        }

        #[test]
        fn a_closed_chain_far_from_the_origin_crosses_evenly(a in curve(), b in curve(), turn in 0..4) {
            // Two curves from one point to another and back, all to one side of the origin.
            let moved = |c: &PlaneCubic| {
                let away = |v: f64| v + 2.0;
                match turn {
                    0 => PlaneCubic { x: c.x.map(away), y: c.y },
                    1 => PlaneCubic { x: c.x.map(|v| -away(v)), y: c.y },
                    2 => PlaneCubic { x: c.x, y: c.y.map(away) },
                    _ => PlaneCubic { x: c.x, y: c.y.map(|v| -away(v)) },
                }
            };
            let (a, mut b) = (moved(&a), moved(&b));
            (b.x[0], b.y[0], b.x[3], b.y[3]) = (a.x[3], a.y[3], a.x[0], a.y[0]);
            prop_assert_eq!(a.crosses_odd(0), b.crosses_odd(0));
        }
    }

    #[test]
    fn an_arch_around_the_origin_crosses_once() {
        let arch = PlaneCubic { x: [-1.0, -1.0, 1.0, 1.0], y: [-1.0, 2.0, 2.0, -1.0] };
        // It crosses the axis on the left and on the right; only the right counts.
        assert!(arch.crosses_odd(0));
        let beside = PlaneCubic { x: arch.x.map(|x| x + 3.0), ..arch };
        assert!(!beside.crosses_odd(0));
    }
}

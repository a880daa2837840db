//! A bicubic Bézier patch in the world, or a part of one.

use crate::math::{Bounds, DVec3, Mask, Number, Vector};

use super::bezier_cell::{Net, evaluated, net_halves};
use super::bezier_shell::Shell;
use super::bezier_steep::Flatness;

/// A patch by its control points: four rows of four.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub points: [DVec3; 16],
}

/// A piece, and what is known of how it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LyingPiece {
    pub piece: Piece,
    pub flatness: Flatness,
    pub shell: Shell,
}

/// The control points of a piece, or of a piece each for several rays: by axis, four rows of four.
pub(super) type Nets<N> = [[N; 16]; 3];

/// Steps towards the parameters of a point, the first of which are known to a 2000th of a piece, or of a
/// million pieces to a 128th: each squares what is left, to 10⁻¹³ or 10⁻⁸ of a piece.
const STEPS: usize = 2;

/// So far a place without a normal is moved to where there is one: at a corner or along a side that is one
/// point, where the surface still has a plane that touches it. That turns the normal by as much as it turns
/// along so much of a piece.
const ASIDE: f64 = 1.0 / (1 << 20) as f64;

impl Piece {
    /// Its control points by axis.
    pub fn nets(&self) -> Nets<f64> {
        [0, 1, 2].map(|axis| self.points.map(|p| p[axis]))
    }

    fn of_nets([x, y, z]: &[&Net; 3]) -> Self {
        Self { points: std::array::from_fn(|i| DVec3::new(x[i], y[i], z[i])) }
    }

    /// Both halves along `u`, axis 0, or `v`, axis 1.
    fn halves(&self, axis: usize) -> [Self; 2] {
        let [x, y, z] = self.nets().map(|net| net_halves(&net, axis));
        [0, 1].map(|k| Self::of_nets(&[&x[k], &y[k], &z[k]]))
    }

    /// Cuts it in four so many times over, and adds the parts to `pieces`.
    pub fn cut(&self, levels: u32, pieces: &mut Vec<Self>) {
        if levels == 0 {
            pieces.push(*self);
            return;
        }
        for half in self.halves(0) {
            for quarter in half.halves(1) {
                quarter.cut(levels - 1, pieces);
            }
        }
    }

    /// A box around it.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.points)
    }

    /// How far its control points lie from each other at most, or more.
    pub fn size(&self) -> f64 {
        2.0 * self.bounds().half().length()
    }
}

/// Points, and how they move with each parameter.
#[inline(always)]
fn at<N: Number>(nets: &Nets<N>, uv: [N; 2]) -> [Vector<N>; 3] {
    // Not by `map`, whose closure is compiled by itself, for any processor.
    let (x, y, z) = (evaluated(&nets[0], uv), evaluated(&nets[1], uv), evaluated(&nets[2], uv));
    [
        Vector { x: x[0], y: y[0], z: z[0] },
        Vector { x: x[1], y: y[1], z: z[1] },
        Vector { x: x[2], y: y[2], z: z[2] },
    ]
}

/// The parameters of the points nearest to `p`, from parameters near those (Gauss and Newton).
#[inline(always)]
pub(super) fn nearest<N: Number>(nets: &Nets<N>, p: Vector<N>, near: [N; 2]) -> [N; 2] {
    let [mut u, mut v] = near;
    let (zero, one) = (u.same(0.0), u.same(1.0));
    for _ in 0..STEPS {
        let [point, by_u, by_v] = at(nets, [u, v]);
        let left = p - point;
        let (uu, uv, vv) = (by_u.dot(by_u), by_u.dot(by_v), by_v.dot(by_v));
        let (to_u, to_v) = (by_u.dot(left), by_v.dot(left));
        let area = uu * vv - uv * uv;
        let (step_u, step_v) = ((to_u * vv - to_v * uv) / area, (to_v * uu - to_u * uv) / area);
        // Where the surface has no area, the parameters are as good as they can be.
        let is_known = (step_u.magnitude() + step_v.magnitude()).is_below(u.same(f64::INFINITY));
        let within = |t: N| zero.larger(one.smaller(t));
        (u, v) = (is_known.choose(within(u + step_u), u), is_known.choose(within(v + step_v), v));
    }
    [u, v]
}

/// The normals there, of length 1, turned to the left around `u` to `v`.
#[inline(always)]
pub(super) fn normals<N: Number>(nets: &Nets<N>, [u, v]: [N; 2]) -> Vector<N> {
    let [_, by_u, by_v] = at(nets, [u, v]);
    let normal = by_u.cross(by_v);
    // Of vectors of rounded numbers a product that is smaller than this is mostly rounding: so is one with a
    // side that is a point but for rounding.
    let product = by_u.length_squared() * by_v.length_squared();
    let longest = by_u.length_squared().larger(by_v.length_squared());
    let small = longest * longest * (ASIDE * ASIDE);
    let is_plain = normal.length_squared().is_above(small) & product.is_above(small);
    let normal = if (!is_plain).any() {
        let aside = |t: N| t + (-t + 0.5) * ASIDE;
        let [_, by_u, by_v] = at(nets, [aside(u), aside(v)]);
        Vector::choose(is_plain, normal, by_u.cross(by_v))
    } else {
        normal
    };
    let Vector { x, y, z } = normal.magnitude();
    (normal / x.larger(y).larger(z)).normalized_or(normal.same(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a dome whose first row is its top.
    fn dome() -> Piece {
        // The cubic that is nearest to a quarter circle.
        const BEND: f64 = 0.552_284_749_831;
        let arc = [[0.0, 1.0], [BEND, 1.0], [1.0, BEND], [1.0, 0.0]];
        let point = |i: usize| {
            let ([radius, height], [x, y]) = (arc[i / 4], arc[i % 4]);
            DVec3::new(radius * x, radius * y, height)
        };
        Piece { points: std::array::from_fn(point) }
    }

    fn normal(piece: &Piece, uv: [f64; 2]) -> DVec3 {
        normals(&piece.nets(), uv).into()
    }

    fn point(piece: &Piece, uv: [f64; 2]) -> DVec3 {
        at(&piece.nets(), uv)[0].into()
    }

    #[test]
    fn the_top_of_a_dome_has_a_normal() {
        let dome = dome();
        for u in [0.0, 0.3, 1.0] {
            assert!(normal(&dome, [u, 0.0]).dot(DVec3::Z).abs() > 1.0 - 1e-9, "{u}");
        }
        // Everywhere else it points away from the middle, as far as four cubics are a ball: 3 parts in 10⁴.
        for (u, v) in [(0.5, 0.5), (0.1, 0.9), (0.7, 0.2)] {
            let p = point(&dome, [u, v]);
            assert!(normal(&dome, [u, v]).dot(p.normalize()).abs() > 1.0 - 1e-5, "{u} {v}");
        }
    }

    #[test]
    fn the_nearest_point_is_found_to_the_last_digits() {
        let mut parts = Vec::new();
        dome().cut(2, &mut parts);
        for part in parts {
            for (u, v) in [(0.5, 0.5), (0.1, 0.9), (0.71, 0.21), (0.25, 1.0)] {
                let p = point(&part, [u, v]);
                let [a, b] = nearest(&part.nets(), p.into(), [u + 0.0005, v - 0.0005]);
                let q = point(&part, [a, b]);
                assert!(p.distance(q) < 1e-13, "{u} {v}: {a} {b}");
            }
        }
    }

    #[test]
    fn parts_lie_on_the_whole() {
        let mut parts = Vec::new();
        dome().cut(2, &mut parts);
        assert_eq!(parts.len(), 16);
        // The first half along u, of that the second along v, and of that the second along u and v.
        let p = point(&parts[4 + 3], [0.25, 0.75]);
        let q = point(&dome(), [0.25 + 0.25 * 0.25, 0.75 + 0.25 * 0.75]);
        assert!((p - q).length() < 1e-15, "{p} {q}");
    }
}

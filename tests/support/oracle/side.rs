//! Surfaces as equations in world coordinates: the sides of convex solids.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::{HalfSpace, Shape};

use super::number::{Number, cross, dot};

/// A point or direction with a fourth coordinate: 1 for points, 0 for directions.
pub type Row<N> = [N; 4];

/// A function of the point that is 0 on the surface and below 0 inside.
#[derive(Clone, Debug)]
pub enum Side<N> {
    /// `row · (x, y, z, 1)`.
    Plane(Row<N>),
    /// `p Q p` with a symmetric matrix.
    Quadric([Row<N>; 4]),
}

pub fn point<N: Number>(p: DVec3) -> Row<N> {
    [p.x.into(), p.y.into(), p.z.into(), 1.0.into()]
}

pub fn direction<N: Number>(d: DVec3) -> Row<N> {
    [d.x.into(), d.y.into(), d.z.into(), 0.0.into()]
}

/// The three coordinates.
pub fn place<N: Number>(row: &Row<N>) -> [N; 3] {
    [row[0].clone(), row[1].clone(), row[2].clone()]
}

/// `o + t·d`.
pub fn along<N: Number>(o: &Row<N>, d: &Row<N>, t: &N) -> Row<N> {
    std::array::from_fn(|i| o[i].clone() + t.clone() * d[i].clone())
}

fn apply<N: Number>(matrix: &[Row<N>; 4], v: &Row<N>) -> Row<N> {
    std::array::from_fn(|i| dot(&matrix[i], v))
}

/// A point moved by a map.
pub fn mapped<N: Number>(map: &DAffine3, p: DVec3) -> Row<N> {
    let [x, y, z] = p.to_array().map(N::from);
    let [ax, ay, az, o]: [Row<N>; 4] = [map.x_axis, map.y_axis, map.z_axis, map.translation].map(direction);
    let coordinate = |i: usize| {
        let [ax, ay, az, o]: [N; 4] = [ax[i].clone(), ay[i].clone(), az[i].clone(), o[i].clone()];
        ax * x.clone() + ay * y.clone() + az * z.clone() + o
    };
    [coordinate(0), coordinate(1), coordinate(2), 1.0.into()]
}

/// The three upper rows of the inverse of a map, by cofactors.
pub fn inverse<N: Number>(map: &DAffine3) -> [Row<N>; 3] {
    let column = [map.x_axis, map.y_axis, map.z_axis].map(|axis| axis.to_array().map(N::from));
    let cofactors = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| cross(&column[i], &column[j]));
    let determinant = dot(&column[0], &cofactors[0]);
    let origin = map.translation.to_array().map(N::from);
    cofactors.map(|c| {
        let [x, y, z] = c.map(|x| x / determinant.clone());
        let linear = [x, y, z];
        let shift = dot(&linear, &origin);
        let [x, y, z] = linear;
        [x, y, z, -shift]
    })
}

impl<N: Number> Side<N> {
    /// Its value at a point.
    pub fn at(&self, p: &Row<N>) -> N {
        match self {
            Self::Plane(row) => dot(row, p),
            Self::Quadric(q) => dot(p, &apply(q, p)),
        }
    }

    /// Where the line `o + t·d` crosses the surface.
    pub fn crossings(&self, o: &Row<N>, d: &Row<N>) -> Vec<N> {
        match self {
            Self::Plane(row) => {
                let slope = dot(row, d);
                if slope.is_zero() { vec![] } else { vec![-dot(row, o) / slope] }
            }
            Self::Quadric(q) => {
                let (qd, qo) = (apply(q, d), apply(q, o));
                quadratic(&dot(d, &qd), &dot(o, &qd), &dot(o, &qo))
            }
        }
    }

    /// The gradient at a point: outward, of any length, 0 at an apex.
    pub fn gradient(&self, p: &Row<N>) -> [N; 3] {
        match self {
            Self::Plane(row) => place(row),
            Self::Quadric(q) => place(&apply(q, p)),
        }
    }
}

/// The roots of `a t² + 2 b t + c = 0`, none where it has no real root or is constant.
fn quadratic<N: Number>(a: &N, b: &N, c: &N) -> Vec<N> {
    let discriminant = b.clone() * b.clone() - a.clone() * c.clone();
    if discriminant.sign() < 0 {
        return vec![];
    }
    // The sum that does not cancel; the other root is from the product of both.
    let root = discriminant.sqrt();
    let sum = if b.sign() < 0 { root - b.clone() } else { -(b.clone() + root) };
    let mut roots = vec![];
    if !a.is_zero() {
        roots.push(sum.clone() / a.clone());
    }
    if !sum.is_zero() {
        roots.push(c.clone() / sum);
    }
    roots
}

/// The sides of a convex shape, moved into the world: a point `p` of the world is inside where each side is 0
/// or less at it. They stand in the order of the program's own face numbers.
pub fn sides<N: Number>(shape: &Shape, map: &DAffine3) -> Vec<Side<N>> {
    let rows = inverse::<N>(map);
    // The function a·x + b·y + c·z + w of the unit coordinates, as a row over the world's.
    let combine = |a: f64, b: f64, c: f64, w: N| -> Row<N> {
        let [a, b, c] = [a, b, c].map(N::from);
        let mut sum: Row<N> = std::array::from_fn(|i| {
            a.clone() * rows[0][i].clone() + b.clone() * rows[1][i].clone() + c.clone() * rows[2][i].clone()
        });
        sum[3] = sum[3].clone() + w;
        sum
    };
    let zero = || N::from(0.0);
    // The sum of squares of rows, each with a sign.
    let squares = |terms: &[(f64, Row<N>)]| {
        Side::Quadric(std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                terms
                    .iter()
                    .fold(zero(), |sum, (sign, row)| sum + N::from(*sign) * row[i].clone() * row[j].clone())
            })
        }))
    };
    let slab =
        |[a, b, c]: [f64; 3]| [-1.0, 1.0].map(|s| Side::Plane(combine(s * a, s * b, s * c, N::from(-1.0))));
    let (x, y, z) =
        (combine(1.0, 0.0, 0.0, zero()), combine(0.0, 1.0, 0.0, zero()), combine(0.0, 0.0, 1.0, zero()));
    match shape {
        Shape::Sphere => {
            let last = combine(0.0, 0.0, 0.0, N::from(1.0));
            vec![squares(&[(1.0, x), (1.0, y), (1.0, z), (-1.0, last)])]
        }
        Shape::Cone { bottom, top } | Shape::Tube { bottom, top } => {
            let (half, bottom, top) = (N::from(0.5), N::from(*bottom), N::from(*top));
            let slope = half.clone() * (top.clone() - bottom.clone());
            let middle = half * (top + bottom);
            let mut radius: Row<N> = z.map(|x| slope.clone() * x);
            radius[3] = radius[3].clone() + middle;
            let mut all = vec![squares(&[(1.0, x), (1.0, y), (-1.0, radius)])];
            all.extend(slab([0.0, 0.0, 1.0]));
            all
        }
        Shape::Cube => {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().flat_map(slab).collect()
        }
        Shape::Facets(facets) => {
            let plane =
                |h: &HalfSpace| Side::Plane(combine(h.normal.x, h.normal.y, h.normal.z, N::from(-h.offset)));
            facets.faces.iter().map(plane).collect()
        }
        Shape::Mesh(_) | Shape::Bezier(_) | Shape::Sheet(_) | Shape::Face(_) | Shape::Patch(_) => vec![],
    }
}

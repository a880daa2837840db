//! Surfaces as equations in world coordinates: the sides of convex solids, and triangles.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::{HalfSpace, Mesh, Shape};

use super::wide::Wide;

/// A point or direction with a fourth coordinate: 1 for points, 0 for directions.
pub type Row = [Wide; 4];

/// A function of the point that is 0 on the surface and below 0 inside.
#[derive(Clone, Debug)]
pub enum Side {
    /// `row · (x, y, z, 1)`.
    Plane(Row),
    /// `p Q p` with a symmetric matrix.
    Quadric([Row; 4]),
}

pub fn dot(a: &Row, b: &Row) -> Wide {
    (0..4).fold(Wide::ZERO, |sum, i| sum + a[i] * b[i])
}

pub fn point(p: DVec3) -> Row {
    [p.x.into(), p.y.into(), p.z.into(), 1.0.into()]
}

pub fn direction(d: DVec3) -> Row {
    [d.x.into(), d.y.into(), d.z.into(), Wide::ZERO]
}

/// `o + t·d`.
pub fn along(o: &Row, d: &Row, t: Wide) -> Row {
    std::array::from_fn(|i| o[i] + t * d[i])
}

fn apply(matrix: &[Row; 4], v: &Row) -> Row {
    std::array::from_fn(|i| dot(&matrix[i], v))
}

/// The three upper rows of the inverse of a map, by cofactors.
pub fn inverse(map: &DAffine3) -> [Row; 3] {
    let column = [map.x_axis, map.y_axis, map.z_axis].map(direction);
    let cross = |a: &Row, b: &Row| -> [Wide; 3] {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            a[j] * b[k] - a[k] * b[j]
        })
    };
    let cofactors =
        [cross(&column[1], &column[2]), cross(&column[2], &column[0]), cross(&column[0], &column[1])];
    let along_x = &cofactors[0];
    let determinant = (0..3).fold(Wide::ZERO, |sum, i| sum + column[0][i] * along_x[i]);
    let origin = point(map.translation);
    cofactors.map(|c| {
        let linear = c.map(|x| x / determinant);
        let shift = (0..3).fold(Wide::ZERO, |sum, i| sum + linear[i] * origin[i]);
        [linear[0], linear[1], linear[2], -shift]
    })
}

impl Side {
    /// Its value at a point.
    pub fn at(&self, p: &Row) -> Wide {
        match self {
            Self::Plane(row) => dot(row, p),
            Self::Quadric(q) => dot(p, &apply(q, p)),
        }
    }

    /// Where the line `o + t·d` crosses the surface.
    pub fn crossings(&self, o: &Row, d: &Row) -> Vec<Wide> {
        match self {
            Self::Plane(row) => {
                let slope = dot(row, d);
                if slope == Wide::ZERO { vec![] } else { vec![-dot(row, o) / slope] }
            }
            Self::Quadric(q) => {
                let (qd, qo) = (apply(q, d), apply(q, o));
                quadratic(dot(d, &qd), dot(o, &qd), dot(o, &qo))
            }
        }
    }

    /// The gradient at a point: outward, of any length, 0 at an apex.
    pub fn gradient(&self, p: &Row) -> DVec3 {
        let row = match self {
            Self::Plane(row) => *row,
            Self::Quadric(q) => apply(q, p),
        };
        DVec3::new(row[0].value(), row[1].value(), row[2].value())
    }
}

/// The roots of `a t² + 2 b t + c = 0`, none where it has no real root or is constant.
fn quadratic(a: Wide, b: Wide, c: Wide) -> Vec<Wide> {
    let discriminant = b * b - a * c;
    if discriminant.value() < 0.0 {
        return vec![];
    }
    // The sum that does not cancel; the other root is from the product of both.
    let root = discriminant.sqrt();
    let sum = if b.value() < 0.0 { root - b } else { -(b + root) };
    let mut roots = vec![];
    if a != Wide::ZERO {
        roots.push(sum / a);
    }
    if sum != Wide::ZERO {
        roots.push(c / sum);
    }
    roots
}

/// The sides of a convex shape in the world, those of the frustum for its open wall. What is made of polygons has none.
pub fn sides(shape: &Shape, map: &DAffine3) -> Vec<Side> {
    let back = inverse(map);
    let last: Row = [Wide::ZERO, Wide::ZERO, Wide::ZERO, 1.0.into()];
    let combine = |x: f64, y: f64, z: f64, w: f64| -> Row {
        let factors = [x, y, z, w].map(Wide::from);
        let rows = [back[0], back[1], back[2], last];
        std::array::from_fn(|i| (0..4).fold(Wide::ZERO, |sum, k| sum + factors[k] * rows[k][i]))
    };
    // Σ sign · (row · p)², as the matrix Σ sign · row rowᵀ.
    let squares = |terms: &[(f64, Row)]| -> Side {
        Side::Quadric(std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                terms.iter().fold(Wide::ZERO, |sum, (sign, row)| sum + Wide::from(*sign) * row[i] * row[j])
            })
        }))
    };
    let slab = |axis: [f64; 3]| {
        [1.0, -1.0].map(|s| Side::Plane(combine(s * axis[0], s * axis[1], s * axis[2], -1.0)))
    };
    let (x, y, z) = (combine(1.0, 0.0, 0.0, 0.0), combine(0.0, 1.0, 0.0, 0.0), combine(0.0, 0.0, 1.0, 0.0));
    match shape {
        Shape::Sphere => vec![squares(&[(1.0, x), (1.0, y), (1.0, z), (-1.0, last)])],
        Shape::Frustum { bottom, top } | Shape::Tube { bottom, top } => {
            let radius = combine(0.0, 0.0, (top - bottom) / 2.0, f64::midpoint(*top, *bottom));
            let mut all = vec![squares(&[(1.0, x), (1.0, y), (-1.0, radius)])];
            all.extend(slab([0.0, 0.0, 1.0]));
            all
        }
        Shape::Cube => {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().flat_map(slab).collect()
        }
        Shape::Facets(facets) => {
            let plane = |h: &HalfSpace| Side::Plane(combine(h.normal.x, h.normal.y, h.normal.z, -h.offset));
            facets.faces.iter().map(plane).collect()
        }
        Shape::Mesh(_) | Shape::Face(_) | Shape::Patch(_) => vec![],
    }
}

/// A triangle in the world.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    corners: [DVec3; 3],
}

impl Triangle {
    /// All triangles of a mesh, moved by its map.
    pub fn of(mesh: &Mesh, map: &DAffine3) -> Vec<Self> {
        let corner = |i: u32| map.transform_point3(mesh.points[i as usize]);
        mesh.triangles.iter().map(|t| Self { corners: t.map(corner) }).collect()
    }

    /// A polygon as a fan of triangles: a point is inside it if it is inside an odd number of them.
    pub fn fan(corners: &[DVec3]) -> Vec<Self> {
        let apex = corners[0];
        corners[1..].windows(2).map(|edge| Self { corners: [apex, edge[0], edge[1]] }).collect()
    }

    /// The shares of the three corners in a point of the triangle, by areas.
    pub fn shares(&self, p: DVec3) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let normal = self.normal();
        let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal) / normal.length_squared();
        [area(p, b, c), area(a, p, c), area(a, b, p)]
    }

    /// Not of unit length.
    pub fn normal(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Where the line crosses it. A line through an edge that two triangles share crosses exactly one of those
    /// two, or both or neither where they fold back, because both ask the same question about that edge.
    pub fn crossing(&self, o: &Row, d: &Row) -> Option<Wide> {
        let [a, b, c] = self.corners;
        let turns = [(a, b), (b, c), (c, a)].map(|(p, q)| passes_left(p, q, o, d));
        if turns[0] != turns[1] || turns[1] != turns[2] {
            return None;
        }
        self.plane_crossing(o, d)
    }

    /// Where the line crosses its plane.
    pub fn plane_crossing(&self, o: &Row, d: &Row) -> Option<Wide> {
        let [a, b, c] = self.corners.map(point);
        let (u, v) = (minus(&b, &a), minus(&c, &a));
        let normal: [Wide; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            u[j] * v[k] - u[k] * v[j]
        });
        let normal = [normal[0], normal[1], normal[2], Wide::ZERO];
        let slope = dot(&normal, d);
        (slope != Wide::ZERO).then(|| dot(&normal, &minus(&a, o)) / slope)
    }
}

fn minus(a: &Row, b: &Row) -> Row {
    std::array::from_fn(|i| a[i] - b[i])
}

/// On which side the line passes the edge from `p` to `q`: the sign of a determinant, computed for the edge in one
/// fixed order of its ends so that the edge's two triangles never disagree.
fn passes_left(p: DVec3, q: DVec3, o: &Row, d: &Row) -> bool {
    let swapped = p.to_array() > q.to_array();
    let (first, second) = if swapped { (q, p) } else { (p, q) };
    let (a, b) = (minus(&point(first), o), minus(&point(second), o));
    let volume = (0..3).fold(Wide::ZERO, |sum, i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        sum + d[i] * (a[j] * b[k] - a[k] * b[j])
    });
    (volume.value() > 0.0) != swapped
}

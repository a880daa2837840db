//! Triangles in the world, whose neighbours never disagree about the edge between them.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::Mesh;

use super::ball::Ball;
use super::number::{Number, cross, dot, unit};
use super::side::{Row, mapped, place};

/// A triangle in the world.
#[derive(Clone, Debug)]
pub struct Triangle<N> {
    corners: [[N; 3]; 3],
    /// A ball around it.
    pub ball: Ball,
}

fn minus<N: Number>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    std::array::from_fn(|i| a[i].clone() - b[i].clone())
}

impl<N: Number> Triangle<N> {
    /// All triangles of a mesh, moved by its map.
    pub fn of(mesh: &Mesh, map: &DAffine3) -> Vec<Self> {
        let corner = |i: u32| place(&mapped(map, mesh.points[i as usize]));
        mesh.triangles.iter().map(|t| Self::new(t.map(corner))).collect()
    }

    /// A polygon as a frusta of triangles: a point is inside it if it is inside an odd number of them.
    pub fn frusta(corners: &[DVec3], map: &DAffine3) -> Vec<Self> {
        let corners: Vec<[N; 3]> = corners.iter().map(|&p| place(&mapped(map, p))).collect();
        let apex = &corners[0];
        corners[1..]
            .windows(2)
            .map(|edge| Self::new([apex.clone(), edge[0].clone(), edge[1].clone()]))
            .collect()
    }

    fn new(corners: [[N; 3]; 3]) -> Self {
        let ball = Ball::around(&corners.clone().map(|p| DVec3::from_array(p.map(|x| x.value()))));
        Self { corners, ball }
    }

    /// The shares of the three corners in a point of the triangle, by areas.
    pub fn shares(&self, p: &Row<N>) -> [f64; 3] {
        let [a, b, c] = &self.corners;
        let (p, normal) = (place(p), self.normal());
        let size = dot(&normal, &normal);
        let area = |p: &[N; 3], q: &[N; 3], r: &[N; 3]| {
            (dot(&cross(&minus(q, p), &minus(r, p)), &normal) / size.clone()).value()
        };
        [area(&p, b, c), area(a, &p, c), area(a, b, &p)]
    }

    /// Not of unit length.
    pub fn normal(&self) -> [N; 3] {
        let [a, b, c] = &self.corners;
        cross(&minus(b, a), &minus(c, a))
    }

    /// Of length 1.
    pub fn unit_normal(&self) -> DVec3 {
        unit(&self.normal())
    }

    /// The square of its area, four times over.
    pub fn size(&self) -> N {
        let normal = self.normal();
        dot(&normal, &normal)
    }

    /// Where the line crosses it. A line through an edge that two triangles share crosses exactly one of
    /// those two, or both or neither where they fold back, because both ask the same question about that
    /// edge.
    pub fn crossing(&self, o: &Row<N>, d: &Row<N>) -> Option<N> {
        let [a, b, c] = &self.corners;
        let turns = [(a, b), (b, c), (c, a)].map(|(p, q)| passes_left(p, q, o, d));
        if turns[0] != turns[1] || turns[1] != turns[2] {
            return None;
        }
        self.plane_crossing(o, d)
    }

    /// Where the line crosses its plane.
    pub fn plane_crossing(&self, o: &Row<N>, d: &Row<N>) -> Option<N> {
        let normal = self.normal();
        let slope = dot(&normal, &place(d));
        (!slope.is_zero()).then(|| dot(&normal, &minus(&self.corners[0], &place(o))) / slope)
    }
}

/// On which side the line passes the edge from `p` to `q`: the sign of a determinant, computed for the edge
/// in one fixed order of its ends so that the edge's two triangles never disagree.
fn passes_left<N: Number>(p: &[N; 3], q: &[N; 3], o: &Row<N>, d: &Row<N>) -> bool {
    let swapped = p > q;
    let (first, second) = if swapped { (q, p) } else { (p, q) };
    let o = place(o);
    let volume = dot(&place(d), &cross(&minus(first, &o), &minus(second, &o)));
    (volume.sign() > 0) != swapped
}

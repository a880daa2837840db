//! Closed surfaces of triangles.
//!
//! Whether a ray crosses a triangle is decided in the plane across the ray, by the exact signs of the areas
//! that the ray's point spans with each edge (Woop, Benthin, Wald: Watertight ray/triangle intersection, JCGT
//! 2013; signs by Shewchuk's adaptive predicates). A point on an edge counts as moved by an infinitesimal
//! step, the same for all triangles, so that of the triangles around an edge or a corner exactly as many are
//! crossed as a ray beside it would cross: a closed surface is always crossed an even number of times.

use robust::{Coord, orient2d};

use crate::math::{Bounds, DVec3, Placement, Ray};
use crate::scene;

use super::span::{End, ROUNDING};

/// At most this many triangles are tested without looking at a box first.
const LEAF: usize = 4;

/// A closed surface of triangles, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
    reach: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Triangle {
    corners: [DVec3; 3],
    normal: DVec3,
}

/// A box of triangles, or of two boxes. Children are stored behind their parent, the left one right behind it.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    bounds: Bounds,
    /// For a leaf the first triangle; else the right child.
    first: u32,
    /// Triangles of a leaf; 0 for a box of boxes.
    count: u32,
}

impl Mesh {
    /// The triangles of `unit`, put at `place`.
    pub fn new(unit: &scene::Mesh, place: &Placement) -> Self {
        let points: Vec<DVec3> = unit.points.iter().map(|&p| place.linear * p + place.center).collect();
        let mut triangles: Vec<Triangle> = unit
            .triangles
            .iter()
            .map(|t| {
                let corners = t.map(|i| points[i as usize]);
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
                let size = normal.abs().max_element();
                Triangle { corners, normal: (normal / size).normalize_or(DVec3::Z) }
            })
            .collect();
        let reach = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let mut nodes = Vec::new();
        let count = triangles.len();
        build(&mut nodes, &mut triangles, 0, count);
        Self { triangles, nodes, reach }
    }

    /// Every crossing of the line with the surface, in no order.
    pub fn crossings(&self, ray: &Ray, mut found: impl FnMut(End)) {
        let across = Across::new(ray);
        let off = ROUNDING * (self.reach + ray.o.length());
        let mut stack = vec![0_u32];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !line_meets(ray, &node.bounds, off) {
                continue;
            }
            if node.count == 0 {
                stack.push(node.first);
                stack.push(index + 1);
                continue;
            }
            for surface in node.first..node.first + node.count {
                let triangle = &self.triangles[surface as usize];
                if let Some(end) = across.crossing(ray, triangle, off, surface) {
                    found(end);
                }
            }
        }
    }

    /// The normal of a triangle, of length 1, turned either way.
    pub fn normal(&self, surface: u32) -> DVec3 {
        self.triangles[surface as usize].normal
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        self.triangles.iter().flat_map(|t| t.corners).map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.nodes[0].bounds
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        self.bounds().meet(b).is_empty()
    }
}

/// Puts `triangles[from..to]` into the node that it appends, and their halves into nodes behind it.
fn build(nodes: &mut Vec<Node>, triangles: &mut [Triangle], from: usize, to: usize) {
    let part = &mut triangles[from..to];
    let bounds = Bounds::around(part.iter().flat_map(|t| t.corners));
    let index = nodes.len();
    nodes.push(Node { bounds, first: from as u32, count: part.len() as u32 });
    if part.len() <= LEAF {
        return;
    }
    let middle = |t: &Triangle| t.corners[0] / 3.0 + t.corners[1] / 3.0 + t.corners[2] / 3.0;
    let half = Bounds::around(part.iter().map(middle)).half();
    let axis =
        half.to_array().iter().enumerate().fold(0, |best, (i, &h)| if h > half[best] { i } else { best });
    let split = part.len() / 2;
    part.select_nth_unstable_by(split, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    build(nodes, triangles, from, from + split);
    let right = nodes.len() as u32;
    build(nodes, triangles, from + split, to);
    nodes[index].first = right;
    nodes[index].count = 0;
}

/// Whether the line passes the box, its faces moved outward by `off`.
fn line_meets(ray: &Ray, b: &Bounds, off: f64) -> bool {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (lo, hi) = (b.lo[axis] - off - ray.o[axis], b.hi[axis] + off - ray.o[axis]);
        let d = ray.d[axis];
        if d == 0.0 {
            if lo > 0.0 || hi < 0.0 {
                return false;
            }
        } else {
            let (t1, t2) = (lo / d, hi / d);
            low = low.max(t1.min(t2));
            high = high.min(t1.max(t2));
        }
    }
    // Each quotient is off by one rounding; a wider bound only costs a test.
    low <= high + 4.0 * f64::EPSILON * high.abs()
}

/// The plane across a ray: two axes of the world sheared along it.
struct Across {
    axes: [usize; 3],
    shear: [f64; 2],
}

impl Across {
    fn new(ray: &Ray) -> Self {
        let size = ray.d.abs();
        let main = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let axes = [main, (main + 1) % 3, (main + 2) % 3];
        Self { axes, shear: [ray.d[axes[1]] / ray.d[main], ray.d[axes[2]] / ray.d[main]] }
    }

    /// The place of a point in the plane, the ray at (0, 0).
    fn place(&self, ray: &Ray, p: DVec3) -> Coord<f64> {
        let q = p - ray.o;
        let along = q[self.axes[0]];
        Coord { x: q[self.axes[1]] - self.shear[0] * along, y: q[self.axes[2]] - self.shear[1] * along }
    }

    fn crossing(&self, ray: &Ray, triangle: &Triangle, off: f64, surface: u32) -> Option<End> {
        let [a, b, c] = triangle.corners.map(|p| self.place(ray, p));
        let sides = [side(a, b)?, side(b, c)?, side(c, a)?];
        if sides[0] != sides[1] || sides[1] != sides[2] {
            return None;
        }
        let towards = triangle.normal.dot(ray.d);
        // The nearest corner's plane equation has the smallest rounding.
        let from = triangle.corners.map(|p| p - ray.o);
        let near = from
            .into_iter()
            .fold(from[0], |best, p| if p.length_squared() < best.length_squared() { p } else { best });
        let t = triangle.normal.dot(near) / towards;
        let (t, error) = if t.is_finite() {
            (t, off / towards.abs())
        } else {
            // Edge on: anywhere between its corners.
            let along = from.map(|p| p.dot(ray.d));
            let (low, high) = along.into_iter().fold((along[0], along[0]), |(l, h), x| (l.min(x), h.max(x)));
            (0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low + off)
        };
        Some(End { t, error, surface })
    }
}

/// On which side of the directed edge the ray's point lies, itself moved by (ε, ε²); `None` for an edge of no
/// length across the ray, whose triangle has no area there.
fn side(p: Coord<f64>, q: Coord<f64>) -> Option<bool> {
    let area = orient2d(p, q, Coord { x: 0.0, y: 0.0 });
    if area != 0.0 {
        return Some(area > 0.0);
    }
    // The area's change for a step along x is −(q.y − p.y), along y it is q.x − p.x.
    if p.y != q.y {
        return Some(p.y > q.y);
    }
    (p.x != q.x).then_some(q.x > p.x)
}

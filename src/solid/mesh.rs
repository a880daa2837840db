//! Closed surfaces of triangles.
//!
//! Whether a ray crosses a triangle is decided exactly, in the plane across the ray ([`super::ray_shear`]),
//! so that a closed surface is always crossed an even number of times.

use crate::math::{Bounds, DVec3, Placement, Ray};
use crate::scene;

use super::ray_shear::{RayShear, plane_crossing};
use super::span::{End, rounding_at};

/// At most this many triangles are tested without looking at a box first.
const LEAF: usize = 4;

/// A closed surface of triangles, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
    /// How far a corner may seem off its place.
    place_error: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Triangle {
    corners: [DVec3; 3],
    normal: DVec3,
}

/// A box of triangles, or of two boxes. Children are stored behind their parent, the left one right behind
/// it.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    bounds: Bounds,
    /// For a leaf the first triangle; else the right child.
    first: u32,
    /// Triangles of a leaf; 0 for a box of boxes.
    count: u32,
}

impl TriangleMesh {
    /// The triangles of `unit`, put at `place`, which may be off by `map_error`.
    pub fn new(unit: &scene::Mesh, place: &Placement, map_error: DVec3) -> Self {
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
        // Corners are moved into the world: they are what crossings are computed from.
        let reach = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let mut nodes = Vec::new();
        let count = triangles.len();
        build(&mut nodes, &mut triangles, 0, count);
        Self { triangles, nodes, place_error: rounding_at(reach) + map_error.length() }
    }

    /// Every crossing of the line with the surface, in no order.
    pub fn crossings(&self, ray: &Ray, mut found: impl FnMut(End)) {
        let across = RayShear::new(ray);
        let mut stack = vec![0_u32];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !line_meets(ray, &node.bounds, self.place_error) {
                continue;
            }
            if node.count == 0 {
                stack.push(node.first);
                stack.push(index + 1);
                continue;
            }
            for surface in node.first..node.first + node.count {
                let triangle = &self.triangles[surface as usize];
                if let Some(end) = triangle.crossing(ray, &across, self.place_error, surface) {
                    found(end);
                }
            }
        }
    }

    /// The normal of a triangle, of length 1, turned either way.
    pub fn normal(&self, surface: u32) -> DVec3 {
        self.triangles[surface as usize].normal
    }

    /// How far a corner may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
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

/// Whether the line passes the box, its faces moved outward by `margin`.
fn line_meets(ray: &Ray, b: &Bounds, margin: f64) -> bool {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (lo, hi) = (b.lo[axis] - margin - ray.o[axis], b.hi[axis] + margin - ray.o[axis]);
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

impl Triangle {
    fn crossing(&self, ray: &Ray, across: &RayShear, place_error: f64, surface: u32) -> Option<End> {
        if !across.meets_triangle(&self.corners) {
            return None;
        }
        let (t, error) =
            plane_crossing(ray, &self.corners, self.normal, nearest(ray, &self.corners), place_error);
        Some(End { t, error, surface })
    }
}

/// The corner whose plane equation has the smallest rounding.
fn nearest(ray: &Ray, corners: &[DVec3; 3]) -> DVec3 {
    let closer = |a: DVec3, b: DVec3| {
        if b.distance_squared(ray.o) < a.distance_squared(ray.o) { b } else { a }
    };
    corners[1..].iter().fold(corners[0], |best, &p| closer(best, p))
}

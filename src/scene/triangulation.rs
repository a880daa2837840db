//! Polygons cut into triangles, and the edges of those, counted modulo 2.

use std::collections::{HashMap, HashSet};

use earcut::Earcut;

use crate::math::{Bounds, DVec2, DVec3};
use crate::scene::groups::Groups;
use crate::scene::unit_vector::unit;

/// Cuts faces that are not convex, as far as its budget goes.
pub struct EarClipper {
    earcut: Earcut<f64>,
    /// Ear clipping takes up to the cube of the corners where a face crosses itself: some 5e−11 s each.
    /// Simple faces take far less, but are not known as such before.
    budget: f64,
}

/// Cubed corners of a scene's faces: a quarter of a second at worst; one face of 1,700 corners.
const EAR_CLIPPING_BUDGET: f64 = 5e9;

impl Default for EarClipper {
    fn default() -> Self {
        Self { earcut: Earcut::new(), budget: EAR_CLIPPING_BUDGET }
    }
}

impl EarClipper {
    /// Triangles of a face as indices of its corners; none where the budget is used up.
    fn clip(&mut self, face: &[DVec2]) -> Option<Vec<u32>> {
        let corners = face.len() as f64;
        let left = self.budget - corners * corners * corners;
        if left < 0.0 {
            return None;
        }
        self.budget = left;
        let mut ears = Vec::new();
        self.earcut.earcut(face.iter().map(DVec2::to_array), &[], &mut ears);
        Some(ears)
    }

    /// Triangles of outlines that do not cross, which takes their square at most; none where the budget is
    /// used up.
    fn clip_rings(&mut self, corners: &[DVec2], holes: &[u32]) -> Vec<u32> {
        let count = corners.len() as f64;
        let left = self.budget - count * count;
        let mut ears = Vec::new();
        if left >= 0.0 {
            self.budget = left;
            let bounds = Bounds::around(corners.iter().map(|p| p.extend(0.0)));
            let (center, half) = (bounds.center().truncate(), bounds.half().max_element());
            // Unit size, so that no product over- or underflows.
            let local = corners.iter().map(|&p| ((p - center) / half).to_array());
            self.earcut.earcut(local, holes, &mut ears);
        }
        ears
    }
}

/// Cuts a face into triangles whose edges, counted modulo 2, are exactly the face's own: so that a surface
/// of closed faces stays closed however badly a face is shaped. No triangle names a point twice.
pub fn triangulate(
    points: &[DVec3],
    polygon: &[u32],
    clipper: &mut EarClipper,
    mut give: impl FnMut([u32; 3]),
) {
    if let &[a, b, c] = polygon {
        return give([a, b, c]);
    }
    let mut frusta = |cycle: &[u32]| {
        for pair in cycle.windows(2).skip(1) {
            if cycle[0] != pair[0] && cycle[0] != pair[1] {
                give([cycle[0], pair[0], pair[1]]);
            }
        }
    };
    let flat = flattened(points, polygon);
    // Of a face that is not convex, too, a frusta is right by the parity rule: where its triangles overlap
    // they cancel. But every overlap costs each ray that passes it.
    let ears = if is_convex(&flat) { None } else { clipper.clip(&flat) };
    let Some(ears) = ears else { return frusta(polygon) };
    // Ear clipping leaves out corners that lie on a straight line, and other faces may still end there. What
    // the triangles' edges and the polygon's do not share are closed ways along such lines.
    let mut rest = EdgeSet::default();
    for (i, &corner) in polygon.iter().enumerate() {
        rest.toggle(corner, polygon[(i + 1) % polygon.len()]);
    }
    for ear in ears.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|i| polygon[ear[i] as usize]);
        if a != b && b != c && c != a {
            frusta(&[a, b, c]);
            rest.toggle_triangle([a, b, c]);
        }
    }
    rest.cycles().iter().for_each(|cycle| frusta(cycle));
}

/// Cuts what lies within outlines that do not cross, the first around all others, into triangles whose edges,
/// counted modulo 2, are exactly those of the outlines. Corners are numbered outline after outline.
pub fn triangulate_rings(rings: &[&[DVec2]], clipper: &mut EarClipper, mut give: impl FnMut([u32; 3])) {
    let corners: Vec<DVec2> = rings.concat();
    let mut rest = EdgeSet::default();
    let (mut holes, mut start) = (Vec::new(), 0);
    for ring in rings {
        let count = ring.len() as u32;
        (0..count).for_each(|i| rest.toggle(start + i, start + (i + 1) % count));
        start += count;
        holes.push(start);
    }
    holes.pop();
    for ear in clipper.clip_rings(&corners, &holes).chunks_exact(3) {
        let [a, b, c] = [ear[0], ear[1], ear[2]];
        if a != b && b != c && c != a {
            give([a, b, c]);
            rest.toggle_triangle([a, b, c]);
        }
    }
    for cycle in rest.cycles() {
        for pair in cycle.windows(2).skip(1) {
            if cycle[0] != pair[0] && cycle[0] != pair[1] {
                give([cycle[0], pair[0], pair[1]]);
            }
        }
    }
}

/// The corners projected along the polygon's normal by Newell's method, within −1..=1.
fn flattened(points: &[DVec3], polygon: &[u32]) -> Vec<DVec2> {
    let corner = |i: usize| points[polygon[i % polygon.len()] as usize];
    let bounds = Bounds::around((0..polygon.len()).map(corner));
    let (center, half) = (bounds.center(), bounds.half().max_element());
    // Unit size, so that no product over- or underflows.
    let local = |i: usize| if half > 0.0 { (corner(i) - center) / half } else { DVec3::ZERO };
    let newell = (0..polygon.len()).fold(DVec3::ZERO, |sum, i| sum + local(i).cross(local(i + 1)));
    let normal = unit(newell).unwrap_or(DVec3::Z);
    let (right, up) = normal.any_orthonormal_pair();
    (0..polygon.len()).map(|i| DVec2::new(local(i).dot(right), local(i).dot(up))).collect()
}

/// Whether a polygon turns one way only, and once around.
fn is_convex(polygon: &[DVec2]) -> bool {
    let count = polygon.len();
    let side = |i: usize| polygon[(i + 1) % count] - polygon[i % count];
    let mut turns = (0..count).map(|i| side(i).perp_dot(side(i + 1)));
    let one_way = turns.clone().all(|turn| turn >= 0.0) || turns.all(|turn| turn <= 0.0);
    // A star turns one way, too, but its sides change between rising and falling more than twice.
    let rises = (0..count).filter(|&i| (side(i).y < 0.0) != (side(i + 1).y < 0.0)).count();
    one_way && rises <= 2
}

/// Undirected edges that were named an odd number of times.
#[derive(Default)]
pub struct EdgeSet(HashSet<[u32; 2]>);

impl EdgeSet {
    /// Those of triangles: the edges that are open.
    pub fn of<T>(triangles: &[([u32; 3], T)]) -> Self {
        let mut odd = Self::default();
        for &(triangle, _) in triangles {
            odd.toggle_triangle(triangle);
        }
        odd
    }

    fn toggle(&mut self, a: u32, b: u32) {
        let edge = [a.min(b), a.max(b)];
        if !self.0.remove(&edge) {
            self.0.insert(edge);
        }
    }

    fn toggle_triangle(&mut self, [a, b, c]: [u32; 3]) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            self.toggle(from, to);
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether this edge, in either direction, is one of them.
    pub fn has(&self, [a, b]: [u32; 2]) -> bool {
        self.0.contains(&[a.min(b), a.max(b)])
    }

    /// All of their ends, in no order.
    pub fn ends(&self) -> impl Iterator<Item = u32> {
        self.0.iter().flatten().copied()
    }

    /// The edges as closed ways, in an order that does not depend on hashing. Every point has an even number
    /// of edges, since polygons and triangles are closed ways.
    fn cycles(self) -> Vec<Vec<u32>> {
        let mut edges: Vec<[u32; 2]> = self.0.into_iter().collect();
        edges.sort_unstable();
        let mut neighbours: HashMap<u32, Vec<usize>> = HashMap::new();
        for (index, edge) in edges.iter().enumerate() {
            for &end in edge {
                neighbours.entry(end).or_default().push(index);
            }
        }
        let mut used = vec![false; edges.len()];
        let mut cycles = Vec::new();
        for first in 0..edges.len() {
            if used[first] {
                continue;
            }
            let mut cycle = vec![edges[first][0]];
            let mut next = Some(first);
            while let Some(index) = next {
                used[index] = true;
                let [a, b] = edges[index];
                let at = if cycle.last() == Some(&a) { b } else { a };
                cycle.push(at);
                let ways = neighbours.entry(at).or_default();
                while ways.last().is_some_and(|&way| used[way]) {
                    ways.pop();
                }
                next = ways.last().copied();
            }
            cycles.push(cycle);
        }
        cycles
    }
}

/// Takes out triangles of the same three points, two by two: between two equal surfaces lies nothing.
pub fn cancel_pairs<T: Copy>(triangles: &mut Vec<([u32; 3], T)>) {
    let sorted = |number: u32| {
        let mut triangle = triangles[number as usize].0;
        triangle.sort_unstable();
        triangle
    };
    let corners =
        triangles.iter().flat_map(|(triangle, _)| triangle).max().map_or(0, |&last| last as usize + 1);
    let by_first = (0..triangles.len() as u32).map(|number| (sorted(number)[0], number));
    let mut is_kept = vec![true; triangles.len()];
    Groups::new(corners, by_first).each(|_, numbers| {
        if numbers.len() < 2 {
            return;
        }
        numbers.sort_unstable_by_key(|&number| (sorted(number), number));
        for same in numbers.chunk_by(|&a, &b| sorted(a) == sorted(b)) {
            // Of an odd number the first is left.
            same[same.len() % 2..].iter().for_each(|&number| is_kept[number as usize] = false);
        }
    });
    let mut kept = is_kept.into_iter();
    triangles.retain(|_| kept.next().unwrap_or(true));
}

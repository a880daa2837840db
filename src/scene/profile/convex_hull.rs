//! Convex hulls: quickhull, its decisions by exact predicates, so that points that lie in one plane, or are
//! the same, do no harm.

use std::collections::{HashMap, HashSet};

use robust::{Coord, Coord3D, orient2d, orient3d};

use super::figure::Figure;
use super::of_mesh::of_mesh;
use crate::math::{DVec2, DVec3};
use crate::scene::{Mesh, Primitive, Shape, Solid};

/// The smallest convex figure around some; none where that has no area.
pub fn hull_of_figures(figures: &[Figure]) -> Option<Figure> {
    let error = figures.iter().map(|figure| figure.error).fold(0.0, f64::max);
    let corners = outline(figures.iter().flat_map(Figure::corners).collect())?;
    Some(Figure { error, ..Figure::convex(corners) })
}

/// The corners of the smallest convex outline around points, counter-clockwise; none where it has no area.
pub fn outline(mut points: Vec<DVec2>) -> Option<Vec<DVec2>> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && orient2d(coord(a), coord(b), coord(p)) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut outline = chain(&mut points.iter().copied());
    outline.extend(chain(&mut points.iter().rev().copied()));
    (outline.len() >= 3).then_some(outline)
}

/// The smallest convex solid around all corners of meshes; none where it has no volume.
pub fn hull_of_solid(solid: &Solid) -> Option<Primitive> {
    let (mut points, mut error) = (Vec::new(), DVec3::ZERO);
    solid.visit(&mut |primitive| {
        if let Shape::Mesh(mesh) = &primitive.shape {
            error = error.max(primitive.map_error());
            points.extend(mesh.points.iter().map(|&p| primitive.map.transform_point3(p)));
        }
    });
    Some(of_mesh(hull(points)?).with_map_error(error))
}

/// The smallest convex solid around points; none where it has no volume.
pub fn hull(points: Vec<DVec3>) -> Option<Mesh> {
    let mut known = HashSet::with_capacity(points.len());
    let points: Vec<DVec3> = points
        .into_iter()
        .map(|p| p + DVec3::ZERO)
        .filter(|p| p.is_finite() && known.insert(p.to_array().map(f64::to_bits)))
        .collect();
    let size = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    if size == 0.0 || points.len() > u32::MAX as usize {
        return None;
    }
    // By a power of two, so that no product of three coordinates over- or underflows.
    let scale = libm::ldexp(1.0, -libm::ilogb(size).clamp(-1000, 1000));
    let scaled: Vec<DVec3> = points.iter().map(|&p| p * scale).collect();
    let triangles = Hull::around(&scaled)?.triangles();
    let mut places = HashMap::new();
    let mut corners = Vec::new();
    let triangles = triangles
        .into_iter()
        .map(|triangle| {
            triangle.map(|index| {
                *places.entry(index).or_insert_with(|| {
                    corners.push(points[index as usize]);
                    corners.len() as u32 - 1
                })
            })
        })
        .collect();
    Some(Mesh { points: corners, triangles })
}

/// A triangle of a hull as it grows.
struct HullFace {
    /// Counter-clockwise from outside.
    corners: [u32; 3],
    /// Behind the side from each corner to the next.
    beyond: [usize; 3],
    /// Points above it, and above no face before it.
    above: Vec<u32>,
    is_there: bool,
}

struct Hull<'p> {
    points: &'p [DVec3],
    faces: Vec<HullFace>,
}

/// Above 0 where `d` is above the plane through the others, which go round counter-clockwise from there.
fn height(points: &[DVec3], [a, b, c]: [u32; 3], d: u32) -> f64 {
    let at = |index: u32| {
        let p = points[index as usize];
        Coord3D { x: p.x, y: p.y, z: p.z }
    };
    -orient3d(at(a), at(b), at(c), at(d))
}

impl<'p> Hull<'p> {
    fn around(points: &'p [DVec3]) -> Option<Self> {
        let mut hull = Self { points, faces: Vec::new() };
        let first = hull.first()?;
        let mut open: Vec<usize> = (0..4).collect();
        let all: Vec<u32> = (0..points.len() as u32).filter(|index| !first.contains(index)).collect();
        hull.share(&all, &[0, 1, 2, 3]);
        while let Some(face) = open.pop() {
            if hull.faces[face].is_there && !hull.faces[face].above.is_empty() {
                open.extend(hull.grow(face)?);
            }
        }
        Some(hull)
    }

    /// The first four faces, and their corners: points that are not in one plane.
    fn first(&mut self) -> Option<[u32; 4]> {
        let points = self.points;
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            let mut best = (0.0, 0);
            for (index, &p) in points.iter().enumerate() {
                let far = measure(p);
                if far > best.0 {
                    best = (far, index as u32);
                }
            }
            best.1
        };
        let start = points.first()?;
        let a = farthest(&|p| p.distance_squared(*start));
        let origin = points[a as usize];
        let b = farthest(&|p| p.distance_squared(origin));
        let along = points[b as usize] - origin;
        let c = farthest(&|p| along.cross(p - origin).length_squared());
        let normal = along.cross(points[c as usize] - origin);
        let mut d = farthest(&|p| normal.dot(p - origin).abs());
        let is_flat = |d: u32| height(points, [a, b, c], d) == 0.0;
        if is_flat(d) {
            d = (0..points.len() as u32).find(|&d| !is_flat(d))?;
        }
        let (b, c) = if height(points, [a, b, c], d) > 0.0 { (c, b) } else { (b, c) };
        // `d` is below a, b, c now.
        for (corners, beyond) in
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])]
        {
            self.faces.push(HullFace { corners, beyond, above: Vec::new(), is_there: true });
        }
        Some([a, b, c, d])
    }

    /// Gives each point to the first of some faces that it is above.
    fn share(&mut self, points: &[u32], faces: &[usize]) {
        for &point in points {
            let above = |&&face: &&usize| height(self.points, self.faces[face].corners, point) > 0.0;
            if let Some(&face) = faces.iter().find(above) {
                self.faces[face].above.push(point);
            }
        }
    }

    /// Takes the point farthest above a face into the hull; gives the new faces.
    fn grow(&mut self, face: usize) -> Option<Vec<usize>> {
        let [a, b, c] = self.faces[face].corners.map(|index| self.points[index as usize]);
        let normal = (b - a).cross(c - a);
        let far = |index: u32| normal.dot(self.points[index as usize] - a);
        let above = &self.faces[face].above;
        let point =
            above.iter().copied().reduce(|best, next| if far(next) > far(best) { next } else { best })?;
        // All faces that see the point, and the sides behind which none does.
        let mut seen = vec![face];
        self.faces[face].is_there = false;
        let (mut rim, mut next) = (Vec::new(), 0);
        while let Some(&index) = seen.get(next) {
            next += 1;
            for side in 0..3 {
                let other = self.faces[index].beyond[side];
                if !self.faces[other].is_there {
                    continue;
                }
                if height(self.points, self.faces[other].corners, point) > 0.0 {
                    self.faces[other].is_there = false;
                    seen.push(other);
                } else {
                    let corners = self.faces[index].corners;
                    rim.push((corners[side], corners[(side + 1) % 3], other));
                }
            }
        }
        let start = self.faces.len();
        let mut by_first = HashMap::with_capacity(rim.len());
        for (number, &(from, to, other)) in rim.iter().enumerate() {
            let new = start + number;
            // A way round passes each corner once.
            if by_first.insert(from, new).is_some() {
                return None;
            }
            let side = (0..3).find(|&side| {
                let corners = self.faces[other].corners;
                corners[side] == to && corners[(side + 1) % 3] == from
            })?;
            self.faces[other].beyond[side] = new;
            let beyond = [other, usize::MAX, usize::MAX];
            self.faces.push(HullFace {
                corners: [from, to, point],
                beyond,
                above: Vec::new(),
                is_there: true,
            });
        }
        for new in start..self.faces.len() {
            let &behind = by_first.get(&self.faces[new].corners[1])?;
            self.faces[new].beyond[1] = behind;
            self.faces[behind].beyond[2] = new;
        }
        let new: Vec<usize> = (start..self.faces.len()).collect();
        for index in seen {
            let above = std::mem::take(&mut self.faces[index].above);
            let others: Vec<u32> = above.into_iter().filter(|&other| other != point).collect();
            self.share(&others, &new);
        }
        Some(new)
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        self.faces.iter().filter(|face| face.is_there).map(|face| face.corners).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(count: i32) -> Vec<DVec3> {
        let axis = move || (0..=count).map(f64::from);
        axis().flat_map(|x| axis().flat_map(move |y| axis().map(move |z| DVec3::new(x, y, z)))).collect()
    }

    /// Whether every point is on or below every face, by exact predicates, and every side has a face behind
    /// it that turns the other way.
    fn check(points: &[DVec3], mesh: &Mesh) {
        let mut all = mesh.points.clone();
        let corners = all.len() as u32;
        all.extend(points);
        let mut sides = HashSet::new();
        for &triangle in &mesh.triangles {
            for point in corners..all.len() as u32 {
                assert!(height(&all, triangle, point) <= 0.0, "{triangle:?} {point}");
            }
            let [a, b, c] = triangle;
            for side in [(a, b), (b, c), (c, a)] {
                assert!(sides.insert(side), "{side:?} is passed twice");
            }
        }
        assert!(sides.iter().all(|&(a, b)| sides.contains(&(b, a))));
    }

    #[test]
    fn points_in_one_plane_and_on_one_line_do_no_harm() {
        let mut points = grid(4);
        points.extend(grid(4));
        let mesh = hull(points.clone()).unwrap();
        assert_eq!(mesh.points.len(), 8, "the corners of a cube, and no others");
        assert_eq!(mesh.triangles.len(), 12);
        check(&points, &mesh);
    }

    #[test]
    fn flat_points_have_no_hull() {
        assert!(hull(vec![]).is_none());
        assert!(hull(vec![DVec3::ZERO; 9]).is_none());
        assert!(hull((0..9).map(|i| DVec3::new(0.5, 3.5, 1.5) * f64::from(i)).collect()).is_none());
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        assert!(hull(square.map(|[x, y]| DVec3::new(x, y, 0.3)).to_vec()).is_none());
        assert!(outline(square.map(|[x, _]| DVec2::new(x, 0.1 * x)).to_vec()).is_none());
    }

    #[test]
    fn what_is_all_but_in_one_plane_is_sorted_out_exactly() {
        // Corners of a cube that was turned, each a rounding off its faces, and points on its edges.
        let turn = crate::math::DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
        for scale in [1e-200, 1e-4, 1.0, 1e200] {
            let points: Vec<DVec3> = grid(3).into_iter().map(|p| turn * p * scale).collect();
            check(&points.iter().map(|&p| p / scale).collect::<Vec<_>>(), &{
                let mesh = hull(points.iter().map(|&p| p / scale).collect()).unwrap();
                assert!(mesh.points.len() >= 8);
                mesh
            });
            assert!(hull(points).is_some(), "{scale}");
        }
    }

    #[test]
    fn a_flat_outline_goes_round_its_corners_only() {
        let points = (0..=4).flat_map(|x| (0..=4).map(move |y| DVec2::new(f64::from(x), f64::from(y))));
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]].map(DVec2::from);
        assert_eq!(outline(points.collect()), Some(corners.to_vec()));
    }
}

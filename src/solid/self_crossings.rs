//! Where a mesh crosses itself: pairs of triangles of which an edge of one passes through the inside of the
//! other. That is decided exactly; triangles that only touch, or lie in one plane, do not cross.

use rayon::prelude::*;
use robust::{Coord3D, orient3d};

use crate::bvh::{Bvh8, BvhChild};
use crate::math::{Bounds, DVec3};
use crate::scene::Mesh;

/// Triangles that are asked about together, by all threads; after each block it is decided whether to go on,
/// so that the answer is the same for any number of threads.
const BLOCK: usize = 128;

/// So many boxes are looked at before it is given up: some seconds. A mesh of a million triangles that are no
/// larger than their neighbours takes a tenth of it.
const MOST_BOXES: u64 = 2_000_000_000;

/// So many pairs are counted before it is given up: of a heap of 80,000 triangles that all cross each other
/// there are billions, and more of them tell nothing more.
const MOST_PAIRS: u64 = 100_000;

/// What is known of a mesh's crossings with itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SelfCrossings {
    /// Pairs of triangles that cross.
    pub pairs: u64,
    /// A point of the first of them, in the mesh's own coordinates.
    pub first: Option<DVec3>,
    /// Whether all pairs were looked at.
    pub is_complete: bool,
}

impl SelfCrossings {
    /// Those of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        Self::within(mesh, MOST_BOXES)
    }

    /// The same with another limit of boxes.
    fn within(mesh: &Mesh, most: u64) -> Self {
        let whole = Bounds::around(mesh.points.iter().copied());
        let size = whole.farthest().max_element();
        // By a power of two, so that no product of three overflows.
        let scale = libm::ldexp(1.0, -libm::ilogb(size).clamp(-1000, 1000));
        let points: Vec<DVec3> = mesh.points.iter().map(|&point| point * scale).collect();
        let corners = |triangle: usize| mesh.triangles[triangle].map(|corner| points[corner as usize]);
        let boxes: Vec<Bounds> =
            (0..mesh.triangles.len()).map(|triangle| Bounds::around(corners(triangle))).collect();
        let bvh = Bvh8::of_boxes(&boxes, 0.0);
        let mut found = Self { is_complete: true, ..Self::default() };
        let mut looked = 0;
        for start in (0..boxes.len()).step_by(BLOCK) {
            if looked > most || found.pairs > MOST_PAIRS {
                found.is_complete = false;
                break;
            }
            let block = start..(start + BLOCK).min(boxes.len());
            let met = block.into_par_iter().map(|triangle| {
                let mut met = Met::default();
                near(&bvh, &boxes[triangle], &mut met.looked, |other| {
                    let is_new = other > triangle && overlap(&boxes[other], &boxes[triangle]);
                    if is_new
                        && let Some(point) =
                            crossing(mesh.triangles[triangle], mesh.triangles[other], &points)
                    {
                        met.pairs += 1;
                        met.first.get_or_insert(point);
                    }
                });
                met
            });
            for met in met.collect::<Vec<_>>() {
                looked += met.looked;
                found.pairs += met.pairs;
                found.first = found.first.or(met.first.map(|point| point / scale));
            }
        }
        found
    }
}

/// What one triangle has met.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    looked: u64,
    pairs: u64,
    first: Option<DVec3>,
}

/// Calls `f` with all triangles whose boxes may overlap a box, in an order that is always the same.
fn near(bvh: &Bvh8, around: &Bounds, looked: &mut u64, mut f: impl FnMut(usize)) {
    let mut stack = vec![0_u32];
    while let Some(index) = stack.pop() {
        let node = &bvh.nodes()[index as usize];
        *looked += node.len() as u64;
        for slot in 0..node.len() {
            if !overlap(&node.bounds(slot), around) {
                continue;
            }
            match node.child(slot) {
                Some(BvhChild::Node(index)) => stack.push(index),
                Some(BvhChild::Object(object)) => f(object as usize),
                None => {}
            }
        }
    }
}

fn overlap(a: &Bounds, b: &Bounds) -> bool {
    a.lo.cmple(b.hi).all() && b.lo.cmple(a.hi).all()
}

/// A point at which an edge of one triangle passes through the inside of the other. Corners are indices of
/// points: one that both have is in the planes of both, which rounded numbers need not be asked for.
fn crossing(a: [u32; 3], b: [u32; 3], points: &[DVec3]) -> Option<DVec3> {
    // Two that share an edge meet in no other place, or lie in one plane.
    if a.iter().filter(|corner| b.contains(corner)).count() >= 2 {
        return None;
    }
    let at = |corners: [u32; 3]| corners.map(|corner| points[corner as usize]);
    let (places_a, places_b) = (at(a), at(b));
    let sides = |plane: [u32; 3], places: [DVec3; 3], others: [u32; 3]| {
        others.map(|corner| if plane.contains(&corner) { 0.0 } else { side(places, points[corner as usize]) })
    };
    let is_apart = |sides: [f64; 3]| sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
    let of_a = sides(b, places_b, a);
    if is_apart(of_a) {
        return None;
    }
    let of_b = sides(a, places_a, b);
    if is_apart(of_b) {
        return None;
    }
    through(places_a, of_a, places_b).or_else(|| through(places_b, of_b, places_a))
}

/// Where an edge of a triangle passes through the inside of another, on whose `sides` its corners are.
fn through(edges: [DVec3; 3], sides: [f64; 3], other: [DVec3; 3]) -> Option<DVec3> {
    (0..3).find_map(|i| {
        let j = (i + 1) % 3;
        let (from, to) = (edges[i], edges[j]);
        // A product of the two may be smaller than any number.
        if !(sides[i].min(sides[j]) < 0.0 && sides[i].max(sides[j]) > 0.0) {
            return None;
        }
        let around = [0, 1, 2].map(|k| side([from, to, other[k]], other[(k + 1) % 3]));
        let is_inside = around.iter().all(|&s| s > 0.0) || around.iter().all(|&s| s < 0.0);
        is_inside.then(|| from + (to - from) * (sides[i] / (sides[i] - sides[j])))
    })
}

/// On which side of a triangle's plane a point is; the sign is exact, but where the volume between them is
/// smaller than any number: it is 0 then.
fn side(triangle: [DVec3; 3], point: DVec3) -> f64 {
    let at = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    let [a, b, c] = triangle.map(at);
    orient3d(a, b, c, at(point))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedra(places: &[DVec3], scale: f64) -> Mesh {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Mesh {
            points: places.iter().flat_map(|&at| corners.map(|corner| (corner + at) * scale)).collect(),
            triangles: (0..places.len() as u32)
                .flat_map(|i| triangles.map(|t| t.map(|c| c + 4 * i)))
                .collect(),
        }
    }

    #[test]
    fn what_touches_does_not_cross() {
        // Alone, corner on corner, faces on each other, and an edge along a face.
        let places = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.25, -1.0, 0.0)];
        for (count, scale) in [(1, 1.0), (2, 1e-200), (3, 1e200), (4, 1.0)] {
            let found = SelfCrossings::of(&tetrahedra(&places[..count], scale));
            assert_eq!(found, SelfCrossings { pairs: 0, first: None, is_complete: true }, "{count}");
        }
    }

    #[test]
    fn what_crosses_is_counted_and_has_a_place() {
        for scale in [1e-200, 1.0, 1e200] {
            let mesh = tetrahedra(&[DVec3::ZERO, DVec3::new(0.1, 0.15, 0.2)], scale);
            let found = SelfCrossings::of(&mesh);
            assert!(found.pairs > 2 && found.is_complete, "{found:?}");
            let point = found.first.unwrap() / scale;
            assert!(point.min_element() > 0.0 && point.element_sum() <= 1.0 + 1e-12, "{point}");
        }
    }

    #[test]
    fn it_is_given_up_in_time() {
        let places: Vec<DVec3> = (0..600).map(|i| DVec3::splat(f64::from(i) * 1e-4)).collect();
        let mesh = tetrahedra(&places, 1.0);
        assert!(!SelfCrossings::within(&mesh, 1000).is_complete);
    }
}

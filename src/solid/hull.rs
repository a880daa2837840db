//! Meshes that are convex: the half-spaces whose intersection is the same solid, which a ray meets in one
//! span.

use crate::math::{Bounds, DVec3, Placement, Ray};
use crate::scene;

use super::facets::ConvexPolyhedron;
use super::mesh::TriangleMesh;

/// A mesh of more triangles than this is left to its tree of boxes, which tests fewer of them than there are
/// half-spaces.
const MOST_TRIANGLES: usize = 128;

/// How far a corner may be off the plane of its face, as a share of its largest coordinate: three roundings
/// of its own numbers, as they were written, and those of the plane, a cross product and a dot product of
/// differences (2 each), 8 of half an ulp.
const ON_PLANE: f64 = 4.0 * f64::EPSILON;

/// The solid within a mesh at `place`, which may be off by `map_error`, where that is convex.
pub(super) fn convex(unit: &scene::Mesh, place: &Placement, map_error: DVec3) -> Option<ConvexPolyhedron> {
    if unit.triangles.len() > MOST_TRIANGLES {
        return None;
    }
    let mut used: Vec<u32> = unit.triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let points: Vec<DVec3> = used.iter().map(|&i| unit.points[i as usize]).collect();
    let (faces, bent) = half_spaces(unit, &points)?;
    let linear = &place.linear;
    let bent = (linear.x_axis.abs() + linear.y_axis.abs() + linear.z_axis.abs()) * bent;
    let mesh = TriangleMesh::new(unit, place, map_error);
    let middle = points.iter().fold(DVec3::ZERO, |sum, &p| sum + p / points.len() as f64);
    if !has_one_layer(&mesh, *linear * middle + place.center) {
        return None;
    }
    let unit = scene::Facets { faces, bounds: Bounds::around(points.iter().copied()) };
    let corners = points.iter().map(|&p| *linear * p + place.center).collect();
    Some(ConvexPolyhedron::new(&unit, place, map_error + bent).with_corners(corners))
}

/// The half-spaces that have a face in their plane and all points in them, and how far a point may be off.
/// None where a triangle is no part of such a face.
fn half_spaces(mesh: &scene::Mesh, points: &[DVec3]) -> Option<(Vec<scene::HalfSpace>, f64)> {
    let size = Bounds::around(points.iter().copied()).farthest().max_element();
    let within = ON_PLANE * size;
    let corners = |triangle: &[u32; 3]| triangle.map(|i| mesh.points[i as usize]);
    let across = |triangle: &[u32; 3]| {
        let [a, b, c] = corners(triangle);
        // Scaled, so that no product overflows.
        ((b - a) / size).cross((c - a) / size)
    };
    // The planes of large triangles are the surest; small ones beside them lie in these.
    let mut largest_first: Vec<&[u32; 3]> = mesh.triangles.iter().collect();
    largest_first.sort_by(|a, b| across(b).length_squared().total_cmp(&across(a).length_squared()));
    let (mut faces, mut bent) = (Vec::<(DVec3, DVec3)>::new(), 0.0_f64);
    for triangle in largest_first {
        let [a, b, c] = corners(triangle);
        let off = |&(normal, anchor): &(DVec3, DVec3)| {
            [a, b, c].iter().map(|&p| normal.dot(p - anchor).abs()).fold(0.0, f64::max)
        };
        if let Some(off) = faces.iter().map(off).find(|&off| off <= within) {
            bent = bent.max(off);
            continue;
        }
        let normal = across(triangle).try_normalize()?;
        let heights = points.iter().map(|&p| normal.dot(p - a));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let (normal, outside, inside) =
            if high <= -low { (normal, high, low) } else { (-normal, -low, -high) };
        // Flat altogether, or with points on both sides.
        if inside >= -within || outside > within {
            return None;
        }
        faces.push((normal, a));
        bent = bent.max(outside);
    }
    let half_space =
        |(normal, anchor): (DVec3, DVec3)| scene::HalfSpace { normal, offset: normal.dot(anchor) };
    (faces.len() >= 4).then(|| (faces.into_iter().map(half_space).collect(), bent))
}

/// Whether a closed surface, all of which lies on the hull around `middle`, covers it: an even number of
/// layers is nothing. Since it is closed, one line tells.
fn has_one_layer(mesh: &TriangleMesh, middle: DVec3) -> bool {
    let mut sides = [0, 0];
    let ray = Ray::new(middle, DVec3::new(0.36, 0.48, 0.8));
    mesh.crossings(&ray, |end| sides[usize::from(end.t > 0.0)] += 1);
    sides == [1, 1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DAffine3;

    const CORNERS: [[f64; 3]; 6] = [
        [-5.4, -9.4, 6.7],
        [5.4, -9.4, 6.7],
        [0.0, -9.4, 8.9],
        [-5.4, -7.9, 6.7],
        [5.4, -7.9, 6.7],
        [0.0, -7.9, 8.9],
    ];
    const PRISM: [[u32; 3]; 8] =
        [[0, 1, 2], [5, 4, 3], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]];

    fn hull(corners: &[[f64; 3]], triangles: &[[u32; 3]]) -> Option<ConvexPolyhedron> {
        let points = corners.iter().map(|&p| DVec3::from(p)).collect();
        let mesh = scene::Mesh { points, triangles: triangles.to_vec() };
        convex(&mesh, &Placement::new(&DAffine3::IDENTITY).unwrap(), DVec3::ZERO)
    }

    #[test]
    fn a_gable_is_five_half_spaces_with_its_own_corners() {
        let gable = hull(&CORNERS, &PRISM).unwrap();
        assert_eq!(gable.count(), 5);
        assert_eq!(gable.bounds(), Bounds::around(CORNERS.map(DVec3::from)));
        assert_eq!(gable.support(DVec3::new(1.0, 0.0, 1.0)), (5.4 + 6.7_f64).max(8.9));
    }

    #[test]
    fn what_is_dented_or_flat_or_two_layers_deep_is_none() {
        let mut dented = CORNERS.to_vec();
        dented.push([0.0, -8.6, 7.5]);
        // The floor's four corners meet in a point above it.
        let mut triangles = PRISM.to_vec();
        triangles.splice(2..4, [[0, 3, 6], [3, 4, 6], [4, 1, 6], [1, 0, 6]]);
        assert!(hull(&dented, &triangles).is_none());
        // Below it, the same point makes a hull of eight faces.
        dented[6][2] = 6.0;
        assert_eq!(hull(&dented, &triangles).unwrap().count(), 8);
        // By less than can be seen, it makes one of five.
        dented[6][2] = 6.7_f64.next_up();
        assert_eq!(hull(&dented, &triangles).unwrap().count(), 5);
        assert!(hull(&CORNERS.map(|[x, y, _]| [x, y, 1.0]), &PRISM).is_none());
        let twice: Vec<_> = PRISM.iter().chain(&PRISM).copied().collect();
        assert!(hull(&CORNERS, &twice).is_none());
    }
}

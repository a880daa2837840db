//! Minkowski sums: every point of one added to every point of the other.

use std::sync::Arc;

use super::clip::covered;
use super::convex_hull::{hull, outline};
use super::figure::Figure;
use crate::math::{Bounds, DAffine3, DVec2, DVec3};
use crate::scene::triangulation::{EarClipper, triangulate_rings};
use crate::scene::{MaterialId, Mesh, Primitive, Shape, Solid};

/// More sums of two corners than this are not computed.
const MOST_SUMS: usize = 1_000_000;

/// The sum of two figures; none where that is too much to compute.
pub fn sum_of_figures(a: &Figure, b: &Figure, clipper: &mut EarClipper) -> Option<Figure> {
    let (parts, others) = (convex_parts(a, clipper), convex_parts(b, clipper));
    let size = |parts: &[Vec<DVec2>]| parts.iter().map(Vec::len).sum::<usize>();
    if size(&parts).saturating_mul(size(&others)) > MOST_SUMS {
        return None;
    }
    let sums = parts.iter().flat_map(|part| {
        others.iter().filter_map(|other| {
            outline(part.iter().flat_map(|&p| other.iter().map(move |&q| p + q)).collect())
        })
    });
    let figure = covered(&sums.collect::<Vec<_>>());
    Some(Figure { error: figure.error + a.error + b.error, ..figure })
}

/// Convex outlines that cover a figure.
fn convex_parts(figure: &Figure, clipper: &mut EarClipper) -> Vec<Vec<DVec2>> {
    let mut parts = Vec::new();
    for region in &figure.regions {
        let ring = &region.outer;
        let hull = outline(ring.clone());
        if region.holes.is_empty() && hull.is_some_and(|hull| hull.len() == ring.len()) {
            parts.push(ring.clone());
            continue;
        }
        let rings: Vec<&[DVec2]> = region.rings().map(Vec::as_slice).collect();
        let corners = rings.concat();
        triangulate_rings(&rings, clipper, |triangle| {
            parts.push(triangle.map(|i| corners[i as usize]).to_vec());
        });
    }
    parts
}

/// Why there is no sum of two solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSum {
    /// Neither is made of convex parts.
    NotConvex,
    /// It would take too long.
    TooMany,
}

/// The sum of two solids, of which one at least is made of convex parts.
pub fn sum_of_solids(a: &Solid, b: &Solid) -> Result<Solid, NoSum> {
    let (parts, others) = (parts(a)?, parts(b)?);
    let size = |parts: &[Part]| parts.iter().map(|part| part.mesh.points.len()).sum::<usize>();
    if size(&parts).saturating_mul(size(&others)) > MOST_SUMS {
        return Err(NoSum::TooMany);
    }
    let mut sums = Vec::new();
    for part in &parts {
        for other in &others {
            match (part.is_convex, other.is_convex) {
                (true, true) => sums.extend(sum(&part.mesh.points, &other.mesh.points)),
                (false, true) => hollow(part, other, &mut sums)?,
                (true, false) => hollow(other, part, &mut sums)?,
                (false, false) => return Err(NoSum::NotConvex),
            }
        }
    }
    let solid = |mesh: Mesh| Solid::Primitive(of_mesh(mesh));
    Ok(Solid::Union(sums.into_iter().map(solid).collect()))
}

/// A mesh as a primitive of no material in particular.
pub fn of_mesh(mesh: Mesh) -> Primitive {
    Primitive::new(Shape::Mesh(Arc::new(mesh)), DAffine3::IDENTITY, MaterialId(0)).with_map_error(DVec3::ZERO)
}

fn sum(points: &[DVec3], others: &[DVec3]) -> Option<Mesh> {
    hull(points.iter().flat_map(|&p| others.iter().map(move |&q| p + q)).collect())
}

/// The sum of a part that is not convex and one that is: that of its surface, triangle by triangle, and what
/// is within, which is in the part moved to any one point of the other.
fn hollow(part: &Part, convex: &Part, sums: &mut Vec<Mesh>) -> Result<(), NoSum> {
    if part.mesh.triangles.len().saturating_mul(convex.mesh.points.len()) > MOST_SUMS {
        return Err(NoSum::TooMany);
    }
    for triangle in &part.mesh.triangles {
        let corners = triangle.map(|i| part.mesh.points[i as usize]);
        sums.extend(sum(&corners, &convex.mesh.points));
    }
    let by = Bounds::around(convex.mesh.points.iter().copied()).center();
    let points = part.mesh.points.iter().map(|&p| p + by).collect();
    sums.push(Mesh { points, triangles: part.mesh.triangles.clone() });
    Ok(())
}

/// A mesh in its place.
struct Part {
    mesh: Mesh,
    is_convex: bool,
}

/// The parts of a union.
fn parts(solid: &Solid) -> Result<Vec<Part>, NoSum> {
    let mut is_union = true;
    let mut meshes = Vec::new();
    solid.fold(
        &mut |primitive| {
            if let Shape::Mesh(mesh) = &primitive.shape {
                let points = mesh.points.iter().map(|&p| primitive.map.transform_point3(p)).collect();
                meshes.push(Mesh { points, triangles: mesh.triangles.clone() });
            }
        },
        &mut |solid, _| is_union &= matches!(solid, Solid::Union(_)),
    );
    if !is_union {
        return Err(NoSum::NotConvex);
    }
    Ok(meshes.into_iter().map(|mesh| Part { is_convex: is_convex(&mesh), mesh }).collect())
}

/// Whether all corners are on one side of each triangle, up to what rounding made of those in its plane.
pub fn is_convex(mesh: &Mesh) -> bool {
    // A cross product of differences and a product with a third, 8 half-ulps, of coordinates that were mapped
    // by 4 more.
    let within = 16.0 * f64::EPSILON * Bounds::around(mesh.points.iter().copied()).farthest().max_element();
    let is_small = mesh.points.len().saturating_mul(mesh.triangles.len()) <= 100 * MOST_SUMS;
    is_small
        && mesh.triangles.iter().all(|triangle| {
            let [a, b, c] = triangle.map(|i| mesh.points[i as usize]);
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { return true };
            let heights = mesh.points.iter().map(|&p| normal.dot(p - a));
            let (low, high) =
                heights.fold((0.0_f64, 0.0_f64), |(low, high), height| (low.min(height), high.max(height)));
            low >= -within || high <= within
        })
}

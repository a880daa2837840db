//! Minkowski sums: every point of one added to every point of the other.

use super::carved::{NotCarved, sum_of_hollows};
use super::clip::covered;
use super::convex_hull::{hull, outline};
use super::figure::Figure;
use super::of_mesh::of_mesh;
use super::work::{TooMuchWork, WorkLeft};
use crate::math::{Bounds, DVec2, DVec3};
use crate::scene::triangulation::{EarClipper, triangulate_rings};
use crate::scene::{Mesh, Shape, Solid};

/// The sum of two figures. A step of work is a sum of two corners.
pub fn sum_of_figures(
    a: &Figure,
    b: &Figure,
    clipper: &mut EarClipper,
    work: &mut WorkLeft,
) -> Result<Figure, TooMuchWork> {
    let (parts, others) = (convex_parts(a, clipper), convex_parts(b, clipper));
    let size = |parts: &[Vec<DVec2>]| parts.iter().map(Vec::len).sum::<usize>();
    work.spend(size(&parts).saturating_mul(size(&others)))?;
    let sums = parts.iter().flat_map(|part| {
        others.iter().filter_map(|other| {
            outline(part.iter().flat_map(|&p| other.iter().map(move |&q| p + q)).collect())
        })
    });
    let figure = covered(&sums.collect::<Vec<_>>());
    Ok(Figure { error: figure.error + a.error + b.error, ..figure })
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
    /// There is no surface of one of the two, or none of two of their parts that are not convex.
    NotWorkedOut,
    /// It would take too long.
    TooMuch,
}

impl From<TooMuchWork> for NoSum {
    fn from(TooMuchWork: TooMuchWork) -> Self {
        Self::TooMuch
    }
}

impl From<NotCarved> for NoSum {
    fn from(why: NotCarved) -> Self {
        match why {
            NotCarved::TooMuch => Self::TooMuch,
            NotCarved::Failed => Self::NotWorkedOut,
        }
    }
}

/// The sum of two unions of meshes. A step of work is a sum of two corners.
pub fn sum_of_solids(a: &Solid, b: &Solid, work: &mut WorkLeft) -> Result<Solid, NoSum> {
    let (parts, others) = (parts(a, work)?, parts(b, work)?);
    let size = |parts: &[Part]| parts.iter().map(|part| part.mesh.points.len()).sum::<usize>();
    work.spend(size(&parts).saturating_mul(size(&others)))?;
    let mut sums = Vec::new();
    for part in &parts {
        for other in &others {
            match (part.is_convex, other.is_convex) {
                (true, true) => sums.extend(sum(&part.mesh.points, &other.mesh.points)),
                (false, true) => hollow(part, other, &mut sums, work)?,
                (true, false) => hollow(other, part, &mut sums, work)?,
                (false, false) => sums.push(sum_of_hollows(&part.mesh, &other.mesh, work)?),
            }
        }
    }
    let error = largest_error(a) + largest_error(b);
    let solid = |mesh: Mesh| Solid::Primitive(of_mesh(mesh).with_map_error(error));
    Ok(Solid::Union(sums.into_iter().map(solid).collect()))
}

/// How far the corners of a solid may be off their places.
fn largest_error(solid: &Solid) -> DVec3 {
    let mut error = DVec3::ZERO;
    solid.visit(&mut |primitive| error = error.max(primitive.map_error()));
    error
}

fn sum(points: &[DVec3], others: &[DVec3]) -> Option<Mesh> {
    hull(points.iter().flat_map(|&p| others.iter().map(move |&q| p + q)).collect())
}

/// The sum of a part that is not convex and one that is: that of its surface, triangle by triangle, and what
/// is within, which is in the part moved to any one point of the other.
fn hollow(part: &Part, convex: &Part, sums: &mut Vec<Mesh>, work: &mut WorkLeft) -> Result<(), TooMuchWork> {
    // Three sums for each corner of the convex part, of which most end up in a hull of their own.
    work.spend(part.mesh.triangles.len().saturating_mul(9 * convex.mesh.points.len()))?;
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
fn parts(solid: &Solid, work: &mut WorkLeft) -> Result<Vec<Part>, NoSum> {
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
        return Err(NoSum::NotWorkedOut);
    }
    let part = |mesh: Mesh| {
        // Each corner is held against each triangle, which is quick.
        work.spend(mesh.points.len().saturating_mul(mesh.triangles.len()) / 200)?;
        Ok(Part { is_convex: is_convex(&mesh), mesh })
    };
    meshes.into_iter().map(part).collect()
}

/// More pairs of a corner and a triangle are not looked at.
const MOST_HELD: usize = 100_000_000;

/// Whether all corners are on one side of each triangle, up to what rounding made of those in its plane.
pub fn is_convex(mesh: &Mesh) -> bool {
    // A cross product of differences and a product with a third, 8 half-ulps, of coordinates that were mapped
    // by 4 more.
    let within = 16.0 * f64::EPSILON * Bounds::around(mesh.points.iter().copied()).farthest().max_element();
    let is_small = mesh.points.len().saturating_mul(mesh.triangles.len()) <= MOST_HELD;
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

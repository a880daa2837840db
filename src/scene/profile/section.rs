//! Figures of solids: what the plane z = 0 cuts of them, and the shadow that they cast on it.

use super::clip::{Tangled, combined, covered, filled};
use super::convex_hull::outline;
use super::figure::{Figure, FigureOperator};
use super::sums::is_convex;
use super::work::{TooMuchWork, WorkLeft};
use crate::math::{DVec2, DVec3};
use crate::scene::{Mesh, Primitive, Shape, Solid};

/// Steps that a triangle takes until it is part of a shadow.
const OF_OUTLINE: usize = 200;

/// What the plane z = 0 cuts of a solid of meshes.
pub fn section(solid: &Solid) -> Result<Figure, Tangled> {
    solid.fold(&mut |primitive| filled(&cut(primitive), 0.0), &mut |solid, parts| {
        let figures = parts.collect::<Result<Vec<_>, _>>()?;
        combined(
            match solid {
                Solid::Difference(_) => FigureOperator::Difference,
                Solid::Intersection(_) => FigureOperator::Intersection,
                Solid::Union(_) | Solid::Primitive(_) => FigureOperator::Union,
            },
            &figures,
        )
    })
}

fn placed(primitive: &Primitive) -> Option<Mesh> {
    let Shape::Mesh(mesh) = &primitive.shape else { return None };
    let points = mesh.points.iter().map(|&p| primitive.map.transform_point3(p)).collect();
    Some(Mesh { points, triangles: mesh.triangles.clone() })
}

/// The ways round in which a mesh crosses the plane z = 0. A corner in the plane counts as below it.
fn cut(primitive: &Primitive) -> Vec<Vec<DVec2>> {
    let Some(mesh) = placed(primitive) else { return Vec::new() };
    let is_above = |corner: u32| mesh.points[corner as usize].z > 0.0;
    // By edge that crosses the plane: the edges to which triangles lead on from it.
    let mut next = std::collections::BTreeMap::<[u32; 2], Vec<[u32; 2]>>::new();
    for &[a, b, c] in &mesh.triangles {
        let crossed: Vec<[u32; 2]> = [[a, b], [b, c], [c, a]]
            .into_iter()
            .filter(|&[a, b]| is_above(a) != is_above(b))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        if let [from, to] = crossed[..] {
            next.entry(from).or_default().push(to);
            next.entry(to).or_default().push(from);
        }
    }
    let place = |[a, b]: [u32; 2]| {
        let [a, b]: [DVec3; 2] = [a, b].map(|corner| mesh.points[corner as usize]);
        a.truncate() + (b - a).truncate() * (a.z / (a.z - b.z))
    };
    let mut ways = Vec::new();
    // Every edge has an even number of triangles, so that each way leads back to where it began.
    while let Some((&start, _)) = next.first_key_value() {
        let (mut way, mut at) = (Vec::new(), start);
        while let Some(ends) = next.get_mut(&at) {
            let to = ends.pop();
            if ends.is_empty() {
                next.remove(&at);
            }
            let Some(to) = to else { break };
            if let Some(back) = next.get_mut(&to) {
                if let Some(index) = back.iter().position(|&edge| edge == at) {
                    back.swap_remove(index);
                }
                if back.is_empty() {
                    next.remove(&to);
                }
            }
            way.push(place(to));
            at = to;
        }
        if way.len() >= 3 {
            ways.push(way);
        }
    }
    ways
}

/// The shadow of a union of meshes, along z.
pub fn shadow(solid: &Solid, work: &mut WorkLeft) -> Result<Figure, TooMuchWork> {
    let (mut outlines, mut error) = (Vec::new(), 0.0_f64);
    solid.visit(&mut |primitive| {
        let Some(mesh) = placed(primitive) else { return };
        error = error.max(primitive.map_error().truncate().length());
        let flat: Vec<DVec2> = mesh.points.iter().map(|p| p.truncate()).collect();
        if is_convex(&mesh) {
            outlines.extend(outline(flat));
        } else {
            let corners = |triangle: &[u32; 3]| triangle.map(|i| flat[i as usize]).to_vec();
            outlines.extend(mesh.triangles.iter().filter_map(|triangle| outline(corners(triangle))));
        }
    });
    work.spend(outlines.len().saturating_mul(OF_OUTLINE))?;
    let figure = covered(&outlines);
    Ok(Figure { error: figure.error + error, ..figure })
}

//! What is cut, and what several have in common, as meshes: for what is made of a surface that no primitive
//! has.

use std::panic::{AssertUnwindSafe, catch_unwind};

use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGL64, OpType};

use super::of_mesh::of_mesh;
use super::orientation::oriented;
use super::work::{TooMuchWork, WorkLeft};
use crate::math::{Bounds, DVec3};
use crate::scene::{Mesh, Primitive, Shape, Solid};

/// The library makes corners one that are nearer than this share of the size of what it works on, and its own
/// arithmetic is off by far less.
const MERGED: f64 = 1e-12;

/// Why a solid has no surface of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotCarved {
    /// It would take too long.
    TooMuch,
    /// A mesh has no inside and outside, or the library has failed.
    Failed,
}

impl From<TooMuchWork> for NotCarved {
    fn from(TooMuchWork: TooMuchWork) -> Self {
        Self::TooMuch
    }
}

/// A solid of meshes as a union of meshes only.
pub fn united_meshes(solid: &Solid, work: &mut WorkLeft) -> Result<Solid, NotCarved> {
    let mut is_union = true;
    let mut bounds = Bounds::EMPTY;
    solid.fold(
        &mut |primitive| bounds = bounds.join(&primitive.shape.bounds().mapped(&primitive.map)),
        &mut |solid, _| is_union &= matches!(solid, Solid::Union(_)),
    );
    if is_union {
        return Ok(solid.clone());
    }
    let size = bounds.farthest().max_element();
    if !(size > 0.0 && size.is_finite()) {
        return Ok(Solid::Union(Vec::new()));
    }
    // By a power of two, so that no product of coordinates over- or underflows.
    let scale = libm::ldexp(1.0, -libm::ilogb(size).clamp(-1000, 1000));
    // A fault of the library is one of this solid alone.
    let parts =
        catch_unwind(AssertUnwindSafe(|| carve(solid, scale, work))).unwrap_or(Err(NotCarved::Failed))?;
    let error = DVec3::splat(2.0 * MERGED * size);
    let meshes = parts.into_iter().filter_map(|part| match part {
        Part::Own(primitive) => Some(Solid::Primitive(primitive.clone())),
        Part::Carved(carved) => {
            let mesh = mesh_of(&carved.manifold, scale);
            let primitive = of_mesh(mesh).with_map_error(error);
            (!carved.manifold.is_empty()).then_some(Solid::Primitive(primitive))
        }
    });
    Ok(Solid::Union(meshes.collect()))
}

/// A part of a union.
enum Part<'s> {
    /// A primitive as it was.
    Own(&'s Primitive),
    Carved(Box<Body>),
}

/// A solid as the library has it.
struct Body {
    manifold: Manifold,
    /// Whether each edge belongs to two triangles: the library is quicker with those by far.
    is_paired: bool,
}

/// Steps that a triangle takes where edges are paired: 25 cylinders that were cut from 4,272 triangles took
/// 5.6 s, 22 µs for each triangle of both operands; and where they are not, by the ratio that was seen.
const OF_PAIRED: usize = 20;
const OF_UNPAIRED: usize = 200;

fn carve<'s>(solid: &'s Solid, scale: f64, work: &mut WorkLeft) -> Result<Vec<Part<'s>>, NotCarved> {
    solid.fold(&mut |primitive| Ok(vec![Part::Own(primitive)]), &mut |solid, operands| {
        let operands = operands.collect::<Result<Vec<_>, _>>()?;
        let operator = match solid {
            Solid::Union(_) | Solid::Primitive(_) => return Ok(operands.into_iter().flatten().collect()),
            Solid::Difference(_) => OpType::Subtract,
            Solid::Intersection(_) => OpType::Intersect,
        };
        let mut operands = operands.into_iter();
        let first = whole(operands.next().unwrap_or_default(), scale, work)?;
        let carved = operands.try_fold(first, |carved, operand| match operator {
            // What is cut away may as well be cut away part by part.
            OpType::Subtract => operand.into_iter().try_fold(carved, |carved, part| {
                joined(&carved, &body(part, scale)?, OpType::Subtract, work)
            }),
            _ => joined(&carved, &whole(operand, scale, work)?, OpType::Intersect, work),
        })?;
        Ok(vec![Part::Carved(Box::new(carved))])
    })
}

/// The union of parts.
fn whole(parts: Vec<Part<'_>>, scale: f64, work: &mut WorkLeft) -> Result<Body, NotCarved> {
    let mut parts = parts.into_iter();
    let Some(first) = parts.next() else {
        return Ok(Body { manifold: Manifold::empty(), is_paired: true });
    };
    let first = body(first, scale)?;
    parts.try_fold(first, |all, part| joined(&all, &body(part, scale)?, OpType::Add, work))
}

fn joined(a: &Body, b: &Body, operator: OpType, work: &mut WorkLeft) -> Result<Body, NotCarved> {
    let is_paired = a.is_paired && b.is_paired;
    let (engine, times) =
        if is_paired { (BooleanEngine::Exact, OF_PAIRED) } else { (BooleanEngine::Robust, OF_UNPAIRED) };
    work.spend((a.manifold.num_tri() + b.manifold.num_tri()).saturating_mul(times))?;
    let manifold = a.manifold.boolean_with_engine(&b.manifold, operator, engine);
    if manifold.status() == Error::NoError {
        Ok(Body { manifold, is_paired })
    } else {
        Err(NotCarved::Failed)
    }
}

fn body(part: Part<'_>, scale: f64) -> Result<Body, NotCarved> {
    let primitive = match part {
        Part::Carved(carved) => return Ok(*carved),
        Part::Own(primitive) => primitive,
    };
    let Shape::Mesh(mesh) = &primitive.shape else { return Err(NotCarved::Failed) };
    let points: Vec<DVec3> = mesh.points.iter().map(|&p| primitive.map.transform_point3(p) * scale).collect();
    let triangles = oriented(&points, &mesh.triangles).ok_or(NotCarved::Failed)?;
    let given = MeshGL64 {
        num_prop: 3,
        vert_properties: points.iter().flat_map(DVec3::to_array).collect(),
        tri_verts: triangles.into_iter().flatten().map(u64::from).collect(),
        ..MeshGL64::default()
    };
    let manifold = Manifold::from_mesh_gl64(&given);
    if manifold.status() == Error::NoError {
        return Ok(Body { manifold, is_paired: true });
    }
    let manifold = Manifold::from_mesh_gl64_robust(&given);
    if manifold.status() == Error::NoError {
        Ok(Body { manifold, is_paired: false })
    } else {
        Err(NotCarved::Failed)
    }
}

fn mesh_of(manifold: &Manifold, scale: f64) -> Mesh {
    let given = manifold.get_mesh_gl64(-1);
    let step = given.num_prop.max(3) as usize;
    // Where corners are told apart by what the library keeps with them, they are one to it all the same.
    let mut merged: Vec<u32> = (0..(given.vert_properties.len() / step) as u32).collect();
    for (&from, &to) in given.merge_from_vert.iter().zip(&given.merge_to_vert) {
        merged[from as usize] = to as u32;
    }
    let place = |p: &[f64]| DVec3::new(p[0], p[1], p[2]) / scale + DVec3::ZERO;
    let points = given.vert_properties.chunks_exact(step).map(place).collect();
    let corner = |&index: &u64| merged[index as usize];
    let triangles = given
        .tri_verts
        .chunks_exact(3)
        .map(|triangle| [corner(&triangle[0]), corner(&triangle[1]), corner(&triangle[2])])
        .collect();
    Mesh { points, triangles }
}

/// Steps that the sum of two triangles takes: a hull, and its place among all the others.
const OF_PAIR: usize = 3000;

/// The sum of two meshes of which neither need be convex.
pub fn sum_of_hollows(a: &Mesh, b: &Mesh, work: &mut WorkLeft) -> Result<Mesh, NotCarved> {
    work.spend(a.triangles.len().saturating_mul(b.triangles.len()).saturating_mul(OF_PAIR))?;
    let size = Bounds::around(a.points.iter().chain(&b.points).copied()).farthest().max_element();
    if !(size > 0.0 && size.is_finite()) {
        return Err(NotCarved::Failed);
    }
    let scale = libm::ldexp(1.0, -libm::ilogb(size).clamp(-1000, 1000));
    let of = |mesh: &Mesh| body(Part::Own(&of_mesh(mesh.clone())), scale);
    let sum = || Ok(of(a)?.manifold.minkowski_sum(&of(b)?.manifold));
    let sum: Manifold = catch_unwind(AssertUnwindSafe(sum)).unwrap_or(Err(NotCarved::Failed))?;
    if sum.status() == Error::NoError { Ok(mesh_of(&sum, scale)) } else { Err(NotCarved::Failed) }
}

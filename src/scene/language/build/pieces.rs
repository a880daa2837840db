//! Facets that wait for what is made of them.

use crate::math::{DAffine3, DMat3, DVec3};
use crate::scene::profile::Figure;
use crate::scene::{Primitive, Solid};

/// A figure or a solid, as facets.
#[derive(Clone, Debug)]
pub enum Piece {
    Figure(Figure),
    /// An expression of meshes.
    Solid(Solid),
}

/// What a call without children, or one that makes something of them, is.
#[derive(Clone, Debug)]
pub enum Made {
    Solid(Solid),
    Piece(Piece),
}

impl Piece {
    pub fn is_figure(&self) -> bool {
        matches!(self, Self::Figure(_))
    }

    /// The piece under a map; none where that makes it flat.
    pub fn mapped(self, map: &DAffine3) -> Option<Self> {
        match self {
            Self::Figure(figure) => figure.mapped(map).map(Self::Figure),
            Self::Solid(solid) => {
                Some(Self::Solid(rebuilt(&solid, |primitive| moved(primitive, map, DVec3::ZERO))))
            }
        }
    }
}

/// A primitive under a map, which may be off by `error` itself.
pub fn moved(primitive: &Primitive, map: &DAffine3, error: DVec3) -> Primitive {
    let error = error + carried(&map.matrix3, primitive.map_error());
    Primitive::new(primitive.shape.clone(), *map * primitive.map, primitive.material).with_map_error(error)
}

/// How far along each axis a step of at most `error` along each axis leads under a map.
pub fn carried(linear: &DMat3, error: DVec3) -> DVec3 {
    linear.x_axis.abs() * error.x + linear.y_axis.abs() * error.y + linear.z_axis.abs() * error.z
}

/// A solid with other primitives.
pub fn rebuilt(solid: &Solid, mut leaf: impl FnMut(&Primitive) -> Primitive) -> Solid {
    solid.fold(&mut |primitive| Solid::Primitive(leaf(primitive)), &mut |solid, parts| match solid {
        Solid::Difference(_) => Solid::Difference(parts.collect()),
        Solid::Intersection(_) => Solid::Intersection(parts.collect()),
        Solid::Union(_) | Solid::Primitive(_) => united(parts.collect()),
    })
}

/// A union, of one alone that itself.
pub fn united(mut solids: Vec<Solid>) -> Solid {
    match solids.pop() {
        Some(last) if solids.is_empty() => last,
        Some(last) => {
            solids.push(last);
            Solid::Union(solids)
        }
        None => Solid::Union(solids),
    }
}

/// The corners of all meshes of a solid.
pub fn corners(solid: &Solid) -> Vec<DVec3> {
    let mut points = Vec::new();
    solid.visit(&mut |primitive| {
        if let crate::scene::Shape::Mesh(mesh) = &primitive.shape {
            points.extend(mesh.points.iter().map(|&p| primitive.map.transform_point3(p)));
        }
    });
    points
}

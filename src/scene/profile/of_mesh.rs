//! A mesh as a primitive.

use std::sync::Arc;

use crate::math::{DAffine3, DVec3};
use crate::scene::{MaterialId, Mesh, Primitive, Shape};

/// A mesh as a primitive of no material in particular.
pub fn of_mesh(mesh: Mesh) -> Primitive {
    Primitive::new(Shape::Mesh(Arc::new(mesh)), DAffine3::IDENTITY, MaterialId(0)).with_map_error(DVec3::ZERO)
}

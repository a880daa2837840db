//! Triangles that share corners.

use crate::math::DVec3;

/// A surface of triangles. That of a [`super::Shape::Mesh`] is closed: every edge is shared by an even number
/// of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Corner points, in the mesh's own coordinates.
    pub points: Vec<DVec3>,
    /// Three indices into `points` each; either order of turning. No triangle names a point twice.
    pub triangles: Vec<[u32; 3]>,
}

//! What one ray meets.

use crate::math::DVec3;
use crate::solid::Crossing;

/// The first surface that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the ray's start, in the assembly's unit.
    pub t: f64,
    /// The exact distance lies within `t ± error`.
    pub error: f64,
    /// Where it is, in the assembly's coordinates: as near to the surface as numbers can say, from however
    /// far away the ray comes.
    pub p: DVec3,
    /// The object's index in the assembly.
    pub object: u32,
    /// The primitive's index in the assembly.
    pub primitive: u32,
    /// The face of the primitive.
    pub surface: u32,
    /// Whether the ray goes into the object; false where it started inside.
    pub entering: bool,
}

impl Hit {
    /// The same as a crossing of its object.
    pub fn crossing(&self) -> Crossing {
        let Self { t, error, primitive, surface, entering, .. } = *self;
        Crossing { t, error, primitive, surface, entering }
    }
}

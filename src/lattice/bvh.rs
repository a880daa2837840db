//! The hierarchy of boxes around the objects of a scene.

use crate::bvh::{BuildPrimitive, Bvh8};
use crate::math::DVec3;
use crate::solid::Assembly;

use super::bounding_sphere::BoundingSphere;
use super::planes::slack;

impl Bvh8 {
    /// Parts the objects of an assembly. Their boxes are padded by [`slack`], so that no ray that meets an
    /// object by its own computation misses the object's box by rounding.
    pub fn new(assembly: &Assembly) -> Self {
        let margin = DVec3::splat(slack(assembly.place_error));
        let objects = &assembly.objects;
        Self::over(objects.len(), |object| {
            let reach = BuildPrimitive::new(&objects[object].bounds.padded(margin), object as u32);
            if BoundingSphere::is_in(&reach, assembly) { reach.round() } else { reach }
        })
    }
}

//! A surface that a ray met, and how it lies to the ray.

use crate::math::{DVec3, Ray};
use crate::solid::Assembly;
use crate::trace::Hit;

/// A surface that a ray met, and how it lies to the ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceInteraction {
    pub hit: Hit,
    pub p: DVec3,
    /// Turned to the side that the ray comes from, length 1.
    pub normal: DVec3,
}

/// A surface that a ray from the eye met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrimaryHit {
    /// Distance from the eye, in the assembly's unit.
    pub t: f64,
    /// The object's index in the assembly.
    pub object: u32,
    /// The normal, turned to the eye's side, length 1.
    pub normal: DVec3,
}

impl SurfaceInteraction {
    /// The surface at a hit of `ray`.
    pub fn new(assembly: &Assembly, ray: &Ray, hit: Hit) -> Self {
        let normal = assembly.turned_normal(hit.primitive, hit.surface, hit.p, ray.d);
        Self { hit, p: hit.p, normal }
    }

    /// The same for a ray from the eye.
    #[inline]
    pub fn primary(&self) -> PrimaryHit {
        PrimaryHit { t: self.hit.t, object: self.hit.object, normal: self.normal }
    }
}

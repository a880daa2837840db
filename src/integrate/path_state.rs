//! A ray on its way, with what it carries along its path.

use crate::math::Ray;
use crate::shade::{MediumStack, Scattered, SurfaceInteraction};

/// A ray on its way.
#[derive(Clone, Debug)]
pub(super) struct PathState {
    pub ray: Ray,
    /// The length of the path from the eye to its start, in the assembly's unit.
    pub travelled: f64,
    /// The share of its light that reaches the eye.
    pub weight: f64,
    /// 0 for a ray from the eye.
    pub generation: u32,
    /// The glass it starts in.
    pub inside: MediumStack,
}

impl PathState {
    /// A ray from the eye, which is in this glass.
    #[inline]
    pub fn primary(ray: Ray, inside: MediumStack) -> Self {
        Self { ray, travelled: 0.0, weight: 1.0, generation: 0, inside }
    }

    /// A ray that the surface which this one met sends on.
    #[inline]
    pub fn scattered(&self, met: &SurfaceInteraction, onward: Scattered, inside: MediumStack) -> Self {
        Self {
            ray: Ray::new(met.p, onward.d),
            travelled: self.travelled + met.hit.t,
            weight: self.weight * onward.share,
            generation: self.generation + 1,
            inside,
        }
    }
}

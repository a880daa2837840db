//! The rays that a surface sends on: eq. (4) (Whitted: An improved illumination model for shaded display,
//! CACM 1980).

use crate::math::DVec3;

use super::direction::{mirrored, refracted};
use super::material::ResolvedMaterial;

/// A ray that a surface sends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    /// Of length 1.
    pub d: DVec3,
    /// The share of its light that the surface sends back, above 0.
    pub share: f64,
}

/// The rays that a surface sends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScatteredRays {
    pub mirror: Option<Scattered>,
    pub snell: Option<Scattered>,
}

impl ScatteredRays {
    /// `before` and `behind` are the indices of refraction on the two sides.
    #[inline]
    pub fn new<C>(d: DVec3, normal: DVec3, material: &ResolvedMaterial<C>, before: f64, behind: f64) -> Self {
        let some = |d, share| (share > 0.0).then_some(Scattered { d, share });
        let (kr, kt) = (material.kr, material.kt);
        match (kt > 0.0).then(|| refracted(d, normal, before, behind)) {
            // Total internal reflection: what can not go out goes the way of the mirror ray.
            Some(None) => Self { mirror: some(mirrored(d, normal), kr + kt), snell: None },
            Some(Some(through)) => Self { mirror: some(mirrored(d, normal), kr), snell: some(through, kt) },
            None => Self { mirror: some(mirrored(d, normal), kr), snell: None },
        }
    }
}

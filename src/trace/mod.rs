//! Stages 4 to 8, driven: rays in, hits out. An engine answers what a ray meets first ([`Engine::first`],
//! [`Engine::next`]) and whether light comes through ([`Engine::blocked`]); [`Exact`] is the reference.

mod exact;

pub use exact::{Exact, Memory};

use crate::math::Ray;
use crate::solid::Departure;
use crate::stage::{Meter, Probe};

/// The first surface on a ray's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the ray's start, in the assembly's unit.
    pub t: f64,
    /// The object's index in the assembly.
    pub object: u32,
    /// The primitive's index in the assembly.
    pub primitive: u32,
    /// The face of the primitive.
    pub surface: u32,
    /// Whether the ray goes into the object; false where it started inside.
    pub entering: bool,
}

/// Finds hits. Every engine gives the same ones, whatever structure it uses.
pub trait Engine {
    /// Memory of one worker, used again for every ray.
    type Memory;

    /// New memory for a worker.
    fn memory(&self) -> Self::Memory;

    /// The first hit of a ray from the eye, which may start far outside the world.
    fn first(&self, ray: &Ray, memory: &mut Self::Memory, meter: &mut Meter<impl Probe>) -> Option<Hit>;

    /// The first hit of a ray that leaves a surface of the world.
    fn next(
        &self,
        ray: &Ray,
        departure: Departure,
        memory: &mut Self::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Hit>;

    /// Whether anything stands between a surface and a light at `distance`.
    fn blocked(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Self::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> bool;
}

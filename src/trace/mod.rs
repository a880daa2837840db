//! Stages 4 to 8, driven: rays in, hits out. A [`RayEngine`] answers what a ray meets first
//! ([`RayEngine::first`], [`RayEngine::next`]) and whether light comes through ([`RayEngine::blocked`]);
//! [`Exact`] is the reference. [`Fast`] answers the same for packets of rays, and hands out the exact engine
//! for those that it leaves a doubt of.

mod exact;
mod fast;

pub use exact::{Exact, Memory};
pub use fast::{
    Fast, OpacityClass, PacketHits, PrimaryPackets, ShadowPacket, ShadowQuery, TileMemory, Transmittance,
};

use crate::math::{DVec3, Ray};
use crate::solid::{Crossing, Departure};
use crate::stage::{Meter, Probe};

/// The first surface on a ray's way.
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

/// Finds the hits of one ray after the other. Every engine gives the same ones, whatever structure it uses.
pub trait RayEngine {
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

    /// All surfaces that lie where the last hit does, within their errors and one per object, in no order;
    /// the hit is one of them. To be asked before the memory is used for another ray: empty if the last one
    /// met nothing.
    fn together<'m>(&self, memory: &'m Self::Memory) -> &'m [(u32, Crossing)];

    /// Calls `visit` with what a ray that leaves a surface first meets of each object in its way, as far as
    /// that may lie before `distance`, in no order, until it says yes. Answers whether it did.
    fn meets(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Self::Memory,
        meter: &mut Meter<impl Probe>,
        visit: &mut dyn FnMut(u32, &Crossing) -> bool,
    ) -> bool;

    /// What a ray that leaves a surface first meets of one object, as far as that may lie before `distance`.
    fn of_object(
        &self,
        object: u32,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Self::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Crossing>;

    /// Whether anything stands between a surface and a light at `distance`.
    fn blocked(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Self::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        let blocks = &mut |_, crossing: &Crossing| crossing.is_before(distance);
        self.meets(ray, departure, distance, memory, meter, blocks)
    }
}

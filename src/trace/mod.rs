//! Stages 4 to 8, driven: rays in, hits out. A [`RayEngine`] answers what a ray meets first
//! ([`RayEngine::first`], [`RayEngine::next`]) and whether light comes through ([`RayEngine::blocked`]);
//! [`Exact`] is the reference. [`Fast`] answers the same for packets of rays, and hands out the exact engine
//! for rays that it is uncertain of.

mod exact;
mod fast;
mod hit;

pub use exact::{Exact, RayMemory};
pub use fast::{
    Fast, OpacityClass, PacketHits, PrimaryPackets, ShadowPacket, ShadowQuery, TileMemory, Transmittance,
};
pub use hit::Hit;

use crate::math::Ray;
use crate::solid::{Crossing, Departure};
use crate::stage::{Meter, Probe};

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
    /// the hit is one of them. To be called before the memory is used for another ray: empty if the last one
    /// met nothing.
    fn together<'m>(&self, memory: &'m Self::Memory) -> &'m [(u32, Crossing)];

    /// Calls `visit` with what a ray that leaves a surface first meets of each object, as far as that may lie
    /// before `distance`, in no order, until it says yes. Answers whether it did.
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

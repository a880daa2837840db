//! How a picture is lit tile by tile, whatever integrator does it.

use std::sync::OnceLock;

use crate::shade::PrimaryHit;
use crate::stage::{Meter, Probe};
use crate::view::TileCamera;

use super::history::History;
use super::tile_hits::TileHits;

/// Some rays through a tile.
#[derive(Clone, Copy, Debug)]
pub struct TilePass<'a> {
    /// The rays.
    pub camera: TileCamera<'a>,
    /// What they meet, or room for it: set by the same camera and the same solids. Absent where it is not
    /// kept.
    pub kept: Option<&'a OnceLock<TileHits>>,
    /// Whether anyone asks for [`TileIntegrator::histories`].
    pub keeps_histories: bool,
}

/// Finds the light of the dots of tiles, and what they see.
pub trait TileIntegrator<C>: Sync {
    /// Memory that a worker leaves to the next picture.
    type Scratch: Default + Send + 'static;
    /// Memory of one worker, used again for every tile.
    type Memory: Send;

    /// Memory for a worker.
    fn tile_memory(&self, scratch: Self::Scratch) -> Self::Memory;

    /// What of it serves the next picture.
    fn into_scratch(memory: Self::Memory) -> Self::Scratch;

    /// Sets `light`, which has a place for each ray in the order of [`TileCamera::points`]: the tile's scan order
    /// where each dot has one.
    fn shade(
        &self,
        pass: &TilePass,
        memory: &mut Self::Memory,
        light: &mut [C],
        meter: &mut Meter<impl Probe>,
    );

    /// Finds what the rays see, and no light.
    fn trace(&self, pass: &TilePass, memory: &mut Self::Memory, meter: &mut Meter<impl Probe>);

    /// Calls `each` with every ray's place in that order and what it saw in the last pass, which was this
    /// one.
    fn seen(&self, pass: &TilePass, memory: &Self::Memory, each: impl FnMut(usize, Option<PrimaryHit>));

    /// Calls `each` with every ray's place in that order and its history in the last pass, which was this
    /// one, found light and kept histories.
    fn histories(&self, pass: &TilePass, memory: &Self::Memory, each: impl FnMut(usize, History));
}

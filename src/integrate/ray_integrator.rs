//! The integrator that follows one ray after the other, and the memory of one of its workers.

use crate::plan::Plan;
use crate::scene::Scene;
use crate::shade::{Channel, Illumination, Media};
use crate::solid::{Assembly, Crossing};
use crate::trace::RayEngine;

use super::history::History;

/// Follows one ray after the other, with any engine for rays.
#[derive(Debug)]
pub struct RayIntegrator<'a, R, C> {
    pub(super) engine: &'a R,
    pub(super) illumination: Illumination<'a, C>,
    /// The last generation of rays that is followed; 0 for those from the eye.
    pub(super) generations: u32,
    /// A ray whose share of the light that reaches the eye is less is not followed.
    pub(super) least_weight: f64,
}

/// Memory of one worker that follows paths, with its engine's own.
#[derive(Debug)]
pub struct PathMemory<M> {
    pub(super) engine: M,
    pub(super) media: Media,
    /// The glass objects that the present shadow ray has gone through.
    pub(super) crossed: Vec<(u32, Crossing)>,
    /// That of the last ray whose light was found.
    pub(super) history: History,
}

impl<'a, R: RayEngine, C: Channel> RayIntegrator<'a, R, C> {
    /// One for a planned picture.
    pub fn new(scene: &Scene, assembly: &'a Assembly, plan: &Plan, engine: &'a R) -> Self {
        let secondary = plan.secondary.as_ref();
        Self {
            engine,
            illumination: Illumination::new(scene, assembly, plan),
            generations: secondary.map_or(0, |s| s.generations),
            least_weight: secondary.map_or(0.0, |s| s.least_weight),
        }
    }

    /// New memory for a worker.
    pub fn memory(&self) -> PathMemory<R::Memory> {
        PathMemory {
            engine: self.engine.memory(),
            media: Media::default(),
            crossed: Vec::new(),
            history: History::MISS,
        }
    }
}

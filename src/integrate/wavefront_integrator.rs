//! The integrator that lights tiles: all rays of one generation side by side.

use crate::plan::Plan;
use crate::scene::Scene;
use crate::shade::{Channel, Illumination};
use crate::solid::Assembly;
use crate::trace::{Exact, Fast};

use super::ray_integrator::RayIntegrator;

/// Lights tiles, all rays of one generation side by side.
#[derive(Debug)]
pub struct WavefrontIntegrator<'a, C> {
    pub(super) engine: &'a Fast<'a>,
    /// For rays of which packets are uncertain.
    pub(super) single: RayIntegrator<'a, Exact<'a>, C>,
}

impl<'a, C: Channel> WavefrontIntegrator<'a, C> {
    /// One for a planned picture.
    pub fn new(scene: &Scene, assembly: &'a Assembly, plan: &Plan, engine: &'a Fast<'a>) -> Self {
        Self { engine, single: RayIntegrator::new(scene, assembly, plan, engine.exact()) }
    }

    /// The picture's light.
    #[inline]
    pub(super) fn illumination(&self) -> &Illumination<'a, C> {
        &self.single.illumination
    }
}

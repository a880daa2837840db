//! A tile lit ray by ray.

use crate::math::Ray;
use crate::shade::{Channel, PrimaryHit};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::RayEngine;
use crate::view::{TileCamera, settled};

use super::history::History;
use super::ray_integrator::{PathMemory, RayIntegrator};
use super::tile_integrator::{TileIntegrator, TilePass};

/// What the rays of a tile saw, in their order.
#[derive(Debug, Default)]
pub struct SeenByRays {
    seen: Vec<Option<PrimaryHit>>,
    histories: Vec<History>,
}

/// Memory of one worker.
#[derive(Debug)]
pub struct RayTileMemory<M> {
    rays: PathMemory<M>,
    /// Of the last pass.
    last: SeenByRays,
}

impl<R, C: Channel> RayIntegrator<'_, R, C>
where
    R: RayEngine,
{
    /// The rays from the eye through a tile, in the order of [`TileCamera::points`].
    fn primary_rays<'r>(&self, camera: &'r TileCamera) -> impl Iterator<Item = Ray> + use<'r, '_, R, C> {
        let assembly = self.illumination.assembly;
        camera.points().map(move |[x, y]| {
            let ray = assembly.ray(&camera.pinhole.ray(x, y));
            Ray::new(ray.o, settled(ray.d, camera.longest_path))
        })
    }
}

impl<R, C: Channel> TileIntegrator<C> for RayIntegrator<'_, R, C>
where
    R: RayEngine<Memory: Send> + Sync,
{
    type Scratch = SeenByRays;
    type Memory = RayTileMemory<R::Memory>;

    fn tile_memory(&self, scratch: SeenByRays) -> Self::Memory {
        RayTileMemory { rays: self.memory(), last: scratch }
    }

    fn into_scratch(memory: Self::Memory) -> SeenByRays {
        memory.last
    }

    /// Traces all rays, whatever is kept: it is the reference.
    fn shade(
        &self,
        pass: &TilePass,
        memory: &mut Self::Memory,
        light: &mut [C],
        meter: &mut Meter<impl Probe>,
    ) {
        let RayTileMemory { rays: memory, last: SeenByRays { seen, histories } } = memory;
        seen.clear();
        histories.clear();
        meter.at(Stage::Ray);
        for (light, ray) in light.iter_mut().zip(self.primary_rays(&pass.camera)) {
            let view = self.view(&ray, memory, meter);
            meter.at(Stage::Ray);
            *light = view.light;
            seen.push(view.seen);
            histories.push(memory.history);
        }
    }

    fn trace(&self, pass: &TilePass, memory: &mut Self::Memory, meter: &mut Meter<impl Probe>) {
        let RayTileMemory { rays: memory, last: SeenByRays { seen, histories } } = memory;
        seen.clear();
        histories.clear();
        meter.at(Stage::Ray);
        for ray in self.primary_rays(&pass.camera) {
            let met = self.interaction(&ray, memory, meter);
            meter.at(Stage::Ray);
            seen.push(met.map(|met| met.primary()));
        }
    }

    fn seen(&self, _: &TilePass, memory: &Self::Memory, mut each: impl FnMut(usize, Option<PrimaryHit>)) {
        memory.last.seen.iter().enumerate().for_each(|(ray, seen)| each(ray, *seen));
    }

    fn histories(&self, _: &TilePass, memory: &Self::Memory, mut each: impl FnMut(usize, History)) {
        memory.last.histories.iter().enumerate().for_each(|(ray, history)| each(ray, *history));
    }
}

//! A tile lit ray by ray.

use crate::math::Ray;
use crate::shade::{Channel, PrimaryHit};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::RayEngine;
use crate::view::{TileCamera, settled};

use super::ray_integrator::{PathMemory, RayIntegrator};
use super::tile_integrator::{TileIntegrator, TilePass};

/// By dot of a tile in scan order: what it saw.
type SeenByDots = Vec<Option<PrimaryHit>>;

/// Memory of one worker.
#[derive(Debug)]
pub struct RayTileMemory<M> {
    rays: PathMemory<M>,
    /// Of the last pass.
    seen: SeenByDots,
}

impl<R, C: Channel> RayIntegrator<'_, R, C>
where
    R: RayEngine,
{
    /// The rays from the eye through a tile's dots, in scan order.
    fn primary_rays<'r>(&self, camera: &'r TileCamera) -> impl Iterator<Item = Ray> + use<'r, '_, R, C> {
        let assembly = self.illumination.assembly;
        camera.tile.dots().map(move |(i, j)| {
            let (x, y) = (f64::from(i) + 0.5 + camera.off[0], f64::from(j) + 0.5 + camera.off[1]);
            let ray = assembly.ray(&camera.pinhole.ray(x, y));
            Ray::new(ray.o, settled(ray.d, camera.longest_path))
        })
    }
}

impl<R, C: Channel> TileIntegrator<C> for RayIntegrator<'_, R, C>
where
    R: RayEngine<Memory: Send> + Sync,
{
    type Scratch = SeenByDots;
    type Memory = RayTileMemory<R::Memory>;

    fn tile_memory(&self, scratch: SeenByDots) -> Self::Memory {
        RayTileMemory { rays: self.memory(), seen: scratch }
    }

    fn into_scratch(memory: Self::Memory) -> SeenByDots {
        memory.seen
    }

    /// Traces all rays, whatever is kept: it is the reference.
    fn shade(
        &self,
        pass: &TilePass,
        memory: &mut Self::Memory,
        light: &mut [C],
        meter: &mut Meter<impl Probe>,
    ) {
        let RayTileMemory { rays: memory, seen } = memory;
        seen.clear();
        meter.at(Stage::Ray);
        for (light, ray) in light.iter_mut().zip(self.primary_rays(&pass.camera)) {
            let view = self.view(&ray, memory, meter);
            meter.at(Stage::Ray);
            *light = view.light;
            seen.push(view.seen);
        }
    }

    fn trace(&self, pass: &TilePass, memory: &mut Self::Memory, meter: &mut Meter<impl Probe>) {
        let RayTileMemory { rays: memory, seen } = memory;
        seen.clear();
        meter.at(Stage::Ray);
        for ray in self.primary_rays(&pass.camera) {
            let met = self.interaction(&ray, memory, meter);
            meter.at(Stage::Ray);
            seen.push(met.map(|met| met.primary()));
        }
    }

    fn seen(&self, _: &TilePass, memory: &Self::Memory, mut each: impl FnMut(usize, Option<PrimaryHit>)) {
        memory.seen.iter().enumerate().for_each(|(dot, seen)| each(dot, *seen));
    }
}

//! Tracing a picture point by point.

use crate::math::Ray;
use crate::shade::{Channel, Memory, Shader, View};
use crate::solid::Assembly;
use crate::stage::{Meter, Probe, Stage};
use crate::trace::Engine;
use crate::view::{PinholeCamera, Tile, settled};

use super::gather::TileDots;

/// Fills the dots of tiles.
pub(super) trait Tracer<C>: Sync {
    /// Memory of one worker, used again for every tile.
    type Memory: Send;

    /// Memory for a worker.
    fn memory(&self) -> Self::Memory;

    /// Takes the memory of a worker back when all is drawn.
    fn give_back(&self, _: Self::Memory) {}

    /// Fills all dots of a tile.
    fn tile(
        &self,
        tile: &Tile,
        memory: &mut Self::Memory,
        dots: &mut TileDots<C>,
        meter: &mut Meter<impl Probe>,
    );
}

/// Traces ray by ray, with any engine.
pub(super) struct Points<'a, 'b, E, C> {
    pub assembly: &'a Assembly,
    pub shader: &'a Shader<'b, E, C>,
    pub pinhole: &'a PinholeCamera,
    /// To the farthest point of the world, in the assembly's unit.
    pub way: f64,
    pub samples: u32,
}

impl<E, C: Channel> Tracer<C> for Points<'_, '_, E, C>
where
    E: Engine<Memory: Send> + Sync,
{
    type Memory = Memory<E>;

    fn memory(&self) -> Memory<E> {
        self.shader.memory()
    }

    fn tile(
        &self,
        tile: &Tile,
        memory: &mut Memory<E>,
        dots: &mut TileDots<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        for (place, (i, j)) in tile.dots().enumerate() {
            let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
            let middle = self.sample(x, y, memory, meter);
            dots.light[place] = if self.samples == 1 {
                middle.light
            } else {
                let step = 1.0 / f64::from(self.samples);
                let mut sum = C::DARK;
                for (a, b) in (0..self.samples).flat_map(|b| (0..self.samples).map(move |a| (a, b))) {
                    let inside = |k: u32| (f64::from(k) + 0.5) * step - 0.5;
                    sum = sum + self.sample(x + inside(a), y + inside(b), memory, meter).light;
                }
                sum * (step * step)
            };
            dots.see(place, middle.seen, self.assembly);
        }
    }
}

impl<E: Engine, C: Channel> Points<'_, '_, E, C> {
    fn sample(&self, x: f64, y: f64, memory: &mut Memory<E>, meter: &mut Meter<impl Probe>) -> View<C> {
        meter.at(Stage::Ray);
        let ray = self.assembly.ray(&self.pinhole.ray(x, y));
        let ray = Ray::new(ray.o, settled(ray.d, self.way));
        let view = self.shader.view(&ray, memory, meter);
        meter.at(Stage::Ray);
        view
    }
}

//! A tile lit generation by generation.
//!
//! All rays of one generation are traced before any is shaded ([`super::direct`]); then those that are sent
//! on ([`super::scattering`]) are the next generation. When there are no more, the light that arrives goes
//! the same way back. Only a ray that must tell two surfaces in one place apart is followed by itself.

use crate::math::{LANES, RayIndex};
use crate::shade::{Channel, PrimaryHit};
use crate::stage::{Meter, Probe};

use super::goal::Goal;
use super::history::History;
use super::tile_integrator::{TileIntegrator, TilePass};
use super::wavefront_integrator::WavefrontIntegrator;
use super::wavefront_scratch::{WavefrontMemory, WavefrontScratch};

impl<C: Channel + 'static> TileIntegrator<C> for WavefrontIntegrator<'_, C> {
    type Scratch = WavefrontScratch<C>;
    type Memory = WavefrontMemory<C>;

    fn tile_memory(&self, scratch: WavefrontScratch<C>) -> WavefrontMemory<C> {
        WavefrontMemory { single: self.single.memory(), tile: scratch }
    }

    fn into_scratch(memory: WavefrontMemory<C>) -> WavefrontScratch<C> {
        memory.tile
    }

    fn shade(
        &self,
        pass: &TilePass,
        memory: &mut WavefrontMemory<C>,
        light: &mut [C],
        meter: &mut Meter<impl Probe>,
    ) {
        memory.tile.keeps_histories = pass.keeps_histories;
        self.find_primary_hits(pass, Goal::Light, memory, meter);
        self.shade_generation(0, memory, meter);
        let mut last = 0;
        while self.scatter(last, memory, meter) {
            last += 1;
            self.trace_generation(last, memory, meter);
            self.shade_generation(last, memory, meter);
        }
        for generation in (1..=last).rev() {
            self.arrive(generation, &mut memory.tile);
        }
        meter.counts += std::mem::take(memory.tile.trace.counts_mut());
        let (camera, first) = (&pass.camera, &memory.tile.waves[0]);
        for packet in 0..camera.packets() {
            camera.rows(packet, |row, rays| copy_row(first.row_of_light(packet, row), &mut light[rays]));
        }
    }

    fn trace(&self, pass: &TilePass, memory: &mut WavefrontMemory<C>, meter: &mut Meter<impl Probe>) {
        memory.tile.keeps_histories = false;
        self.find_primary_hits(pass, Goal::Surfaces, memory, meter);
        meter.counts += std::mem::take(memory.tile.trace.counts_mut());
    }

    fn seen(
        &self,
        pass: &TilePass,
        memory: &WavefrontMemory<C>,
        mut each: impl FnMut(usize, Option<PrimaryHit>),
    ) {
        let (camera, first) = (&pass.camera, &memory.tile.waves[0]);
        for packet in 0..camera.packets() {
            let found = first.found(packet);
            camera.rows(packet, |row, rays| {
                for (lane, ray) in (row * LANES..).zip(rays) {
                    let met = (found >> lane & 1 == 1).then(|| first.met(RayIndex { packet, lane }));
                    each(ray, met.map(|met| met.primary()));
                }
            });
        }
    }

    fn histories(&self, pass: &TilePass, memory: &WavefrontMemory<C>, mut each: impl FnMut(usize, History)) {
        let (camera, first) = (&pass.camera, &memory.tile.waves[0]);
        for packet in 0..camera.packets() {
            camera.rows(packet, |row, rays| {
                for (lane, ray) in (row * LANES..).zip(rays) {
                    each(ray, first.history_or_miss(RayIndex { packet, lane }));
                }
            });
        }
    }
}

/// Copies as many as there is place for: mostly all, of which the compiler then knows the number.
#[inline(always)]
fn copy_row<C: Channel>(row: [C; LANES], to: &mut [C]) {
    match <&mut [C; LANES]>::try_from(&mut *to) {
        Ok(to) => *to = row,
        Err(_) => to.iter_mut().zip(row).for_each(|(to, light)| *to = light),
    }
}

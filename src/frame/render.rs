//! The second step of a picture: one tile after the other, by any integrator, with one sampling loop for all.

use std::sync::OnceLock;

use crate::integrate::{TileHits, TileIntegrator, TilePass};
use crate::math::DVec3;
use crate::shade::Channel;
use crate::solid::Assembly;
use crate::stage::{Meter, Probe, Stopwatch};
use crate::view::{PinholeCamera, Tile, TileCamera};

use super::finished_tile::FinishedTile;
use super::scratch_pool::ScratchPool;

/// The middle of a dot.
const MIDDLE: [f64; 2] = [0.0; 2];

/// Renders the tiles of one picture.
pub(super) struct TileRenderer<'a, I> {
    pub integrator: &'a I,
    pub assembly: &'a Assembly,
    pub pinhole: &'a PinholeCamera,
    /// Where rays start, in the assembly's coordinates.
    pub eye: DVec3,
    /// To the farthest point of the world, in the assembly's unit.
    pub longest_path: f64,
    /// Rays for the light of a dot along each of its sides, 1 or more.
    pub samples: u32,
    /// By tile: what the rays through the middles of its dots meet, where that is kept.
    pub hits: Option<&'a [OnceLock<TileHits>]>,
    pub spare: &'a ScratchPool,
}

/// Memory of one worker, used again for every tile.
pub(super) struct RenderMemory<M, C> {
    integrator: M,
    /// The light of one of several samples.
    sample: Vec<C>,
}

impl<I> TileRenderer<'_, I> {
    /// Memory for a worker.
    pub fn memory<C>(&self) -> RenderMemory<I::Memory, C>
    where
        I: TileIntegrator<C>,
    {
        RenderMemory { integrator: self.integrator.tile_memory(self.spare.take()), sample: Vec::new() }
    }

    /// Takes the memory of a worker back when all is drawn.
    pub fn give_back<C>(&self, memory: RenderMemory<I::Memory, C>)
    where
        I: TileIntegrator<C>,
    {
        self.spare.give_back(I::into_scratch(memory.integrator));
    }

    /// Renders a tile. What its stages took is known where `watch` is timed, which itself takes time.
    pub fn render<C: Channel>(
        &self,
        tile: &Tile,
        watch: Stopwatch,
        memory: &mut RenderMemory<I::Memory, C>,
        finished: &mut FinishedTile<C>,
    ) where
        I: TileIntegrator<C>,
    {
        let mut meter = Meter::new(watch);
        self.sample_dots(tile, memory, finished, &mut meter);
        (finished.counts, finished.times) = (meter.counts, meter.probe.stop());
    }

    /// What a dot sees is what its middle sees. Where that is none of several samples, it is traced without
    /// light, if anyone wants to know.
    fn sample_dots<C: Channel>(
        &self,
        tile: &Tile,
        memory: &mut RenderMemory<I::Memory, C>,
        finished: &mut FinishedTile<C>,
        meter: &mut Meter<impl Probe>,
    ) where
        I: TileIntegrator<C>,
    {
        finished.start(tile);
        let RenderMemory { integrator: memory, sample } = memory;
        if self.samples == 1 {
            let pass = self.pass(tile, MIDDLE);
            self.integrator.shade(&pass, memory, &mut finished.light, meter);
            self.see(&pass, memory, finished);
            return;
        }
        finished.light.fill(C::DARK);
        sample.resize(finished.light.len(), C::DARK);
        let mut saw_middle = false;
        for off in offsets(self.samples) {
            let pass = self.pass(tile, off);
            self.integrator.shade(&pass, memory, sample, meter);
            for (sum, light) in finished.light.iter_mut().zip(&*sample) {
                *sum = *sum + *light;
            }
            if off == MIDDLE {
                saw_middle = true;
                self.see(&pass, memory, finished);
            }
        }
        let step = 1.0 / f64::from(self.samples);
        for light in &mut finished.light {
            *light = *light * (step * step);
        }
        if !saw_middle && finished.sees() {
            let pass = self.pass(tile, MIDDLE);
            self.integrator.trace(&pass, memory, meter);
            self.see(&pass, memory, finished);
        }
    }

    /// A ray through each dot, so many dots from its middle.
    fn pass(&self, tile: &Tile, off: [f64; 2]) -> TilePass<'_> {
        let Self { pinhole, eye, longest_path, .. } = *self;
        let camera = TileCamera { pinhole, tile: *tile, off, eye, longest_path };
        let hits = self.hits.filter(|_| off == MIDDLE);
        TilePass { camera, kept: hits.map(|tiles| &tiles[tile.number as usize]) }
    }

    /// Takes over what the dots saw in the last pass.
    fn see<C: Channel>(&self, pass: &TilePass, memory: &I::Memory, finished: &mut FinishedTile<C>)
    where
        I: TileIntegrator<C>,
    {
        if finished.sees() {
            self.integrator.seen(pass, memory, |dot, seen| finished.see(dot, seen, self.assembly));
        }
    }
}

/// Where in a dot its samples lie, in dots from its middle: row by row, in the middles of n × n parts.
fn offsets(n: u32) -> impl Iterator<Item = [f64; 2]> {
    let step = 1.0 / f64::from(n);
    let inside = move |k: u32| (f64::from(k) + 0.5) * step - 0.5;
    (0..n).flat_map(move |b| (0..n).map(move |a| [inside(a), inside(b)]))
}

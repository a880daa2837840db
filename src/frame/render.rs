//! The second step of a picture: one tile after the other, by any integrator, with one sampling loop for all.

use std::ops::Range;
use std::sync::OnceLock;

use crate::integrate::{TileHits, TileIntegrator, TilePass};
use crate::math::DVec3;
use crate::shade::Channel;
use crate::solid::Assembly;
use crate::stage::{GiveUp, Meter, Probe, Stopwatch};
use crate::view::{PinholeCamera, PointPacket, Tile, TileCamera, TileRays, sample_point};

use super::edges::SeenByRay;
use super::finished_tile::FinishedTile;
use super::scratch_pool::ScratchPool;

/// The number of the sample in the middle of a dot.
const MIDDLE: u32 = 0;

/// Renders the tiles of one picture.
pub(super) struct TileRenderer<'a, I> {
    pub integrator: &'a I,
    pub assembly: &'a Assembly,
    pub pinhole: &'a PinholeCamera,
    /// Where rays start, in the assembly's coordinates.
    pub eye: DVec3,
    /// To the farthest point of the world, in the assembly's unit.
    pub longest_path: f64,
    /// The numbers of the samples ([`sample_point`]) whose mean is the light of a dot; one at least.
    pub samples: Range<u32>,
    /// By tile: what the rays through the middles of its dots meet, where that is kept.
    pub hits: Option<&'a [OnceLock<TileHits>]>,
    pub spare: &'a ScratchPool,
    /// When no more is rendered.
    pub give_up: &'a GiveUp<'a>,
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

    /// Renders a tile; gives whether it did, and was not to give up. What its stages took is known where
    /// `watch` is timed, which itself takes time.
    pub fn render<C: Channel>(
        &self,
        tile: &Tile,
        watch: Stopwatch,
        memory: &mut RenderMemory<I::Memory, C>,
        finished: &mut FinishedTile<C>,
    ) -> bool
    where
        I: TileIntegrator<C>,
    {
        if self.give_up.is_due() {
            return false;
        }
        let mut meter = Meter::new(watch);
        self.sample_dots(tile, memory, finished, &mut meter);
        (finished.counts, finished.times) = (meter.counts, meter.probe.stop());
        !self.give_up.was_due()
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
        if self.samples == (MIDDLE..MIDDLE + 1) {
            let pass = self.pass(tile, MIDDLE, finished.history.is_some());
            self.integrator.shade(&pass, memory, &mut finished.light, meter);
            self.see(&pass, memory, finished);
            return;
        }
        finished.light.fill(C::DARK);
        sample.resize(finished.light.len(), C::DARK);
        for number in self.samples.clone() {
            if self.give_up.is_due() {
                return;
            }
            let pass = self.pass(tile, number, finished.history.is_some() && number == MIDDLE);
            self.integrator.shade(&pass, memory, sample, meter);
            for (sum, light) in finished.light.iter_mut().zip(&*sample) {
                *sum = *sum + *light;
            }
            if number == MIDDLE {
                self.see(&pass, memory, finished);
            }
        }
        let share = 1.0 / self.samples.len() as f64;
        for light in &mut finished.light {
            *light = *light * share;
        }
        if !self.samples.contains(&MIDDLE) && finished.sees() {
            let pass = self.pass(tile, MIDDLE, false);
            self.integrator.trace(&pass, memory, meter);
            self.see(&pass, memory, finished);
        }
    }

    /// Sets `seen` to what rays through some points of the picture saw, at most 16 packets of them; leaves it
    /// where it is to give up.
    pub fn shade_points<C: Channel>(
        &self,
        points: &[PointPacket],
        memory: &mut RenderMemory<I::Memory, C>,
        seen: &mut [SeenByRay<C>],
        meter: &mut Meter<impl Probe>,
    ) where
        I: TileIntegrator<C>,
    {
        if self.give_up.is_due() {
            return;
        }
        let RenderMemory { integrator: memory, sample } = memory;
        let camera = self.camera(&Tile::NONE, TileRays::Points(points));
        let pass = TilePass { camera, kept: None, keeps_histories: true };
        sample.resize(seen.len(), C::DARK);
        self.integrator.shade(&pass, memory, sample, meter);
        for (seen, light) in seen.iter_mut().zip(&*sample) {
            seen.light = *light;
        }
        self.integrator.histories(&pass, memory, |ray, history| seen[ray].history = history);
    }

    /// A ray through each dot, by a sample's number.
    fn pass(&self, tile: &Tile, number: u32, keeps_histories: bool) -> TilePass<'_> {
        let camera = self.camera(tile, TileRays::EachDot(sample_point(number)));
        let hits = self.hits.filter(|_| number == MIDDLE);
        TilePass { camera, kept: hits.map(|tiles| &tiles[tile.number as usize]), keeps_histories }
    }

    fn camera<'r>(&'r self, tile: &Tile, rays: TileRays<'r>) -> TileCamera<'r> {
        let Self { pinhole, eye, longest_path, .. } = *self;
        TileCamera { pinhole, tile: *tile, rays, eye, longest_path }
    }

    /// Takes over what the dots saw in the last pass.
    fn see<C: Channel>(&self, pass: &TilePass, memory: &I::Memory, finished: &mut FinishedTile<C>)
    where
        I: TileIntegrator<C>,
    {
        if finished.sees() {
            self.integrator.seen(pass, memory, |dot, seen| finished.see(dot, seen, self.assembly));
        }
        if let Some(histories) = finished.history.as_mut().filter(|_| pass.keeps_histories) {
            self.integrator.histories(pass, memory, |dot, history| histories[dot] = history);
        }
    }
}

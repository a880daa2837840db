//! What the rays from the eye through a tile meet: traced, or taken over from the picture before.

use crate::math::{LaneVector, Ray, RayIndex, places};
use crate::shade::{Channel, SurfaceInteraction};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{PrimaryPackets, RayEngine, RayMemory};
use crate::view::TileCamera;

use super::goal::Goal;
use super::path_state::PathState;
use super::ray_integrator::PathMemory;
use super::surfaces_met::SingleRay;
use super::tile_hits::{BlockHits, TileHits};
use super::tile_integrator::TilePass;
use super::wavefront::Wavefront;
use super::wavefront_integrator::WavefrontIntegrator;
use super::wavefront_scratch::{WavefrontMemory, WavefrontScratch};

impl<C: Channel> WavefrontIntegrator<'_, C> {
    /// Finds what the rays from the eye meet. It is taken from what the pass has kept, or put there.
    pub(super) fn find_primary_hits(
        &self,
        pass: &TilePass,
        goal: Goal,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let WavefrontMemory { single, tile } = memory;
        tile.start(pass.camera.packets());
        tile.waves[0].inside = single.media.start(&self.illumination().around_eye);
        match pass.kept.map(|kept| (kept, kept.get())) {
            None => self.trace_primary(&pass.camera, goal, None, memory, meter),
            Some((_, Some(hits))) => self.recall(&pass.camera, goal, hits, memory, meter),
            Some((kept, None)) => {
                let mut hits = TileHits::default();
                self.trace_primary(&pass.camera, goal, Some(&mut hits), memory, meter);
                // Whoever was sooner set the same.
                let _ = kept.set(hits);
            }
        }
    }

    /// Traces the rays from the eye. Those of blocks in whose way there is nothing are not even made.
    fn trace_primary(
        &self,
        camera: &TileCamera,
        goal: Goal,
        mut keep: Option<&mut TileHits>,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let WavefrontMemory { single, tile: WavefrontScratch { trace, waves, .. } } = memory;
        let wave = &mut waves[0];
        let count = wave.rays.len();
        let Wavefront { rays, before, nearest, .. } = &mut *wave;
        let mut packets = PrimaryPackets { camera, rays, before };
        let made = self.engine.first_seen(&mut packets, &mut nearest[..count], trace, &mut meter.probe);
        self.engine.first_of_incoherent(&wave.rays, None, &mut wave.nearest[..count], trace);
        for k in 0..count {
            meter.counts.primary_rays += u64::from(camera.live(k).count_ones());
            if made >> k & 1 == 0 {
                wave.surfaces[k].forget();
                continue;
            }
            let uncertain = places(k, std::mem::take(&mut wave.nearest[k].uncertain));
            let met_singly = self.trace_singly(camera, goal, uncertain, wave, single, meter);
            self.interact(wave, k, &met_singly);
            let found = wave.found(k);
            meter.counts.primary_hits += u64::from(found.count_ones());
            if let Some(hits) = keep.as_mut().filter(|_| found != 0) {
                hits.keep(k, BlockHits::new(&wave.nearest[k], wave.resolved_singly[k], &met_singly));
            }
        }
    }

    /// Takes over what the rays from the eye met. Only those are traced again that met more than one surface
    /// in one place.
    fn recall(
        &self,
        camera: &TileCamera,
        goal: Goal,
        hits: &TileHits,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let WavefrontMemory { single, tile } = memory;
        let wave = &mut tile.waves[0];
        for (k, block) in hits.by_block(wave.rays.len()).enumerate() {
            let Some(block) = block else {
                wave.surfaces[k].forget();
                continue;
            };
            meter.at(Stage::Ray);
            let Wavefront { rays, before, .. } = &mut *wave;
            PrimaryPackets { camera, rays, before }.make(k, self.engine.level());
            meter.at(Stage::Shade);
            let mut met_singly = block.restore(k, &mut wave.nearest[k]);
            let again = places(k, block.together);
            met_singly.extend(self.trace_singly(camera, goal, again, wave, single, meter));
            self.interact(wave, k, &met_singly);
            meter.counts.primary_rays += u64::from(block.together.count_ones());
            meter.counts.primary_hits += u64::from(wave.found(k).count_ones());
        }
    }

    /// Finds what some rays from the eye meet, one after the other.
    fn trace_singly(
        &self,
        camera: &TileCamera,
        goal: Goal,
        some: impl Iterator<Item = RayIndex>,
        wave: &mut Wavefront<C>,
        memory: &mut PathMemory<RayMemory>,
        meter: &mut Meter<impl Probe>,
    ) -> Vec<(RayIndex, SurfaceInteraction)> {
        let mut met_singly = Vec::new();
        for at in some {
            let ray = Ray::new(camera.eye, wave.rays[at.packet].d.get(at.lane));
            let hit = self.single.engine.first(&ray, &mut memory.engine, meter);
            let sent = PathState::primary(ray, wave.inside.clone());
            let single = SingleRay { at, sent: &sent, hit };
            if let Some(met) = self.record_single(wave, &single, goal, memory, meter) {
                met_singly.push((at, met));
            }
        }
        met_singly
    }
}

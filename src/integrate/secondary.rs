//! What the rays of a later generation meet, those that surfaces sent on.

use std::ops::Range;

use crate::lattice::FRUSTA;
use crate::shade::Channel;
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{RayEngine, RayMemory, TileMemory};

use super::goal::Goal;
use super::ray_integrator::PathMemory;
use super::surfaces_met::SingleRay;
use super::wavefront::{QueuedRay, Wavefront};
use super::wavefront_integrator::WavefrontIntegrator;
use super::wavefront_scratch::{WavefrontMemory, WavefrontScratch};

impl<C: Channel> WavefrontIntegrator<'_, C> {
    /// Finds what the rays meet that were sent on.
    pub(super) fn trace_generation(
        &self,
        generation: usize,
        memory: &mut WavefrontMemory<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Cell);
        let WavefrontMemory { single, tile: WavefrontScratch { trace, waves, keeps_histories, .. } } = memory;
        let wave = &mut waves[generation];
        wave.pack_queues(self.engine.level());
        wave.make_room();
        wave.keep_histories(*keeps_histories);
        for packets in [wave.queues[0].packets(), wave.queues[1].packets()] {
            self.trace_queue(wave, packets, trace);
        }
        let count = wave.rays.len();
        self.engine.first_of_incoherent(
            &wave.rays,
            Some(&wave.from[..count]),
            &mut wave.nearest[..count],
            trace,
        );
        self.trace_unsure(wave, single, meter);
        for k in 0..count {
            self.interact(wave, k, &[]);
            meter.counts.secondary_rays += u64::from(wave.rays[k].live.count_ones());
            meter.counts.secondary_hits += u64::from(wave.found(k).count_ones());
        }
        meter.at(Stage::Shade);
    }

    /// Traces the packets of one queue; if those are incoherent, they are left to be
    /// traced as streams.
    fn trace_queue(&self, wave: &mut Wavefront<C>, packets: Range<usize>, trace: &mut TileMemory) {
        let mut nearest_of = |wave: &mut Wavefront<C>, packets: Range<usize>| {
            let (rays, from) = (&wave.rays[packets.clone()], &wave.from[packets.clone()]);
            self.engine.first_of(rays, Some(from), &mut wave.nearest[packets], trace)
        };
        let Range { mut start, end } = packets;
        // What curved surfaces send on is incoherent: the first packet shows it.
        let coherent = start < end && nearest_of(wave, start..start + 1) == 0;
        start += 1;
        while start < end {
            let some = start..(start + FRUSTA).min(end);
            start = some.end;
            if coherent {
                nearest_of(wave, some);
            } else {
                for k in some {
                    wave.nearest[k].clear();
                    wave.nearest[k].incoherent = wave.rays[k].live;
                }
            }
        }
    }

    /// Traces the rays of which packets are uncertain, one after the other.
    fn trace_unsure(
        &self,
        wave: &mut Wavefront<C>,
        memory: &mut PathMemory<RayMemory>,
        meter: &mut Meter<impl Probe>,
    ) {
        let queues = std::mem::take(&mut wave.queues);
        for queue in &queues {
            for (number, QueuedRay { sent, departure }) in queue.rays.iter().enumerate() {
                let at = queue.place(number);
                if wave.nearest[at.packet].uncertain >> at.lane & 1 == 1 {
                    let hit = self.single.engine.next(&sent.ray, *departure, &mut memory.engine, meter);
                    self.record_single(wave, &SingleRay { at, sent, hit }, Goal::Light, memory, meter);
                }
            }
        }
        for nearest in &mut wave.nearest {
            nearest.uncertain = 0;
        }
        wave.queues = queues;
    }
}

//! From the hits of a packet to the surfaces that are shaded.

use crate::math::{DVec3, LaneVector, RayIndex, places};
use crate::shade::{Channel, SurfaceInteraction};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Hit, RayEngine, RayMemory};

use super::goal::Goal;
use super::path_state::PathState;
use super::ray_integrator::PathMemory;
use super::wavefront::Wavefront;
use super::wavefront_integrator::WavefrontIntegrator;

/// A ray of a wavefront that was traced by itself.
pub(super) struct SingleRay<'a> {
    pub at: RayIndex,
    pub sent: &'a PathState,
    pub hit: Option<Hit>,
}

impl<C: Channel> WavefrontIntegrator<'_, C> {
    /// Stores what a ray met that was traced singly, the last one. Where several surfaces coincide there, it
    /// is resolved and lit now, as far as light is asked for, and marked as resolved; else its normal is
    /// found later, with the packet's.
    pub(super) fn record_single(
        &self,
        wave: &mut Wavefront<C>,
        ray: &SingleRay,
        goal: Goal,
        memory: &mut PathMemory<RayMemory>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<SurfaceInteraction> {
        let SingleRay { at, sent, hit } = *ray;
        wave.nearest[at.packet].set(at.lane, hit.as_ref());
        let hit = hit?;
        if self.single.engine.together(&memory.engine).len() == 1 {
            return Some(SurfaceInteraction { hit, p: hit.p, normal: DVec3::ZERO });
        }
        meter.at(Stage::Shade);
        let met = self.single.met(&sent.ray, hit, memory);
        if goal == Goal::Light {
            let light = self.single.light(sent, &met, memory, meter);
            wave.set_light(at, light);
            wave.change_history(at, |_| memory.history);
        }
        meter.at(Stage::Cell);
        wave.nearest[at.packet].set(at.lane, Some(&met.hit));
        wave.resolved_singly[at.packet] |= 1 << at.lane;
        Some(met)
    }

    /// Finds the surfaces that a packet met. `met_singly` is what its rays met that were traced one by one.
    pub(super) fn interact(
        &self,
        wave: &mut Wavefront<C>,
        k: usize,
        met_singly: &[(RayIndex, SurfaceInteraction)],
    ) {
        let (level, illumination) = (self.engine.level(), self.illumination());
        let assembly = illumination.assembly;
        let Wavefront { rays, before, nearest, surfaces, departures, resolved_singly, .. } = wave;
        let (packet, nearest, surfaces) = (&rays[k], &nearest[k], &mut surfaces[k]);
        surfaces.set_points(packet, &before[k], nearest, level);
        surfaces.hits &= !resolved_singly[k];
        for (RayIndex { lane, .. }, met) in met_singly {
            surfaces.p.set(*lane, met.p);
            surfaces.path_length.0[*lane] = met.hit.t;
        }
        surfaces.resolve(packet, nearest, assembly, &mut departures[k], level);
        for at in places(k, surfaces.patches) {
            let (primitive, surface) = (nearest.primitive.0[at.lane], nearest.surface.0[at.lane]);
            let p = surfaces.p.get(at.lane);
            let normal = assembly.turned_normal(primitive, surface, p, packet.d.get(at.lane));
            surfaces.normal.set(at.lane, normal);
            let hit = Hit { t: 0.0, error: 0.0, p, object: 0, primitive, surface, entering: true };
            departures[k].set(at.lane, &illumination.departure(&hit, p, normal));
        }
        for (RayIndex { lane, .. }, met) in
            met_singly.iter().filter(|(at, _)| resolved_singly[k] >> at.lane & 1 == 1)
        {
            surfaces.normal.set(*lane, met.normal);
        }
    }
}

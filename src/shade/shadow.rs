//! Rays towards the lights.

use crate::math::Ray;
use crate::solid::Departure;
use crate::stage::{Meter, Probe, Stage};
use crate::trace::Engine;

use super::channel::Channel;
use super::surface::{Memory, Shader};

impl<E: Engine, C: Channel> Shader<'_, E, C> {
    /// V: the share of a light at `distance` that reaches the start of `ray`.
    #[inline]
    pub(super) fn visibility(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> f64 {
        meter.counts.shadow_rays += 1;
        let share = if self.glass {
            self.transmittance(ray, departure, distance, memory, meter)
        } else {
            let blocked = self.engine.blocked(ray, departure, distance, &mut memory.engine, meter);
            blocked.then_some(0.0)
        };
        meter.at(Stage::Shade);
        meter.counts.shadow_hits += u64::from(share.is_some());
        share.unwrap_or(1.0)
    }

    /// The product of `kt` over the glass objects before `distance`, each counted once however often its surface is
    /// crossed; 0 behind an opaque surface; `None` where there is nothing at all.
    fn transmittance(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<f64> {
        memory.crossed.clear();
        let (mut leg, mut departure, mut way, mut share) = (*ray, departure, 0.0, None);
        while let Some(hit) = self.engine.next(&leg, departure, &mut memory.engine, meter) {
            let t = way + hit.t;
            if t + hit.error >= distance {
                break;
            }
            let hit = self.shown(hit, |finish| finish.lets_through, memory);
            let kt = self.finish(&hit).lets_through;
            if kt == 0.0 {
                return Some(0.0);
            }
            if !memory.crossed.contains(&hit.object) {
                memory.crossed.push(hit.object);
                share = Some(share.unwrap_or(1.0) * kt);
            }
            // A step so short that rounding takes it away would be made for ever.
            if t <= way {
                break;
            }
            way = t;
            leg.o = ray.at(way);
            departure = self.departure(&hit, leg.o, ray.d);
        }
        share
    }
}

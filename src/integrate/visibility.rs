//! Shadow rays: whether a light reaches a surface, and what glass leaves of it.

use crate::math::Ray;
use crate::shade::Channel;
use crate::solid::{Crossing, Departure};
use crate::stage::{Meter, Probe, RayEvent, RayKind, Stage};
use crate::trace::{Hit, OpacityClass, RayEngine};

use super::ray_integrator::{PathMemory, RayIntegrator};

impl<R: RayEngine, C: Channel> RayIntegrator<'_, R, C> {
    /// V: the share of a light at `distance` that reaches the start of `ray`.
    #[inline]
    pub(super) fn visibility(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> f64 {
        meter.counts.shadow_rays += 1;
        meter.record(|| RayEvent::Sent { kind: RayKind::Shadow, ray: *ray, weight: 1.0 });
        let share = if self.illumination.glass {
            self.transmittance(ray, departure, distance, memory, meter)
        } else {
            let blocked = self.engine.blocked(ray, departure, distance, &mut memory.engine, meter);
            blocked.then_some(0.0)
        };
        meter.at(Stage::Shade);
        meter.counts.shadow_hits += u64::from(share.is_some());
        share.unwrap_or(1.0)
    }

    /// The product of `kt` over the glass objects before `distance`, in the order of their numbers; 0 where
    /// anything opaque is met before it; `None` where there is nothing at all.
    ///
    /// What the ray first meets is found for each object by itself: so it makes no difference which of two
    /// surfaces in one place comes first.
    fn transmittance(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<f64> {
        let PathMemory { engine, crossed, .. } = memory;
        crossed.clear();
        let kt = |crossing: &Crossing| self.illumination.lets_through[crossing.primitive as usize];
        let visit = &mut |object, crossing: &Crossing| {
            let is_before = crossing.is_before(distance);
            if is_before && kt(crossing) > 0.0 {
                crossed.push((object, *crossing));
            }
            is_before && kt(crossing) == 0.0
        };
        if self.engine.meets(ray, departure, distance, engine, meter, visit) {
            return Some(0.0);
        }
        crossed.sort_unstable_by_key(|&(object, _)| object);
        let mut share = None;
        for (object, first) in crossed {
            let is_mixed = self.illumination.opacity[*object as usize] == OpacityClass::Mixed;
            if is_mixed && self.goes_dark(ray, *object, first, distance, engine, meter) {
                return Some(0.0);
            }
            share = Some(share.unwrap_or(1.0) * kt(first));
        }
        share
    }

    /// Whether a ray meets an opaque surface of an object before `distance`, behind a first one that is
    /// glass.
    fn goes_dark(
        &self,
        ray: &Ray,
        object: u32,
        first: &Crossing,
        distance: f64,
        memory: &mut R::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> bool {
        let (mut t, mut crossing) = (first.t, *first);
        loop {
            let p = ray.at(t);
            let Crossing { primitive, surface, entering, .. } = crossing;
            let hit = Hit { t, error: 0.0, p, object, primitive, surface, entering };
            let (onward, departure) = (Ray::new(p, ray.d), self.illumination.departure(&hit, p, ray.d));
            let left = distance - t;
            let next = self.engine.of_object(object, &onward, departure, left, memory, meter);
            // A step so short that rounding takes it away would be made for ever.
            let Some(next) = next.filter(|next| next.is_before(left) && t + next.t > t) else {
                return false;
            };
            if self.illumination.lets_through[next.primitive as usize] == 0.0 {
                return true;
            }
            (t, crossing) = (t + next.t, next);
        }
    }
}

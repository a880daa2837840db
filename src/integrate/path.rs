//! The light along one ray and all that its surface sends on: eq. (1) to (4), from surface to surface.

use crate::math::{DVec3, Ray, Vector};
use crate::shade::{
    Channel, Interface, Media, Medium, MediumStack, MediumTransition, PrimaryHit, Reflected, Scattered,
    ScatteredRays, SurfaceInteraction, Towards,
};
use crate::solid::{Crossing, Departure};
use crate::stage::{Meter, Probe, RayEvent, RayKind, Stage};
use crate::trace::{Hit, RayEngine};

use super::history::History;
use super::path_state::PathState;
use super::ray_integrator::{PathMemory, RayIntegrator};

/// What a ray from the eye saw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<C> {
    /// The light.
    pub light: C,
    /// The surface; absent where nothing was met.
    pub seen: Option<PrimaryHit>,
}

impl<R: RayEngine, C: Channel> RayIntegrator<'_, R, C> {
    /// What a ray from the eye sees. `ray` is in the assembly's coordinates.
    pub fn view(
        &self,
        ray: &Ray,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> View<C> {
        let Some(met) = self.interaction(ray, memory, meter) else {
            memory.history = History::MISS;
            return View { light: self.illumination.background, seen: None };
        };
        let inside = memory.media.start(&self.illumination.around_eye);
        let light = self.light(&PathState::primary(*ray, inside), &met, memory, meter);
        View { light, seen: Some(met.primary()) }
    }

    /// The surface that a ray from the eye meets first.
    pub(super) fn interaction(
        &self,
        ray: &Ray,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> Option<SurfaceInteraction> {
        meter.counts.primary_rays += 1;
        meter.record(|| RayEvent::Sent { kind: RayKind::Eye, ray: *ray, weight: 1.0 });
        let Some(hit) = self.engine.first(ray, &mut memory.engine, meter) else {
            meter.record(|| RayEvent::Missed);
            return None;
        };
        meter.counts.primary_hits += 1;
        meter.at(Stage::Shade);
        let met = self.met(ray, hit, memory);
        meter.record(|| hit_event(&met.hit));
        Some(met)
    }

    /// The surface of the last hit.
    pub(super) fn met(&self, ray: &Ray, hit: Hit, memory: &PathMemory<R::Memory>) -> SurfaceInteraction {
        SurfaceInteraction::new(self.illumination.assembly, ray, self.shown(hit, memory))
    }

    /// The light that a surface sends back along the ray that met it, which is the last one traced.
    pub(super) fn light(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        memory.history = History::hit(met.hit.object, met.hit.primitive, met.hit.surface);
        if self.illumination.material_at(met).scatters() {
            let transition = self.transition(&sent.inside, memory);
            let own = self.own_light(sent, met, memory, meter);
            self.scattered_light(sent, met, &transition, own, memory, meter)
        } else {
            self.own_light(sent, met, memory, meter)
        }
    }

    /// `Ia·C + Σ Ip · V · (kd·C·(L·N) + ks·cosⁿθ) / (R + k)`.
    fn own_light(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let illumination = &self.illumination;
        let material = illumination.material_at(met);
        let departure = illumination.departure(&met.hit, met.p, met.normal);
        let normal = Vector::from(met.normal);
        let mut sum = [0.0; 3];
        for (number, lamp) in illumination.lamps.iter().enumerate() {
            let towards = Towards::new(lamp.at, Vector::from(met.p), normal);
            if !towards.shines() {
                memory.history = memory.history.lit(0.0);
                continue;
            }
            let diffuse = material.diffuse(towards.facing);
            let mut highlight = 0.0;
            if material.ks > 0.0 {
                let cosine = towards.mirrored_cosine(normal, Vector::from(sent.ray.d));
                highlight = material.highlight(cosine, true);
            }
            let mut reflected = Reflected { diffuse, highlight, visible: None };
            if illumination.shadows && material.is_lit() {
                let ray = Ray::new(met.p, towards.d.into());
                let visible = self.visibility(&ray, departure, towards.distance, memory, meter);
                memory.history = memory.history.lit(visible);
                reflected.visible = Some(visible);
            } else {
                memory.history = memory.history.lit(if material.is_lit() { 1.0 } else { 0.0 });
            }
            let Reflected { visible, .. } = reflected;
            let add = |sum, part| reflected.add_to(sum, material.color.part(part), lamp.light.part(part));
            meter.record(|| {
                let own = std::array::from_fn(|part| if part < C::PARTS { add(0.0, part) } else { 0.0 });
                let adds = if visible == Some(0.0) { 0.0 } else { C::from_parts(own).gray() };
                RayEvent::Lit { lamp: number, diffuse, highlight, visible, adds }
            });
            if visible == Some(0.0) {
                continue;
            }
            for part in 0..C::PARTS {
                sum[part] = add(sum[part], part);
            }
        }
        let (gathering, path_length) = (illumination.gathering(material), sent.travelled + met.hit.t);
        let lamps = C::from_parts(sum);
        for part in 0..C::PARTS {
            sum[part] = gathering.part(part, sum[part], path_length);
        }
        let light = C::from_parts(sum);
        meter.record(|| RayEvent::Gathered {
            ambient: (illumination.ambient * material.color).gray(),
            lamps: lamps.gray(),
            path_length,
            light: light.gray(),
        });
        light
    }

    /// Of a glass surface and opaque solids that begin in the same place, the opaque shows: behind the glass
    /// there is nothing that a ray could go on through. To be asked before the memory is used again.
    fn shown(&self, hit: Hit, memory: &PathMemory<R::Memory>) -> Hit {
        let illumination = &self.illumination;
        let together = self.engine.together(&memory.engine);
        if together.len() < 2 || illumination.material_of(hit.primitive).kt == 0.0 {
            return hit;
        }
        // A surface that bounds no solid shows on both sides.
        let opaque = together.iter().filter(|(_, c)| {
            illumination.material_of(c.primitive).kt == 0.0
                && (c.entering || illumination.is_surface(c.primitive))
        });
        opaque.min_by_key(|(object, _)| *object).map_or(hit, |&(object, c)| Hit {
            object,
            primitive: c.primitive,
            surface: c.surface,
            entering: c.entering,
            ..hit
        })
    }

    /// The glass that a ray which goes on through the last hit goes through, and what is behind it.
    #[inline]
    pub(super) fn transition(
        &self,
        inside: &MediumStack,
        memory: &mut PathMemory<R::Memory>,
    ) -> MediumTransition {
        let PathMemory { engine, media, .. } = memory;
        self.transition_at(inside, self.engine.together(engine), media)
    }

    /// The glass that a ray which goes on through surfaces that lie in one place goes through, and what is
    /// behind it.
    #[inline]
    pub(super) fn transition_at(
        &self,
        inside: &MediumStack,
        together: &[(u32, Crossing)],
        media: &mut Media,
    ) -> MediumTransition {
        let interfaces = together.iter().filter_map(|&(object, crossing)| {
            let material = self.illumination.material_of(crossing.primitive);
            let filling = Medium { object, index: material.index };
            let solid = !self.illumination.is_surface(crossing.primitive);
            (material.kt > 0.0).then_some(Interface { filling, entering: crossing.entering, solid })
        });
        media.change(inside, interfaces)
    }

    /// The light of a surface that sends rays on: its `own`, and `kr·S + kt·T`.
    pub(super) fn scattered_light(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        transition: &MediumTransition,
        own: C,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let material = self.illumination.material_at(met);
        let mut light = own;
        let rays = ScatteredRays::new(sent.ray.d, met.normal, material, transition.before, transition.behind);
        let mut arriving = |kind, onward: Scattered, side: DVec3, inside: &MediumStack| {
            let next = sent.scattered(met, onward, inside.clone());
            meter.record(|| RayEvent::Sent { kind, ray: next.ray, weight: next.weight });
            let departure = self.illumination.departure(&met.hit, met.p, side);
            let before = memory.history;
            let arrived = self.arriving(&next, departure, memory, meter);
            meter.record(|| RayEvent::Arrived { light: arrived.gray(), share: onward.share });
            memory.history = before.sent_on(memory.history);
            arrived * onward.share
        };
        if let Some(mirror) = rays.mirror {
            light = (light + arriving(RayKind::Mirror, mirror, met.normal, &sent.inside)).limited();
        }
        if let Some(snell) = rays.snell {
            light = (light + arriving(RayKind::Snell, snell, -met.normal, &transition.list)).limited();
        }
        memory.media.forget(&transition.list);
        light
    }

    /// S or T: the light that arrives along a mirror or Snell ray. A ray that is not followed counts as
    /// ambient light.
    pub(super) fn arriving(
        &self,
        sent: &PathState,
        departure: Departure,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        if !self.is_followed(sent.generation, sent.weight) {
            meter.counts.truncated_rays += 1;
            meter.record(|| RayEvent::Truncated);
            memory.history = History::TRUNCATED;
            return self.illumination.ambient;
        }
        meter.counts.secondary_rays += 1;
        let hit = self.engine.next(&sent.ray, departure, &mut memory.engine, meter);
        meter.at(Stage::Shade);
        let Some(hit) = hit else {
            meter.record(|| RayEvent::Missed);
            memory.history = History::MISS;
            return self.illumination.background;
        };
        meter.counts.secondary_hits += 1;
        let met = self.met(&sent.ray, hit, memory);
        meter.record(|| hit_event(&met.hit));
        self.light(sent, &met, memory, meter)
    }

    /// Whether a ray that was sent on is followed.
    #[inline]
    pub(super) fn is_followed(&self, generation: u32, weight: f64) -> bool {
        generation <= self.generations && weight >= self.least_weight
    }
}

fn hit_event(hit: &Hit) -> RayEvent {
    let Hit { object, primitive, surface, t, .. } = *hit;
    RayEvent::Hit { object, primitive, surface, t }
}

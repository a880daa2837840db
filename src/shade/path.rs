//! Mirror and Snell rays: eq. (4) (Whitted: An improved illumination model for shaded display, CACM 1980).

use crate::math::{DVec3, Ray};
use crate::solid::{Crossing, Departure};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Hit};

use super::channel::Channel;
use super::direction::{mirrored, refracted};
use super::media::{Interface, Media, Medium, MediumStack, MediumTransition};
use super::surface::{Memory, ResolvedMaterial, Shader, SurfaceInteraction};

/// Why a ray goes where it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From the eye.
    Eye,
    /// Along the mirror direction.
    Mirror,
    /// Along Snell's direction.
    Snell,
}

/// One ray of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSegment {
    /// Why it goes where it goes.
    pub kind: Kind,
    /// The ray, in the assembly's coordinates.
    pub ray: Ray,
    /// The index of refraction of what it goes through.
    pub index: f64,
    /// The share of its light that reaches the eye.
    pub weight: f64,
    /// What it meets; absent where that is nothing.
    pub hit: Option<Hit>,
}

/// A ray on its way.
#[derive(Clone, Debug)]
pub(super) struct PathState {
    pub ray: Ray,
    /// The way from the eye to its start.
    pub travelled: f64,
    /// The share of its light that reaches the eye.
    pub weight: f64,
    /// 0 for a ray from the eye.
    pub generation: u32,
    /// The glass it starts in.
    pub inside: MediumStack,
}

impl PathState {
    /// The ray that a surface sends on along `d`, with a share of its light.
    #[inline]
    fn on(&self, met: &SurfaceInteraction, d: DVec3, share: f64, inside: MediumStack) -> Self {
        Self {
            ray: Ray::new(met.p, d),
            travelled: self.travelled + met.hit.t,
            weight: self.weight * share,
            generation: self.generation + 1,
            inside,
        }
    }
}

/// The rays that a surface sends on, each with its share.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScatteredRays {
    pub mirror: Option<(DVec3, f64)>,
    pub snell: Option<(DVec3, f64)>,
}

impl ScatteredRays {
    /// `before` and `behind` are the indices of refraction on the two sides.
    #[inline]
    pub fn new<C>(d: DVec3, normal: DVec3, finish: &ResolvedMaterial<C>, before: f64, behind: f64) -> Self {
        let some = |direction, share| (share > 0.0).then_some((direction, share));
        let (kr, kt) = (finish.kr, finish.kt);
        match (kt > 0.0).then(|| refracted(d, normal, before, behind)) {
            // Total internal reflection: what can not go out goes the way of the mirror ray.
            Some(None) => Self { mirror: some(mirrored(d, normal), kr + kt), snell: None },
            Some(Some(onward)) => Self { mirror: some(mirrored(d, normal), kr), snell: some(onward, kt) },
            None => Self { mirror: some(mirrored(d, normal), kr), snell: None },
        }
    }
}

impl<E: Engine, C: Channel> Shader<'_, E, C> {
    /// Of a glass surface and opaque solids that begin in the same place, the opaque shows: behind the glass there
    /// is nothing that a ray could go on through. To be asked before the memory is used again.
    pub(super) fn shown(&self, hit: Hit, memory: &Memory<E>) -> Hit {
        let together = self.engine.together(&memory.engine);
        if together.len() < 2 || self.finish(&hit).kt == 0.0 {
            return hit;
        }
        // A surface that bounds no solid shows on both sides.
        let opaque = together.iter().filter(|(_, c)| {
            self.finish_of(c.primitive).kt == 0.0 && (c.entering || self.is_surface(c.primitive))
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
    pub(super) fn change(&self, inside: &MediumStack, memory: &mut Memory<E>) -> MediumTransition {
        let Memory { engine, media, .. } = memory;
        self.change_at(inside, self.engine.together(engine), media)
    }

    /// The glass that a ray which goes on through surfaces that lie in one place goes through, and what is behind it.
    #[inline]
    pub(super) fn change_at(
        &self,
        inside: &MediumStack,
        together: &[(u32, Crossing)],
        media: &mut Media,
    ) -> MediumTransition {
        let passages = together.iter().filter_map(|&(object, crossing)| {
            let finish = self.finish_of(crossing.primitive);
            let filling = Medium { object, index: finish.index };
            let solid = !self.is_surface(crossing.primitive);
            (finish.kt > 0.0).then_some(Interface { filling, entering: crossing.entering, solid })
        });
        media.change(inside, passages)
    }

    /// The light of a surface that sends rays on: its `own`, and `kr·S + kt·T`. `change` is what its glass changes.
    pub(super) fn sending_surface(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        change: &MediumTransition,
        own: C,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let finish = self.finish(&met.hit);
        let mut light = own;
        let onward = ScatteredRays::new(sent.ray.d, met.normal, finish, change.before, change.behind);
        let mut arriving = |(d, share): (DVec3, f64), side: DVec3, inside: &MediumStack| {
            let next = sent.on(met, d, share, inside.clone());
            self.arriving(&next, self.departure(&met.hit, met.p, side), memory, meter) * share
        };
        if let Some(mirror) = onward.mirror {
            light = (light + arriving(mirror, met.normal, &sent.inside)).limited();
        }
        if let Some(snell) = onward.snell {
            light = (light + arriving(snell, -met.normal, &change.list)).limited();
        }
        memory.media.forget(&change.list);
        light
    }

    /// S or T: the light that arrives along a mirror or Snell ray. A ray that is not followed counts as ambient
    /// light.
    pub(super) fn arriving(
        &self,
        sent: &PathState,
        departure: Departure,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        if sent.generation > self.generations || sent.weight < self.least_weight {
            meter.counts.truncated_rays += 1;
            return self.ambient;
        }
        meter.counts.secondary_rays += 1;
        let hit = self.engine.next(&sent.ray, departure, &mut memory.engine, meter);
        meter.at(Stage::Shade);
        let Some(hit) = hit else { return self.background };
        meter.counts.secondary_hits += 1;
        let met = self.met(&sent.ray, hit, memory);
        self.light(sent, &met, memory, meter)
    }

    /// The legs of one path from the eye: at each surface it takes the ray of the kind that is preferred, or the
    /// other where only that one is sent. It ends where nothing is met, at a surface that sends neither, and with
    /// the last generation. `ray` is in the assembly's coordinates.
    pub fn path(
        &self,
        ray: &Ray,
        preferred: Kind,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> Vec<PathSegment> {
        let mut inside = memory.media.start(&self.around_eye);
        let mut legs: Vec<PathSegment> = Vec::new();
        let mut leg = PathSegment {
            kind: Kind::Eye,
            ray: *ray,
            index: memory.media.index(&inside),
            weight: 1.0,
            hit: None,
        };
        let mut departure = None;
        loop {
            let hit = match departure {
                None => self.engine.first(&leg.ray, &mut memory.engine, meter),
                Some(departure) => self.engine.next(&leg.ray, departure, &mut memory.engine, meter),
            };
            let Some(hit) = hit else { break };
            let met = self.met(&leg.ray, hit, memory);
            leg.hit = Some(met.hit);
            let change = self.change(&inside, memory);
            let onward = ScatteredRays::new(
                leg.ray.d,
                met.normal,
                self.finish(&met.hit),
                change.before,
                change.behind,
            );
            let mirror = onward.mirror.map(|(d, share)| (Kind::Mirror, d, share));
            let snell = onward.snell.map(|(d, share)| (Kind::Snell, d, share));
            let (one, other) = if preferred == Kind::Mirror { (mirror, snell) } else { (snell, mirror) };
            let Some((kind, d, share)) = one.or(other).filter(|_| legs.len() < self.generations as usize)
            else {
                break;
            };
            let mut index = leg.index;
            let mut side = met.normal;
            if kind == Kind::Snell {
                (index, side, inside) = (change.behind, -met.normal, change.list);
            }
            departure = Some(self.departure(&met.hit, met.p, side));
            let weight = leg.weight * share;
            legs.push(std::mem::replace(
                &mut leg,
                PathSegment { kind, ray: Ray::new(met.p, d), index, weight, hit: None },
            ));
        }
        legs.push(leg);
        legs
    }
}

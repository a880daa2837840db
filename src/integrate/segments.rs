//! One path from the eye, ray by ray: for whoever wants to see where light has been.

use crate::math::Ray;
use crate::shade::{Channel, ScatteredRays};
use crate::stage::{Meter, Probe, RayKind};
use crate::trace::{Hit, RayEngine};

use super::ray_integrator::{PathMemory, RayIntegrator};

/// One ray of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSegment {
    /// Why it goes where it goes.
    pub kind: RayKind,
    /// The ray, in the assembly's coordinates.
    pub ray: Ray,
    /// The index of refraction of what it goes through.
    pub index: f64,
    /// The share of its light that reaches the eye.
    pub weight: f64,
    /// What it meets; absent where that is nothing.
    pub hit: Option<Hit>,
}

impl<R: RayEngine, C: Channel> RayIntegrator<'_, R, C> {
    /// The segments of one path from the eye: at each surface it takes the ray of the kind that is preferred,
    /// or the other where only that one is sent. It ends where nothing is met, at a surface that sends
    /// neither, and with the last generation. `ray` is in the assembly's coordinates.
    pub fn path(
        &self,
        ray: &Ray,
        preferred: RayKind,
        memory: &mut PathMemory<R::Memory>,
        meter: &mut Meter<impl Probe>,
    ) -> Vec<PathSegment> {
        let illumination = &self.illumination;
        let mut inside = memory.media.start(&illumination.around_eye);
        let mut segments: Vec<PathSegment> = Vec::new();
        let mut segment = PathSegment {
            kind: RayKind::Eye,
            ray: *ray,
            index: memory.media.index(&inside),
            weight: 1.0,
            hit: None,
        };
        let mut departure = None;
        loop {
            let hit = match departure {
                None => self.engine.first(&segment.ray, &mut memory.engine, meter),
                Some(departure) => self.engine.next(&segment.ray, departure, &mut memory.engine, meter),
            };
            let Some(hit) = hit else { break };
            let met = self.met(&segment.ray, hit, memory);
            segment.hit = Some(met.hit);
            let transition = self.transition(&inside, memory);
            let material = illumination.material_at(&met);
            let rays =
                ScatteredRays::new(segment.ray.d, met.normal, material, transition.before, transition.behind);
            let mirror = rays.mirror.map(|onward| (RayKind::Mirror, onward));
            let snell = rays.snell.map(|onward| (RayKind::Snell, onward));
            let (one, other) = if preferred == RayKind::Mirror { (mirror, snell) } else { (snell, mirror) };
            let followed = one.or(other).filter(|_| segments.len() < self.generations as usize);
            let Some((kind, onward)) = followed else { break };
            let mut index = segment.index;
            let mut side = met.normal;
            if kind == RayKind::Snell {
                (index, side, inside) = (transition.behind, -met.normal, transition.list);
            }
            departure = Some(illumination.departure(&met.hit, met.p, side));
            let weight = segment.weight * onward.share;
            let next = PathSegment { kind, ray: Ray::new(met.p, onward.d), index, weight, hit: None };
            segments.push(std::mem::replace(&mut segment, next));
        }
        segments.push(segment);
        segments
    }
}

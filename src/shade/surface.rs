//! The light that a surface sends to the eye.

use crate::math::{Bounds, DVec3, Ray};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::solid::{Assembly, Crossing, Departure, WorldShape};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Hit, OpacityClass};
use crate::view::settled;

use super::channel::Channel;
use super::direction::WITHIN;
use super::media::{Media, Medium};
use super::path::PathState;
use super::power::power;

/// A light nearer than this, in the assembly's unit, is at the point itself: 2⁻⁵⁰⁰, whose square does not
/// underflow. A hit's own place is not known so well by far.
pub(super) const NEAREST: f64 = f64::from_bits((1023 - 500) << 52);

/// Shades hits of one picture.
#[derive(Debug)]
pub struct Shader<'a, E, C> {
    pub(super) engine: &'a E,
    pub(super) assembly: &'a Assembly,
    pub(super) finishes: Vec<ResolvedMaterial<C>>,
    pub(super) lamps: Vec<Lamp<C>>,
    pub(super) ambient: C,
    pub(super) background: C,
    /// The constant of the depth term, in the scene's unit.
    pub(super) depth: Option<f64>,
    pub(super) shadows: bool,
    /// Whether light can come through anything.
    pub(super) glass: bool,
    /// By object; empty where light comes through nothing.
    pub(super) opacity: Vec<OpacityClass>,
    /// By object: a box around its opaque parts where others are glass; empty where light comes through nothing.
    pub(super) dark: Vec<Bounds>,
    /// By primitive: the share of light that its material lets through; empty where none does.
    pub(super) lets_through: Vec<f64>,
    pub(super) generations: u32,
    pub(super) least_weight: f64,
    /// The glass that the eye is in.
    pub(super) around_eye: Vec<Medium>,
}

/// Memory of one worker.
#[derive(Debug)]
pub struct Memory<E: Engine> {
    pub(super) engine: E::Memory,
    pub(super) media: Media,
    /// The glass objects that the present shadow ray has gone through.
    pub(super) crossed: Vec<(u32, Crossing)>,
}

/// A material, ready for the channels and the terms that are computed: the shares of all others are 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct ResolvedMaterial<C> {
    pub color: C,
    pub kd: f64,
    pub ks: f64,
    pub n: f64,
    pub kr: f64,
    pub kt: f64,
    pub index: f64,
}

/// A surface that a ray met, and how it lies to the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfaceInteraction {
    pub hit: Hit,
    pub p: DVec3,
    /// Turned to the side that the ray comes from, length 1.
    pub normal: DVec3,
}

/// A light in the assembly's coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp<C> {
    pub at: DVec3,
    pub light: C,
}

/// What a ray from the eye saw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<C> {
    /// The light.
    pub light: C,
    /// The surface; absent where nothing was met.
    pub seen: Option<PrimaryHit>,
}

/// A surface that was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrimaryHit {
    /// Distance from the eye, in the assembly's unit.
    pub t: f64,
    /// The object's index in the assembly.
    pub object: u32,
    /// The normal, turned to the eye's side, length 1.
    pub normal: DVec3,
}

/// The way from a surface to a lamp that it faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Towards {
    /// The direction, of length 1.
    pub d: DVec3,
    pub distance: f64,
    /// `L·N`, above 0.
    pub facing: f64,
}

impl Towards {
    /// The cosine of the angle between the mirrored light and the way to the eye, at most 1.
    #[inline]
    pub fn mirrored_cosine(&self, normal: DVec3, seen_along: DVec3) -> f64 {
        let mirrored = 2.0 * self.facing * normal - self.d;
        // Rounding may put it above 1, and n may be large enough to make anything of that.
        (-mirrored.dot(seen_along)).min(1.0)
    }
}

impl<'a, E: Engine, C: Channel> Shader<'a, E, C> {
    /// A shader for a planned picture.
    pub fn new(scene: &Scene, assembly: &'a Assembly, plan: &Plan, engine: &'a E) -> Self {
        let if_planned = |planned: bool, share: f64| if planned { share } else { 0.0 };
        let finishes = scene.materials.iter().map(|m| ResolvedMaterial {
            color: C::from_rgb(m.color),
            kd: m.kd,
            ks: if_planned(plan.highlight, m.ks),
            n: m.n,
            kr: if_planned(plan.secondary.is_some(), m.kr),
            kt: if_planned(plan.secondary.is_some(), m.kt),
            index: m.index,
        });
        let lamps = plan
            .lamps
            .iter()
            .map(|l| Lamp { at: assembly.scene_frame.inward_near(l.at), light: C::source(l.light) });
        let kt = |primitive: u32| scene.materials[assembly.material(primitive).0 as usize].kt;
        let opacity = |object: u32| {
            let primitives = assembly.primitives_of(object);
            match primitives.iter().filter(|&&primitive| kt(primitive) > 0.0).count() {
                0 => OpacityClass::Opaque,
                clear if clear == primitives.len() => OpacityClass::Clear,
                _ => OpacityClass::Mixed,
            }
        };
        let dark = |object: u32| match opacity(object) {
            OpacityClass::Mixed => assembly.bounds_of(object, |primitive| kt(primitive) == 0.0),
            OpacityClass::Opaque | OpacityClass::Clear => Bounds::EMPTY,
        };
        let if_glass = |count: usize| if plan.glass { count as u32 } else { 0 };
        let secondary = plan.secondary.as_ref();
        let around_eye = secondary.iter().flat_map(|s| &s.around_eye);
        Self {
            engine,
            assembly,
            finishes: finishes.collect(),
            lamps: lamps.collect(),
            ambient: C::source(scene.world.ambient),
            background: C::source(scene.world.background),
            depth: plan.depth,
            shadows: plan.shadows,
            glass: plan.glass,
            opacity: (0..if_glass(assembly.objects.len())).map(opacity).collect(),
            dark: (0..if_glass(assembly.objects.len())).map(dark).collect(),
            lets_through: (0..if_glass(assembly.primitives.len())).map(kt).collect(),
            generations: secondary.map_or(0, |s| s.generations),
            least_weight: secondary.map_or(0.0, |s| s.least_weight),
            around_eye: around_eye.map(|&(object, index)| Medium { object, index }).collect(),
        }
    }

    /// New memory for a worker.
    pub fn memory(&self) -> Memory<E> {
        Memory { engine: self.engine.memory(), media: Media::default(), crossed: Vec::new() }
    }

    /// What a ray from the eye sees. `ray` is in the assembly's coordinates.
    pub fn view(&self, ray: &Ray, memory: &mut Memory<E>, meter: &mut Meter<impl Probe>) -> View<C> {
        meter.counts.primary_rays += 1;
        let Some(hit) = self.engine.first(ray, &mut memory.engine, meter) else {
            return View { light: self.background, seen: None };
        };
        meter.counts.primary_hits += 1;
        meter.at(Stage::Shade);
        let met = self.met(ray, hit, memory);
        let inside = memory.media.start(&self.around_eye);
        let sent = PathState { ray: *ray, travelled: 0.0, weight: 1.0, generation: 0, inside };
        let light = self.light(&sent, &met, memory, meter);
        View { light, seen: Some(PrimaryHit { t: met.hit.t, object: met.hit.object, normal: met.normal }) }
    }

    /// The surface of the last hit.
    pub(super) fn met(&self, ray: &Ray, hit: Hit, memory: &Memory<E>) -> SurfaceInteraction {
        let hit = self.shown(hit, memory);
        let normal = self.assembly.turned_normal(hit.primitive, hit.surface, hit.p, ray.d);
        SurfaceInteraction { hit, p: hit.p, normal }
    }

    /// The light that a surface sends back along the ray that met it, which is the last one traced.
    pub(super) fn light(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let finish = self.finish(&met.hit);
        if finish.kr > 0.0 || finish.kt > 0.0 {
            let change = self.change(&sent.inside, memory);
            let own = self.own_light(sent, met, memory, meter);
            self.sending_surface(sent, met, &change, own, memory, meter)
        } else {
            self.own_light(sent, met, memory, meter)
        }
    }

    /// `Ia·C + Σ Ip · V · (kd·C·(L·N) + ks·cosⁿθ) / (R + k)`.
    fn own_light(
        &self,
        sent: &PathState,
        met: &SurfaceInteraction,
        memory: &mut Memory<E>,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let finish = self.finish(&met.hit);
        let (p, normal) = (met.p, met.normal);
        let departure = self.departure(&met.hit, p, normal);
        let mut sum = C::DARK;
        for lamp in 0..self.lamps.len() {
            let Some(towards) = self.towards(lamp, p, normal) else { continue };
            let mut share = Self::share(finish, towards.facing, towards.mirrored_cosine(normal, sent.ray.d));
            if self.shadows && (finish.kd > 0.0 || finish.ks > 0.0) {
                let ray = Ray::new(p, towards.d);
                let visible = self.visibility(&ray, departure, towards.distance, memory, meter);
                if visible == 0.0 {
                    continue;
                }
                share = share * visible;
            }
            sum = (sum + self.lamps[lamp].light * share).limited();
        }
        self.gathered(sum, met, sent.travelled + met.hit.t)
    }

    /// The way from a surface to a lamp; `None` where the lamp is behind the surface.
    #[inline]
    pub(super) fn towards(&self, lamp: usize, p: DVec3, normal: DVec3) -> Option<Towards> {
        let way = self.lamps[lamp].at - p;
        let distance = way.length();
        // A light at the very point has no direction; it lights nothing there.
        if distance < NEAREST {
            return None;
        }
        let d = settled(way / distance, WITHIN);
        let facing = d.dot(normal);
        (facing > 0.0).then_some(Towards { d, distance, facing })
    }

    /// `kd·C·(L·N) + ks·cosⁿθ`: the share of a light that a surface sends to where it is seen from.
    #[inline]
    pub(super) fn share(finish: &ResolvedMaterial<C>, facing: f64, cosine: f64) -> C {
        let share = finish.color * (finish.kd * facing);
        if finish.ks > 0.0 && cosine > 0.0 {
            share + C::from_rgb(DVec3::ONE) * (finish.ks * power(cosine, finish.n))
        } else {
            share
        }
    }

    /// The light of a surface, from the sum over all lamps and the whole way from the eye.
    #[inline]
    pub(super) fn gathered(&self, sum: C, met: &SurfaceInteraction, way: f64) -> C {
        let sum = match self.depth {
            Some(k) => (sum / (way * self.assembly.scene_frame.unit + k)).limited(),
            None => sum,
        };
        (self.ambient * self.finish(&met.hit).color + sum).limited()
    }

    /// The material of the surface that was hit.
    pub(super) fn finish(&self, hit: &Hit) -> &ResolvedMaterial<C> {
        self.finish_of(hit.primitive)
    }

    /// The material of a primitive.
    pub(super) fn finish_of(&self, primitive: u32) -> &ResolvedMaterial<C> {
        &self.finishes[self.assembly.material(primitive).0 as usize]
    }

    /// Whether a primitive is a surface that bounds no solid: it has no inside to be in.
    pub(super) fn is_surface(&self, primitive: u32) -> bool {
        self.assembly.primitives[primitive as usize].form.is_surface()
    }

    /// The surface that a ray leaves to the side to which `toward` points.
    pub(super) fn departure(&self, hit: &Hit, p: DVec3, toward: DVec3) -> Departure {
        let form: &WorldShape = &self.assembly.primitives[hit.primitive as usize].form;
        let inward = form.normal(p, hit.surface).dot(toward) < 0.0;
        Departure { primitive: hit.primitive, surface: hit.surface, inward, off: form.off() }
    }
}

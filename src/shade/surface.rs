//! The light that a surface sends to the eye.

use crate::math::{DVec3, Ray};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::solid::{Assembly, Departure, Form};
use crate::stage::{Meter, Probe, Stage};
use crate::trace::{Engine, Hit};

use super::channel::Channel;

/// Shades hits of one picture.
#[derive(Debug)]
pub struct Shader<'a, E, C> {
    engine: &'a E,
    assembly: &'a Assembly,
    finishes: Vec<Finish<C>>,
    lamps: Vec<Lamp<C>>,
    ambient: C,
    background: C,
    depth: Option<f64>,
    highlight: bool,
    shadows: bool,
}

/// A material, ready for the channels that are computed.
#[derive(Clone, Copy, Debug)]
struct Finish<C> {
    color: C,
    kd: f64,
    ks: f64,
    n: f64,
}

/// A light in the assembly's coordinates.
#[derive(Clone, Copy, Debug)]
struct Lamp<C> {
    at: DVec3,
    light: C,
}

/// What a ray from the eye saw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<C> {
    /// The light.
    pub light: C,
    /// The surface; absent where nothing was met.
    pub seen: Option<Seen>,
}

/// A surface that was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Distance from the eye, in the assembly's unit.
    pub t: f64,
    /// The object's index in the assembly.
    pub object: u32,
    /// The normal, turned to the eye's side, length 1.
    pub normal: DVec3,
}

impl<'a, E: Engine, C: Channel> Shader<'a, E, C> {
    /// A shader for a planned picture.
    pub fn new(scene: &Scene, assembly: &'a Assembly, plan: &Plan, engine: &'a E) -> Self {
        let finishes = scene.materials.iter().map(|m| Finish {
            color: C::from_rgb(m.color),
            kd: m.kd,
            ks: m.ks,
            n: m.n,
        });
        let lamps = plan
            .lamps
            .iter()
            .map(|l| Lamp { at: assembly.datum.inward_near(l.at), light: C::from_rgb(l.light) });
        Self {
            engine,
            assembly,
            finishes: finishes.collect(),
            lamps: lamps.collect(),
            ambient: C::from_rgb(scene.world.ambient),
            background: C::from_rgb(scene.world.background),
            depth: plan.depth.map(|k| k / assembly.datum.unit),
            highlight: plan.highlight,
            shadows: plan.shadows,
        }
    }

    /// What a ray from the eye sees. `ray` is in the assembly's coordinates.
    pub fn view(&self, ray: &Ray, memory: &mut E::Memory, meter: &mut Meter<impl Probe>) -> View<C> {
        meter.counts.primary_rays += 1;
        let Some(hit) = self.engine.first(ray, memory, meter) else {
            return View { light: self.background, seen: None };
        };
        meter.counts.primary_hits += 1;
        meter.at(Stage::Shade);
        let p = ray.at(hit.t);
        let normal = self.assembly.turned_normal(hit.primitive, hit.surface, p, ray.d);
        let light = self.surface(ray, &hit, p, normal, memory, meter);
        View { light, seen: Some(Seen { t: hit.t, object: hit.object, normal }) }
    }

    /// `Ia·C + Σ Ip · V · (kd·C·(L·N) + ks·cosⁿθ) / (R + k)`.
    fn surface(
        &self,
        ray: &Ray,
        hit: &Hit,
        p: DVec3,
        normal: DVec3,
        memory: &mut E::Memory,
        meter: &mut Meter<impl Probe>,
    ) -> C {
        let finish = &self.finishes[self.assembly.material(hit.primitive).0 as usize];
        let departure = self.departure(hit, p, normal);
        let mut sum = C::DARK;
        for lamp in &self.lamps {
            let way = lamp.at - p;
            let distance = way.length();
            let to_light = way / distance;
            let facing = to_light.dot(normal);
            // A light at the very point has no direction; it lights nothing there.
            if facing.is_nan() || facing <= 0.0 {
                continue;
            }
            let mut share = finish.color * (finish.kd * facing);
            if self.highlight && finish.ks > 0.0 {
                let mirrored = 2.0 * facing * normal - to_light;
                let cos = -mirrored.dot(ray.d);
                if cos > 0.0 {
                    share = share + C::from_rgb(DVec3::ONE) * (finish.ks * libm::pow(cos, finish.n));
                }
            }
            if self.shadows && (finish.kd > 0.0 || finish.ks > 0.0) {
                meter.counts.shadow_rays += 1;
                let shadow = Ray::new(p, to_light);
                let blocked = self.engine.blocked(&shadow, departure, distance, memory, meter);
                meter.at(Stage::Shade);
                if blocked {
                    meter.counts.shadow_hits += 1;
                    continue;
                }
            }
            sum = sum + lamp.light * share;
        }
        if let Some(k) = self.depth {
            sum = sum * (1.0 / (hit.t + k) / self.assembly.datum.unit);
        }
        self.ambient * finish.color + sum
    }

    /// The surface that a ray leaves to the side of the turned normal.
    fn departure(&self, hit: &Hit, p: DVec3, normal: DVec3) -> Departure {
        let form: &Form = &self.assembly.primitives[hit.primitive as usize].form;
        let inward = form.normal(p, hit.surface).dot(normal) < 0.0;
        Departure { primitive: hit.primitive, surface: hit.surface, inward }
    }
}

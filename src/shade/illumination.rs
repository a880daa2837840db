//! What light a picture has: its materials and lamps, and the terms of the illumination equations that are
//! computed.

use crate::math::{Bounds, DVec3};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::solid::{Assembly, Departure, WorldShape};
use crate::trace::{Hit, OpacityClass};

use super::channel::Channel;
use super::interaction::SurfaceInteraction;
use super::lamp::Lamp;
use super::lit::Gathering;
use super::material::ResolvedMaterial;
use super::media::Medium;

/// The materials and lamps of one picture, and the terms that are computed.
#[derive(Debug)]
pub(crate) struct Illumination<'a, C> {
    pub assembly: &'a Assembly,
    /// By number.
    pub materials: Vec<ResolvedMaterial<C>>,
    pub lamps: Vec<Lamp<C>>,
    pub ambient: C,
    pub background: C,
    /// The constant of the depth term, in the scene's unit.
    pub depth: Option<f64>,
    pub shadows: bool,
    /// Whether light can come through anything.
    pub glass: bool,
    /// By object; empty where light comes through nothing.
    pub opacity: Vec<OpacityClass>,
    /// By object: a box around its opaque parts where others are glass; empty where light comes through
    /// nothing.
    pub dark: Vec<Bounds>,
    /// By primitive: the share of light that its material lets through; empty where none does.
    pub lets_through: Vec<f64>,
    /// The glass that the eye is in.
    pub around_eye: Vec<Medium>,
}

impl<'a, C: Channel> Illumination<'a, C> {
    /// That of a planned picture.
    pub fn new(scene: &Scene, assembly: &'a Assembly, plan: &Plan) -> Self {
        let if_planned = |planned: bool, share: f64| if planned { share } else { 0.0 };
        let materials = scene.materials.iter().map(|m| ResolvedMaterial {
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
        let around_eye = plan.secondary.iter().flat_map(|s| &s.around_eye);
        Self {
            assembly,
            materials: materials.collect(),
            lamps: lamps.collect(),
            ambient: C::source(scene.world.ambient),
            background: C::source(scene.world.background),
            depth: plan.depth,
            shadows: plan.shadows,
            glass: plan.glass,
            opacity: (0..if_glass(assembly.objects.len())).map(opacity).collect(),
            dark: (0..if_glass(assembly.objects.len())).map(dark).collect(),
            lets_through: (0..if_glass(assembly.primitives.len())).map(kt).collect(),
            around_eye: around_eye.map(|&(object, index)| Medium { object, index }).collect(),
        }
    }

    /// From the sums over all lamps to the light of surfaces of one material.
    #[inline]
    pub fn gathering(&self, material: &ResolvedMaterial<C>) -> Gathering<C> {
        let unit = self.assembly.scene_frame.unit;
        Gathering { depth: self.depth, unit, ambient: self.ambient * material.color }
    }

    /// The material of a primitive.
    #[inline]
    pub fn material_of(&self, primitive: u32) -> &ResolvedMaterial<C> {
        &self.materials[self.assembly.material(primitive).0 as usize]
    }

    /// The material of a surface that was met.
    #[inline]
    pub fn material_at(&self, met: &SurfaceInteraction) -> &ResolvedMaterial<C> {
        self.material_of(met.hit.primitive)
    }

    /// Whether a primitive is a surface that bounds no solid: it has no inside to be in.
    pub fn is_surface(&self, primitive: u32) -> bool {
        self.assembly.primitives[primitive as usize].form.is_surface()
    }

    /// The surface that a ray leaves to the side to which `toward` points.
    pub fn departure(&self, hit: &Hit, p: DVec3, toward: DVec3) -> Departure {
        let form: &WorldShape = &self.assembly.primitives[hit.primitive as usize].form;
        let inward = form.normal(p, hit.surface).dot(toward) < 0.0;
        Departure { primitive: hit.primitive, surface: hit.surface, inward, place_error: form.place_error() }
    }
}

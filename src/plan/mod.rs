//! What a picture requires: the scene, the view and the options, compiled. What can not change the picture is
//! left out here, once, and not asked about again for every dot.

mod cost;
mod explain;
mod options;
mod precision;
mod reasons;

pub use cost::{Cost, Sample};
pub use explain::{StagePlan, Term};
pub use options::{
    CUTOFF, DEPTH, ERROR, EngineChoice, Options, OptionsError, PrecisionChoice, Shading, StructureChoice,
};
pub use precision::Precision;
pub use reasons::Reasons;

use crate::math::DVec3;
use crate::scene::{Anchor, Light, Material, Scene};
use crate::solid::Assembly;
use crate::view::PinholeCamera;

use precision::PrecisionReason;
use reasons::{Absent, Cut};

/// The least error of a dot, as a share of a level, that any number of rays is spent on.
const LEAST_ERROR: f64 = 1e-3;

/// Everything that the later stages need to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How space is cut: what was asked for, or what suits the scene; never [`StructureChoice::Auto`].
    /// Whether a lattice can be had within its budget shows when it is built.
    pub structure: StructureChoice,
    /// What traces; never [`EngineChoice::Auto`]. Where it is [`EngineChoice::Fast`], the structure is
    /// [`StructureChoice::Boxes`].
    pub engine: EngineChoice,
    /// In which precision it asks what rays from the eye meet.
    pub precision: Precision,
    /// The constant of the depth term, in the scene's unit; absent where the division is left out.
    pub depth: Option<f64>,
    /// Whether any surface has a highlight that this shading model shows.
    pub highlight: bool,
    /// Mirror and Snell rays; absent where no surface sends any or the shading model has none.
    pub secondary: Option<Secondary>,
    /// Whether any solid lets light through: if not, a light is hidden by whatever stands before it.
    pub glass: bool,
    /// Whether lights are tested for what stands before them.
    pub shadows: bool,
    /// Three where lights have colours, or surfaces have and the colours are wanted. Else light is one gray
    /// channel, which is exact: a gray light on a coloured surface is as bright as on a gray one of the same
    /// luminance.
    pub channels: Channels,
    /// The lights, where they stand for this view, in the scene's coordinates. Those of no intensity are left
    /// out.
    pub lamps: Vec<Lamp>,
    /// Rays per dot along each axis.
    pub samples: u32,
    /// The error that dots are left with, as a share of a level, where they get as many rays as that needs.
    pub adaptive: Option<f64>,
    /// Why each of these is as it is.
    pub reasons: Reasons,
}

/// What decides how far mirror and Snell rays are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Secondary {
    /// Generations after the rays from the eye.
    pub generations: u32,
    /// A ray whose light counts less than this is not followed.
    pub least_weight: f64,
    /// The glass objects that the eye is in, by their index in the assembly, in file order, with their index
    /// of refraction.
    pub around_eye: Vec<(u32, f64)>,
}

impl Secondary {
    fn new(
        scene: &Scene,
        assembly: &Assembly,
        pinhole: &PinholeCamera,
        options: &Options,
        lamps: &[Lamp],
    ) -> Self {
        // A ray of weight w changes its dot by w at most, unless something in the scene is brighter than
        // white.
        let sources =
            [scene.world.ambient, scene.world.background].into_iter().chain(lamps.iter().map(|l| l.light));
        let brightest = sources.map(DVec3::max_element).fold(1.0, f64::max);
        let eye = assembly.scene_frame.inward_near(pinhole.eye);
        let kt = |primitive: &u32| scene.materials[assembly.material(*primitive).0 as usize].kt > 0.0;
        let glass = scene.materials.iter().any(|m| m.kt > 0.0);
        let objects = if glass { assembly.objects.len() as u32 } else { 0 };
        let around_eye = (0..objects)
            .filter(|&object| assembly.contains(object, eye))
            .filter_map(|object| {
                // Should its surfaces differ, the one that is crossed on the way out has the last word.
                let first = assembly.primitives_of(object).into_iter().find(kt)?;
                Some((object, scene.materials[assembly.material(first).0 as usize].index))
            })
            .collect();
        Self { generations: options.depth, least_weight: options.cutoff / brightest, around_eye }
    }
}

/// How many channels of light are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channels {
    /// The luminance.
    Gray,
    /// The three primaries.
    Three,
}

/// A light in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Where it stands, in the scene's coordinates.
    pub at: DVec3,
    /// Intensity times colour.
    pub light: DVec3,
}

impl Plan {
    /// Compiles one picture.
    pub fn new(scene: &Scene, assembly: &Assembly, pinhole: &PinholeCamera, options: &Options) -> Self {
        let from_model = |least: Shading| {
            if options.shading >= least { Ok(()) } else { Err(Absent::InModel(options.shading)) }
        };
        let first = |has: fn(&Material) -> bool| scene.materials.iter().position(has);
        let lamps: Vec<Lamp> = if scene.lights.is_empty() {
            Light::defaults().iter().map(|light| lamp(light, pinhole)).collect()
        } else {
            scene.lights.iter().filter(|l| l.intensity > 0.0).map(|light| lamp(light, pinhole)).collect()
        };
        let lit = if lamps.is_empty() { Err(Absent::Light) } else { Ok(()) };
        let engine = options.traced_by();
        let (structure, cut) = suitable(assembly, options.structure, engine);
        let secondary = from_model(Shading::Whitted)
            .and_then(|()| first(|m| m.kr > 0.0 || m.kt > 0.0).ok_or(Absent::MirrorOrGlass));
        let shadows = if options.shadows { lit } else { Err(Absent::Wish) };
        let sends_on = secondary.is_ok() || shadows.is_ok();
        let reasons = Reasons {
            cut,
            digital: PrecisionReason::of(assembly, pinhole, options, (engine, sends_on)),
            shading: options.shading,
            depth: from_model(Shading::Depth).and_then(|()| scene.world.k.ok_or(Absent::DepthConstant)),
            highlight: from_model(Shading::Phong)
                .and(lit)
                .and_then(|()| first(|m| m.ks > 0.0).ok_or(Absent::Highlight)),
            secondary,
            shadows,
            colored: colored(scene, &lamps, options.color),
            color_wanted: options.color,
        };
        Self {
            structure,
            engine,
            precision: reasons.digital.precision(),
            depth: reasons.depth.ok(),
            highlight: reasons.highlight.is_ok(),
            secondary: (reasons.secondary.ok())
                .map(|_| Secondary::new(scene, assembly, pinhole, options, &lamps)),
            glass: first(|m| m.kt > 0.0).is_some(),
            shadows: reasons.shadows.is_ok(),
            channels: if reasons.colored.is_some() { Channels::Three } else { Channels::Gray },
            lamps,
            samples: if options.adaptive.is_some() { 1 } else { options.samples.max(1) },
            adaptive: options.adaptive.map(|error| error.max(LEAST_ERROR)),
            reasons,
        }
    }
}

/// The first thing with a colour that would be lost in one channel.
///
/// Light of a colour on a surface of another is what one number can not say: where every lamp and the light
/// all around are gray, the luminance of a surface's light is theirs times that of its colour. The background
/// is only ever weakened, by numbers. So both, surfaces and background, count where colours are wanted.
fn colored(scene: &Scene, lamps: &[Lamp], wanted: bool) -> Option<&'static str> {
    let shining =
        lamps.iter().map(|l| ("a light", l.light)).chain([("the ambient light", scene.world.ambient)]);
    let surfaces = scene.materials.iter().map(|m| ("a material", m.color));
    let seen = surfaces.chain([("the background", scene.world.background)]).filter(|_| wanted);
    let is_gray = |c: DVec3| c.x == c.y && c.y == c.z;
    shining.chain(seen).find(|&(_, c)| !is_gray(c)).map(|(what, _)| what)
}

/// Up to so many objects, of so many primitives in all, are tested one ray at a time as fast as a structure
/// says which of them to test: measured on solids of OpenSCAD.
const FEW_OBJECTS: usize = 2;
const FEW_PRIMITIVES: usize = 8;

fn suitable(assembly: &Assembly, choice: StructureChoice, engine: EngineChoice) -> (StructureChoice, Cut) {
    let few = assembly.objects.len() <= FEW_OBJECTS && assembly.primitives.len() <= FEW_PRIMITIVES;
    match (engine, choice) {
        (EngineChoice::Fast, StructureChoice::Boxes) => (StructureChoice::Boxes, Cut::Asked),
        (EngineChoice::Fast, _) => (StructureChoice::Boxes, Cut::ForTiles),
        (_, StructureChoice::Auto) if few => (StructureChoice::None, Cut::Few),
        (_, StructureChoice::Auto) => (StructureChoice::Boxes, Cut::Many),
        (_, asked) => (asked, Cut::Asked),
    }
}

fn lamp(light: &Light, pinhole: &PinholeCamera) -> Lamp {
    let at = match light.anchor {
        Anchor::World(p) => p,
        Anchor::Eye(p) => pinhole.place(p),
    };
    Lamp { at, light: light.intensity * light.color }
}

//! Why a plan is as it is, stage by stage, in the words of the scene.

use crate::math::Size;
use crate::scene::Scene;
use crate::solid::{Assembly, Body, CsgTree, WorldShape};
use crate::stage::Stage;
use crate::view::PinholeCamera;

use super::precision::{Precision, PrecisionReason};
use super::reasons::{Absent, Cut};
use super::{Channels, Cost, EngineChoice, Plan, StructureChoice};

/// What a plan says of one stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StagePlan {
    /// The stage.
    pub stage: Stage,
    /// Whether the stage can do anything to this picture.
    pub needed: bool,
    /// Why it is needed, or why not: one line.
    pub why: String,
    /// What it is expected to cost; absent where that is nothing, next to nothing, or part of another
    /// stage's.
    pub cost: Option<Cost>,
    /// The parts of the stage that are decided on singly; none where the stage itself is left out.
    pub terms: Vec<Term>,
}

/// A part of a stage, such as the highlight of the illumination equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// A word or two.
    pub name: &'static str,
    /// Whether it is computed.
    pub needed: bool,
    /// Why, or why not: one line.
    pub why: String,
}

impl Absent {
    fn words(self) -> String {
        match self {
            Self::InModel(model) => format!("eq. ({}) has no such term", model.number()),
            Self::DepthConstant => "the world gives no k".into(),
            Self::Light => "no light shines".into(),
            Self::Highlight => "no material has ks".into(),
            Self::MirrorOrGlass => "no mirror or glass".into(),
            Self::Wish => "not wanted".into(),
        }
    }
}

impl Plan {
    /// Stages 1 to 9, in order, of a picture of `dots`. What comes after them is not for the plan to
    /// decide. `scene`, `assembly` and `pinhole` are those that the plan was made from.
    pub fn explain(
        &self,
        scene: &Scene,
        assembly: &Assembly,
        pinhole: &PinholeCamera,
        dots: Size,
    ) -> Vec<StagePlan> {
        let kinds = Kinds::of(assembly);
        let stage =
            |stage, needed, why: String| StagePlan { stage, needed, why, cost: None, terms: Vec::new() };
        let nothing = || "no object holds anything → no ray meets one".to_owned();
        let is_empty = assembly.objects.is_empty();
        let inside = assembly.limit.contains(assembly.scene_frame.inward(pinhole.eye));
        let is_cut = self.structure != StructureChoice::None;
        let [across, down] = pinhole.field();
        let walk = match (is_empty, is_cut) {
            (true, _) => nothing(),
            (false, true) if self.engine == EngineChoice::Fast => {
                "rays side by side, 32 × 32 in a tile, through CELL, SOLID and CSG at once; others alone"
                    .into()
            }
            (false, true) => {
                "one ray after the other; it meets only what reaches into the cells on its way".into()
            }
            (false, false) => "no structure → no cells: every ray meets every object".into(),
        };
        let clip = if inside {
            "the eye is in the world → no ray can miss it"
        } else if is_empty {
            "the world is empty → every ray ends here"
        } else if self.engine == EngineChoice::Fast {
            "the eye is outside the world → rays start near it, and a tile that misses its boxes ends"
        } else {
            "the eye is outside the world → a ray that misses its box ends here"
        };
        let mut shade = stage(Stage::Shade, !is_empty, if is_empty { nothing() } else { self.lights(scene) });
        if !is_empty {
            shade.terms = self.terms(scene);
        }
        let mut solid =
            stage(Stage::Solid, !is_empty, if is_empty { nothing() } else { kinds.forms_words() });
        if !is_empty {
            solid.terms = vec![self.digits()];
        }
        vec![
            stage(Stage::Objects, true, kinds.objects_words(scene)),
            stage(Stage::Lattice, is_cut, self.cut_words(&kinds)),
            stage(Stage::View, true, format!("a field of {across:.1}° × {down:.1}°")),
            stage(Stage::Ray, true, self.rays(dots)),
            stage(Stage::Clip, !inside, clip.into()),
            stage(Stage::Cell, is_cut && !is_empty, walk),
            solid,
            stage(Stage::Csg, kinds.composites() > 0, kinds.csg_words()),
            shade,
        ]
    }

    fn digits(&self) -> Term {
        let why = match self.reasons.digital {
            PrecisionReason::Asked(precision) => format!("{} precision is wanted", precision.name()),
            PrecisionReason::Exact => "the exact engine has double precision → f64".into(),
            PrecisionReason::SentOn => "rays start on what is hit → f64".into(),
            PrecisionReason::NoGain => {
                "of balls, surfaces and meshes that are cut it saves nothing → f64".into()
            }
            PrecisionReason::Thin => {
                "a primitive is so thin that most rays would be asked twice → f64".into()
            }
            PrecisionReason::Many => "24 bits can not number so many primitives → f64".into(),
            PrecisionReason::Near => "the eye may be as near to a solid as can be → f64".into(),
            PrecisionReason::Dots(dots) => format!("a hit would be off by up to {dots:.2} dots → f64"),
            PrecisionReason::Unseen(dots) => {
                format!("a hit is off by {dots:.4} dots at most → f32, and f64 where that is uncertain")
            }
        };
        Term { name: "f32", needed: self.precision == Precision::Single, why }
    }

    fn cut_words(&self, kinds: &Kinds) -> String {
        let objects = count(kinds.objects, "object");
        match (self.reasons.cut, self.structure) {
            (Cut::Few, _) => {
                format!("{objects} of {} → no structure", count(kinds.primitives, "primitive"))
            }
            (Cut::Many, _) => {
                format!("{objects} of {} → boxes, eight side by side", count(kinds.primitives, "primitive"))
            }
            (Cut::ForTiles, _) => {
                format!("{objects} of {}, traced in tiles → boxes", count(kinds.primitives, "primitive"))
            }
            (Cut::Asked, StructureChoice::None) => "no structure is wanted".into(),
            (Cut::Asked, StructureChoice::Tree) => format!("{objects}, a tree is wanted"),
            (Cut::Asked, StructureChoice::Boxes) => format!("{objects}, boxes are wanted"),
            (Cut::Asked, _) => format!("{objects}, a lattice is wanted"),
        }
    }

    fn rays(&self, dots: Size) -> String {
        let size = format!("{} × {} dots", dots.width, dots.height);
        match (self.samples, self.adaptive) {
            (_, Some(error)) => format!(
                "{size}, a ray through the middle of each, and more where its level is not decided within {error} of a level"
            ),
            (1, None) => format!("{size}, a ray through the middle of each"),
            (n, None) => format!("{size}, {} rays through each", u64::from(n).pow(2)),
        }
    }

    fn lights(&self, scene: &Scene) -> String {
        let model = format!("eq. ({})", self.reasons.shading.number());
        let lights = count(self.lamps.len(), "light");
        let dark = scene.lights.len().saturating_sub(self.lamps.len());
        match (scene.lights.len(), dark) {
            (0, _) => format!("{model}; the scene has no light → {lights} that move with the eye"),
            (_, 0) => format!("{model}, {lights}"),
            (_, dark) => format!("{model}, {lights}; {dark} of no intensity left out"),
        }
    }

    fn terms(&self, scene: &Scene) -> Vec<Term> {
        let reasons = &self.reasons;
        let named = |index: usize| match &scene.materials[index].name {
            Some(name) => format!("material \"{name}\""),
            None => "a material".to_owned(),
        };
        let depth = reasons.depth.map(|k| format!("the world gives k = {k} → light is divided by R + k"));
        let highlight = reasons.highlight.map(|index| format!("{} has ks", named(index)));
        let shadows = reasons.shadows.map(|()| {
            let glass = if self.glass {
                "glass lets light through"
            } else {
                "no glass → the first thing met is enough"
            };
            format!("{} can be hidden; {glass}", count(self.lamps.len(), "light"))
        });
        let secondary = reasons.secondary.map(|index| {
            let material = &scene.materials[index];
            let share = if material.kr > 0.0 { "kr" } else { "kt" };
            let generations = self.secondary.as_ref().map_or(0, |s| s.generations);
            format!("{} has {share} → up to {}", named(index), count(generations as usize, "generation"))
        });
        let channels = match (reasons.colored, reasons.color_wanted) {
            (Some(what), _) => format!("{what} is coloured → three channels"),
            (None, true) => "every light, material and the background are gray → one channel".into(),
            (None, false) => "every light is gray → one channel".into(),
        };
        vec![
            term("depth", depth, "no division by R + k"),
            term("highlight", highlight, "no highlight"),
            term("shadow rays", shadows, "no shadow rays"),
            term("secondary rays", secondary, "no secondary rays"),
            Term { name: "colour", needed: self.channels == Channels::Three, why: channels },
        ]
    }
}

fn term(name: &'static str, decided: Result<String, Absent>, else_none: &str) -> Term {
    let needed = decided.is_ok();
    let why = decided.unwrap_or_else(|absent| format!("{} → {else_none}", absent.words()));
    Term { name, needed, why }
}

/// How many there are of each kind of object and primitive.
struct Kinds {
    objects: usize,
    primitives: usize,
    meshes: usize,
    surfaces: usize,
    /// Objects with a CSG expression.
    expressions: usize,
    /// Objects that are a mesh alone.
    lone_meshes: usize,
}

impl Kinds {
    fn of(assembly: &Assembly) -> Self {
        let forms = |is: fn(&WorldShape) -> bool| assembly.primitives.iter().filter(|p| is(&p.form)).count();
        let bodies = |is: fn(&Body) -> bool| assembly.objects.iter().filter(|o| is(&o.body)).count();
        let composites = bodies(|b| matches!(b, Body::Composite { .. }));
        let lone_meshes =
            bodies(|b| matches!(b, Body::Composite { tree, .. } if matches!(**tree, CsgTree::Leaf(_))));
        Self {
            objects: assembly.objects.len(),
            primitives: assembly.primitives.len(),
            meshes: forms(|f| matches!(f, WorldShape::Mesh(_))),
            surfaces: forms(WorldShape::is_surface),
            expressions: composites - lone_meshes,
            lone_meshes,
        }
    }

    fn composites(&self) -> usize {
        self.expressions + self.lone_meshes
    }

    fn objects_words(&self, scene: &Scene) -> String {
        let words = format!("{} of {}", count(self.objects, "object"), count(self.primitives, "primitive"));
        match scene.objects.len() - self.objects {
            0 => words,
            empty => format!("{words}; {empty} that hold nothing left out"),
        }
    }

    fn forms_words(&self) -> String {
        let convex = self.primitives - self.meshes - self.surfaces;
        let kinds = [
            (convex, format!("{}, one interval each", count(convex, "convex primitive"))),
            (self.meshes, if self.meshes == 1 { "1 mesh".into() } else { format!("{} meshes", self.meshes) }),
            (self.surfaces, format!("{}, one point each", count(self.surfaces, "surface"))),
        ];
        let present: Vec<String> =
            kinds.into_iter().filter(|(n, _)| *n > 0).map(|(_, words)| words).collect();
        present.join("; ")
    }

    fn csg_words(&self) -> String {
        match (self.expressions, self.lone_meshes) {
            (0, 0) => "no object is made of several primitives → no CSG".into(),
            (n, 0) => format!("{} made of several primitives", of_all(n, self.objects)),
            (0, m) => format!("{} a mesh of several intervals", of_all(m, self.objects)),
            (n, m) => {
                format!("{} made of several primitives, {m} a mesh alone", of_all(n, self.objects))
            }
        }
    }
}

fn of_all(some: usize, all: usize) -> String {
    match (some, all) {
        (1, 1) => "the only object is".into(),
        (1, _) => format!("1 of {all} objects is"),
        _ => format!("{some} of {all} objects are"),
    }
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

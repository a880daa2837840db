//! What a picture is expected to cost, before it is drawn.
//!
//! As a database does for a query: how many rays of each kind there will be, times what one of them costs. Both are rough.
//! Where the objects' boxes stand in the picture is looked at, what stands in them is not.

use crate::math::{Bounds, Ray, Size};
use crate::scene::Scene;
use crate::solid::{Assembly, Body};
use crate::stage::Stage;
use crate::view::Lens;

use super::{EngineChoice, Plan, StructureChoice};

/// What a stage is expected to cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// How often its work is done.
    pub count: f64,
    /// What is counted.
    pub of: &'static str,
    /// What one of them takes, in nanoseconds of one thread.
    pub each: f64,
    /// Whether threads share the work.
    pub shared: bool,
}

impl Cost {
    /// Milliseconds on so many threads, 1 or more.
    pub fn ms(&self, threads: usize) -> f64 {
        self.count * self.each / 1e6 / if self.shared { threads.max(1) as f64 } else { 1.0 }
    }
}

/// Rays along each side of the picture that are held against the objects' boxes.
const LOOKS: u32 = 16;

/// Of more objects some are looked at for all: 16 × 16 rays against so many boxes take some milliseconds.
const LOOKED_AT: usize = 4096;

// Shares, each the middle of what `--stats json` counts on the scenes inside the program and Haines's.

/// Primitives of one object that a ray is tested against at most: the others are not where it passes.
const SLICED: f64 = 4.0;
/// Of the rays that pass the box of an object, those that meet one.
const MEETS: f64 = 0.75;
/// Of the mirror and Snell rays, those that meet something.
const SENT_MEETS: f64 = 0.7;
/// Of the lights, those that a surface faces.
const FACES: f64 = 0.7;

// Nanoseconds of one thread, each the middle of what `--stats json --threads 1` shows on the same scenes, on a server
// processor of 2024 with AVX-512.

/// An object in boxes, and in a lattice or tree. Sub-lattices are not foreseen.
const BUILD_BOXES: f64 = 250.0;
const BUILD_CELLS: f64 = 5000.0;
/// A ray from the eye, alone and in a bundle.
const RAY: f64 = 45.0;
const RAY_IN_BUNDLE: f64 = 3.5;
/// Of a ray that goes alone: a cell or a node on its way, a primitive, an expression. By the exact engine, and by the fast one,
/// which has many on their way at once.
const CELL: f64 = 28.0;
const TEST: f64 = 35.0;
const EVALUATION: f64 = 45.0;
const CELL_ABREAST: f64 = 16.0;
const TEST_ABREAST: f64 = 8.0;
const EVALUATION_ABREAST: f64 = 10.0;
/// Of a ray in a bundle: its share of the walk where that ends at once, and where it does not; and a primitive, with its
/// expression.
const PAST_IN_BUNDLE: f64 = 1.0;
const WALK_IN_BUNDLE: f64 = 14.0;
const TEST_IN_BUNDLE: f64 = 5.0;
/// A surface that is met, and a light on it.
const SURFACE: f64 = 40.0;
const LIGHT: f64 = 40.0;
const SURFACE_IN_BUNDLE: f64 = 6.0;
const LIGHT_IN_BUNDLE: f64 = 4.0;
/// The same where a ray was sent on, in bundles that are not full.
const SURFACE_OF_SENT: f64 = 25.0;
const LIGHT_OF_SENT: f64 = 15.0;

/// The rays of a picture, as far as they can be foreseen.
#[derive(Clone, Copy, Debug)]
struct Rays {
    primary: f64,
    /// Towards lights, from what the eye sees, and from what rays that were sent on meet.
    shadow: f64,
    shadow_of_sent: f64,
    secondary: f64,
    /// Surfaces that are met by rays from the eye, or sent on; and by these alone.
    met: f64,
    met_by_sent: f64,
}

/// What rays pass that are held against the objects' boxes.
#[derive(Clone, Copy, Debug, Default)]
struct Look {
    /// The share of the picture in which a ray passes any.
    share: f64,
    /// How many such a ray passes.
    boxes: f64,
    /// The share of these that have an expression.
    composite: f64,
    /// How many rays the material sends on of what stands first, in the mean.
    sends: f64,
}

impl Plan {
    /// What each stage from LATTICE to SHADE is expected to cost: `None` where it is left out, or is done along with CELL.
    /// `nodes` are the cells or nodes of the structure. The scene and the others are those that the plan was made from.
    pub fn costs(
        &self,
        scene: &Scene,
        assembly: &Assembly,
        lens: &Lens,
        dots: Size,
        nodes: usize,
    ) -> impl Fn(Stage) -> Option<Cost> + use<> {
        let look = look(scene, assembly, lens, dots);
        let rays = self.rays_of(scene, assembly, &look, dots);
        let objects = assembly.objects.len() as f64;
        let fast = self.engine == EngineChoice::Fast;
        let whole = self.structure == StructureChoice::None;
        let lamps = self.lamps.len() as f64;
        let build = if self.structure == StructureChoice::Boxes { BUILD_BOXES } else { BUILD_CELLS };
        let leaves = (assembly.primitives.len() as f64 / objects.max(1.0)).min(SLICED);
        let sent = rays.secondary + rays.shadow_of_sent;
        let alone = if fast { sent } else { rays.primary + rays.shadow + sent };
        let together = if fast { rays.primary + rays.shadow } else { 0.0 };
        // A ray ends at what it meets, about halfway.
        let asked = if whole { objects } else { 0.5 * (1.0 + look.boxes) };
        let (tests, evaluations) = (alone * asked * leaves, alone * asked * look.composite);
        // Eight ways at each node.
        let steps = 1.0 + libm::log2(nodes.max(1) as f64);
        let tile = WALK_IN_BUNDLE + TEST_IN_BUNDLE * asked * leaves;
        let (ways, of_ways, walked) = if fast {
            let near = rays.primary * look.share + rays.shadow;
            let past = rays.primary * PAST_IN_BUNDLE;
            (together + alone, "ray", past + near * tile + alone * steps * CELL_ABREAST)
        } else {
            (alone * steps, "step", alone * steps * CELL)
        };
        let (test, evaluation) = if fast { (TEST_ABREAST, EVALUATION_ABREAST) } else { (TEST, EVALUATION) };
        let shade = if fast {
            let first = rays.met - rays.met_by_sent;
            let shaded = first * (SURFACE_IN_BUNDLE + lamps * LIGHT_IN_BUNDLE)
                + rays.met_by_sent * (SURFACE_OF_SENT + lamps * LIGHT_OF_SENT);
            if rays.met > 0.0 { shaded / rays.met } else { 0.0 }
        } else {
            SURFACE + lamps * LIGHT
        };
        let of = move |count: f64, of, each: f64| Some(Cost { count, of, each, shared: true });
        let is_empty = assembly.objects.is_empty();
        move |stage| match stage {
            Stage::Lattice if !whole => {
                Some(Cost { count: objects, of: "object", each: build, shared: false })
            }
            Stage::Ray if fast => of(rays.primary, "ray", RAY_IN_BUNDLE),
            Stage::Ray => of(rays.primary, "ray", RAY),
            Stage::Cell if !whole && ways > 0.0 => of(ways, of_ways, walked / ways),
            Stage::Solid if tests > 0.0 => of(tests, "test", test),
            Stage::Csg if evaluations > 0.0 => of(evaluations, "expression", evaluation),
            Stage::Shade if !is_empty => of(rays.met, "surface", shade),
            _ => None,
        }
    }

    fn rays_of(&self, scene: &Scene, assembly: &Assembly, look: &Look, dots: Size) -> Rays {
        let per_dot =
            if self.samples == 1 { 1.0 } else { 1.0 + f64::from(self.samples) * f64::from(self.samples) };
        let primary = dots.area() as f64 * per_dot;
        let first = primary * look.share * MEETS;
        let (mut secondary, mut met) = (0.0, first);
        if let Some(sent) = &self.secondary {
            let shares = assembly.primitives.iter().map(|p| &scene.materials[p.material.0 as usize]);
            let most = shares.map(|m| m.kr.max(m.kt)).fold(0.0, f64::max);
            let (mut rays, mut weight) = (first * look.sends, most);
            for _ in 0..sent.generations {
                if weight < sent.least_weight {
                    break;
                }
                secondary += rays;
                met += rays * SENT_MEETS;
                rays *= SENT_MEETS * look.sends;
                weight *= most;
            }
        }
        let lights = if self.shadows { self.lamps.len() as f64 * FACES } else { 0.0 };
        let (shadow, shadow_of_sent) = (first * lights, (met - first) * lights);
        Rays { primary, shadow, shadow_of_sent, secondary, met, met_by_sent: met - first }
    }
}

/// Holds rays against the objects' boxes.
fn look(scene: &Scene, assembly: &Assembly, lens: &Lens, dots: Size) -> Look {
    let every = assembly.objects.len() / LOOKED_AT + 1;
    let (mut rays, mut boxes, mut composites, mut first, mut sends) = (0_u32, 0_u32, 0_u32, 0_u32, 0_u32);
    for (i, j) in (0..LOOKS).flat_map(|j| (0..LOOKS).map(move |i| (i, j))) {
        let place = |k: u32, side: u32| (f64::from(k) + 0.5) / f64::from(LOOKS) * f64::from(side);
        let ray = assembly.ray(&lens.ray(place(i, dots.width), place(j, dots.height)));
        if passing(&ray, &assembly.limit).is_none() {
            continue;
        }
        let mut nearest = None;
        for (index, object) in assembly.objects.iter().enumerate().step_by(every) {
            let Some(from) = passing(&ray, &object.bounds) else { continue };
            boxes += 1;
            composites += u32::from(matches!(object.body, Body::Composite { .. }));
            if nearest.is_none_or(|(other, _)| from < other) {
                nearest = Some((from, index as u32));
            }
        }
        // Where not all are looked at, a ray through the world is taken to meet one.
        rays += u32::from(nearest.is_some() || every > 1);
        if let Some((_, object)) = nearest
            && let Some(&primitive) = assembly.primitives_of(object).first()
        {
            first += 1;
            let material = &scene.materials[assembly.material(primitive).0 as usize];
            sends += u32::from(material.kr > 0.0) + u32::from(material.kt > 0.0);
        }
    }
    let ratio = |n: u32, of: u32| f64::from(n) / f64::from(of.max(1));
    Look {
        share: ratio(rays, LOOKS * LOOKS),
        boxes: ratio(boxes, rays) * every as f64,
        composite: ratio(composites, boxes),
        sends: ratio(sends, first),
    }
}

/// Where a ray comes to a box that it passes; the last digits do not matter.
fn passing(ray: &Ray, b: &Bounds) -> Option<f64> {
    let (mut from, mut to) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        let [a, z] = [b.lo, b.hi].map(|side| (side[axis] - ray.o[axis]) / ray.d[axis]);
        (from, to) = (f64::max(from, a.min(z)), f64::min(to, a.max(z)));
    }
    (from <= to).then_some(from)
}

//! What the suite asks of an engine, a batch of rays at a time, in the scene's own unit; and the exact
//! engine's answers.

use ray13::frame::{Frame, Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::lattice::{Bvh8, Lattice, Structure, SubLattices, Tree};
use ray13::math::{DVec3, Placement, Ray, Size};
use ray13::plan::{EngineChoice, Options, StructureChoice};
use ray13::scene::{Camera, Primitive, Scene};
use ray13::solid::{Assembly, Departure, ROUNDING, SceneFrame, WORLD};
use ray13::stage::{Meter, Silent};
use ray13::tone::Tone;
use ray13::trace::{Exact, Hit, RayEngine};

/// How space is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    None,
    Lattice,
    Tree,
    Boxes,
}

impl Cut {
    pub const ALL: [Self; 4] = [Self::None, Self::Lattice, Self::Tree, Self::Boxes];
}

/// What a ray met. Lengths are the scene's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub t: f64,
    /// The engine's word for how far `t` may be off.
    pub error: f64,
    /// By its place in the scene, from 0.
    pub object: u32,
    /// By its place in the scene, from 0.
    pub primitive: u32,
    pub surface: u32,
    pub entering: bool,
}

/// A ray that leaves where another one hit.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    pub ray: Ray,
    pub hit: Found,
    pub toward: DVec3,
}

/// Where an engine claims to be right. A row that lies outside of it is skipped, and says so.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// The most radii between the eye and a solid.
    pub distance: f64,
    /// The most sizes of a solid in the size of the world.
    pub world: f64,
    /// The largest ratio between the axes of a solid.
    pub ratio: f64,
    /// The largest power of ten of a scene's size, and the smallest by its negative.
    pub decades: f64,
}

/// An engine under test, over one scene.
pub trait Subject: Sized {
    /// Where it claims to be right.
    const RANGE: Range;

    /// The ways to cut space that make a difference to it; the others would be the same again.
    const CUTS: &'static [Cut];

    /// Makes a scene ready.
    fn new(scene: &Scene, cut: Cut) -> Self;

    /// What each ray of the scene meets first.
    fn first(&self, rays: &[Ray]) -> Vec<Option<Found>>;

    /// What each ray meets that leaves the place of a hit: the engine's own point there, as its shading does.
    fn next(&self, starts: &[Start]) -> Vec<Option<Found>>;

    /// Whether anything stands within a distance of where a ray leaves.
    fn blocked(&self, starts: &[(Start, f64)]) -> Vec<bool>;

    /// Whether a ray that leaves a hit along `toward` goes to the inside of the primitive that was hit.
    fn inward(&self, start: &Start) -> bool;

    /// How far along the axes of a primitive's own coordinates a ray may pass on the other side of its rim
    /// and still be said to meet it, or not to.
    fn rim(&self, primitive: &Primitive, ray: &Ray) -> DVec3;

    /// A picture.
    fn draw(scene: &Scene, camera: &Camera, dots: Size, cut: Cut) -> Frame;
}

/// The reference engine.
#[derive(Debug)]
pub struct ExactEngine {
    pub(crate) assembly: Assembly,
    cut: Cut,
    lattice: Option<Lattice>,
    tree: Tree,
    pub(crate) boxes: Bvh8,
    pub(crate) subs: SubLattices,
}

impl ExactEngine {
    fn structure(&self) -> Structure<'_> {
        match (self.cut, &self.lattice) {
            (Cut::None, _) => Structure::None,
            (Cut::Lattice, Some(lattice)) => Structure::Lattice(lattice, &self.subs),
            (Cut::Boxes, _) => Structure::Boxes(&self.boxes, &self.subs),
            _ => Structure::Tree(&self.tree, &self.subs),
        }
    }

    pub(crate) fn found(&self, hit: Hit) -> Found {
        let unit = self.assembly.scene_frame.unit;
        Found {
            t: hit.t * unit,
            error: hit.error * unit,
            object: self.assembly.objects[hit.object as usize].number,
            primitive: hit.primitive,
            surface: hit.surface,
            entering: hit.entering,
        }
    }

    /// The ray in the assembly, and the departure, of one that leaves a hit.
    pub(crate) fn leaving(&self, start: &Start) -> (Ray, Departure) {
        let p = self.assembly.ray(&start.ray).at(start.hit.t / self.assembly.scene_frame.unit);
        let form = &self.assembly.primitives[start.hit.primitive as usize].form;
        let inward = form.normal(p, start.hit.surface).dot(start.toward) < 0.0;
        let Found { primitive, surface, .. } = start.hit;
        (Ray::new(p, start.toward), Departure { primitive, surface, inward, place_error: form.place_error() })
    }
}

impl Subject for ExactEngine {
    const RANGE: Range = Range { distance: 1e9, world: 1e9, ratio: 1e6, decades: 150.0 };

    const CUTS: &'static [Cut] = &Cut::ALL;

    fn new(scene: &Scene, cut: Cut) -> Self {
        let assembly = Assembly::new(scene).unwrap();
        let (lattice, tree) = (Lattice::new(&assembly).ok(), Tree::new(&assembly));
        let (boxes, subs) = (Bvh8::new(&assembly), SubLattices::new(&assembly));
        Self { assembly, cut, lattice, tree, boxes, subs }
    }

    fn first(&self, rays: &[Ray]) -> Vec<Option<Found>> {
        let engine = Exact::new(&self.assembly, self.structure());
        let (mut memory, mut meter) = (engine.memory(), Meter::new(Silent));
        let mut first = |ray| engine.first(&self.assembly.ray(ray), &mut memory, &mut meter);
        rays.iter().map(|ray| first(ray).map(|hit| self.found(hit))).collect()
    }

    fn next(&self, starts: &[Start]) -> Vec<Option<Found>> {
        let engine = Exact::new(&self.assembly, self.structure());
        let (mut memory, mut meter) = (engine.memory(), Meter::new(Silent));
        let mut next = |start| {
            let (ray, departure) = self.leaving(start);
            engine.next(&ray, departure, &mut memory, &mut meter)
        };
        starts.iter().map(|start| next(start).map(|hit| self.found(hit))).collect()
    }

    fn blocked(&self, starts: &[(Start, f64)]) -> Vec<bool> {
        let engine = Exact::new(&self.assembly, self.structure());
        let (mut memory, mut meter) = (engine.memory(), Meter::new(Silent));
        let mut blocked = |start: &Start, distance: f64| {
            let (ray, departure) = self.leaving(start);
            engine.blocked(
                &ray,
                departure,
                distance / self.assembly.scene_frame.unit,
                &mut memory,
                &mut meter,
            )
        };
        starts.iter().map(|(start, distance)| blocked(start, *distance)).collect()
    }

    fn inward(&self, start: &Start) -> bool {
        self.leaving(start).1.inward
    }

    /// A point of a primitive seems off its place by [`ROUNDING`] of the lengths of the world and of the way
    /// from its origin to the primitive's: that is what is rounded since the ray's start. Where the origin
    /// was moved, the eye's place was rounded too. Along an axis of the primitive's own coordinates that is
    /// multiplied by the length of the inverse map's row.
    ///
    /// A chord that such an error could have made counts as none: on a sphere where the ray passes within
    /// once the error of the silhouette, on the side of a truncated cone within three times, one for each
    /// axis. At an apex a chord through a circle of radius ρ counts as none for ρ² ≤ 3·e·(2ρ + e), up to 6.5
    /// times; rounded up to 7.
    fn rim(&self, primitive: &Primitive, ray: &Ray) -> DVec3 {
        let SceneFrame { origin, unit } = self.assembly.scene_frame;
        let from_origin = primitive.map.translation.distance(origin);
        let eye = if origin == DVec3::ZERO { 0.0 } else { f64::EPSILON * ray.o.distance(origin) };
        let error = ROUNDING * (WORLD * unit + from_origin) + eye;
        // At the ends of f64 only this inverse is one.
        let inverse = Placement::new(&primitive.map).unwrap().inverse;
        DVec3::from_array([0, 1, 2].map(|i| inverse.row(i).length())) * (7.0 * error)
    }

    fn draw(scene: &Scene, camera: &Camera, dots: Size, cut: Cut) -> Frame {
        let structure = match cut {
            Cut::None => StructureChoice::None,
            Cut::Lattice => StructureChoice::Lattice,
            Cut::Tree => StructureChoice::Tree,
            Cut::Boxes => StructureChoice::Boxes,
        };
        drawn(scene, camera, dots, Options { structure, engine: EngineChoice::Exact, ..Options::default() })
    }
}

/// A picture by some options.
pub fn drawn(scene: &Scene, camera: &Camera, dots: Size, options: Options) -> Frame {
    Studio::new(scene.clone()).unwrap().draw(&Request {
        camera: camera.clone(),
        dots,
        dot_aspect: 1.0,
        options,
        wants: Wants::ALL,
        glyphs: GlyphMode::default(),
        palette: Palette::default(),
        tone: Tone::default(),
    })
}

//! Stage 7, SOLID: all objects of a scene, in coordinates of their own.
//!
//! The world's numbers are brought to magnitudes near 1, by a power of two and, where the scene lies far from
//! the origin, a shift: every later bound on rounding then holds at any scale and any distance from the
//! origin.

use rayon::prelude::*;

use crate::math::{Bounds, DAffine3, DVec3, Placement, Ray};
use crate::scene::{self, MaterialId, Scene, Solid};
use crate::stage::{Progress, Task};

use super::ball::Ball;
use super::bezier::BezierSurface;
use super::expression::{CsgTree, Expression};
use super::mesh::TriangleMesh;
use super::primitive::{WorldPrimitive, WorldShape};
use super::span::ROUNDING;

/// Eyes and lights farther away than this, in the assembly's unit, stand here: the square of such a length
/// does not overflow, and seen from the scene, whose size is about 1, the direction is the same within
/// rounding.
const FARTHEST: f64 = 1e100;

/// Objects in a row that one thread looks at: few are done before another thread could begin.
const STRETCH: usize = 4096;

/// Every item, and its number, by `f`; by all threads where they are many.
fn mapped<T: Sync, U: Send>(items: &[T], f: impl Fn(usize, &T) -> U + Sync) -> Vec<U> {
    if items.len() < STRETCH {
        return items.iter().enumerate().map(|(number, item)| f(number, item)).collect();
    }
    items.par_iter().enumerate().map(|(number, item)| f(number, item)).collect()
}

/// Tells of a stretch of items by its last one: a count that all threads share is too slow to be written for
/// each.
fn tell(progress: &Progress, number: usize) {
    if (number + 1).is_multiple_of(STRETCH) {
        progress.advance(STRETCH as u64);
    }
}

/// Those that are there, in the memory that held them all.
fn present<T>(mut all: Vec<Option<T>>) -> Vec<T> {
    all.retain(Option::is_some);
    // `flatten` would take new memory.
    all.into_iter().collect::<Option<_>>().unwrap_or_default()
}

/// Stands for no index of a primitive: there are fewer.
const MANY: u32 = u32::MAX;

/// The objects of a scene, ready for rays.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// All primitives, in file order.
    pub primitives: Vec<WorldPrimitive>,
    /// All objects, in file order, without those that hold nothing.
    pub objects: Vec<WorldObject>,
    /// By object: [`Assembly::alone`], or [`MANY`]; and its kind.
    alone: Vec<(u32, BatchKind)>,
    /// The world limit: the box of all objects. Within −2..=2 on every axis.
    pub limit: Bounds,
    /// How far any primitive may be off its place: the greatest [`WorldShape::place_error`].
    pub place_error: f64,
    /// From the scene's coordinates to those of the assembly.
    pub scene_frame: SceneFrame,
    /// What there is of what.
    pub stats: AssemblyStats,
}

/// What there is of what in an assembly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyStats {
    /// The least [`WorldShape::thickness`] of the primitives.
    pub thinnest: f64,
    /// Objects that are one ball.
    pub balls: usize,
    /// Objects that are one surface.
    pub surfaces: usize,
    /// Meshes that are operands of objects.
    pub cut_meshes: usize,
}

/// One object of the lattice.
#[derive(Clone, Debug)]
pub struct WorldObject {
    /// Its number in the scene, from 0.
    pub number: u32,
    /// A box around it.
    pub bounds: Bounds,
    /// What it is made of.
    pub body: Body,
}

/// What an object is made of.
#[derive(Clone, Debug)]
pub enum Body {
    /// One convex primitive, by its index.
    Single(u32),
    /// One surface that bounds no solid, by its index.
    Surface(u32),
    /// A CSG expression, or a solid that is not convex.
    Composite {
        /// The expression as a tree, to be pruned.
        tree: Box<CsgTree>,
        /// The same laid out for rays.
        whole: Box<Expression>,
    },
}

/// What kind of object is asked about for eight rays at a time, each with an object of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BatchKind {
    /// One ball.
    Ball,
    /// One tube.
    Tube,
    /// One mesh that is no operand.
    Mesh,
    /// A solid of Bézier patches that is no operand.
    Bezier,
    /// One surface of triangles.
    Sheet,
    /// Anything else: one ray at a time.
    Other,
}

/// Where the assembly's coordinates have their origin, and their unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneFrame {
    /// The origin, in the scene's coordinates.
    pub origin: DVec3,
    /// The unit, in the scene's unit: a power of two.
    pub unit: f64,
}

impl WorldObject {
    /// The object of this number, whose primitives begin at `start`. `None` where it holds nothing.
    fn new(
        number: usize,
        object: &scene::Object,
        start: usize,
        primitives: &[WorldPrimitive],
    ) -> Option<Self> {
        let tree = CsgTree::new(&object.solid, &mut (start as u32))?.simplified(primitives);
        let bounds = tree.bounds(primitives);
        let form = |index: u32| &primitives[index as usize].form;
        let body = match tree {
            CsgTree::Leaf(index) if form(index).is_convex() => Body::Single(index),
            CsgTree::Leaf(index) if form(index).is_surface() => Body::Surface(index),
            tree => Body::Composite { whole: Box::new(Expression::new(&tree)), tree: Box::new(tree) },
        };
        (!bounds.is_empty()).then_some(Self { number: number as u32, bounds, body })
    }

    fn is_composite(&self) -> bool {
        matches!(self.body, Body::Composite { .. })
    }
}

impl SceneFrame {
    /// The scene's frame for a scene.
    fn of(scene: &Scene) -> Self {
        // What it shows, and all that is computed with.
        let reach = |objects: &[scene::Object]| {
            objects.iter().fold((Bounds::EMPTY, Bounds::EMPTY), |(seen, mut all), object| {
                object.solid.visit(&mut |p| all = all.join(&p.shape.bounds().mapped(&p.map)));
                (seen.join(&bounds_of(&object.solid)), all)
            })
        };
        if scene.objects.len() < STRETCH {
            let (seen, all) = reach(&scene.objects);
            return Self::new(&seen, &all);
        }
        let reaches: Vec<_> = scene.objects.par_chunks(STRETCH).map(reach).collect();
        let join = |(seen, all): (Bounds, Bounds), (s, a): &(Bounds, Bounds)| (seen.join(s), all.join(a));
        let (seen, all) = reaches.iter().fold((Bounds::EMPTY, Bounds::EMPTY), join);
        Self::new(&seen, &all)
    }

    /// The scene's frame for a scene that shows only in the box `b`, with cutters that reach to the box
    /// `all`.
    fn new(b: &Bounds, all: &Bounds) -> Self {
        // Cutters are computed with, too: where the body is small beside them, beyond all reason, the unit
        // grows so that no square of theirs overflows.
        let least = all.farthest().max_element() / FARTHEST;
        let half = b.half().max_element().max(least);
        let center = b.center();
        // A shift rounds coordinates that lie nearer the origin than the box's size. Up to 8 times half of
        // that away the origin costs 3 bits, less than the shift would.
        let far = center.abs().max_element() > 8.0 * half;
        let scale_of = |x: f64| libm::ldexp(1.0, libm::ilogb(x).clamp(-1000, 1000));
        let unit = |size: f64| if size > 0.0 && size.is_finite() { 2.0 * scale_of(size) } else { 1.0 };
        if far {
            // A multiple of the scene's size, so that coordinates of few bits keep them all.
            let grid = unit(half);
            let origin = (center / grid).round() * grid;
            Self { origin: if origin.is_finite() { origin } else { center }, unit: grid }
        } else {
            Self { origin: DVec3::ZERO, unit: unit(b.farthest().max_element().max(least)) }
        }
    }

    /// A point of the scene in the assembly.
    pub fn inward(&self, p: DVec3) -> DVec3 {
        (p - self.origin) / self.unit
    }

    /// A point of the scene in the assembly; one farther than `FARTHEST` is brought there along its
    /// direction.
    pub fn inward_near(&self, p: DVec3) -> DVec3 {
        let from_origin = p - self.origin;
        let size = from_origin.abs().max_element();
        if size / self.unit > FARTHEST { from_origin / size * FARTHEST } else { from_origin / self.unit }
    }

    /// A point of the assembly in the scene.
    pub fn outward(&self, p: DVec3) -> DVec3 {
        p * self.unit + self.origin
    }

    /// The form of a primitive in the assembly.
    fn form(&self, p: &scene::Primitive) -> Option<WorldShape> {
        let matrix3 = p.map.matrix3 * self.unit.recip();
        let map = DAffine3 { matrix3, translation: self.inward(p.map.translation) };
        // The scale is exact; a shift is rounded.
        let shifted = if self.origin == DVec3::ZERO { DVec3::ZERO } else { ROUNDING * map.translation.abs() };
        let error = p.map_error() / self.unit + shifted;
        if let Some(ball) = WorldShape::ball(&p.shape, &map, error) {
            return Some(ball);
        }
        let place = Placement::new(&map).filter(|place| {
            // Lengths of the world in the unit space, whose squares must not overflow.
            place.inverse.to_cols_array().iter().all(|x| x.abs() <= FARTHEST)
        });
        match place {
            Some(place) => Some(WorldShape::new(&p.shape, place, error)),
            // So thin beside the scene that no ray meets it, though its map has an inverse: a ball of no
            // size.
            None => {
                Placement::new(&p.map).map(|_| WorldShape::Ball(Ball::new(map.translation, 0.0, DVec3::ZERO)))
            }
        }
    }
}

/// A box around what a solid shows: a difference reaches no further than what it cuts from.
fn bounds_of(solid: &Solid) -> Bounds {
    solid.fold(&mut |p| p.shape.bounds().mapped(&p.map), &mut |solid, mut parts| match solid {
        Solid::Primitive(_) | Solid::Union(_) => parts.fold(Bounds::EMPTY, |b, part| b.join(&part)),
        Solid::Intersection(_) => {
            let met = parts.reduce(|b, part| b.meet(&part));
            met.filter(|b| !b.is_empty()).unwrap_or(Bounds::EMPTY)
        }
        Solid::Difference(_) => parts.next().unwrap_or(Bounds::EMPTY),
    })
}

/// Why a scene can not be put together. Readers refuse such scenes with the place in their text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AssemblyError {
    /// A primitive whose map flattens it, or is not finite.
    #[error("object {object} has a primitive (number {primitive} in it) whose map has no inverse")]
    Singular {
        /// The object's number in the scene, from 1.
        object: usize,
        /// The primitive's number in the object, from 1.
        primitive: usize,
    },
    /// A surface, which has no inside, among the operands of an operator.
    #[error(
        "object {object} has a surface (number {primitive} in it) inside an operation, which is for solids only"
    )]
    SurfaceInOperation {
        /// The object's number in the scene, from 1.
        object: usize,
        /// The surface's number among the primitives of the object, from 1.
        primitive: usize,
    },
    /// More primitives than a 32-bit index can name.
    #[error("the scene has more than 2³² − 1 primitives")]
    TooMany,
}

impl Assembly {
    /// Puts a scene together.
    pub fn new(scene: &Scene) -> Result<Self, AssemblyError> {
        Self::watched(scene, &Progress::default())
    }

    /// The same, where `progress` says how far this is.
    pub fn watched(scene: &Scene, progress: &Progress) -> Result<Self, AssemblyError> {
        let scene_frame = SceneFrame::of(scene);
        let mut parts = Vec::with_capacity(scene.objects.len());
        // By object: where its primitives start; one more than there are objects.
        let mut starts = Vec::with_capacity(scene.objects.len() + 1);
        for object in &scene.objects {
            starts.push(parts.len());
            object.solid.visit(&mut |p| parts.push(p));
        }
        starts.push(parts.len());
        u32::try_from(parts.len()).map_err(|_| AssemblyError::TooMany)?;
        // Primitives take about as long as objects.
        progress.begin(Task::Assembling, (parts.len() + scene.objects.len()) as u64);
        let placed = |number, p: &&scene::Primitive| {
            tell(progress, number);
            scene_frame.form(p).map(|form| WorldPrimitive { form, material: p.material })
        };
        let primitives = mapped(&parts, placed);
        if let Some(singular) = primitives.iter().position(Option::is_none) {
            let object = starts.partition_point(|&start| start <= singular);
            return Err(AssemblyError::Singular { object, primitive: singular - starts[object - 1] + 1 });
        }
        let primitives = present(primitives);
        drop(parts);
        let own = |number: usize| starts[number]..starts[number + 1];
        let object = |number, object: &scene::Object| {
            tell(progress, number);
            WorldObject::new(number, object, own(number).start, &primitives)
        };
        let objects = present(mapped(&scene.objects, object));
        for WorldObject { number, .. } in objects.iter().filter(|object| object.is_composite()) {
            if let Some(surface) = primitives[own(*number as usize)].iter().position(|p| p.form.is_surface())
            {
                let (object, primitive) = (*number as usize + 1, surface + 1);
                return Err(AssemblyError::SurfaceInOperation { object, primitive });
            }
        }
        let limit = objects.iter().fold(Bounds::EMPTY, |limit, object| limit.join(&object.bounds));
        let numbers = |p: &WorldPrimitive| (p.form.place_error(), p.form.thickness());
        let join = |(place_error, thinnest): (f64, f64), other: (f64, f64)| {
            (place_error.max(other.0), thinnest.min(other.1))
        };
        let (place_error, thinnest) = if primitives.len() < STRETCH {
            primitives.iter().map(numbers).fold((0.0, f64::INFINITY), join)
        } else {
            primitives.par_iter().map(numbers).reduce(|| (0.0, f64::INFINITY), join)
        };
        let is_mesh = |p: &WorldPrimitive| matches!(p.form, WorldShape::Mesh(_));
        let is_bezier = |p: &WorldPrimitive| matches!(p.form, WorldShape::Bezier(_));
        let alone = |object: &WorldObject| match &object.body {
            &Body::Single(index) | &Body::Surface(index) => match primitives[index as usize].form {
                WorldShape::Ball(_) => (index, BatchKind::Ball),
                WorldShape::Tube(_) => (index, BatchKind::Tube),
                WorldShape::Sheet(_) => (index, BatchKind::Sheet),
                _ => (index, BatchKind::Other),
            },
            Body::Composite { tree, .. } => match **tree {
                CsgTree::Leaf(index) if is_mesh(&primitives[index as usize]) => (index, BatchKind::Mesh),
                CsgTree::Leaf(index) if is_bezier(&primitives[index as usize]) => (index, BatchKind::Bezier),
                CsgTree::Leaf(_) | CsgTree::Any(_) | CsgTree::All(_) => (MANY, BatchKind::Other),
            },
        };
        let alone: Vec<_> = objects.iter().map(alone).collect();
        let balls = alone.iter().filter(|(_, kind)| *kind == BatchKind::Ball).count();
        let surfaces = objects.iter().filter(|o| matches!(o.body, Body::Surface(_))).count();
        let meshes = primitives.iter().filter(|&p| is_mesh(p)).count();
        let lone_meshes = alone.iter().filter(|(_, kind)| *kind == BatchKind::Mesh).count();
        let stats =
            AssemblyStats { thinnest, balls, surfaces, cut_meshes: meshes.saturating_sub(lone_meshes) };
        Ok(Self { primitives, objects, alone, limit, place_error, scene_frame, stats })
    }

    /// The primitive of an object that is a [`Body::Single`] or a [`Body::Surface`]. A list of its own:
    /// millions of objects are in no cache, their numbers may be.
    #[inline]
    pub fn alone(&self, object: u32) -> Option<u32> {
        let (index, kind) = self.alone[object as usize];
        (index != MANY && !matches!(kind, BatchKind::Mesh | BatchKind::Bezier)).then_some(index)
    }

    /// The mesh, or surface of triangles, that an object is, and its index among the primitives, where it is
    /// nothing else.
    #[inline]
    pub fn mesh(&self, object: u32) -> Option<(u32, &TriangleMesh)> {
        let (index, kind) = self.alone[object as usize];
        if !matches!(kind, BatchKind::Mesh | BatchKind::Sheet) {
            return None;
        }
        let (WorldShape::Mesh(mesh) | WorldShape::Sheet(mesh)) = &self.primitives[index as usize].form else {
            return None;
        };
        Some((index, mesh))
    }

    /// The solid of Bézier patches that an object is, and its index among the primitives, where it is nothing
    /// else.
    #[inline]
    pub fn patches(&self, object: u32) -> Option<(u32, &BezierSurface)> {
        let (index, kind) = self.alone[object as usize];
        if kind != BatchKind::Bezier {
            return None;
        }
        let WorldShape::Bezier(patches) = &self.primitives[index as usize].form else { return None };
        Some((index, patches))
    }

    /// What kind of object it is; and the primitive that it is, where it is one alone.
    #[inline]
    pub fn kind(&self, object: u32) -> (BatchKind, u32) {
        let (index, kind) = self.alone[object as usize];
        (kind, index)
    }

    /// How far the scene reaches along `v` at most, in its own coordinates: the greatest `p · v` of its
    /// points.
    pub fn support(&self, v: DVec3) -> f64 {
        let own = self.objects.iter().map(|object| match &object.body {
            Body::Single(index) | Body::Surface(index) => self.primitives[*index as usize].form.support(v),
            Body::Composite { tree, .. } => tree.support(&self.primitives, v),
        });
        own.fold(f64::NEG_INFINITY, f64::max) * self.scene_frame.unit + self.scene_frame.origin.dot(v)
    }

    /// The material of a primitive.
    pub fn material(&self, primitive: u32) -> MaterialId {
        self.primitives[primitive as usize].material
    }

    /// Takes the materials of another scene with the same solids ([`Scene::has_solids_of`]).
    pub fn take_materials(&mut self, scene: &Scene) {
        let mut own = self.primitives.iter_mut();
        for object in &scene.objects {
            object.solid.visit(&mut |p| own.next().into_iter().for_each(|own| own.material = p.material));
        }
    }

    /// The normal of a primitive's surface at a point of the assembly, turned to the side that a ray along
    /// `d` comes from, of length 1.
    ///
    /// The normal of a patch is interpolated, and turned to the side of the patch's plane that the ray comes
    /// from. Where it still turns away from the ray, as it does at the rim of what coarse patches stand for,
    /// the nearest normal that does not is taken: the one across the ray. So light does not jump there.
    pub fn turned_normal(&self, primitive: u32, surface: u32, p: DVec3, d: DVec3) -> DVec3 {
        let form = &self.primitives[primitive as usize].form;
        let own = form.normal(p, surface).normalize_or(-d);
        let turned = if own.dot(d) > 0.0 { -own } else { own };
        if !matches!(form, WorldShape::Patch(_)) {
            return turned;
        }
        let shown = form.shading_normal(p, surface);
        let shown = if shown.dot(turned) < 0.0 { -shown } else { shown };
        let away = shown.dot(d);
        if away > 0.0 { (shown - away * d).normalize_or(turned) } else { shown }
    }

    /// A ray of the scene in the assembly; distances along it are divided by [`SceneFrame::unit`].
    pub fn ray(&self, ray: &Ray) -> Ray {
        Ray::new(self.scene_frame.inward_near(ray.o), ray.d)
    }
}

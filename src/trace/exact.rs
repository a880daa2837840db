//! The exact engine: f64, one ray at a time, every crossing with its error bound.

use std::ops::ControlFlow;

use crate::lattice::{self, BoxVisitor, CellsVisitor, Outcode, SLACK, Structure, slack};
use crate::math::{Bounds, DVec3, Mask, Number, Ray, Rays, Vector};
use crate::solid::{
    self, Assembly, Body, Crossing, Departure, ExprView, LIMIT, TRange, WorldPrimitive, first_of_expression,
    first_of_span, first_of_surface,
};
use crate::stage::{Meter, Probe, RayEvent, Stage};

use super::RayEngine;
use super::hit::Hit;

/// A start farther than this before the plane across the ray that touches the ball around the world, in the
/// assembly's unit, is moved to that plane, so that the distance to the world adds no rounding.
const FAR: f64 = 1.0;

/// How often what is left of the distance to that plane is corrected: each time leaves one part in 2^52 of
/// it, and no distance is longer than 2^1024. Rays that pass the world far away end no nearer.
const STEPS: usize = 1024 / 52;

/// The reference engine, over an assembly and how its space is cut.
#[derive(Clone, Copy, Debug)]
pub struct Exact<'a> {
    assembly: &'a Assembly,
    structure: Structure<'a>,
    limit: Bounds,
    /// How far apart two hits may seem that are one place.
    slack: f64,
}

/// Memory of one worker.
#[derive(Clone, Debug, Default)]
pub struct RayMemory {
    scratch: solid::Scratch,
    /// By object: the last ray that was tested against it.
    tested: Vec<u32>,
    ray: u32,
    /// Hits that may be the first: all within `slack` behind the nearest.
    nearest: Vec<(u32, Crossing)>,
    /// The distance of the nearest; infinite as long as there is none.
    best: f64,
    slack: f64,
}

impl RayMemory {
    /// Forgets what the last ray met.
    fn start_ray(&mut self) {
        self.nearest.clear();
        self.best = f64::INFINITY;
    }

    /// Forgets which objects the last ray was tested against; there are so many.
    fn start_marking(&mut self, objects: usize) {
        self.tested.resize(objects, 0);
        self.ray = self.ray.wrapping_add(1);
        if self.ray == 0 {
            self.tested.fill(0);
            self.ray = 1;
        }
    }

    /// Whether the object is new to this ray.
    fn first_time(&mut self, object: u32) -> bool {
        std::mem::replace(&mut self.tested[object as usize], self.ray) != self.ray
    }

    fn keep(&mut self, object: u32, crossing: Crossing) {
        if crossing.t <= self.best + self.slack {
            if crossing.t < self.best {
                self.best = crossing.t;
                self.nearest.retain(|(_, other)| other.t <= crossing.t + self.slack);
            }
            self.nearest.push((object, crossing));
        }
    }

    /// The nearest hit; of those that coincide with it within their errors, the first object's in the file.
    /// Only these are kept.
    fn chosen(&mut self, ray: &Ray) -> Option<Hit> {
        let best = self.nearest.iter().min_by(|a, b| a.1.t.total_cmp(&b.1.t))?.1;
        self.nearest.retain(|(_, c)| c.t - c.error <= best.t + best.error);
        let (object, c) = *self.nearest.iter().min_by_key(|(object, _)| *object)?;
        Some(Hit {
            t: c.t,
            error: c.error,
            p: ray.at(c.t),
            object,
            primitive: c.primitive,
            surface: c.surface,
            entering: c.entering,
        })
    }
}

impl<'a> Exact<'a> {
    /// An engine over an assembly.
    pub fn new(assembly: &'a Assembly, structure: Structure<'a>) -> Self {
        // Moved outward by what rounding may take from a hit at the limit.
        let limit = assembly.limit.padded(DVec3::splat(SLACK));
        Self { assembly, structure, limit, slack: slack(assembly.place_error) }
    }

    /// The first crossing of one object, if it lies before `to`.
    #[inline]
    pub(super) fn object(
        &self,
        object: u32,
        ray: &Ray,
        departure: Option<Departure>,
        to: f64,
        scratch: &mut solid::Scratch,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Crossing> {
        let found = self.first_of_object(object, ray, departure, to, scratch, meter);
        if let Some(Crossing { t, error, primitive, surface, entering }) = found {
            meter.record(|| RayEvent::Crossed { object, primitive, surface, t, error, entering });
        }
        found
    }

    #[inline]
    fn first_of_object(
        &self,
        object: u32,
        ray: &Ray,
        departure: Option<Departure>,
        to: f64,
        scratch: &mut solid::Scratch,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Crossing> {
        meter.at(Stage::Solid);
        if let Some(index) = self.assembly.alone(object) {
            let primitive = &self.assembly.primitives[index as usize];
            return if primitive.form.is_surface() {
                first_of_surface(ray, primitive, index, departure, meter)
            } else {
                first_of_span(ray, primitive, index, departure, meter)
            };
        }
        let Body::Composite { whole, .. } = &self.assembly.objects[object as usize].body else { return None };
        let primitives = &self.assembly.primitives;
        if let Some(cells) = self.structure.cells(object) {
            meter.at(Stage::Cell);
            let mut query = FirstInCells { ray, primitives, departure, to, best: None, scratch, meter };
            cells.walk(ray, to, &mut query);
            return query.best;
        }
        match self.structure.sub(object) {
            None => {
                let reach = TRange { from: 0.0, to };
                first_of_expression(ray, &**whole, primitives, departure, reach, scratch, meter)
            }
            Some(sub) => {
                meter.at(Stage::Cell);
                let found = sub.walk(ray, |part, step| {
                    meter.enter_cell(step.from);
                    let Some(part) = part else { return ControlFlow::Continue(()) };
                    if step.from > to {
                        return ControlFlow::Break(None);
                    }
                    let reach = TRange { from: step.from - SLACK, to: step.to + SLACK };
                    let found = first_of_expression(ray, part, primitives, departure, reach, scratch, meter);
                    meter.at(Stage::Cell);
                    found.map_or(ControlFlow::Continue(()), |c| ControlFlow::Break(Some(c)))
                });
                found.flatten()
            }
        }
    }

    /// The nearest hit of a ray that starts inside the world or near it.
    fn closest(
        &self,
        ray: &Ray,
        entry: f64,
        departure: Option<Departure>,
        memory: &mut RayMemory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Hit> {
        memory.start_ray();
        let goal = Nearest { slack: self.slack };
        ObjectVisitor { exact: self, ray, departure, goal, memory, meter }.walk(entry, f64::INFINITY);
        memory.chosen(ray)
    }
}

/// The first crossing of a ray with the parts of an object in cells.
struct FirstInCells<'a, P> {
    ray: &'a Ray,
    primitives: &'a [WorldPrimitive],
    departure: Option<Departure>,
    to: f64,
    best: Option<Crossing>,
    scratch: &'a mut solid::Scratch,
    meter: &'a mut Meter<P>,
}

impl<P: Probe> CellsVisitor for FirstInCells<'_, P> {
    fn enter(&mut self, from: f64) {
        self.meter.enter_cell(from);
    }

    fn visit(&mut self, part: ExprView, reach: TRange) -> f64 {
        let Self { ray, primitives, departure, scratch, meter, .. } = self;
        let found = first_of_expression(ray, part, primitives, *departure, reach, scratch, meter);
        meter.at(Stage::Cell);
        self.best = match (self.best, found) {
            (Some(a), Some(b)) if b.t >= a.t => Some(a),
            (one, other) => other.or(one),
        };
        self.best.map_or(self.to, |c| c.t.min(self.to))
    }
}

/// What is looked for among the objects that a ray may meet.
trait Goal {
    /// Whether the order counts: boxes are walked the nearest first then.
    const IN_ORDER: bool;

    /// How far the ray still matters.
    fn farthest(&self, memory: &RayMemory) -> f64;

    /// Takes what the ray crosses first of an object. Answers whether the rest does not matter.
    fn take(&mut self, object: u32, crossing: &Crossing, memory: &mut RayMemory) -> bool;
}

/// The nearest hit, and what lies within `slack` behind it.
struct Nearest {
    slack: f64,
}

impl Goal for Nearest {
    const IN_ORDER: bool = true;

    #[inline]
    fn farthest(&self, memory: &RayMemory) -> f64 {
        memory.best + self.slack
    }

    #[inline]
    fn take(&mut self, object: u32, crossing: &Crossing, memory: &mut RayMemory) -> bool {
        memory.keep(object, *crossing);
        false
    }
}

/// Any crossing before `distance` to which `visit` says yes.
struct Any<'f> {
    distance: f64,
    visit: &'f mut dyn FnMut(u32, &Crossing) -> bool,
}

impl Goal for Any<'_> {
    const IN_ORDER: bool = false;

    #[inline]
    fn farthest(&self, _: &RayMemory) -> f64 {
        self.distance
    }

    #[inline]
    fn take(&mut self, object: u32, crossing: &Crossing, _: &mut RayMemory) -> bool {
        (self.visit)(object, crossing)
    }
}

/// Tests a ray against the objects that it may meet.
struct ObjectVisitor<'v, 'a, P, G> {
    exact: &'v Exact<'a>,
    ray: &'v Ray,
    departure: Option<Departure>,
    goal: G,
    memory: &'v mut RayMemory,
    meter: &'v mut Meter<P>,
}

impl<P: Probe, G: Goal> ObjectVisitor<'_, '_, P, G> {
    /// Tests the ray against each object that it may meet between two distances, once. Answers whether the
    /// goal was reached before the last.
    #[inline]
    fn walk(&mut self, from: f64, to: f64) -> bool {
        let (exact, ray) = (self.exact, self.ray);
        let objects = exact.assembly.objects.len();
        if let Structure::None = exact.structure {
            return (0..objects as u32).any(|object| self.test(object).is_break());
        }
        self.meter.at(Stage::Cell);
        if let Structure::Boxes(boxes, _) = exact.structure {
            // Each object has one place there.
            let found =
                if G::IN_ORDER { boxes.walk(ray, from, to, self) } else { boxes.walk_any(ray, to, self) };
            return found.is_some();
        }
        self.memory.start_marking(objects);
        let is_lattice = matches!(exact.structure, Structure::Lattice(..));
        let found = exact.structure.walk(ray, from, to, |objects, step| {
            self.meter.enter_numbered_cell(step.from, is_lattice.then_some(step.cell as u32));
            for &object in objects {
                if self.memory.first_time(object) {
                    self.test(object)?;
                    self.meter.at(Stage::Cell);
                }
            }
            ControlFlow::Continue(self.goal.farthest(self.memory))
        });
        found.is_some()
    }

    #[inline]
    fn test(&mut self, object: u32) -> ControlFlow<()> {
        let Self { exact, ray, departure, goal, memory, meter } = self;
        let to = goal.farthest(memory);
        let crossing = exact.object(object, ray, *departure, to, &mut memory.scratch, meter);
        if crossing.is_some_and(|crossing| goal.take(object, &crossing, memory)) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

impl<P: Probe, G: Goal> BoxVisitor<()> for ObjectVisitor<'_, '_, P, G> {
    #[inline(always)]
    fn enter(&mut self, from: f64) {
        self.meter.enter_cell(from);
    }

    #[inline(never)]
    fn visit(&mut self, object: u32, _: f64) -> ControlFlow<(), f64> {
        let tested = self.test(object);
        self.meter.at(Stage::Cell);
        tested?;
        ControlFlow::Continue(self.goal.farthest(self.memory))
    }
}

impl RayEngine for Exact<'_> {
    type Memory = RayMemory;

    fn memory(&self) -> RayMemory {
        RayMemory { slack: self.slack, ..RayMemory::default() }
    }

    fn first(&self, ray: &Ray, memory: &mut RayMemory, meter: &mut Meter<impl Probe>) -> Option<Hit> {
        meter.at(Stage::Clip);
        let (near, [far, left]) = moved_nearer(ray);
        meter.record(|| RayEvent::Coded { outcode: Outcode::of(near.o, &self.limit).0, moved: far + left });
        let Some(entry) = lattice::entry(&near, &self.limit) else {
            meter.counts.clipped_rays += 1;
            meter.record(|| RayEvent::Clipped);
            memory.nearest.clear();
            return None;
        };
        meter.record(|| RayEvent::Entered { t: entry });
        let hit = self.closest(&near, entry, None, memory, meter)?;
        // Of a long path each part is rounded once.
        Some(Hit { t: far + (left + hit.t), error: hit.error + 0.5 * f64::EPSILON * far, ..hit })
    }

    fn next(
        &self,
        ray: &Ray,
        departure: Departure,
        memory: &mut RayMemory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Hit> {
        self.closest(ray, 0.0, Some(departure), memory, meter)
    }

    fn together<'m>(&self, memory: &'m RayMemory) -> &'m [(u32, Crossing)] {
        &memory.nearest
    }

    fn meets(
        &self,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut RayMemory,
        meter: &mut Meter<impl Probe>,
        visit: &mut dyn FnMut(u32, &Crossing) -> bool,
    ) -> bool {
        let goal = Any { distance, visit };
        ObjectVisitor { exact: self, ray, departure: Some(departure), goal, memory, meter }
            .walk(0.0, distance)
    }

    fn of_object(
        &self,
        object: u32,
        ray: &Ray,
        departure: Departure,
        distance: f64,
        memory: &mut RayMemory,
        meter: &mut Meter<impl Probe>,
    ) -> Option<Crossing> {
        self.object(object, ray, Some(departure), distance, &mut memory.scratch, meter)
    }
}

/// The same ray from a start that is not far from the world, and the distance there in two parts.
///
/// Over a long distance the product is larger than the sum, and each coordinate takes one rounding of the sum
/// only: a fused multiply-add, in software where the processor has none, gives the same bits everywhere. The
/// distance is itself rounded, which moves the start along the ray; what is left of that is corrected.
fn moved_nearer(ray: &Ray) -> (Ray, [f64; 2]) {
    let (near, moved) = all_moved_nearer(&Rays::from(ray));
    let vector = |v: Vector<f64>| DVec3::new(v.x, v.y, v.z);
    (Ray::new(vector(near.o), vector(near.d)), moved)
}

/// At least as far as any ray is moved ([`moved_nearer`]) that starts in `o` and goes between the directions
/// `corners`.
pub(super) fn most_moved(o: DVec3, corners: &[DVec3; 4]) -> f64 {
    // A direction between the corners is a sum of shares of them, which add up to 1, over the length of that
    // sum; and that is no less than it reaches along their middle.
    let middle = (corners[0] + corners[1] + corners[2] + corners[3]).normalize_or(DVec3::X);
    let reach = corners.iter().fold(f64::INFINITY, |least, d| least.min(d.dot(middle)));
    let most = corners.iter().fold(0.0, |most, d| f64::max(most, -o.dot(*d)));
    if most == 0.0 {
        return 0.0;
    }
    // Where they diverge too far to say so, it is no farther than to the origin.
    let far = if reach > 0.0 { (most / reach).min(o.length()) } else { o.length() };
    (far - LIMIT).max(0.0)
}

/// [`moved_nearer`], for one ray or for several.
#[inline(always)]
pub(super) fn all_moved_nearer<N: Number>(rays: &Rays<N>) -> (Rays<N>, [N; 2]) {
    let zero = rays.o.x.same(0.0);
    let far = -rays.o.dot(rays.d) - LIMIT;
    let is_far = far.is_above(zero.same(FAR));
    if !is_far.any() {
        return (*rays, [zero; 2]);
    }
    let Rays { o, d } = *rays;
    let start = Vector { x: far.fused(d.x, o.x), y: far.fused(d.y, o.y), z: far.fused(d.z, o.z) };
    let mut left = -start.dot(d) - LIMIT;
    let mut start = start + d * left;
    for _ in 0..STEPS {
        let more = -start.dot(d) - LIMIT;
        let is_off = is_far & (more.is_above(zero.same(FAR)) | more.is_below(zero.same(-FAR)));
        if !is_off.any() {
            break;
        }
        start = Vector::choose(is_off, start + d * more, start);
        left = is_off.choose(left + more, left);
    }
    let o = Vector::choose(is_far, start, o);
    (Rays { o, d }, [is_far.choose(far, zero), is_far.choose(left, zero)])
}

//! The exact engine: f64, one ray at a time, every crossing with its error bound.

use std::ops::ControlFlow;

use crate::lattice::{self, SLACK, Structure, slack};
use crate::math::{Bounds, DVec3, Mask, Number, Ray, Rays, Vector};
use crate::solid::{
    self, Assembly, Body, Crossing, Departure, LIMIT, TRange, first_of_expression, first_of_span,
    first_of_surface,
};
use crate::stage::{Meter, Probe, Stage};

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
        Self { assembly, structure, limit, slack: slack(assembly.off) }
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
            let (mut visited, mut best) = (0, None::<Crossing>);
            cells.walk(ray, to, &mut visited, |part, reach| {
                let found = first_of_expression(ray, part, primitives, departure, reach, scratch, meter);
                meter.at(Stage::Cell);
                best = match (best, found) {
                    (Some(a), Some(b)) if b.t >= a.t => Some(a),
                    (one, other) => other.or(one),
                };
                best.map_or(to, |c| c.t.min(to))
            });
            meter.counts.cells_visited += visited;
            return best;
        }
        match self.structure.sub(object) {
            None => {
                let reach = TRange { from: 0.0, to };
                first_of_expression(ray, &**whole, primitives, departure, reach, scratch, meter)
            }
            Some(sub) => {
                meter.at(Stage::Cell);
                let mut visited = 0;
                let found = sub.walk(ray, &mut visited, |part, step| {
                    if step.from > to {
                        return ControlFlow::Break(None);
                    }
                    let reach = TRange { from: step.from - SLACK, to: step.to + SLACK };
                    let found = first_of_expression(ray, part, primitives, departure, reach, scratch, meter);
                    meter.at(Stage::Cell);
                    found.map_or(ControlFlow::Continue(()), |c| ControlFlow::Break(Some(c)))
                });
                meter.counts.cells_visited += visited;
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
        let test = |object: u32, memory: &mut RayMemory, meter: &mut Meter<_>| {
            let to = memory.best + self.slack;
            if let Some(crossing) = self.object(object, ray, departure, to, &mut memory.scratch, meter) {
                memory.keep(object, crossing);
            }
        };
        if let Structure::None = self.structure {
            for object in 0..self.assembly.objects.len() as u32 {
                test(object, memory, meter);
            }
            return memory.chosen(ray);
        }
        meter.at(Stage::Cell);
        let mut visited = 0;
        if let Structure::Boxes(boxes, _) = self.structure {
            // Each object has one place there.
            boxes.walk(ray, entry, f64::INFINITY, &mut visited, |object, _| -> ControlFlow<(), f64> {
                test(object, memory, meter);
                meter.at(Stage::Cell);
                ControlFlow::Continue(memory.best + self.slack)
            });
            meter.counts.cells_visited += visited;
            return memory.chosen(ray);
        }
        memory.start_marking(self.assembly.objects.len());
        self.structure.walk(ray, entry, f64::INFINITY, &mut visited, |objects, _| -> ControlFlow<(), f64> {
            for &object in objects {
                if memory.first_time(object) {
                    test(object, memory, meter);
                    meter.at(Stage::Cell);
                }
            }
            ControlFlow::Continue(memory.best + self.slack)
        });
        meter.counts.cells_visited += visited;
        memory.chosen(ray)
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
        let Some(entry) = lattice::entry(&near, &self.limit) else {
            meter.counts.clipped_rays += 1;
            memory.nearest.clear();
            return None;
        };
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
        let mut test = |object: u32, memory: &mut RayMemory, meter: &mut Meter<_>| {
            let crossing = self.object(object, ray, Some(departure), distance, &mut memory.scratch, meter);
            crossing.is_some_and(|crossing| visit(object, &crossing))
        };
        if let Structure::None = self.structure {
            return (0..self.assembly.objects.len() as u32).any(|object| test(object, memory, meter));
        }
        meter.at(Stage::Cell);
        let mut visited = 0;
        if let Structure::Boxes(boxes, _) = self.structure {
            let found = boxes.any(ray, distance, &mut visited, |object| {
                let found = test(object, memory, meter);
                meter.at(Stage::Cell);
                found
            });
            meter.counts.cells_visited += visited;
            return found;
        }
        memory.start_marking(self.assembly.objects.len());
        let found = self.structure.walk(ray, 0.0, distance, &mut visited, |objects, _| {
            for &object in objects {
                if memory.first_time(object) {
                    let found = test(object, memory, meter);
                    meter.at(Stage::Cell);
                    if found {
                        return ControlFlow::Break(());
                    }
                }
            }
            ControlFlow::Continue(distance)
        });
        meter.counts.cells_visited += visited;
        found.is_some()
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

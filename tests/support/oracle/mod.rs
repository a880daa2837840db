//! The depth of a scene along a ray, worked out the slow way: every surface of every primitive is one
//! equation in world coordinates; all its crossings with the ray are sorted; and the points halfway between
//! them are tested for membership in the whole CSG expression. No lattice, no intervals, no pruning, no
//! coordinates of the primitive's own, and no code of the program's own.
//!
//! The arithmetic is a [`Number`]: [`Wide`] of 106 bits for whole pictures, [`Big`] of 600 bits with
//! exponents of any size for scales and ratios at the ends of f64. The scene's and the ray's own f64 are
//! taken as exact.

mod ball;
mod big;
mod chord;
mod number;
mod open;
mod patch;
mod side;
mod triangle;
mod wide;
mod worked;

use ray13::math::DVec3;
use ray13::scene::{Primitive, Scene, Shape, Solid};

pub use big::Big;
pub use chord::{Chord, Verdict, chord, point_at, silhouette, verdict};
pub use number::Number;
pub use wide::Wide;

use ball::Ball;
use number::unit;
use open::Open;
use patch::Patch;
use side::{Row, Side, along, direction, point, sides};
use triangle::Triangle;

/// Where a ray first meets the surface of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the origin, in lengths of the direction.
    pub t: f64,
    /// The place of the object in the scene, counted from 1.
    pub object: u32,
    /// The primitive whose surface it is, by its place in the scene, counted from 0.
    pub primitive: u32,
    /// Whether the object is entered; a surface that bounds no solid is not.
    pub entering: Option<bool>,
    /// Of length 1, turned to the side that the ray comes from. Zero at the tip of a cone.
    pub normal: DVec3,
}

/// A scene as a list of surfaces and an expression over them.
#[derive(Debug)]
pub struct Oracle<'a, N = Wide> {
    scene: &'a Scene,
    pieces: Vec<Piece<N>>,
    /// The length in the scene's unit that is 1 here: a power of two near the scene's size.
    unit: f64,
    /// So many times its rounding a surface may move.
    tolerance: f64,
}

/// A primitive in the world.
#[derive(Debug)]
struct Piece<N> {
    object: usize,
    surface: Surface<N>,
    /// A ball around it.
    ball: Ball,
    /// How far rounding may have moved it.
    map_error: f64,
}

#[derive(Debug)]
enum Surface<N> {
    /// Inside all of its sides.
    Convex(Vec<Side<N>>),
    /// Inside an odd number of times.
    Parity(Vec<Triangle<N>>),
    /// The same of Bézier patches.
    Patches(Vec<Patch<N>>),
    /// Without an inside.
    Open(Open<N>),
}

/// A point of the ray where it may enter or leave a piece.
#[derive(Clone, Debug)]
struct Crossing<N> {
    t: N,
    piece: usize,
    outward: DVec3,
    /// How far `t` may move when the surface moves by what is of no account.
    slack: f64,
}

/// A crossing counts as on a primitive's surface where its other sides are passed by no more than this, in
/// the units of their equations (1 from the middle to the surface). Only the choice of candidates depends on
/// it, not a depth: a candidate too many changes no membership.
const SLACK: f64 = 1e-9;

impl<'a, N: Number> Oracle<'a, N> {
    /// An oracle to which a stretch of a ray is of no account that vanishes when surfaces move by what was
    /// rounded in their maps, which the scene says of each primitive.
    pub fn new(scene: &'a Scene) -> Self {
        Self::with_tolerance(scene, 1.0)
    }

    /// The same with so many times the scene's [`map_error`](Primitive::map_error); 0 takes its numbers at
    /// their word.
    pub fn with_tolerance(scene: &'a Scene, tolerance: f64) -> Self {
        let mut size = 0.0_f64;
        for object in &scene.objects {
            object.solid.visit(&mut |p| {
                let corners = p.shape.bounds().corners().map(|corner| p.map.transform_point3(corner));
                size = corners.iter().fold(size, |size, p| size.max(p.abs().max_element()));
            });
        }
        let unit = if size > 0.0 { libm::ldexp(1.0, libm::ilogb(size).clamp(-1000, 1000)) } else { 1.0 };
        let mut pieces = Vec::new();
        for (object, part) in scene.objects.iter().enumerate() {
            part.solid.visit(&mut |primitive| pieces.push(Piece::new(object, primitive, unit)));
        }
        Self { scene, pieces, unit, tolerance }
    }

    /// The first point in front of the origin where the ray enters or leaves an object, or meets an open
    /// surface.
    pub fn hit(&self, origin: DVec3, toward: DVec3) -> Option<Hit> {
        self.exact_hit(origin, toward).map(|(_, hit)| hit)
    }

    /// The same with the distance before it is rounded.
    pub fn exact_hit(&self, origin: DVec3, toward: DVec3) -> Option<(N, Hit)> {
        let (o, d): (Row<N>, Row<N>) = (point(origin / self.unit), direction(toward));
        let ray = Ray { o: &o, d: &d, origin: origin / self.unit, toward };
        let opens = self.pieces.iter().enumerate().filter_map(|(index, piece)| {
            let Surface::Open(open) = &piece.surface else { return None };
            let (t, plane, normal) = if piece.ball.may_meet(ray.origin, toward.normalize()) {
                open.first(&o, &d, toward)?
            } else {
                return None;
            };
            let slack = self.slack(piece, plane, toward);
            let hit = Hit {
                t: t.value(),
                object: piece.object as u32 + 1,
                primitive: index as u32,
                entering: None,
                normal,
            };
            Some((t, slack, hit))
        });
        let all: Vec<(N, f64, Hit)> = opens.chain(self.solid_hit(&ray)).collect();
        let (nearest, slack, _) = all.iter().reduce(|a, b| if b.0 < a.0 { b } else { a })?.clone();
        // In one place the first in the file shows.
        let here = all.into_iter().filter(|(t, own, _)| (t.clone() - nearest.clone()).value() <= own + slack);
        let (t, _, hit) = here.min_by_key(|(_, _, hit)| hit.object)?;
        let t = t * N::from(self.unit);
        Some((t.clone(), Hit { t: t.value(), ..hit }))
    }

    /// How far a crossing may move along the ray when its surface moves by the tolerance; no farther than
    /// through the whole piece.
    fn slack(&self, piece: &Piece<N>, normal: DVec3, toward: DVec3) -> f64 {
        let length = toward.length();
        let off = self.tolerance * piece.map_error;
        let sine = (normal.dot(toward) / length).abs();
        (off / sine.max(f64::MIN_POSITIVE)).min(2.0 * piece.ball.radius) / length
    }

    /// The first point in front of the origin where the ray enters or leaves an object that is a solid. From
    /// outside all of them that is where it enters their union; from inside one it may be an object that lies
    /// within it.
    fn solid_hit(&self, ray: &Ray<N>) -> Option<(N, f64, Hit)> {
        let mut crossings = Vec::new();
        for (index, piece) in self.pieces.iter().enumerate() {
            if piece.ball.may_meet(ray.origin, ray.toward.normalize()) {
                piece.crossings(ray, |t, outward| {
                    let slack = self.slack(piece, outward, ray.toward);
                    crossings.push(Crossing { t, piece: index, outward, slack });
                });
            }
        }
        crossings
            .sort_by(|a, b| a.t.partial_cmp(&b.t).expect("roots are numbers").then(a.piece.cmp(&b.piece)));

        let half = N::from(0.5);
        let first = crossings.first()?;
        let mut before = self.inside(&crossings, &along(ray.o, ray.d, &(first.t.clone() * half.clone())));
        let mut at = 0;
        while at < crossings.len() {
            // One place: all crossings that follow each other closely.
            let close =
                |a: &Crossing<N>, b: &Crossing<N>| (b.t.clone() - a.t.clone()).value() <= a.slack + b.slack;
            let mut end = at + 1;
            while end < crossings.len() && close(&crossings[end - 1], &crossings[end]) {
                end += 1;
            }
            let here = crossings[end - 1].t.clone();
            let next = crossings.get(end).map_or(here.clone() + N::from(1.0), |next| next.t.clone());
            let after = self.inside(&crossings, &along(ray.o, ray.d, &((here + next) * half.clone())));
            if self.in_objects(&before) != self.in_objects(&after) {
                return Some(self.surface(&crossings[at..end], &before, &after, ray.toward));
            }
            before = after;
            at = end;
        }
        None
    }

    /// Which pieces a point is in. One that the ray's crossings do not name is met nowhere on the ray.
    fn inside(&self, crossings: &[Crossing<N>], p: &Row<N>) -> Vec<bool> {
        let mut inside = vec![false; self.pieces.len()];
        let mut asked = inside.clone();
        for crossing in crossings {
            if !asked[crossing.piece] {
                asked[crossing.piece] = true;
                inside[crossing.piece] = self.pieces[crossing.piece].contains(p);
            }
        }
        inside
    }

    /// Whether each object holds a point that lies in these pieces.
    fn in_objects(&self, inside: &[bool]) -> Vec<bool> {
        let mut rest = inside.iter().copied();
        self.scene.objects.iter().map(|object| member(&object.solid, &mut rest)).collect()
    }

    /// The object and the surface that show at a place where objects change: the first object that changes
    /// there, and the first of its pieces whose crossing makes a difference.
    fn surface(&self, here: &[Crossing<N>], before: &[bool], after: &[bool], toward: DVec3) -> (N, f64, Hit) {
        let changes =
            |a: &[bool], b: &[bool], object: usize| self.in_objects(a)[object] != self.in_objects(b)[object];
        let object = (0..self.scene.objects.len()).find(|&o| changes(before, after, o)).unwrap_or_default();
        let matters = |crossing: &&Crossing<N>| {
            [before, after].iter().any(|state| {
                let mut other = state.to_vec();
                other[crossing.piece] = !other[crossing.piece];
                before[crossing.piece] != after[crossing.piece] && changes(state, &other, object)
            })
        };
        let own = || here.iter().filter(|c| self.pieces[c.piece].object == object);
        let shown =
            own().filter(matters).min_by_key(|c| c.piece).or_else(|| own().next()).unwrap_or(&here[0]);
        let normal = shown.outward;
        let hit = Hit {
            t: here[0].t.value(),
            object: object as u32 + 1,
            primitive: shown.piece as u32,
            entering: Some(self.in_objects(after)[object]),
            normal: if normal.dot(toward) > 0.0 { -normal } else { normal },
        };
        (here[0].t.clone(), here[0].slack, hit)
    }
}

/// Whether a solid holds a point, from whether each of its primitives does, in file order.
fn member(solid: &Solid, inside: &mut impl Iterator<Item = bool>) -> bool {
    // Every part takes its own primitives' answers, so none may be passed over.
    let mut all =
        |parts: &[Solid]| -> Vec<bool> { parts.iter().map(|part| member(part, &mut *inside)).collect() };
    match solid {
        Solid::Primitive(_) => inside.next().unwrap_or(false),
        Solid::Union(parts) => all(parts).contains(&true),
        Solid::Intersection(parts) => !parts.is_empty() && !all(parts).contains(&false),
        Solid::Difference(parts) => {
            let parts = all(parts);
            parts.first() == Some(&true) && !parts[1..].contains(&true)
        }
    }
}

/// A ray in the oracle's unit.
struct Ray<'r, N> {
    o: &'r Row<N>,
    d: &'r Row<N>,
    origin: DVec3,
    toward: DVec3,
}

impl<N: Number> Piece<N> {
    fn new(object: usize, primitive: &Primitive, unit: f64) -> Self {
        let mut map = primitive.map;
        map.matrix3 *= unit.recip();
        map.translation *= unit.recip();
        let surface = match &primitive.shape {
            Shape::Mesh(mesh) => Surface::Parity(Triangle::of(mesh, &map)),
            Shape::Bezier(patches) if patches.is_closed() => Surface::Patches(Patch::of(patches, &map)),
            open if open.is_surface() => Surface::Open(Open::new(open, &map)),
            convex => Surface::Convex(sides(convex, &map)),
        };
        let corners = primitive.shape.bounds().corners().map(|corner| map.transform_point3(corner));
        let ball = Ball::around(&corners);
        Self { object, surface, ball, map_error: primitive.map_error().length() / unit }
    }

    fn contains(&self, p: &Row<N>) -> bool {
        match &self.surface {
            Surface::Convex(sides) => sides.iter().all(|side| side.at(p).sign() <= 0),
            Surface::Parity(triangles) => {
                // Any direction will do; this one is along no axis or diagonal of a model.
                let toward = DVec3::new(0.537_651_3, 0.831_874_9, 0.137_229_1).normalize();
                let (from, d) = (DVec3::from_array(std::array::from_fn(|i| p[i].value())), direction(toward));
                let near = triangles.iter().filter(|t| t.ball.may_meet(from, toward));
                let in_front = near.filter_map(|t| t.crossing(p, &d)).filter(|t| t.sign() > 0);
                in_front.count() % 2 == 1
            }
            Surface::Patches(patches) => {
                let toward = DVec3::new(0.537_651_3, 0.831_874_9, 0.137_229_1).normalize();
                let (from, d) = (DVec3::from_array(std::array::from_fn(|i| p[i].value())), direction(toward));
                let near = patches.iter().filter(|patch| patch.ball.may_meet(from, toward));
                let in_front = near.flat_map(|patch| patch.crossings(p, &d)).filter(|on| on.t.sign() > 0);
                in_front.count() % 2 == 1
            }
            Surface::Open(_) => false,
        }
    }

    /// Calls `add` with each crossing in front of the origin and the outward normal there, of length 1 or 0.
    fn crossings(&self, ray: &Ray<N>, mut add: impl FnMut(N, DVec3)) {
        match &self.surface {
            Surface::Convex(sides) => {
                for (i, side) in sides.iter().enumerate() {
                    for t in side.crossings(ray.o, ray.d).into_iter().filter(|t| t.sign() > 0) {
                        let p = along(ray.o, ray.d, &t);
                        let mut others = sides.iter().enumerate().filter(|(j, _)| *j != i);
                        if others.all(|(_, other)| other.at(&p).value() <= SLACK) {
                            add(t, unit(&side.gradient(&p)));
                        }
                    }
                }
            }
            Surface::Parity(triangles) => {
                let toward = ray.toward.normalize();
                for triangle in triangles.iter().filter(|t| t.ball.may_meet(ray.origin, toward)) {
                    if let Some(t) = triangle.crossing(ray.o, ray.d).filter(|t| t.sign() > 0) {
                        add(t, triangle.unit_normal());
                    }
                }
            }
            Surface::Patches(patches) => {
                let toward = ray.toward.normalize();
                for patch in patches.iter().filter(|patch| patch.ball.may_meet(ray.origin, toward)) {
                    for on in patch.crossings(ray.o, ray.d).into_iter().filter(|on| on.t.sign() > 0) {
                        add(on.t, on.normal);
                    }
                }
            }
            Surface::Open(_) => {}
        }
    }
}

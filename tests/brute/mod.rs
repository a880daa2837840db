//! The depth of a scene along a ray, worked out the slow way: every surface of every primitive is one equation in
//! world coordinates, in arithmetic of 106 bits; all its crossings with the ray are sorted; and the points halfway
//! between them are tested for membership in the whole CSG expression. No lattice, no intervals, no pruning, no
//! coordinates of the primitive's own, and no code of the program's own.

mod open;
mod side;
mod wide;
mod worked;

use ray13::math::DVec3;
use ray13::scene::{Primitive, Scene, Shape, Solid};

use open::Open;
use side::{Row, Side, Triangle, along, direction, point, sides};
use wide::Wide;

/// Where a ray first meets the surface of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the origin, in lengths of the direction.
    pub t: f64,
    /// The place of the object in the scene, counted from 1.
    pub object: u32,
    /// Of length 1, turned to the side that the ray comes from. Zero at the tip of a cone.
    pub normal: DVec3,
}

/// A scene as a list of surfaces and an expression over them.
#[derive(Debug)]
pub struct Brute<'a> {
    scene: &'a Scene,
    pieces: Vec<Piece>,
    /// The length that counts as nothing: a stretch of ray shorter than this is not asked about.
    smallest: f64,
}

/// A primitive in the world.
#[derive(Debug)]
struct Piece {
    object: usize,
    surface: Surface,
    /// A ball around it.
    center: DVec3,
    radius: f64,
}

#[derive(Debug)]
enum Surface {
    /// Inside all of its sides.
    Convex(Vec<Side>),
    /// Inside an odd number of times.
    Parity(Vec<Triangle>),
    /// Without an inside.
    Open(Open),
}

/// A point of the ray where it may enter or leave a piece.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    t: Wide,
    piece: usize,
    outward: DVec3,
}

/// A crossing counts as on a primitive's surface where its other sides are passed by no more than this, in the units
/// of their equations (1 from the middle to the surface). Only the choice of candidates depends on it, not a depth:
/// a candidate too many changes no membership.
const SLACK: f64 = 1e-9;

/// Stretches of ray shorter than this share of the scene's size are of no account: they come from surfaces that
/// coincide, whose f64 data differ in the last digits.
const COINCIDENT: f64 = 1e-12;

impl<'a> Brute<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut pieces = Vec::new();
        for (object, part) in scene.objects.iter().enumerate() {
            part.solid.visit(&mut |primitive| pieces.push(Piece::new(object, primitive)));
        }
        let size = pieces.iter().map(|p| p.center.length() + p.radius).fold(0.0, f64::max);
        Self { scene, pieces, smallest: size * COINCIDENT }
    }

    /// The first point in front of the origin where the ray enters or leaves an object, or meets an open surface.
    pub fn hit(&self, origin: DVec3, toward: DVec3) -> Option<Hit> {
        let opens = self.pieces.iter().filter(|piece| piece.may_meet(origin, toward)).filter_map(|piece| {
            let Surface::Open(open) = &piece.surface else { return None };
            let (t, normal) = open.first(origin, toward)?;
            Some(Hit { t, object: piece.object as u32 + 1, normal })
        });
        let all: Vec<Hit> = opens.chain(self.solid_hit(origin, toward)).collect();
        let nearest = all.iter().map(|hit| hit.t).fold(f64::INFINITY, f64::min);
        // In one place the first in the file shows.
        let here = all.into_iter().filter(|hit| hit.t - nearest <= self.smallest / toward.length());
        here.min_by_key(|hit| hit.object)
    }

    /// The first point in front of the origin where the ray enters or leaves an object that is a solid. From outside
    /// all of them that is where it enters their union; from inside one it may be an object that lies within it.
    fn solid_hit(&self, origin: DVec3, toward: DVec3) -> Option<Hit> {
        let (o, d) = (point(origin), direction(toward));
        let mut crossings = Vec::new();
        for (index, piece) in self.pieces.iter().enumerate() {
            if piece.may_meet(origin, toward) {
                piece.crossings(index, &o, &d, &mut crossings);
            }
        }
        crossings.sort_by(|a, b| a.t.value().total_cmp(&b.t.value()).then(a.piece.cmp(&b.piece)));
        let smallest = self.smallest / toward.length();

        let half = Wide::from(0.5);
        let first = crossings.first()?;
        let mut before = self.inside(&crossings, &along(&o, &d, first.t * half));
        let mut at = 0;
        while at < crossings.len() {
            // One place: all crossings that follow each other closely.
            let mut end = at + 1;
            while end < crossings.len() && (crossings[end].t - crossings[end - 1].t).value() < smallest {
                end += 1;
            }
            let here = crossings[end - 1].t;
            let next = crossings.get(end).map_or(here + Wide::from(1.0), |next| next.t);
            let after = self.inside(&crossings, &along(&o, &d, (here + next) * half));
            if self.in_objects(&before) != self.in_objects(&after) {
                return Some(self.surface(&crossings[at..end], &before, &after, toward));
            }
            before = after;
            at = end;
        }
        None
    }

    /// Which pieces a point is in. One that the ray's crossings do not name is met nowhere on the ray.
    fn inside(&self, crossings: &[Crossing], p: &Row) -> Vec<bool> {
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

    /// The object and the surface that show at a place where objects change: the first object that changes there,
    /// and the first of its pieces whose crossing makes a difference.
    fn surface(&self, here: &[Crossing], before: &[bool], after: &[bool], toward: DVec3) -> Hit {
        let changes =
            |a: &[bool], b: &[bool], object: usize| self.in_objects(a)[object] != self.in_objects(b)[object];
        let object = (0..self.scene.objects.len()).find(|&o| changes(before, after, o)).unwrap_or_default();
        let matters = |crossing: &&Crossing| {
            [before, after].iter().any(|state| {
                let mut other = state.to_vec();
                other[crossing.piece] = !other[crossing.piece];
                before[crossing.piece] != after[crossing.piece] && changes(state, &other, object)
            })
        };
        let own = || here.iter().filter(|c| self.pieces[c.piece].object == object);
        let shown =
            own().filter(matters).min_by_key(|c| c.piece).or_else(|| own().next()).unwrap_or(&here[0]);
        let normal = shown.outward.normalize_or_zero();
        let normal = if normal.dot(toward) > 0.0 { -normal } else { normal };
        Hit { t: here[0].t.value(), object: object as u32 + 1, normal }
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

impl Piece {
    fn new(object: usize, primitive: &Primitive) -> Self {
        let map = &primitive.map;
        let surface = match &primitive.shape {
            Shape::Mesh(mesh) => Surface::Parity(Triangle::of(mesh, map)),
            open if open.is_surface() => Surface::Open(Open::new(open, map)),
            convex => Surface::Convex(sides(convex, map)),
        };
        let corners = primitive.shape.bounds().corners().map(|corner| map.transform_point3(corner));
        let center = corners.iter().fold(DVec3::ZERO, |sum, &p| sum + p / 8.0);
        let radius = corners.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
        Self { object, surface, center, radius }
    }

    /// Whether a ray comes near the ball; a hundredth of its radius is far more than any rounding.
    fn may_meet(&self, origin: DVec3, toward: DVec3) -> bool {
        let d = toward.normalize();
        let to = self.center - origin;
        (to - d * to.dot(d)).length() <= self.radius * 1.01 && to.dot(d) >= -self.radius * 1.01
    }

    fn contains(&self, p: &Row) -> bool {
        match &self.surface {
            Surface::Convex(sides) => sides.iter().all(|side| side.at(p).value() <= 0.0),
            Surface::Parity(triangles) => {
                // Any direction will do; this one is along no axis or diagonal of a model.
                let d = direction(DVec3::new(0.537_651_3, 0.831_874_9, 0.137_229_1));
                let in_front =
                    triangles.iter().filter_map(|t| t.crossing(p, &d)).filter(|t| t.value() > 0.0).count();
                in_front % 2 == 1
            }
            Surface::Open(_) => false,
        }
    }

    /// Adds the crossings in front of the origin.
    fn crossings(&self, piece: usize, o: &Row, d: &Row, found: &mut Vec<Crossing>) {
        let mut add = |t: Wide, outward: DVec3| {
            if t.value() > 0.0 {
                found.push(Crossing { t, piece, outward });
            }
        };
        match &self.surface {
            Surface::Convex(sides) => {
                for (i, side) in sides.iter().enumerate() {
                    for t in side.crossings(o, d) {
                        let p = along(o, d, t);
                        let mut others = sides.iter().enumerate().filter(|(j, _)| *j != i);
                        if others.all(|(_, other)| other.at(&p).value() <= SLACK) {
                            add(t, side.gradient(&p));
                        }
                    }
                }
            }
            Surface::Parity(triangles) => {
                for triangle in triangles {
                    if let Some(t) = triangle.crossing(o, d) {
                        add(t, triangle.normal());
                    }
                }
            }
            Surface::Open(_) => {}
        }
    }
}

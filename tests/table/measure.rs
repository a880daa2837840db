//! One kind of solid at one extreme: rays at it, and how the engine's answers differ from the oracle's.

use ray13::math::{DAffine3, DMat3, DVec3, Ray};
use ray13::scene::{Primitive, Scene, Shape, Solid};

use crate::conformance::aim::aimed;
use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, ExactEngine, Found, Subject as Engine};
use crate::conformance::solids::{CONE, CYLINDER, moved, placed, primitive, scene};
use crate::conformance::tally::{Tally, said, ulp};
use crate::support::oracle::{Big, Hit, Number, Oracle};

/// Solids of each kind at each extreme, and rays at each: the whole takes half a minute.
const SOLIDS: usize = 20;
const RAYS: usize = 30;

/// A kind of solid.
pub struct Subject {
    /// In capitals, as the chart writes it.
    pub name: &'static str,
    shape: Option<Shape>,
    /// Whether all its axes are alike.
    round: bool,
}

/// How large a solid is, how far from the origin, in radii, and how far from the eye, in radii.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub scale: f64,
    pub place: f64,
    pub distance: f64,
}

impl Case {
    /// Radius 1, seen from 10.
    pub const PLAIN: Self = Self { scale: 1.0, place: 1.0, distance: 10.0 };
}

/// What is measured; the last is an expression of three.
pub fn subjects() -> Vec<Subject> {
    let one = |name, shape: &Shape, round| Subject { name, shape: Some(shape.clone()), round };
    vec![
        one("SPHERE", &Shape::Sphere, true),
        one("ELLIPSOID", &Shape::Sphere, false),
        one("CYLINDER", &CYLINDER, false),
        one("CONE", &CONE, false),
        one("BOX", &Shape::Cube, false),
        Subject { name: "CSG", shape: None, round: true },
    ]
}

/// Many rays at solids of a kind.
pub fn measured(subject: &Subject, case: &Case, decade: i32) -> Tally {
    let mut sum = Tally::default();
    for number in 0..SOLIDS {
        let seed = (i64::from(decade) as u64) << 32 | number as u64;
        let chance = &mut Chance::new(subject.name, seed);
        let half = if subject.round {
            DVec3::ONE
        } else {
            DVec3::new(chance.within(0.3, 1.0), chance.within(0.3, 1.0), chance.within(0.3, 1.0))
        };
        let linear = chance.turn() * DMat3::from_diagonal(half * case.scale);
        let center = chance.direction() * case.place * case.scale;
        sum.add(match &subject.shape {
            Some(shape) => {
                let ratio = half.max_element() / half.min_element();
                of_one(&primitive(shape, linear, center), ratio, case, chance)
            }
            None => of_expression(&DAffine3::from_mat3_translation(linear, center), case, chance),
        });
    }
    sum
}

fn of_one(solid: &Primitive, ratio: f64, case: &Case, chance: &mut Chance) -> Tally {
    let engine = ExactEngine::new(&scene([Solid::Primitive(solid.clone())]), Cut::Tree);
    let rays: Vec<Ray> = (0..RAYS).map(|_| aimed(solid, case.distance * case.scale, chance)).collect();
    let mut tally = Tally::default();
    for (ray, found) in rays.iter().zip(engine.first(&rays)) {
        tally.count(&engine, solid, ratio, ray, found);
    }
    tally
}

/// A cube with a hole, and a ball that stands out of it.
fn of_expression(by: &DAffine3, case: &Case, chance: &mut Chance) -> Tally {
    let cube = placed(&Shape::Cube, DVec3::ZERO, DVec3::splat(0.8));
    let hole = placed(&CYLINDER, DVec3::ZERO, DVec3::new(0.4, 0.4, 0.8));
    let ball = placed(&Shape::Sphere, DVec3::X * 0.6, DVec3::splat(0.5));
    let whole = Solid::Union(vec![Solid::Difference(vec![cube, hole]), ball]);
    let world = scene([moved(&whole, by)]);
    let engine = ExactEngine::new(&world, Cut::Tree);
    let around = primitive(&Shape::Sphere, by.matrix3, by.translation);
    let rays: Vec<Ray> = (0..RAYS).map(|_| aimed(&around, case.distance * case.scale, chance)).collect();
    let oracle = Oracle::<Big>::new(&world);
    let mut tally = Tally::default();
    for (ray, found) in rays.iter().zip(engine.first(&rays)) {
        tally.rays += 1;
        match (found, oracle.exact_hit(ray.o, ray.d)) {
            (None, None) => {}
            (Some(found), Some((t, hit))) if is_near(&found, &hit) => {
                tally.hits += 1;
                let cosine = hit.normal.dot(ray.d).abs();
                let tangent = (1.0 - cosine * cosine).max(0.0).sqrt() / cosine;
                let length = found.t.max(by.translation.length().min(8.0 * case.scale) + case.scale);
                let error = (Big::from(found.t) - t).abs().value();
                tally.ulps = tally.ulps.max(error / (ulp(length) * (1.0 + tangent)));
                tally.stated = tally.stated.max(error / (found.error + ulp(found.t)));
            }
            (found, _) => {
                let beside = beside(ray, &world).any(|ray| match (found, oracle.hit(ray.o, ray.d)) {
                    (None, None) => true,
                    (Some(found), Some(hit)) => is_near(&found, &hit),
                    _ => false,
                });
                if beside {
                    tally.wrong_at_rim += 1;
                } else {
                    tally.wrong.push(said(&around, ray));
                }
            }
        }
    }
    tally
}

/// Whether two hits are on one surface: much nearer than any two of the expression's are, but along an edge.
fn is_near(found: &Found, hit: &Hit) -> bool {
    found.primitive == hit.primitive && (found.t - hit.t).abs() <= 1e-3 * hit.t
}

/// Rays to all sides of this one, at the engine's bound: 64 times the rounding of a map.
fn beside(ray: &Ray, world: &Scene) -> impl Iterator<Item = Ray> {
    let mut off = 0.0_f64;
    for object in &world.objects {
        object.solid.visit(&mut |p| off = off.max(64.0 * p.map_error().length()));
    }
    let ray = *ray;
    let aside = ray.d.any_orthonormal_vector();
    let other = ray.d.cross(aside);
    [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)]
        .into_iter()
        .map(move |(u, v)| Ray::new(ray.o + (aside * u + other * v) * off, ray.d))
}

//! Random expressions against the oracle.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use ray13::math::{DAffine3, DMat3, DVec3, Ray};
use ray13::scene::{Corner, Scene, Shape, Solid};

use crate::conformance::chance::Chance;
use crate::conformance::engine::{Cut, Found, Subject};
use crate::conformance::faults::assert_none;
use crate::conformance::long::{cases, report};
use crate::conformance::solids::{
    CONE, CYLINDER, TRUNCATED_CONE, any_patch, mesh, moved, pillow, prism, scene, solid,
};
use crate::conformance::tally::ulp;
use crate::support::oracle::{Big, Hit, Oracle};

/// Axes permuted and reversed, or any turn.
pub fn any_turn(chance: &mut Chance) -> DMat3 {
    if chance.below(2) == 0 {
        return chance.turn();
    }
    let first = chance.below(3);
    let second = (first + 1 + chance.below(2)) % 3;
    let (x, y) = (DVec3::AXES[first] * chance.sign(), DVec3::AXES[second] * chance.sign());
    DMat3::from_cols(x, y, x.cross(y))
}

/// On a coarse grid, so that faces are flush, edges meet and solids coincide.
fn any_primitive(chance: &mut Chance) -> Solid {
    let shape = chance.one_of(&[
        Shape::Sphere,
        Shape::Sphere,
        Shape::Cube,
        Shape::Cube,
        Shape::Cube,
        CYLINDER,
        CYLINDER,
        CONE,
        TRUNCATED_CONE,
        prism(),
        mesh(),
    ]);
    let turn = if chance.below(4) > 0 { DMat3::IDENTITY } else { any_turn(chance) };
    let mut step = |from: f64, count: usize| 0.5 * (from + chance.below(count) as f64);
    let half = DVec3::new(step(1.0, 3), step(1.0, 3), step(1.0, 3));
    let center = DVec3::new(step(-2.0, 5), step(-2.0, 5), step(-2.0, 5));
    solid(&shape, turn * DMat3::from_diagonal(half), center)
}

/// An expression so many operators deep at most, with one to three operands each.
pub fn any_solid(chance: &mut Chance, depth: usize) -> Solid {
    if depth == 0 || chance.below(4) == 0 {
        return any_primitive(chance);
    }
    let parts: Vec<Solid> = (0..=chance.below(3)).map(|_| any_solid(chance, depth - 1)).collect();
    match chance.below(3) {
        0 => Solid::Union(parts),
        1 => Solid::Intersection(parts),
        _ => Solid::Difference(parts),
    }
}

/// So many times the rounding of a scene's maps an engine's own rounding comes to. Its bound for a point is
/// 96 to 152 ulps of its unit ([`ROUNDING`](ray13::solid::ROUNDING)); that of a map is 4 ulps of how far the
/// solid reaches, which is half a unit at least for the farthest: 48 to 76 times as much.
const ENGINE: f64 = 64.0;

/// What was compared.
#[derive(Debug, Default)]
struct Comparison {
    rays: usize,
    hits: usize,
    uncertain: usize,
    faults: Vec<String>,
}

/// What the oracle says of the rays of one case.
type Answers = Arc<OnceLock<Vec<Option<Hit>>>>;

/// A random scene and its rays, which follow from these two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Case {
    name: &'static str,
    number: usize,
}

/// The oracle's answers by case: they take most of the time, and are the same for every engine.
static ANSWERS: Mutex<BTreeMap<Case, Answers>> = Mutex::new(BTreeMap::new());

/// The oracle's answers to the rays of a case, worked out by whoever asks first.
fn answers(case: Case, oracle: &Oracle<Big>, rays: &[Ray]) -> Answers {
    let answers = Arc::clone(ANSWERS.lock().unwrap().entry(case).or_default());
    answers.get_or_init(|| rays.iter().map(|ray| oracle.hit(ray.o, ray.d)).collect());
    answers
}

impl Comparison {
    /// Asks an engine and the oracle.
    fn compare<S: Subject>(&mut self, case: Case, world: &Scene, rays: &[Ray], cut: Cut) {
        let oracle = Oracle::<Big>::new(world);
        let answers = answers(case, &oracle, rays);
        let answers = answers.get().expect("worked out");
        assert_eq!(answers.len(), rays.len());
        for ((ray, found), &expected) in rays.iter().zip(S::new(world, cut).first(rays)).zip(answers) {
            self.rays += 1;
            self.hits += usize::from(expected.is_some());
            if agrees(found, expected, ray, 1.0) {
                continue;
            }
            // Within the engine's bound of another answer it may be right: where other surfaces than the
            // oracle's own tolerance makes one are one to it, and where the ray runs along a face or through
            // an edge, or starts on a surface.
            let clusters = [0.0, 1.0 / ENGINE, ENGINE]
                .map(|factor| Oracle::<Big>::with_tolerance(world, factor).hit(ray.o, ray.d));
            let beside = rays_beside(ray, ENGINE * map_error(world)).map(|ray| oracle.hit(ray.o, ray.d));
            if clusters.into_iter().chain(beside).any(|other| agrees(found, other, ray, ENGINE)) {
                self.uncertain += 1;
            } else {
                self.faults.push(format!("{case:?}: {found:?}, expected {expected:?}, {ray:?}"));
            }
        }
    }

    #[track_caller]
    fn assert_right(&self, what: &str) {
        let Self { rays, hits, uncertain, faults } = self;
        report(|| {
            format!("{what}: {rays} rays, {hits} hits, {uncertain} uncertain, {} faults", faults.len())
        });
        assert!(hits * 4 > *rays, "{hits} of {rays}");
        assert_none(faults, *rays);
        assert!(uncertain * 200 < *rays, "{uncertain} of {rays}");
    }
}

/// At random scales and turned, in four of ten from inside or far away.
pub fn random_expressions_agree_with_the_oracle<S: Subject>() {
    let mut all = Comparison::default();
    for case in 0..cases(250, 100) {
        let chance = &mut Chance::new("trees", case as u64);
        let scale = if chance.below(2) == 0 { 1.0 } else { chance.decade(-100.0, 100.0) };
        let by = DAffine3::from_mat3(any_turn(chance) * scale);
        let solids = (0..=chance.below(2)).map(|_| moved(&any_solid(chance, 4), &by));
        let world: Scene = scene(solids.collect::<Vec<_>>());
        let rays: Vec<Ray> = (0..20).map(|_| any_ray(&by, chance)).collect();
        all.compare::<S>(Case { name: "trees", number: case }, &world, &rays, chance.one_of(&Cut::ALL));
    }
    all.assert_right("trees");
}

/// Faces, patches and tubes among balls, at random scales and turned.
pub fn random_surfaces_agree_with_the_oracle<S: Subject>() {
    let mut all = Comparison::default();
    for case in 0..cases(150, 100) {
        let chance = &mut Chance::new("surfaces", case as u64);
        let scale = if chance.below(2) == 0 { 1.0 } else { chance.decade(-100.0, 100.0) };
        let by = DAffine3::from_mat3(chance.turn() * scale);
        let parts = (0..=1 + chance.below(4)).map(|_| moved(&any_surface(chance), &by));
        let world: Scene = scene(parts.collect::<Vec<_>>());
        let rays: Vec<Ray> = (0..20).map(|_| any_ray(&by, chance)).collect();
        all.compare::<S>(Case { name: "surfaces", number: case }, &world, &rays, chance.one_of(&Cut::ALL));
    }
    all.assert_right("surfaces");
}

/// Patches that bound nothing, and closed ones alone and in expressions, at random scales and turned.
pub fn random_patches_agree_with_the_oracle<S: Subject>() {
    let mut all = Comparison::default();
    for case in 0..cases(40, 100) {
        let chance = &mut Chance::new("patches", case as u64);
        let scale = if chance.below(2) == 0 { 1.0 } else { chance.decade(-12.0, 12.0) };
        let by = DAffine3::from_mat3(chance.turn() * scale);
        let part = match case % 4 {
            0 | 1 => solid(&any_patch(chance), chance.turn(), chance.point() * 0.5),
            2 => solid(&pillow(), DMat3::from_diagonal(DVec3::new(1.0, 0.8, 0.6)), chance.point() * 0.5),
            _ => {
                let own = || solid(&pillow(), DMat3::IDENTITY, DVec3::ZERO);
                let other = any_primitive(chance);
                let parts = vec![own(), other];
                if chance.below(2) == 0 { Solid::Difference(parts) } else { Solid::Intersection(parts) }
            }
        };
        let world: Scene = scene([moved(&part, &by)]);
        let rays: Vec<Ray> = (0..25).map(|_| any_ray(&by, chance)).collect();
        all.compare::<S>(Case { name: "patches", number: case }, &world, &rays, chance.one_of(&Cut::ALL));
    }
    all.assert_right("patches");
}

/// A star-shaped polygon, a triangle with normals, a tube, or a ball.
fn any_surface(chance: &mut Chance) -> Solid {
    let on_circle = |k: usize, count: usize, r: f64| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / count as f64);
        DVec3::new(r * cos, r * sin, 0.0)
    };
    let shape = match chance.below(6) {
        0 | 1 => {
            let count = 3 + chance.below(80);
            Shape::Face((0..count).map(|k| on_circle(k, count, chance.within(0.2, 2.0))).collect())
        }
        2 => {
            let corner = |k| Corner {
                place: on_circle(k, 3, chance.within(0.5, 2.0)),
                normal: DVec3::Z + chance.point(),
            };
            Shape::Patch((0..3).map(corner).collect())
        }
        3 => Shape::Tube { bottom: 1.0, top: 1.0 },
        4 => chance.one_of(&[Shape::Tube { bottom: 1.0, top: 0.0 }, Shape::Tube { bottom: 0.25, top: 1.0 }]),
        _ => Shape::Sphere,
    };
    let half = DVec3::new(chance.within(0.3, 1.5), chance.within(0.3, 1.5), chance.within(0.3, 1.5));
    solid(&shape, chance.turn() * DMat3::from_diagonal(half), chance.point())
}

/// Most from outside, aimed at the grid's points now and then; some from within, some from afar.
fn any_ray(by: &DAffine3, chance: &mut Chance) -> Ray {
    let mut target = chance.point() * 1.5;
    if chance.below(4) == 0 {
        target = (target * 2.0).round() / 2.0;
    }
    let d =
        if chance.below(8) == 0 { DVec3::AXES[chance.below(3)] * chance.sign() } else { chance.direction() };
    let distance = match chance.below(10) {
        0 | 1 => 0.0,
        2 | 3 => chance.decade(1.0, 6.0),
        _ => 8.0,
    };
    Ray::new(by.transform_point3(target - d * distance), by.transform_vector3(d).normalize())
}

/// How far rounding may have moved any surface of a scene.
fn map_error(scene: &Scene) -> f64 {
    let mut most = 0.0_f64;
    for object in &scene.objects {
        object.solid.visit(&mut |p| most = most.max(p.map_error().length()));
    }
    most
}

/// Rays that start to all sides of this one's start, before and behind it.
fn rays_beside(ray: &Ray, off: f64) -> impl Iterator<Item = Ray> {
    let ray = *ray;
    let aside = ray.d.any_orthonormal_vector();
    let frame = DMat3::from_cols(aside, ray.d.cross(aside), ray.d) * off;
    let step = |n: usize| DVec3::new((n % 3) as f64, (n / 3 % 3) as f64, (n / 9) as f64) - 1.0;
    (0..27).map(move |n| Ray::new(ray.o + frame * step(n), ray.d))
}

/// Whether a hit is the oracle's, at `share` times the distance from it that the engine allows itself.
fn agrees(found: Option<Found>, expected: Option<Hit>, ray: &Ray, share: f64) -> bool {
    match (found, expected) {
        (None, None) => true,
        (Some(found), Some(hit)) => {
            // A surface is said to be entered or left by a normal of its own, which the oracle has no word
            // for.
            let enters = hit.entering.is_none_or(|entering| entering == found.entering);
            // A ray that starts afar was rounded there, and so is its length.
            let off = share * (found.error + 4.0 * ulp(found.t) + 4.0 * ulp(ray.o.abs().max_element()));
            (found.t - hit.t).abs() <= off && found.object + 1 == hit.object && enters
        }
        _ => false,
    }
}

//! Patches whose crossings are known, and rays through what patches share.

use crate::math::{DAffine3, DMat3};
use crate::scene::BezierPatches;

use super::*;

fn surface(points: &[DVec3], patches: &[[u32; 16]], map: &DAffine3) -> BezierSurface {
    let patches = BezierPatches::new(points, patches);
    BezierSurface::new(&patches, &Placement::new(map).unwrap(), DVec3::ZERO)
}

fn one_patch(at: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    (0..16).map(|i| at(f64::from(i % 4) / 1.5 - 1.0, f64::from(i / 4) / 1.5 - 1.0)).collect()
}

const ALL: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

fn crossings(surface: &BezierSurface, ray: &Ray) -> Vec<End> {
    let mut found = Vec::new();
    surface.crossings(ray, |end| found.push(end));
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    found
}

/// Numbers from −1 to 1 that are the same on every run.
fn chance(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64) / f64::from(1 << 26) / f64::from(1 << 26) - 1.0
    }
}

fn any_ray(mut chance: impl FnMut() -> f64) -> Ray {
    let mut point = || DVec3::new(chance(), chance(), chance());
    let (target, d) = (point(), point().normalize());
    Ray::new(target - 3.0 * d, d)
}

#[test]
fn a_flat_patch_is_a_plane() {
    // Flat, but its parameters run unevenly.
    let points = one_patch(|x, y| {
        let (x, y) = (x + 0.2 * x * y, y + 0.1 * x);
        DVec3::new(x, y, 0.3 * x - 0.2 * y)
    });
    let flat = surface(&points, &[ALL], &DAffine3::IDENTITY);
    let normal = DVec3::new(-0.3, 0.2, 1.0);
    let (mut random, mut met) = (chance(1), 0);
    for _ in 0..2000 {
        let ray = any_ray(&mut random);
        let found = crossings(&flat, &ray);
        assert!(found.len() < 2, "{ray:?}: {found:?}");
        let Some(end) = found.first() else { continue };
        let t = -ray.o.dot(normal) / ray.d.dot(normal);
        assert!((end.t - t).abs() <= end.error + 8.0 * f64::EPSILON * t, "{ray:?}: {end:?} {t}");
        assert!(flat.normal(ray.at(end.t), end.surface).cross(normal.normalize()).length() < 1e-12);
        met += 1;
    }
    assert!(met > 500, "{met}");
}

#[test]
fn a_paraboloid_is_met_where_its_equation_says() {
    // z = x² + y², whose blossom along an axis is (ab + bc + ca)/3: 1, −1/3, −1/3 and 1.
    let square = |x: f64| if x.abs() > 0.5 { 1.0 } else { -1.0 / 3.0 };
    let points = one_patch(|x, y| DVec3::new(x, y, square(x) + square(y)));
    let bowl = surface(&points, &[ALL], &DAffine3::IDENTITY);
    let (mut random, mut met) = (chance(2), [0; 3]);
    for _ in 0..4000 {
        let ray = any_ray(&mut random);
        let Ray { o, d } = ray;
        let a = d.x * d.x + d.y * d.y;
        let b = 0.5 * (d.z - 2.0 * (o.x * d.x + o.y * d.y));
        let c = o.x * o.x + o.y * o.y - o.z;
        let root = (b * b - a * c).max(0.0).sqrt();
        // Too near to a silhouette, or to the rim, for so plain an equation.
        let expected = [(b - root) / a, (b + root) / a];
        let rim = |t: f64| ray.at(t).truncate().abs().max_element() - 1.0;
        if root < 1e-3 && root > 0.0 || expected.iter().any(|&t| rim(t).abs() < 1e-9) {
            continue;
        }
        let expected: Vec<f64> = expected.into_iter().filter(|&t| root > 0.0 && rim(t) < 0.0).collect();
        let found = crossings(&bowl, &ray);
        assert_eq!(found.len(), expected.len(), "{ray:?}: {found:?} {expected:?}");
        for (end, t) in found.iter().zip(&expected) {
            assert!((end.t - t).abs() <= end.error + 1e-12, "{ray:?}: {end:?} {t}");
            let p = ray.at(end.t);
            let normal = DVec3::new(2.0 * p.x, 2.0 * p.y, -1.0).normalize();
            assert!(bowl.normal(p, end.surface).cross(normal).length() < 1e-11);
        }
        met[found.len()] += 1;
    }
    assert!(met[1] > 400 && met[2] > 100, "{met:?}");
}

/// The six sides of a cube of half-size 1, their middles moved out by `bulge`; corners are bent by `bend`.
fn bent_box(bulge: f64, bend: f64) -> (Vec<DVec3>, Vec<[u32; 16]>) {
    let (mut points, mut patches) = (Vec::new(), Vec::new());
    for (axis, side) in [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)] {
        let first = points.len() as u32;
        points.extend(one_patch(|a, b| {
            let is_inner = a.abs() < 0.5 && b.abs() < 0.5;
            let mut p = [a, b, side * if is_inner { 1.0 + bulge } else { 1.0 }];
            p.rotate_right(axis);
            let [x, y, z] = p;
            DVec3::new(x + bend * y * z, y - bend * z * z, z + bend * x * y * y)
        }));
        patches.push(ALL.map(|i| first + i));
    }
    (points, patches)
}

#[test]
fn a_closed_surface_is_crossed_an_even_number_of_times() {
    let mut random = chance(3);
    let (mut rays, mut crossed) = (0, 0);
    for case in 0..6 {
        let (points, patches) = bent_box([0.0, 0.7, -0.5][case % 3], if case < 3 { 0.0 } else { 0.15 });
        let turn = if case % 2 == 0 {
            DMat3::IDENTITY
        } else {
            DMat3::from_axis_angle(DVec3::new(0.48, 0.6, 0.64), 2.0 * random())
        };
        let closed = surface(&points, &patches, &DAffine3::from_mat3(turn));
        assert!(closed.is_closed());
        for number in 0..1500 {
            // Through corners, points of edges, and control points: what patches share.
            let target = turn * points[number % points.len()];
            let other = turn * points[(7 * number + 3) % points.len()];
            let far = DVec3::new(random(), random(), random());
            let d = match number % 4 {
                0 => (target - other).normalize_or(DVec3::X),
                1 => turn * DVec3::AXES[number % 3],
                2 => (target - 3.0 * far).normalize(),
                _ => DVec3::AXES[number % 3],
            };
            let ray = Ray::new(target - 3.0 * d, d);
            let found = crossings(&closed, &ray);
            assert!(found.len().is_multiple_of(2), "case {case}, {ray:?}: {found:?}");
            (rays, crossed) = (rays + 1, crossed + usize::from(!found.is_empty()));
        }
    }
    assert!(crossed * 2 > rays, "{crossed} of {rays}");
}

#[test]
fn rays_beside_a_shared_side_are_told_apart() {
    let (points, patches) = bent_box(0.4, 0.0);
    let closed = surface(&points, &patches, &DAffine3::IDENTITY);
    for off in [1e-12, 1e-9, 1e-3] {
        for y in [-0.9, -1.0 / 3.0, 0.0, 0.777] {
            // The edge x = 1, z = 1, which is straight.
            let d = DVec3::new(1.0, 0.0, -1.0).normalize();
            let aside = DVec3::new(1.0, 0.0, 1.0).normalize() * off;
            let edge = DVec3::new(1.0, y, 1.0);
            let count = |p: DVec3| crossings(&closed, &Ray::new(p - 4.0 * d, d)).len();
            assert_eq!((count(edge - aside), count(edge + aside)), (2, 0), "{off} {y}");
        }
    }
}

#[test]
fn a_ray_along_a_patch_takes_bounded_work() {
    let (points, patches) = bent_box(0.0, 0.0);
    let closed = surface(&points, &patches, &DAffine3::IDENTITY);
    for (y, z) in [(0.0, 1.0), (1.0, 1.0), (0.3, -1.0), (-1.0, 1.0), (0.3, 1.0 - 1e-16)] {
        let found = crossings(&closed, &Ray::new(DVec3::new(-4.0, y, z), DVec3::X));
        assert!(found.len().is_multiple_of(2) && found.len() <= 4, "{y} {z}: {found:?}");
    }
    // Bent across the ray, and straight along it.
    let wall = surface(&one_patch(|x, y| DVec3::new(x, 0.4 * x * x, y)), &[ALL], &DAffine3::IDENTITY);
    for x in [-0.5, 0.0, 1.0 / 3.0, 0.7] {
        let o = DVec3::new(x, 0.4 * x * x, 5.0);
        assert!(crossings(&wall, &Ray::new(o, DVec3::NEG_Z)).len() < 16, "{x}");
    }
}

//! Closed surfaces of triangles.
//!
//! Whether a ray crosses a triangle is decided exactly, in the plane across the ray ([`super::ray_shear`]),
//! so that a closed surface is always crossed an even number of times. Single precision decides for most
//! rays of a packet beforehand ([`super::mesh_packet`]).

use std::borrow::Cow;
use std::ops::ControlFlow;

use fearless_simd::{Simd, SimdBase, f64x8};
use rayon::prelude::*;

use crate::bvh::{BuildPrimitive, Bvh8, MARGIN};
use crate::math::{Bounds, DVec3, LANES, Lanes, Mask, Number, Placement, Ray, RayPacket, Vector};
use crate::math::{REGISTERS, Rays};
use crate::scene;

use super::csg_query::PacketCrossings;
use super::ray_shear::{OnPlane, RayShear, plane_crossing, planes_met};
use super::span::{End, WORLD, rounding_at};

/// Points or triangles that one thread takes at a time: fewer are done before another thread could begin.
const STRETCH: usize = 8192;

/// A closed surface of triangles, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    points: Vec<DVec3>,
    /// The corners of each by their places in `points`, in the order in which they stand in `boxes`; without
    /// those that have no area whatever way they are looked at, which no line crosses.
    triangles: Vec<[u32; 3]>,
    boxes: Bvh8,
    bounds: Bounds,
    /// How far a corner may seem off its place.
    place_error: f64,
}

impl TriangleMesh {
    /// The triangles of `unit`, put at `place`, which may be off by `map_error`.
    pub fn new(unit: &scene::Mesh, place: &Placement, map_error: DVec3) -> Self {
        let points = mapped(&unit.points, |&p| place.linear * p + place.center);
        // Corners are moved into the world: they are what crossings are computed from.
        let reach = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let place_error = rounding_at(reach) + map_error.length();
        let corners = |t: &[u32; 3]| t.map(|i| points[i as usize]);
        let bounds = Bounds::around(unit.triangles.iter().flat_map(corners));
        let is_solid = |t: &&[u32; 3]| {
            let [a, b, c] = corners(t);
            a != b && b != c && c != a
        };
        // Mostly all are, and are copied only once their order is known.
        let solid = if unit.triangles.iter().all(|triangle| is_solid(&triangle)) {
            Cow::Borrowed(&unit.triangles)
        } else {
            Cow::Owned(unit.triangles.iter().filter(is_solid).copied().collect())
        };
        // What rounding makes of boxes is for a world of this size; a cutter may reach out of it.
        let margin = DVec3::splat(2.0 * place_error + MARGIN * (reach / WORLD));
        let mut boxes = Bvh8::over(solid.len(), |number| {
            let around = Bounds::around(corners(&solid[number])).padded(margin);
            BuildPrimitive::new(&around, number as u32)
        });
        let order = boxes.renumber();
        let triangles = mapped(&order, |&old| solid[old as usize]);
        Self { points, triangles, boxes, bounds, place_error }
    }

    /// Every crossing of the line with the surface, in no order.
    pub fn crossings(&self, ray: &Ray, mut found: impl FnMut(End)) {
        let crossed = self.crossed_by(ray);
        self.boxes.walk_line::<()>(ray, &mut |surface: u32, _: f64| {
            crossed(surface).into_iter().for_each(&mut found);
            ControlFlow::Continue(0.0)
        });
    }

    /// Where the line crosses a triangle, if it does.
    #[inline]
    pub(super) fn crossed_by<'a>(&'a self, ray: &'a Ray) -> impl Fn(u32) -> Option<End> + 'a {
        let across = RayShear::new(ray);
        move |surface| {
            let corners = self.corners(surface);
            across.meets_triangle(&corners).then(|| {
                let anchor = nearest(ray, &corners);
                let (t, error) = plane_crossing(ray, &corners, normal(&corners), anchor, self.place_error);
                End { t, error, surface }
            })
        }
    }

    /// Sets where those of a packet's rays that cross any of its triangles, `found.any`, meet the planes of
    /// the triangles that they cross, `found.surface`, and how far that may be off: as
    /// [`TriangleMesh::crossings`] finds it, for triangles that are not seen edge on.
    #[inline(always)]
    pub fn planes_of<S: Simd>(&self, simd: S, packet: &RayPacket, found: &mut PacketCrossings) {
        for register in 0..REGISTERS {
            let own = found.any >> (register * LANES) & 0xFF;
            if own == 0 {
                continue;
            }
            let rays = packet.load(simd, register);
            let corners = self.gathered(simd, own, register, &found.surface);
            let anchors = nearest_of(&rays, &corners);
            let OnPlane { t, error, .. } = planes_met(&rays, normals(&corners), anchors, self.place_error);
            found.t.store(register, t);
            found.error.store(register, error);
        }
    }

    /// The normals of the triangles that some rays of a register cross, as [`TriangleMesh::normal`] has them.
    #[inline(always)]
    pub fn normals_of<S: Simd>(
        &self,
        simd: S,
        some: u64,
        register: usize,
        surfaces: &Lanes<u32>,
    ) -> Vector<f64x8<S>> {
        normals(&self.gathered(simd, some, register, surfaces))
    }

    /// The corners of the triangles of a register's rays; of those that are not among `some`, any.
    #[inline(always)]
    fn gathered<S: Simd>(
        &self,
        simd: S,
        some: u64,
        register: usize,
        surfaces: &Lanes<u32>,
    ) -> [Vector<f64x8<S>>; 3] {
        let mut numbers = [[[0.0; LANES]; 3]; 3];
        let mut rest = some;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize % LANES;
            rest &= rest - 1;
            let corners = self.corners(surfaces.0[register * LANES + lane]);
            for corner in 0..3 {
                for axis in 0..3 {
                    numbers[corner][axis][lane] = corners[corner][axis];
                }
            }
        }
        // Not by `map`, whose closure is compiled by itself, for any processor.
        let [a, b, c] = &numbers;
        [vector(simd, a), vector(simd, b), vector(simd, c)]
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub fn corners(&self, surface: u32) -> [DVec3; 3] {
        let [a, b, c] = self.triangles[surface as usize];
        [self.points[a as usize], self.points[b as usize], self.points[c as usize]]
    }

    /// The normal of a triangle, of length 1, turned either way.
    pub fn normal(&self, surface: u32) -> DVec3 {
        normal(&self.corners(surface))
    }

    /// The boxes around its triangles, which are objects there.
    #[inline]
    pub fn boxes(&self) -> &Bvh8 {
        &self.boxes
    }

    /// How far a corner may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        let corners = self.triangles.iter().flatten();
        corners.map(|&p| self.points[p as usize].dot(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        self.bounds().meet(b).is_empty()
    }
}

/// Each of them by `f`; by all threads where they are many.
fn mapped<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Send + Sync) -> Vec<U> {
    if items.len() < STRETCH {
        return items.iter().map(f).collect();
    }
    items.par_iter().with_min_len(STRETCH).map(f).collect()
}

/// A vector of eight.
#[inline(always)]
fn vector<S: Simd>(simd: S, [x, y, z]: &[[f64; LANES]; 3]) -> Vector<f64x8<S>> {
    Vector { x: f64x8::from_slice(simd, x), y: f64x8::from_slice(simd, y), z: f64x8::from_slice(simd, z) }
}

/// The normal of a triangle, of length 1; any for one without area.
fn normal(corners: &[DVec3; 3]) -> DVec3 {
    normals(&corners.map(Vector::from)).into()
}

/// The same, of one triangle or of several.
#[inline(always)]
fn normals<N: Number>([a, b, c]: &[Vector<N>; 3]) -> Vector<N> {
    let (u, v) = (*b - *a, *c - *a);
    let normal = u.cross(v);
    let Vector { x, y, z } = normal.magnitude();
    (normal / x.larger(y.larger(z))).normalized_or(normal.same(DVec3::Z))
}

/// The corner whose plane equation has the smallest rounding.
fn nearest(ray: &Ray, corners: &[DVec3; 3]) -> DVec3 {
    nearest_of(&Rays::from(ray), &corners.map(Vector::from)).into()
}

/// The same, for one ray or for several, each with a triangle of its own.
#[inline(always)]
fn nearest_of<N: Number>(rays: &Rays<N>, [a, b, c]: &[Vector<N>; 3]) -> Vector<N> {
    let far =
        [(*a - rays.o).length_squared(), (*b - rays.o).length_squared(), (*c - rays.o).length_squared()];
    let second = far[1].is_below(far[0]);
    let (best, least) = (Vector::choose(second, *b, *a), second.choose(far[1], far[0]));
    Vector::choose(far[2].is_below(least), *c, best)
}

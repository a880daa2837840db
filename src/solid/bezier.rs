//! Surfaces of bicubic Bézier patches, traced as they are.
//!
//! In the plane across a ray ([`super::ray_shear`]) a patch is a map of the unit square, and the ray crosses
//! it where that map meets the origin. A patch is halved until a part certainly lies beside the ray, or is
//! crossed once at most ([`Cell::slopes`]); whether it is crossed then its rim says, which goes around the
//! origin or not, and where, Newton's method (Toth: On ray tracing parametric surfaces, SIGGRAPH 1985; as
//! there, a step is taken only where it can not lead to another crossing).
//!
//! What the rim says is decided for each curve by itself, and alike for all patches that share it
//! ([`super::bezier_edge`]). The answers of all parts of a closed surface add up to an even number, whatever
//! rounding does: no ray slips through between two patches, or is stopped by both.

use std::ops::ControlFlow;

use fearless_simd::{Simd, SimdBase, f64x8};

use crate::bvh::{BuildPrimitive, Bvh8, MARGIN};
use crate::math::{Bounds, DVec3, LANES, Number, Placement, Ray, Vector, lanes};
use crate::scene;

use super::bezier_cell::{Cell, range};
use super::bezier_piece::{LyingPiece, Nets, Piece, nearest, normals};
use super::bezier_shell::Shell;
use super::bezier_steep::Flatness;
use super::ray_shear::RayShear;
use super::span::{End, WORLD, rounding_at};

/// How far halving may move a point, as a share of how far the points of a piece lie from each other at most.
/// Each time, three means in a row are rounded by half an ulp of at most twice that distance, as the ray
/// passes among the points, sheared, which makes it √2 times as long; and it halves every second time:
/// 3 · ½ · 2 · √2 · (1 + 1 + ½ + ½ + …) < 17 ulps. Seven more are for the value at a root: four products and
/// three sums, twice.
const HALVING: f64 = 24.0 * f64::EPSILON;

/// So many parts of one piece are looked at for one ray; a ray that has not been told apart from the surface
/// by then runs along it. What is left counts as crossed where the rims say so, somewhere in its length.
const MOST_CELLS: usize = 4096;

/// Within a factor of this a crossing's error is known: more exactly would take more halving.
const SLOPES: f64 = 4.0;

/// A line so far from all control points passes beside them whatever rounding does, and so does the rim of
/// what they make: four times what either point may be off, and what rounding takes from two products and a
/// sum.
fn apart_from(place_error: f64) -> f64 {
    4.0 * place_error
}

/// A surface of Bézier patches, in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierSurface {
    /// In the order in which they stand in `boxes`.
    pieces: Vec<LyingPiece>,
    boxes: Bvh8,
    bounds: Bounds,
    is_closed: bool,
    /// How far a point may seem off its place; and how much of that is halving's, to within which a crossing
    /// is found.
    place_error: f64,
    fine: f64,
    /// The digits of each parameter of a crossing that its surface number has.
    uv_digits: u32,
}

impl BezierSurface {
    /// The patches of `unit`, put at `place`, which may be off by `map_error`.
    pub fn new(unit: &scene::BezierPatches, place: &Placement, map_error: DVec3) -> Self {
        let points: Vec<DVec3> = unit.points().iter().map(|&p| place.linear * p + place.center).collect();
        let cuts = unit.cuts();
        let mut pieces = Vec::with_capacity(unit.patches().len() << (2 * cuts));
        for patch in unit.patches() {
            Piece { points: patch.map(|index| points[index as usize]) }.cut(cuts, &mut pieces);
        }
        let reach = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let size = pieces.iter().map(Piece::size).fold(0.0, f64::max);
        let fine = HALVING * size;
        // Cutting moved points, too: three means in a row along each parameter, for each cut.
        let cut = f64::from(3 * cuts) * f64::EPSILON * reach;
        let place_error = rounding_at(reach) + cut + fine + map_error.length();
        let margin = DVec3::splat(2.0 * place_error + MARGIN * (reach / WORLD));
        let mut boxes = Bvh8::over(pieces.len(), |number| {
            BuildPrimitive::new(&pieces[number].bounds().padded(margin), number as u32)
        });
        let order = boxes.renumber();
        let bounds = pieces.iter().fold(Bounds::EMPTY, |b, piece| b.join(&piece.bounds()));
        let lying = |&old: &u32| {
            let piece = pieces[old as usize];
            let apart = apart_from(place_error);
            let flatness = Flatness::of(&piece.points, place_error, apart);
            LyingPiece { piece, flatness, shell: Shell::around(&piece.points, flatness.axis, apart) }
        };
        let pieces: Vec<LyingPiece> = order.iter().map(lying).collect();
        let uv_digits = (pieces.len().max(1) as u32 - 1).leading_zeros() / 2;
        Self { pieces, boxes, bounds, is_closed: unit.is_closed(), place_error, fine, uv_digits }
    }

    /// Every crossing of the line with the surface, in no order.
    pub fn crossings(&self, ray: &Ray, mut found: impl FnMut(End)) {
        let shear = RayShear::new(ray);
        let mut open = Vec::new();
        self.boxes.walk_line::<()>(ray, &mut |number: u32, _: f64| {
            self.cross_piece(number, ray, &shear, &mut open, &mut found);
            ControlFlow::Continue(0.0)
        });
    }

    /// The crossings of one piece. `open` is memory, empty before and after.
    fn cross_piece(
        &self,
        number: u32,
        ray: &Ray,
        shear: &RayShear,
        open: &mut Vec<Cell>,
        found: &mut impl FnMut(End),
    ) {
        let LyingPiece { piece, flatness, shell } = &self.pieces[number as usize];
        if shell.is_beside(ray.o.into(), ray.d.into()) {
            return;
        }
        let [mut x, mut y, mut along] = [[0.0; 16]; 3];
        for (i, &p) in piece.points.iter().enumerate() {
            [x[i], y[i], along[i]] = shear.sheared(p);
        }
        let nets = [x, y, along];
        let met = flatness.meet(&nets, ray.d.into(), shear.main(), self.fine);
        if met.hits {
            let error = self.error_of(met.slope, shear.step());
            found(End { t: met.along / shear.step(), error, surface: self.surface(number, met.uv) });
        } else if !met.beside {
            self.halve_piece(number, nets, shear, open, found);
        }
    }

    /// How far a crossing may be off, given the slope of the surface, for one ray or for several, and how far
    /// each goes along its main axis.
    #[inline(always)]
    pub(super) fn error_of<N: Number>(&self, slope: N, step: N) -> N {
        slope * self.place_error / step.magnitude()
    }

    /// The crossings of one ray with a piece that is not known to be met steeply.
    pub(super) fn cross_uncertain(&self, number: u32, ray: &Ray, found: &mut impl FnMut(End)) {
        let shear = RayShear::new(ray);
        let [mut x, mut y, mut along] = [[0.0; 16]; 3];
        for (i, &p) in self.pieces[number as usize].piece.points.iter().enumerate() {
            [x[i], y[i], along[i]] = shear.sheared(p);
        }
        self.halve_piece(number, [x, y, along], &shear, &mut Vec::new(), found);
    }

    /// The crossings of a piece, by halving it.
    fn halve_piece(
        &self,
        number: u32,
        [x, y, along]: Nets<f64>,
        shear: &RayShear,
        open: &mut Vec<Cell>,
        found: &mut impl FnMut(End),
    ) {
        open.push(Cell::whole(x, y, along));
        let mut looked_at = 0;
        while let Some(cell) = open.pop() {
            if cell.is_beside() || cell.is_apart(apart_from(self.place_error)) {
                continue;
            }
            looked_at += 1;
            let is_crossed_once = cell.is_crossed_once();
            if is_crossed_once && !cell.is_crossed_odd() {
                continue;
            }
            let slopes = is_crossed_once.then(|| cell.slopes(shear.shear));
            if let Some(slopes) = slopes.filter(|s| s.most <= SLOPES * s.least.max(1.0))
                && let Some(root) = cell.root(self.fine)
            {
                let error = self.error_of(slopes.most, shear.step());
                let surface = self.surface(number, root.uv);
                found(End { t: root.along / shear.step(), error, surface });
                continue;
            }
            match cell.halves(self.fine).filter(|_| looked_at < MOST_CELLS) {
                Some(halves) => open.extend(halves),
                None if cell.is_crossed_odd() => {
                    found(self.somewhere_in(&cell, shear, self.surface(number, cell.middle())));
                }
                None => {}
            }
        }
    }

    /// The crossing of a cell that is not known closer than that it is in there.
    fn somewhere_in(&self, cell: &Cell, shear: &RayShear, surface: u32) -> End {
        let [low, high] = range(&cell.along);
        let t = 0.5 * (low + high) / shear.step();
        End { t, error: 0.5 * (high - low) / shear.step().abs() + self.place_error, surface }
    }

    /// The number of the place of a crossing: its piece, and where in that, as far as there are digits.
    pub(super) fn surface(&self, piece: u32, uv: [f64; 2]) -> u32 {
        let steps = f64::from(1_u32 << self.uv_digits);
        let [u, v] = uv.map(|t| ((t * steps) as u32).min((1 << self.uv_digits) - 1));
        (piece << self.uv_digits | u) << self.uv_digits | v
    }

    /// The piece of a place, and the middle of the parameters that are meant by it.
    fn piece_of(&self, surface: u32) -> (&LyingPiece, [f64; 2]) {
        let digits = self.uv_digits;
        let part = |digits_behind: u32| {
            let steps = surface >> digits_behind & ((1 << digits) - 1);
            (f64::from(steps) + 0.5) / f64::from(1_u32 << digits)
        };
        (&self.pieces[(surface >> digits >> digits) as usize], [part(digits), part(0)])
    }

    /// The normal at a point of the surface, of length 1, turned either way.
    pub fn normal(&self, p: DVec3, surface: u32) -> DVec3 {
        let (LyingPiece { piece, .. }, uv) = self.piece_of(surface);
        let nets = piece.nets();
        normals(&nets, nearest(&nets, p.into(), uv)).into()
    }

    /// The same at the points that some rays of a register met; of the others, any.
    #[inline(always)]
    pub fn normals_of<S: Simd>(
        &self,
        simd: S,
        some: u64,
        surfaces: &[u32],
        p: Vector<f64x8<S>>,
    ) -> Vector<f64x8<S>> {
        let mut numbers = [[[0.0; LANES]; 16]; 3];
        let mut near = [[0.5; LANES]; 2];
        for lane in lanes(some) {
            let (LyingPiece { piece, .. }, uv) = self.piece_of(surfaces[lane]);
            for (i, p) in piece.points.iter().enumerate() {
                for axis in 0..3 {
                    numbers[axis][i][lane] = p[axis];
                }
            }
            (near[0][lane], near[1][lane]) = (uv[0], uv[1]);
        }
        let zero = f64x8::splat(simd, 0.0);
        let mut nets = [[zero; 16]; 3];
        for axis in 0..3 {
            for i in 0..16 {
                nets[axis][i] = f64x8::from_slice(simd, &numbers[axis][i]);
            }
        }
        let near = [f64x8::from_slice(simd, &near[0]), f64x8::from_slice(simd, &near[1])];
        normals(&nets, nearest(&nets, p, near))
    }

    /// The boxes around its pieces, which are objects there.
    #[inline]
    pub fn boxes(&self) -> &Bvh8 {
        &self.boxes
    }

    /// A piece, and how near to it a crossing is found.
    #[inline(always)]
    pub(super) fn piece(&self, number: u32) -> (&LyingPiece, f64) {
        (&self.pieces[number as usize], self.fine)
    }

    /// Whether it is the surface of a solid.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// How far a point may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// How far it reaches along `v`, or a little less than its control points do: the greatest `p · v`.
    pub fn support(&self, v: DVec3) -> f64 {
        let points = self.pieces.iter().flat_map(|lying| lying.piece.points);
        points.map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// A box around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Whether the box is certainly outside.
    pub fn misses(&self, b: &Bounds) -> bool {
        self.bounds().meet(b).is_empty()
    }
}

#[cfg(test)]
mod tests;

//! Spheres that stayed spheres: a centre and a radius.

use crate::math::{Bounds, DVec3, Mask, Number, Rays, Real, Vector};

use super::classification::Classification;
use super::span::{Ends, LIMIT, ROUNDING, Spans, WORLD, rounding_at};

/// The points within `radius` of `center`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The centre.
    pub center: DVec3,
    /// The radius, above 0; at 0 no ray meets it.
    pub radius: f64,
    /// How far a point of it may be off its place, by its map and by our own rounding.
    place_error: f64,
}

/// The [`rounding_at`] of a ball whose centre is within the world. One from farther away only cuts, or is
/// cut: how little is known of its chords is in their errors.
const SEEN: f64 = ROUNDING * (WORLD + LIMIT);

/// A ball, or one for each of as many rays as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balls<N> {
    center: Vector<N>,
    radius: N,
    place_error: N,
    /// The square of half a chord that the map's own error could have made, and its root.
    grazing: [N; 2],
}

/// Numbers that say what a ball is.
pub(super) const NUMBERS_OF_BALL: usize = 5;

impl<N: Number> Balls<N> {
    /// Balls of numbers that [`Ball::numbers`] gives.
    #[inline(always)]
    pub fn new([x, y, z, radius, place_error]: [N; NUMBERS_OF_BALL]) -> Self {
        let grazing = radius * 2.0 * place_error;
        Self { center: Vector { x, y, z }, radius, place_error, grazing: [grazing, grazing.root()] }
    }

    /// Where each ray is inside its ball.
    ///
    /// The origin is moved to the point of the ray closest to the centre, twice: the first move leaves an
    /// error in proportion to the distance, the second removes it along the ray. The half-chord then comes
    /// from `(r − l)(r + l)`, which does not cancel as `b² − 4ac` does (Haines, Günther, Akenine-Möller:
    /// Precision improvements for ray/sphere intersection, Ray Tracing Gems, 2019).
    #[inline(always)]
    pub fn spans(&self, rays: &Rays<N>) -> Spans<N> {
        let Self { center, radius, place_error, grazing: [grazing, grazing_root] } = *self;
        let like = rays.o.x;
        let from_center = rays.o - center;
        let first = -from_center.dot(rays.d);
        let near = from_center + rays.d * first;
        let second = -near.dot(rays.d);
        let near = near + rays.d * second;
        let l_squared = near.length_squared();
        let near_enough = l_squared.is_at_most(if N::IS_DOUBLE {
            radius * radius
        } else {
            radius * radius + grazing + place_error * place_error
        });
        if !near_enough.any() {
            return Spans::none(like);
        }
        let l = l_squared.root();
        let half_squared = (-l + radius) * (l + radius);
        // Moving the ray sideways changes the square of the half-chord by 2·l times as much.
        let least = if N::IS_DOUBLE { radius * 2.0 * SEEN } else { grazing };
        let any = near_enough & half_squared.is_above(least);
        let half = half_squared.root();
        // Half a chord that the map's own error could have made is off by no more than all of that.
        let sideways = half_squared.is_below(grazing).choose(grazing_root, l * place_error / half);
        let error = sideways + place_error;
        let middle = first + second;
        let surface = like.same(0.0);
        Spans {
            enter: Ends { t: middle - half, error, surface },
            leave: Ends { t: middle + half, error, surface },
            any,
            may: if N::IS_DOUBLE { any } else { near_enough },
        }
    }
}

impl Ball {
    /// What [`Balls::new`] asks for.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f64; NUMBERS_OF_BALL] {
        let [x, y, z] = self.center.to_array();
        [x, y, z, self.radius, self.place_error]
    }

    /// A ball whose map may be off by `map_error`.
    pub fn new(center: DVec3, radius: f64, map_error: DVec3) -> Self {
        Self { center, radius, place_error: rounding_at(center.length()) + map_error.length() }
    }

    /// The same ball for each of as many rays as there are numbers in `like`.
    #[inline(always)]
    fn for_all<N: Number>(&self, like: N) -> Balls<N> {
        let Self { center, radius, place_error } = *self;
        let place_error = place_error * N::EPSILON_RATIO;
        let grazing = 2.0 * radius * place_error;
        let Vector { x, y, z } = Vector::from(center);
        Balls {
            center: Vector { x: like.same(x), y: like.same(y), z: like.same(z) },
            radius: like.same(radius),
            place_error: like.same(place_error),
            grazing: [like.same(grazing), like.same(grazing.sqrt())],
        }
    }

    /// Where each ray is inside. A chord that rounding could have made counts as none.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Spans<N> {
        self.for_all(rays.o.x).spans(rays)
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    pub fn place_error(&self) -> f64 {
        self.place_error
    }

    /// The most that the `error` of any of its ends can be: half a chord whose square is below
    /// `2·r·place_error` is off by no more than the root of that, and one above it by less than half of that
    /// root.
    pub fn most_error<T: Real>(&self) -> f64 {
        let place_error = self.place_error * T::EPSILON_RATIO;
        place_error + (2.0 * self.radius * place_error).sqrt()
    }

    /// The share of its errors that our own rounding may have made.
    pub fn rounding_share(&self) -> f64 {
        (SEEN / self.place_error).min(1.0)
    }

    /// The outward normals at points of the surface; their length is 1 within rounding.
    #[inline(always)]
    pub fn normals<N: Number>(&self, p: Vector<N>) -> Vector<N> {
        (p - self.center) / p.x.same(self.radius)
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        Bounds::new(self.center - self.radius, self.center + self.radius)
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points.
    pub fn support(&self, v: DVec3) -> f64 {
        self.center.dot(v) + self.radius * v.length()
    }

    /// How it lies to a box.
    pub fn classify(&self, b: &Bounds) -> Classification {
        let (from_center, half) = ((b.center() - self.center).abs(), b.half());
        // Radii are far from numbers whose squares are none.
        let square = self.radius * self.radius;
        Classification::of((from_center - half).max(DVec3::ZERO).length_squared() > square, || {
            (from_center + half).length_squared() < square
        })
    }
}

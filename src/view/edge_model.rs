//! How much of a dot lies on one side of an edge of which only some points are known: the mean over all
//! straight lines that part those of one side from those of the other.
//!
//! A line is a direction and a distance from the middle of the dot, and all are taken to be equally likely:
//! the measure of lines that no turn and no shift of the picture changes. So the mean is what the area is
//! expected to be, and its deviation how far off that is, in the root of the mean of squares.

use std::f64::consts::TAU;

use crate::math::DVec2;

use super::sample_points::sample_point;

/// Directions across edges: those of a half turn, since the lines of the other half are the same with their
/// sides exchanged. With half as many, one fit in fifteen of 4 points with those of the dots around finds
/// none between the directions that are tried; with these one in a hundred.
const DIRECTIONS: usize = 32;

/// The first samples of a dot that are told apart.
pub const FITTED: usize = 16;

/// Where lines may pass is taken at three places of each gap between points (Gauss and Legendre): from the
/// middle of the gap in halves of it, and the weight.
const NODES: [[f64; 2]; 3] =
    [[-0.774_596_669_241_483_4, 5.0 / 18.0], [0.0, 8.0 / 18.0], [0.774_596_669_241_483_4, 5.0 / 18.0]];

/// How far along each direction something lies.
type Along = [f32; DIRECTIONS];

/// How far along each direction some points reach.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    least: Along,
    most: Along,
}

/// A share of a dot, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// What is expected.
    pub mean: f64,
    /// How far off that is, in the root of the mean of squares.
    pub deviation: f64,
}

/// Straight edges through a dot.
#[derive(Clone, Debug)]
pub struct EdgeModel {
    slopes: [Slope; DIRECTIONS],
    /// By sample of a dot.
    samples: [Along; FITTED],
    /// By dot of the block of three by three around one: its middle.
    middles: [Along; 9],
}

/// Lines across one direction.
#[derive(Clone, Copy, Debug)]
struct Slope {
    /// How far from the middle of the dot those are that touch its corners: the outer two, and the inner two.
    outer: f64,
    inner: f64,
    /// What the squares of distances to those are to be multiplied by.
    scale: f64,
}

impl Extent {
    /// Of no points.
    pub const NONE: Self = Self { least: [f32::INFINITY; DIRECTIONS], most: [f32::NEG_INFINITY; DIRECTIONS] };

    /// The same with the points of another.
    #[inline]
    pub fn add_all(&mut self, other: &Self) {
        for (own, other) in self.least.iter_mut().zip(other.least) {
            *own = if other < *own { other } else { *own };
        }
        for (own, other) in self.most.iter_mut().zip(other.most) {
            *own = if other > *own { other } else { *own };
        }
    }
}

impl Slope {
    fn across(n: DVec2) -> Self {
        let (a, b) = (n.x.abs(), n.y.abs());
        Self { outer: 0.5 * (a + b), inner: 0.5 * (a - b), scale: 0.5 / (a * b) }
    }

    /// The share of the dot that lies before the line at this distance from its middle.
    #[inline]
    fn share_before(&self, distance: f64) -> f64 {
        let square = |beyond: f64| {
            let beyond = if beyond > 0.0 { beyond } else { 0.0 };
            beyond * beyond
        };
        let Self { outer, inner, scale } = *self;
        let sum = square(distance + outer) - square(distance + inner) - square(distance - inner)
            + square(distance - outer);
        (sum * scale).clamp(0.0, 1.0)
    }
}

impl Default for EdgeModel {
    /// That of the dots of any picture.
    fn default() -> Self {
        // Half a step aside: no line runs along the sides of the dot, where its area has corners.
        let angle = |k: usize| (k as f64 + 0.5) / (2 * DIRECTIONS) as f64 * TAU;
        let normals: [DVec2; DIRECTIONS] =
            std::array::from_fn(|k| DVec2::new(libm::cos(angle(k)), libm::sin(angle(k))));
        let along = |[x, y]: [f64; 2]| normals.map(|n| (n.x * x + n.y * y) as f32);
        Self {
            slopes: normals.map(Slope::across),
            samples: std::array::from_fn(|number| along(sample_point(number as u32))),
            middles: std::array::from_fn(|dot| along([(dot % 3) as f64 - 1.0, (dot / 3) as f64 - 1.0])),
        }
    }
}

impl EdgeModel {
    /// Adds a sample of a dot of the block of three by three around the one that is asked about; `dot` counts
    /// its dots in scan order, `sample` is below [`FITTED`].
    #[inline(always)]
    pub fn add(&self, extent: &mut Extent, dot: usize, sample: usize) {
        let (middle, sample) = (&self.middles[dot], &self.samples[sample]);
        // A loop, of which the compiler makes registers of any width.
        for k in 0..DIRECTIONS {
            let at = middle[k] + sample[k];
            extent.least[k] = if at < extent.least[k] { at } else { extent.least[k] };
            extent.most[k] = if at > extent.most[k] { at } else { extent.most[k] };
        }
    }

    /// The share of the dot on the side of some points of a straight edge that has other points on its other
    /// side; `None` where there is no such edge. Of both there is one point at least.
    pub fn share(&self, inside: &Extent, outside: &Extent) -> Option<Share> {
        let (mut weight, mut first, mut second) = (0.0, 0.0, 0.0);
        let mut add = |gap: f64, share: f64| {
            weight += gap;
            first += gap * share;
            second += gap * share * share;
        };
        for (k, slope) in self.slopes.iter().enumerate() {
            // The points are before the line, or beyond it.
            for (from, to, is_before) in
                [(inside.most[k], outside.least[k], true), (outside.most[k], inside.least[k], false)]
            {
                if from >= to {
                    continue;
                }
                let (from, to) = (f64::from(from), f64::from(to));
                for [at, part] in NODES {
                    let before = slope.share_before(0.5 * (from + to) + 0.5 * (to - from) * at);
                    add((to - from) * part, if is_before { before } else { 1.0 - before });
                }
            }
        }
        (weight > 0.0).then(|| {
            let mean = first / weight;
            Share { mean, deviation: (second / weight - mean * mean).max(0.0).sqrt() }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::edge_error;

    /// The root of the mean of squares of how far shares are off, and of what is said of that, over edges of
    /// many directions and places, by the first `rays` samples of a dot and of the dots around it.
    fn errors(rays: usize, beside: usize) -> [f64; 2] {
        let model = EdgeModel::default();
        let (mut off, mut said, mut edges) = (0.0, 0.0, 0.0);
        for direction in 0..61 {
            let angle = (f64::from(direction) + 0.31) / 61.0 * TAU;
            let n = DVec2::new(libm::cos(angle), libm::sin(angle));
            let slope = Slope::across(n);
            for place in 0..16 {
                let distance = slope.outer * ((f64::from(place) + 0.5) / 8.0 - 1.0);
                let [mut before, mut beyond] = [Extent::NONE; 2];
                for dot in 0..9 {
                    let middle = DVec2::new((dot % 3) as f64 - 1.0, (dot / 3) as f64 - 1.0);
                    for sample in 0..if dot == 4 { rays } else { beside } {
                        let point = middle + DVec2::from(sample_point(sample as u32));
                        let side = if n.dot(point) < distance { &mut before } else { &mut beyond };
                        model.add(side, dot, sample);
                    }
                }
                let Some(share) = model.share(&before, &beyond) else { continue };
                let other = model.share(&beyond, &before).unwrap();
                assert!((share.mean + other.mean - 1.0).abs() < 1e-12);
                let error = share.mean - slope.share_before(distance);
                off += error * error;
                said += share.deviation * share.deviation;
                edges += 1.0;
            }
        }
        // Between the directions that are tried a few edges are not found.
        assert!(edges > 0.9 * 61.0 * 16.0, "{edges} edges");
        [off, said].map(|squares| f64::sqrt(squares / edges))
    }

    #[test]
    fn edges_lie_where_points_say_and_as_exactly_as_is_said() {
        for (rays, beside) in [(1, 1), (2, 2), (4, 1), (4, 4), (8, 4), (16, 4)] {
            let [off, said] = errors(rays, beside);
            assert!((0.75..1.35).contains(&(off / said)), "{rays}, {beside}: off by {off}, said {said}");
        }
    }

    #[test]
    fn four_rays_with_those_around_are_as_good_as_ten_alone() {
        assert!(errors(4, 4)[0] < edge_error(10));
    }

    #[test]
    fn a_ring_of_points_has_no_straight_edge() {
        let model = EdgeModel::default();
        let [mut middle, mut ring] = [Extent::NONE; 2];
        (0..9).for_each(|dot| model.add(if dot == 4 { &mut middle } else { &mut ring }, dot, 0));
        assert_eq!(model.share(&middle, &ring), None);
        assert_eq!(model.share(&ring, &middle), None);
    }

    #[test]
    fn an_edge_midway_between_two_rows_of_dots_takes_nothing() {
        let model = EdgeModel::default();
        let [mut above, mut below] = [Extent::NONE; 2];
        (0..9).for_each(|dot| model.add(if dot < 3 { &mut above } else { &mut below }, dot, 0));
        let share = model.share(&above, &below).unwrap();
        // The line lies between the upper row and the middle of the dot, which reaches half as far.
        assert!((0.05..0.25).contains(&share.mean), "{share:?}");
        assert!(share.deviation < 0.2, "{share:?}");
    }
}

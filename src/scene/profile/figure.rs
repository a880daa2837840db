//! A plane figure as outlines.

use crate::math::{Bounds, DAffine3, DVec2, DVec3};

/// What is inside of some outlines: each lies within the figure's plane, crosses neither itself nor another,
/// and has the inside on its left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The parts that do not hang together.
    pub regions: Vec<Region>,
    /// How far a corner may be off the place that exact arithmetic would give it.
    pub error: f64,
}

/// A part of a figure that hangs together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    /// Counter-clockwise.
    pub outer: Vec<DVec2>,
    /// Clockwise.
    pub holes: Vec<Vec<DVec2>>,
}

/// How figures are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureOperator {
    /// What is in any.
    Union,
    /// What is in all.
    Intersection,
    /// What is in the first and in no other.
    Difference,
}

impl Region {
    /// Its outlines, the outer one first.
    pub fn rings(&self) -> impl Iterator<Item = &Vec<DVec2>> {
        std::iter::once(&self.outer).chain(&self.holes)
    }
}

impl Figure {
    /// A convex figure, whose corners go round counter-clockwise.
    pub fn convex(outer: Vec<DVec2>) -> Self {
        Self { regions: vec![Region { outer, holes: Vec::new() }], error: 0.0 }
    }

    /// All outlines.
    pub fn rings(&self) -> impl Iterator<Item = &Vec<DVec2>> {
        self.regions.iter().flat_map(Region::rings)
    }

    /// All corners.
    pub fn corners(&self) -> impl Iterator<Item = DVec2> {
        self.rings().flatten().copied()
    }

    /// How many corners there are.
    pub fn count(&self) -> usize {
        self.rings().map(Vec::len).sum()
    }

    /// A box around it, in the plane z = 0.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.corners().map(|corner| corner.extend(0.0)))
    }

    /// The figure under what a map does within the plane; none where that makes it flat, or sends it beyond
    /// all numbers.
    pub fn mapped(&self, map: &DAffine3) -> Option<Self> {
        let [x, y] = [map.matrix3.x_axis, map.matrix3.y_axis].map(DVec3::truncate);
        let turn = x.perp_dot(y);
        if turn == 0.0 {
            return None;
        }
        let place = |p: &DVec2| x * p.x + y * p.y + map.translation.truncate();
        let ring = |ring: &Vec<DVec2>| {
            let mut placed: Vec<DVec2> = ring.iter().map(place).collect();
            if turn < 0.0 {
                placed.reverse();
            }
            placed
        };
        let region = |region: &Region| Region {
            outer: ring(&region.outer),
            holes: region.holes.iter().map(ring).collect(),
        };
        let error = self.error * (x.length() + y.length());
        let mapped = Self { regions: self.regions.iter().map(region).collect(), error };
        let is_finite = mapped.corners().all(DVec2::is_finite);
        is_finite.then_some(mapped)
    }
}

//! Makes equal corners one.

use std::hash::{BuildHasher, RandomState};

use crate::math::DVec3;

/// Marks a slot that holds no point.
const FREE: u32 = u32::MAX;

/// Points that differ, numbered in the order in which they came. A map by hashing that keeps nothing but
/// their numbers: a file of a million triangles names three million corners.
pub struct Welder {
    points: Vec<DVec3>,
    /// Numbers of points, each at the first free slot from its hash on; a power of two of them, of which at
    /// most half are taken.
    slots: Vec<u32>,
    /// Of random keys: no file can have points that all take one slot.
    hasher: RandomState,
}

impl Welder {
    /// No points so far.
    pub fn new() -> Self {
        Self { points: Vec::new(), slots: vec![FREE; 64], hasher: RandomState::new() }
    }

    /// The number of a point, whose coordinates are finite.
    pub fn number(&mut self, point: DVec3) -> u32 {
        // Adding 0 makes −0 and 0 the same.
        let point = point + DVec3::ZERO;
        let slot = self.slot(point);
        if self.slots[slot] != FREE {
            return self.slots[slot];
        }
        let number = self.points.len() as u32;
        self.points.push(point);
        self.slots[slot] = number;
        if 2 * self.points.len() > self.slots.len() {
            self.grow();
        }
        number
    }

    /// The points, by their numbers.
    pub fn into_points(self) -> Vec<DVec3> {
        let mut points = self.points;
        points.shrink_to_fit();
        points
    }

    /// Where the number of a point stands, or is to stand.
    fn slot(&self, point: DVec3) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = self.hasher.hash_one(point.to_array().map(f64::to_bits)) as usize & mask;
        while self.slots[slot] != FREE && self.points[self.slots[slot] as usize] != point {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        let slots = 2 * self.slots.len();
        self.slots.clear();
        self.slots.resize(slots, FREE);
        for number in 0..self.points.len() {
            let slot = self.slot(self.points[number]);
            self.slots[slot] = number as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_have_one_number() {
        let mut welder = Welder::new();
        let point = |i: u32| DVec3::new(f64::from(i % 100), f64::from(i / 100), -0.0);
        for round in 0..2 {
            for i in 0..5000 {
                assert_eq!(welder.number(point(i)), i, "{round}");
            }
        }
        assert_eq!(welder.number(DVec3::new(1.0, 0.0, 0.0)), 1);
        let points = welder.into_points();
        assert!(points.len() == 5000 && points[4999] == point(4999));
    }
}

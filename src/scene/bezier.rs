//! Surfaces of bicubic Bézier patches that share control points.

use std::collections::{HashMap, HashSet};

use crate::math::DVec3;

/// Bicubic Bézier patches. Where they close, they are the surface of a solid: the points around which an odd
/// number of surfaces lie. Else they are a surface that bounds nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPatches {
    /// Control points, in the surface's own coordinates; no two are equal.
    points: Vec<DVec3>,
    /// Sixteen indices into `points` each: four rows of four.
    patches: Vec<[u32; 16]>,
    /// The control points of a boundary curve, from one end to the other, that an odd number of patches have.
    open: Option<[u32; 4]>,
}

/// Patches are cut into so many pieces at most for rays; where they are more themselves, they are not cut.
const MOST_PIECES: usize = 1 << 14;

/// So often a patch is cut in four at most. A piece of a patch that bends by a quarter turn is flat to half a
/// hundredth of its size then, and mostly crossed by a ray once at most. With 3 cuts the teapot has 2.4
/// times as many rays in doubt, which are asked one by one.
const MOST_CUTS: u32 = 4;

/// The sides of a patch: the places of their control points in its four rows of four.
const SIDES: [[usize; 4]; 4] = [[0, 1, 2, 3], [3, 7, 11, 15], [15, 14, 13, 12], [12, 8, 4, 0]];

impl BezierPatches {
    /// The patches that have these control points, by their places among `points`, all of which must be
    /// there. Equal points become one.
    pub fn new(points: &[DVec3], patches: &[[u32; 16]]) -> Self {
        let mut places = HashMap::new();
        let mut own = Vec::new();
        let mut place = |index: u32| {
            // Adding 0 makes −0 and 0 the same point.
            let point = points[index as usize] + DVec3::ZERO;
            *places.entry(point.to_array().map(f64::to_bits)).or_insert_with(|| {
                own.push(point);
                own.len() as u32 - 1
            })
        };
        let patches: Vec<_> = patches.iter().map(|patch| patch.map(&mut place)).collect();
        let open = open_side(&patches);
        Self { points: own, patches, open }
    }

    /// The control points; each is one of a patch, and no two are equal.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The patches, as indices of their control points: four rows of four.
    pub fn patches(&self) -> &[[u32; 16]] {
        &self.patches
    }

    /// How often each patch is cut in four for rays: all as often, so that patches which share a side share
    /// its parts.
    pub fn cuts(&self) -> u32 {
        (0..=MOST_CUTS).rev().find(|cuts| self.patches.len() << (2 * cuts) <= MOST_PIECES).unwrap_or(0)
    }

    /// Whether each boundary curve belongs to an even number of patches, so that the surface has an inside.
    pub fn is_closed(&self) -> bool {
        self.open.is_none()
    }

    /// The ends of a boundary curve that belongs to an odd number of patches; none where all are closed.
    pub fn open_side(&self) -> Option<[DVec3; 2]> {
        self.open.map(|[from, .., to]| [self.points[from as usize], self.points[to as usize]])
    }
}

/// The first side, in the order of the patches, that an odd number of them have. Two patches share a side
/// where all four control points are the same, from either end: then it is one curve to the last bit.
fn open_side(patches: &[[u32; 16]]) -> Option<[u32; 4]> {
    let sides = || patches.iter().flat_map(|patch| SIDES.map(|side| side.map(|place| patch[place])));
    let either_way = |[a, b, c, d]: [u32; 4]| [a, b, c, d].min([d, c, b, a]);
    let mut odd = HashSet::new();
    for [a, b, c, d] in sides() {
        // One that runs back the way it came, as that of no length, encloses nothing.
        let is_nothing = a == d && b == c;
        let side = either_way([a, b, c, d]);
        if !is_nothing && !odd.insert(side) {
            odd.remove(&side);
        }
    }
    sides().find(|&side| odd.contains(&either_way(side)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The patch over the unit square at a height, its control points on a grid of thirds.
    fn sheet(height: f64) -> Vec<DVec3> {
        let third = |i: usize| i as f64 / 3.0;
        (0..16).map(|i| DVec3::new(third(i % 4), third(i / 4), height)).collect()
    }

    #[test]
    fn one_patch_is_open_and_two_back_to_back_are_closed() {
        let mut points = sheet(0.0);
        let first: [u32; 16] = std::array::from_fn(|i| i as u32);
        let one = BezierPatches::new(&points, &[first]);
        assert_eq!(one.open_side(), Some([DVec3::ZERO, DVec3::X]));
        // The same rim, given anew and read the other way round, and another middle.
        let mut upper = sheet(0.0);
        upper[5].z = 1.0;
        points.extend(upper);
        let second: [u32; 16] = std::array::from_fn(|i| (16 + 4 * (i / 4) + 3 - i % 4) as u32);
        let both = BezierPatches::new(&points, &[first, second]);
        assert!(both.is_closed());
        assert_eq!(both.points().len(), 17, "equal points are one");
    }

    #[test]
    fn sides_without_length_close_nothing_and_leave_nothing_open() {
        // A patch whose first row is one point, and whose last row runs there and back.
        let mut points = sheet(0.0);
        points[..4].fill(DVec3::ZERO);
        (points[15], points[14]) = (points[12], points[13]);
        for row in [4, 8] {
            points[row + 3] = points[row];
        }
        points[12] = DVec3::Y;
        points[15] = DVec3::Y;
        let patch: [u32; 16] = std::array::from_fn(|i| i as u32);
        assert!(BezierPatches::new(&points, &[patch]).is_closed(), "its two other sides are the same curve");
    }
}

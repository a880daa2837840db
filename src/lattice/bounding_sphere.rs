//! Bounding boxes of balls: from one the ball follows, without reading the object.

use crate::bvh::{BuildPrimitive, MARGIN, Node};
use crate::math::DVec3;
use crate::solid::{Assembly, Body, WorldShape};

/// Two balls about one point: a solid ball lies between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// Their middle.
    pub center: [f32; 3],
    /// The radius of the one that holds the ball, with the [`ROOM`] around it.
    pub outer: f32,
    /// The radius of the one that the ball holds; 0 or less where there is none.
    pub inner: f32,
}

/// What lies deeper in the inner ball of a [`BoundingSphere`] than this, or so far outside its outer one,
/// does so for every computation of crossings too: the errors of the ball are less.
pub const ROOM: f64 = MARGIN;

impl BoundingSphere {
    /// The two balls of a box.
    #[inline(always)]
    fn of(lo: [f32; 3], hi: [f32; 3]) -> Self {
        let half = [0, 1, 2].map(|axis| 0.5 * hi[axis] - 0.5 * lo[axis]);
        let widest = half[0].max(half[1]).max(half[2]);
        let least = half[0].min(half[1]).min(half[2]);
        Self {
            center: [0, 1, 2].map(|axis| 0.5 * lo[axis] + 0.5 * hi[axis]),
            outer: widest,
            // The sides are moved outward by a margin, by the slack, which is mostly far less, and by a
            // rounding: `holds` tells whether three are enough.
            inner: least - 3.0 * MARGIN as f32,
        }
    }

    /// Whether the box of an object tells that it is a ball, and which.
    pub(super) fn is_in(reach: &BuildPrimitive, assembly: &Assembly) -> bool {
        let (lo, hi) = reach.corners();
        Self::of(lo, hi).holds(assembly, reach.object())
    }

    /// Whether an object is a ball between the two, and its errors are small enough.
    fn holds(&self, assembly: &Assembly, object: u32) -> bool {
        let Body::Single(index) = assembly.objects[object as usize].body else { return false };
        let WorldShape::Ball(ball) = &assembly.primitives[index as usize].form else { return false };
        let off_center = DVec3::from_array(self.center.map(f64::from)).distance(ball.center);
        let error = ball.most_error::<f64>() * (1.0 + assembly.place_error / ball.place_error());
        error <= ROOM
            && ball.radius + off_center <= f64::from(self.outer)
            && f64::from(self.inner) + off_center + ball.place_error() <= ball.radius
    }
}

impl Node {
    /// What the box of a slot tells of the ball in it, where there is one between the two of
    /// [`BoundingSphere`].
    #[inline(always)]
    pub fn ball(&self, slot: usize) -> Option<BoundingSphere> {
        self.is_round(slot).then(
            #[inline(always)]
            || {
                let (lo, hi) = self.corners(slot);
                BoundingSphere::of(lo, hi)
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use crate::lattice::{Bvh8, BvhChild};
    use crate::scene::{ReadOptions, read};
    use crate::solid::Assembly;

    #[test]
    fn balls_alone_are_round_and_nothing_else_is() {
        let text = "sphere(1); translate([5, 1, 0.3]) scale([0.7, 0.7, 0.7]) sphere(1); translate([9, 0, 0]) scale([1, 2, 1]) sphere(1);
            translate([0, 4, 0]) cube(1); translate([0, 7, 0]) difference() { sphere(1); cube(1); }
            translate([0, 0, 7]) cylinder(1, 1, 1);";
        let assembly =
            Assembly::new(&read("balls", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap();
        let boxes = Bvh8::new(&assembly);
        let [root] = boxes.nodes() else { panic!("few objects fill one node") };
        let mut round = [false; 6];
        for slot in 0..root.len() {
            let Some(BvhChild::Object(object)) = root.child(slot) else { panic!("no other node") };
            round[assembly.objects[object as usize].number as usize] = root.ball(slot).is_some();
        }
        assert_eq!(round, [true, true, false, false, false, false]);
    }
}

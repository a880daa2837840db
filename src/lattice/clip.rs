//! Stage 5, CLIP: does a ray from outside cross the world at all?
//!
//! Cohen and Sutherland's line clipping, taken from a window to a box and from a line to a ray: six bits say
//! beyond which faces a point lies. A ray that runs away from one of those faces is rejected at once; else
//! its start is moved to that face, and the bits are computed again.

use crate::math::{Bounds, DVec3, Ray};

/// Beyond which faces of a box a point lies: bit `2·axis` below the lower face, `2·axis + 1` above the upper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcode(pub u8);

impl Outcode {
    /// The code of a point; 0 inside and on the faces.
    pub fn of(p: DVec3, b: &Bounds) -> Self {
        let bits = p.cmplt(b.lo).bitmask() | p.cmpgt(b.hi).bitmask() << 3;
        // glam packs x, y, z into bits 0 to 2; spread them to every second bit.
        let spread = |m: u32| (m & 1) | (m & 2) << 1 | (m & 4) << 2;
        Self((spread(bits & 7) | spread(bits >> 3) << 1) as u8)
    }

    /// Whether the point is in the box.
    pub fn is_inside(self) -> bool {
        self.0 == 0
    }
}

/// Where the ray enters the box: 0 where it starts inside, `None` where it never does.
pub fn entry(ray: &Ray, b: &Bounds) -> Option<f64> {
    let mut t = 0.0;
    let mut p = ray.o;
    let mut settled = 0;
    // Every move settles one face for good: the ray can not lie beyond it again, though rounding may say so
    // where it passes an edge, and beyond the other one it runs away.
    for _ in 0..4 {
        let code = Outcode(Outcode::of(p, b).0 & !settled);
        if code.is_inside() {
            return Some(t);
        }
        let bit = code.0.trailing_zeros() as usize;
        settled |= 1 << bit;
        let (axis, above) = (bit / 2, bit % 2 == 1);
        let d = ray.d[axis];
        if (above && d >= 0.0) || (!above && d <= 0.0) {
            return None;
        }
        let face = if above { b.hi[axis] } else { b.lo[axis] };
        t = ((face - ray.o[axis]) / d).max(t);
        p = ray.at(t);
        p[axis] = face;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);

    #[test]
    fn outcodes_name_the_faces() {
        assert_eq!(Outcode::of(DVec3::ZERO, &BOX), Outcode(0));
        assert_eq!(Outcode::of(DVec3::new(-2.0, 0.0, 0.0), &BOX), Outcode(0b1));
        assert_eq!(Outcode::of(DVec3::new(2.0, -2.0, 2.0), &BOX), Outcode(0b10_01_10));
    }

    #[test]
    fn enters_through_a_face_an_edge_and_a_corner() {
        let from = |o: DVec3| entry(&Ray::new(o, -o.normalize()), &BOX);
        assert_eq!(from(DVec3::new(3.0, 0.0, 0.0)), Some(2.0));
        assert!((from(DVec3::new(3.0, 3.0, 0.0)).unwrap() - 8_f64.sqrt()).abs() < 1e-15);
        assert!((from(DVec3::splat(3.0)).unwrap() - 12_f64.sqrt()).abs() < 1e-15);
        assert_eq!(from(DVec3::new(0.5, 0.0, 0.0)), Some(0.0));
    }

    // A ray into an edge was moved to one face, which left it beyond the other by a rounding, and back, and
    // was given up: objects vanished along their diagonals.
    #[test]
    fn enters_through_an_edge_however_it_is_rounded() {
        for k in 1..1000 {
            let o = DVec3::new(-1.0, 0.3, -1.0) - DVec3::new(1.0, 0.0, 1.0) * (f64::from(k) / 7.0);
            for turn in [0.0, f64::EPSILON, -f64::EPSILON] {
                let d = DVec3::new(1.0, 0.0, 1.0 + turn).normalize();
                let entered = entry(&Ray::new(o, d), &BOX).expect("the box, along its diagonal");
                assert!((entered - (f64::from(k) / 7.0) * 2_f64.sqrt()).abs() < 1e-13, "{k}");
            }
        }
    }

    #[test]
    fn rejects_what_passes_by_or_runs_away() {
        let passing = Ray::new(DVec3::new(-3.0, -1.5, 0.0), DVec3::X);
        let away = Ray::new(DVec3::new(3.0, 0.0, 0.0), DVec3::X);
        let past_a_corner = Ray::new(DVec3::new(-3.0, 0.0, 0.0), DVec3::new(1.0, 1.0, 0.0).normalize());
        for ray in [passing, away, past_a_corner] {
            assert_eq!(entry(&ray, &BOX), None, "{ray:?}");
        }
    }
}

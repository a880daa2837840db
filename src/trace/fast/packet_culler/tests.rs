//! Whether what a culler leaves out is never met.

use fearless_simd::Level;
use proptest::prelude::*;

use super::*;
use crate::math::{Ray, dispatch};

fn point() -> impl Strategy<Value = DVec3> {
    // BoundingSphere numbers make rays along axes, and along the sides of boxes.
    let coordinate = || prop_oneof![-2.0..2.0_f64, (-4..=4_i8).prop_map(|i| f64::from(i) / 2.0)];
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #[test]
    fn whoever_goes_through_a_point_of_a_solid_is_asked(
        starts in prop::collection::vec((point(), point(), point(), 0..4_usize), PACKET),
        (a, b) in (point(), point()),
        radius in 1e-6..0.1_f64,
    ) {
        let (lo, hi) = (a.min(b), a.max(b));
        let (middle, along) = (0.5 * a + 0.5 * b, (b - a).normalize_or_zero());
        let mut packet = RayPacket::EMPTY;
        let mut expected = [0_u64; 3];
        for (lane, &(o, to, free, kind)) in starts.iter().enumerate() {
            let share = (to + 2.0) / 4.0;
            // To a point of the box, of the bar and of the ball; or anywhere.
            let target = match kind {
                0 => lo + (hi - lo) * share,
                1 => a + (b - a) * share.x + (free.cross(along)).normalize_or_zero() * (radius * share.y),
                2 => middle + free.normalize_or_zero() * (radius * share.y),
                _ => to,
            };
            packet.set(lane, &Ray::new(o, (target - o).normalize_or(DVec3::X)));
            if kind < 3 && target != o {
                expected[kind] |= 1 << lane;
            }
        }
        let bar = Bar { middle, along, radius };
        // As a box tells of a ball: its numbers are rounded.
        let round = BoundingSphere {
            center: [middle.x as f32, middle.y as f32, middle.z as f32],
            outer: (radius + ROOM) as f32,
            inner: (radius - 2.0 * ROOM) as f32,
        };
        for level in [Level::new(), Level::baseline()] {
            let mut culler = PacketCuller::EMPTY;
            let (asked, inside) = dispatch!(level, simd => {
                culler.set(&packet);
                culler.set_points(simd, &packet);
                culler.set_lines(simd, &packet);
                let slabs = Slabs::around(simd, lo, hi, 0.0);
                let all = u64::MAX;
                let (near, inside) = culler.ball(simd, &round, 0.0, all);
                ([culler.passing(simd, &slabs, all), culler.beside(simd, &packet, &bar, 0.0, all), near], inside)
            });
            for lane in crate::math::lanes(inside) {
                let Ray { o, d } = packet.ray(lane);
                let to_middle = middle - o;
                let t = to_middle.dot(d);
                let depth = radius * radius - (to_middle - t * d).length_squared();
                prop_assert!(depth > 0.0 && t > depth.sqrt());
            }
            for (expected, asked) in expected.into_iter().zip(asked) {
                prop_assert_eq!(expected & !asked, 0);
            }
            let (from, to) = dispatch!(level, simd => {
                culler.range(simd, &Slabs::around(simd, lo, hi, 0.0), u64::MAX)
            });
            for (lane, &(o, share, ..)) in starts.iter().enumerate() {
                if expected[0] >> lane & 1 == 1 {
                    let t = (lo + (hi - lo) * ((share + 2.0) / 4.0)).distance(o);
                    prop_assert!(from <= t && t <= to, "{} {} {}", from, t, to);
                }
            }
        }
    }
}

#[test]
fn a_ball_is_known_to_be_met_and_to_be_missed_but_for_its_rim() {
    let mut packet = RayPacket::EMPTY;
    for lane in 0..PACKET {
        let aim = DVec3::new((lane % 8) as f64 / 8.0, (lane / 8) as f64 / 8.0, 0.0);
        packet
            .set(lane, &Ray::new(DVec3::new(0.4, 0.4, -1.0), (aim - DVec3::new(0.4, 0.4, -1.0)).normalize()));
    }
    let round = BoundingSphere { center: [0.5, 0.5, 0.0], outer: 0.3, inner: 0.3 - 4.0 * ROOM as f32 };
    let mut culler = PacketCuller::EMPTY;
    let mut asked = |limit: f64| {
        dispatch!(Level::new(), simd => {
            culler.set(&packet);
                culler.set_points(simd, &packet);
            culler.limit(|_| limit);
            culler.ball(simd, &round, 0.0, u64::MAX)
        })
    };
    let (near, inside) = asked(9.0);
    assert_eq!(near, inside);
    assert!((8..40).contains(&near.count_ones()));
    // Nearer than where any ray goes in, and between there and the middle.
    assert_eq!(asked(0.6), (0, 0));
    assert_eq!(asked(0.9), (near, 0));
}

#[test]
fn most_rays_miss_what_is_small_or_lies_behind_what_they_met() {
    let mut packet = RayPacket::EMPTY;
    for lane in 0..PACKET {
        let aim = DVec3::new((lane % 8) as f64 / 8.0, (lane / 8) as f64 / 8.0, 1.0);
        packet.set(lane, &Ray::new(DVec3::new(0.4, 0.4, -1.0), (aim - DVec3::Z).normalize_or(DVec3::Z)));
    }
    let (lo, hi) = (DVec3::new(0.6, 0.4, -1.1), DVec3::new(0.7, 0.5, -0.9));
    let mut culler = PacketCuller::EMPTY;
    let mut asked = |limit: f64| {
        dispatch!(Level::new(), simd => {
            culler.set(&packet);
                culler.set_points(simd, &packet);
            culler.set_lines(simd, &packet);
            culler.limit(|_| limit);
            culler.passing(simd, &Slabs::around(simd, lo, hi, 0.0), u64::MAX).count_ones()
        })
    };
    assert!((1..32).contains(&asked(f64::INFINITY)));
    assert_eq!(asked(0.19), 0);
    // What is no number is asked in full.
    packet.d[0].0[5] = f64::NAN;
    let mut culler = PacketCuller::EMPTY;
    let asked = dispatch!(Level::new(), simd => {
        culler.set(&packet);
                culler.set_points(simd, &packet);
        culler.set_lines(simd, &packet);
        culler.passing(simd, &Slabs::around(simd, lo, hi, 0.0), u64::MAX)
    });
    assert_eq!(asked >> 5 & 1, 1);
}

//! What the hierarchy holds, and what rays find in it.

use std::ops::ControlFlow;

use super::build_primitive::*;
use super::node::*;
use super::rounding::*;
use super::*;
use crate::math::{Bounds, Ray};

/// Numbers in 0..1 that look like chance.
pub(super) struct Noise(pub u64);

impl Noise {
    pub(super) fn next(&mut self) -> f64 {
        // Knuth's MMIX.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

pub(super) fn cloud(n: usize, size: f64) -> Vec<Bounds> {
    let mut noise = Noise(1);
    let mut one = || {
        let center = noise.point();
        Bounds::new(center, center).padded(DVec3::splat(size * noise.next()))
    };
    (0..n).map(|_| one()).collect()
}

pub(super) fn over(boxes: &[Bounds]) -> Bvh8 {
    Bvh8::over(boxes.len(), |object| BuildPrimitive::new(&boxes[object], object as u32))
}

/// How far a side of a box within 0..1 may stand outside what it was made around: [`MARGIN`], and a rounding.
const OUTSIDE: f64 = MARGIN + f32::EPSILON as f64;

/// Whether a box in a node holds what it was made around, with a margin and little more.
fn fits(own: &Bounds, held: &Bounds) -> bool {
    let wide = held.padded(DVec3::splat(OUTSIDE));
    let holds = |a: &Bounds, b: &Bounds| a.lo.cmple(b.lo).all() && b.hi.cmple(a.hi).all();
    holds(own, held) && (holds(&wide, own) || held.farthest().max_element() > 2.0)
}

/// Checks that every box has one place, and every node's box holds its children; returns the depth.
fn checked(of: &Bvh8, boxes: &[Bounds]) -> usize {
    fn visit(of: &Bvh8, index: u32, seen: &mut [u32], boxes: &[Bounds]) -> (Bounds, usize) {
        let node = &of.nodes()[index as usize];
        let (mut all, mut depth) = (Bounds::EMPTY, 0);
        for slot in 0..WIDE {
            let own = node.bounds(slot);
            match node.child(slot) {
                None => assert_eq!(own, Bounds::EMPTY),
                Some(BvhChild::Object(object)) => {
                    seen[object as usize] += 1;
                    let held = boxes[object as usize];
                    assert!(fits(&own, &held), "{own:?} around {held:?}");
                    all = all.join(&held);
                }
                Some(BvhChild::Node(child)) => {
                    assert!(child > index);
                    let (held, below) = visit(of, child, seen, boxes);
                    assert!(fits(&own, &held), "a node's box is the box of its children");
                    depth = depth.max(below);
                    all = all.join(&held);
                }
            }
        }
        (all, depth + 1)
    }
    let mut seen = vec![0; boxes.len()];
    let (_, depth) = visit(of, 0, &mut seen, boxes);
    assert!(seen.iter().all(|&n| n == 1), "each object has one place");
    depth
}

#[test]
fn every_object_has_one_place_in_boxes_that_hold_it() {
    for n in [0, 1, 2, 5, 8, 9, 17, 64, 500, 5000, 20_000] {
        let boxes = cloud(n, 0.02);
        let of = over(&boxes);
        let depth = checked(&of, &boxes);
        assert!(depth <= 10, "{n}: {depth}");
    }
}

#[test]
fn up_to_eight_objects_are_one_node() {
    for n in 0..=WIDE {
        assert_eq!(over(&cloud(n, 0.1)).nodes().len(), 1, "{n}");
    }
}

#[test]
fn slots_ascend_along_the_longest_axis() {
    let boxes = cloud(3000, 0.01);
    for node in over(&boxes).nodes() {
        let own: Vec<Bounds> = (0..node.len()).map(|slot| node.bounds(slot)).collect();
        let whole = own.iter().fold(Bounds::EMPTY, |all, b| all.join(b));
        let axis = (whole.hi - whole.lo).max_position();
        assert!(own.is_sorted_by_key(|b| b.lo[axis] + b.hi[axis]));
    }
}

#[test]
fn threads_change_nothing() {
    let boxes = cloud(30_000, 0.01);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| over(&boxes))
    };
    let (one, four) = (with(1), with(4));
    assert_eq!(one.nodes(), four.nodes());
}

#[test]
fn memory_is_little() {
    let n = 100_000;
    for size in [0.0, 0.002, 0.1] {
        let of = over(&cloud(n, size));
        assert!(of.memory() <= 70 * n, "{size}: {} bytes each", of.memory() as f64 / n as f64);
    }
}

#[test]
fn a_floor_is_set_apart_near_the_root() {
    let flat = DVec3::new(1.0, 1.0, 0.01);
    let mut boxes: Vec<Bounds> =
        cloud(10_000, 0.001).iter().map(|b| Bounds::new(b.lo * flat, b.hi * flat)).collect();
    boxes.push(Bounds::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.001)));
    let of = over(&boxes);
    checked(&of, &boxes);
    let floor = BvhChild::Object(10_000);
    let holds = |node: &Node| (0..node.len()).any(|slot| node.child(slot) == Some(floor));
    let root = &of.nodes()[0];
    let below = (0..root.len()).filter_map(|slot| match root.child(slot) {
        Some(BvhChild::Node(child)) => Some(&of.nodes()[child as usize]),
        _ => None,
    });
    assert!(holds(root) || below.into_iter().any(holds), "the floor stands deeper");
}

#[test]
fn what_can_not_be_told_apart_is_halved() {
    let same = vec![Bounds::new(DVec3::ZERO, DVec3::ONE); 5000];
    let nested: Vec<Bounds> = (0..3000)
        .map(|i| Bounds::new(DVec3::ZERO, DVec3::ZERO).padded(DVec3::splat(libm::ldexp(1.0, -i / 3))))
        .collect();
    let row: Vec<Bounds> =
        (0..3000).map(|i| Bounds::new(DVec3::ZERO, DVec3::splat(libm::ldexp(1.0, -i / 3)))).collect();
    let tiny: Vec<Bounds> = cloud(3000, 0.01)
        .iter()
        .map(|b| Bounds::new(b.lo * 1e-12 + 0.5, b.hi * 1e-12 + 0.5))
        .chain([Bounds::new(DVec3::ZERO, DVec3::ONE)])
        .collect();
    let huge: Vec<Bounds> =
        cloud(3000, 0.01).iter().map(|b| Bounds::new(b.lo * 1e305, b.hi * 1e305)).collect();
    let endless = vec![Bounds::new(DVec3::NEG_INFINITY, DVec3::INFINITY); 100];
    for boxes in [same, nested, row, tiny, huge, endless] {
        let depth = checked(&over(&boxes), &boxes);
        assert!(depth < 100, "{depth}");
    }
}

/// What a walk visits that looks for all objects.
fn visited(of: &Bvh8, ray: &Ray, to: f64) -> Vec<(u32, f64)> {
    let mut all = Vec::new();
    let mut visit = |object: u32, from: f64| -> ControlFlow<(), f64> {
        all.push((object, from));
        ControlFlow::Continue(to)
    };
    assert_eq!(of.walk(ray, 0.0, to, &mut visit), None);
    all
}

/// Where the ray is in a box, by the definition and nothing else; `None` where it never is.
fn stretch(ray: &Ray, b: &Bounds) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        if d == 0.0 {
            if o < b.lo[axis] || o > b.hi[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((b.lo[axis] - o) / d, (b.hi[axis] - o) / d);
        (from, to) = (f64::max(from, a.min(b)), f64::min(to, a.max(b)));
    }
    (from <= to).then_some((from, to))
}

/// Rays of all directions from everywhere, many along axes and planes, and from planes of boxes.
fn rays(boxes: &[Bounds]) -> Vec<Ray> {
    let mut noise = Noise(7);
    let mut one = |k: usize| {
        let mut d = noise.point() * 2.0 - 1.0;
        let mut o = noise.point() * 3.0 - 1.0;
        for axis in (0..3).filter(|axis| k >> axis & 1 == 1 && k & 7 != 7) {
            d[axis] = 0.0;
        }
        if k & 8 == 8 {
            let b = &boxes[k % boxes.len()];
            o = DVec3::select(d.cmpeq(DVec3::ZERO), b.center(), b.lo);
        }
        Ray::new(o, d.normalize())
    };
    (0..500).map(&mut one).collect()
}

const PAD: f64 = 1e-13;

#[test]
fn rays_visit_every_box_that_they_meet_once() {
    for size in [0.0, 0.01, 0.3] {
        let boxes = cloud(2000, size);
        let of = Bvh8::over(boxes.len(), |object| {
            BuildPrimitive::new(&boxes[object].padded(DVec3::splat(PAD)), object as u32)
        });
        let mut met = 0;
        for ray in rays(&boxes) {
            for to in [f64::INFINITY, 0.5] {
                let mut all = visited(&of, &ray, to);
                all.sort_by_key(|&(object, _)| object);
                assert!(all.windows(2).all(|two| two[0].0 != two[1].0), "twice: {ray:?}");
                for (object, b) in (0..).zip(&boxes) {
                    let own = all.binary_search_by_key(&object, |&(object, _)| object);
                    match (stretch(&ray, b).filter(|(from, _)| *from <= to), own) {
                        (Some((from, _)), Ok(place)) => {
                            met += 1;
                            assert!(all[place].1 <= from, "{ray:?}: {} after {from}", all[place].1);
                        }
                        (Some(_), Err(_)) => panic!("{ray:?} misses {b:?}"),
                        (None, Ok(_)) => {
                            let wide = b.padded(DVec3::splat(3.0 * MARGIN));
                            assert!(stretch(&ray, &wide).is_some(), "{ray:?} is far from {b:?}");
                        }
                        (None, Err(_)) => {}
                    }
                }
            }
        }
        assert!(met > 200, "{met}");
    }
}

#[test]
fn in_the_way_of_a_light_is_what_a_walk_visits() {
    let boxes = cloud(2000, 0.05);
    let of = over(&boxes);
    let mut broken = 0;
    for ray in rays(&boxes) {
        for to in [f64::INFINITY, 0.5] {
            let mut all = Vec::new();
            let mut visit = |object: u32, _: f64| -> ControlFlow<(), f64> {
                all.push(object);
                ControlFlow::Continue(to)
            };
            assert_eq!(of.walk_any(&ray, to, &mut visit), None);
            all.sort_unstable();
            let mut walked: Vec<u32> = visited(&of, &ray, to).iter().map(|&(object, _)| object).collect();
            walked.sort_unstable();
            assert_eq!(all, walked, "{ray:?}");
            if let Some(&one) = all.first() {
                broken += 1;
                let mut find = |object: u32, _: f64| {
                    if object == one { ControlFlow::Break(object) } else { ControlFlow::Continue(to) }
                };
                assert_eq!(of.walk_any(&ray, to, &mut find), Some(one), "{ray:?}");
            }
        }
    }
    assert!(broken > 200, "{broken}");
}

#[test]
fn every_processor_visits_the_same() {
    let boxes = cloud(3000, 0.05);
    let best = over(&boxes);
    let baseline = Bvh8 { level: Level::baseline(), ..best.clone() };
    for ray in rays(&boxes) {
        assert_eq!(visited(&best, &ray, f64::INFINITY), visited(&baseline, &ray, f64::INFINITY), "{ray:?}");
    }
}

#[test]
fn nothing_beyond_what_matters_is_visited() {
    let boxes = cloud(3000, 0.02);
    let of = over(&boxes);
    let mut skipped = 0;
    for ray in rays(&boxes) {
        let mut best = f64::INFINITY;
        let mut count = 0;
        let mut visit = |object: u32, from: f64| -> ControlFlow<(), f64> {
            // As many digits as there are.
            assert!(from <= best * (1.0 + f64::from(f32::EPSILON)), "{ray:?}");
            count += 1;
            if let Some((from, _)) = stretch(&ray, &boxes[object as usize]) {
                best = best.min(from);
            }
            ControlFlow::Continue(best)
        };
        of.walk(&ray, 0.0, f64::INFINITY, &mut visit);
        let all = visited(&of, &ray, f64::INFINITY);
        let entered = all.iter().filter_map(|&(object, _)| stretch(&ray, &boxes[object as usize]));
        let first = entered.map(|(from, _)| from).fold(f64::INFINITY, f64::min);
        assert_eq!(best, first, "{ray:?}");
        skipped += all.len() - count;
    }
    assert!(skipped > 100, "{skipped}");
}

#[test]
fn a_deep_hierarchy_is_walked_to_its_end() {
    // Each box holds all that come after it.
    let boxes: Vec<Bounds> =
        (0..2000).map(|i| Bounds::new(DVec3::ZERO, DVec3::splat(libm::ldexp(1.0, -i / 2)))).collect();
    let of = over(&boxes);
    let ray = Ray::new(DVec3::splat(-1.0), DVec3::ONE.normalize());
    assert_eq!(visited(&of, &ray, f64::INFINITY).len(), boxes.len());
    let mut count = 0;
    let mut visit = |_, _: f64| -> ControlFlow<(), f64> {
        count += 1;
        ControlFlow::Continue(f64::INFINITY)
    };
    assert_eq!(of.walk_any(&ray, f64::INFINITY, &mut visit), None);
    assert_eq!(count, boxes.len());
}

#[test]
fn a_stream_meets_what_each_of_its_rays_visits_alone() {
    let boxes = cloud(500, 0.2);
    let of = over(&boxes);
    let rays = rays(&boxes);
    let mut stream = Stream::default();
    // One stream after the other in the same memory, some of whose rays look no farther, or for nothing.
    for (count, to) in [(rays.len(), f64::INFINITY), (5, f64::INFINITY), (rays.len(), 0.5), (7, -1.0)] {
        stream.clear();
        rays[..count].iter().for_each(|ray| stream.push(ray, to));
        let mut met = vec![Vec::new(); count];
        of.walk_stream(&mut stream, &mut 0, &mut |some, ways| {
            for meeting in some {
                assert!(ways.matters(meeting));
                met[meeting.ray as usize].push((meeting.object, f64::from(meeting.near)));
            }
        });
        for (ray, mut met) in rays.iter().zip(met) {
            let mut alone = visited(&of, ray, to);
            met.sort_by(|a, b| a.partial_cmp(b).unwrap());
            alone.sort_by(|a, b| a.partial_cmp(b).unwrap());
            assert_eq!(met, alone, "{ray:?}");
        }
    }
}

#[test]
fn a_ray_of_a_stream_that_looks_no_farther_meets_no_more() {
    let boxes = cloud(500, 0.2);
    let of = over(&boxes);
    let rays = rays(&boxes);
    let mut stream = Stream::default();
    for ray in &rays {
        stream.push(ray, f64::INFINITY);
    }
    let mut asked = vec![0; rays.len()];
    of.walk_stream(&mut stream, &mut 0, &mut |some, ways| {
        for meeting in some.iter().filter(|meeting| ways.matters(meeting)).copied().collect::<Vec<_>>() {
            if ways.matters(&meeting) {
                asked[meeting.ray as usize] += 1;
                ways.limit(meeting.ray, -1.0);
            }
        }
    });
    for (ray, asked) in rays.iter().zip(asked) {
        assert_eq!(asked, usize::from(!visited(&of, ray, f64::INFINITY).is_empty()), "{ray:?}");
    }
}

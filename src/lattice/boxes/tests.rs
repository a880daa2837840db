use super::*;

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

pub(super) fn over(boxes: &[Bounds]) -> Boxes {
    Boxes::over(boxes.iter().copied())
}

/// Checks that every box has one place, and every node's box holds its children; returns the depth.
fn checked(of: &Boxes, boxes: &[Bounds]) -> usize {
    fn visit(of: &Boxes, index: u32, seen: &mut [u32], boxes: &[Bounds]) -> (Bounds, usize) {
        let node = &of.nodes()[index as usize];
        let (mut all, mut depth) = (Bounds::EMPTY, 0);
        for slot in 0..WIDE {
            let own = node.bounds(slot);
            match node.child(slot) {
                None => assert_eq!(own, Bounds::EMPTY),
                Some(Child::Object(object)) => {
                    seen[object as usize] += 1;
                    assert_eq!(own, boxes[object as usize]);
                }
                Some(Child::Node(child)) => {
                    assert!(child > index);
                    let (held, below) = visit(of, child, seen, boxes);
                    assert_eq!(own, held, "a node's box is the box of its children");
                    depth = depth.max(below);
                }
            }
            all = all.join(&own);
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
        assert!(of.memory() <= 120 * n, "{size}: {} bytes each", of.memory() as f64 / n as f64);
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
    let floor = Child::Object(10_000);
    let holds = |node: &Node| (0..node.len()).any(|slot| node.child(slot) == Some(floor));
    let root = &of.nodes()[0];
    let below = (0..root.len()).filter_map(|slot| match root.child(slot) {
        Some(Child::Node(child)) => Some(&of.nodes()[child as usize]),
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

#[test]
#[ignore = "timing"]
fn temp_speed() {
    for (n, size) in [(100_000, 0.005), (1_000_000, 0.0), (1_000_000, 0.005), (1_000_000, 0.05)] {
        let boxes = cloud(n, size);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut least = f64::INFINITY;
            let mut of = over(&boxes[..1]);
            for _ in 0..4 {
                let t = std::time::Instant::now();
                of = pool.install(|| over(&boxes));
                least = least.min(t.elapsed().as_secs_f64());
            }
            let area: f64 = of
                .nodes()
                .iter()
                .map(|node| {
                    let b = (0..node.len()).fold(Bounds::EMPTY, |a, s| a.join(&node.bounds(s)));
                    let e = b.hi - b.lo;
                    e.x * e.y + e.y * e.z + e.z * e.x
                })
                .sum();
            println!(
                "{n} {size} {threads}: {:.3} s, {:.2} M/s, {:.1} B each, area {area:.1}",
                least,
                n as f64 / least / 1e6,
                of.memory() as f64 / n as f64
            );
        }
    }
}

//! Where a node is cut: planes by surface-area cost.
//!
//! The cost of a ray's path through a node is the steps from cell to cell and the tests in them. Along one
//! axis the expected tests of a slab are its share of the node's surface times the objects that reach into
//! it; over three axes the shares are taken as independent. (J. D. `MacDonald` and K. S. Booth: Heuristics
//! for ray tracing using space subdivision, 1990.)

use crate::math::Bounds;

use super::SIDE;

/// What a step to the next cell costs, in tests of an object. Measured: a step is a comparison of three
/// distances and a bit, a test of a sphere a square root and two dozen products.
const STEP: f64 = 0.2;

/// What entering a node costs, in tests of an object: three places to locate.
const ENTER: f64 = 1.5;

/// Candidate planes along an axis: more gain less than their search costs.
const CANDIDATES: usize = 32;

/// Planes across each axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuts {
    /// Ascending along each axis, inside the node's box.
    pub planes: [Vec<f64>; 3],
}

/// The cheapest cuts of a box that holds these boxes; `None` where testing all of them is cheaper.
pub fn cheapest(boxes: &[Bounds], node: &Bounds) -> Option<Cuts> {
    let axes = [0, 1, 2].map(|axis| Axis::new(boxes, node, axis));
    let n = boxes.len() as f64;
    let mut best = (n, [0; 3]);
    for kx in 0..SIDE {
        for ky in 0..SIDE {
            for kz in 0..SIDE {
                let k = [kx, ky, kz];
                let (mut share, mut steps) = (1.0, 1.0);
                for axis in 0..3 {
                    share *= axes[axis].share[k[axis]];
                    steps += axes[axis].crossed * k[axis] as f64;
                }
                let cost = n * share + STEP * steps + ENTER;
                if k != [0; 3] && cost < best.0 {
                    best = (cost, k);
                }
            }
        }
    }
    let (_, k) = best;
    (k != [0; 3]).then(|| Cuts { planes: [0, 1, 2].map(|axis| axes[axis].planes[k[axis]].clone()) })
}

/// The best cuts along one axis, for each number of planes.
struct Axis {
    /// The expected share of the objects that a ray is tested against.
    share: [f64; SIDE],
    planes: [Vec<f64>; SIDE],
    /// The share of the node's rays that cross a plane of this axis.
    crossed: f64,
}

impl Axis {
    fn new(boxes: &[Bounds], node: &Bounds, axis: usize) -> Self {
        let (lo, hi) = (node.lo[axis], node.hi[axis]);
        let size = node.hi - node.lo;
        let (width, other) = (size[axis], [size[(axis + 1) % 3], size[(axis + 2) % 3]]);
        let face = other[0] * other[1];
        let around = other[0] + other[1];
        let area = |w: f64| face + w * around;
        let whole = area(width);
        let candidates = if whole > 0.0 { candidates(boxes, lo, hi, axis) } else { Vec::new() };

        // The ends are planes too: 0 and last.
        let mut places = vec![lo];
        places.extend(&candidates);
        places.push(hi);
        let last = places.len() - 1;
        // How many boxes begin before, and end at or before, each place: by counting in intervals of places.
        let mut begins = vec![0_u32; places.len() + 1];
        let mut ends = vec![0_u32; places.len() + 1];
        for b in boxes {
            begins[candidates.partition_point(|&p| p <= b.lo[axis])] += 1;
            ends[candidates.partition_point(|&p| p < b.hi[axis])] += 1;
        }
        let running = |counts: &[u32]| -> Vec<u32> {
            counts.iter().scan(0, |sum, &c| Some(std::mem::replace(sum, *sum + c))).collect()
        };
        // begun[j]: boxes with lo < places[j]; ended[i]: boxes with hi ≤ places[i].
        let (begun, ended) = (running(&begins), running(&ends));
        let n = boxes.len().max(1) as f64;
        let tests = |i: usize, j: usize| {
            let held = begun[j].saturating_sub(ended[i]);
            f64::from(held) / n * area(places[j] - places[i]) / whole
        };

        let mut share = [1.0; SIDE];
        let mut planes: [Vec<f64>; SIDE] = Default::default();
        // cost[j]: the best cost of the part up to place j with the number of planes so far.
        let mut cost: Vec<f64> = (0..=last).map(|j| if j == 0 { 0.0 } else { tests(0, j) }).collect();
        let mut came: Vec<Vec<usize>> = Vec::new();
        for k in 1..SIDE {
            let mut next = vec![f64::INFINITY; last + 1];
            let mut from = vec![0; last + 1];
            for j in 2..=last {
                for i in 1..j {
                    let c = cost[i] + tests(i, j);
                    if c < next[j] {
                        (next[j], from[j]) = (c, i);
                    }
                }
            }
            came.push(from);
            cost = next;
            share[k] = cost[last];
            if share[k].is_finite() {
                let mut j = last;
                for level in (0..k).rev() {
                    j = came[level][j];
                    planes[k].push(places[j]);
                }
                planes[k].reverse();
            } else {
                share[k] = f64::INFINITY;
            }
        }
        let surface = whole + face + (other[0] + other[1]) * width;
        let crossed = if surface > 0.0 { 2.0 * face / surface } else { 0.0 };
        Self { share, planes, crossed }
    }
}

/// Bounds of the boxes strictly between `lo` and `hi`, ascending, each once, at most [`CANDIDATES`]: the
/// nearest to even steps where there are more.
fn candidates(boxes: &[Bounds], lo: f64, hi: f64, axis: usize) -> Vec<f64> {
    let inside = |x: f64| lo < x && x < hi;
    if boxes.len() * 2 <= 4 * CANDIDATES {
        let mut all: Vec<f64> =
            boxes.iter().flat_map(|b| [b.lo[axis], b.hi[axis]]).filter(|&x| inside(x)).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.dedup();
        if all.len() > CANDIDATES {
            let step = all.len() as f64 / CANDIDATES as f64;
            all = (0..CANDIDATES).map(|i| all[((i as f64 + 0.5) * step) as usize]).collect();
        }
        return all;
    }
    let scale = CANDIDATES as f64 / (hi - lo);
    let mut nearest = [None::<f64>; CANDIDATES];
    for b in boxes {
        for x in [b.lo[axis], b.hi[axis]].into_iter().filter(|&x| inside(x)) {
            let place = (x - lo) * scale;
            let bin = (place as usize).min(CANDIDATES - 1);
            let off = |x: f64| ((x - lo) * scale - bin as f64 - 0.5).abs();
            if nearest[bin].is_none_or(|y| (off(x), x) < (off(y), y)) {
                nearest[bin] = Some(x);
            }
        }
    }
    nearest.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DVec3;

    #[test]
    fn two_far_heaps_are_cut_off_from_the_space_between() {
        let heap = |x: f64| {
            (0..8)
                .map(move |i| f64::from(i) * 0.01 + x)
                .map(|x| Bounds::new(DVec3::splat(x), DVec3::splat(x + 0.01)))
        };
        let boxes: Vec<Bounds> = heap(0.0).chain(heap(0.9)).collect();
        let node = Bounds::new(DVec3::ZERO, DVec3::ONE);
        let cuts = cheapest(&boxes, &node).unwrap();
        assert!(
            cuts.planes.iter().any(|p| p.iter().any(|&x| x < 0.1) && p.iter().any(|&x| x > 0.85)),
            "{cuts:?}"
        );
    }

    #[test]
    fn what_fills_the_node_is_not_cut() {
        let node = Bounds::new(DVec3::ZERO, DVec3::ONE);
        assert_eq!(cheapest(&[node; 20], &node), None);
    }

    #[test]
    fn planes_are_ascending_and_inside() {
        let boxes: Vec<Bounds> = (0..300)
            .map(|i| {
                let p = DVec3::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97), f64::from(i * 71 % 89))
                    / 101.0;
                Bounds::new(p, p + 0.02)
            })
            .collect();
        let node = boxes.iter().fold(Bounds::EMPTY, |all, b| all.join(b));
        let cuts = cheapest(&boxes, &node).unwrap();
        for (axis, planes) in cuts.planes.iter().enumerate() {
            assert!(planes.len() < SIDE && planes.is_sorted());
            assert!(planes.iter().all(|&p| node.lo[axis] < p && p < node.hi[axis]), "{planes:?}");
        }
    }
}

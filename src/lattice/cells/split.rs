//! Where a cell is cut in two: at the plane by which rays are expected to meet the fewest primitives.

use crate::math::Bounds;

/// Planes that are looked at across each axis, and one more: enough that gaps between some ten primitives in
/// a row are found; of more, planes through a few of them cost little.
const BINS: usize = 16;

/// A plane across an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    pub axis: usize,
    pub at: f64,
    /// The share of the primitives that the lower part has.
    pub share: f64,
}

/// By axis and bin: how many boxes begin in it, and how many end.
#[derive(Default)]
struct Bins {
    begin: [u32; BINS],
    end: [u32; BINS],
}

/// The best plane to cut a cell where primitives with these boxes are. By surface area: so a ray that meets
/// the cell is expected to meet either part (Wald and Havran: On building fast kd-trees for ray tracing, and
/// on doing that in O(N log N), 2006).
pub fn best(cell: &Bounds, boxes: impl ExactSizeIterator<Item = Bounds>) -> Cut {
    let count = boxes.len() as f64;
    let size = cell.hi - cell.lo;
    let per = BINS as f64 / size;
    let mut bins: [Bins; 3] = Default::default();
    for b in boxes {
        let (first, last) = ((b.lo - cell.lo) * per, (b.hi - cell.lo) * per);
        for (axis, bins) in bins.iter_mut().enumerate() {
            // Of an axis without size these are no numbers, which become 0.
            bins.begin[(first[axis].max(0.0) as usize).min(BINS - 1)] += 1;
            bins.end[(last[axis].max(0.0) as usize).min(BINS - 1)] += 1;
        }
    }
    let longest = size.max_position();
    let mut best = Cut { axis: longest, at: 0.5 * (cell.lo[longest] + cell.hi[longest]), share: 0.5 };
    let mut least = f64::INFINITY;
    for (axis, bins) in bins.iter().enumerate() {
        let (edge, [a, b]) = (size[axis], [size[(axis + 1) % 3], size[(axis + 2) % 3]]);
        // A slice of nothing has no middle.
        if edge <= 1e-3 * size[longest] {
            continue;
        }
        let (mut low, mut ended) = (0.0, 0.0);
        for plane in 1..BINS {
            low += f64::from(bins.begin[plane - 1]);
            ended += f64::from(bins.end[plane - 1]);
            let high = count - ended;
            let along = plane as f64 / BINS as f64;
            let area = |edge: f64| edge * (a + b) + a * b;
            let cost = low * area(along * edge) + high * area((1.0 - along) * edge);
            // Of equal ones that in the middle of the longest axis.
            let off = (along - 0.5).abs() + if axis == longest { 0.0 } else { 0.5 };
            let cost = cost * (1.0 + 0.01 * off);
            if cost < least {
                least = cost;
                let at = cell.lo[axis] + along * edge;
                best = Cut { axis, at, share: low / (low + high).max(1.0) };
            }
        }
    }
    best
}

//! The lattice-coordinate lists X(0..), Y(0..), Z(0..), and the walk from cell to cell.

use std::ops::ControlFlow;

use crate::math::{Bounds, DVec3, Ray};
use crate::solid::ROUNDING;

/// Bounds nearer to each other than this are one plane: both ends of a contact were rounded, each by
/// [`ROUNDING`] of a coordinate of at most 2.
const SAME: f64 = 4.0 * ROUNDING;

/// How far along a ray a crossing may be computed outside the cell that holds it: the plane's distance and
/// the crossing are off by at most [`ROUNDING`] each of lengths of at most 8, the diagonals of world and
/// margin.
pub const SLACK: f64 = 16.0 * ROUNDING;

/// How far the surfaces of solids may seem to be from each other that are one place, where each may be
/// `place_error` its own: twice that from the front, and as much again for rays that meet them aslant. Past a
/// hundredth of the world it is no rounding.
pub fn slack(place_error: f64) -> f64 {
    (4.0 * place_error).clamp(SLACK, 0.01)
}

/// Planes across each axis, ascending; cell i holds `X(i) ≤ x < X(i+1)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Planes {
    lists: [Vec<f64>; 3],
}

/// A cell that a ray passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellStep {
    /// The cell's number in scan order, x fastest.
    pub cell: usize,
    /// Where the ray comes in.
    pub from: f64,
    /// Where it goes out.
    pub to: f64,
}

impl Planes {
    /// Planes at every face of the boxes, within `limit`; the outermost [`SLACK`] outside it.
    pub fn new(boxes: impl Iterator<Item = Bounds>, limit: &Bounds) -> Self {
        let mut lists = [0, 1, 2].map(|axis| vec![limit.lo[axis], limit.hi[axis]]);
        for b in boxes {
            for (axis, list) in lists.iter_mut().enumerate() {
                let inside = |x: f64| limit.lo[axis] + SAME < x && x < limit.hi[axis] - SAME;
                list.extend([b.lo[axis], b.hi[axis]].into_iter().filter(|&x| inside(x)));
            }
        }
        for list in &mut lists {
            list.sort_unstable_by(f64::total_cmp);
            list.dedup_by(|next, kept| *next - *kept <= SAME);
            // A box thinner than the rounding still has a cell.
            if list.len() == 1 {
                list.push(list[0]);
            }
            // A ray is not done before it has left the world for certain; within a thin one it may still go
            // far.
            if let [first, .., last] = &mut list[..] {
                *first -= SLACK;
                *last += SLACK;
            }
        }
        Self { lists }
    }

    /// Leaves out planes evenly until at most `most` cells are left.
    pub fn thin(&mut self, most: f64) {
        while self.cells() > most {
            let Some(list) =
                self.lists.iter_mut().max_by_key(|list| list.len()).filter(|list| list.len() > 2)
            else {
                return;
            };
            let last = list.len() - 1;
            let mut place = 0;
            list.retain(|_| {
                place += 1;
                (place - 1) % 2 == 0 || place - 1 == last
            });
        }
    }

    /// Cells along x, y and z.
    #[inline]
    pub fn dimensions(&self) -> [usize; 3] {
        let [x, y, z] = &self.lists;
        [x.len() - 1, y.len() - 1, z.len() - 1]
    }

    /// The number of cells; a float, for it may pass any integer.
    pub fn cells(&self) -> f64 {
        self.dimensions().iter().map(|&n| n as f64).product()
    }

    /// The planes across an axis.
    pub fn list(&self, axis: usize) -> &[f64] {
        &self.lists[axis]
    }

    /// The first and the last cell that a box reaches into, along each axis.
    pub fn reach(&self, b: &Bounds) -> [(usize, usize); 3] {
        [0, 1, 2].map(|axis| {
            let list = &self.lists[axis];
            let last = list.len() - 2;
            let first = list.partition_point(|&x| x <= b.lo[axis]).saturating_sub(1).min(last);
            let end = list.partition_point(|&x| x < b.hi[axis]).saturating_sub(1).clamp(first, last);
            (first, end)
        })
    }

    /// The number of a cell in scan order, x fastest.
    #[inline]
    pub fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.dimensions();
        (k * ny + j) * nx + i
    }

    /// Calls `visit` with each cell that the ray passes between `from` and `to`, in order, until it breaks.
    #[inline]
    pub fn walk<B>(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        mut visit: impl FnMut(CellStep) -> ControlFlow<B>,
    ) -> Option<B> {
        let start = ray.at(from);
        let size = self.dimensions();
        let stride = [1, size[0], size[0] * size[1]];
        let mut at = [self.locate(0, start.x), self.locate(1, start.y), self.locate(2, start.z)];
        let mut next = DVec3::INFINITY;
        for axis in 0..3 {
            next[axis] = self.leaves_at(ray, axis, at[axis]);
        }
        let mut cell = self.number(at);
        let mut now = from;
        loop {
            let axis = if next.x <= next.y && next.x <= next.z {
                0
            } else if next.y <= next.z {
                1
            } else {
                2
            };
            // Rounding may put the next plane a little behind the start.
            let end = next[axis].max(now).min(to);
            if let ControlFlow::Break(value) = visit(CellStep { cell, from: now, to: end }) {
                return Some(value);
            }
            if end >= to {
                return None;
            }
            now = end;
            if ray.d[axis] > 0.0 {
                if at[axis] + 1 == size[axis] {
                    return None;
                }
                at[axis] += 1;
                cell += stride[axis];
            } else {
                if at[axis] == 0 {
                    return None;
                }
                at[axis] -= 1;
                cell -= stride[axis];
            }
            next[axis] = self.leaves_at(ray, axis, at[axis]);
        }
    }

    /// The cell of a coordinate, half open; the nearest one outside.
    #[inline]
    fn locate(&self, axis: usize, x: f64) -> usize {
        let list = &self.lists[axis];
        list.partition_point(|&plane| plane <= x).saturating_sub(1).min(list.len() - 2)
    }

    /// Where the ray leaves a cell across an axis; infinite where it runs along it.
    #[inline]
    fn leaves_at(&self, ray: &Ray, axis: usize, cell: usize) -> f64 {
        let d = ray.d[axis];
        if d == 0.0 {
            return f64::INFINITY;
        }
        let plane = self.lists[axis][cell + usize::from(d > 0.0)];
        (plane - ray.o[axis]) / d
    }

    /// The box of a range of cells, both ends included.
    pub fn bounds(&self, range: &[(usize, usize); 3]) -> Bounds {
        let mut b = Bounds::EMPTY;
        for axis in 0..3 {
            b.lo[axis] = self.lists[axis][range[axis].0];
            b.hi[axis] = self.lists[axis][range[axis].1 + 1];
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_boxes(n: u32) -> impl Iterator<Item = Bounds> {
        (0..n)
            .map(|i| Bounds::new(DVec3::new(f64::from(i), 0.0, 0.0), DVec3::new(f64::from(i + 1), 1.0, 1.0)))
    }

    fn planes() -> Planes {
        let limit = unit_boxes(4).fold(Bounds::EMPTY, |b, c| b.join(&c));
        Planes::new(unit_boxes(4), &limit)
    }

    fn visited(ray: &Ray) -> Vec<usize> {
        let mut seen = Vec::new();
        planes().walk::<()>(ray, 0.0, f64::INFINITY, |step| {
            seen.push(step.cell);
            ControlFlow::Continue(())
        });
        seen
    }

    #[test]
    fn planes_stand_at_the_faces_once() {
        assert_eq!(planes().list(0), [-SLACK, 1.0, 2.0, 3.0, 4.0 + SLACK]);
        assert_eq!(planes().dimensions(), [4, 1, 1]);
    }

    #[test]
    fn an_empty_cell_left_through_its_plus_x_face_leads_to_the_next() {
        assert_eq!(visited(&Ray::new(DVec3::new(0.5, 0.5, 0.5), DVec3::X)), [0, 1, 2, 3]);
        assert_eq!(visited(&Ray::new(DVec3::new(2.5, 0.5, 0.5), DVec3::NEG_X)), [2, 1, 0]);
    }

    #[test]
    fn a_ray_in_a_plane_is_in_the_upper_cell() {
        assert_eq!(visited(&Ray::new(DVec3::new(1.0, 0.0, 0.5), DVec3::Y)), [1]);
    }

    #[test]
    fn a_box_reaches_the_cells_that_it_fills() {
        let planes = planes();
        let second = unit_boxes(4).nth(1).unwrap();
        assert_eq!(planes.reach(&second), [(1, 1), (0, 0), (0, 0)]);
        assert_eq!(planes.reach(&second.padded(DVec3::splat(1e-9)))[0], (0, 2));
    }

    #[test]
    fn thinning_keeps_the_limit() {
        let limit = unit_boxes(100).fold(Bounds::EMPTY, |b, c| b.join(&c));
        let mut planes = Planes::new(unit_boxes(100), &limit);
        planes.thin(10.0);
        assert!(planes.cells() <= 10.0);
        assert_eq!((planes.list(0)[0], *planes.list(0).last().unwrap()), (-SLACK, 100.0 + SLACK));
    }

    // A world thinner along an axis than the rounding of its size was one plane there, which every ray had
    // left before it came to the next cell.
    #[test]
    fn a_world_as_thin_as_rounding_is_walked_from_end_to_end() {
        let limit = Bounds::new(DVec3::new(-1e-150, -1.0, -1.0), DVec3::new(1e-150, 1.0, 1.0));
        let halves =
            [Bounds { hi: limit.hi.with_y(0.0), ..limit }, Bounds { lo: limit.lo.with_y(0.0), ..limit }];
        let planes = Planes::new(halves.into_iter(), &limit);
        assert_eq!(planes.dimensions(), [1, 2, 1]);
        let ray = Ray::new(DVec3::new(-1e-150, -0.5, 0.0), DVec3::new(1e-14, 1.0, 0.0));
        let mut cells = Vec::new();
        planes.walk::<()>(&ray, 0.0, f64::INFINITY, |step| {
            cells.push(step.cell);
            ControlFlow::Continue(())
        });
        assert_eq!(cells, [0, 1]);
    }
}

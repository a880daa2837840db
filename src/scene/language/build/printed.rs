//! What six digits leave open of the flat sides of primitives.

use std::collections::{HashMap, VecDeque};

use super::chain::{Chain, PrintedMap};
use super::six_digits::half_unit;
use crate::math::{Bounds, DAffine3};
use crate::scene::{Primitive, Shape};

/// The axes of a shape.
pub const AXES: [usize; 3] = [0, 1, 2];

/// What was printed of a primitive.
#[derive(Clone, Debug)]
pub struct PrintedPrimitive {
    /// The maps above it.
    maps: Chain,
    /// The box of its shape under its own map, which gives it its size.
    b: Bounds,
    /// By axis of the shape, for its lower and its upper side, how far that may lie from where the size that
    /// was printed has it, in the shape's own coordinates. None where there is no flat side.
    off: [[Option<f64>; 2]; 3],
}

impl PrintedPrimitive {
    /// Of a primitive that `local` gives its size below `maps`; none where it has no flat side.
    pub fn new(primitive: &Primitive, local: &DAffine3, maps: &Chain) -> Option<Self> {
        let b = primitive.shape.bounds();
        // Others are made of points that were printed.
        let is_sized = *local != DAffine3::IDENTITY;
        let off = AXES.map(|axis| {
            let along = local.matrix3.col(axis);
            // Sizes are given along the axes of the word.
            let is_straight = AXES.into_iter().all(|k| (k == axis) == (along[k] != 0.0));
            let ends = [b.lo, b.hi].map(|end| local.translation[axis] + along[axis] * end[axis]);
            [0, 1].map(|upper| {
                let is_flat = is_straight && has_side(&primitive.shape, &b, axis, upper);
                is_flat.then(|| off_of(ends, upper, is_sized) / along[axis].abs())
            })
        });
        let any = off.as_flattened().iter().any(Option::is_some);
        any.then(|| Self { maps: maps.clone(), b: b.mapped(local), off })
    }

    /// How far a side may lie from where it was meant to be, map by map, the outermost first; across it.
    pub fn side(&self, axis: usize, upper: usize) -> Option<(f64, Vec<PrintedMap>)> {
        let off = self.off[axis][upper]?;
        let mut b = self.b;
        let end = [b.lo, b.hi][upper][axis];
        (b.lo[axis], b.hi[axis]) = (end, end);
        Some((off, self.maps.printed(&b)))
    }
}

/// What was printed of primitives, by where they are: those that are in one place in file order.
#[derive(Clone, Debug, Default)]
pub struct PrintedPrimitives(HashMap<[u64; 12], VecDeque<PrintedPrimitive>>);

impl PrintedPrimitives {
    /// Adds what was printed of a primitive.
    pub fn add(&mut self, of: &Primitive, printed: PrintedPrimitive) {
        self.0.entry(place(of)).or_default().push_back(printed);
    }

    /// Takes out what was printed of a primitive.
    pub fn take(&mut self, of: &Primitive) -> Option<PrintedPrimitive> {
        self.0.get_mut(&place(of))?.pop_front()
    }

    /// Whether nothing was.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The bits of a primitive's map.
fn place(primitive: &Primitive) -> [u64; 12] {
    primitive.map.to_cols_array().map(f64::to_bits)
}

/// How far the end of a size may be from where it was meant to be. What begins at 0 does so exactly, and ends
/// with its size; what has its middle there ends with half of that.
fn off_of(ends: [f64; 2], upper: usize, is_sized: bool) -> f64 {
    let (end, size) = (ends[upper], (ends[1] - ends[0]).abs());
    if is_sized || ends[0] == -ends[1] {
        return half_unit(size) * (end / size).abs().min(1.0);
    }
    half_unit(end)
}

/// Whether the end of `b`, a shape's box, is a side of it.
fn has_side(shape: &Shape, b: &Bounds, axis: usize, upper: usize) -> bool {
    match shape {
        Shape::Cube => true,
        Shape::Cone { bottom, top } => axis == 2 && [bottom, top][upper] != &0.0,
        Shape::Facets(facets) => facets.faces.iter().any(|face| {
            let is_along = AXES.into_iter().all(|k| (k == axis) == (face.normal[k] != 0.0));
            is_along && (face.normal[axis] > 0.0) == (upper == 1)
        }),
        Shape::Mesh(mesh) => {
            let end = [b.lo, b.hi][upper][axis];
            let is_there =
                |triangle: &[u32; 3]| triangle.iter().all(|&p| mesh.points[p as usize][axis] == end);
            mesh.triangles.iter().any(is_there)
        }
        _ => false,
    }
}

//! What six digits leave open of the flat sides of primitives.

use super::Builder;
use super::chain::{Chain, PrintedMap};
use super::context::Context;
use super::flush::{AXES, PrintedSide, flushed};
use super::six_digits::half_unit;
use crate::math::{Bounds, DAffine3};
use crate::scene::{Digits, Primitive, Shape};

/// What was printed of a primitive.
#[derive(Clone, Debug)]
pub struct PrintedPrimitive {
    /// The maps above it.
    maps: Chain,
    /// The box of its shape under its own map, which gives it its size.
    b: Bounds,
    /// By axis of the shape, for its lower and its upper side, how far that may lie from where the size that was
    /// printed has it, in the shape's own coordinates. None where there is no flat side.
    off: [[Option<f64>; 2]; 3],
}

impl PrintedPrimitive {
    /// How far a side may lie from where it was meant to be, map by map, the outermost first; across it.
    pub fn side(&self, axis: usize, upper: usize) -> Option<(f64, Vec<PrintedMap>)> {
        let off = self.off[axis][upper]?;
        let mut b = self.b;
        if upper == 1 {
            b.lo[axis] = b.hi[axis]
        } else {
            b.hi[axis] = b.lo[axis]
        };
        Some((off, self.maps.printed(&b)))
    }
}

impl Builder {
    /// Notes what six digits leave open of a primitive that `local` gives its size.
    pub(super) fn noting_digits(
        &mut self,
        mut primitive: Primitive,
        local: &DAffine3,
        context: &Context,
    ) -> Primitive {
        if self.digits == Digits::Exact {
            return primitive;
        }
        let b = primitive.shape.bounds();
        // Others are made of points that were printed.
        let is_sized = *local != DAffine3::IDENTITY;
        let off = AXES.map(|axis| {
            let along = local.matrix3.col(axis);
            // Sizes are given along the axes of the word.
            let is_straight = AXES.into_iter().all(|k| (k == axis) == (along[k] != 0.0));
            let ends = [b.lo, b.hi].map(|end| local.translation[axis] + along[axis] * end[axis]);
            [0, 1].map(|upper| {
                let is_flat = is_straight && has_side(&primitive.shape, axis, upper);
                is_flat.then(|| off_of(ends, upper, is_sized) / along[axis].abs())
            })
        });
        if off.as_flattened().iter().all(Option::is_none) {
            return primitive;
        }
        self.memory.take(size_of::<PrintedPrimitive>() as u64);
        self.printed.push(PrintedPrimitive { maps: context.maps.clone(), b: b.mapped(local), off });
        primitive.note = self.printed.len() as u32;
        primitive
    }

    /// Makes one plane of the sides that may be one by six digits, object by object. Answers how many were
    /// moved.
    pub(super) fn flush(&mut self) -> usize {
        let mut count = 0;
        for object in &mut self.scene.objects {
            let mut primitives = Vec::new();
            object.solid.each_mut(&mut |primitive| {
                if primitive.note != 0 {
                    primitives.push(primitive);
                }
            });
            if primitives.len() > 1 {
                let of = |leaf: u32, primitive: &Primitive| {
                    let printed = &self.printed[primitive.note as usize - 1];
                    PrintedSide::all_of(leaf, primitive, printed)
                };
                let sides =
                    primitives.iter().zip(0..).flat_map(|(primitive, leaf)| of(leaf, primitive)).collect();
                count += flushed(&mut primitives, sides);
            }
            primitives.iter_mut().for_each(|primitive| primitive.note = 0);
        }
        count
    }
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

/// Whether the end of a shape's box is a side of it.
fn has_side(shape: &Shape, axis: usize, upper: usize) -> bool {
    match shape {
        Shape::Cube => true,
        Shape::Cone { bottom, top } => axis == 2 && [bottom, top][upper] != &0.0,
        Shape::Facets(facets) => facets.faces.iter().any(|face| {
            let is_along = AXES.into_iter().all(|k| (k == axis) == (face.normal[k] != 0.0));
            is_along && (face.normal[axis] > 0.0) == (upper == 1)
        }),
        Shape::Mesh(mesh) => {
            let b = shape.bounds();
            let end = [b.lo, b.hi][upper][axis];
            let is_there =
                |triangle: &[u32; 3]| triangle.iter().all(|&p| mesh.points[p as usize][axis] == end);
            mesh.triangles.iter().any(is_there)
        }
        _ => false,
    }
}

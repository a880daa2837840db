//! What is left of a large expression in each part of its box: where to begin when it is pruned to a small
//! box.
//!
//! A loose octree: the cells of each level overlap, every one is twice as wide as the space it stands for, so
//! that a box no wider than that space lies within the cell around its middle, wherever it is (Ulrich: Loose
//! octrees, Game Programming Gems, 2000).

use std::sync::OnceLock;

use crate::math::{Bounds, DVec3};
use crate::solid::{Classification, ExprView, PrunedExpr, Pruning, WorldPrimitive};

/// An object of so many primitives is cut into cells where these part; one of fewer by a lattice, and an
/// expression of fewer is pruned as it is.
pub const MANY: usize = 24;

/// Levels below the whole: the cells of the last stand for a sixteenth of each axis.
const LEVELS: usize = 4;

/// One level: its cells, made when they are first needed.
#[derive(Debug)]
struct Level {
    side: usize,
    /// None where there is no surface: all is inside, or outside.
    cells: Vec<OnceLock<Option<PrunedExpr>>>,
}

/// The cells of one object.
#[derive(Debug)]
pub struct LooseOctree {
    bounds: Bounds,
    levels: Vec<Level>,
}

impl LooseOctree {
    /// The cells of an object within `bounds`, none of which is made yet.
    pub fn new(bounds: Bounds) -> Self {
        let level = |depth: usize| {
            let side = 2 << depth;
            Level { side, cells: std::iter::repeat_with(OnceLock::new).take(side * side * side).collect() }
        };
        Self { bounds, levels: (0..LEVELS).map(level).collect() }
    }

    /// What is left of `whole`, the object's expression, in a cell that holds the box `b`; `whole` itself
    /// where no cell does, and none where there is no surface in the cell.
    pub fn around<'l>(
        &'l self,
        whole: ExprView<'l>,
        primitives: &[WorldPrimitive],
        b: &Bounds,
    ) -> Option<ExprView<'l>> {
        let size = self.bounds.hi - self.bounds.lo;
        let (wide, middle) = (b.hi - b.lo, (b.center() - self.bounds.lo) / size);
        let mut best = whole;
        for level in &self.levels {
            let side = level.side as f64;
            if !wide.cmple(size / side).all() || best.leaves.len() < MANY {
                break;
            }
            let place = (middle * side).floor().clamp(DVec3::ZERO, DVec3::splat(side - 1.0));
            let space = size / side;
            let corner = self.bounds.lo + place * space;
            let cell = Bounds::new(corner, corner + space).padded(0.5 * space);
            if !(cell.contains(b.lo) && cell.contains(b.hi)) {
                break;
            }
            let [x, y, z] = place.to_array().map(|x| x as usize);
            let left = level.cells[(z * level.side + y) * level.side + x].get_or_init(|| {
                let mut remains = PrunedExpr::default();
                let some = best.pruned(primitives, &cell, &mut Pruning::default(), &mut remains);
                (some == Classification::Mixed).then_some(remains)
            });
            best = ExprView::from(left.as_ref()?);
        }
        Some(best)
    }
}

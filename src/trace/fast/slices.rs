//! The way of a packet through a composite object in slices, nearest first, each with what its expression is there.

use crate::lattice::{LooseOctree, MANY};
use crate::math::{Bounds, DVec3};
use crate::solid::{Classification, ExprView, WorldPrimitive};

use super::Fast;
use super::memory::TileMemory;

/// The most leaves of an expression that are asked at once, rather than the way being cut into shorter slices: more
/// cost more than slices do.
pub const SOME: usize = 6;

/// Where the way has been cut so often, or oftener, up to [`SOME`] leaves are asked at once, whatever [`Slices::FEW`].
const CUTS: u32 = 2;

/// How often the way through an object is halved at most: into 64 slices, about as many as a sub-lattice has cells.
const HALVINGS: u32 = 6;

/// Whose way is cut into slices.
pub trait Slices {
    /// The most leaves that are asked at once before the way has been cut often: fewer than [`SOME`] where what is nearest
    /// mostly hides the others.
    const FEW: usize;

    /// The rays that have not met the object yet.
    fn open(&self) -> u64;

    /// How far outside its slice a crossing may be computed.
    fn slack(&self) -> f64;

    /// The box around the way of all rays between two distances.
    fn bounds(&self, from: f64, to: f64) -> Bounds;

    /// Asks the rays that are open what they meet between two distances.
    fn ask(&mut self, expression: ExprView, way: (f64, f64), memory: &mut TileMemory);
}

/// Asks along the way from `from` to `to`, nearest slices first.
pub fn slices(
    fast: &Fast,
    whole: Option<Whole>,
    rays: &mut impl Slices,
    expression: ExprView,
    way: (f64, f64),
    memory: &mut TileMemory,
) {
    slice(fast, whole, rays, expression, way, HALVINGS, memory);
}

fn slice<R: Slices>(
    fast: &Fast,
    whole: Option<Whole>,
    rays: &mut R,
    expression: ExprView,
    (from, to): (f64, f64),
    halvings: u32,
    memory: &mut TileMemory,
) {
    if rays.open() == 0 || from > to {
        return;
    }
    let primitives = &fast.assembly.primitives;
    // A crossing may be computed `slack` outside its slice; twice that keeps its whole cluster.
    let b = rays.bounds(from, to).padded(DVec3::splat(2.0 * rays.slack()));
    let Some(expression) = begin(whole, expression, primitives, &b) else { return };
    let halves = [(from, 0.5 * (from + to)), (0.5 * (from + to), to)];
    // The way is cut before much is pruned: shorter slices begin with less.
    if expression.leaves.len() > 2 * MANY && halvings > 0 {
        for half in halves {
            slice(fast, whole, rays, expression, half, halvings - 1, memory);
        }
        return;
    }
    let mut remains = memory.remains.pop().unwrap_or_default();
    if expression.pruned(primitives, &b, &mut memory.pruning, &mut remains) == Classification::Mixed {
        let left = ExprView::from(&remains);
        let few = if halvings + CUTS > HALVINGS { R::FEW } else { SOME };
        if left.leaves.len() <= few || halvings == 0 {
            rays.ask(left, (from, to), memory);
        } else {
            for half in halves {
                slice(fast, whole, rays, left, half, halvings - 1, memory);
            }
        }
    }
    memory.remains.push(remains);
}

/// The expression of a whole object, and what is known of its parts.
pub type Whole<'a> = (&'a LooseOctree, ExprView<'a>);

/// What an expression in a box is to be pruned from: what is left of it already, or of the whole object in a cell around
/// the box, whichever is less; none where there is no surface in that cell.
fn begin<'e>(
    whole: Option<Whole<'e>>,
    left: ExprView<'e>,
    primitives: &[WorldPrimitive],
    b: &Bounds,
) -> Option<ExprView<'e>> {
    let Some((loose, whole)) = whole.filter(|_| left.leaves.len() >= MANY) else { return Some(left) };
    let around = loose.around(whole, primitives, b)?;
    Some(if around.leaves.len() < left.leaves.len() { around } else { left })
}

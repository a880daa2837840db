//! Cutting the box of a composite object into cells, from the top.

use crate::math::{Bounds, DVec3};
use crate::solid::{Assembly, Classification, ExprView, Expression, Expressions, Leaf, PrunedExpr, Pruning};

use super::split::best;

/// A cell with so few primitives is not cut any more: to find their spans costs as much as two cells do.
const FEW: usize = 4;

/// A cell is cut no more after so many cuts in a row that leave as many primitives in a part: where they all
/// meet in a point or a line no cut parts them. Two for each axis.
const FRUITLESS: u32 = 6;

/// No edge that is cut is shorter than so many margins: below that what is near a cell is as much as what is
/// in it.
const MARGINS: f64 = 16.0;

/// Expressions of so many primitives are cut on by another thread: below that a thread takes longer to be
/// woken.
const SHARED: usize = 256;

/// Cells and their expressions.
#[derive(Default)]
pub struct Part {
    pub bounds: Vec<Bounds>,
    pub expressions: Expressions,
}

impl Part {
    fn push(&mut self, b: Bounds, expression: ExprView) {
        self.bounds.push(b);
        self.expressions.push(expression);
    }
}

/// Memory of one thread.
#[derive(Default)]
struct Memory {
    pruning: Pruning,
    /// Pruned expressions that are not in use.
    pruned: Vec<PrunedExpr>,
}

/// A part of the object's box.
#[derive(Clone, Copy)]
struct Cell {
    b: Bounds,
    /// How many primitives the expressions in it may name together, about.
    allowance: f64,
    /// Cuts since one that left fewer primitives.
    fruitless: u32,
}

struct Building<'a> {
    assembly: &'a Assembly,
    boxes: &'a LeafBoxes,
    margin: f64,
}

/// The boxes around the primitives of an object.
#[derive(Clone, Debug)]
pub struct LeafBoxes {
    /// By primitive, from number `first` on.
    boxes: Vec<Bounds>,
    first: u32,
}

impl LeafBoxes {
    /// Those of an expression.
    pub fn new(whole: &Expression, assembly: &Assembly) -> Self {
        let numbers = || whole.leaves.iter().map(|leaf| leaf.primitive);
        let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
        let own = &assembly.primitives[first as usize..=last as usize];
        Self { boxes: own.iter().map(|primitive| primitive.form.bounds()).collect(), first }
    }

    /// The box around one.
    #[inline]
    pub fn of(&self, leaf: &Leaf) -> &Bounds {
        &self.boxes[(leaf.primitive - self.first) as usize]
    }
}

/// What is to be cut, and how.
#[derive(Clone, Copy)]
pub struct Cutting<'a> {
    pub whole: &'a Expression,
    pub assembly: &'a Assembly,
    pub boxes: &'a LeafBoxes,
    /// The box of the object.
    pub bounds: &'a Bounds,
    /// How many primitives the expressions of all cells may name together, about.
    pub allowance: f64,
    /// How far beside their places crossings may be computed.
    pub slack: f64,
    /// How far around its cell an expression is to hold.
    pub margin: f64,
}

/// Cuts the box of an object into cells.
pub fn cut(cutting: &Cutting) -> Part {
    let Cutting { whole, assembly, boxes, bounds, allowance, slack, margin } = *cutting;
    let building = Building { assembly, boxes, margin };
    let mut part = Part::default();
    let cell = Cell { b: bounds.padded(DVec3::splat(slack)), allowance, fruitless: 0 };
    building.fill(ExprView::from(whole), cell, &mut Memory::default(), &mut part);
    part
}

impl Building<'_> {
    fn fill(&self, around: ExprView, cell: Cell, memory: &mut Memory, part: &mut Part) {
        let mut left = memory.pruned.pop().unwrap_or_default();
        let padded = cell.b.padded(DVec3::splat(self.margin));
        let found = around.pruned(&self.assembly.primitives, &padded, &mut memory.pruning, &mut left);
        if found == Classification::Mixed {
            self.cut(around.leaves.len(), ExprView::from(&left), cell, memory, part);
        }
        memory.pruned.push(left);
    }

    /// Cuts a cell with what is left of `before` primitives in it, or adds it to `part`.
    fn cut(&self, before: usize, left: ExprView, cell: Cell, memory: &mut Memory, part: &mut Part) {
        let Cell { b, allowance, fruitless } = cell;
        let count = left.leaves.len();
        let fruitless = if count < before { 0 } else { fruitless + 1 };
        let is_small = (b.hi - b.lo).max_element() < MARGINS * self.margin;
        // Both halves may still need all of it.
        if count <= FEW || fruitless > FRUITLESS || is_small || 2.0 * count as f64 > allowance {
            part.push(b, left);
            return;
        }
        let plane = best(&b, left.leaves.iter().map(|leaf| *self.boxes.of(leaf)));
        let (mut low, mut high) = (b, b);
        low.hi[plane.axis] = plane.at;
        high.lo[plane.axis] = plane.at;
        let share = plane.share.clamp(0.1, 0.9);
        let low = Cell { b: low, allowance: allowance * share, fruitless };
        let high = Cell { b: high, allowance: allowance * (1.0 - share), fruitless };
        if count < SHARED {
            self.fill(left, low, memory, part);
            self.fill(left, high, memory, part);
            return;
        }
        let mut other = Part::default();
        rayon::join(
            || self.fill(left, low, memory, part),
            || self.fill(left, high, &mut Memory::default(), &mut other),
        );
        part.bounds.append(&mut other.bounds);
        part.expressions.append(&other.expressions);
    }
}

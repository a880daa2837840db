//! The sub-lattice of a composite object: in each cell, the part of its CSG expression that still matters
//! there.

use std::collections::HashMap;
use std::ops::ControlFlow;

use crate::math::{Bounds, DVec3, Ray};
use crate::solid::{
    Assembly, Body, Classification, ExprView, Expression, Leaf, PrunedExpr, Pruning, WorldObject,
    WorldPrimitive,
};
use crate::stage::{Progress, Task};

use super::cells::CsgCells;
use super::loose_octree::MANY;
use super::planes::{CellStep, Planes, SLACK, slack};

/// The most cells of one sub-lattice. Past it planes are left out, which costs tests but changes no hit: 64
/// along each axis, where a cell is as small as a dot of a picture that the object fills.
const MOST_CELLS: f64 = 262_144.0;

/// The most cells of all sub-lattices: 16 MB, and a second or two to fill. Each composite object has an equal
/// share; where they are many, each is few dots of the picture.
const ALL_CELLS: f64 = 4_194_304.0;

/// The most primitives named by the expressions of one sub-lattice, and of all: 12 bytes each, and three
/// times that while one is built. Past it cells share an expression, which costs tests but changes no hit.
const MOST_LEAVES: f64 = 4_194_304.0;
const ALL_LEAVES: f64 = 4.0 * MOST_LEAVES;

/// The sub-lattices of all composite objects.
#[derive(Debug)]
pub struct SubLattices {
    /// By object, up to the last that has one.
    cells: Vec<Option<SubLattice>>,
    /// By object, up to the last that has some: of those with many primitives.
    many: Vec<Option<CsgCells>>,
}

impl SubLattices {
    /// Cuts every composite object of an assembly.
    pub fn new(assembly: &Assembly) -> Self {
        Self::watched(assembly, &Progress::default())
    }

    /// The same, where `progress` says how far this is.
    pub fn watched(assembly: &Assembly, progress: &Progress) -> Self {
        progress.begin(Task::Cutting, assembly.objects.len() as u64);
        let composite = |object: &&WorldObject| matches!(object.body, Body::Composite { .. });
        let budget = Budget::shared(assembly.objects.iter().filter(composite).count());
        let of = |(number, object): (usize, &WorldObject)| match &object.body {
            Body::Single(_) | Body::Surface(_) => None,
            Body::Composite { whole, .. } if whole.leaves.len() >= MANY => None,
            Body::Composite { whole, .. } => {
                progress.reach(number as u64);
                SubLattice::new(whole, &assembly.primitives, &object.bounds, budget)
            }
        };
        let many = |(number, object): (usize, &WorldObject)| match &object.body {
            Body::Composite { whole, .. } if whole.leaves.len() >= MANY => {
                progress.reach(number as u64);
                Some(CsgCells::new(whole, assembly, &object.bounds, budget.leaves))
            }
            _ => None,
        };
        Self {
            cells: unless_none(assembly.objects.iter().enumerate().map(of)),
            many: unless_none(assembly.objects.iter().enumerate().map(many)),
        }
    }

    /// The sub-lattice of an object, where it has one.
    #[inline]
    pub fn of(&self, object: u32) -> Option<&SubLattice> {
        self.cells.get(object as usize)?.as_ref()
    }

    /// The cells of an object of many primitives.
    #[inline]
    pub fn cells(&self, object: u32) -> Option<&CsgCells> {
        self.many.get(object as usize)?.as_ref()
    }
}

/// By object up to the last that has one: most large scenes have no composite object at all.
fn unless_none<T>(all: impl Iterator<Item = Option<T>>) -> Vec<Option<T>> {
    let mut kept = Vec::new();
    for (object, one) in all.enumerate().filter(|(_, one)| one.is_some()) {
        kept.resize_with(object, || None);
        kept.push(one);
    }
    kept
}

/// What one sub-lattice may hold.
#[derive(Clone, Copy, Debug)]
struct Budget {
    cells: f64,
    leaves: f64,
}

impl Budget {
    /// The budget of each of `sharers`.
    fn shared(sharers: usize) -> Self {
        let share = |one: f64, all: f64| one.min(all / sharers.max(1) as f64);
        Self { cells: share(MOST_CELLS, ALL_CELLS), leaves: share(MOST_LEAVES, ALL_LEAVES) }
    }
}

/// Cells of one composite object.
#[derive(Clone, Debug)]
pub struct SubLattice {
    planes: Planes,
    /// By cell: an index into `parts`, or [`NOTHING`].
    cells: Vec<u32>,
    parts: Vec<Expression>,
    bounds: Bounds,
}

/// The first and the last cell along each axis.
type Range = [(usize, usize); 3];

/// The content of a cell without surfaces, be it outside or inside.
const NOTHING: u32 = u32::MAX;

impl SubLattice {
    /// The sub-lattice of the expression `whole` in the box `bounds`; `None` where it would be a single cell.
    fn new(
        whole: &Expression,
        primitives: &[WorldPrimitive],
        bounds: &Bounds,
        budget: Budget,
    ) -> Option<Self> {
        let leaves = &whole.leaves;
        if leaves.len() < 2 {
            return None;
        }
        let form = |leaf: &Leaf| &primitives[leaf.primitive as usize].form;
        let boxes = leaves.iter().map(|leaf| form(leaf).bounds());
        let mut planes = Planes::new(boxes, bounds);
        planes.thin(budget.cells);
        if planes.cells() <= 1.0 {
            return None;
        }
        let cells = vec![NOTHING; planes.cells() as usize];
        let place_error = leaves.iter().map(|leaf| form(leaf).place_error()).fold(0.0, f64::max);
        let (parts, pruning, slack) = (HashMap::new(), Pruning::default(), slack(place_error));
        let mut building = Building { primitives, planes: &planes, slack, cells, parts, pruning };
        let [nx, ny, nz] = planes.dimensions();
        building.fill(ExprView::from(whole), [(0, nx - 1), (0, ny - 1), (0, nz - 1)], budget.leaves);
        let Building { cells, parts, .. } = building;
        let mut parts: Vec<_> = parts.into_iter().collect();
        parts.sort_unstable_by_key(|&(_, number)| number);
        let parts = parts.into_iter().map(|(part, _)| part).collect();
        Some(Self { planes, cells, parts, bounds: *bounds })
    }

    /// Calls `visit` with each stretch of the ray, and the expression there where it has surfaces, in order,
    /// until it breaks. Cells that share an expression are not joined: a stretch is at most a cell.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        mut visit: impl FnMut(Option<&Expression>, CellStep) -> ControlFlow<B>,
    ) -> Option<B> {
        let start = super::clip::entry(ray, &self.bounds.padded(DVec3::splat(SLACK)))?;
        self.planes.walk(ray, start, f64::INFINITY, |step| {
            let part = self.cells[step.cell];
            visit((part != NOTHING).then(|| &self.parts[part as usize]), step)
        })
    }

    /// Cells along x, y and z.
    pub fn dimensions(&self) -> [usize; 3] {
        self.planes.dimensions()
    }

    /// Expressions that differ.
    pub fn parts(&self) -> usize {
        self.parts.len()
    }
}

struct Building<'a> {
    primitives: &'a [WorldPrimitive],
    planes: &'a Planes,
    slack: f64,
    cells: Vec<u32>,
    /// The expressions, each once, and their numbers.
    parts: HashMap<Expression, u32>,
    pruning: Pruning,
}

impl Building<'_> {
    /// Fills a range of cells, given what is left of the expression in a range around it, with expressions
    /// that name about `allowance` primitives together.
    fn fill(&mut self, around: ExprView, range: Range, allowance: f64) {
        // A crossing may be computed `slack` outside its cell; twice that keeps its whole cluster.
        let b = self.planes.bounds(&range).padded(DVec3::splat(2.0 * self.slack));
        let mut left = PrunedExpr::default();
        if around.pruned(self.primitives, &b, &mut self.pruning, &mut left) != Classification::Mixed {
            return;
        }
        let longest = (0..3).max_by_key(|&axis| range[axis].1 - range[axis].0).unwrap_or(0);
        let (first, last) = range[longest];
        // Both halves may still need all of it.
        if first == last || 2.0 * left.leaves.len() as f64 > allowance {
            let part = self.part(&left);
            let [x, y, z] = range;
            for (k, j) in (z.0..=z.1).flat_map(|k| (y.0..=y.1).map(move |j| (k, j))) {
                let row = self.planes.number([x.0, j, k]);
                self.cells[row..=row + x.1 - x.0].fill(part);
            }
            return;
        }
        let middle = usize::midpoint(first, last);
        let (mut low, mut high) = (range, range);
        low[longest].1 = middle;
        high[longest].0 = middle + 1;
        let share = (middle - first + 1) as f64 / (last - first + 1) as f64;
        self.fill(ExprView::from(&left), low, allowance * share);
        self.fill(ExprView::from(&left), high, allowance * (1.0 - share));
    }

    /// The number of an expression.
    fn part(&mut self, left: &PrunedExpr) -> u32 {
        let next = self.parts.len() as u32;
        *self.parts.entry(Expression::from(left)).or_insert(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DAffine3;
    use crate::scene::{Material, MaterialId, Scene, Shape, Solid};

    // Five thousand slanted plates took 20 s and a gigabyte: nearly every cell was crossed by hundreds of
    // them.
    #[test]
    fn expressions_stay_within_the_budget() {
        let plate = |k: u32| {
            let turn = DAffine3::from_rotation_x(f64::from(k));
            let map =
                turn * DAffine3::from_rotation_y(0.7) * DAffine3::from_scale(DVec3::new(1.0, 1.0, 0.01));
            Solid::Primitive(crate::scene::Primitive::new(Shape::Cube, map, MaterialId(0)))
        };
        let object = crate::scene::Object { name: None, solid: Solid::Union((0..60).map(plate).collect()) };
        let scene = Scene { objects: vec![object], materials: vec![Material::default()], ..Scene::default() };
        let assembly = Assembly::new(&scene).unwrap();
        let Body::Composite { whole, .. } = &assembly.objects[0].body else { panic!("one solid of many") };
        let leaves = |leaves: f64| {
            let budget = Budget { cells: 32_768.0, leaves };
            let sub = SubLattice::new(whole, &assembly.primitives, &assembly.limit, budget).unwrap();
            sub.parts.iter().map(|part| part.leaves.len()).sum::<usize>()
        };
        let (much, little) = (leaves(f64::INFINITY), leaves(500.0));
        assert!(much > 2000, "{much}: the budget is not put to the test");
        assert!(little < 1000, "{little}");
    }
}

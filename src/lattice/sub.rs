//! The sub-lattice of a composite object: in each cell, the part of its CSG expression that still matters there.

use std::collections::HashMap;
use std::ops::ControlFlow;

use crate::math::{Bounds, DVec3, Ray};
use crate::solid::{Assembly, Body, Expression, Object, Primitive, Pruned, Tree};

use super::planes::{Planes, SLACK, Step};

/// The most cells of one sub-lattice. Past it planes are left out, which costs tests but changes no hit: 64
/// along each axis, where a cell is as small as a dot of a picture that the object fills.
const MOST_CELLS: f64 = 262_144.0;

/// The sub-lattices of all composite objects.
#[derive(Clone, Debug)]
pub struct SubLattices(Vec<Option<SubLattice>>);

impl SubLattices {
    /// Cuts every composite object of an assembly.
    pub fn new(assembly: &Assembly) -> Self {
        let of = |object: &Object| match &object.body {
            Body::Single(_) | Body::Surface(_) => None,
            Body::Composite { tree, .. } => SubLattice::new(tree, &assembly.primitives, &object.bounds),
        };
        let all: Vec<_> = assembly.objects.iter().map(of).collect();
        // Most large scenes have no composite object at all.
        Self(if all.iter().all(Option::is_none) { Vec::new() } else { all })
    }

    /// The sub-lattice of an object, where it has one.
    #[inline]
    pub fn of(&self, object: u32) -> Option<&SubLattice> {
        self.0.get(object as usize)?.as_ref()
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

/// The content of a cell without surfaces, be it outside or inside.
const NOTHING: u32 = u32::MAX;

impl SubLattice {
    /// The sub-lattice of the expression `tree` in the box `bounds`; `None` where it would be a single cell.
    pub fn new(tree: &Tree, primitives: &[Primitive], bounds: &Bounds) -> Option<Self> {
        let leaves = tree.leaves();
        if leaves.len() < 2 {
            return None;
        }
        let boxes = leaves.iter().map(|&leaf| primitives[leaf as usize].form.bounds());
        let mut planes = Planes::new(boxes, bounds);
        planes.thin(MOST_CELLS);
        if planes.cells() <= 1.0 {
            return None;
        }
        let cells = vec![NOTHING; planes.cells() as usize];
        let mut building =
            Building { primitives, planes: &planes, cells, parts: Vec::new(), known: HashMap::new() };
        let [nx, ny, nz] = planes.dimensions();
        building.fill(tree, [(0, nx - 1), (0, ny - 1), (0, nz - 1)]);
        let Building { cells, parts, .. } = building;
        Some(Self { planes, cells, parts, bounds: *bounds })
    }

    /// Calls `visit` with each stretch of the ray that has surfaces, and the expression there, in order, until it
    /// breaks. Cells that share an expression are not joined: a stretch is at most a cell.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        cells_visited: &mut u64,
        mut visit: impl FnMut(&Expression, Step) -> ControlFlow<B>,
    ) -> Option<B> {
        let start = super::clip::entry(ray, &self.bounds.padded(DVec3::splat(SLACK)))?;
        self.planes.walk(ray, start, f64::INFINITY, |step| {
            *cells_visited += 1;
            match self.cells[step.cell] {
                NOTHING => ControlFlow::Continue(()),
                part => visit(&self.parts[part as usize], step),
            }
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
    primitives: &'a [Primitive],
    planes: &'a Planes,
    cells: Vec<u32>,
    parts: Vec<Expression>,
    /// Equal expressions are stored once. Only asked by key, so that its order plays no part.
    known: HashMap<Tree, u32>,
}

impl Building<'_> {
    /// Fills a range of cells, given what is left of the expression in a range around it.
    fn fill(&mut self, tree: &Tree, range: [(usize, usize); 3]) {
        // A crossing may be computed SLACK outside its cell; twice that keeps its whole cluster.
        let b = self.planes.bounds(&range).padded(DVec3::splat(2.0 * SLACK));
        let Pruned::Tree(tree) = tree.pruned(self.primitives, &b) else { return };
        let longest = (0..3).max_by_key(|&axis| range[axis].1 - range[axis].0).unwrap_or(0);
        let (first, last) = range[longest];
        if first == last {
            let part = self.part(&tree);
            let cell = self.planes.number([range[0].0, range[1].0, range[2].0]);
            self.cells[cell] = part;
            return;
        }
        let middle = usize::midpoint(first, last);
        let (mut low, mut high) = (range, range);
        low[longest].1 = middle;
        high[longest].0 = middle + 1;
        self.fill(&tree, low);
        self.fill(&tree, high);
    }

    fn part(&mut self, tree: &Tree) -> u32 {
        if let Some(&part) = self.known.get(tree) {
            return part;
        }
        let part = self.parts.len() as u32;
        self.parts.push(Expression::new(tree));
        self.known.insert(tree.clone(), part);
        part
    }
}

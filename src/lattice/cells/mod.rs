//! The cells of a composite object of many primitives: space is cut where that parts them, each cell has the
//! part of the expression that still matters there, and cells without a surface are left out.
//!
//! What is left are boxes, disjoint but for their sides, in a hierarchy as that of objects: rays and frustums
//! find those on their way as they find objects.

mod build;
mod split;

use std::ops::ControlFlow;

use crate::bvh::{BoxVisitor, Bvh8};
use crate::math::{Bounds, Mask, Number, Ray, Rays, Real, Vector};
use crate::solid::{Assembly, ExprView, Expression, Expressions, Leaf, TRange};

use super::loose_octree::LooseOctree;
use super::planes::{SLACK, slack};

use build::{Cutting, LeafBoxes, Part, cut};

/// Where single precision would need expressions to hold farther around their cells than this, it is not
/// used: they would name much beside their cells.
const WIDEST: f64 = 1.0 / 1024.0;

/// The cells of one object.
#[derive(Debug)]
pub struct CsgCells {
    /// By cell.
    bounds: Vec<Bounds>,
    expressions: Expressions,
    boxes: Bvh8,
    leaf_boxes: LeafBoxes,
    margin: f64,
    /// What is left of the expression around slices of a packet's way.
    loose: LooseOctree,
}

/// How far around its cell an expression is to hold where crossings may be computed `slack` beside their
/// places: twice that keeps their whole cluster. In single precision it is so much more, if that is little
/// enough.
fn margin(slack: f64) -> f64 {
    let least = 2.0 * slack;
    least.max((least * f32::EPSILON_RATIO).min(WIDEST))
}

/// A line as cells are cut out of it: 1 / d, and the largest number where that is larger, so that no product
/// with 0 is not a number.
#[derive(Clone, Copy, Debug)]
pub struct CellLine<N> {
    /// Where it starts.
    pub o: Vector<N>,
    /// The inverse of its direction.
    pub inverse: Vector<N>,
}

impl<N: Number> CellLine<N> {
    /// The lines of rays, whose numbers reach up to `greatest`.
    #[inline(always)]
    pub fn new(rays: &Rays<N>, greatest: f64) -> Self {
        let most = rays.o.x.same(greatest);
        let one = rays.o.x.same(1.0);
        let inverse = Vector { x: one / rays.d.x, y: one / rays.d.y, z: one / rays.d.z };
        let within = |x: N| x.smaller(most).larger(-most);
        Self {
            o: rays.o,
            inverse: Vector { x: within(inverse.x), y: within(inverse.y), z: within(inverse.z) },
        }
    }

    /// Between which distances the lines are in a box, from 0 on: of those that miss it the second is less.
    #[inline(always)]
    pub fn range(&self, b: &Bounds) -> (N, N) {
        let (mut from, mut to) = (self.o.x.same(0.0), self.o.x.same(f64::INFINITY));
        for axis in 0..3 {
            let (o, inverse) = (self.o.along(axis), self.inverse.along(axis));
            let (lo, hi) = ((o.same(b.lo[axis]) - o) * inverse, (o.same(b.hi[axis]) - o) * inverse);
            let ascends = lo.is_at_most(hi);
            from = from.larger(ascends.choose(lo, hi));
            to = to.smaller(ascends.choose(hi, lo));
        }
        (from, to)
    }
}

impl CsgCells {
    /// Cuts the object of the expression `whole` in the box `bounds`, into cells that name about `allowance`
    /// primitives together.
    pub fn new(whole: &Expression, assembly: &Assembly, bounds: &Bounds, allowance: f64) -> Self {
        let slack = slack(assembly.place_error);
        let margin = margin(slack);
        let leaf_boxes = LeafBoxes::new(whole, assembly);
        let cutting = Cutting { whole, assembly, boxes: &leaf_boxes, bounds, allowance, slack, margin };
        let Part { bounds, expressions } = cut(&cutting);
        let boxes = Bvh8::of_boxes(&bounds, slack);
        let loose = LooseOctree::new(*cutting.bounds);
        Self { bounds, expressions, boxes, leaf_boxes, margin, loose }
    }

    /// How far around its cell an expression holds.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// What is left of the object's expression in larger cells, which overlap.
    pub fn loose(&self) -> &LooseOctree {
        &self.loose
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.bounds.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.bounds.is_empty()
    }

    /// Primitives that their expressions name, all together.
    pub fn leaves(&self) -> usize {
        self.expressions.leaves()
    }

    /// Their boxes, in a hierarchy: its objects are the cells.
    #[inline]
    pub fn boxes(&self) -> &Bvh8 {
        &self.boxes
    }

    /// The box of one.
    #[inline]
    pub fn bounds(&self, cell: u32) -> &Bounds {
        &self.bounds[cell as usize]
    }

    /// The box around the part in a cell of a primitive of the object.
    #[inline]
    pub fn part(&self, cell: u32, leaf: &Leaf) -> Bounds {
        self.bounds(cell).meet(self.leaf_boxes.of(leaf))
    }

    /// The expression in one.
    #[inline]
    pub fn expression(&self, cell: u32) -> ExprView<'_> {
        self.expressions.get(cell as usize)
    }

    /// Leads a ray through its cells, nearly in order, as far as `to` and as the visitor says.
    pub fn walk(&self, ray: &Ray, to: f64, visitor: &mut impl CellsVisitor) {
        let line = CellLine::new(&Rays::from(ray), f64::MAX);
        self.boxes.walk(ray, 0.0, to, &mut CellBoxes { cells: self, line, limit: to, visitor });
    }
}

/// What becomes of the cells that a ray meets.
pub trait CellsVisitor {
    /// Takes a node of cells that the ray comes into at `from`, or behind that.
    fn enter(&mut self, from: f64);

    /// Takes the expression in a cell, and the part of the ray there. Returns how far the ray still matters.
    fn visit(&mut self, part: ExprView, reach: TRange) -> f64;
}

/// The boxes of cells on the way of a ray.
struct CellBoxes<'a, V> {
    cells: &'a CsgCells,
    line: CellLine<f64>,
    /// How far the ray still matters.
    limit: f64,
    visitor: &'a mut V,
}

impl<V: CellsVisitor> BoxVisitor<()> for CellBoxes<'_, V> {
    fn enter(&mut self, from: f64) {
        self.visitor.enter(from);
    }

    #[inline(never)]
    fn visit(&mut self, cell: u32, _: f64) -> ControlFlow<(), f64> {
        let (from, end) = self.line.range(self.cells.bounds(cell));
        if from <= end && from <= self.limit + SLACK {
            let reach = TRange { from: from - SLACK, to: end + SLACK };
            self.limit = self.visitor.visit(self.cells.expression(cell), reach);
        }
        ControlFlow::Continue(self.limit + SLACK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{DAffine3, DVec3};
    use crate::scene::{Material, MaterialId, Object, Primitive, Scene, Shape, Solid};
    use crate::solid::{Body, Crossing, Scratch, first_of_expression};
    use crate::stage::{Meter, Silent};

    /// Keeps the first crossing.
    struct Nearest<F> {
        first: F,
        found: Option<Crossing>,
    }

    impl<F: FnMut(ExprView, TRange) -> Option<Crossing>> CellsVisitor for Nearest<F> {
        fn enter(&mut self, _: f64) {}

        fn visit(&mut self, part: ExprView, reach: TRange) -> f64 {
            let crossing = (self.first)(part, reach);
            let is_nearer = |one: &Crossing| self.found.is_none_or(|found| one.t < found.t);
            self.found = crossing.filter(is_nearer).or(self.found);
            self.found.map_or(f64::INFINITY, |found| found.t)
        }
    }

    /// A block from which these are cut.
    fn cut_from_block(shape: &Shape, maps: impl Iterator<Item = DAffine3>) -> Assembly {
        let solid = |shape: &Shape, map| Solid::Primitive(Primitive::new(shape.clone(), map, MaterialId(0)));
        let block = solid(&Shape::Cube, DAffine3::from_scale(DVec3::new(1.0, 1.0, 0.2)));
        let parts = std::iter::once(block).chain(maps.map(|map| solid(shape, map))).collect();
        let object = Object { name: None, solid: Solid::Difference(parts) };
        let scene = Scene { objects: vec![object], materials: vec![Material::default()], ..Scene::default() };
        Assembly::new(&scene).unwrap()
    }

    fn whole(assembly: &Assembly) -> &Expression {
        let Body::Composite { whole, .. } = &assembly.objects[0].body else { panic!("one solid of many") };
        whole
    }

    /// A plate of `side` × `side` holes.
    fn plate(side: u32) -> Assembly {
        let step = 2.0 / f64::from(side);
        let place = move |k: u32| (f64::from(k) + 0.5) * step - 1.0;
        let holes = (0..side * side).map(move |k| {
            DAffine3::from_translation(DVec3::new(place(k % side), place(k / side), 0.0))
                * DAffine3::from_scale(DVec3::new(0.3 * step, 0.3 * step, 1.0))
        });
        cut_from_block(&Shape::Cone { bottom: 1.0, top: 1.0 }, holes)
    }

    fn cells(assembly: &Assembly, allowance: f64) -> CsgCells {
        CsgCells::new(whole(assembly), assembly, &assembly.objects[0].bounds, allowance)
    }

    // The sub-lattice of 10 000 holes had 262 144 cells.
    #[test]
    fn a_hole_has_few_cells_however_many_there_are() {
        for side in [10, 30, 50] {
            let cells = cells(&plate(side), f64::INFINITY);
            let holes = (side * side) as usize;
            assert!(cells.len() <= 2 * holes, "{} cells of {holes} holes", cells.len());
            assert!(cells.leaves() <= 8 * holes, "{} primitives of {holes} holes", cells.leaves());
        }
    }

    // What slanted plates share is in all cells.
    #[test]
    fn expressions_stay_within_the_allowance() {
        let slabs = (0..60).map(|k| {
            DAffine3::from_rotation_x(f64::from(k))
                * DAffine3::from_rotation_y(0.7)
                * DAffine3::from_scale(DVec3::new(1.0, 1.0, 0.01))
        });
        let assembly = cut_from_block(&Shape::Cube, slabs);
        let (much, little) = (cells(&assembly, f64::INFINITY).leaves(), cells(&assembly, 500.0).leaves());
        assert!(much > 2000, "{much}: the allowance is not put to the test");
        assert!(little < 1000, "{little}");
    }

    #[test]
    fn a_ray_finds_in_the_cells_what_it_finds_in_the_whole() {
        let assembly = plate(9);
        let cells = cells(&assembly, f64::INFINITY);
        let (mut scratch, mut meter) = (Scratch::default(), Meter::new(Silent));
        for k in 0..500 {
            let [x, y, z] = [31, 89, 200].map(|step| f64::from(k * step % 257) / 128.0 - 1.0);
            let start = DVec3::new(x, y, if k % 3 == 0 { 0.0 } else { 1.5 });
            // Every fifth ray runs straight down, or along a plane between cells.
            let d = if k % 5 == 0 { -DVec3::Z } else { DVec3::new(z, 0.5 - x, -1.0).normalize() };
            let ray = Ray::new(start, d);
            let mut first = |expression: ExprView<'_>, reach| {
                let primitives = &assembly.primitives;
                first_of_expression(&ray, expression, primitives, None, reach, &mut scratch, &mut meter)
            };
            let expected = first(whole(&assembly).into(), TRange::ALL);
            let mut nearest = Nearest { first, found: None };
            cells.walk(&ray, f64::INFINITY, &mut nearest);
            assert_eq!(nearest.found, expected, "{ray:?}");
        }
    }
}

//! How the space of a picture is cut.

use std::ops::ControlFlow;

use crate::math::Ray;

use super::{Bvh8, CellStep, CsgCells, Lattice, SubLattice, SubLattices, Tree};

/// How the space of a picture is cut. Every structure leads to the same hits.
#[derive(Clone, Copy, Debug)]
pub enum Structure<'a> {
    /// Not at all: every ray is tested against every object, and composite objects as a whole.
    None,
    /// The paper's lattice, with sub-lattices in composite objects.
    Lattice(&'a Lattice, &'a SubLattices),
    /// Lattices within lattices, with sub-lattices in composite objects.
    Tree(&'a Tree, &'a SubLattices),
    /// Boxes around boxes, with sub-lattices in composite objects.
    Boxes(&'a Bvh8, &'a SubLattices),
}

impl<'a> Structure<'a> {
    /// Calls `visit` with the objects of each cell that the ray passes between `from` and `to` until it
    /// breaks: in order where cells are disjoint, nearly so where boxes overlap. `visit` returns how far the
    /// ray still matters: cells that begin beyond that are not visited. Without a structure there are no
    /// cells; of boxes, each that holds an object is one.
    pub fn walk<B>(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        visit: impl FnMut(&[u32], CellStep) -> ControlFlow<B, f64>,
    ) -> Option<B> {
        match self {
            Self::None => None,
            Self::Lattice(lattice, _) => lattice.walk(ray, from, to, visit),
            Self::Tree(tree, _) => tree.walk(ray, from, to, visit),
            Self::Boxes(boxes, _) => {
                let mut visit = visit;
                boxes.walk(ray, from, to, &mut |object: u32, from: f64| {
                    visit(&[object], CellStep { cell: object as usize, from, to })
                })
            }
        }
    }

    /// The sub-lattice of an object, where it has one.
    #[inline]
    pub fn sub(&self, object: u32) -> Option<&'a SubLattice> {
        match self {
            Self::None => None,
            Self::Lattice(_, subs) | Self::Tree(_, subs) | Self::Boxes(_, subs) => subs.of(object),
        }
    }

    /// The cells of an object of many primitives, where it is cut.
    #[inline]
    pub fn cells(&self, object: u32) -> Option<&'a CsgCells> {
        match self {
            Self::None => None,
            Self::Lattice(_, subs) | Self::Tree(_, subs) | Self::Boxes(_, subs) => subs.cells(object),
        }
    }

    /// The name on the command line.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Lattice(..) => "lattice",
            Self::Tree(..) => "tree",
            Self::Boxes(..) => "boxes",
        }
    }
}

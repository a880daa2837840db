//! Stage 8, CSG: an expression over primitives, pruned to a box.
//!
//! Union, intersection and difference become two operators, *any* and *all*, over children that may be negated.
//! A box in which a primitive is certainly inside or outside replaces it by a constant, and the constants fold.

use crate::math::{Bounds, DVec3};
use crate::scene::Solid;

use super::primitive::{Cover, Primitive};

/// An expression over primitives.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Tree {
    /// Inside this primitive, by its index.
    Leaf(u32),
    /// Inside any of these.
    Any(Vec<Child>),
    /// Inside all of these.
    All(Vec<Child>),
}

/// A child, taken as it is or its complement.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Child {
    /// The child.
    pub tree: Tree,
    /// Whether its complement is meant.
    pub negated: bool,
}

/// What is left of an expression in a box.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Pruned {
    /// Nothing of the solid is in the box.
    Out,
    /// The whole box is in the solid.
    In,
    /// This decides.
    Tree(Tree),
}

impl Tree {
    /// The expression of a solid whose primitives are numbered from `*next` in file order. `None` for a solid
    /// of nothing.
    pub fn new(solid: &Solid, next: &mut u32) -> Option<Self> {
        let plain = |tree| Child { tree, negated: false };
        match solid {
            Solid::Primitive(_) => {
                let leaf = Self::Leaf(*next);
                *next += 1;
                Some(leaf)
            }
            Solid::Union(children) => {
                let children = children.iter().filter_map(|c| Self::new(c, next)).map(plain).collect();
                fold(Self::Any(children), false)
            }
            Solid::Intersection(children) => {
                let children: Vec<_> = children.iter().map(|c| Self::new(c, next)).collect();
                let children: Option<Vec<_>> = children.into_iter().map(|c| c.map(plain)).collect();
                fold(Self::All(children?), false)
            }
            Solid::Difference(children) => {
                let mut children =
                    children.iter().map(|c| Self::new(c, next)).collect::<Vec<_>>().into_iter();
                let first = children.next().flatten().map(plain);
                let cuts = children.flatten().map(|tree| Child { tree, negated: true });
                fold(Self::All(std::iter::once(first?).chain(cuts).collect()), false)
            }
        }
    }

    /// The expression inside a box.
    pub fn pruned(&self, primitives: &[Primitive], b: &Bounds) -> Pruned {
        match self {
            Self::Leaf(index) => match primitives[*index as usize].form.cover(b) {
                Cover::All => Pruned::In,
                Cover::None => Pruned::Out,
                Cover::Some => Pruned::Tree(self.clone()),
            },
            Self::Any(children) => prune_children(children, primitives, b, true),
            Self::All(children) => prune_children(children, primitives, b, false),
        }
    }

    /// The primitives it depends on, in file order.
    pub fn leaves(&self) -> Vec<u32> {
        let mut found = Vec::new();
        self.visit(&mut |leaf| found.push(leaf));
        found
    }

    fn visit(&self, f: &mut impl FnMut(u32)) {
        match self {
            Self::Leaf(leaf) => f(*leaf),
            Self::Any(children) | Self::All(children) => children.iter().for_each(|c| c.tree.visit(f)),
        }
    }

    /// How far the solid reaches along `v` at most. A difference reaches no further than what it cuts from.
    pub fn support(&self, primitives: &[Primitive], v: DVec3) -> f64 {
        match self {
            Self::Leaf(index) => primitives[*index as usize].form.support(v),
            Self::Any(children) => {
                let own = children.iter().map(|c| c.tree.support(primitives, v));
                own.fold(f64::NEG_INFINITY, f64::max)
            }
            Self::All(children) => {
                let own = children.iter().filter(|c| !c.negated).map(|c| c.tree.support(primitives, v));
                own.fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// The solids that it puts together: the operands of its unions, and of unions in those, or itself.
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Any(children) if children.iter().all(|child| !child.negated) => {
                children.iter().flat_map(|child| child.tree.parts()).collect()
            }
            whole => vec![whole],
        }
    }

    /// A box around the solid. A difference reaches no further than what it cuts from.
    pub fn bounds(&self, primitives: &[Primitive]) -> Bounds {
        match self {
            Self::Leaf(index) => primitives[*index as usize].form.bounds(),
            Self::Any(children) => {
                children.iter().fold(Bounds::EMPTY, |b, c| b.join(&c.tree.bounds(primitives)))
            }
            Self::All(children) => {
                let mut own = children.iter().filter(|c| !c.negated).map(|c| c.tree.bounds(primitives));
                let first = own.next().unwrap_or(Bounds::EMPTY);
                own.fold(first, |b, c| b.meet(&c))
            }
        }
    }
}

/// `stop` is the value of a child that decides the operator: true for *any*, false for *all*.
fn prune_children(children: &[Child], primitives: &[Primitive], b: &Bounds, stop: bool) -> Pruned {
    let mut left = Vec::new();
    for child in children {
        let constant = match child.tree.pruned(primitives, b) {
            Pruned::Tree(tree) => {
                left.push(Child { tree, negated: child.negated });
                continue;
            }
            Pruned::In => !child.negated,
            Pruned::Out => child.negated,
        };
        if constant == stop {
            return if stop { Pruned::In } else { Pruned::Out };
        }
    }
    let empty = if stop { Pruned::Out } else { Pruned::In };
    let tree = if stop { Tree::Any(left) } else { Tree::All(left) };
    fold(tree, true).map_or(empty, Pruned::Tree)
}

/// An operator over one child is that child; over none it is nothing.
fn fold(tree: Tree, keep_negated: bool) -> Option<Tree> {
    match tree {
        Tree::Any(mut children) | Tree::All(mut children) if children.len() == 1 && !children[0].negated => {
            children.pop().map(|c| c.tree)
        }
        Tree::Any(ref children) | Tree::All(ref children) if children.is_empty() => None,
        tree => {
            debug_assert!(keep_negated || !matches!(&tree, Tree::All(c) if c.iter().all(|c| c.negated)));
            Some(tree)
        }
    }
}

/// An expression laid out flat, for evaluation along a ray.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expression {
    /// The primitives in file order.
    pub leaves: Box<[Leaf]>,
    /// The operators; the root is the first. Empty for an expression that is one primitive.
    pub(super) nodes: Box<[Node]>,
}

/// One primitive of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leaf {
    /// Its index in the assembly.
    pub primitive: u32,
    pub(super) parent: Link,
}

/// The way up from a child.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Link {
    /// The operator; [`Link::ROOT`] above the root.
    pub node: u32,
    pub negated: bool,
}

impl Link {
    pub const ROOT: u32 = u32::MAX;
}

/// An operator: true where at least `threshold` of its children, each negated or not, are true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub parent: Link,
    pub threshold: u32,
    /// How many children are true before any primitive is entered.
    pub initial: u32,
}

impl Expression {
    /// Lays a tree out.
    pub fn new(tree: &Tree) -> Self {
        let (mut leaves, mut nodes) = (Vec::new(), Vec::new());
        flatten(tree, Link { node: Link::ROOT, negated: false }, &mut leaves, &mut nodes);
        Self { leaves: leaves.into(), nodes: nodes.into() }
    }

    /// Whether a point outside all primitives is inside.
    pub fn outside_value(&self) -> bool {
        self.nodes.first().is_some_and(|root| root.initial >= root.threshold)
    }
}

fn flatten(tree: &Tree, parent: Link, leaves: &mut Vec<Leaf>, nodes: &mut Vec<Node>) -> bool {
    let (children, all) = match tree {
        Tree::Leaf(primitive) => {
            leaves.push(Leaf { primitive: *primitive, parent });
            return false;
        }
        Tree::Any(children) => (children, false),
        Tree::All(children) => (children, true),
    };
    let index = nodes.len();
    let threshold = if all { children.len() as u32 } else { 1 };
    nodes.push(Node { parent, threshold, initial: 0 });
    for child in children {
        let link = Link { node: index as u32, negated: child.negated };
        if flatten(&child.tree, link, leaves, nodes) != child.negated {
            nodes[index].initial += 1;
        }
    }
    nodes[index].initial >= threshold
}

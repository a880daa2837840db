//! Stage 8, CSG: an expression over primitives, pruned to a box.
//!
//! Union, intersection and difference become two operators, *any* and *all*, over children that may be negated.
//! A box in which a primitive is certainly inside or outside replaces it by a constant, and the constants fold.

use std::vec::Drain;

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
        let mut leaf = |_| {
            let leaf = Self::Leaf(*next);
            *next += 1;
            Some(leaf)
        };
        solid.fold(&mut leaf, &mut |solid, mut children| match solid {
            Solid::Primitive(_) | Solid::Union(_) => {
                fold(Self::Any(children.flatten().map(plain).collect()), false)
            }
            Solid::Intersection(_) => {
                let children: Option<Vec<_>> = children.map(|c| c.map(plain)).collect();
                fold(Self::All(children?), false)
            }
            Solid::Difference(_) => {
                let first = children.next().flatten().map(plain);
                let cuts = children.flatten().map(|tree| Child { tree, negated: true });
                fold(Self::All(std::iter::once(first?).chain(cuts).collect()), false)
            }
        })
    }

    /// How many operators stand inside each other at most.
    pub fn depth(&self) -> usize {
        self.fold_up(|_| 0, |_, operands| 1 + operands.max().unwrap_or(0))
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
        let (mut found, mut open) = (Vec::new(), vec![self]);
        while let Some(tree) = open.pop() {
            match tree {
                Self::Leaf(leaf) => found.push(*leaf),
                Self::Any(children) | Self::All(children) => {
                    open.extend(children.iter().rev().map(|c| &c.tree));
                }
            }
        }
        found
    }

    /// What `leaf` makes of the primitives, put together by `join` at each operator, from the innermost outwards. Does not
    /// recurse, as [`Solid::fold`].
    fn fold_up<T>(&self, leaf: impl Fn(u32) -> T, join: impl Fn(&Self, Drain<'_, T>) -> T) -> T {
        let children = match self {
            Self::Leaf(index) => return leaf(*index),
            Self::Any(children) | Self::All(children) => children,
        };
        let mut open = vec![(self, children.iter(), 0)];
        let mut values = Vec::new();
        loop {
            let Some((tree, rest, start)) = open.last_mut() else { return join(self, values.drain(..)) };
            match rest.next().map(|child| &child.tree) {
                Some(Self::Leaf(index)) => values.push(leaf(*index)),
                Some(inner @ (Self::Any(children) | Self::All(children))) => {
                    open.push((inner, children.iter(), values.len()));
                }
                None => {
                    let value = join(tree, values.drain(*start..));
                    open.pop();
                    if open.is_empty() {
                        return value;
                    }
                    values.push(value);
                }
            }
        }
    }

    /// How far the solid reaches along `v` at most. A difference reaches no further than what it cuts from.
    pub fn support(&self, primitives: &[Primitive], v: DVec3) -> f64 {
        self.fold_up(
            |index| primitives[index as usize].form.support(v),
            |tree, own| match tree {
                Self::All(children) => kept(children, own).fold(f64::INFINITY, f64::min),
                _ => own.fold(f64::NEG_INFINITY, f64::max),
            },
        )
    }

    /// The solids that it puts together: the operands of its unions, and of unions in those, or itself.
    pub fn parts(&self) -> Vec<&Self> {
        let (mut parts, mut open) = (Vec::new(), vec![self]);
        while let Some(tree) = open.pop() {
            match tree {
                Self::Any(children) if children.iter().all(|child| !child.negated) => {
                    open.extend(children.iter().rev().map(|child| &child.tree));
                }
                whole => parts.push(whole),
            }
        }
        parts
    }

    /// A box around the solid. A difference reaches no further than what it cuts from.
    pub fn bounds(&self, primitives: &[Primitive]) -> Bounds {
        self.fold_up(
            |index| primitives[index as usize].form.bounds(),
            |tree, own| match tree {
                Self::All(children) => kept(children, own).reduce(|b, c| b.meet(&c)).unwrap_or(Bounds::EMPTY),
                _ => own.fold(Bounds::EMPTY, |b, c| b.join(&c)),
            },
        )
    }
}

/// Of the values of children those that are taken as they are.
fn kept<T>(children: &[Child], values: impl Iterator<Item = T>) -> impl Iterator<Item = T> {
    children.iter().zip(values).filter(|(child, _)| !child.negated).map(|(_, value)| value)
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
        flatten(tree, &mut leaves, &mut nodes);
        Self { leaves: leaves.into(), nodes: nodes.into() }
    }

    /// Whether a point outside all primitives is inside.
    pub fn outside_value(&self) -> bool {
        self.nodes.first().is_some_and(|root| root.initial >= root.threshold)
    }
}

/// An operator that is laid out, while its children are.
struct Laying<'t> {
    node: usize,
    rest: std::slice::Iter<'t, Child>,
    negated: bool,
}

/// Lays a tree out: operators before their children, primitives in file order.
fn flatten(tree: &Tree, leaves: &mut Vec<Leaf>, nodes: &mut Vec<Node>) {
    let mut open: Vec<Laying<'_>> = Vec::new();
    let mut next = Some((tree, false));
    loop {
        let node = open.last().map_or(Link::ROOT, |laying| laying.node as u32);
        // The value outside of all primitives, of what ends here.
        let ended = match next {
            Some((Tree::Leaf(primitive), negated)) => {
                leaves.push(Leaf { primitive: *primitive, parent: Link { node, negated } });
                Some(negated)
            }
            Some((operator @ (Tree::Any(children) | Tree::All(children)), negated)) => {
                let threshold = if matches!(operator, Tree::All(_)) { children.len() as u32 } else { 1 };
                open.push(Laying { node: nodes.len(), rest: children.iter(), negated });
                nodes.push(Node { parent: Link { node, negated }, threshold, initial: 0 });
                None
            }
            None => open.pop().map(|laying| {
                let node = &nodes[laying.node];
                (node.initial >= node.threshold) != laying.negated
            }),
        };
        let Some(laying) = open.last_mut() else { return };
        if ended == Some(true) {
            nodes[laying.node].initial += 1;
        }
        next = laying.rest.next().map(|child| (&child.tree, child.negated));
    }
}

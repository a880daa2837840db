//! Stage 8, CSG: an expression over primitives.
//!
//! Union, intersection and difference become two operators, *any* and *all*, over children that may be
//! negated.

use std::vec::Drain;

use crate::math::{Bounds, DVec3};
use crate::scene::Solid;

use super::primitive::WorldPrimitive;

/// An expression over primitives.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum CsgTree {
    /// Inside this primitive, by its index.
    Leaf(u32),
    /// Inside any of these.
    Any(Vec<Operand>),
    /// Inside all of these.
    All(Vec<Operand>),
}

/// A child, taken as it is or its complement.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Operand {
    /// The child.
    pub tree: CsgTree,
    /// Whether its complement is meant.
    pub negated: bool,
}

impl CsgTree {
    /// The expression of a solid whose primitives are numbered from `*next` in file order. `None` for a solid
    /// of nothing.
    pub fn new(solid: &Solid, next: &mut u32) -> Option<Self> {
        let plain = |tree| Operand { tree, negated: false };
        let mut leaf = |_| {
            let leaf = Self::Leaf(*next);
            *next += 1;
            Some(leaf)
        };
        solid.fold(&mut leaf, &mut |solid, mut children| match solid {
            Solid::Primitive(_) | Solid::Union(_) => fold(Self::Any(children.flatten().map(plain).collect())),
            Solid::Intersection(_) => {
                let children: Option<Vec<_>> = children.map(|c| c.map(plain)).collect();
                fold(Self::All(children?))
            }
            Solid::Difference(_) => {
                let first = children.next().flatten().map(plain);
                let cuts = children.flatten().map(|tree| Operand { tree, negated: true });
                fold(Self::All(std::iter::once(first?).chain(cuts).collect()))
            }
        })
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

    /// What `leaf` makes of the primitives, put together by `join` at each operator, from the innermost
    /// outwards. Does not recurse, as [`Solid::fold`].
    pub(super) fn fold_up<T>(&self, leaf: impl Fn(u32) -> T, join: impl Fn(&Self, Drain<'_, T>) -> T) -> T {
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
    pub fn support(&self, primitives: &[WorldPrimitive], v: DVec3) -> f64 {
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
    pub fn bounds(&self, primitives: &[WorldPrimitive]) -> Bounds {
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
fn kept<T>(children: &[Operand], values: impl Iterator<Item = T>) -> impl Iterator<Item = T> {
    children.iter().zip(values).filter(|(child, _)| !child.negated).map(|(_, value)| value)
}

/// An operator over one child is that child; over none it is nothing.
fn fold(tree: CsgTree) -> Option<CsgTree> {
    match tree {
        CsgTree::Any(mut children) | CsgTree::All(mut children)
            if children.len() == 1 && !children[0].negated =>
        {
            children.pop().map(|c| c.tree)
        }
        CsgTree::Any(ref children) | CsgTree::All(ref children) if children.is_empty() => None,
        tree => {
            debug_assert!(!matches!(&tree, CsgTree::All(c) if c.iter().all(|c| c.negated)));
            Some(tree)
        }
    }
}

/// An expression laid out flat, for evaluation along a ray.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Expression {
    /// The primitives in file order.
    pub leaves: Box<[Leaf]>,
    /// The operators; the root is the first. Empty for an expression that is one primitive.
    pub(super) nodes: Box<[Node]>,
}

/// One primitive of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Leaf {
    /// Its index in the assembly.
    pub primitive: u32,
    pub(super) parent: Link,
}

/// The way up from a child.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Link {
    /// The operator; [`Link::ROOT`] above the root.
    pub node: u32,
    pub negated: bool,
}

impl Link {
    pub const ROOT: u32 = u32::MAX;

    /// The link from a child whose own link, to an operator that has become this one, is `below`.
    #[inline(always)]
    pub fn over(self, below: Self) -> Self {
        Self { node: self.node, negated: self.negated != below.negated }
    }
}

/// An operator: true where at least `threshold` of its children, each negated or not, are true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Node {
    pub parent: Link,
    pub threshold: u32,
    /// How many children are true before any primitive is entered.
    pub initial: u32,
}

impl Expression {
    /// Lays a tree out.
    pub fn new(tree: &CsgTree) -> Self {
        let (leaves, nodes) = flatten(tree);
        Self::of(leaves, nodes)
    }

    /// The expression of these primitives under these operators, whose `initial` is 0.
    pub(super) fn of(leaves: Vec<Leaf>, mut nodes: Vec<Node>) -> Self {
        count_initial(&leaves, &mut nodes);
        Self { leaves: leaves.into(), nodes: nodes.into() }
    }

    /// Whether a point outside all primitives is inside.
    pub fn outside_value(&self) -> bool {
        self.nodes.first().is_some_and(|root| root.initial >= root.threshold)
    }
}

/// An operator whose children are being laid out.
struct OpenOperator<'t> {
    node: u32,
    rest: std::slice::Iter<'t, Operand>,
}

/// Lays a tree out: operators before their children, primitives in file order.
fn flatten(tree: &CsgTree) -> (Vec<Leaf>, Vec<Node>) {
    let (mut leaves, mut nodes) = (Vec::new(), Vec::new());
    let mut open: Vec<OpenOperator<'_>> = Vec::new();
    let mut next = Some((tree, false));
    loop {
        let node = open.last().map_or(Link::ROOT, |operator| operator.node);
        match next {
            Some((CsgTree::Leaf(primitive), negated)) => {
                leaves.push(Leaf { primitive: *primitive, parent: Link { node, negated } });
            }
            Some((operator @ (CsgTree::Any(children) | CsgTree::All(children)), negated)) => {
                let threshold = if matches!(operator, CsgTree::All(_)) { children.len() as u32 } else { 1 };
                open.push(OpenOperator { node: nodes.len() as u32, rest: children.iter() });
                nodes.push(Node { parent: Link { node, negated }, threshold, initial: 0 });
            }
            None => {
                open.pop();
            }
        }
        let Some(operator) = open.last_mut() else { return (leaves, nodes) };
        next = operator.rest.next().map(|child| (&child.tree, child.negated));
    }
}

/// Counts the children of each operator that are true outside of all primitives, onto an `initial` of 0.
pub(super) fn count_initial(leaves: &[Leaf], nodes: &mut [Node]) {
    for leaf in leaves.iter().filter(|leaf| leaf.parent.node != Link::ROOT) {
        nodes[leaf.parent.node as usize].initial += u32::from(leaf.parent.negated);
    }
    // Children stand behind their parents.
    for place in (1..nodes.len()).rev() {
        let node = &nodes[place];
        let (parent, value) = (node.parent, node.initial >= node.threshold);
        nodes[parent.node as usize].initial += u32::from(value != parent.negated);
    }
}

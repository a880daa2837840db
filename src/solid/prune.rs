//! Stage 8, CSG: an expression pruned to a box, laid out flat as it was: without memory of its own, for whoever prunes
//! again and again.

use crate::math::Bounds;

use super::expression::{Expression, Leaf, Link, Node};
use super::primitive::{Cover, Primitive};

/// What is left of an expression in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Classification {
    /// Nothing of the solid is in the box.
    Out,
    /// The whole box is in the solid.
    In,
    /// The pruned expression decides.
    Some,
}

/// Memory for pruning.
#[derive(Clone, Debug, Default)]
pub struct Pruning {
    /// By leaf: how it lies to the box.
    covers: Vec<Cover>,
    /// By operator: how many children are undecided; the value where that is none of them.
    open: Vec<u32>,
    decided: Vec<bool>,
    /// By operator: its place in the pruned expression.
    places: Vec<u32>,
}

/// An expression that is overwritten by what others are pruned to.
#[derive(Clone, Debug, Default)]
pub struct PrunedExpr {
    /// The primitives that still matter, in file order.
    pub leaves: Vec<Leaf>,
    /// The operators above them; the root is the first.
    pub(super) nodes: Vec<Node>,
}

/// An expression laid out flat, whoever holds it.
#[derive(Clone, Copy, Debug)]
pub struct ExprView<'e> {
    /// The primitives in file order.
    pub leaves: &'e [Leaf],
    /// The operators; the root is the first. None where the expression is one primitive.
    pub(super) nodes: &'e [Node],
}

impl<'e> From<&'e Expression> for ExprView<'e> {
    fn from(expression: &'e Expression) -> Self {
        Self { leaves: &expression.leaves, nodes: &expression.nodes }
    }
}

impl<'e> From<&'e PrunedExpr> for ExprView<'e> {
    fn from(remains: &'e PrunedExpr) -> Self {
        Self { leaves: &remains.leaves, nodes: &remains.nodes }
    }
}

impl ExprView<'_> {
    /// Of an expression of one primitive: whether it is true outside.
    pub(super) fn is_negated(self) -> bool {
        // Every operator has one child, the one behind it or the primitive.
        let operators = self.nodes.iter().map(|node| node.parent);
        operators
            .chain(self.leaves.iter().map(|leaf| leaf.parent))
            .fold(false, |odd, link| odd ^ link.negated)
    }

    /// Prunes to a box; `remains` means something only where the answer is [`Classification::Some`].
    pub fn pruned(
        self,
        primitives: &[Primitive],
        b: &Bounds,
        memory: &mut Pruning,
        remains: &mut PrunedExpr,
    ) -> Classification {
        let Pruning { covers, open, decided, places } = memory;
        covers.clear();
        covers.extend(self.leaves.iter().map(|leaf| primitives[leaf.primitive as usize].form.cover(b)));
        if self.nodes.is_empty() {
            remains.nodes.clear();
            remains.leaves.clear();
            remains.leaves.extend_from_slice(self.leaves);
            return match covers[0] {
                Cover::All => Classification::In,
                Cover::None => Classification::Out,
                Cover::Some => Classification::Some,
            };
        }
        // An operator is decided by a child that alone decides it, and stays so; `stop` is the value of such a child.
        let stop = |node: &Node| node.threshold == 1;
        open.clear();
        open.resize(self.nodes.len(), 0);
        decided.clear();
        decided.resize(self.nodes.len(), false);
        for (leaf, cover) in self.leaves.iter().zip(&*covers) {
            let place = leaf.parent.node as usize;
            match cover {
                Cover::Some => open[place] += 1,
                cover => {
                    let value = (*cover == Cover::All) != leaf.parent.negated;
                    decided[place] |= value == stop(&self.nodes[place]);
                }
            }
        }
        // Children stand behind their parents.
        for place in (0..self.nodes.len()).rev() {
            let node = &self.nodes[place];
            if node.parent.node == Link::ROOT {
                continue;
            }
            let above = node.parent.node as usize;
            match value(node, decided[place], open[place]) {
                None => open[above] += 1,
                Some(value) => {
                    decided[above] |= (value != node.parent.negated) == stop(&self.nodes[above]);
                }
            }
        }
        match value(&self.nodes[0], decided[0], open[0]) {
            Some(true) => return Classification::In,
            Some(false) => return Classification::Out,
            None => {}
        }
        let PrunedExpr { leaves, nodes } = remains;
        nodes.clear();
        leaves.clear();
        places.clear();
        for (place, node) in self.nodes.iter().enumerate() {
            let above = node.parent.node;
            let gone = decided[place]
                || open[place] == 0
                || (above != Link::ROOT && places[above as usize] == Link::ROOT);
            places.push(if gone { Link::ROOT } else { nodes.len() as u32 });
            if !gone {
                let parent = if above == Link::ROOT {
                    node.parent
                } else {
                    Link { node: places[above as usize], ..node.parent }
                };
                let threshold = if node.threshold == 1 { 1 } else { open[place] };
                nodes.push(Node { parent, threshold, initial: 0 });
            }
        }
        for (leaf, cover) in self.leaves.iter().zip(&*covers) {
            let place = places[leaf.parent.node as usize];
            if *cover == Cover::Some && place != Link::ROOT {
                let parent = Link { node: place, negated: leaf.parent.negated };
                leaves.push(Leaf { primitive: leaf.primitive, parent });
            }
        }
        Classification::Some
    }
}

/// The value of an operator; `None` where it is open.
fn value(node: &Node, decided: bool, open: u32) -> Option<bool> {
    let stop = node.threshold == 1;
    if decided {
        Some(stop)
    } else if open == 0 {
        Some(!stop)
    } else {
        None
    }
}

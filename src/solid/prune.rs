//! Stage 8, CSG: an expression pruned to a box.
//!
//! A box in which a primitive is certainly inside or outside replaces it by a constant, and the constants
//! fold. What is left is laid out as the expression was, in memory that is used again: the slices of a
//! packet's way prune again and again.

use crate::math::Bounds;

use super::classification::Classification;
use super::expression::{Expression, Leaf, Link, Node};
use super::primitive::WorldPrimitive;

/// Memory for pruning.
#[derive(Clone, Debug, Default)]
pub struct Pruning {
    /// By leaf: how the box lies to it.
    leaves: Vec<Classification>,
    /// By operator: what is known of its children.
    children: Vec<Children>,
    /// By operator: what its open children become the children of; none where the operator is a constant, or
    /// is below one.
    parents: Vec<Option<Link>>,
}

/// What is known of an operator's children in a box.
#[derive(Clone, Copy, Debug, Default)]
struct Children {
    /// How many are open: neither certainly true nor certainly false.
    open: u32,
    /// Whether any of the open ones is negated.
    any_negated: bool,
    /// Whether one alone decides the operator: a true one of *any*, a false one of *all*.
    decided: bool,
}

impl Children {
    /// Adds a child of `node`, with its value where that is known, by the link from it.
    #[inline(always)]
    fn add(&mut self, node: &Node, link: Link, value: Option<bool>) {
        if let Some(value) = value {
            self.decided |= (value != link.negated) == stop(node);
        } else {
            self.open += 1;
            self.any_negated |= link.negated;
        }
    }

    /// The value of the operator; none where that is open.
    #[inline(always)]
    fn value(self, node: &Node) -> Option<bool> {
        if self.decided {
            Some(stop(node))
        } else if self.open == 0 {
            Some(!stop(node))
        } else {
            None
        }
    }

    /// Whether the operator is nothing but its one open child.
    #[inline(always)]
    fn is_its_child(self) -> bool {
        self.open == 1 && !self.any_negated
    }
}

/// The value of a child that alone decides the operator. Of one child *any* and *all* are the same.
#[inline(always)]
fn stop(node: &Node) -> bool {
    node.threshold == 1
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

impl From<&PrunedExpr> for Expression {
    fn from(remains: &PrunedExpr) -> Self {
        Self::of(remains.leaves.clone(), remains.nodes.clone())
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

    /// Prunes to a box; `remains` means something only where the answer is [`Classification::Mixed`].
    pub fn pruned(
        self,
        primitives: &[WorldPrimitive],
        b: &Bounds,
        memory: &mut Pruning,
        remains: &mut PrunedExpr,
    ) -> Classification {
        memory.leaves.clear();
        let forms = self.leaves.iter().map(|leaf| &primitives[leaf.primitive as usize].form);
        memory.leaves.extend(forms.map(|form| form.classify(b)));
        self.folded(memory, remains)
    }

    /// Takes out the primitives that are missed, which a bit for each says, the first the lowest, of up to
    /// 64; as [`ExprView::pruned`].
    pub fn without(self, missed: u64, memory: &mut Pruning, remains: &mut PrunedExpr) -> Classification {
        let classification = |leaf: usize| {
            if leaf < 64 && missed >> leaf & 1 == 1 { Classification::Outside } else { Classification::Mixed }
        };
        memory.leaves.clear();
        memory.leaves.extend((0..self.leaves.len()).map(classification));
        self.folded(memory, remains)
    }

    /// Folds the constants that primitives are replaced by.
    fn folded(self, memory: &mut Pruning, remains: &mut PrunedExpr) -> Classification {
        let Pruning { leaves, children, parents } = memory;
        remains.leaves.clear();
        remains.nodes.clear();
        if self.nodes.is_empty() {
            remains.leaves.extend_from_slice(self.leaves);
            return leaves[0];
        }
        children.clear();
        children.resize(self.nodes.len(), Children::default());
        for (leaf, classification) in self.leaves.iter().zip(&*leaves) {
            let place = leaf.parent.node as usize;
            children[place].add(&self.nodes[place], leaf.parent, classification.value());
        }
        // Children stand behind their parents.
        for place in (1..self.nodes.len()).rev() {
            let (parent, value) = (self.nodes[place].parent, children[place].value(&self.nodes[place]));
            let above = parent.node as usize;
            children[above].add(&self.nodes[above], parent, value);
        }
        match children[0].value(&self.nodes[0]) {
            Some(true) => return Classification::Inside,
            Some(false) => return Classification::Outside,
            None => {}
        }
        parents.clear();
        for (node, children) in self.nodes.iter().zip(&*children) {
            let above = if node.parent.node == Link::ROOT {
                Some(node.parent)
            } else {
                parents[node.parent.node as usize].map(|above| above.over(node.parent))
            };
            let parent = above.filter(|_| children.value(node).is_none());
            parents.push(match parent {
                Some(parent) if !children.is_its_child() => {
                    let threshold = if node.threshold == 1 { 1 } else { children.open };
                    remains.nodes.push(Node { parent, threshold, initial: 0 });
                    Some(Link { node: remains.nodes.len() as u32 - 1, negated: false })
                }
                parent => parent,
            });
        }
        for (leaf, classification) in self.leaves.iter().zip(&*leaves) {
            if *classification == Classification::Mixed
                && let Some(above) = parents[leaf.parent.node as usize]
            {
                remains.leaves.push(Leaf { primitive: leaf.primitive, parent: above.over(leaf.parent) });
            }
        }
        Classification::Mixed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::expression::{CsgTree, Operand};

    fn child(tree: CsgTree, negated: bool) -> Operand {
        Operand { tree, negated }
    }

    #[test]
    fn an_operator_of_one_child_that_is_left_is_that_child() {
        // (0 or 1) and not (2 or (3 and 4)).
        let inner = CsgTree::All(vec![child(CsgTree::Leaf(3), false), child(CsgTree::Leaf(4), false)]);
        let cut = CsgTree::Any(vec![child(CsgTree::Leaf(2), false), child(inner, false)]);
        let kept = CsgTree::Any(vec![child(CsgTree::Leaf(0), false), child(CsgTree::Leaf(1), false)]);
        let whole = Expression::new(&CsgTree::All(vec![child(kept, false), child(cut, true)]));
        let is_left = |open: [bool; 5], value: [bool; 5]| {
            let balls: Vec<_> = (0..5).map(|i| ball(open[i], value[i])).collect();
            let mut remains = PrunedExpr::default();
            let b = Bounds::new(crate::math::DVec3::splat(-1.0), crate::math::DVec3::splat(1.0));
            let found = ExprView::from(&whole).pruned(&balls, &b, &mut Pruning::default(), &mut remains);
            (found, Expression::from(&remains))
        };
        let (yes, no) = (true, false);
        let (found, left) = is_left([yes, no, no, no, no], [no; 5]);
        assert_eq!((found, left), (Classification::Mixed, Expression::new(&CsgTree::Leaf(0))));
        // Not 3: an operator is kept for a child that is negated.
        let (found, left) = is_left([no, no, no, yes, no], [no, yes, no, no, yes]);
        let not_3 = Expression::new(&CsgTree::All(vec![child(CsgTree::Leaf(3), true)]));
        assert_eq!((found, left), (Classification::Mixed, not_3));
        let (found, _) = is_left([yes, yes, no, yes, yes], [no, no, yes, no, no]);
        assert_eq!(found, Classification::Outside);
        let (found, _) = is_left([yes, no, no, yes, no], [no, yes, no, no, no]);
        assert_eq!(found, Classification::Inside);
    }

    /// A ball that a box of −1..1 lies across, within, or beside.
    fn ball(is_open: bool, is_inside: bool) -> WorldPrimitive {
        use crate::math::DVec3;
        use crate::scene::MaterialId;
        use crate::solid::{Ball, WorldShape};
        let radius = if is_open {
            1.0
        } else if is_inside {
            9.0
        } else {
            0.5
        };
        let center = if is_open || is_inside { DVec3::ZERO } else { DVec3::splat(5.0) };
        let form = WorldShape::Ball(Ball::new(center, radius, DVec3::ZERO));
        WorldPrimitive { form, material: MaterialId(0) }
    }
}

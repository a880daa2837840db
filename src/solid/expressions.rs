//! Many small expressions, laid out one behind the other: those of the cells of an object.

use super::expression::{Leaf, Node, count_initial};
use super::prune::ExprView;

/// Many expressions.
#[derive(Clone, Debug, Default)]
pub struct Expressions {
    leaves: Vec<Leaf>,
    nodes: Vec<Node>,
    /// By expression: behind its last leaf, and behind its last operator.
    ends: Vec<End>,
}

/// Where an expression ends.
#[derive(Clone, Copy, Debug, Default)]
struct End {
    leaf: u32,
    node: u32,
}

impl Expressions {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Primitives that they name, all together.
    pub fn leaves(&self) -> usize {
        self.leaves.len()
    }

    /// Adds one to the end.
    pub fn push(&mut self, expression: ExprView) {
        let first = self.nodes.len();
        self.leaves.extend_from_slice(expression.leaves);
        self.nodes.extend(expression.nodes.iter().map(|node| Node { initial: 0, ..*node }));
        count_initial(expression.leaves, &mut self.nodes[first..]);
        self.ends.push(End { leaf: self.leaves.len() as u32, node: self.nodes.len() as u32 });
    }

    /// Adds all of another list to the end.
    pub fn append(&mut self, other: &Self) {
        let End { leaf, node } = self.ends.last().copied().unwrap_or_default();
        self.leaves.extend_from_slice(&other.leaves);
        self.nodes.extend_from_slice(&other.nodes);
        self.ends.extend(other.ends.iter().map(|end| End { leaf: leaf + end.leaf, node: node + end.node }));
    }

    /// One of them, by its number.
    #[inline]
    pub fn get(&self, number: usize) -> ExprView<'_> {
        let start = number.checked_sub(1).map_or(End::default(), |before| self.ends[before]);
        let end = self.ends[number];
        ExprView {
            leaves: &self.leaves[start.leaf as usize..end.leaf as usize],
            nodes: &self.nodes[start.node as usize..end.node as usize],
        }
    }
}

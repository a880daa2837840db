//! The value of an expression at a place on a ray, kept up to date crossing by crossing.

use super::expression::Link;
use super::prune::ExprView;

/// Which primitives a place is inside, and which operators are true there. Memory that is used again for
/// every ray.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// By leaf.
    inside: Vec<bool>,
    /// By operator: how many of its children, each negated or not, are true.
    counts: Vec<u32>,
    /// By leaf and by operator: whether its value differs from the one at the last [`State::settle`].
    flipped: Vec<bool>,
    changed: Vec<bool>,
    /// The leaves and operators to be looked at by the next [`State::settle`].
    leaves: Vec<u32>,
    nodes: Vec<u32>,
}

impl State {
    /// Goes to where no primitive is.
    pub fn start(&mut self, expression: ExprView) {
        fn all_false(list: &mut Vec<bool>, length: usize) {
            list.clear();
            list.resize(length, false);
        }
        all_false(&mut self.inside, expression.leaves.len());
        all_false(&mut self.flipped, expression.leaves.len());
        all_false(&mut self.changed, expression.nodes.len());
        self.leaves.clear();
        self.nodes.clear();
        self.counts.clear();
        self.counts.extend(expression.nodes.iter().map(|node| node.initial));
    }

    /// Whether the place is inside the expression.
    #[inline]
    pub fn value(&self, expression: ExprView) -> bool {
        // An expression without operators is one primitive.
        expression.nodes.first().map_or_else(|| self.inside[0], |root| self.counts[0] >= root.threshold)
    }

    /// Crosses the surface of a leaf.
    #[inline]
    pub fn toggle(&mut self, expression: ExprView, leaf: u32) {
        let mut now = !self.inside[leaf as usize];
        self.inside[leaf as usize] = now;
        self.flipped[leaf as usize] ^= true;
        self.leaves.push(leaf);
        let mut link = expression.leaves[leaf as usize].parent;
        while link.node != Link::ROOT {
            let node = &expression.nodes[link.node as usize];
            let count = &mut self.counts[link.node as usize];
            let before = *count >= node.threshold;
            if now == link.negated {
                *count -= 1;
            } else {
                *count += 1;
            }
            let after = *count >= node.threshold;
            if before == after {
                return;
            }
            self.changed[link.node as usize] ^= true;
            self.nodes.push(link.node);
            now = after;
            link = node.parent;
        }
    }

    /// Whether a leaf is a reason of the root's change since the last [`State::settle`]: it and every
    /// operator above it must have changed, each in the direction in which its child pushed.
    pub fn decides(&self, expression: ExprView, leaf: u32) -> bool {
        if !self.flipped[leaf as usize] {
            return false;
        }
        let (mut link, mut now) = (expression.leaves[leaf as usize].parent, self.inside[leaf as usize]);
        while link.node != Link::ROOT {
            let node = &expression.nodes[link.node as usize];
            let after = self.counts[link.node as usize] >= node.threshold;
            if !self.changed[link.node as usize] || after != (now != link.negated) {
                return false;
            }
            now = after;
            link = node.parent;
        }
        true
    }

    /// What changed up to here is past.
    #[inline]
    pub fn settle(&mut self) {
        for leaf in self.leaves.drain(..) {
            self.flipped[leaf as usize] = false;
        }
        for node in self.nodes.drain(..) {
            self.changed[node as usize] = false;
        }
    }
}

//! What the operators of an expression come to for a packet of rays, a bit for each: an operator is one
//! operation on a word for all of them.

use super::expression::Link;
use super::prune::ExprView;

/// The value of each operator, a bit for each ray.
#[inline(always)]
pub(super) fn evaluate(expression: ExprView, inside: &[u64], values: &mut Vec<u64>) {
    values.clear();
    // More than one child is asked for where all are.
    values.extend(expression.nodes.iter().map(|node| if node.threshold == 1 { 0 } else { u64::MAX }));
    let put = |values: &mut Vec<u64>, link: Link, value: u64| {
        let value = if link.negated { !value } else { value };
        let above = &mut values[link.node as usize];
        if expression.nodes[link.node as usize].threshold == 1 {
            *above |= value;
        } else {
            *above &= value;
        }
    };
    for (leaf, &value) in expression.leaves.iter().zip(inside) {
        if leaf.parent.node != Link::ROOT {
            put(values, leaf.parent, value);
        }
    }
    for place in (1..expression.nodes.len()).rev() {
        put(values, expression.nodes[place].parent, values[place]);
    }
}

/// The rays for which a leaf is a reason of the change: it and every operator above it have changed, each in
/// the direction in which its child pushed.
#[inline(always)]
pub(super) fn decides(
    expression: ExprView,
    leaf: usize,
    inside: &[u64],
    flipped: &[u64],
    before: &[u64],
    behind: &[u64],
) -> u64 {
    let (mut rays, mut now) = (flipped[leaf], inside[leaf]);
    let mut link = expression.leaves[leaf].parent;
    while link.node != Link::ROOT && rays != 0 {
        let place = link.node as usize;
        let pushed = if link.negated { !now } else { now };
        rays &= (before[place] ^ behind[place]) & !(behind[place] ^ pushed);
        now = behind[place];
        link = expression.nodes[place].parent;
    }
    rays
}

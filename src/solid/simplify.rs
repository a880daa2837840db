//! An expression without what changes nothing: operators within operators that are one, and solids that are
//! there twice.
//!
//! What is cut from a cut is cut from the whole: `(a − b) − c` is `a − b − c`, and so is `a − (b ∪ c)`. The
//! same primitive makes the same crossings, which are one place and toggle together, and the first in the
//! file shows: of two the second decides nothing.

use std::collections::HashMap;

use super::expression::{CsgTree, Operand};
use super::primitive::WorldPrimitive;

/// The operands that are leaves: by whether they are negated and the corners of their boxes, bit by bit.
type Seen = HashMap<(bool, [u64; 6]), Vec<u32>>;

impl CsgTree {
    /// The same solid, whose every point is decided by the same primitives.
    #[must_use]
    pub fn simplified(&self, primitives: &[WorldPrimitive]) -> Self {
        self.fold_up(Self::Leaf, |tree, own| match tree {
            Self::Leaf(index) => Self::Leaf(*index),
            Self::Any(children) => operator(Kind::Any, joined(Kind::Any, children, own, primitives)),
            Self::All(children) => operator(Kind::All, joined(Kind::All, children, own, primitives)),
        })
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Any,
    All,
}

/// Operands under an operator, which is nothing but the operand where that is one.
fn operator(kind: Kind, mut operands: Vec<Operand>) -> CsgTree {
    match (&operands[..], kind) {
        ([Operand { negated: false, .. }], _) => operands.remove(0).tree,
        (_, Kind::Any) => CsgTree::Any(operands),
        (_, Kind::All) => CsgTree::All(operands),
    }
}

/// The operands of an operator, given what became of each: those of operands that are the same operator in
/// its place.
fn joined(
    kind: Kind,
    children: &[Operand],
    own: impl Iterator<Item = CsgTree>,
    primitives: &[WorldPrimitive],
) -> Vec<Operand> {
    let mut operands = Vec::with_capacity(children.len());
    let mut seen = Seen::new();
    let mut add = |operand: Operand| {
        if !is_repeated(&operand, &mut seen, primitives) {
            operands.push(operand);
        }
    };
    for (Operand { negated, .. }, tree) in children.iter().zip(own) {
        match (kind, negated, tree) {
            // By de Morgan a negated one is the other operator over what is negated.
            (Kind::Any, false, CsgTree::Any(inner))
            | (Kind::Any, true, CsgTree::All(inner))
            | (Kind::All, false, CsgTree::All(inner))
            | (Kind::All, true, CsgTree::Any(inner)) => {
                for Operand { tree, negated: own } in inner {
                    add(Operand { tree, negated: own != *negated });
                }
            }
            (_, _, tree) => add(Operand { tree, negated: *negated }),
        }
    }
    operands
}

/// Whether an operand is a primitive that was seen before under the same operator; it is now.
fn is_repeated(operand: &Operand, seen: &mut Seen, primitives: &[WorldPrimitive]) -> bool {
    let CsgTree::Leaf(index) = operand.tree else { return false };
    let form = &primitives[index as usize].form;
    let b = form.bounds();
    let corners = [b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z].map(f64::to_bits);
    let alike = seen.entry((operand.negated, corners)).or_default();
    let repeated = alike.iter().any(|&other| primitives[other as usize].form == *form);
    if !repeated {
        alike.push(index);
    }
    repeated
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DVec3;
    use crate::scene::MaterialId;
    use crate::solid::{Ball, WorldShape};

    fn child(tree: CsgTree, negated: bool) -> Operand {
        Operand { tree, negated }
    }

    /// Balls along a line; numbers 3 and 1 are the same.
    fn balls() -> Vec<WorldPrimitive> {
        let ball = |x: f64| WorldPrimitive {
            form: WorldShape::Ball(Ball::new(DVec3::X * x, 0.25, DVec3::ZERO)),
            material: MaterialId(0),
        };
        [0.0, 1.0, 2.0, 1.0, 3.0].map(ball).to_vec()
    }

    #[test]
    fn cuts_of_cuts_are_cuts_of_the_whole() {
        // (0 − 1) − (2 ∪ 4)
        let inner = CsgTree::All(vec![child(CsgTree::Leaf(0), false), child(CsgTree::Leaf(1), true)]);
        let cuts = CsgTree::Any(vec![child(CsgTree::Leaf(2), false), child(CsgTree::Leaf(4), false)]);
        let tree = CsgTree::All(vec![child(inner, false), child(cuts, true)]);
        let operands = [(0, false), (1, true), (2, true), (4, true)];
        let flat = operands.map(|(leaf, negated)| child(CsgTree::Leaf(leaf), negated)).to_vec();
        assert_eq!(tree.simplified(&balls()), CsgTree::All(flat));
    }

    #[test]
    fn what_is_cut_from_a_cut_stays() {
        // 0 − (1 − 2)
        let inner = CsgTree::All(vec![child(CsgTree::Leaf(1), false), child(CsgTree::Leaf(2), true)]);
        let tree = CsgTree::All(vec![child(CsgTree::Leaf(0), false), child(inner, true)]);
        assert_eq!(tree.simplified(&balls()), tree);
    }

    // A sponge as people write it has each bar up to twenty times.
    #[test]
    fn the_first_of_equal_primitives_is_kept() {
        let twice = CsgTree::Any([1, 2, 3].map(|leaf| child(CsgTree::Leaf(leaf), false)).to_vec());
        let once = CsgTree::Any([1, 2].map(|leaf| child(CsgTree::Leaf(leaf), false)).to_vec());
        assert_eq!(twice.simplified(&balls()), once);
        // Not where one is taken away and the other is not.
        let nothing = CsgTree::All(vec![child(CsgTree::Leaf(1), false), child(CsgTree::Leaf(3), true)]);
        assert_eq!(nothing.simplified(&balls()), nothing);
        let same = CsgTree::All([1, 3].map(|leaf| child(CsgTree::Leaf(leaf), false)).to_vec());
        assert_eq!(same.simplified(&balls()), CsgTree::Leaf(1));
    }
}

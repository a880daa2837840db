//! What is made of the children of a call.

use crate::math::{DAffine3, DVec3};
use crate::scene::language::vocabulary::OperatorWord;
use crate::scene::profile::{Join, LinearSweep, Revolution};

/// What is made of the children of a call.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    Operator(OperatorWord),
    Hull,
    Minkowski,
    Grown(f64, Join),
    Fill,
    Linear(LinearSweep, DAffine3),
    Turned(Revolution),
    Section,
    Shadow,
    Resize(DVec3, [bool; 3]),
}

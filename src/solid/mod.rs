//! Stages 7 and 8, SOLID and CSG: ray × primitive → interval, intervals × expression → hit, and an expression
//! pruned to a box.

mod across;
mod assembly;
mod ball;
mod crossing;
mod expression;
mod face;
mod facets;
mod inside;
mod mesh;
mod patch;
mod primitive;
mod round;
mod slabs;
mod span;
mod state;
mod surface;
mod taper;
#[cfg(test)]
mod tests;
mod tube;
mod unit_space;

pub use assembly::{Assembly, AssemblyError, Body, Datum, Object};
pub use crossing::{Crossing, Reach, Scratch, first_of_expression, first_of_span};
pub use expression::{Child, Expression, Leaf, Pruned, Tree};
pub use primitive::{Cover, Form, Primitive};
pub use span::{Departure, End, LIMIT, ROUNDING, Span, WORLD};
pub use surface::first_of_surface;

//! Stages 7 and 8, SOLID and CSG: ray × primitive → interval, intervals × expression → hit, and an expression
//! pruned to a box.

mod across;
mod alone;
mod assembly;
mod ball;
mod crossing;
mod crossings;
mod eight;
mod expression;
mod face;
mod facets;
mod hull;
mod inside;
mod known;
mod mesh;
mod patch;
mod primitive;
mod prune;
mod round;
mod sheared;
mod slabs;
mod span;
mod state;
mod surface;
mod surfaces;
mod taper;
#[cfg(test)]
mod tests;
mod tube;
mod unit_space;

pub use assembly::{Assembly, AssemblyError, Body, Datum, Kind, Makeup, Object};
pub use ball::Ball;
pub use crossing::{
    Crossing, Firsts, Reach, Scratch, Starts, first_of_expression, first_of_span, firsts_of_spans,
};
pub use crossings::{Asked, BundleScratch, Departures, Found, first_of_expressions};
pub use eight::Eight;
pub use expression::{Child, Expression, Leaf, Pruned, Tree};
pub(crate) use known::with_spans;
pub use primitive::{Cover, Form, Primitive};
pub use prune::{Flat, Left, Pruning, Remains};
pub use sheared::Sheared;
pub use span::{Departure, End, Ends, LIMIT, ROUNDING, Span, Spans, WORLD};
pub use surface::first_of_surface;
pub use surfaces::firsts_of_surface;
pub use tube::Bar;

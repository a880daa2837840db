//! Stages 7 and 8, SOLID and CSG: ray × primitive → interval, intervals × expression → hit, and an expression
//! pruned to a box.

mod alone;
mod assembly;
mod ball;
mod classification;
mod crossing;
mod crossings;
mod csg_query;
mod eight;
mod expression;
mod face;
mod facets;
mod hull;
mod inside;
mod mesh;
mod packet_shear;
mod patch;
mod primitive;
mod prune;
mod ray_shear;
mod round;
mod slabs;
mod span;
mod span_cache;
mod state;
mod surface;
mod surfaces;
mod taper;
#[cfg(test)]
mod tests;
mod tube;
mod unit_space;

pub use assembly::{Assembly, AssemblyError, AssemblyStats, Body, Kind, Object, SceneFrame};
pub use ball::Ball;
pub use classification::Classification;
pub use crossing::{
    Crossing, FirstCrossings, Scratch, Starts, TRange, first_of_expression, first_of_span, firsts_of_spans,
};
pub use crossings::{PacketScratch, first_of_expressions};
pub use csg_query::{CsgQuery, Departures, PacketCrossings};
pub use eight::Eight;
pub use expression::{Child, Expression, Leaf, Tree};
pub use packet_shear::PacketShear;
pub use primitive::{Primitive, WorldShape};
pub use prune::{ExprView, PrunedExpr, Pruning};
pub use span::{Departure, End, Ends, LIMIT, ROUNDING, Span, Spans, WORLD};
pub(crate) use span_cache::with_spans;
pub use surface::first_of_surface;
pub use surfaces::firsts_of_surface;
pub use tube::Bar;

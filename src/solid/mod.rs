//! Stages 7 and 8, SOLID and CSG: ray × primitive → interval, intervals × expression → hit, and an expression
//! pruned to a box.

mod assembly;
mod ball;
mod bezier;
mod bezier_cell;
mod bezier_edge;
mod bezier_packet;
mod bezier_piece;
mod bezier_shell;
mod bezier_steep;
mod classification;
mod crossing;
mod crossings;
mod csg_query;
mod expression;
mod expressions;
mod face;
mod facets;
mod hull;
mod inside;
mod mesh;
mod mesh_lists;
mod mesh_packet;
mod mesh_ray;
mod mesh_spans;
mod mesh_triangle;
mod operator_bits;
mod packet_shear;
mod patch;
mod primitive;
mod prune;
mod quadric;
mod ray_batch;
mod ray_shear;
mod self_crossings;
mod simplify;
mod single;
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

pub use assembly::{Assembly, AssemblyError, AssemblyStats, BatchKind, Body, SceneFrame, WorldObject};
pub use ball::Ball;
pub use bezier::BezierSurface;
pub use bezier_packet::{BezierPacket, BezierQuery};
pub use classification::Classification;
pub use crossing::{
    Crossing, FirstCrossings, RayStarts, Scratch, TRange, first_of_expression, first_of_span, firsts_of_spans,
};
pub use crossings::{PacketScratch, first_of_expressions};
pub use csg_query::{CsgQuery, Departures, PacketCrossings, PacketRange};
pub use expression::{CsgTree, Expression, Leaf, Operand};
pub use expressions::Expressions;
pub use mesh::TriangleMesh;
pub use mesh_lists::MeshLists;
pub use mesh_packet::{MeshAnswer, MeshPacket, MeshQuery};
pub use mesh_ray::{AheadQuery, FirstAhead};
pub use mesh_spans::MeshLearning;
pub use packet_shear::PacketShear;
pub use primitive::{WorldPrimitive, WorldShape};
pub use prune::{ExprView, PrunedExpr, Pruning};
pub use ray_batch::RayBatch;
pub use self_crossings::SelfCrossings;
pub use span::{Departure, End, Ends, LIMIT, ROUNDING, Span, Spans, WORLD};
pub(crate) use span_cache::with_spans;
pub use surface::first_of_surface;
pub use surfaces::{SurfaceQuery, firsts_of_surface};
pub use tube::Bar;

//! Vectors, rays, boxes and grids: the arithmetic that every stage shares. All of it is f64; powers and
//! trigonometry come from `libm`, so that every platform computes the same bits.

mod bounds;
mod dispatch;
mod exact;
mod f32x16;
mod grid;
mod ids;
mod number;
mod packet;
mod placement;
mod ray;
mod real;
mod rows;
mod vector;

pub use bounds::Bounds;
pub(crate) use dispatch::dispatch;
pub use exact::{product_rest, two_product_in_range, two_sum};
pub use glam::{DAffine2, DAffine3, DMat2, DMat3, DVec2, DVec3};
pub use grid::{Grid, Size};
pub use number::{LANES, Mask, Number, PACKET, Powers};
pub use packet::{LaneVector, Lanes, REGISTERS, RayIndex, RayPacket, lanes, mask_of, places};
pub use placement::{Placement, is_singular};
pub use ray::Ray;
pub use real::{Real, RealIds, RealMask, SimdIds, SimdReal, SimdRegister};
pub use rows::{ROW, ROWS, row_of, splats};
pub use vector::{Rays, Vector};

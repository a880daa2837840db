//! Vectors, rays, boxes and grids: the arithmetic that every stage shares. All of it is f64; powers and
//! trigonometry come from `libm`, so that every platform computes the same bits.

mod bounds;
mod bundle;
mod digits;
mod exact;
mod grid;
mod number;
mod placement;
mod ray;
mod single;
mod vector;

pub use bounds::Bounds;
pub use bundle::{BUNDLE, Bundle, Column, Columns, Place, ROWS, lanes, places, row_of};
pub use digits::{Answers, Digits, Row, Wide};
pub use exact::{product_rest, two_sum};
pub use glam::{DAffine3, DMat3, DVec2, DVec3};
pub use grid::{Grid, Size};
pub use number::{LANES, Mask, Number, Powers};
pub use placement::{Placement, is_singular};
pub use ray::Ray;
pub use vector::{Rays, Vector};

//! Stages 3 and 4, VIEW and RAY: camera, field, zoom and picture size in; rays, in tiles, out.

mod block;
mod direction;
mod edge_model;
mod framing;
mod pinhole;
mod point_packet;
mod sample_points;
mod tile;
mod tile_camera;
mod tile_share;
mod turntable;

pub use block::{BLOCK, Block};
pub use direction::{all_settled, settled};
pub use edge_model::{EdgeModel, Extent, FITTED, Share};
pub use framing::{framed, framed_from};
pub use pinhole::{Picture, PinholeCamera};
pub use point_packet::PointPacket;
pub use sample_points::{edge_error, missed_edge_error, sample_point};
pub use tile::{TILE, Tile, tiles};
pub use tile_camera::{TileCamera, TileRays};
pub use tile_share::{PLASTIC, TileShare};
pub use turntable::Turntable;

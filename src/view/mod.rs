//! Stages 3 and 4, VIEW and RAY: camera, field, zoom and picture size in; rays, in tiles, out.

mod block;
mod direction;
mod framing;
mod lens;
mod sight;
mod tile;

pub use block::{BLOCK, Block};
pub use direction::{all_settled, settled};
pub use framing::framed;
pub use lens::{Lens, Picture};
pub use sight::Sight;
pub use tile::{TILE, Tile, tiles};

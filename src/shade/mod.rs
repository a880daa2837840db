//! Stage 9, SHADE: the illumination equations (1) to (4) at a hit, and the rays that they ask for.

mod channel;
mod direction;
mod hits;
mod lamps;
mod lit;
mod media;
mod path;
mod power;
mod sends;
mod shadow;
mod surface;
mod surfaces;
mod tile;
mod wavefront;

pub use channel::{Channel, luminance};
pub use hits::TileHits;
pub use path::{Kind, PathSegment};
pub use surface::{Memory, PrimaryHit, Shader, View};
pub use tile::TileShading;

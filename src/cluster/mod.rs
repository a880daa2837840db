//! One picture from many machines: each draws a share of its tiles and writes them as a part; whoever has all
//! parts joins them. Whoever draws what, the bytes are those of one machine.

mod digest;
mod dots;
mod join;
mod part;
mod values;

pub use digest::PictureDigest;
pub use dots::DotChannels;
pub use join::{JoinError, Joining};
pub use part::{PartAbout, PartError, PicturePart};

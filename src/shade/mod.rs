//! Stage 9, SHADE: the illumination equations (1) to (3) at a hit.

mod channel;
mod surface;

pub use channel::{Channel, luminance};
pub use surface::{Seen, Shader, View};

//! Stage 9, SHADE: the illumination equations (1) to (4) at a surface: kernels, one formula for one ray and
//! for a packet.
//!
//! The rays that they need are traced by [`crate::integrate`].

mod channel;
mod direction;
mod illumination;
mod interaction;
mod lamp;
mod lit;
mod material;
mod media;
mod power;
mod scattered;
mod surfaces;

pub use channel::{Channel, luminance};
pub use interaction::PrimaryHit;

pub(crate) use illumination::Illumination;
pub(crate) use interaction::SurfaceInteraction;
pub(crate) use lamp::{Lamp, Towards};
pub(crate) use lit::{Lit, LitQuery, add_everywhere, before_lamps};
pub(crate) use material::{Reflected, ResolvedMaterial};
pub(crate) use media::{Interface, Media, Medium, MediumStack, MediumTransition, OUTSIDE};
pub(crate) use scattered::{Scattered, ScatteredRays};
pub(crate) use surfaces::Surfaces;

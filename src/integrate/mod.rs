//! Drives stages 5 to 9: rays from the eye become light, through their shadow rays and all generations of
//! mirror and Snell rays. [`crate::trace`] answers what rays meet, [`crate::shade`] what light that gives.
//!
//! A picture is lit tile by tile, through a [`TileIntegrator`]: a [`RayIntegrator`] follows one ray after the
//! other, a [`WavefrontIntegrator`] all rays of one generation side by side. Both give the same bits.

mod direct;
mod generations;
mod goal;
mod history;
mod path;
mod path_state;
mod primary;
mod ray_integrator;
mod ray_tiles;
mod scattering;
mod secondary;
mod segments;
mod surfaces_met;
mod tile_hits;
mod tile_integrator;
mod visibility;
mod wavefront;
mod wavefront_integrator;
mod wavefront_scratch;

pub use history::History;
pub use path::View;
pub use ray_integrator::{PathMemory, RayIntegrator};
pub use ray_tiles::RayTileMemory;
pub use segments::PathSegment;
pub use tile_hits::TileHits;
pub use tile_integrator::{TileIntegrator, TilePass};
pub use wavefront_integrator::WavefrontIntegrator;
pub use wavefront_scratch::{WavefrontMemory, WavefrontScratch};

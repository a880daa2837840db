//! Plane figures, what is made of them, and the facets that stand for curved solids where something is made
//! of their corners: `docs/decisions/28-plane-figures.md` says what is exact and what is not.

mod arcs;
mod carved;
mod clip;
mod convex_hull;
mod faceted;
mod figure;
mod of_mesh;
mod orientation;
mod section;
mod sums;
mod sweep;
mod work;

pub use arcs::{Fragments, MOST_CORNERS, corners};
pub use carved::{NotCarved, united_meshes};
pub use clip::{Join, LineEnd, combined, filled, grown, stroked, wound};
pub use convex_hull::{hull_of_figures, hull_of_solid};
pub use faceted::faceted;
pub use figure::{Figure, FigureOperator, Region};
pub use of_mesh::of_mesh;
pub use section::{section, shadow};
pub use sums::{NoSum, sum_of_figures, sum_of_solids};
pub use sweep::{LinearSweep, NoRevolution, Revolution, prism};
pub use work::WorkLeft;

//! All stages in order: a request in, a finished frame out, with what each stage counted.

mod accuracy;
mod assemble;
mod coarse;
mod compare;
mod draw;
mod edges;
mod explain;
mod finished_tile;
mod followed;
mod frame_cache;
mod inventory;
mod nothing;
pub mod pcat;
mod prepare;
mod refine;
mod render;
mod request;
mod reuse;
mod sample;
mod scan;
mod scratch_pool;
mod small;
mod studio;
mod workers;

pub use compare::{Comparison, OtherDots};
pub use followed::{DrawnSpace, FollowedRay};
pub use inventory::{Inventory, SeenObject, UnseenObject};
pub use nothing::NothingInView;
pub use request::{Frame, MOST_DOTS, Request, Space, Wants};
pub use studio::{Built, Studio};

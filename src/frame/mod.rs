//! All stages in order: a request in, a finished frame out, with what each stage counted.

mod blocks;
mod compare;
mod draw;
mod explain;
mod frame_cache;
mod gather;
mod nothing;
pub mod pcat;
mod points;
mod request;
mod sample;
mod scratch_pool;
mod studio;

pub use compare::{Comparison, OtherDots};
pub use nothing::NothingInView;
pub use request::{Frame, Request, Space, Wants};
pub use studio::{Built, Studio};

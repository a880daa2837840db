//! All stages in order: a request in, a finished frame out, with what each stage counted.

mod blocks;
mod draw;
mod explain;
mod gather;
mod kept;
mod nothing;
pub mod pcat;
mod points;
mod request;
mod spare;
mod studio;

pub use nothing::NothingInView;
pub use request::{Frame, Request, Space, Wants};
pub use studio::{Built, Studio};

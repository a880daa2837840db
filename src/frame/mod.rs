//! All stages in order: a request in, a finished frame out, with what each stage counted.

mod draw;
mod explain;
pub mod pcat;
mod request;
mod studio;

pub use request::{Frame, Request, Space};
pub use studio::{Built, Studio};

//! Equation (4): mirror and Snell rays, the media they go through, and the light that comes through glass.

mod bound;
mod glass;
mod light;
mod paths;
#[path = "../request/mod.rs"]
mod request;
mod sending;

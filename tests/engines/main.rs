//! The fast engine against the exact one: every dot of every picture has the same bits, on every processor; and with half the
//! digits what is met is the same.

#[path = "../anything/mod.rs"]
mod anything;
mod glass;
mod lamps;
mod random;
mod range;
#[path = "../request/mod.rs"]
mod request;
mod same;
#[path = "../scenery/mod.rs"]
mod scenery;
mod scenes;
mod singles;
mod widths;

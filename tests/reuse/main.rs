//! What a request shares with the picture before it is not computed again, and the pictures are the same as without.

mod hits;
mod pictures;
#[path = "../request/mod.rs"]
mod request;
#[expect(dead_code, reason = "pictures are only compared here, by one engine")]
#[path = "../engines/same.rs"]
mod same;
#[path = "../scenery/mod.rs"]
mod scenery;
mod scenes;

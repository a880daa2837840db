//! What a request shares with the picture before it is not computed again, and the pictures are the same as
//! without.

mod support {
    pub mod agreement;
    pub mod request;
    pub mod scenery;
}

mod reuse {
    mod hits;
    mod pictures;
    mod scenes;
}

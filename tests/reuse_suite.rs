//! What a request shares with the picture before it is not computed again, and the pictures are the same as
//! without.

mod support {
    pub mod request;
    #[expect(dead_code, reason = "pictures are only compared here, by one engine")]
    pub mod same;
    pub mod scenery;
}

mod reuse {
    mod hits;
    mod pictures;
    mod scenes;
}

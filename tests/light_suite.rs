//! The light of a picture: the paper's formulas, and equation (4)'s mirror and Snell rays, the media they go
//! through, and what comes through glass.

mod support {
    pub mod picture;
    pub mod rays;
    pub mod request;
}

mod light {
    mod adaptive;
    mod bound;
    mod errata;
    mod glass;
    mod paths;
    mod sending;
    mod through_glass;
}

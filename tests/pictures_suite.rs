//! Pictures as text that a person can look at and compare.

mod support {
    pub mod request;
    pub mod scenery;
}

mod pictures {
    mod embedded;
    mod pcat;
}

//! Pictures as text that a person can look at and compare.

mod support {
    pub mod request;
    pub mod scenery;
    pub mod seen;
}

mod pictures {
    mod bytes;
    mod embedded;
    mod pcat;
    mod read_back;
}

//! What rays meet, against a calculation that shares no code with the tracer: no dot may be hit by one and
//! missed by the other, and depths agree to nine digits.

mod support {
    pub mod anything;
    pub mod beside;
    pub mod cases;
    pub mod nasty_meshes;
    pub mod oracle;
    pub mod oracle_agreement;
    pub mod rays;
    pub mod request;
    pub mod scenery;
}

mod oracle {
    mod examples;
    mod meshes;
    mod random_solids;
    mod random_surfaces;
}

#[test]
fn zz_what_was_skipped_is_said() {
    support::beside::say_what_was_skipped("oracle");
}

//! One answer, whatever computes it: the fast engine and the exact one find the same bits in every dot, on
//! every processor, through every structure, on any number of threads; in single precision what is met is the
//! same.

mod support {
    pub mod agreement;
    pub mod anything;
    pub mod beside;
    pub mod cases;
    pub mod nasty_meshes;
    pub mod request;
    pub mod same;
    pub mod scenery;
}

mod engines {
    mod events;
    mod follow;
    mod glass;
    mod lamps;
    mod large_csg;
    mod meshes;
    mod random;
    mod range;
    mod scenes;
    mod singles;
    mod structures;
    mod threads;
    mod widths;
}

#[test]
fn zz_what_was_skipped_is_said() {
    support::beside::say_what_was_skipped("engines");
}

//! Files as programs and people write them: what they hold, what is wrong with them, and what they cost.

mod support {
    pub mod agreement;
    pub mod around;
    pub mod beside;
    pub mod cases;
    pub mod drawings;
    pub mod mesh_files;
    pub mod openscad;
    pub mod oracle;
    pub mod rays;
    pub mod request;
    pub mod scribble;
    pub mod sound;
}

mod formats {
    mod any_text;
    mod drawings;
    mod hostile;
    mod hostile_drawings;
    mod imports;
    mod leaves;
    mod memory;
    mod meshes;
    mod nff;
    mod openscad_examples;
    mod openscad_facets;
    mod openscad_letters;
    mod six_digits;
    mod spd;
    mod surfaces;
}

#[test]
fn zz_what_was_skipped_is_said() {
    support::beside::say_what_was_skipped("formats");
}

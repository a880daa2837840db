//! How a scene is written, and how it is to be read.

use std::path::Path;

use crate::stage::Progress;

/// How a scene is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// The scene language, and OpenSCAD's `.csg`, which is a part of it.
    Language,
    /// Eric Haines's Neutral File Format.
    Nff,
}

impl Format {
    /// The format of a file by the end of its name. A name that says nothing means the scene language.
    pub fn of(name: &str) -> Self {
        let extension = Path::new(name).extension();
        if extension.is_some_and(|e| e.eq_ignore_ascii_case("nff")) { Self::Nff } else { Self::Language }
    }

    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Language => "the scene language",
            Self::Nff => "NFF",
        }
    }
}

/// How to read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// Leave out what OpenSCAD can show and ray13 can not, with a note, where it would be an error.
    pub skip_unsupported: bool,
    /// The format, where neither name nor content are to decide.
    pub format: Option<Format>,
    /// Where to write how far the reading is, for who watches.
    pub progress: Option<Progress>,
    /// Bytes of memory that the scene, and what will show it, may take; as many as there are where it is not
    /// given.
    pub memory: Option<u64>,
}

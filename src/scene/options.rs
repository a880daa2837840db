//! How a scene is written, and how it is to be read.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::lettering::KnownFonts;
use crate::math::DVec3;
use crate::stage::Progress;

/// The largest file that is read: 256 MiB.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// How a scene is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// The scene language, and OpenSCAD's `.csg`, which is a part of it.
    Language,
    /// Eric Haines's Neutral File Format.
    Nff,
    /// STL, binary or text.
    Stl,
    /// OFF, Geomview's.
    Off,
    /// PLY, Stanford's, binary or text.
    Ply,
    /// OBJ, Wavefront's.
    Obj,
    /// 3MF, of the 3MF Consortium: XML in a ZIP archive.
    ThreeMf,
    /// AMF, the Additive Manufacturing File Format, of ISO and ASTM.
    Amf,
}

/// The formats that names tell.
const ENDINGS: [(&str, Format); 7] = [
    ("nff", Format::Nff),
    ("stl", Format::Stl),
    ("off", Format::Off),
    ("ply", Format::Ply),
    ("obj", Format::Obj),
    ("3mf", Format::ThreeMf),
    ("amf", Format::Amf),
];

impl Format {
    /// The format of a file by the end of its name. A name that says nothing means the scene language.
    pub fn of(name: &str) -> Self {
        let extension = Path::new(name).extension();
        let named = |&(ending, _): &(&str, Self)| extension.is_some_and(|e| e.eq_ignore_ascii_case(ending));
        ENDINGS.iter().find(|ending| named(ending)).map_or(Self::Language, |&(_, format)| format)
    }

    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Language => "the scene language",
            Self::Nff => "NFF",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::ThreeMf => "3MF",
            Self::Amf => "AMF",
        }
    }
}

/// The axis of a mesh file that is up in the scene, where z is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// The second: the file is turned by 90 degrees around x.
    Y,
    /// The third.
    Z,
}

impl UpAxis {
    /// A place of the file in the scene.
    pub fn turned(self, place: DVec3) -> DVec3 {
        match self {
            // 0 − z and not −z: there is no −0 among places.
            Self::Y => DVec3::new(place.x, 0.0 - place.z, place.y),
            Self::Z => place,
        }
    }

    /// A place of the scene in the file.
    pub fn turned_back(self, place: DVec3) -> DVec3 {
        match self {
            Self::Y => DVec3::new(place.x, place.z, 0.0 - place.y),
            Self::Z => place,
        }
    }
}

/// How the curved things of OpenSCAD's words are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FacetMode {
    /// Round, but for `$fn` from 3 to 12.
    #[default]
    Smooth,
    /// Of the very facets that OpenSCAD cuts them into, by `$fn`, `$fa` and `$fs`.
    OpenScad,
}

impl FacetMode {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Smooth => "smooth",
            Self::OpenScad => "openscad",
        }
    }
}

/// What the digits of a number say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// The number.
    Exact,
    /// The number to half a unit of its sixth digit: faces that may be one plane by that are.
    Six,
}

impl Digits {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Six => "six",
        }
    }
}

/// The files that a scene is read from, as far as they are known: for who waits for changes of them. Those
/// that could not be read are among them.
#[derive(Clone, Debug, Default)]
pub struct FilesRead(Arc<Mutex<BTreeSet<PathBuf>>>);

impl FilesRead {
    /// Takes a file.
    pub fn add(&self, file: &Path) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(file.to_owned());
    }

    /// All so far, in the order of their names.
    pub fn all(&self) -> Vec<PathBuf> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
    }
}

/// Lists are the same where files that are added to the one are in the other.
impl PartialEq for FilesRead {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for FilesRead {}

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
    /// The axis of a mesh that is up, where it is not the one usual in its format.
    pub up: Option<UpAxis>,
    /// How curved things of the scene language are made.
    pub facets: FacetMode,
    /// What digits say in the scene language. Where it is not given, those of `.csg`, and of a text
    /// without an ending that is plainly OpenSCAD's, are six, as that program prints; all others exact.
    pub digits: Option<Digits>,
    /// Where the files are that a scene or a mesh names; [`read_file`](super::read_file) takes the folder of
    /// its own.
    pub folder: Option<PathBuf>,
    /// A folder, besides that one, of which a scene may name files, at any depth.
    pub root: Option<PathBuf>,
    /// The fonts of the machine, where scenes are read one after the other.
    pub fonts: KnownFonts,
    /// Where to note the files that the scene is read from.
    pub files: Option<FilesRead>,
}

//! What is wrong with a mesh file, and where.

use std::ops::Range;

use crate::scene::xml::{XmlError, XmlFault};
use crate::scene::{Diagnostic, Diagnostics};

/// Why a mesh file gave no mesh: the first mistake in it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshError {
    /// Where it is.
    pub place: MeshPlace,
    /// What it is.
    pub fault: MeshFault,
}

/// A place in a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshPlace {
    /// The whole file.
    Whole,
    /// Bytes of a text.
    Text(Range<usize>),
    /// A line of a file within the file.
    Within {
        /// Its name.
        part: String,
        /// The line, from 1.
        line: usize,
    },
    /// A byte of a binary file, counted from 0, and what it is a part of, as in `triangle 3`.
    Byte {
        /// The offset.
        offset: usize,
        /// What is there.
        part: String,
    },
}

/// What can be wrong with a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshFault {
    /// There is nothing to see.
    #[error("the mesh has no triangles: there is nothing to see in it")]
    Empty,
    /// All faces are lines and points.
    #[error("no face of the mesh has an area: there is nothing to see in it")]
    Flat,
    /// The file is not as long as it says.
    #[error("the file is cut off: it ends where {0} should be")]
    CutOff(String),
    /// A binary STL file is too short for its triangles.
    #[error("the file is cut off: it says that it has {announced} triangles, and has room for {room}")]
    TooShort {
        /// The count in the file.
        announced: u32,
        /// So many fit.
        room: usize,
    },
    /// A word is something else.
    #[error("{0} is expected here")]
    Unexpected(String),
    /// A number that is none.
    #[error("{0} is no number")]
    NoNumber(String),
    /// A number that is no place.
    #[error("{0} is not a finite number")]
    NotFinite(String),
    /// A face has fewer than three corners.
    #[error("a face has {0} corners, and needs three or more")]
    FewCorners(usize),
    /// A face names a corner that there is not.
    #[error("a face names corner {index}, which there is not: {known}")]
    NoCorner {
        /// The number in the file.
        index: i64,
        /// Which there are.
        known: String,
    },
    /// More corners than can be numbered.
    #[error("the mesh has more corners or faces than can be numbered")]
    TooMany,
    /// The format has it, the reader does not.
    #[error("{0}, which ray13 does not read")]
    Unsupported(String),
    /// An archive does not have a file that it should.
    #[error("the archive has no `{0}`")]
    NoEntry(String),
    /// A part of an archive is more than may be read.
    #[error("`{what}` in the archive takes more than {room} bytes, which is all that may be read of it")]
    TooLarge {
        /// Its name.
        what: String,
        /// Bytes that there may be.
        room: u64,
    },
    /// A part of an archive is not what its sum says.
    #[error("`{0}` in the archive is damaged")]
    Damaged(String),
    /// A text is no XML, or not as that of a model is.
    #[error(transparent)]
    Xml(#[from] XmlFault),
    /// An object that is named is not there.
    #[error("an object `{0}` is named, which there is not")]
    NoObject(String),
    /// What a file stands for takes this many bytes, which there are not.
    #[error("it takes about {0} bytes of memory")]
    NoRoom(u64),
    /// A mesh that is wanted as a solid has an edge that nothing meets.
    #[error("the mesh is not closed: nothing meets its edge from {from} to {to}")]
    Open {
        /// An end, as the file has it.
        from: String,
        /// The other.
        to: String,
    },
    /// A mesh that is wanted as a solid is closed, and nothing lies inside.
    #[error("the mesh encloses nothing: its faces lie on each other")]
    Hollow,
    /// Coordinates too large.
    #[error("the mesh reaches farther than {:e} from the origin", crate::scene::REACH)]
    TooFar,
}

impl MeshFault {
    /// The error of this fault in a text.
    pub fn at(self, span: Range<usize>) -> MeshError {
        MeshError { place: MeshPlace::Text(span), fault: self }
    }

    /// The error of this fault in a binary file.
    pub fn at_byte(self, offset: usize, part: impl Into<String>) -> MeshError {
        MeshError { place: MeshPlace::Byte { offset, part: part.into() }, fault: self }
    }

    /// The error of this fault in the file as a whole.
    pub fn of_all(self) -> MeshError {
        MeshError { place: MeshPlace::Whole, fault: self }
    }
}

impl From<XmlError> for MeshError {
    fn from(XmlError { place, fault }: XmlError) -> Self {
        Self { place: place.map_or(MeshPlace::Whole, MeshPlace::Text), fault: MeshFault::Xml(fault) }
    }
}

impl MeshError {
    /// The error of a text as that of the archive that has it, in a file of this name.
    pub fn within(self, part: &str, text: &[u8]) -> Self {
        match self.place {
            MeshPlace::Text(span) => {
                let place = MeshPlace::Within { part: part.to_owned(), line: line(text, span.start) };
                Self { place, ..self }
            }
            _ => self,
        }
    }

    /// The error in one sentence, with its place, for who speaks of several files.
    pub fn sentence(&self, bytes: &[u8]) -> String {
        match &self.place {
            MeshPlace::Whole => self.fault.to_string(),
            MeshPlace::Byte { offset, part } => format!("{part}, at byte {offset}: {}", self.fault),
            MeshPlace::Within { part, line } => format!("{part}, line {line}: {}", self.fault),
            MeshPlace::Text(span) => format!("line {}: {}", line(bytes, span.start), self.fault),
        }
    }

    /// The error as a person is told it; `bytes` are the file's.
    pub fn told(self, name: &str, bytes: &[u8]) -> Diagnostics {
        let whole = |message| Diagnostics::whole(name, Diagnostic::error(0..0, message));
        match self.place {
            MeshPlace::Whole | MeshPlace::Byte { .. } | MeshPlace::Within { .. } => {
                whole(self.sentence(bytes))
            }
            MeshPlace::Text(ref span) => match std::str::from_utf8(bytes) {
                Ok(text) if !span.is_empty() => {
                    // What is missing at an end is told at the last byte, which may be within a character.
                    let start = (0..=span.start).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
                    let end =
                        (span.end..text.len()).find(|&at| text.is_char_boundary(at)).unwrap_or(text.len());
                    let error = Diagnostic::error(start..end, self.fault.to_string());
                    Diagnostics { source: text.into(), ..Diagnostics::whole(name, error) }
                }
                // A comment in another encoding is no reason not to read a mesh.
                _ => whole(self.sentence(bytes)),
            },
        }
    }
}

/// The line of a byte of a text, from 1.
fn line(text: &[u8], at: usize) -> usize {
    text[..at.min(text.len())].split(|&byte| byte == b'\n').count()
}

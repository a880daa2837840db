//! Stage 1, OBJECTS: bytes in, [`Scene`] out. Kind, place, size and surface of every solid.

mod bezier;
mod bounded;
mod content;
mod degrees;
mod diagnostic;
mod drawing;
mod embedded;
mod groups;
mod gzip;
mod heightmap;
mod language;
mod lettering;
mod memory;
mod mesh;
mod model;
mod named_files;
mod nff;
mod options;
mod outline;
mod profile;
mod read;
mod screen_colors;
mod triangles;
mod triangulation;
mod unit_vector;
mod xml;

pub use bezier::BezierPatches;
pub use diagnostic::{Diagnostic, Diagnostics, MAX_ERRORS, Severity};
pub use embedded::{EmbeddedScene, embedded};
pub use language::{nearest, reference};
pub use lettering::KnownFonts;
pub use mesh::MeshFacts;
pub use model::{
    Anchor, Camera, CameraError, Corner, Facets, FieldSpan, HalfSpace, Light, Material, MaterialId, Object,
    Primitive, REACH, Scene, Shape, Solid, World,
};
pub use options::{Digits, FacetMode, FilesRead, Format, MAX_FILE_BYTES, ReadOptions, UpAxis};
pub use read::{ReadError, read, read_file};
pub use triangles::Mesh;

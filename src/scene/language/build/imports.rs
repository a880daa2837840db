//! The files that `import` names, each read once.

use std::collections::HashMap;
use std::path::PathBuf;
use std::rc::Rc;

use crate::scene::ReadOptions;
use crate::scene::mesh::MeshSolids;
use crate::scene::named_files::NamedFiles;
use crate::scene::profile::Figure;

/// The files that a scene imports.
#[derive(Debug)]
pub struct Imports {
    pub files: NamedFiles,
    /// Those that were read, by their paths; of those that can not be, why. Each is read once, however often
    /// it is named.
    pub known: HashMap<PathBuf, Result<Rc<MeshSolids>, String>>,
    /// The same of drawings, by their paths and what is wanted of them.
    pub figures: HashMap<(PathBuf, String), Result<Rc<Figure>, String>>,
}

impl Imports {
    /// Those of a scene that is read with these options.
    pub fn new(options: &ReadOptions) -> Self {
        Self { files: NamedFiles::new(options), known: HashMap::new(), figures: HashMap::new() }
    }
}

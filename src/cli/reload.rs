//! A scene that is read again whenever a file of it changes.

use std::fs;
use std::path::PathBuf;
use std::time::SystemTime;

use crate::scene::{FilesRead, Scene};

use super::arguments::ReadingArguments;
use super::changes::{Changes, EndOfChanges};
use super::error::CliError;
use super::input::{self, Onlooker};
use super::openscad::OpenScadRun;

/// A scene's file, and all that it is made of.
pub struct WatchedScene {
    file: String,
    reading: ReadingArguments,
    onlooker: Onlooker,
    /// All files of readings so far, since one that fails may not have come to all of them.
    files: Vec<PathBuf>,
    changes: Changes,
}

/// Ends what another thread does with a watched scene.
#[derive(Clone)]
pub struct EndOfWatch {
    openscad: OpenScadRun,
    changes: EndOfChanges,
}

impl EndOfWatch {
    /// OpenSCAD is ended, and nothing is waited for from now on.
    pub fn end(&self) {
        self.changes.end();
        self.openscad.end();
    }
}

impl WatchedScene {
    /// The scene of a file; not one of standard input, which comes once, or of the program's own.
    pub fn new(file: &str, reading: &ReadingArguments, onlooker: Onlooker) -> Option<Self> {
        // A pipe is read once. What is not there may come.
        let is_file = fs::metadata(file).map_or_else(|_| !input::is_scene(file), |found| found.is_file());
        (file != "-" && is_file).then(|| Self {
            file: file.to_owned(),
            reading: reading.clone(),
            onlooker,
            files: vec![PathBuf::from(file)],
            changes: Changes::new(),
        })
    }

    /// What ends it.
    pub fn end(&self) -> EndOfWatch {
        EndOfWatch { openscad: self.onlooker.openscad.clone(), changes: self.changes.end() }
    }

    /// Reads it as it is now.
    pub fn read(&mut self) -> Result<Scene, CliError> {
        self.read_for(&self.onlooker.clone())
    }

    /// The same, where another looks on.
    pub fn read_for(&mut self, onlooker: &Onlooker) -> Result<Scene, CliError> {
        self.changes.note(self.files.iter().cloned());
        let since = SystemTime::now();
        let files = FilesRead::default();
        let onlooker = Onlooker { files: Some(files.clone()), ..onlooker.clone() };
        let scene = input::read_watched(&self.file, &self.reading, &onlooker);
        let own = PathBuf::from(&self.file);
        let read = files.all().into_iter().chain([own]);
        if scene.is_ok() {
            self.files = read.collect();
            self.files.sort();
            self.files.dedup();
        } else {
            self.files.extend(read.filter(|file| !self.files.contains(file)).collect::<Vec<_>>());
        }
        self.changes.add(self.files.iter().cloned(), since);
        scene
    }

    /// The files that it was read from.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Waits until it is another; `false` at the end.
    pub fn wait(&mut self) -> bool {
        self.changes.wait()
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Of a mesh that is not there yet, too: it may come.
    #[test]
    fn what_a_scene_imports_is_watched() {
        let folder = tempfile::tempdir().unwrap();
        let [scene, mesh] = ["a.scene", "part.off"].map(|name| folder.path().join(name));
        fs::write(&scene, "cube(1); import(\"part.off\");").unwrap();
        let reading = ReadingArguments {
            skip_unsupported: false,
            memory: None,
            root: None,
            facets: crate::scene::FacetMode::default(),
            digits: None,
            up: None,
            openscad: super::super::arguments::OpenScadArguments::default(),
        };
        let watch =
            |file: &Path| WatchedScene::new(&file.to_string_lossy(), &reading, Onlooker::default()).unwrap();
        let mut watched = watch(&scene);
        assert!(watched.read().is_err());
        assert_eq!(watched.files(), [scene.clone(), mesh.clone()]);
        fs::write(&mesh, "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
            .unwrap();
        assert!(watched.read().is_ok());
        assert_eq!(watched.files(), [scene, mesh]);
    }
}

//! The files that a scene names: where they lie, and which of them may be read. A scene is somebody else's as
//! often as not, so what it names beyond its own folder is read only where a person allows it.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::options::{FilesRead, MAX_FILE_BYTES, ReadOptions};

/// Where the files of a scene lie.
#[derive(Clone, Debug, Default)]
pub struct NamedFiles {
    /// Where relative names begin.
    folder: Option<PathBuf>,
    /// Another folder whose files may be read.
    root: Option<PathBuf>,
    /// Is told of each file that is, or would be, read.
    noted: Option<FilesRead>,
}

/// A plain file that may be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    /// Its path without links: the same for all names that it has.
    pub path: PathBuf,
    /// Bytes that it has, as far as the system knows.
    pub length: u64,
}

/// Why a file that a scene names is not read.
#[derive(Debug, thiserror::Error)]
pub enum NoNamedFile {
    /// The scene has no place.
    #[error("it is not known in which folder the scene lies")]
    NoFolder,
    /// It lies elsewhere.
    #[error("it lies outside of the scene's folder")]
    Outside {
        /// The folder that would have to be allowed.
        folder: PathBuf,
    },
    /// A pipe, a device or a folder.
    #[error("it is no plain file")]
    NotPlain,
    /// Larger than any that is read.
    #[error("it is larger than {} MiB", MAX_FILE_BYTES >> 20)]
    TooLarge,
    /// The system's answer.
    #[error("{0}")]
    Io(#[from] io::Error),
}

impl NoNamedFile {
    /// What to do about it, where that is not plain.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Outside { folder } => Some(format!(
                "what a scene names elsewhere is read where you allow it: --root {}",
                folder.display()
            )),
            Self::NoFolder => Some("read the scene from a file".to_owned()),
            _ => None,
        }
    }
}

impl NamedFiles {
    /// Those of a scene that is read with these options.
    pub fn new(options: &ReadOptions) -> Self {
        let ReadOptions { folder, root, files, .. } = options.clone();
        Self { folder, root, noted: files }
    }

    /// Finds a file by its name in the scene.
    pub fn find(&self, name: &str) -> Result<NamedFile, NoNamedFile> {
        // The folder of `part.scene` has an empty path.
        let folder = self.folder.as_deref().ok_or(NoNamedFile::NoFolder)?;
        let named = folder.join(name);
        let outside = || {
            let clean = without_dots(&named);
            let folder = clean.parent().filter(|folder| !folder.as_os_str().is_empty());
            NoNamedFile::Outside { folder: folder.unwrap_or(Path::new(".")).to_owned() }
        };
        let allowed = || [Some(folder), self.root.as_deref()].into_iter().flatten();
        let path = match fs::canonicalize(&named) {
            // Links count as what they lead to: an archive may bring some along.
            Ok(path) if allowed().any(|folder| real(folder).is_some_and(|it| path.starts_with(it))) => path,
            Ok(_) => return Err(outside()),
            // Of what lies outside not even that is told.
            Err(_) if !allowed().any(|folder| whole(&named).starts_with(whole(folder))) => {
                return Err(outside());
            }
            Err(error) => {
                // It may come while the scene is watched.
                self.note(&named);
                return Err(error.into());
            }
        };
        self.note(&named);
        let found = fs::metadata(&path)?;
        match found.len() {
            _ if !found.is_file() => Err(NoNamedFile::NotPlain),
            length if length > MAX_FILE_BYTES => Err(NoNamedFile::TooLarge),
            length => Ok(NamedFile { path, length }),
        }
    }

    fn note(&self, file: &Path) {
        if let Some(noted) = &self.noted {
            noted.add(file);
        }
    }
}

impl NamedFile {
    /// Its bytes; never more than it had when it was found, of a file that grows.
    pub fn read(&self) -> Result<Vec<u8>, NoNamedFile> {
        let mut bytes = Vec::with_capacity(self.length as usize);
        File::open(&self.path)?.take(self.length).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// The path of a folder without links; none where there is no such folder.
fn real(folder: &Path) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    fs::canonicalize(folder).ok()
}

/// A path from the root on, without `.` and `..`, by its words alone: of what is not there the system says no
/// more.
fn whole(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    without_dots(&std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
}

/// A path without `.` and `..`, by its words alone.
fn without_dots(path: &Path) -> PathBuf {
    let mut clean = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(clean.components().next_back(), Some(Component::Normal(_))) => {
                clean.pop();
            }
            other => clean.push(other),
        }
    }
    clean
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(root: Option<&str>) -> NamedFiles {
        let at = Path::new(env!("CARGO_MANIFEST_DIR"));
        NamedFiles { folder: Some(at.join("src/scene")), root: root.map(|it| at.join(it)), noted: None }
    }

    #[test]
    fn what_lies_below_the_folder_or_the_root_is_found() {
        let found = |root, name: &str| files(root).find(name).map(|file| file.length > 0);
        for name in ["mod.rs", "./mesh/mod.rs", "../scene/mod.rs"] {
            assert!(found(None, name).is_ok(), "{name}");
        }
        for name in ["../lib.rs", "../../Cargo.toml", "../no such file", "/etc/hostname", "../no/such.stl"] {
            assert!(matches!(found(None, name), Err(NoNamedFile::Outside { .. })), "{name}");
        }
        // The folder of a scene that is named without one.
        for folder in ["", ".", "src"] {
            let files = NamedFiles { folder: Some(folder.into()), ..NamedFiles::default() };
            assert!(matches!(files.find("../../no such file"), Err(NoNamedFile::Outside { .. })), "{folder}");
            assert!(matches!(files.find("no such file"), Err(NoNamedFile::Io(_))), "{folder}");
        }
        assert!(found(Some("src"), "../lib.rs").is_ok());
        assert!(matches!(found(Some("src"), "../../Cargo.toml"), Err(NoNamedFile::Outside { .. })));
        assert!(matches!(found(Some("src"), "../no such file"), Err(NoNamedFile::Io(_))));
        assert!(matches!(found(None, "no such file"), Err(NoNamedFile::Io(_))));
        assert!(matches!(found(None, "mesh"), Err(NoNamedFile::NotPlain)));
        assert!(matches!(NamedFiles::default().find("mod.rs"), Err(NoNamedFile::NoFolder)));
    }

    #[test]
    fn paths_lose_their_dots() {
        let clean = |path: &str| without_dots(Path::new(path)).display().to_string();
        assert_eq!(
            ["a/../b", "./a/./b", "../a", "a/../../b", "/a/../b"].map(clean),
            ["b", "a/b", "../a", "../b", "/b"]
        );
    }
}

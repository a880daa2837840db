//! Files that a scene names: those in its own folder, and in folders within that.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::options::FilesRead;
use super::{MAX_FILE_BYTES, ReadOptions};

/// The folder of a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneFolder {
    folder: Option<PathBuf>,
    files: Option<FilesRead>,
}

impl SceneFolder {
    pub fn of(options: &ReadOptions) -> Self {
        Self { folder: options.folder.clone(), files: options.files.clone() }
    }

    /// The bytes of a file that the scene names, or why they are not read.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let is_below = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !Path::new(name).components().all(is_below) {
            return Err("only a file in the scene's own folder is read".to_owned());
        }
        let Some(folder) = &self.folder else {
            return Err("it is not known where the scene lies".to_owned());
        };
        let path = folder.join(name);
        if let Some(files) = &self.files {
            files.add(&path);
        }
        read(&path).map_err(|error| error.to_string())
    }
}

/// The bytes of a file; not of a pipe or a device, which need not end.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is no plain file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(io::Error::other(format!("it is larger than {} MiB", MAX_FILE_BYTES >> 20)));
    }
    Ok(bytes)
}

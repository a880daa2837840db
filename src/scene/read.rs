//! From a file, or its bytes, to a [`Scene`]: the checks that every format shares, then the format's reader.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::options::{Format, ReadOptions};
use super::{Diagnostic, Diagnostics, Scene, language, memory, nff};

/// The largest file that is read: 256 MiB.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Why a file gave no scene.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file could not be opened or read.
    #[error("{path}: error: {cause}", path = .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's answer.
        #[source]
        cause: io::Error,
    },
    /// The file was read, but is no scene.
    #[error(transparent)]
    Content(#[from] Diagnostics),
}

/// Reads a scene from a file.
///
/// # Errors
/// [`ReadError::File`] from the file system; [`ReadError::Content`] as [`read`].
pub fn read_file(path: &Path, options: &ReadOptions) -> Result<Scene, ReadError> {
    let name = path.display().to_string();
    let file_error = |cause| ReadError::File { path: path.to_owned(), cause };
    let file = File::open(path).map_err(file_error)?;
    let metadata = file.metadata().map_err(file_error)?;
    if metadata.is_dir() {
        return Err(file_error(io::ErrorKind::IsADirectory.into()));
    }
    if metadata.len() > MAX_FILE_BYTES {
        return Err(too_large(&name).into());
    }
    check_room(&name, metadata.len(), options)?;
    // The length above is a promise only of plain files: a pipe or a growing file is cut off here.
    let mut bytes = Vec::with_capacity(metadata.len() as usize + 1);
    file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(file_error)?;
    Ok(read(&name, &bytes, options)?)
}

/// Reads a scene from the bytes of a file; `name` is what messages call it.
///
/// # Errors
/// Every error found, with its place, as far as reading can go on after the first.
///
/// # Example
/// ```
/// let scene = ray13::scene::read("ball", b"sphere(1);", &Default::default())?;
/// assert_eq!(scene.objects.len(), 1);
/// # Ok::<(), ray13::scene::Diagnostics>(())
/// ```
pub fn read(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Scene, Diagnostics> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(too_large(name));
    }
    check_room(name, bytes.len() as u64, options)?;
    let text = text(name, bytes)?;
    match options.format.unwrap_or_else(|| Format::of(name)) {
        Format::Language => language::read(name, text, options),
        Format::Nff => nff::read(name, text, options),
    }
}

/// Whether there is memory for the text alone.
fn check_room(name: &str, bytes: u64, options: &ReadOptions) -> Result<(), Diagnostics> {
    match options.memory {
        Some(limit) if bytes > limit => Err(Diagnostics::whole(name, memory::too_little(limit, bytes))),
        _ => Ok(()),
    }
}

fn too_large(name: &str) -> Diagnostics {
    let error = Diagnostic::error(0..0, format!("the file is larger than {} MiB", MAX_FILE_BYTES >> 20));
    Diagnostics::whole(name, error.help("split the scene, or leave detail out where it was exported"))
}

fn text<'a>(name: &str, bytes: &'a [u8]) -> Result<&'a str, Diagnostics> {
    let no_text = |offset: usize, what: &str| {
        let line = bytes[..offset].split(|&byte| byte == b'\n').count();
        let message = format!("the file is not text: byte {offset}, in line {line}, is {what}");
        Diagnostics::whole(name, Diagnostic::error(0..0, message).help("a scene is UTF-8 text"))
    };
    let text = std::str::from_utf8(bytes).map_err(|error| no_text(error.valid_up_to(), "not UTF-8"))?;
    match text.find('\0') {
        Some(offset) => Err(no_text(offset, "0")),
        None => Ok(text),
    }
}

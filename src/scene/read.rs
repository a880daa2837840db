//! From a file, or its bytes, to a [`Scene`]: the checks that every format shares, then the reader that name
//! or content choose. Only the readers of text ask for UTF-8.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::options::{Format, MAX_FILE_BYTES, ReadOptions};
use super::{Diagnostic, Diagnostics, Scene, content, gzip, language, memory, mesh, nff};

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
    if let Some(files) = &options.files {
        files.add(path);
    }
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
    let most = options.memory.map_or(MAX_FILE_BYTES, |memory| memory.min(MAX_FILE_BYTES));
    file.take(most + 1).read_to_end(&mut bytes).map_err(file_error)?;
    let folder = options.folder.clone().or_else(|| path.parent().map(Path::to_owned));
    Ok(read(&name, &bytes, &ReadOptions { folder, ..options.clone() })?)
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
    if !gzip::is_gzip(bytes) {
        return read_plain(name, bytes, options);
    }
    let inner = gzip::unpacked(bytes, options.memory).map_err(|error| Diagnostics::whole(name, error))?;
    // Places are those of what is within; the file is the one that people have.
    read_plain(gzip::inner_name(name), &inner, options)
        .map_err(|errors| Diagnostics { source_name: name.to_owned(), ..errors })
}

/// Reads what is not compressed.
fn read_plain(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Scene, Diagnostics> {
    let known = options.format.or_else(|| mesh::format_of(bytes));
    if let (None, Some(what)) = (known, content::binary(bytes)) {
        return Err(no_scene(name, what));
    }
    let format = known.unwrap_or_else(|| format_of(name, bytes));
    if let Some(scene) = mesh::read(name, bytes, format, options) {
        return scene;
    }
    if options.up.is_some() {
        let error = Diagnostic::error(0..0, "an axis that is up is chosen for meshes only, and this is none");
        return Err(Diagnostics::whole(
            name,
            error.help("leave out `--up`, or give it X,Y,Z: the direction upwards"),
        ));
    }
    let text = text(name, bytes, format)?;
    match format {
        Format::Nff => nff::read(name, text, options),
        _ => language::read(name, text, options),
    }
}

/// The format of what is no mesh by its content: by the name; by the content where that has no ending, as
/// that of standard input has none.
fn format_of(name: &str, bytes: &[u8]) -> Format {
    match Path::new(name).extension() {
        None if content::is_nff(bytes) => Format::Nff,
        _ => Format::of(name),
    }
}

fn no_scene(name: &str, what: &str) -> Diagnostics {
    let error = Diagnostic::error(0..0, format!("this is {what}, not a scene"));
    Diagnostics::whole(
        name,
        error.help("ray13 reads its scene language, OpenSCAD's .csg and NFF, all of them UTF-8 text, and meshes: STL, OFF, PLY, OBJ, 3MF and AMF"),
    )
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

/// The text that a format asks for.
fn text<'a>(name: &str, bytes: &'a [u8], format: Format) -> Result<&'a str, Diagnostics> {
    let no_text = |offset: usize, what: &str| {
        let line = bytes[..offset].split(|&byte| byte == b'\n').count();
        let message = format!("the file is not text: byte {offset}, in line {line}, is {what}");
        Diagnostics::whole(
            name,
            Diagnostic::error(0..0, message).help(format!("{} is UTF-8 text", format.name())),
        )
    };
    let text = std::str::from_utf8(bytes).map_err(|error| no_text(error.valid_up_to(), "not UTF-8"))?;
    match text.find('\0') {
        Some(offset) => Err(no_text(offset, "0")),
        None => Ok(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides_where_a_name_has_no_ending() {
        let objects =
            |name: &str, bytes: &[u8]| read(name, bytes, &ReadOptions::default()).map(|s| s.objects.len());
        assert_eq!(objects("standard input", b"# a ball\ns 0 0 0 1"), Ok(1));
        assert_eq!(objects("standard input", b"sphere(1);"), Ok(1));
        assert!(objects("ball.csg", b"s 0 0 0 1").is_err(), "the ending has the last word");
    }

    #[test]
    fn a_binary_file_is_named_whatever_its_own_name() {
        for name in ["ball.csg", "ball.nff", "standard input"] {
            let error = read(name, b"\x89PNG\r\n\x1a\n\0\0", &ReadOptions::default()).unwrap_err();
            assert!(error.to_string().contains("error: this is a PNG picture, not a scene"), "{error}");
        }
    }

    #[test]
    fn a_text_format_asks_for_utf_8_by_its_name() {
        for (name, format) in [("ball.csg", "the scene language"), ("ball.nff", "NFF")] {
            let error = read(name, b"s \xc0", &ReadOptions::default()).unwrap_err().to_string();
            assert!(error.contains("the file is not text: byte 2"), "{error}");
            assert!(error.ends_with(&format!("{format} is UTF-8 text")), "{error}");
        }
    }
}

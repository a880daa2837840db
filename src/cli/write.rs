//! Where a picture is written to: standard output, or a file that is whole or as it was.

use std::collections::HashSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::CliError;
use super::input;

/// Writes to standard output. A reader that has seen enough is no error.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(CliError::Output(format!("standard output could not be written: {e}"))),
        Ok(()) => Ok(()),
    }
}

/// Where a picture goes.
#[derive(Debug)]
pub enum Destination {
    /// Standard output.
    Standard,
    /// The top of the terminal that is standard output, over the picture before.
    Place,
    /// A file, a pipe or a device.
    File(PathBuf),
}

impl Destination {
    /// What is asked for by `-o`; `-` is standard output, as is nothing.
    pub fn new(output: Option<&Path>) -> Self {
        match output {
            Some(path) if path != Path::new("-") => Self::File(path.to_owned()),
            _ => Self::Standard,
        }
    }

    /// Refuses the file that a scene is read from, under whatever name: the picture would take its place.
    pub fn check(&self, scene: &str) -> Result<(), CliError> {
        let Some(source) = input::metadata(scene) else { return Ok(()) };
        let (name, found) = match self {
            Self::Standard | Self::Place => ("standard output".to_owned(), standard_output()),
            Self::File(path) => (path.display().to_string(), fs::metadata(path).ok()),
        };
        let is_source = found.is_some_and(|found| found.is_file() && is_same(&found, &source))
            || self.path().is_some_and(|path| is_same_path(path, Path::new(scene)));
        if !is_source {
            return Ok(());
        }
        Err(lost(&name))
    }

    /// Refuses the files that a scene was read from, its own and all that it is made of.
    pub fn check_files(&self, files: &[PathBuf]) -> Result<(), CliError> {
        let files = SceneFiles::new(files.iter().map(PathBuf::as_path));
        self.path().map_or(Ok(()), |path| files.check(path))
    }

    fn path(&self) -> Option<&Path> {
        match self {
            Self::Standard | Self::Place => None,
            Self::File(path) => Some(path),
        }
    }

    /// Writes a picture.
    pub fn write(&self, bytes: &[u8]) -> Result<(), CliError> {
        match self {
            Self::Standard => print(bytes),
            Self::Place => print(&in_place(bytes)),
            Self::File(path) => write_file(path, bytes),
        }
    }
}

/// A text from the top of the screen on: the rest of each line, and all below, is cleared, and nothing before
/// it is written, which would be seen as a flash.
fn in_place(bytes: &[u8]) -> Vec<u8> {
    let mut out = b"\x1b[H".to_vec();
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        let (line, end) = line.strip_suffix(b"\n").map_or((line, &b""[..]), |line| (line, b"\x1b[K\r\n"));
        out.extend(line);
        out.extend(end);
    }
    out.extend(b"\x1b[J");
    out
}

#[cfg(unix)]
fn is_same(a: &fs::Metadata, b: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

/// Elsewhere files have no numbers that std tells; their paths are compared.
#[cfg(not(unix))]
fn is_same(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    false
}

fn is_same_path(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b && a.is_file())
}

/// The files that scenes are read from, of which none may be written. What each is is asked of the system
/// once.
#[derive(Debug, Default)]
pub struct SceneFiles(HashSet<FileId>);

impl SceneFiles {
    /// These files.
    pub fn new<'s>(files: impl Iterator<Item = &'s Path>) -> Self {
        Self(files.filter_map(FileId::of).collect())
    }

    /// Refuses a place that is one of them, by whatever link.
    pub fn check(&self, place: &Path) -> Result<(), CliError> {
        match FileId::of(place) {
            Some(id) if self.0.contains(&id) => Err(lost(&place.display().to_string())),
            _ => Ok(()),
        }
    }
}

/// What is the same for all names of a file: its numbers, or its path where std tells none.
#[derive(Debug, PartialEq, Eq, Hash)]
#[cfg(unix)]
struct FileId(u64, u64);

#[derive(Debug, PartialEq, Eq, Hash)]
#[cfg(not(unix))]
struct FileId(PathBuf);

impl FileId {
    /// That of a file; `None` where there is none, or something else.
    #[cfg(unix)]
    fn of(path: &Path) -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        fs::metadata(path).ok().filter(fs::Metadata::is_file).map(|found| Self(found.dev(), found.ino()))
    }

    #[cfg(not(unix))]
    fn of(path: &Path) -> Option<Self> {
        fs::canonicalize(path).ok().filter(|path| path.is_file()).map(Self)
    }
}

/// Why a picture is not written to a file.
fn lost(name: &str) -> CliError {
    CliError::Input(format!(
        "{name} is a file that the scene is read from, and would be lost: give the picture another name"
    ))
}

/// What standard output is, as far as the system tells.
#[cfg(unix)]
fn standard_output() -> Option<fs::Metadata> {
    use std::os::fd::AsFd;
    fs::File::from(io::stdout().as_fd().try_clone_to_owned().ok()?).metadata().ok()
}

#[cfg(not(unix))]
fn standard_output() -> Option<fs::Metadata> {
    None
}

/// Writes beside the place and moves there at the end, so that the file is whole or as it was. A link is
/// written through, and a file that was there keeps its permissions. What is no plain file, a pipe or a
/// device, is written straight, and so is a link to what is not there yet, since a move would put the file in
/// its place.
fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let failed = |e: io::Error| CliError::Output(format!("{} could not be written: {e}", path.display()));
    let open = || fs::File::options().write(true).open(path);
    let (place, permissions) = match fs::metadata(path) {
        Ok(found) if found.is_dir() => return Err(failed(io::ErrorKind::IsADirectory.into())),
        Ok(found) if !found.is_file() => {
            let written = open().and_then(|mut out| out.write_all(bytes).and_then(|()| out.flush()));
            return written.map_err(failed);
        }
        Ok(found) => {
            // A move asks the folder for permission only; the file must allow it too.
            open().map_err(failed)?;
            (fs::canonicalize(path).map_err(failed)?, Some(found.permissions()))
        }
        Err(_) if fs::symlink_metadata(path).is_ok() => return fs::write(path, bytes).map_err(failed),
        Err(_) => (path.to_owned(), None),
    };
    // Not made from the file's own name, which may be as long as names can be.
    let part = place.with_file_name(format!("ray13-{}.part", std::process::id()));
    let written = fs::write(&part, bytes)
        .and_then(|()| permissions.map_or(Ok(()), |own| fs::set_permissions(&part, own)))
        .and_then(|()| fs::rename(&part, &place));
    written.map_err(|e| {
        let _ = fs::remove_file(&part);
        failed(e)
    })
}

//! Scenes that are not part of this repository and may stand beside it: OpenSCAD's examples and the Standard
//! Procedural Databases. A case whose file is not there is skipped; each suite that has such cases says at
//! its end how many.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Where they may stand, from the root of the repository.
const BESIDE: &str = "../shared/scenes";

/// Cases that were left out for want of a file.
static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// A folder such as `spd`, or a file such as `spd/balls.nff`, if it is there; else a case is counted as
/// skipped.
pub fn path(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(BESIDE).join(name);
    if path.exists() {
        return Some(path);
    }
    SKIPPED.fetch_add(1, Ordering::Relaxed);
    None
}

/// The files of a folder, by name; none, and a case skipped, where it is not there.
pub fn files(folder: &str) -> Vec<PathBuf> {
    let entries = path(folder).map(|folder| folder.read_dir().unwrap());
    let mut paths: Vec<_> = entries.into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Says how many cases were skipped, on a line that the test harness does not keep to itself. A suite calls
/// this from the test whose name comes last, which begins when all others have begun.
pub fn say_what_was_skipped(suite: &str) {
    let skipped = SKIPPED.load(Ordering::Relaxed);
    if skipped > 0 {
        let _ = writeln!(io::stderr(), "{suite}: {skipped} cases skipped, whose files are not in {BESIDE}");
    }
}

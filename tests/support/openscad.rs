//! OpenSCAD itself, where it is installed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Whether it is missing; says so then.
pub fn is_missing() -> bool {
    let is_missing = Command::new("openscad").arg("--version").output().is_err();
    if is_missing {
        eprintln!("skipped: openscad is not installed");
    }
    is_missing
}

/// What it writes of a program, in the format of this ending; none where it says that the program makes
/// nothing of that kind.
pub fn exported(program: &Path, ending: &str) -> Option<Vec<u8>> {
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let name = format!("openscad-{}-{}.{ending}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut openscad = Command::new("openscad");
    openscad
        .arg("-o")
        .arg(&file)
        .arg(program)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let is_well = openscad.status().is_ok_and(|status| status.success());
    let bytes = fs::read(&file).ok();
    let _ = fs::remove_file(&file);
    bytes.filter(|_| is_well)
}

/// The same of a program's text.
pub fn exported_text(program: &str, ending: &str) -> Option<Vec<u8>> {
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let name = format!("program-{}-{}.scad", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&file, program).unwrap();
    let bytes = exported(&file, ending);
    let _ = fs::remove_file(&file);
    bytes
}

/// Does something for each of some things, on two threads, and gives the results in their order.
pub fn in_parallel<T: Sync, R: Send>(things: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let index = next.fetch_add(1, Ordering::Relaxed)
            && let Some(thing) = things.get(index)
        {
            done.push((index, f(thing)));
        }
        done
    };
    let mut done = std::thread::scope(|scope| {
        let other = scope.spawn(work);
        let mut done = work();
        done.extend(other.join().unwrap());
        done
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

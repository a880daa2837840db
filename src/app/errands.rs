//! What takes its time, each on a thread of its own, so that no key waits for it.

use std::fs::OpenOptions;
use std::io::{self, Read, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::mpsc::Sender;
use std::thread;

use super::desk::camera_line;
use super::done::Done;
use super::events::Event;

/// Begins it. What comes of it, or that it has panicked, is sent to `events`.
pub fn begin(events: Sender<Event>, errand: impl FnOnce() -> Done + Send + 'static) -> io::Result<()> {
    let run = move || {
        // What a panic leaves half done is not looked at: the program ends.
        let event = match panic::catch_unwind(AssertUnwindSafe(errand)) {
            Ok(done) => Event::Done(done),
            Err(_) => Event::Panicked,
        };
        // Who no longer waits for it has ended.
        let _ = events.send(event);
    };
    thread::Builder::new().name("errand".to_owned()).spawn(run).map(drop)
}

/// Adds a line at the end of a text file, which need not be there; gives what was done, in words.
///
/// # Errors
/// Why the file could not be written, in words: nor is one that is not of the scene language, or has a view
/// of this name.
pub fn append(path: &Path, line: &str) -> Result<String, String> {
    if path.extension().is_none_or(|ending| ending != "scene") {
        return Err("a view is a line of the scene language: name a file that ends in .scene".to_owned());
    }
    let failed = |error: io::Error| format!("{} could not be written: {error}", path.display());
    let mut file = OpenOptions::new().read(true).append(true).create(true).open(path).map_err(failed)?;
    let mut text = String::new();
    file.read_to_string(&mut text).map_err(failed)?;
    if let Some(name) = camera_line::name_in(line)
        && text.lines().any(|one| one.contains("camera(") && one.contains(name))
    {
        return Err(format!("{} has a view {name} already", path.display()));
    }
    let begin = if text.is_empty() || text.ends_with('\n') { "" } else { "\n" };
    file.write_all(format!("{begin}{line}\n").as_bytes()).map_err(failed)?;
    Ok(format!("added to {}", path.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn a_line_is_added_on_a_line_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.scene");
        append(&path, "camera(1);").unwrap();
        fs::write(&path, "cube(1);").unwrap();
        append(&path, "camera(2);").unwrap();
        append(&path, "camera(3);").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "cube(1);\ncamera(2);\ncamera(3);\n");
        append(&path, "camera(\"a\", eye = 1);").unwrap();
        let again = append(&path, "camera(\"a\", eye = 2);").unwrap_err();
        assert!(again.contains("has a view \"a\" already"), "{again}");
        assert!(append(&folder.path().join("a.nff"), "").unwrap_err().contains(".scene"));
        let no_file = folder.path().join("b.scene");
        fs::create_dir(&no_file).unwrap();
        assert!(append(&no_file, "").unwrap_err().contains("could not be written"));
    }

    #[test]
    fn a_panic_is_an_event() {
        let (sender, events) = mpsc::channel();
        begin(sender, || panic!("the errand fell")).unwrap();
        assert!(matches!(events.recv().unwrap(), Event::Panicked));
    }
}

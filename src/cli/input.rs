//! Scenes from files, from standard input and from within the program.

use std::io::{IsTerminal, Read};
use std::path::Path;

use crate::frame::Studio;
use crate::scene::{
    self, Diagnostics, EmbeddedScene, MAX_FILE_BYTES, ReadError, ReadOptions, Scene, embedded,
};

use super::diagnostics;
use super::error::{CliError, tell};

/// Reads a scene: a file, `-` for standard input, or an embedded scene where there is no file of that name.
pub fn read(file: &str, skip_unsupported: bool) -> Result<Scene, CliError> {
    let options = ReadOptions { skip_unsupported, ..ReadOptions::default() };
    if file == "-" {
        let mut bytes = Vec::new();
        let limited = std::io::stdin().lock().take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes);
        limited.map_err(|e| CliError::Input(format!("standard input could not be read: {e}")))?;
        return scene::read("standard input", &bytes, &options).map_err(|e| rendered(&e));
    }
    match scene::read_file(Path::new(file), &options) {
        Ok(scene) => Ok(scene),
        Err(ReadError::Content(diagnostics)) => Err(rendered(&diagnostics)),
        Err(error @ ReadError::File { .. }) => match named(file) {
            Some(inside) => {
                scene::read(inside.name, inside.text.as_bytes(), &options).map_err(|e| rendered(&e))
            }
            None => Err(CliError::Scene(format!("{error}{}", no_such_scene(file)))),
        },
    }
}

fn named(name: &str) -> Option<&'static EmbeddedScene> {
    embedded().iter().find(|s| s.name == name)
}

/// What to try instead of a file that is not there, where its name could have been meant for an embedded scene.
fn no_such_scene(file: &str) -> String {
    if Path::new(file).exists() || file.contains(['.', '/', '\\']) {
        return String::new();
    }
    let names: Vec<&str> = embedded().iter().map(|s| s.name).collect();
    format!("\nhelp: nor is it an embedded scene; there are {}", names.join(", "))
}

fn rendered(diagnostics: &Diagnostics) -> CliError {
    CliError::Scene(diagnostics::render(diagnostics, std::io::stderr().is_terminal()))
}

/// Puts a scene together.
pub fn studio(scene: Scene) -> Result<Studio, CliError> {
    Studio::new(scene).map_err(|e| CliError::Input(e.to_string()))
}

/// What the frame of the viewer calls a scene.
pub fn title(file: &str) -> String {
    if file == "-" {
        return "standard input".to_owned();
    }
    let name = Path::new(file).file_name().map_or(file.into(), |n| n.to_string_lossy());
    if named(file).is_some() && !Path::new(file).exists() {
        format!("{name}.scene")
    } else {
        name.into_owned()
    }
}

/// Says what the reader left out.
pub fn say(notes: &[String]) {
    for note in notes {
        tell(note);
    }
}

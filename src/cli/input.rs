//! Scenes from files, from standard input and from within the program.

#[cfg(unix)]
use std::fs::File;
use std::fs::Metadata;
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};

use crate::frame::Studio;
use crate::scene::{
    self, Diagnostic, Diagnostics, EmbeddedScene, FilesRead, Format, KnownFonts, MAX_FILE_BYTES, ReadError,
    ReadOptions, Scene, embedded,
};
use crate::stage::Progress;

use super::arguments::ReadingArguments;
use super::diagnostics;
use super::error::{CliError, tell, visible};
use super::memory;
use super::openscad::{self, OpenScadRun, Program};
use super::terminal::capabilities;
use super::waiting::Waiting;

/// Who looks on while a scene is read.
#[derive(Clone, Debug, Default)]
pub struct Onlooker {
    /// Is told how far it is.
    pub progress: Option<Progress>,
    /// Can end OpenSCAD, where that is at work.
    pub openscad: OpenScadRun,
    /// Is told of the files that it is read from.
    pub files: Option<FilesRead>,
    /// The fonts of the machine, once a reading has looked for them.
    pub fonts: KnownFonts,
    /// Shows what is wrong on a screen of its own, and not on standard error.
    pub has_screen: bool,
}

/// Reads a scene: a file, `-` for standard input, or an embedded scene where there is no file of that name.
pub fn read(file: &str, reading: &ReadingArguments) -> Result<Scene, CliError> {
    read_noting(file, reading, &FilesRead::default())
}

/// The same, and notes the files that it is read from.
pub fn read_noting(file: &str, reading: &ReadingArguments, files: &FilesRead) -> Result<Scene, CliError> {
    let openscad = OpenScadRun::minding_signals();
    let onlooker = Onlooker { openscad, files: Some(files.clone()), ..Onlooker::default() };
    read_watched(file, reading, &onlooker)
}

/// Reads a scene of which the bytes are here already; `file` is where they are from.
pub fn read_bytes(
    file: &str,
    bytes: &[u8],
    reading: &ReadingArguments,
    files: &FilesRead,
) -> Result<Scene, CliError> {
    if openscad::is_program(file, &reading.openscad)? {
        return read_noting(file, reading, files);
    }
    let folder = Path::new(file).parent().map(Path::to_owned);
    let onlooker = Onlooker { files: Some(files.clone()), ..Onlooker::default() };
    let options = ReadOptions { folder, ..options(reading, &onlooker) };
    scene::read(file, bytes, &options).map_err(|e| no_scene(file, &e, &onlooker))
}

/// The same as [`read`], where somebody looks on.
pub fn read_watched(file: &str, reading: &ReadingArguments, onlooker: &Onlooker) -> Result<Scene, CliError> {
    let options = &options(reading, onlooker);
    let is_program = openscad::is_program(file, &reading.openscad)?;
    if file == "-" {
        let mut bytes = Vec::new();
        let limited = std::io::stdin().lock().take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes);
        limited.map_err(|e| CliError::Input(format!("standard input could not be read: {e}")))?;
        if is_program {
            return read_program("standard input", Program::Text(&bytes), options, reading, onlooker);
        }
        let options = &ReadOptions { folder: Some(working_folder()), ..options.clone() };
        return scene::read("standard input", &bytes, options).map_err(|e| rendered(&e, onlooker));
    }
    if is_program && Path::new(file).is_file() {
        return read_program(file, Program::File(Path::new(file)), options, reading, onlooker);
    }
    // The viewer has a screen that says what it is at.
    let is_silent = onlooker.has_screen || onlooker.progress.is_some();
    let waiting = (!is_silent).then(|| Waiting::new(file));
    let read = scene::read_file(Path::new(file), options);
    drop(waiting);
    match read {
        Ok(scene) => Ok(scene),
        Err(ReadError::Content(diagnostics)) => Err(no_scene(file, &diagnostics, onlooker)),
        Err(error @ ReadError::File { .. }) => match named(file) {
            Some(inside) => {
                scene::read(inside.name, inside.text.as_bytes(), options).map_err(|e| rendered(&e, onlooker))
            }
            None => Err(CliError::Scene(visible(&format!("{error}{}", embedded_names(file))))),
        },
    }
}

/// Reads what OpenSCAD makes of a program of its own.
fn read_program(
    name: &str,
    program: Program<'_>,
    options: &ReadOptions,
    reading: &ReadingArguments,
    onlooker: &Onlooker,
) -> Result<Scene, CliError> {
    let made = openscad::convert(name, program, &reading.openscad, &onlooker.openscad)?;
    if let Some(files) = &onlooker.files {
        made.files.iter().for_each(|file| files.add(file));
    }
    let folder = match program {
        // The names in the `.csg` are those from the program on.
        Program::File(path) => path.parent().map_or_else(working_folder, Path::to_owned),
        Program::Text(_) => working_folder(),
    };
    let options = ReadOptions { folder: Some(folder), format: Some(Format::Language), ..options.clone() };
    // Places are those of a text that is not kept; what is wrong in it stands in no program.
    let source = format!("{name}, as OpenSCAD's .csg");
    let place = match program {
        Program::File(_) => name,
        Program::Text(_) => "PROGRAM.scad",
    };
    let kept = format!("`openscad -o FILE.csg {place}` keeps the text that these lines are of");
    let mut scene = scene::read(&source, &made.csg, &options).map_err(|mut why| {
        why.list.push(Diagnostic::note(0..0, kept.clone()));
        rendered(&why, onlooker)
    })?;
    if name_csg(&mut scene.notes) {
        scene.notes.push(kept);
    }
    scene.notes.splice(0..0, made.said.into_iter().map(|line| format!("OpenSCAD: {line}")));
    Ok(scene)
}

/// Where the files lie that a scene of standard input names.
fn working_folder() -> PathBuf {
    PathBuf::new()
}

fn options(reading: &ReadingArguments, onlooker: &Onlooker) -> ReadOptions {
    let ReadingArguments { skip_unsupported, memory, up, facets, digits, ref root, openscad: _ } = *reading;
    let memory = memory.or_else(memory::half_of_all);
    let Onlooker { progress, files, fonts, .. } = onlooker.clone();
    let root = root.clone();
    ReadOptions {
        skip_unsupported,
        progress,
        memory,
        up,
        facets,
        digits,
        root,
        fonts,
        files,
        ..ReadOptions::default()
    }
}

/// Says in notes that a line is one of OpenSCAD's `.csg`, which is not the file that a person has; whether
/// any note names a line.
fn name_csg(notes: &mut [String]) -> bool {
    let mut any_line = false;
    for note in notes.iter_mut().filter(|note| note.starts_with("line ")) {
        note.insert_str(0, "in what OpenSCAD wrote, ");
        any_line = true;
    }
    any_line
}

/// Why a file is no scene, given what the reader says.
fn no_scene(file: &str, diagnostics: &Diagnostics, onlooker: &Onlooker) -> CliError {
    match foreign(file) {
        Some(format) => CliError::Input(format!(
            "{file} looks like {format}, which ray13 does not read: give it a scene or OpenSCAD's .csg"
        )),
        None => rendered(diagnostics, onlooker),
    }
}

/// What the system tells of the file that a scene is read from, be it that standard input is one; nothing of
/// a scene inside the program.
pub fn metadata(file: &str) -> Option<Metadata> {
    if file == "-" { standard_input() } else { std::fs::metadata(file).ok() }
}

#[cfg(unix)]
fn standard_input() -> Option<Metadata> {
    use std::os::fd::AsFd;
    File::from(std::io::stdin().as_fd().try_clone_to_owned().ok()?).metadata().ok()
}

#[cfg(not(unix))]
fn standard_input() -> Option<Metadata> {
    None
}

/// Whether there is a file of this name, or an embedded scene.
pub fn is_scene(name: &str) -> bool {
    name == "-" || Path::new(name).exists() || named(name).is_some()
}

fn named(name: &str) -> Option<&'static EmbeddedScene> {
    embedded().iter().find(|s| s.name == name)
}

/// Formats of models that people try first, by the ending of the name. Only asked where a file made no sense.
const FOREIGN: [(&str, &str); 2] = [("step", "a STEP model"), ("stp", "a STEP model")];

fn foreign(file: &str) -> Option<&'static str> {
    let ending = Path::new(file).extension()?;
    FOREIGN.iter().find(|(own, _)| ending.eq_ignore_ascii_case(own)).map(|(_, format)| *format)
}

/// What else a plain word could have meant, where no file has that name.
fn embedded_names(file: &str) -> String {
    if file.contains(['.', '/', '\\']) || Path::new(file).exists() {
        return String::new();
    }
    let names: Vec<&str> = embedded().iter().map(|s| s.name).collect();
    format!("\n  = help: it is neither a file nor an embedded scene; of those there are {}", names.join(", "))
}

fn rendered(diagnostics: &Diagnostics, onlooker: &Onlooker) -> CliError {
    let colors = !onlooker.has_screen && std::io::stderr().is_terminal() && capabilities().has_grays();
    CliError::Scene(diagnostics::render(diagnostics, colors))
}

/// Puts a scene together.
pub fn studio(scene: Scene) -> Result<Studio, CliError> {
    watched_studio(scene, Progress::default())
}

/// The same, where `progress` says how far this is.
pub fn watched_studio(scene: Scene, progress: Progress) -> Result<Studio, CliError> {
    Studio::watched(scene, progress).map_err(|e| CliError::Input(e.to_string()))
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

//! Anything at all as the text of a scene, in every format that is read: an answer in time, every error at a
//! place within the text, and of what is read a picture, by every structure the same.

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::{LazyLock, mpsc};
use std::time::Duration;
use std::{fs, thread};

use crate::support::beside;
use crate::support::cases::cases;
use crate::support::mesh_files::MeshText;
use crate::support::scribble::{Mutation, language, nff, soup};
use crate::support::sound::Pictures;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use ray13::frame::Studio;
use ray13::math::Size;
use ray13::plan::Shading;
use ray13::scene::{Diagnostics, ReadOptions, Scene, embedded, read};

const DOTS: Size = Size::new(8, 8);

/// What takes milliseconds may take so long, on however slow a machine. A text that needs more hangs the
/// program.
const DEADLINE: Duration = Duration::from_secs(20);

/// Reads a text and draws what it says; what is wrong with that, if anything is. `name` tells the format.
fn answer(name: &'static str, bytes: Vec<u8>) -> Result<(), TestCaseError> {
    let (sender, receiver) = mpsc::channel();
    let shown = String::from_utf8_lossy(&bytes).into_owned();
    thread::spawn(move || {
        let outcome = [false, true].into_iter().try_for_each(|skip_unsupported| {
            let options = ReadOptions { skip_unsupported, ..ReadOptions::default() };
            match read(name, &bytes, &options) {
                Ok(scene) => drawn(scene, &bytes),
                Err(errors) => placed(&errors),
            }
        });
        // Whoever waits no longer has said why.
        let _ = sender.send(outcome);
    });
    let fault = match receiver.recv_timeout(DEADLINE) {
        Ok(Ok(())) => return Ok(()),
        Ok(Err(fault)) => fault,
        Err(mpsc::RecvTimeoutError::Timeout) => format!("no answer within {DEADLINE:?}"),
        Err(mpsc::RecvTimeoutError::Disconnected) => "a panic".to_owned(),
    };
    Err(TestCaseError::fail(format!("{fault}\n{name}:\n{shown}")))
}

/// Whether what was read can be drawn.
fn drawn(scene: Scene, bytes: &[u8]) -> Result<(), String> {
    let lines = bytes.split(|&byte| byte == b'\n').count();
    for note in &scene.notes {
        let line =
            note.strip_prefix("line ").and_then(|rest| rest.split(':').next()).map(str::parse::<usize>);
        if line.is_some_and(|line| !line.is_ok_and(|line| (1..=lines).contains(&line))) {
            return Err(format!("a note of no line: {note}"));
        }
    }
    let studio = Studio::new(scene).map_err(|e| format!("it was read, but: {e}"))?;
    let camera = studio.camera(0, 1.0);
    camera.check().map_err(|e| format!("it was read, but: {e}; {camera:?}"))?;
    let pictures = Pictures::sound(&studio, &camera, DOTS, Shading::Whitted, false)?;
    pictures.same()
}

/// Whether each error stands at a place of the text, and can be told.
pub fn placed(errors: &Diagnostics) -> Result<(), String> {
    if errors.list.is_empty() || errors.to_string().is_empty() {
        return Err("an error without a word".to_owned());
    }
    for diagnostic in &errors.list {
        let (line, column) = errors.place(diagnostic.span.start);
        let characters = errors.source.split('\n').nth(line - 1).map(|line| line.chars().count());
        let inside = errors.source.get(diagnostic.span.clone()).is_some();
        if !inside || characters.is_none_or(|characters| column == 0 || column > characters + 1) {
            return Err(format!("{line}:{column} is no place: {diagnostic:?}"));
        }
    }
    Ok(())
}

/// Texts that are right, read once: the scenes within the program, this repository's files, and those beside
/// it.
static TEXTS: LazyLock<Vec<(&str, Vec<u8>)>> = LazyLock::new(|| {
    let mut all: Vec<_> = embedded().iter().map(|s| ("test.scene", s.text.as_bytes().to_vec())).collect();
    all.extend(KEPT.map(|(name, text)| (name, text.to_vec())));
    all.extend(MeshText::brick().files());
    for (folder, name) in [("openscad", "test.csg"), ("spd", "test.nff")] {
        for path in beside::files(folder) {
            let mut text = fs::read(&path).unwrap();
            // The beginning of a long one has all that the rest has, and is drawn in milliseconds.
            text.truncate(20_000);
            all.push((name, text));
        }
    }
    all
});

/// This repository's own files, of every format.
const KEPT: [(&str, &[u8]); 4] = [
    ("test.csg", include_bytes!("../files/bracket.csg")),
    ("test.csg", b"hull() { cube(1); } color([0.2, 0.4, 0.6, 0.5]) { sphere($fn = 0, r = 2); }"),
    ("test.nff", include_bytes!("../files/balls.nff")),
    ("test.nff", include_bytes!("../files/surfaces.nff")),
];

const NAMES: [&str; 3] = ["test.scene", "test.csg", "test.nff"];

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn bytes(name in select(&NAMES[..]), bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        answer(name, bytes)?;
    }

    #[test]
    fn pieces(name in select(&NAMES[..]), text in soup()) {
        answer(name, text.into_bytes())?;
    }

    #[test]
    fn programs(name in select(&NAMES[..2]), text in language()) {
        answer(name, text.into_bytes())?;
    }

    #[test]
    fn entities(text in nff()) {
        answer("test.nff", text.into_bytes())?;
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn right_texts_gone_wrong(text in any::<Index>(), mutations in prop::collection::vec(any::<Mutation>(), 1..5)) {
        let (name, mut bytes) = TEXTS[text.index(TEXTS.len())].clone();
        for mutation in &mutations {
            mutation.apply(&mut bytes);
        }
        answer(name, bytes)?;
    }
}

#[test]
fn right_texts() {
    for (name, bytes) in &*TEXTS {
        if let Err(fault) = answer(name, bytes.clone()) {
            panic!("{fault}");
        }
    }
}

/// The program says of a text what the library says: exit code 0 and nothing on standard error, or 2 and why.
#[test]
fn the_program_answers_as_the_library() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("any_text");
    fs::create_dir_all(&folder).unwrap();
    for (number, (name, bytes)) in TEXTS.iter().enumerate() {
        for (cut, insert) in [(3, "1e400"), (5, "\""), (7, "é\r\n\t["), (11, "nan"), (2, "")] {
            let mut bytes = bytes.clone();
            let middle = bytes.len() * (cut - 1) / cut;
            bytes.truncate(middle);
            bytes.extend_from_slice(insert.as_bytes());
            let file = folder.join(format!("{number}-{cut}-{name}"));
            fs::write(&file, &bytes).unwrap();
            let scene = read(name, &bytes, &ReadOptions::default());
            for arguments in [&["check"][..], &["render", "--dots", "8x8", "--threads", "1"]] {
                let mut command = Command::new(env!("CARGO_BIN_EXE_ray13"));
                let output = command.args(arguments).arg(&file).stdin(Stdio::null()).output().unwrap();
                let message = String::from_utf8(output.stderr).expect("text");
                let expected = if scene.is_ok() { 0 } else { 2 };
                assert_eq!(output.status.code(), Some(expected), "{}: {message}", file.display());
                let silent = scene.as_ref().is_ok_and(|scene| scene.notes.is_empty());
                assert_eq!(message.is_empty(), silent, "{}: {message}", file.display());
                assert_eq!(output.stdout.is_empty(), scene.is_err(), "{}", file.display());
            }
        }
    }
}

//! What the command `ray13` promises to a shell: exit codes, which stream, and no half-written files.

mod support {
    pub mod seen;
}

mod command_line {
    use super::{BALL, done, fails, folder, ray13, run, scene, text};

    mod bad_arguments;
    mod bad_input;
    mod bad_output;
    mod describe;
    mod dos_art;
    mod effects;
    mod engines;
    mod follow;
    mod kept;
    mod parts;
    mod plan;
    mod plans;
    mod programs;
    mod readme;
    mod scenes;
    mod still;
    mod threads;
    mod trade;
    mod turntable;
}

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// A folder of its own for each test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("command_line").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn ray13() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ray13"));
    command.stdin(Stdio::null()).env_remove("NO_COLOR");
    command
}

fn run(arguments: &[&str]) -> Output {
    ray13().args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

/// Exit code 0, nothing on standard error; gives standard output.
#[track_caller]
fn done(output: &Output) -> Vec<u8> {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr), "");
    output.stdout.clone()
}

/// An exit code with a message, nothing on standard output; gives the message.
#[track_caller]
fn fails(output: &Output, code: i32) -> String {
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert_eq!(text(&output.stdout), "");
    assert!(!message.trim().is_empty(), "an error says nothing");
    assert!(!message.contains("panicked"), "{message}");
    message
}

const BALL: &str = "sphere(1);\n";

/// A file of a test's folder that holds `contents`.
fn scene(test: &str, contents: &str) -> (PathBuf, String) {
    let folder = folder(test);
    let file = folder.join("given.scene");
    fs::write(&file, contents).unwrap();
    (folder, file.to_str().unwrap().to_owned())
}

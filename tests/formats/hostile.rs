//! Files that nobody means well with, of every format: an answer or an error with a word of the file, exit
//! code 0 or 2, within memory that the file accounts for, and never a panic.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::support::mesh_files::{MeshText, gzip, three_mf, zip};

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile");
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs `check` with half a gigabyte of address space, where the system can hold it to that.
fn check(file: &Path, more: &[&str]) -> Output {
    let mut check = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        shell.args(["-c", "ulimit -v 524288 && exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_ray13")]);
        shell
    } else {
        Command::new(env!("CARGO_BIN_EXE_ray13"))
    };
    check
        .env("RAYON_NUM_THREADS", "1")
        .arg("check")
        .args(more)
        .arg(file)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[track_caller]
fn answers(name: &str, output: &Output, says: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 2)), "{name}: {:?} {said}", output.status);
    assert!(!said.contains("panicked"), "{name}: {said}");
    assert!(said.contains(says), "{name}: {said}\ninstead of: {says}");
    assert_eq!(output.status.code() == Some(2), !says.is_empty(), "{name}: {said}");
}

/// What a file says that it has is no reason to take memory for it.
#[test]
fn what_is_announced_is_not_believed() {
    let brick = MeshText::brick();
    let mut stl = brick.stl_binary(b"");
    stl[80..84].copy_from_slice(&1_000_000_000_u32.to_le_bytes());
    let ply = |from: &str| {
        let text = String::from_utf8_lossy(&brick.ply_little()[..200])
            .replace(from, &format!("{}000000000", &from[..from.len() - 1]));
        text.into_bytes()
    };
    let blank = vec![b' '; 30 << 20];
    let off = "OFF 1000000000 1000000000 0\n0 0 0\n";
    let list = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n4294967295 0 0 0\n";
    let model = |index: &str| brick.model().replacen("v1=\"0\"", &format!("v1=\"{index}\""), 1);
    for (name, bytes, says) in [
        ("announced.stl", stl, "says that it has 1000000000 triangles"),
        ("announced.ply", ply("face 6"), "the file is cut off"),
        ("corners.ply", ply("vertex 8"), "the file is cut off"),
        ("list.ply", list.into(), "the file is cut off"),
        ("announced.off", off.into(), "the file is cut off"),
        ("face.off", "OFF 1 1 0\n0 0 0\n1000000000 0 0 0\n".into(), "error"),
        ("far.obj", "v 0 0 0\nf 1000000000 -1000000000 1\n".into(), "a face names corner 1000000000"),
        ("far.3mf", three_mf(&model("1000000000")), "a face names corner 1000000000"),
        ("bomb.stl.gz", gzip(&blank), "more than the 20 MiB of memory"),
        ("bomb.3mf", zip(&[("a", b"a"), ("3D/3dmodel.model", &blank)]), "takes more than"),
        ("bomb.amf", zip(&[("a", b"a"), ("a.amf", &blank)]), "takes more than"),
    ] {
        let path = folder().join(name);
        fs::write(&path, bytes).unwrap();
        // A bomb that is held to less memory goes off sooner.
        let memory: &[&str] = if name.starts_with("bomb.") { &["--memory", "20MiB"] } else { &[] };
        answers(name, &check(&path, memory), says);
    }
}

/// A copy may be cut off anywhere; no half of a mesh is shown as if it were whole.
#[test]
fn what_is_cut_off_is_said() {
    for (name, bytes) in MeshText::brick().files() {
        for share in [1, 3, 6, 9] {
            let path = folder().join(format!("{share}-{name}"));
            fs::write(&path, &bytes[..bytes.len() * share / 10]).unwrap();
            let output = check(&path, &[]);
            // OBJ says nowhere how much of it there is: it is an open mesh then, which is said.
            let says = if output.status.code() == Some(2) { "error" } else { "" };
            answers(name, &output, says);
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(!said.is_empty(), "{name}: {share} of 10");
        }
    }
}

/// Editors of Windows end lines by two characters.
#[test]
fn lines_may_end_by_two_characters() {
    for (name, bytes) in MeshText::brick().files() {
        let is_text = std::str::from_utf8(&bytes).is_ok_and(|text| !text.contains('\0'));
        if is_text {
            let path = folder().join(format!("crlf-{name}"));
            fs::write(&path, String::from_utf8(bytes).unwrap().replace('\n', "\r\n")).unwrap();
            let output = check(&path, &[]);
            answers(name, &output, "");
            assert!(
                String::from_utf8_lossy(&output.stdout).contains("12 triangles, 8 corners, closed"),
                "{name}"
            );
        }
    }
}

/// Somebody saves it again and again, first half of it.
#[test]
fn a_file_that_changes_while_it_is_read_has_an_answer() {
    let path = folder().join("changing.stl");
    let bytes = MeshText::brick().stl_binary(b"");
    fs::write(&path, &bytes).unwrap();
    let is_over = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(std::sync::atomic::Ordering::Relaxed) {
                fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
                fs::write(&path, &bytes).unwrap();
            }
        });
        for _ in 0..8 {
            let output = check(&path, &[]);
            let says = if output.status.success() { "" } else { "error" };
            answers("changing.stl", &output, says);
        }
        is_over.store(true, std::sync::atomic::Ordering::Relaxed);
    });
}

/// Who waits for nobody wants to know; and what is written then is read.
#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_to_is_said() {
    use std::io::{BufRead, BufReader, Read};

    let path = folder().join("pipe.scene");
    let _ = fs::remove_file(&path);
    if !Command::new("mkfifo").arg(&path).status().is_ok_and(|status| status.success()) {
        eprintln!("skipped: mkfifo is missing");
        return;
    }
    let mut waiting = Command::new(env!("CARGO_BIN_EXE_ray13"));
    let mut waiting =
        waiting.arg("check").arg(&path).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(waiting.stderr.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.contains("pipe.scene: waiting for what is written to this pipe"), "{line}");
    fs::write(&path, "sphere(1);").unwrap();
    let mut said = String::new();
    waiting.stdout.take().unwrap().read_to_string(&mut said).unwrap();
    assert!(waiting.wait().unwrap().success() && said.contains("1 object"), "{said}");
    // What a scene imports is not waited for.
    let scene = folder().join("of-pipe.scene");
    fs::write(&scene, "import(\"pipe.scene\");").unwrap();
    answers("of-pipe.scene", &check(&scene, &[]), "it is no plain file");
}

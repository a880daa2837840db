//! Where nothing can be written.

use std::fs;
use std::process::Stdio;

use super::{BALL, done, fails, folder, ray13, run, scene, text};

#[test]
fn has_exit_code_1_and_leaves_nothing() {
    let (folder, file) = scene("unwritable", BALL);
    let nowhere = folder.join("missing/picture.png");
    fails(&run(&["render", &file, "--format", "png", "-o", nowhere.to_str().unwrap()]), 1);
    fails(&run(&["render", &file, "--format", "png", "-o", folder.to_str().unwrap()]), 1);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "something was left behind");
}

// From an attack on `-o`: a link was replaced by a file, and a private file became readable by all.
#[cfg(unix)]
#[test]
fn goes_through_links_and_keeps_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let (folder, file) = scene("link", BALL);
    let (own, link) = (folder.join("own.levels"), folder.join("link.levels"));
    fs::write(&own, "before").unwrap();
    fs::set_permissions(&own, fs::Permissions::from_mode(0o600)).unwrap();
    symlink(&own, &link).unwrap();
    done(&run(&["render", &file, "--dots", "4x4", "-o", link.to_str().unwrap()]));
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::metadata(&own).unwrap().permissions().mode() & 0o777, 0o600);
    assert_eq!(fs::read_to_string(&own).unwrap().lines().count(), 4);
    let long = folder.join("a".repeat(255));
    done(&run(&["render", &file, "--cells", "4x4", "-o", long.to_str().unwrap()]));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 4, "something was left behind");
}

#[cfg(target_os = "linux")]
#[test]
fn is_a_full_disk() {
    let (_, file) = scene("full", BALL);
    for arguments in [&["render", &file, "--format", "ans"][..], &["scenes"], &["scenes", "die"], &[&file]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = ray13().args(arguments).stdout(full).output().unwrap();
        fails(&output, 1);
    }
    fails(&run(&["render", &file, "-o", "/dev/full"]), 1);
}

#[cfg(unix)]
#[test]
fn is_not_a_reader_that_has_seen_enough() {
    let (_, file) = scene("pipe", BALL);
    // Larger than the buffer of a pipe, so that writing meets the closed end.
    let mut child = ray13()
        .args(["render", &file, "--dots", "600x400", "--format", "levels"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let message = text(&output.stderr);
    assert!(!message.contains("panicked"), "{message}");
    assert_ne!(output.status.code(), Some(101));
    assert_ne!(output.status.code(), Some(2), "{message}");
}

// From a first user: the picture took the place of the scene.
#[test]
fn is_never_the_scene_itself() {
    let (folder, file) = scene("own", BALL);
    let (link, hard) = (folder.join("link.png"), folder.join("hard.txt"));
    let beside = folder.join("beside");
    fs::create_dir(&beside).unwrap();
    let around = beside.join("../given.scene");
    let mut names = vec![file.clone(), around.to_str().unwrap().to_owned()];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&file, &link).unwrap();
        fs::hard_link(&file, &hard).unwrap();
        names.extend([&link, &hard].map(|path| path.to_str().unwrap().to_owned()));
    }
    for read in &names {
        for written in &names {
            let message = fails(&run(&["render", read, "-o", written, "--format", "txt"]), 2);
            assert!(message.contains("a file that the scene is read from"), "{message}");
        }
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), BALL);
}

// From a review: the colours of a mesh were gone, and a picture stood in their file.
#[test]
fn is_never_the_library_of_a_mesh() {
    let folder = folder("library");
    let [mesh, library] = ["part.obj", "part.mtl"].map(|name| folder.join(name));
    fs::write(&mesh, "mtllib part.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    fs::write(&library, "newmtl red\nKd 1 0 0\n").unwrap();
    let [mesh, written] = [&mesh, &library].map(|path| path.to_str().unwrap());
    let linked = folder.join("linked.txt");
    fs::hard_link(&library, &linked).unwrap();
    for written in [written, linked.to_str().unwrap()] {
        let message = fails(&run(&["render", mesh, "-o", written, "--format", "txt"]), 2);
        assert!(message.contains("a file that the scene is read from"), "{message}");
    }
    // A file of that ending that nobody reads is one as any.
    let other = folder.join("other.mtl");
    fs::write(&other, "").unwrap();
    let output = run(&["render", mesh, "-o", other.to_str().unwrap(), "--format", "txt"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(fs::read_to_string(&library).unwrap(), "newmtl red\nKd 1 0 0\n");
}

#[cfg(unix)]
#[test]
fn is_never_the_scene_itself_by_redirection() {
    let (folder, file) = scene("redirected", BALL);
    let read = fs::File::open(&file).unwrap();
    let output = ray13().args(["render", "-", "-o", &file, "--format", "txt"]).stdin(read).output().unwrap();
    fails(&output, 2);
    let appended = fs::File::options().append(true).open(&file).unwrap();
    let output = ray13().args(["render", &file]).stdout(appended).output().unwrap();
    fails(&output, 2);
    assert_eq!(fs::read_to_string(&file).unwrap(), BALL);
    // Another file may be appended to, and a scene inside the program has none.
    let other = folder.join("other.txt");
    for from in [file.as_str(), "die"] {
        let out = fs::File::create(&other).unwrap();
        assert!(ray13().args(["render", from]).stdout(out).status().unwrap().success());
    }
}

#[test]
fn is_not_a_dash() {
    let (folder, file) = scene("dash", BALL);
    let picture = ["render", &file, "--cells", "9x4", "--format", "ans"];
    let output = ray13().args(picture).args(["-o", "-"]).current_dir(&folder).output().unwrap();
    assert_eq!(done(&output), done(&run(&picture)));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "a file was made");
}

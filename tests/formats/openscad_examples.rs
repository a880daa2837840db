//! The examples that OpenSCAD's package brings: which of them open whole, when that program has exported
//! them.

use std::path::{Path, PathBuf};

use ray13::scene::{ReadOptions, read};

use crate::support::openscad::{exported, in_parallel, is_missing};

const FOLDER: &str = "/usr/share/openscad/examples";

/// Those that do not open, and a word of why.
const NOT_YET: [(&str, &str); 1] = [("echo", "empty")];

fn programs() -> Vec<PathBuf> {
    let files = |folder: &Path| -> Vec<PathBuf> {
        let entries = folder.read_dir().into_iter().flatten();
        entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect()
    };
    let all = files(Path::new(FOLDER)).into_iter().flat_map(|folder| files(&folder));
    let mut programs: Vec<PathBuf> =
        all.filter(|file| file.extension().is_some_and(|e| e == "scad")).collect();
    programs.sort();
    programs
}

#[test]
fn the_examples_of_openscad_open_whole() {
    if is_missing() {
        return;
    }
    let programs = programs();
    if programs.is_empty() {
        return eprintln!("skipped: there is nothing in {FOLDER}");
    }
    let found = in_parallel(&programs, |program| {
        let text = exported(program, "csg").expect("OpenSCAD exports its examples");
        let name = program.file_stem().unwrap().to_str().unwrap().to_owned();
        let options = ReadOptions { folder: program.parent().map(Path::to_owned), ..ReadOptions::default() };
        (name.clone(), read(&format!("{name}.csg"), &text, &options).map_err(|errors| errors.to_string()))
    });
    for (name, scene) in found {
        match (scene, NOT_YET.iter().find(|(not_yet, _)| *not_yet == name)) {
            // On a machine without fonts letters are not expected.
            (Err(errors), None) => assert!(errors.contains("no font on this machine"), "{name}: {errors}"),
            (Err(errors), Some((_, why))) => assert!(errors.contains(why), "{name}: {errors}"),
            // What a program wrote is shown without what is missing, with a note.
            (Ok(scene), Some((_, why))) => {
                let is_noted = scene.notes.iter().any(|note| note.contains(why));
                assert!(is_noted, "{name} opens: take it from the list");
            }
            (Ok(scene), None) => {
                let left_out: Vec<_> = scene.notes.iter().filter(|note| note.contains("left out")).collect();
                assert!(left_out.is_empty(), "{name}: {left_out:?}");
            }
        }
    }
}

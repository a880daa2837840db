//! Right files gone wrong, in every format: an answer, no panic, and errors at places within the file.

use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::mesh_files::MeshText;
use super::{check_places, options};
use crate::scene::{Format, ReadOptions, read};

/// What is put into a file.
const PIECES: [&[u8]; 24] = [
    b" ",
    b"\n",
    b"\r\n",
    b"0",
    b"-1",
    b"nan",
    b"inf",
    b"1e308",
    b"1e-320",
    b"4294967295",
    b"99999999999",
    b"#",
    b"\\\n",
    b"/",
    b"f 1 2 3\n",
    b"solid\n",
    b"endsolid",
    b"element face 9\n",
    b"OFF\n",
    b"end_header\n",
    b"\0",
    b"\xff",
    "\u{e4}".as_bytes(),
    b"\x7f\xff\xff\xff",
];

const FORMATS: [Format; 6] =
    [Format::Stl, Format::Off, Format::Ply, Format::Obj, Format::ThreeMf, Format::Amf];

fn changed() -> impl Strategy<Value = Vec<u8>> {
    let change = (any::<Index>(), any::<Index>(), select(&PIECES[..]), 0..5);
    let mesh = prop_oneof![Just(MeshText::brick()), Just(MeshText::tetrahedron())];
    (mesh, any::<Index>(), prop::collection::vec(change, 1..6)).prop_map(|(mesh, file, changes)| {
        let files = mesh.files();
        let mut bytes = files[file.index(files.len())].1.clone();
        for (from, to, piece, kind) in changes {
            let (from, to) = (from.index(bytes.len() + 1), to.index(bytes.len() + 1));
            let (from, to) = (from.min(to), from.max(to));
            match kind {
                // A bit, a piece more, a piece in place, a part less, a part twice.
                0 => bytes.get_mut(from).into_iter().for_each(|byte| *byte ^= 1 << (to % 8)),
                1 => drop(bytes.splice(from..from, piece.iter().copied())),
                2 => drop(bytes.splice(from..(from + piece.len()).min(bytes.len()), piece.iter().copied())),
                3 => drop(bytes.drain(from..to)),
                _ => {
                    let part = bytes[from..to].to_vec();
                    bytes.splice(to..to, part);
                }
            }
        }
        bytes
    })
}

fn answers(bytes: &[u8], options: &ReadOptions) {
    match read("part", bytes, options) {
        Ok(scene) => {
            assert!(!scene.objects.is_empty());
            for object in &scene.objects {
                object.solid.visit(&mut |primitive| {
                    assert!((primitive.material.0 as usize) < scene.materials.len());
                    assert!(
                        primitive.shape.bounds().lo.is_finite() && primitive.shape.bounds().hi.is_finite()
                    );
                });
            }
            scene.meshes.iter().for_each(|facts| assert!(!facts.to_string().is_empty()));
        }
        Err(errors) => check_places(&errors),
    }
}

/// A thousand cases, and a hundred times as many where `RAY13_LONG` is set.
fn config() -> ProptestConfig {
    let times = if std::env::var_os("RAY13_LONG").is_some() { 100 } else { 1 };
    ProptestConfig { cases: 1000 * times, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_changed_file_has_an_answer(bytes in changed()) {
        answers(&bytes, &ReadOptions::default());
        // As another format than it is, too.
        for format in FORMATS {
            answers(&bytes, &ReadOptions { format: Some(format), ..options() });
        }
    }

    #[test]
    fn any_bytes_have_an_answer(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        for format in FORMATS {
            answers(&bytes, &ReadOptions { format: Some(format), ..options() });
        }
    }
}

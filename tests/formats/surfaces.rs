//! `surface`: heights of other files.

use std::fs;
use std::path::PathBuf;

use ray13::scene::{FilesRead, ReadOptions, Scene, Shape, Solid, read};

use crate::support::openscad::{exported, in_parallel, is_missing};

/// A folder with files of heights.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("surfaces-{test}"));
    fs::create_dir_all(folder.join("below")).unwrap();
    fs::write(folder.join("ragged.dat"), "# heights\n1 2 3\n4 5\n\n7 8 9 10\n-3 0 0 2.5\n").unwrap();
    fs::write(folder.join("below/ended.dat"), "5 6\n7 x\n1 2\n").unwrap();
    let mut picture = Vec::new();
    let mut encoder = png::Encoder::new(&mut picture, 3, 2);
    encoder.set_color(png::ColorType::Rgba);
    let dots: Vec<u8> = (0..24_u32).map(|i| (i * 37 % 251) as u8).collect();
    encoder.write_header().unwrap().write_image_data(&dots).unwrap();
    fs::write(folder.join("picture.png"), picture).unwrap();
    folder
}

fn points(scene: &Scene) -> Vec<[f64; 3]> {
    let [object] = &scene.objects[..] else { panic!("{scene:?}") };
    let Solid::Primitive(primitive) = &object.solid else { panic!("{object:?}") };
    let Shape::Mesh(mesh) = &primitive.shape else { panic!("{primitive:?}") };
    mesh.points.iter().map(|&p| primitive.map.transform_point3(p).to_array()).collect()
}

#[test]
fn heights_are_those_of_openscad() {
    if is_missing() {
        return;
    }
    let folder = folder("openscad");
    let texts = [
        "surface(file = \"ragged.dat\");",
        "surface(\"below/ended.dat\", center = true);",
        "surface(\"picture.png\", invert = true);",
    ];
    in_parallel(&texts, |text| {
        let name = text.chars().filter(char::is_ascii_alphabetic).collect::<String>();
        let program = folder.join(format!("{name}.scad"));
        fs::write(&program, text).unwrap();
        let stl = String::from_utf8(exported(&program, "stl").unwrap()).unwrap();
        let options = ReadOptions { folder: Some(folder.clone()), ..ReadOptions::default() };
        let own = points(&read("surface.csg", text.as_bytes(), &options).unwrap());
        let vertices = stl.lines().filter_map(|line| line.trim().strip_prefix("vertex "));
        let mut count = 0;
        for vertex in vertices {
            let vertex: Vec<f64> = vertex.split(' ').map(|number| number.parse().unwrap()).collect();
            let off = |p: &[f64; 3]| (0..3).map(|i| (p[i] - vertex[i]).abs()).fold(0.0, f64::max);
            // STL has six digits of numbers up to a hundred.
            assert!(own.iter().any(|p| off(p) < 1e-3), "{text}: nothing is at {vertex:?}");
            count += 1;
        }
        assert!(count > 20, "{text}: {stl}");
    });
}

#[test]
fn only_files_of_the_folder_are_read_and_each_is_known() {
    let folder = folder("files");
    let files = FilesRead::default();
    let inside =
        ReadOptions { folder: Some(folder.clone()), files: Some(files.clone()), ..ReadOptions::default() };
    let nowhere = ReadOptions::default();
    for (text, options, word) in [
        ("surface(\"../other/ragged.dat\");", &inside, "outside of the scene's folder"),
        ("surface(\"/etc/passwd\");", &inside, "outside of the scene's folder"),
        ("surface(\"none.dat\");", &inside, "`none.dat`"),
        ("surface(\"below\");", &inside, "no plain file"),
        ("surface(\"ragged.dat\");", &nowhere, "in which folder the scene lies"),
        ("surface(\"\");", &inside, "double quotes"),
        ("surface();", &inside, "needs `file`"),
    ] {
        let errors = read("test", text.as_bytes(), options).expect_err(text).to_string();
        assert!(errors.contains(word) && errors.starts_with("test:1:"), "{errors}");
        // What a program wrote is shown without it.
        let rest = format!("cube(1); {text}");
        assert_eq!(read("test.csg", rest.as_bytes(), options).map(|scene| scene.objects.len()), Ok(1));
    }
    let scene =
        read("test", b"surface(\"below/ended.dat\", convexity = 3, timestamp = 7);", &inside).unwrap();
    assert!(scene.notes[0].contains("up to its line 2"), "{:?}", scene.notes);
    assert!(
        files.all().contains(&folder.join("below/ended.dat"))
            && files.all().contains(&folder.join("none.dat"))
    );
}

#[test]
fn a_surface_for_which_there_is_no_room_is_refused() {
    let folder = folder("memory");
    let row = "1 ".repeat(300) + "\n";
    fs::write(folder.join("large.dat"), row.repeat(300)).unwrap();
    let options =
        ReadOptions { folder: Some(folder.clone()), memory: Some(20 << 20), ..ReadOptions::default() };
    let errors = read("test", b"surface(\"large.dat\");", &options).unwrap_err().to_string();
    assert!(errors.contains("room"), "{errors}");
    fs::write(folder.join("endless.dat"), "1 ".repeat(1 << 20) + &"\n1".repeat(1 << 20)).unwrap();
    let options = ReadOptions { folder: Some(folder), ..ReadOptions::default() };
    let errors = read("test", b"surface(\"endless.dat\");", &options).unwrap_err().to_string();
    assert!(errors.contains("room"), "{errors}");
}

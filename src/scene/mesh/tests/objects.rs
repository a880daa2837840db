//! 3MF and AMF: objects made of objects, units, colours, and archives.

use super::mesh_files::{MeshText, three_mf, zip};
use super::{all_refused, facts, refused, scene};
use crate::math::DVec3;
use crate::scene::{ReadOptions, Scene, Solid, read};

fn parts(scene: &Scene) -> Vec<(Option<&str>, DVec3, DVec3)> {
    let mut parts = Vec::new();
    for object in &scene.objects {
        if let Solid::Primitive(primitive) = &object.solid {
            let bounds = primitive.shape.bounds();
            parts.push((object.name.as_deref(), bounds.lo, bounds.hi));
        }
    }
    parts
}

/// The brick as object 7, with these other objects, and this list of what is built.
fn model(objects: &str, items: &str) -> String {
    let brick = MeshText::brick().model();
    brick.replace("</resources>", &format!("{objects}</resources>")).replace("<item objectid=\"7\"/>", items)
}

#[test]
fn units_are_told() {
    let brick = MeshText::brick();
    assert!(facts("a", &brick.three_mf()).to_string().starts_with("3MF, z up, in millimeter: 12 triangles"));
    assert!(facts("a", brick.amf().as_bytes()).to_string().starts_with("AMF, z up, in inch: 12 triangles"));
}

#[test]
fn what_is_built_is_objects_in_their_places() {
    let objects = "<object id=\"8\" name=\"two\"><components><component objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>\
                   <component objectid=\"7\" transform=\"0 1 0 -1 0 0 0 0 1 0 20 0\"/></components></object>";
    let items = "<item objectid=\"8\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 5\"/><item objectid=\"7\"/>";
    let scene = scene("a.3mf", &three_mf(&model(objects, items)));
    let at = |lo: [f64; 3], hi: [f64; 3]| (DVec3::from_array(lo), DVec3::from_array(hi));
    let expected = [
        at([-12.0, 0.0, 5.0], [-10.0, 1.5, 8.0]),
        // (x, y) goes to (−y, x + 20), and is mirrored then.
        at([0.0, 20.0, 5.0], [1.5, 22.0, 8.0]),
        at([0.0; 3], [2.0, 1.5, 3.0]),
    ];
    let parts = parts(&scene);
    assert_eq!(parts.iter().map(|&(_, lo, hi)| (lo, hi)).collect::<Vec<_>>(), expected);
    assert_eq!(parts.iter().map(|part| part.0).collect::<Vec<_>>(), [Some("two"), Some("two"), None]);
    // What is mirrored is not inside out.
    assert!(scene.meshes.iter().all(|facts| facts.volume == Some(9.0)), "{:?}", scene.meshes);
}

#[test]
fn objects_of_other_files_of_the_archive_are_read() {
    let root = "<model xmlns:p=\"x\"><resources><object id=\"1\"><components><component p:path=\"/3D/Objects/a.model\" \
                objectid=\"7\"/></components></object></resources><build><item objectid=\"1\"/></build></model>";
    let other = MeshText::brick().model();
    let files =
        [("[Content_Types].xml", "<Types/>"), ("3D/3dmodel.model", root), ("3d/objects/A.model", &other)];
    let archive = zip(&files.map(|(name, text)| (name, text.as_bytes())));
    assert_eq!(facts("a", &archive).triangles, 12);
    let missing = zip(&[("3D/3dmodel.model", root.as_bytes())]);
    assert!(refused("a", &missing).contains("the archive has no `3D/Objects/a.model`"));
}

#[test]
fn colours_are_those_of_groups() {
    let colors = "<basematerials id=\"1\"><base name=\"dark\" displaycolor=\"#000000FF\"/><base name=\"light\" \
                  displaycolor=\"#FFFFFF\"/></basematerials>";
    let colored = |object: &str| {
        let model = MeshText::brick()
            .model()
            .replace("<object id=\"7\"", &format!("{colors}<object id=\"7\" {object}"));
        scene("a.3mf", &three_mf(&model))
    };
    let scene = colored("pid=\"1\" pindex=\"1\"");
    let mut color = None;
    scene.objects[0].solid.visit(&mut |it| color = Some(scene.materials[it.material.0 as usize].color));
    assert_eq!(color, Some(DVec3::ONE));
    // A group or a place in it that there is not is none.
    assert_eq!(colored("pid=\"9\" pindex=\"1\"").objects.len(), 1);
    let amf = MeshText::brick()
        .amf()
        .replace("<volume>", "<volume materialid=\"2\">")
        .replace("</amf>", "<material id=\"2\"><color><r>0.25</r><g>1</g><b>7</b></color></material></amf>");
    let scene = super::scene("a.amf", amf.as_bytes());
    scene.objects[0].solid.visit(&mut |it| color = Some(scene.materials[it.material.0 as usize].color));
    assert_eq!(color, Some(DVec3::new(0.25, 1.0, 1.0)));
}

#[test]
fn constellations_place_objects() {
    let amf = MeshText::brick().amf().replace(
        "</amf>",
        "<constellation id=\"5\"><instance objectid=\"0\"><deltax>10</deltax><rz>90</rz></instance>\
         <instance objectid=\"0\"><deltaz>-4</deltaz></instance></constellation></amf>",
    );
    let scene = scene("a.amf", amf.as_bytes());
    let bounds: Vec<_> = parts(&scene).iter().map(|&(_, lo, hi)| (lo.to_array(), hi.to_array())).collect();
    assert_eq!(bounds, [([8.5, 0.0, 0.0], [10.0, 2.0, 3.0]), ([0.0, 0.0, -4.0], [2.0, 1.5, -1.0])]);
}

/// Two of two of two, thirty times over, are a thousand million bricks.
#[test]
fn objects_that_multiply_are_bounded() {
    let doubled: String = (8..40)
        .map(|id| {
            let component = format!("<component objectid=\"{}\"/>", id - 1);
            format!("<object id=\"{id}\"><components>{component}{component}</components></object>")
        })
        .collect();
    let built = |id: i32, memory| {
        let file = three_mf(&model(&doubled, &format!("<item objectid=\"{id}\"/>")));
        read("a.3mf", &file, &ReadOptions { memory, ..ReadOptions::default() })
            .map(|scene| scene.objects.len())
    };
    assert_eq!(built(10, None), Ok(8));
    assert!(built(39, None).unwrap_err().to_string().contains("more corners or faces than can be numbered"));
    assert!(built(20, Some(4 << 20)).unwrap_err().to_string().contains("--memory"));
}

#[test]
fn an_archive_that_is_a_bomb_is_refused() {
    let bomb = vec![b' '; 20 << 20];
    let file = zip(&[("a", b"a"), ("3D/3dmodel.model", &bomb)]);
    assert!(file.len() < 1 << 20);
    let options = ReadOptions { memory: Some(2 << 20), ..ReadOptions::default() };
    let told = read("a.3mf", &file, &options).unwrap_err().to_string();
    assert!(told.contains("`3D/3dmodel.model` in the archive takes more than"), "{told}");
}

#[test]
fn hostile_three_mf_is_refused() {
    let brick = MeshText::brick().model();
    let with = |from: &str, to: &str| {
        assert!(brick.contains(from));
        three_mf(&brick.replacen(from, to, 1))
    };
    let whole = MeshText::brick().three_mf();
    let stored = zip(&[("3D/3dmodel.model", brick.as_bytes())]);
    let damaged = {
        let mut bytes = stored.clone();
        let at = bytes.windows(8).position(|window| window == b"<vertex ").unwrap();
        bytes[at + 4] ^= 1;
        bytes
    };
    let directory = whole.windows(4).position(|window| window == b"PK\x01\x02").unwrap();
    let changed = |at: usize, byte: u8| {
        let mut bytes = whole.clone();
        bytes[directory + at] = byte;
        bytes
    };
    let nested = format!("<model>{}", "<a>".repeat(100_000));
    let entity = "<!DOCTYPE m [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><model>";
    let itself = "<object id=\"8\"><components><component objectid=\"8\"/></components></object>";
    let files: Vec<(Vec<u8>, &str)> = vec![
        (whole[..100].to_vec(), "ZIP archive without a model in it, or cut off"),
        (whole[..whole.len() - 1].to_vec(), "cut off"),
        (stored[20..].to_vec(), "the directory of the ZIP archive"),
        (damaged, "`3D/3dmodel.model` in the archive is damaged"),
        (changed(8, 1), "is encrypted"),
        (changed(10, 14), "compressed by method 14"),
        (changed(42, 0xff), "`_rels/.rels` in the ZIP archive"),
        (changed(20, 0xff), "damaged"),
        (changed(16, 0xff), "damaged"),
        (zip(&[("a.model", b"")]), "the archive has no `3D/3dmodel.model`"),
        (three_mf(""), "an element `model` is expected"),
        (three_mf("<html></html>"), "an element `model` is expected"),
        (three_mf("no xml"), "an element `model` is expected"),
        (three_mf("<model>"), "the file is cut off: it ends where the end of an element"),
        (three_mf("<model></mesh>"), "this is no XML"),
        (three_mf(&nested), "nested deeper than 256"),
        (three_mf(entity), "a document type, which may define entities"),
        (with("<resources>", "<resources>&lol;"), "an entity `lol`"),
        (with("<model ", "<model \u{0} x=<"), "no XML"),
        (three_mf("<model/>"), "no triangles"),
        (with("v1=\"0\"", "v1=\"99\""), "3D/model.model, line 6: a face names corner 99"),
        (with("v1=\"0\"", "v1=\"-1\""), "a face names corner -1"),
        (with("v1=\"0\"", "v1=\"99999999999999999999\""), "`v1` is no number"),
        (with("v1=\"0\"", "v1=\"0.5\""), "`v1` is no number"),
        (with("v1=\"0\" ", ""), "an attribute `v1` is expected"),
        (with("x=\"2\"", "x=\"nan\""), "`x` is not a finite number"),
        (with("x=\"2\"", "x=\"1e999\""), "`x` is not a finite number"),
        (with("x=\"2\"", "x=\"1e306\""), "farther than 1e305"),
        (with("x=\"2\"", "x=\"2,5\""), "`x` is no number"),
        (
            with("<item objectid=\"7\"/>", "<item objectid=\"5\"/>"),
            "an object `5` is named, which there is not",
        ),
        (with("<item objectid=\"7\"/>", ""), "no triangles"),
        (with("objectid=\"7\"", "objectid=\"7\" transform=\"1 0 0\""), "twelve numbers in `transform`"),
        (with("objectid=\"7\"", "objectid=\"7\" transform=\"0 0 0 0 0 0 0 0 0 0 0 0\""), "flattens"),
        (with("objectid=\"7\"", "objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\""), "flattens"),
        (
            with("objectid=\"7\"", "objectid=\"7\" transform=\"1e300 0 0 0 1e300 0 0 0 1e300 1e308 0 0\""),
            "farther",
        ),
        (three_mf(&model(itself, "<item objectid=\"8\"/>")), "objects are made of each other"),
    ];
    let files: Vec<(&[u8], &str)> = files.iter().map(|(bytes, says)| (&bytes[..], *says)).collect();
    all_refused("a.3mf", &files);
}

#[test]
fn hostile_amf_is_refused() {
    let brick = MeshText::brick().amf();
    let with = |from: &str, to: &str| {
        assert!(brick.contains(from), "{from}");
        brick.replacen(from, to, 1)
    };
    let circle = "<constellation id=\"1\"><instance objectid=\"2\"/></constellation><constellation id=\"2\"><instance \
                  objectid=\"1\"/></constellation><constellation id=\"3\"><instance objectid=\"1\"/></constellation></amf>";
    let itself = "<constellation id=\"5\"><instance objectid=\"5\"/></constellation></amf>";
    let files: Vec<(String, &str)> = vec![
        (brick[..brick.len() / 2].to_owned(), "not found before end of input"),
        ("<amf>".to_owned(), "the file is cut off"),
        ("<amf></amf>".to_owned(), "no triangles"),
        ("<amf/>".to_owned(), "no triangles"),
        ("<amf><object id=\"1\"></amf>".to_owned(), "a.amf:1:21: error: this is no XML"),
        ("<amf><".to_owned(), "this is no XML"),
        ("<amf a='>".to_owned(), "this is no XML"),
        ("<amf>&bomb;</amf>".to_owned(), "an entity `bomb`"),
        ("<!DOCTYPE amf [<!ENTITY a \"b\">]><amf>&a;</amf>".to_owned(), "a document type"),
        (format!("<amf>{}", "<a>".repeat(1000)), "nested deeper than 256"),
        ("<html/>".to_owned(), "an element `amf` is expected"),
        (String::new(), "an element `amf` is expected"),
        (with("<x>2</x>", "<x>nan</x>"), "`x` is not a finite number"),
        (with("<x>2</x>", "<x>inf</x>"), "`x` is not a finite number"),
        (with("<x>2</x>", "<x>1e306</x>"), "farther than 1e305"),
        (with("<x>2</x>", "<x/>"), "`x` is no number"),
        (with("<x>2</x>", "<x>2 3</x>"), "`x` is no number"),
        (with("<v1>0</v1>", "<v1>8</v1>"), "a face names corner 8"),
        (with("<v1>0</v1>", "<v1>-1</v1>"), "a face names corner -1"),
        (with("<v1>0</v1>", "<v1>4294967296</v1>"), "a face names corner 4294967296"),
        (with("<v1>0</v1>", "<v1>1.5</v1>"), "`v1` is no number"),
        (with("<v1>0</v1>", ""), "`v1`, `v2` and `v3` of a triangle"),
        (brick.replace("<v1>", "<v3>").replace("</v1>", "</v3>"), "`v1`, `v2` and `v3`"),
        (
            with("</amf>", "<constellation id=\"5\"><instance objectid=\"9\"/></constellation></amf>"),
            "an object `9`",
        ),
        (with("</amf>", circle), "objects are made of each other"),
        (with("</amf>", itself), "objects are made of each other"),
        (brick.replace("<vertices>", "<other>").replace("</vertices>", "</other>"), "there are no corners"),
    ];
    let files: Vec<(&[u8], &str)> = files.iter().map(|(text, says)| (text.as_bytes(), *says)).collect();
    all_refused("a.amf", &files);
}

//! Anything at all as input: an answer, no panic, and places inside the text.

use proptest::prelude::*;

use super::polyhedra::six_volumes;
use super::primitives;
use crate::scene::{Diagnostics, ReadOptions, Scene, Shape, read};

/// Reads with and without leaving words out, and checks what every answer must keep.
fn check(bytes: &[u8]) {
    for skip_unsupported in [false, true] {
        let options = ReadOptions { skip_unsupported, ..ReadOptions::default() };
        match read("test", bytes, &options) {
            Ok(scene) => check_scene(&scene),
            Err(errors) => check_places(&errors),
        }
    }
}

fn check_scene(scene: &Scene) {
    assert!(!scene.objects.is_empty());
    for primitive in primitives(scene) {
        assert!(primitive.map.is_finite() && (primitive.material.0 as usize) < scene.materials.len());
        if let Shape::Mesh(mesh) = &primitive.shape {
            six_volumes(mesh);
        }
    }
}

fn check_places(errors: &Diagnostics) {
    assert!(!errors.list.is_empty() && !errors.to_string().is_empty());
    for diagnostic in &errors.list {
        assert!(errors.source.get(diagnostic.span.clone()).is_some(), "{diagnostic:?}");
    }
}

/// Pieces of the language, right and wrong, that a text is put together from.
const PIECES: &[&str] = &[
    "cube(1);",
    "cube",
    "sphere(2);",
    "sphere",
    "cylinder",
    "cone(",
    "polyhedron(",
    "patches(",
    "patch(",
    "union()",
    "difference()",
    "intersection()",
    "group()",
    "translate([1,2,3])",
    "rotate(",
    "scale(",
    "mirror(",
    "multmatrix(",
    "color(",
    "material(",
    "object(",
    "camera(",
    "light(",
    "world(",
    "hull()",
    "minkowski()",
    "linear_extrude(2)",
    "linear_extrude(2,twist=90,scale=0)",
    "rotate_extrude()",
    "offset(",
    "projection()",
    "resize([1,2,3])",
    "circle(",
    "square(",
    "polygon(",
    "for",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    "=",
    "*",
    "!",
    "#",
    "%",
    "-",
    "+",
    "<",
    "1",
    "0",
    "-1",
    "1e308",
    "1e999",
    "1e-320",
    ".5",
    "2mm",
    "true",
    "undef",
    "\"a\"",
    "\"",
    "\\",
    "//",
    "/*",
    "*/",
    "\n",
    " ",
    "é",
    "“",
    "$fn",
    "$fn=5;",
    "$fx",
    "at",
    "semi",
    "r1",
    "h",
    "points",
    "faces",
    "[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]",
    "[[0,1,2],[0,3,1],[1,3,2],[2,3,0]]",
    "eye",
    "name",
];

proptest! {
    #[test]
    fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        check(&bytes);
    }

    #[test]
    fn random_text(text in "\\PC{0,100}") {
        check(text.as_bytes());
    }

    #[test]
    fn random_pieces(pieces in proptest::collection::vec(proptest::sample::select(PIECES), 0..40)) {
        check(pieces.concat().as_bytes());
    }

    #[test]
    fn random_arguments(
        word in proptest::sample::select(&["cube", "sphere", "cylinder", "cone", "scale", "rotate", "translate",
            "mirror", "color", "multmatrix", "camera", "light", "world", "material", "polyhedron"][..]),
        names in proptest::collection::vec(proptest::sample::select(&["", "r=", "h=", "r1=", "d=", "at=", "semi=",
            "v=", "a=", "c=", "m=", "eye=", "target=", "up=", "field=", "name=", "k=", "$fn=", "center="][..]), 0..5),
        values in proptest::collection::vec(prop_oneof![
            any::<f64>().prop_map(|number| format!("{number:e}")),
            proptest::array::uniform3(any::<f64>()).prop_map(|numbers| format!("{numbers:?}")),
            Just("true".to_owned()), Just("[40, 25]".to_owned()), Just("\"red\"".to_owned()), Just("7".to_owned()),
        ], 5),
    ) {
        let arguments: Vec<String> = names.iter().zip(&values).map(|(name, value)| format!("{name}{value}")).collect();
        let arguments = arguments.join(", ");
        check(format!("{word}({arguments}); cube(1);").as_bytes());
        check(format!("{word}({arguments}) cube(1);").as_bytes());
    }

    #[test]
    fn random_polyhedra(
        points in proptest::collection::vec(proptest::array::uniform3(0..3i32), 4..10),
        faces in proptest::collection::vec(proptest::collection::vec(0..4usize, 3..9), 1..6),
    ) {
        check(format!("polyhedron({points:?}, {faces:?});").as_bytes());
    }

    #[test]
    fn a_pyramid_on_any_polygon_is_closed(
        points in proptest::collection::vec([0..4i32, 0..4i32], 5..10),
        polygon in proptest::collection::vec(0..5usize, 3..12),
    ) {
        // The base may cross itself, touch itself, lie on a line and name a point many times.
        let apex = points.len();
        let places: Vec<_> = points.iter().map(|[x, y]| [*x, *y, 0]).chain([[1, 1, 5]]).collect();
        let sides = (0..polygon.len()).map(|i| vec![polygon[i], polygon[(i + 1) % polygon.len()], apex]);
        let faces: Vec<_> = sides.chain([polygon.clone()]).collect();
        match read("test", format!("polyhedron({places:?}, {faces:?});").as_bytes(), &ReadOptions::default()) {
            Ok(scene) => check_scene(&scene),
            Err(errors) => prop_assert!(errors.to_string().contains("enclose nothing"), "{errors}"),
        }
    }
}

#[test]
fn a_megabyte_of_anything() {
    const SIZE: usize = 1 << 20;
    let identifier = "x".repeat(SIZE);
    for text in [
        "(".repeat(SIZE),
        format!("cube({}", "(".repeat(SIZE)),
        format!("{identifier}(1);"),
        format!("cube({identifier} = 1);"),
        format!("material(\"{identifier}\") cube(1);"),
        "!".repeat(SIZE),
        format!("cube({}1);", "-".repeat(SIZE)),
        format!("cube({});", "1".repeat(SIZE)),
        "%cube();".repeat(SIZE / 8),
        "nonsense();".repeat(SIZE / 11),
        format!("{}{}{}", "difference(){sphere();".repeat(500), "cube();".repeat(SIZE / 8), "}".repeat(500)),
        format!("{}{}{}", "intersection(){cube();".repeat(500), "cube();".repeat(SIZE / 8), "}".repeat(500)),
        format!("polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0]], [[{}]]);", "0,2,1,3,".repeat(SIZE / 8)),
        format!("polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0]], [{}]);", "[0,2,1,3],".repeat(SIZE / 10)),
    ] {
        check(text.as_bytes());
    }
}

//! Parts that are wrong in themselves: left out of what a program wrote, an error in what a person wrote.
//!
//! Of 844 files that OpenSCAD had written 23 were refused for one such part each, all the rest of them with
//! it.

use super::structured;
use crate::math::DVec3;
use crate::scene::{Diagnostics, ReadOptions, Scene, read};

const BALL: &str = "sphere($fn = 0, $fa = 12, $fs = 2, r = 3);";
const PYRAMID: &str = "points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [2, 2, 5]";

fn skipping(name: &str, text: &str) -> Result<Scene, Diagnostics> {
    read(name, text.as_bytes(), &ReadOptions { skip_unsupported: true, ..ReadOptions::default() })
}

/// What is left of a program's file, and what is said of it; the same as is left of a person's file on
/// demand, which is an error otherwise.
fn left(text: &str) -> (String, Vec<String>) {
    let scene = read("part.csg", text.as_bytes(), &ReadOptions::default())
        .unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    assert!(!scene.notes.is_empty(), "{text}: nothing is said of what is left out");
    assert!(read("part.scene", text.as_bytes(), &ReadOptions::default()).is_err(), "{text}");
    let left = skipping("part.scene", text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    assert_eq!((&left.objects, &left.notes), (&scene.objects, &scene.notes), "{text}");
    (structured(&scene), scene.notes)
}

/// Whether `text` beside a ball leaves just the ball.
fn leaves_the_ball(text: &str, said: &str) {
    let (structure, notes) = left(&format!("{BALL}\n{text}"));
    assert_eq!(structure, "a", "{text}");
    assert!(notes[0].starts_with("line 2: ") && notes[0].contains(said), "{text}: {notes:?}");
}

#[test]
fn a_solid_of_no_size() {
    for leaf in [
        "cube(size = [0, 0, 0]);",
        "cube(size = [-3, 2, 2]);",
        "cube(size = [1, nan, 1]);",
        "cube(size = -inf);",
    ] {
        leaves_the_ball(leaf, "`cube` is left out: `size`");
    }
    for leaf in ["sphere(r = 0);", "sphere(r = -1);", "sphere(r = nan);", "sphere(r = 1e999);"] {
        leaves_the_ball(leaf, "`sphere` is left out: `r`");
    }
    for leaf in [
        "cylinder(h = 0, r1 = 2, r2 = 2);",
        "cylinder(h = inf, r1 = 1, r2 = 1);",
        "cylinder(h = 1, r1 = -1, r2 = 1);",
        "cylinder(h = 5, r1 = 0, r2 = 0);",
        "cylinder(h = 5, r1 = 1, r2 = nan);",
    ] {
        leaves_the_ball(leaf, "`cylinder` is left out");
    }
}

#[test]
fn a_solid_of_no_size_is_empty_as_in_openscad() {
    let bad = "cube(size = [0, 0, 0]);";
    assert_eq!(left(&format!("difference() {{ {BALL} {bad} cube(1); }}")).0, "(a - b)");
    assert_eq!(left(&format!("{BALL} difference() {{ {bad} cube(1); }}")).0, "a");
    assert_eq!(left(&format!("{BALL} intersection() {{ {bad} cube(1); }}")).0, "a");
    assert_eq!(left(&format!("difference() {{ union() {{ {bad} {BALL} }} cube(1); }}")).0, "(a - b)");
}

#[test]
fn a_map_that_is_no_number_or_makes_flat() {
    for map in [
        "scale([1, 1, 0])",
        "translate([nan, 0, 0])",
        "rotate(inf)",
        "rotate([0, nan, 0])",
        "mirror([inf, 0, 0])",
    ] {
        leaves_the_ball(&format!("{map} {{ cube(1); roof() cube(1); }}"), "holds is left out");
    }
    for row in ["[0, 0, 0, 0]", "[nan, nan, nan, nan]", "[1, 0, 0, 0]", "[0, 0, -inf, 0]"] {
        let map = format!("multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], {row}, [0, 0, 0, 1]])");
        leaves_the_ball(&format!("{map} {{ cube(1); }}"), "what `multmatrix` holds is left out");
        assert_eq!(left(&format!("difference() {{ {BALL} {map} cube(1); }}")).0, "a");
    }
    leaves_the_ball("scale([1e200, 1, 1]) scale([1e200, 1, 1]) cube(1);", "multiply to more");
    leaves_the_ball("translate([1e306, 0, 0]) cube(1);", "reaches farther");
}

#[test]
fn a_polyhedron_that_is_none() {
    let of = |points: &str, faces: &str| {
        format!("polyhedron({PYRAMID}{points}], faces = [{faces}], convexity = 1);")
    };
    let open = of("", "[0, 1, 4], [2, 1, 4], [2, 3, 4], [0, 3, 4]");
    leaves_the_ball(&open, "not closed: nothing meets its edge from [0, 0, 0] to [4, 0, 0]");
    let t_junction = of(", [2, 0, 0]", "[0, 1, 2, 3], [0, 5, 4], [5, 1, 4], [2, 1, 4], [2, 3, 4], [0, 3, 4]");
    leaves_the_ball(&t_junction, "not closed");
    let high = of("", "[0, 1, 2, 3], [0, 1, 4], [2, 1, 4], [2, 3, 4], [0, 3, 9]");
    leaves_the_ball(&high, "a face names a point that there is not: this is the number 9");
    leaves_the_ball("polyhedron(points = [], faces = [], convexity = 1);", "enclose nothing");
    leaves_the_ball("polyhedron(points = undef, faces = undef, convexity = 1);", "needs `points`");
    leaves_the_ball(&of("", "undef"), "takes a list of faces");
    leaves_the_ball(&of(", [0, 0, nan]", "[0, 1, 2]"), "no place");
    // Of a face that is none the rest may well be closed.
    let two = of("", "[0, 1, 2, 3], [0, 1, 4], [2, 1, 4], [2, 3, 4], [0, 3, 4], [0, 1]");
    assert_eq!(left(&two).0, "a");
    // OpenSCAD shows an open one as a surface: it is not nothing.
    assert_eq!(left(&format!("{BALL} intersection() {{ {open} cube(1); }}")).0, "a");
    let (structure, notes) = left(&format!("difference() {{\n cube(1);\n {open} }}"));
    assert_eq!(structure, "a");
    assert_eq!(notes[1], "line 3: a hole of `difference` stays filled: what cuts it is left out");
}

#[test]
fn points_are_welded_where_that_closes_a_polyhedron() {
    // OpenSCAD wrote 8.88e-15 beside 0; to it both are one place of its grid.
    let text = format!(
        "polyhedron({PYRAMID}, [4, 8.88178e-15, 0]], faces = [[3, 2, 1, 0], [0, 1, 4], [5, 2, 4], [2, 3, 4], [3, 0, 4]]);"
    );
    for name in ["part.csg", "part.scene"] {
        let scene = read(name, text.as_bytes(), &ReadOptions::default()).expect("a pyramid");
        assert!(scene.notes[0].contains("2^-20"), "{:?}", scene.notes);
    }
    let far = text.replace("8.88178e-15", "3e-6");
    assert!(
        read("part.scene", far.as_bytes(), &ReadOptions::default()).is_err(),
        "three cells away is another place"
    );
    // On the line between two cells, with its twin beyond it.
    let astride = text.replace("8.88178e-15", "-4.7683716e-7");
    assert!(read("part.scene", astride.as_bytes(), &ReadOptions::default()).is_ok());
}

#[test]
fn a_colour_above_1_is_clamped() {
    let (_, notes) = left("color([255, 128, 0, 1]) cube(1);");
    assert_eq!(notes, ["line 1: a colour of `color` is clamped to the range from 0 to 1"]);
    let scene = skipping("part.scene", "color([255, -3, nan], alpha = 7) cube(1);").expect("a scene");
    assert_eq!(scene.materials[0].color, DVec3::X);
    assert_eq!(scene.materials[0].kt, 0.0);
}

#[test]
fn variables_of_openscad_are_passed_over() {
    let text = "$t = 0; $fn = 6; group($preview = true) { cube(size = 1, $my = [1, 2]); }";
    let scene = read("part.csg", text.as_bytes(), &ReadOptions::default()).expect("a scene");
    assert!(scene.notes.is_empty());
    assert!(read("part.scene", text.as_bytes(), &ReadOptions::default()).is_err());
}

#[test]
fn an_operator_does_not_show_what_was_never_meant() {
    let shown = |text: &str| {
        structured(&skipping("part.csg", text).unwrap_or_else(|errors| panic!("{text}\n{errors}")))
    };
    let notes = |text: &str| skipping("part.csg", text).expect("a scene").notes;
    let unknown = "roof() { circle(r = 5); }";
    assert_eq!(shown(&format!("{BALL} intersection() {{ {unknown} cube(1); }}")), "a");
    assert_eq!(shown(&format!("{BALL} intersection() {{ group() {{ {unknown} }} cube(1); }}")), "a");
    assert_eq!(shown(&format!("{BALL} intersection() {{ cube(1); translate([1, 0, 0]) {unknown} }}")), "a");
    assert_eq!(shown(&format!("{BALL} difference() {{ {unknown} cube(1); }}")), "a");
    assert_eq!(
        shown(&format!("{BALL} difference() {{ intersection() {{ {unknown} cube(1); }} cube(1); }}")),
        "a"
    );
    assert_eq!(shown(&format!("union() {{ {unknown} cube(1); }}")), "a");
    // What is nothing anyway is nothing, whatever else is missing.
    let empty = format!("difference() {{ {BALL} intersection() {{ {unknown} cube(0); }} }}");
    assert_eq!(notes(&empty).len(), 2, "no hole is missing");
    let holes =
        format!("difference() {{\n cube(1);\n {unknown}\n sphere(1);\n group() {{ {unknown} cube(1); }}\n}}");
    assert_eq!(shown(&holes), "(a - b - c)");
    assert_eq!(
        notes(&holes)[1..],
        [
            "line 3: a hole of `difference` stays filled: what cuts it is left out",
            "line 5: a hole of `difference` is not as it was meant: a part of what cuts it is left out"
        ]
    );
    assert!(notes(&format!("{BALL} intersection() {{ {unknown} cube(1); }}"))[1].contains("left out whole"));
}

#[test]
fn what_a_program_wrote_wrong_a_thousand_times_is_said_once() {
    let text = format!("{BALL}\n{}", "cube(size = [1, 0, 1]);\n".repeat(30_000));
    let scene = read("part.csg", text.as_bytes(), &ReadOptions::default()).expect("a ball");
    let [note] = &scene.notes[..] else { panic!("{:?}", scene.notes) };
    assert!(note.starts_with("line 2: `cube` is left out: `size` of `cube` takes"), "{note}");
    assert!(note.contains("(30000 times, in lines 2, 3, 4, 5 and on)"), "{note}");
}

#[test]
fn a_scene_in_which_nothing_is_left_says_why() {
    let text = format!("sphere(r = 0);\n{}", "cube(size = 0);\n".repeat(30));
    let errors = read("part.csg", text.as_bytes(), &ReadOptions::default()).expect_err("nothing").to_string();
    assert!(errors.starts_with(
        "part.csg: error: the scene is empty: nothing is left to see in it\n  help: `sphere` is left out"
    ));
    assert!(errors.contains("part.csg:1:12: note: `sphere` is left out"), "{errors}");
    assert!(!errors.contains("add a solid"), "{errors}");
}

#[test]
fn standard_input_is_known_by_what_openscad_writes() {
    let of = |text: &str| read("standard input", text.as_bytes(), &ReadOptions::default());
    assert!(of(&format!("{BALL} cube(0);")).is_ok());
    assert!(of("sphere(3); cube(0);").is_err());
}

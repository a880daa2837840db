//! What is told of a ray, and that it is the picture's.

use serde_json::Value;

use super::{done, fails, run, text};

/// A plane mirror, a solid with a hole, and glass.
const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/follow.scene");

/// With as many dots as in `docs/follow.md`.
fn follow(column: u32, row: u32, options: &[&str]) -> Vec<String> {
    let [column, row] = [column, row].map(|number| number.to_string());
    let all = ["follow", SCENE, &column, &row, "--cells", "64x24", "--structure", "lattice"];
    [&all[..], options].concat().iter().map(|&word| word.to_owned()).collect()
}

fn told(column: u32, row: u32, options: &[&str]) -> String {
    let all = follow(column, row, options);
    text(&done(&run(&all.iter().map(String::as_str).collect::<Vec<_>>())))
}

#[test]
fn each_stage_tells_what_it_makes_of_the_ray() {
    for (name, [column, row]) in [
        ("a miss", [2, 2]),
        ("a mirror", [64, 80]),
        ("a hole", [34, 48]),
        ("a difference", [26, 50]),
        ("glass", [90, 44]),
        ("a shadow", [28, 66]),
    ] {
        insta::assert_snapshot!(name.to_owned(), told(column, row, &[]));
    }
}

/// The page computes this ray by hand.
#[test]
fn the_page_has_what_is_printed() {
    let page = include_str!("../../docs/follow.md");
    assert!(page.contains(&told(64, 80, &[])), "{}", told(64, 80, &[]));
}

#[test]
fn in_json_each_step_has_its_stage_and_the_picture_its_light() {
    let value: Value = serde_json::from_str(&told(64, 80, &["--json"])).unwrap();
    let steps = value["steps"].as_array().unwrap();
    let stages: Vec<_> = steps.iter().map(|step| step["stage"].as_str().unwrap()).collect();
    let order = ["lattice", "view", "ray", "clip", "cell", "solid", "csg", "shade", "dither", "display"];
    let mut at = 0;
    for stage in order {
        at += stages[at..].iter().position(|other| *other == stage).unwrap_or_else(|| panic!("{stage}"));
    }
    assert_eq!(
        (&value["dot"], &value["dots"]),
        (&serde_json::json!([64, 80]), &serde_json::json!([128, 96]))
    );
    let direction: Vec<f64> = serde_json::from_value(value["ray"]["direction"].clone()).unwrap();
    assert!((direction.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-14);
    assert!((value["light"].as_f64().unwrap() - 0.242_852).abs() < 1e-6);
}

#[test]
fn there_are_no_other_dots() {
    let all = follow(128, 5, &[]);
    let message = fails(&run(&all.iter().map(String::as_str).collect::<Vec<_>>()), 2);
    assert!(
        message.contains("there is no dot 128, 5") && message.contains("the last is 127, 95"),
        "{message}"
    );
}

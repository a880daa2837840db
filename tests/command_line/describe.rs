//! What a view shows, in words.

use serde_json::Value;

use super::{done, run, scene, text};

#[test]
fn each_scene_inside_is_told() {
    for name in ["hanyang", "die"] {
        insta::assert_snapshot!(name.to_owned(), text(&done(&run(&["describe", name, "--dots", "160x100"]))));
    }
}

#[test]
fn json_has_the_same_objects() {
    let value: Value =
        serde_json::from_slice(&done(&run(&["describe", "hanyang", "--dots", "160x100", "--json"]))).unwrap();
    let seen = value["seen"].as_array().unwrap();
    let shares: Vec<f64> = seen.iter().map(|object| object["share"].as_f64().unwrap()).collect();
    assert!(shares.is_sorted_by(|one, other| one >= other), "{shares:?}");
    let all = shares.iter().sum::<f64>() + value["background"].as_f64().unwrap();
    assert!((all - 1.0).abs() < 1e-12);
    assert_eq!(seen[0]["name"], "floor");
    // What stands on the floor is nowhere behind it.
    assert!(seen[0]["before"].as_array().unwrap().is_empty(), "{}", seen[0]);
}

/// A name from a file stands in a line of the terminal.
#[test]
fn names_can_not_command_the_terminal() {
    let (_, file) = scene("describe_name", "object(\"a\u{9b}2J\") sphere(1);");
    let told = text(&done(&run(&["describe", &file])));
    assert!(told.contains("\"a\\u{9b}2J\": in the middle"), "{told}");
}

//! What `plan` says, and that the picture does it; what `bench` measures.

use super::{BALL, done, fails, run, scene, text};

#[test]
fn bench_measures() {
    let (_, file) = scene("bench", BALL);
    let table = text(&done(&run(&["bench", &file, "--dots", "16x16"])));
    assert!(table.contains("ms"), "{table}");
    let json = done(&run(&["bench", &file, "--dots", "16x16", "--json"]));
    let figures: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    for key in
        ["frame_ms_min", "frame_ms_median", "rays_per_second", "bytes_per_frame", "objects", "primitives"]
    {
        assert!(figures.get(key).is_some(), "{key} is missing in {figures}");
    }
    assert_eq!((&figures["objects"], &figures["primitives"]), (&1.into(), &1.into()));
}

/// The plan of a scene: a stage or a term by its name → whether it is needed, and why.
fn plan(file: &str, options: &[&str]) -> impl Fn(&str) -> (bool, String) {
    let json = done(&run(&[&["plan", file, "--json"], options].concat()));
    let plan: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let stages = plan["stages"].as_array().expect("stages").clone();
    let names: Vec<&str> = stages.iter().filter_map(|s| s["stage"].as_str()).collect();
    let expected: Vec<String> = ray13::stage::Stage::ALL.iter().map(|s| s.name().to_lowercase()).collect();
    assert_eq!(names, expected);
    let terms = |s: &serde_json::Value| s["terms"].as_array().expect("terms").clone();
    let rows: Vec<serde_json::Value> =
        stages.iter().flat_map(|s| std::iter::once(s.clone()).chain(terms(s))).collect();
    move |name| {
        let row = rows.iter().find(|r| r["stage"] == name || r["name"] == name);
        let row = row.unwrap_or_else(|| panic!("no row {name}"));
        (row["needed"].as_bool().unwrap(), row["why"].as_str().unwrap().to_owned())
    }
}

#[track_caller]
fn says(row: &(bool, String), needed: bool, words: &str) {
    assert!(row.0 == needed && row.1.contains(words), "{row:?}, not {needed}, {words}");
}

#[test]
fn leaves_out_what_a_ball_does_not_require() {
    let (_, file) = scene("plan_ball", BALL);
    let row = plan(&file, &[]);
    says(&row("lattice"), true, "1 object of 1 primitive, traced in tiles → boxes: 1 node");
    says(&row("cell"), true, "side by side");
    says(&row("csg"), false, "no CSG");
    says(&row("clip"), true, "outside the world");
    says(&row("depth"), false, "the world gives no k");
    says(&row("secondary rays"), false, "no mirror or glass → no secondary rays");
    says(&row("highlight"), true, "has ks");
    says(&row("colour"), false, "every light is gray → one channel");
    let row = plan(&file, &["--engine", "exact"]);
    says(&row("lattice"), false, "1 object of 1 primitive → no structure");
    says(&row("cell"), false, "no structure");
    let row = plan(&file, &["--shading", "1", "--no-shadows", "--eye", "0,0,0", "--target", "1,0,0"]);
    says(&row("highlight"), false, "eq. (1) has no such term");
    says(&row("shadow rays"), false, "not wanted");
    says(&row("clip"), false, "the eye is in the world");
}

#[test]
fn takes_in_what_a_scene_requires() {
    let shining = "world(k = 1); light(at = [5, -9, 9], color = [1, 0, 0]);\n\
        material(kr = 0.9) difference() { cube(2); sphere(1); }\n";
    let (_, file) = scene("plan_shining", shining);
    let row = plan(&file, &["--structure", "lattice"]);
    says(&row("lattice"), true, "a lattice is wanted");
    says(&row("sub-lattices"), true, "1 object");
    says(&row("csg"), true, "the only object is made of several primitives");
    says(&row("depth"), true, "k = 1");
    says(&row("secondary rays"), true, "kr");
    says(&row("colour"), true, "a light is coloured → three channels");
    let balls: String = (0..17).map(|i| format!("translate([{}, 0, 0]) sphere(1);\n", 3 * i)).collect();
    let (_, file) = scene("plan_balls", &balls);
    let row = plan(&file, &[]);
    says(&row("lattice"), true, "17 objects of 17 primitives, traced in tiles → boxes: 3 nodes");
    let row = plan(&file, &["--engine", "exact"]);
    says(&row("lattice"), true, "17 objects of 17 primitives → boxes, eight side by side: 3 nodes");
}

/// What the plan leaves out is not counted in the picture, what it takes in is.
#[test]
fn is_what_the_picture_does() {
    for (name, options) in [
        ("hanyang", &[][..]),
        ("hanyang", &["--preset", "pcat"]),
        ("hanyang", &["--view", "inside", "--structure", "none"]),
        ("glass", &[]),
        ("glass", &["--engine", "exact"]),
        ("hanyang", &["--engine", "exact", "--structure", "boxes"]),
        ("die", &["--shading", "2"]),
    ] {
        let row = plan(name, options);
        let stats =
            run(&[&["render", name, "--stats", "json", "--format", "levels", "--cells", "40x20"], options]
                .concat());
        let stats: serde_json::Value = serde_json::from_slice(&stats.stderr).expect("JSON");
        for (what, key) in [
            ("cell", "cells_visited"),
            ("csg", "csg_evaluations"),
            ("shadow rays", "shadow_rays"),
            ("secondary rays", "secondary_rays"),
        ] {
            let counted = stats[key].as_u64().unwrap() > 0;
            assert_eq!(row(what).0, counted, "{name} {options:?}: {what}");
        }
        let structure = stats["structure"].as_str().unwrap();
        assert_eq!(row("lattice").0, structure != "none", "{name} {options:?}");
    }
}

#[test]
fn is_a_table() {
    for options in [&[][..], &["--run"]] {
        let table = text(&done(&run(&[&["plan", "hanyang"], options].concat())));
        let lines: Vec<&str> = table.lines().collect();
        let (rows, sums) = lines.split_at(lines.len() - 2);
        let starts: Vec<usize> = rows
            .iter()
            .map(|line| line.find("needed").or(line.find("left out")).or(line.find("plan ")).unwrap())
            .collect();
        assert!(starts.len() > 11 && starts.iter().all(|&s| s == starts[0]), "{table}");
        for (sum, of) in sums.iter().zip(["each picture", "with what is done once"]) {
            assert!(sum.starts_with(of) && sum.contains(" ms"), "{table}");
        }
        assert_eq!(rows[0].contains("measured"), !options.is_empty(), "{table}");
    }
    fails(&run(&["plan", "hanjang"]), 2);
}

/// What was counted stands beside what was expected, and is what `--stats` says.
#[test]
fn can_be_run() {
    for engine in ["fast", "exact"] {
        let picture = ["glass", "--cells", "60x30", "--engine", engine];
        let plan = done(&run(&[&["plan", "--run", "--json"], &picture[..]].concat()));
        let plan: serde_json::Value = serde_json::from_slice(&plan).expect("JSON");
        let stats = run(&[&["render", "--stats", "json", "--format", "ans"], &picture[..]].concat());
        let stats: serde_json::Value = serde_json::from_slice(&stats.stderr).expect("JSON");
        assert_eq!((&plan["engine"], &stats["engine"]), (&engine.into(), &engine.into()));
        let stage = |name: &str| {
            plan["stages"].as_array().unwrap().iter().find(|s| s["stage"] == name).unwrap().clone()
        };
        assert_eq!(stage("ray")["count"], stats["primary_rays"]);
        assert_eq!(stage("ray")["expected_count"].as_f64(), stats["primary_rays"].as_f64());
        assert_eq!(stage("solid")["count"], stats["primitive_tests"]);
        let terms = stage("shade")["terms"].clone();
        let term = |name: &str| terms.as_array().unwrap().iter().find(|t| t["name"] == name).unwrap().clone();
        assert_eq!(term("shadow rays")["count"], stats["shadow_rays"]);
        assert_eq!(term("secondary rays")["count"], stats["secondary_rays"]);
        // Rough, but no guess: half to twice as many surfaces.
        let (expected, met) = (&stage("shade")["expected_count"], &stage("shade")["count"]);
        let ratio = expected.as_f64().unwrap() / met.as_f64().unwrap();
        assert!((0.5..2.0).contains(&ratio), "{expected} expected, {met} met");
        assert!(plan["ms"].as_f64().unwrap() > 0.0 && plan["expected_ms"].as_f64().unwrap() > 0.0);
    }
}

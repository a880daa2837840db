//! An option changes the picture, or it is said, or refused, that it has no effect: every option beside every
//! format.

use super::{run, scene, text};

/// A scene in which every term of the light shows, with a view that is not the first.
const SHINING: &str = "camera(name = \"front\", eye = [0, -9, 3], field = [30, 20]); camera(name = \"side\", eye = [9, -3, 3]);\n\
    world(k = 1); light(at = [5, -9, 9], intensity = 9, color = [1, 0.5, 0.5]);\n\
    material(kd = 0.4, ks = 0.3, kr = 0.5, n = 6, color = [1, 0.6, 0.2]) cube(2, center = true);\n\
    material(kd = 0.4, ks = 0.3, kr = 0.5, n = 6) translate([2.5, 0, 0]) sphere(1.3);\n\
    material(kd = 0.9) translate([-6, -6, -2]) cube([12, 12, 0.5]);\n";

const FORMATS: [&[&str]; 12] = [
    &["--format", "txt"],
    &["--format", "ans"],
    &["--format", "ans", "--glyphs", "braille"],
    &["--format", "levels"],
    &["--format", "png"],
    &["--format", "pgm"],
    &["--format", "ppm", "--channel", "light"],
    &["--format", "pgm", "--levels"],
    &["--format", "pfm"],
    &["--format", "pfm", "--channel", "depth"],
    &["--format", "pfm", "--channel", "normal"],
    &["--format", "pfm", "--channel", "object"],
];

/// Options that can change a picture, each but `--threads`, `--structure` and `--engine`, by which all are
/// the same.
const OPTIONS: [&[&str]; 27] = [
    &["--view", "side"],
    &["--eye", "9,9,9"],
    &["--target", "1,0,0"],
    &["--up", "1,0,0"],
    &["--field", "70x50"],
    &["--zoom", "2"],
    &["--shading", "1"],
    &["--no-shadows"],
    &["--depth", "0"],
    &["--cutoff", "9"],
    &["--samples", "3"],
    &["--aa", "fixed"],
    &["--aa", "adaptive"],
    &["--error", "0.5"],
    &["--glyphs", "half"],
    &["--glyphs", "ascii"],
    &["--palette", "dos"],
    &["--palette", "dos16"],
    &["--palette", "gray"],
    &["--palette", "mono"],
    &["--palette", "color"],
    &["--tone", "even"],
    &["--invert"],
    &["--levels"],
    &["--channel", "light"],
    &["--channel", "depth"],
    &["--preset", "pcat"],
];

/// What is asked for is what there is already, and nothing to speak of.
const AS_IT_IS: [(&str, &str); 10] = [
    ("txt", "--palette mono"),
    // One of them, as the terminal has it.
    ("ans", "--palette dos"),
    ("ans", "--palette dos16"),
    ("ans --glyphs braille", "--palette mono"),
    ("png", "--channel light"),
    ("pgm", "--channel light"),
    ("ppm --channel light", "--channel light"),
    ("pgm --levels", "--levels"),
    ("pfm", "--channel light"),
    ("pfm --channel depth", "--channel depth"),
];

#[test]
fn every_option_has_one_or_says_that_it_has_none() {
    let (_, file) = scene("effects", SHINING);
    let mut said = 0;
    for format in FORMATS {
        let plain = ["render", &file, "--dots", "64x48"];
        let plain = [&plain[..], format].concat();
        let picture = run(&plain);
        assert!(picture.status.success(), "{format:?}: {}", text(&picture.stderr));
        for option in OPTIONS {
            let (name, asked) = (format[1..].join(" "), option.join(" "));
            // An option that stands in the format already is given once.
            let is_given = format.contains(&option[0]);
            if is_given || AS_IT_IS.contains(&(name.as_str(), asked.as_str())) {
                continue;
            }
            let output = run(&[&plain[..], option].concat());
            let message = text(&output.stderr);
            match output.status.code() {
                Some(2) => assert!(message.contains("no effect"), "{name} {asked}: {message}"),
                Some(0) if message.is_empty() => {
                    assert!(output.stdout != picture.stdout, "{name} {asked} changes nothing");
                }
                Some(0) => {
                    let option = format!("{} has no effect", option[0]);
                    assert!(message.contains(&option), "{name} {asked}: {message}");
                    assert!(output.stdout == picture.stdout, "{name} {asked} has an effect: {message}");
                    said += 1;
                }
                other => panic!("{name} {asked}: {other:?} {message}"),
            }
        }
    }
    assert!(said > 30, "only {said} lines");
}

#[test]
fn what_contradicts_is_refused() {
    for (options, says) in [
        (&["--engine", "exact", "--precision", "single"][..], "exact"),
        (&["--structure", "tree", "--precision", "single"], "exact"),
        (&["--format", "png", "--levels", "--channel", "light"], "raw"),
        (&["--format", "png", "--levels", "--palette", "color"], "grays"),
        (&["--format", "pfm", "--levels"], "raw"),
        (&["--format", "png", "--channel", "normal"], "pfm"),
    ] {
        let message = super::fails(&run(&[&["render", "die", "--dots", "8x4"], options].concat()), 2);
        assert!(message.contains("no effect") && message.contains(says), "{options:?}: {message}");
    }
}

/// A size of cells decides how many dots formats without characters have.
#[test]
fn glyphs_have_one_where_they_decide_the_size() {
    for options in [&["--format", "png", "--cells", "8x4"][..], &["--format", "levels"]] {
        let output = run(&[&["render", "die", "--glyphs", "shade"], options].concat());
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    }
}

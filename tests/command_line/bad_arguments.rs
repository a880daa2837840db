//! Arguments that make no sense.

use std::fs;

use super::{BALL, done, fails, folder, run, scene};

#[test]
fn have_exit_code_2() {
    let (_, file) = scene("arguments", BALL);
    let cases: &[&[&str]] = &[
        &["render"],
        &["rendre", &file],
        &["--cels", "80x25", &file],
        &["render", &file, "--cells", "80"],
        &["render", &file, "--cells", "0x25"],
        &["render", &file, "--dots", "99999999x99999999"],
        &["render", &file, "--dots", "-3x5"],
        &["render", &file, "--eye", "1,2"],
        &["render", &file, "--eye", "1,2,nan"],
        &["render", &file, "--eye", "1,2,3", "--target", "1,2,3"],
        &["render", &file, "--field", "180x40"],
        &["render", &file, "--field", "0x40"],
        &["render", &file, "--zoom", "0"],
        &["render", &file, "--zoom", "inf"],
        &["render", &file, "--samples", "0"],
        &["render", &file, "--shading", "7"],
        &["render", &file, "--depth", "65"],
        &["render", &file, "--cutoff", "-0.1"],
        &["render", &file, "--cutoff", "nan"],
        &["render", &file, "--format", "jpeg"],
        &["render", &file, "--glyphs", "block"],
        &["render", &file, "--palette", "cga"],
        &["render", &file, "--format", "txt", "--channel", "light"],
        &["render", &file, "--format", "png", "--channel", "depth"],
        &["render", &file, "--structure", "octree"],
        &["render", &file, "--engine", "slow"],
        &["render", &file, "--engine", "fast", "--structure", "none"],
        &["bench", &file, "--engine", "fast", "--structure", "tree"],
        &["plan", &file, "--engine", "fast", "--structure", "lattice"],
        &[&file, "--engine", "fast", "--structure", "lattice"],
        &["render", &file, "--preset", "pcxt"],
        &["render", &file, "--facets", "round"],
    ];
    for arguments in cases {
        fails(&run(arguments), 2);
    }
}

#[test]
fn do_not_include_the_request_for_help() {
    for arguments in [&["--help"][..], &["--version"], &["render", "--help"]] {
        assert!(!done(&run(arguments)).is_empty());
    }
}

// Each from an attack on the arguments: a message of no words, a picture that ended for want of memory, a
// direction that overflowed, a model taken for a scene, and a misspelt scene with no word of those that there
// are.
#[test]
fn arguments_out_of_range_are_explained() {
    let (_, file) = scene("out_of_range", BALL);
    let message = fails(&run(&["render", &file, "--eye", "a,b,c"]), 2);
    assert!(message.contains("as in 0,-9,3"), "{message}");
    let message = fails(&run(&["render", &file, "--cells", "4096x8192"]), 2);
    assert!(message.contains("8192 × 32768 traced dots"), "{message}");
    fails(&run(&["render", &file, "--eye", "1e308,0,0", "--target", "-1e308,0,0"]), 2);
    let model = folder("foreign").join("part.STEP");
    fs::write(&model, "ISO-10303-21;\nHEADER;\n").unwrap();
    let message = fails(&run(&["check", model.to_str().unwrap()]), 2);
    assert!(message.contains("a STEP model"), "{message}");
    let message = fails(&run(&["render", "hanyan"]), 2);
    assert!(message.contains("hanyang"), "{message}");
}

// From a first user: the message for `--zoom -1` spoke of `--`, that for a second scene of a subcommand.
#[test]
fn each_have_a_message_of_their_own() {
    let (_, file) = scene("messages", BALL);
    for (option, value, says) in [
        ("--zoom", "-1", "above 0"),
        ("--cells", "-3x5", "WIDTHxHEIGHT"),
        ("--dots", "-8x-8", "WIDTHxHEIGHT"),
        ("--field", "-40x25", "above 0"),
        ("--cutoff", "-1", "0 or more"),
        ("--samples", "-1", "1..=64"),
        ("--depth", "-1", "0..=64"),
        ("--threads", "-2", "1..=1024"),
        ("--shading", "-1", "1..=4"),
        ("--eye", "-1", "X,Y,Z"),
    ] {
        let message = fails(&run(&["render", &file, option, value]), 2);
        assert!(message.contains(option) && message.contains(says), "{message}");
        assert!(!message.contains("'--'") && !message.contains("'-- "), "{message}");
    }
    for two in [&["die", "hanyang"][..], &["render", "die", "hanyang"], &["--zoom", "2", "die", "hanyang"]] {
        let message = fails(&run(two), 2);
        assert!(message.contains("one scene at a time") && message.contains("hanyang"), "{message}");
    }
    let message = fails(&run(&["rendre", "die"]), 2);
    assert!(message.contains("`rendre`") && message.contains("render, bench"), "{message}");
    let message = fails(&run(&["die", "render"]), 2);
    assert!(message.contains("ray13 render FILE"), "{message}");
}

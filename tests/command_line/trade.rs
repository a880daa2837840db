//! What `trade` prints, and that its command lines do what it says of them.

use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{done, fails, folder, ray13, run, text};

/// The figures of a sweep of some small picture that all knobs are turned of.
fn figures(options: &[&str]) -> Value {
    let all =
        [&["trade", "hanyang", "--cells", "8x4", "--seconds", "1.5", "--rays", "16", "--json"], options]
            .concat();
    serde_json::from_slice(&done(&run(&all))).expect("JSON")
}

/// A command line of words without blanks, as it was printed.
fn typed(line: &str, more: &[&str]) -> Vec<u8> {
    let mut words = line.split(' ');
    assert_eq!(words.next(), Some("ray13"));
    done(&ray13().args(words).args(more).output().unwrap())
}

#[test]
fn a_printed_command_line_has_the_printed_accuracy() {
    let figures = figures(&[]);
    let settings = figures["settings"].as_array().unwrap();
    assert!(settings.len() > 10, "{figures}");
    for setting in settings.iter().step_by(3) {
        // As a shell takes it: options that are one word stand in quotes.
        let again = format!("{} --json", setting["again"].as_str().unwrap())
            .replace("ray13 ", &format!("{} ", env!("CARGO_BIN_EXE_ray13")));
        let measured = Command::new("sh").args(["-c", &again]).output().unwrap();
        let measured: Value = serde_json::from_slice(&done(&measured)).unwrap();
        let own = measured["settings"].as_array().unwrap().last().unwrap();
        assert_eq!(own["options"], setting["options"]);
        for layer in ["geometry", "light", "characters"] {
            assert_eq!(own[layer], setting[layer], "{layer} of {setting}");
        }
        // And it is the picture's command line.
        let picture = typed(setting["command"].as_str().unwrap(), &["--format", "levels"]);
        assert_eq!(text(&picture).lines().next().map(str::len).unwrap() % 8, 0);
    }
}

#[test]
fn what_is_left_out_on_purpose_is_marked() {
    // All that are looked at are asked for: what is measured by itself depends on how fast the machine is.
    let asked = ["--no-shadows", "--shading 1", "--depth 0", "--depth 1", "--engine exact"];
    let asked = asked.map(|option| format!("--samples 2 {option}"));
    let with: Vec<&str> = asked.iter().flat_map(|options| ["--with", options]).collect();
    let figures = figures(&[&["--samples", "2"], &with[..]].concat());
    let settings = figures["settings"].as_array().unwrap();
    let find = |option: &str| {
        let found = settings.iter().find(|one| {
            one["options"] == format!("{option} --samples 2").as_str()
                || one["options"] == format!("--samples 2 {option}").as_str()
        });
        found.unwrap_or_else(|| panic!("no {option} in {figures}"))
    };
    assert_eq!(settings[0]["options"], "--samples 2");
    for option in ["--no-shadows", "--shading 1", "--depth 0"] {
        assert_eq!((&find(option)["another_picture"], &find(option)["front"]), (&true.into(), &false.into()));
    }
    assert_eq!(find("--depth 1")["another_picture"], false);
    assert_eq!(find("--engine exact")["light"], settings[0]["light"]);
    assert!(settings.iter().any(|one| one["front"] == true));
}

#[test]
fn a_wish_is_answered_by_one_line() {
    let small = ["trade", "die", "--cells", "8x4", "--seconds", "0", "--rays", "4"];
    for wish in [&["--within", "10s"][..], &["--wrong", "100%"], &["--within", "10s", "--wrong", "50%"]] {
        let output = run(&[&small[..], wish].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let line = text(&output.stdout);
        assert!(line.starts_with("ray13 render die --cells 8x4") && line.lines().count() == 1, "{line}");
        typed(line.trim_end(), &[]);
        assert!(text(&output.stderr).contains("of the levels wrong"));
    }
    let message = fails(&run(&[&small[..], &["--within", "1us"]].concat()), 2);
    assert!(message.contains("no setting") && message.contains("the fastest has"), "{message}");
}

#[test]
fn a_plot_is_a_picture() {
    let small = ["trade", "die", "--cells", "8x4", "--seconds", "0", "--rays", "4"];
    let svg = done(&run(&[&small[..], &["--format", "svg"]].concat()));
    assert!(text(&svg).starts_with("<svg ") && text(&svg).ends_with("</svg>\n"));
    let file = folder("trade_plot").join("plot.png");
    assert_eq!(done(&run(&[&small[..], &["-o", file.to_str().unwrap()]].concat())), b"");
    assert!(fs::read(&file).unwrap().starts_with(b"\x89PNG"));
    let message = fails(&run(&[&small[..], &["-o", "plot.gif"]].concat()), 2);
    assert!(message.contains("svg or png"), "{message}");
}

#[test]
fn the_table_says_what_all_is_compared_with() {
    let table = text(&done(&run(&["trade", "die", "--cells", "8x4", "--seconds", "0", "--rays", "8"])));
    assert!(
        table.starts_with("The reference: 8 rays for each of 16 × 16 dots, 4 of them by the exact engine"),
        "{table}"
    );
    assert!(table.contains("(as asked)"), "{table}");
    assert!(table.ends_with("ray13 trade die --cells 8x4 --seconds 0 --rays 8\n"), "{table}");
    assert!(table.contains("  wrong% dots with another of the 13 levels"), "{table}");
    let more = ["--with", "--samples 2", "--with", "--depth 3 --no-shadows"];
    let more = [&["trade", "die", "--cells", "8x4", "--seconds", "0", "--rays", "8"][..], &more].concat();
    let table = text(&done(&run(&more)));
    assert!(table.contains("  --samples 2\n") && table.contains("  --no-shadows --depth 3\n"), "{table}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    for (option, value) in [("--within", "16"), ("--wrong", "0%"), ("--rays", "100"), ("--seconds", "-1")] {
        let message = fails(&run(&["trade", "die", option, value]), 2);
        assert!(message.contains("expected"), "{message}");
    }
    fails(&run(&["trade", "die", "--json", "--within", "1s"]), 2);
    // These were taken for the setting that was asked for already.
    for with in ["junk", "--view nope", "--dots 9x9", "--fps 9", "scenes"] {
        let message = fails(&run(&["trade", "die", "--with", with]), 2);
        assert!(message.contains("--with"), "{with}: {message}");
    }
    fails(&run(&["trade", "nosuch.scene"]), 2);
}

/// A limit of 3 s took 47: with pictures so large there is nothing to tell by then, and that is said.
#[test]
fn the_limit_of_time_holds_within_a_picture() {
    let begin = Instant::now();
    let message = fails(&run(&["trade", "glass", "--dots", "1500x1500", "--seconds", "0.1"]), 2);
    assert!(message.contains("the time was over") && message.contains("--seconds 0"), "{message}");
    // A minute of rays: a machine that is busy with others is no reason to fail.
    assert!(begin.elapsed() < Duration::from_secs(20), "{:?}", begin.elapsed());
}

/// Ctrl-C: what there is, with exit code 0; the line says so.
#[cfg(unix)]
#[test]
fn an_interrupt_gives_what_there_is() {
    let arguments = ["trade", "hanyang", "--cells", "40x20", "--seconds", "60"];
    let child = ray13()
        .args(arguments)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(2));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("interrupted"));
    assert!(text(&output.stdout).contains("The front"));
}

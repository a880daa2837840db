//! A still that several machines draw in parts, and join.

use std::fs;
use std::path::{Path, PathBuf};

use super::{done, fails, folder, run, text};

/// Draws the parts of a still, and gives their names.
fn parts(folder: &Path, scene: &str, of: u32, options: &[&str]) -> Vec<String> {
    (1..=of)
        .map(|number| {
            let part = path(folder, &format!("part.{number}"));
            let share = format!("{number}/{of}");
            done(&run(&[&["render", scene, "--part", &share, "-o", &part], options].concat()));
            part
        })
        .collect()
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

fn joined(parts: &[String]) -> std::process::Output {
    let words: Vec<&str> = std::iter::once("join").chain(parts.iter().map(String::as_str)).collect();
    run(&words)
}

#[test]
fn joined_parts_are_the_bytes_of_one_machine() {
    let folder = folder("parts");
    let forms: [&[&str]; 6] = [
        &["--dots", "130x70", "--format", "png"],
        &["--cells", "50x12", "--format", "ans", "--palette", "color", "--glyphs", "quadrant"],
        &["--dots", "100x70", "--format", "png", "--aa", "adaptive"],
        &["--dots", "70x40", "--format", "png", "--palette", "color", "--aa", "adaptive"],
        &["--dots", "70x40", "--format", "pfm", "--channel", "normal"],
        &["--dots", "70x40", "--format", "levels", "--preset", "pcat", "--samples", "2"],
    ];
    for options in forms {
        let mut parts = parts(&folder, "glass", 3, options);
        // In any order, and one twice.
        parts.reverse();
        parts.push(parts[1].clone());
        let whole = done(&run(&[&["render", "glass"], options].concat()));
        assert!(done(&joined(&parts)) == whole, "{options:?}");
    }
}

#[test]
fn a_part_is_the_same_bytes_on_any_number_of_threads() {
    let folder = folder("parts_threads");
    let drawn = ["1", "3"].map(|threads| {
        let part = path(&folder, threads);
        let options = ["--dots", "130x70", "--aa", "adaptive", "--part", "2/2"];
        done(&run(&[&["render", "hanyang", "--threads", threads, "-o", &part], &options[..]].concat()));
        fs::read(part).unwrap()
    });
    assert!(drawn[0] == drawn[1]);
}

/// What can go wrong between machines, each by the name of the file that is to blame.
#[test]
fn parts_that_are_no_picture_are_named() {
    let folder = folder("parts_bad");
    let options = ["--dots", "90x40", "--format", "levels"];
    let good = parts(&folder, "die", 3, &options);
    let with = |replaced: usize, by: &str| {
        let mut parts = good.clone();
        parts[replaced] = by.to_owned();
        fails(&joined(&parts), 2)
    };
    let write = |name: &str, bytes: &[u8]| {
        fs::write(folder.join(name), bytes).unwrap();
        path(&folder, name)
    };
    let bytes = fs::read(&good[1]).unwrap();

    assert!(fails(&joined(&[good[0].clone()]), 2).contains("draw --part 2/3, 3/3"));
    let short = write("short", &bytes[..bytes.len() - 5]);
    assert!(with(1, &short).contains("short: it is cut short or damaged"));
    let mut damaged = bytes.clone();
    damaged[bytes.len() / 2] ^= 1;
    let damaged = write("damaged", &damaged);
    assert!(with(1, &damaged).contains("damaged: it is cut short or damaged"));
    let longer = write("longer", &[&bytes[..], b"more"].concat());
    assert!(with(1, &longer).contains("longer: it is cut short or damaged"));
    let text_file = write("text", b"sphere(1);");
    assert!(with(1, &text_file).contains("text: it is no part of a picture"));
    assert!(with(1, &path(&folder, "absent")).contains("absent: "));

    let other = |name: &str, words: &[&str]| {
        let part = path(&folder, name);
        done(&run(&[&["render"], words, &["--format", "levels", "-o", &part]].concat()));
        part
    };
    let other_scene = other("scene", &["temple", "--dots", "90x40", "--part", "2/3"]);
    assert!(with(1, &other_scene).contains("scene: it is of another picture than"));
    let other_light = other("light", &["die", "--dots", "90x40", "--no-shadows", "--part", "2/3"]);
    assert!(with(1, &other_light).contains("light: it is of another picture than"));
    let other_number = other("number", &["die", "--dots", "90x40", "--part", "2/4"]);
    assert!(with(1, &other_number).contains("number: it is one of 4 parts"));
}

#[test]
fn parts_are_not_lost_and_keep_to_their_format() {
    let folder = folder("parts_kept");
    let parts = parts(&folder, "die", 1, &["--dots", "40x30"]);
    let bytes = fs::read(&parts[0]).unwrap();
    let onto = |name: &str| fails(&run(&["join", &parts[0], "-o", name]), 2);
    assert!(onto(&parts[0]).contains("is one of the parts"));
    assert_eq!(fs::read(&parts[0]).unwrap(), bytes);
    let other = path(&folder, "still.levels");
    assert!(onto(&other).contains("the parts were drawn for png"));
    assert!(!PathBuf::from(&other).exists());
    let still = path(&folder, "still.png");
    done(&run(&["join", &parts[0], "-o", &still]));
    assert!(fs::read(&still).unwrap().starts_with(b"\x89PNG"));
    let refused = run(&["render", "die", "--part", "4/3", "-o", &still]);
    assert!(text(&refused.stderr).contains("parts are counted from 1/N to N/N"));
}

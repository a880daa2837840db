//! How much memory a scene takes: what the reader counts on is what the program then takes, and what is more
//! than it may is an error.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const MIB: f64 = (1 << 20) as f64;

/// What the cells of one composite object take at most: 114 MiB were seen of 20,000 cutters.
const CELLS: f64 = 200.0 * MIB;

/// What the program takes without a scene, and while it draws a small picture: 5 MiB were seen.
const PROGRAM: f64 = 20.0 * MIB;

fn file(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("memory");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn ray13(command: &str, file: &Path, memory: &str, more: &[&str]) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.arg(command).arg(file).args(["--memory", memory]).args(more).stdin(Stdio::null()).output().unwrap()
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What is called for in place of a limit that is too low: `--memory 12MiB`.
fn called_for(message: &str) -> (String, f64) {
    let option = message.split("--memory ").nth(1).and_then(|rest| rest.split([',', ' ', '\n']).next());
    let option = option.unwrap_or_else(|| panic!("no advice: {message}"));
    let number: f64 = option.trim_end_matches(char::is_alphabetic).parse().unwrap();
    let unit = if option.ends_with("KiB") { 1024.0 } else { MIB };
    (option.to_owned(), number * unit)
}

/// Texts that take the most memory for their length, each of its kind.
fn texts() -> [(&'static str, String); 8] {
    let many = |count: usize, part: &str| part.repeat(count);
    let mesh = {
        // A strip of boxes that share nothing: 8 points and 12 triangles each.
        let (mut points, mut faces) = (String::new(), String::new());
        for i in 0..4000 {
            let x = 2 * i;
            for [dx, y, z] in
                [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
            {
                points += &format!("[{},{y},{z}],", x + dx);
            }
            for face in [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]] {
                faces += &format!("{:?},", face.map(|corner| corner + 8 * i));
            }
        }
        format!("polyhedron([{points}], [{faces}]);")
    };
    [
        ("flat.scene", many(30_000, "cube(1);")),
        ("group.scene", format!("group() {{ {} }}", many(10_000, "cube(1);"))),
        ("difference.scene", format!("difference() {{ {} }}", many(2_000, "cube(1);"))),
        ("small.scene", many(10_000, "difference(){cube(2);cube(1);}")),
        ("nuts.scene", many(20_000, "cylinder($fn=6);")),
        (
            "tetrahedra.scene",
            many(5_000, "polyhedron([[0,0,0],[1,0,0],[0,1,0],[0,0,1]],[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]);"),
        ),
        ("mesh.scene", mesh),
        ("balls.nff", (0..20_000).map(|i| format!("s {i} 0 0 .4\n")).collect()),
    ]
}

// 255 MiB of `cube(1);` took 13.4 GB and was ended by the system; a million cubes in 9 MB took 521 MB.
#[test]
fn what_is_counted_on_is_what_is_taken() {
    for (name, text) in texts() {
        let path = file(name, &text);
        // Twice the text: enough to begin, too little to go on.
        let short = ray13("check", &path, &(2 * text.len()).to_string(), &[]);
        assert_eq!(short.status.code(), Some(2), "{name}: {}", message(&short));
        assert!(message(&short).contains("the scene takes more than the"), "{name}: {}", message(&short));
        let (option, bytes) = called_for(&message(&short));
        let ratio = bytes / text.len() as f64;
        assert!(ratio < 100.0, "{name}: {ratio} bytes a byte of text");
        // One dot is enough: all of these cubes stand in one place, and a ray meets each of them.
        // What is called for may be rounded down by as much as the beginning was unlike the rest.
        let enough = ray13(
            "bench",
            &path,
            &format!("{}", bytes * 1.1),
            &["--json", "--dots", "1x1", "--threads", "2"],
        );
        assert_eq!(enough.status.code(), Some(0), "{name}, {option}: {}", message(&enough));
        let figures: serde_json::Value = serde_json::from_slice(&enough.stdout).unwrap();
        let Some(peak) = figures["peak_rss_bytes"].as_f64() else { return };
        println!("{name}: {option} called for, {:.1} MiB taken, {ratio:.0} bytes a byte of text", peak / MIB);
        // Cells of composite objects have a bound of their own.
        let cells = if name == "difference.scene" { CELLS } else { 0.0 };
        assert!(
            peak <= 1.25 * bytes + PROGRAM + cells,
            "{name}: {option} called for, {} MiB taken",
            peak / MIB
        );
        assert!(peak >= 0.3 * bytes, "{name}: {option} called for, {} MiB taken", peak / MIB);
    }
}

#[test]
fn one_value_can_be_too_large() {
    let path = file("list.scene", &format!("polyhedron([{}]);", "[],".repeat(200_000)));
    let output = ray13("check", &path, "3MiB", &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("takes more than the 3 MiB"), "{}", message(&output));
    let text = ray13("check", &path, "1KiB", &[]);
    assert_eq!(text.status.code(), Some(2));
    assert!(message(&text).contains("takes more than the 1 KiB"), "{}", message(&text));
}

#[test]
fn a_limit_that_is_none_is_refused() {
    for none in ["0", "-1", "much", "1TB"] {
        let output = ray13("check", Path::new("die"), none, &[]);
        assert_eq!(output.status.code(), Some(2), "{none}");
    }
}

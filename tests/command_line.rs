//! What the command `ray13` promises to a shell: exit codes, which stream, and no half-written files.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// A folder of its own for each test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("command_line").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn ray13() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ray13"));
    command.stdin(Stdio::null()).env_remove("NO_COLOR");
    command
}

fn run(arguments: &[&str]) -> Output {
    ray13().args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

/// Exit code 0, nothing on standard error; gives standard output.
#[track_caller]
fn done(output: &Output) -> Vec<u8> {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr), "");
    output.stdout.clone()
}

/// An exit code with a message, nothing on standard output; gives the message.
#[track_caller]
fn fails(output: &Output, code: i32) -> String {
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert_eq!(text(&output.stdout), "");
    assert!(!message.trim().is_empty(), "an error says nothing");
    assert!(!message.contains("panicked"), "{message}");
    message
}

const BALL: &str = "sphere(1);\n";

/// A file of a test's folder that holds `contents`.
fn scene(test: &str, contents: &str) -> (PathBuf, String) {
    let folder = folder(test);
    let file = folder.join("given.scene");
    fs::write(&file, contents).unwrap();
    (folder, file.to_str().unwrap().to_owned())
}

mod scenes {
    use super::*;

    #[test]
    fn lists_the_embedded_scenes() {
        let list = text(&done(&run(&["scenes"])));
        for name in ["hanyang", "die", "bolt", "temple"] {
            assert!(
                list.lines().any(|line| line.split_whitespace().next() == Some(name)),
                "{name} in {list}"
            );
        }
    }

    #[test]
    fn prints_each_as_a_file_that_can_be_read() {
        let folder = folder("prints_each");
        for name in ["hanyang", "die", "bolt", "temple"] {
            let file = folder.join(format!("{name}.scene"));
            fs::write(&file, done(&run(&["scenes", name]))).unwrap();
            done(&run(&["check", file.to_str().unwrap()]));
        }
    }

    #[test]
    fn knows_when_there_is_no_such_scene() {
        let message = fails(&run(&["scenes", "hanjang"]), 2);
        assert!(message.contains("hanyang"), "the nearest name is not offered: {message}");
    }
}

mod a_still {
    use super::*;

    #[test]
    fn is_printed_where_output_is_no_terminal() {
        let (_, file) = scene("no_terminal", BALL);
        for arguments in [&[file.as_str()][..], &[]] {
            let picture = text(&done(&run(arguments)));
            assert!(picture.lines().count() > 5, "{picture}");
            assert!(picture.contains(|c| "░▒▓█".contains(c)), "{picture}");
        }
    }

    #[test]
    fn has_the_size_asked_for() {
        let (_, file) = scene("size", BALL);
        let cells = text(&done(&run(&["render", &file, "--cells", "30x12", "--format", "txt"])));
        assert_eq!(cells.lines().map(|line| line.chars().count()).collect::<Vec<_>>(), [30; 12]);
        let dots = text(&done(&run(&["render", &file, "--dots", "30x12", "--format", "levels"])));
        assert_eq!(dots.lines().map(str::len).collect::<Vec<_>>(), [30; 12]);
        assert!(dots.chars().all(|c| "0123456789ABC\n".contains(c)), "{dots}");
    }

    #[test]
    fn comes_in_every_format() {
        let (_, file) = scene("formats", BALL);
        let format = |name| done(&run(&["render", &file, "--dots", "20x16", "--format", name]));
        assert!(format("png").starts_with(b"\x89PNG\r\n\x1a\n"));
        assert!(format("pfm").starts_with(b"Pf\n20 16\n-1"));
        let (pgm, ppm) = (format("pgm"), format("ppm"));
        assert_eq!((&pgm[..13], pgm.len()), (&b"P5\n20 16\n255\n"[..], 13 + 320));
        assert_eq!((&ppm[..13], ppm.len()), (&b"P6\n20 16\n255\n"[..], 13 + 960));
        // One gray a dot, in both.
        assert!(pgm[13..].iter().zip(ppm[13..].chunks(3)).all(|(&gray, rgb)| rgb == [gray; 3]));
        let thirteen = [0, 42, 60, 74, 85, 114, 136, 154, 170, 196, 218, 237, 255];
        assert!(pgm[13..].iter().all(|gray| thirteen.contains(gray)));
        assert!(format("ans").contains(&0x1b));
        assert!(!format("txt").contains(&0x1b));
        assert!(!format("levels").contains(&0x1b));
    }

    /// A red ball and a gray one, under white light.
    const RED: &str = "color([1, 0.2, 0.1]) sphere(1);\ntranslate([3, 0, 0]) sphere(1);\n";

    #[test]
    fn has_colours_when_asked() {
        let (_, file) = scene("colours", RED);
        let still = |more: &[&str]| {
            let arguments = [&["render", &file, "--dots", "40x20"][..], more].concat();
            done(&run(&arguments))
        };
        let colours = still(&["--format", "ppm", "--palette", "color"]);
        let header = b"P6\n40 20\n255\n".len();
        assert!(colours[header..].chunks(3).any(|rgb| rgb[0] > rgb[1] && rgb[1] > rgb[2]), "nothing is red");
        assert!(colours[header..].chunks(3).any(|rgb| rgb[0] > 0 && rgb[0] == rgb[1] && rgb[1] == rgb[2]));
        assert!(still(&["--format", "pfm", "--palette", "color"]).starts_with(b"PF\n40 20\n"));
        assert!(still(&["--format", "pfm"]).starts_with(b"Pf\n40 20\n"));
        // Bit depth and colour type of the header chunk.
        assert_eq!(still(&["--format", "png", "--palette", "color"])[24..26], [8, 2]);
        assert_eq!(still(&["--format", "png"])[24..26], [8, 0]);
        let levels = still(&["--format", "levels"]);
        assert_eq!(still(&["--format", "levels", "--palette", "color"]), levels);
    }

    #[test]
    fn holds_light_in_place_of_levels_when_asked() {
        let (_, file) = scene("light", BALL);
        let still = |more: &[&str]| {
            let arguments = [&["render", &file, "--dots", "60x60"][..], more].concat();
            done(&run(&arguments))
        };
        let grays = |bytes: &[u8]| {
            let mut grays = bytes[b"P5\n60 60\n255\n".len()..].to_vec();
            grays.sort_unstable();
            grays.dedup();
            grays.len()
        };
        assert!(grays(&still(&["--format", "pgm"])) <= 13);
        assert!(grays(&still(&["--format", "pgm", "--channel", "light"])) > 13);
        for format in ["png", "ppm"] {
            assert_ne!(still(&["--format", format]), still(&["--format", format, "--channel", "light"]));
        }
    }

    #[test]
    fn tells_colours_as_the_terminal_takes_them() {
        let (_, file) = scene("depth", RED);
        let with = |colorterm: &str, palette: &str| {
            let arguments = ["render", &file, "--cells", "30x12", "--format", "ans", "--palette", palette];
            text(&done(&ray13().env("COLORTERM", colorterm).args(arguments).output().unwrap()))
        };
        for palette in ["gray", "color"] {
            for colorterm in ["truecolor", "24bit"] {
                let picture = with(colorterm, palette);
                assert!(picture.contains("48;2;") && !picture.contains("48;5;"), "{picture}");
            }
            let picture = with("", palette);
            assert!(picture.contains("48;5;") && !picture.contains("48;2;"), "{picture}");
        }
        for palette in ["dos16", "mono"] {
            assert_eq!(with("truecolor", palette), with("", palette));
        }
    }

    /// Solarized's attribute 8 is darker than its 0, and nothing answers a still.
    #[test]
    fn sends_grays_that_nobody_changes_where_there_are_256_colours() {
        let (_, file) = scene("grays", RED);
        let with = |term: &str, palette: &[&str]| {
            let arguments = [&["render", &file, "--cells", "30x12", "--format", "ans"], palette].concat();
            let mut command = ray13();
            command.env("TERM", term).env_remove("COLORTERM").env("LANG", "C.UTF-8").env_remove("LC_ALL");
            text(&done(&command.args(arguments).output().unwrap()))
        };
        let by_number = ["48;5;16", "38;5;240", "38;5;248"];
        for palette in [&[][..], &["--palette", "dos"]] {
            let picture = with("xterm-256color", palette);
            assert!(by_number.iter().all(|color| picture.contains(color)), "{picture}");
            assert!(!picture.contains("[90") && !picture.contains(";40m"), "{picture}");
            let picture = with("xterm", palette);
            assert!(picture.contains("90") && !picture.contains("8;5;"), "{picture}");
        }
        assert_eq!(with("xterm-256color", &["--palette", "dos16"]), with("xterm", &[]));
    }

    /// In the terminal's own ink a picture was a negative on white paper.
    #[test]
    fn puts_ink_where_it_is_dark_when_asked() {
        let (_, file) = scene("invert", BALL);
        let still = |more: &[&str]| {
            let arguments = [&["render", &file, "--cells", "40x20", "--format", "txt"][..], more].concat();
            text(&done(&run(&arguments)))
        };
        let inked = |picture: &str, marks: &str| picture.chars().filter(|mark| marks.contains(*mark)).count();
        for (glyphs, blank, full) in [("blocks", " ", "█"), ("ascii", " ", "@"), ("braille", " ", "⣿")] {
            let [dark, light] = [&["--glyphs", glyphs][..], &["--glyphs", glyphs, "--invert"]].map(still);
            // Around the ball it is black: blank on dark paper, full of ink on light.
            assert!(inked(&dark, blank) > 200 && inked(&dark, full) < 200, "{dark}");
            assert!(inked(&light, full) > 200 && inked(&light, blank) < 200, "{light}");
        }
        assert_eq!(still(&["--no-invert"]), still(&[]));
        let message = fails(&run(&["render", &file, "--invert", "--no-invert"]), 2);
        assert!(message.contains("--no-invert"), "{message}");
    }

    #[test]
    fn holds_the_channel_asked_for() {
        let (_, file) = scene("channels", BALL);
        let channel = |name| {
            let view = ["--eye", "0,-5,0", "--target", "0,0,0", "--up", "0,0,1"];
            let size = ["--dots", "9x9", "--format", "pfm", "--channel", name];
            done(&run(&[&["render", &file][..], &size, &view].concat()))
        };
        for (name, kind, channels) in
            [("light", "Pf", 1), ("depth", "Pf", 1), ("normal", "PF", 3), ("object", "Pf", 1)]
        {
            let bytes = channel(name);
            assert!(bytes.starts_with(kind.as_bytes()), "{name}");
            let header = bytes.iter().enumerate().filter(|(_, b)| **b == b'\n').nth(2).unwrap().0 + 1;
            let values: Vec<f32> =
                bytes[header..].chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
            assert_eq!(values.len(), 81 * channels);
            // The dot in the middle looks straight at the sphere of radius 1, five away.
            let middle = &values[40 * channels..41 * channels];
            let corner = &values[..channels];
            match name {
                "depth" => assert_eq!((middle, corner), (&[4.0][..], &[f32::INFINITY][..])),
                "normal" => assert_eq!((middle, corner), (&[0.0, -1.0, 0.0][..], &[0.0; 3][..])),
                "object" => assert_eq!((middle, corner), (&[1.0][..], &[0.0][..])),
                _ => assert!(middle[0] > corner[0]),
            }
        }
    }

    #[test]
    fn goes_to_a_file() {
        let (folder, file) = scene("to_a_file", BALL);
        let out = folder.join("picture.png");
        let printed = done(&run(&["render", &file, "--format", "png"]));
        assert!(done(&run(&["render", &file, "--format", "png", "-o", out.to_str().unwrap()])).is_empty());
        assert_eq!(fs::read(out).unwrap(), printed);
    }

    #[test]
    fn takes_its_format_from_the_ending_of_its_file() {
        let (folder, file) = scene("ending", BALL);
        let written = |name: &str| {
            let out = folder.join(name);
            done(&run(&["render", &file, "--cells", "9x5", "-o", out.to_str().unwrap()]));
            fs::read(out).unwrap()
        };
        assert!(written("a.png").starts_with(b"\x89PNG"));
        assert_eq!(written("a"), written("a.txt"));
        let out = folder.join("a.jpg");
        let message = fails(&run(&["render", &file, "-o", out.to_str().unwrap()]), 2);
        assert!(message.contains("png") && message.contains("--format"), "{message}");
        assert!(!out.exists());
    }

    /// A scene in which every term of the light shows: nine, divided by the way of about eight and k, is about 1.
    const SHINING: &str = "world(k = 1); light(at = [5, -9, 9], intensity = 9);\n\
        material(kd = 0.6, ks = 0.6, n = 6) cube(2, center = true);\n\
        material(kd = 0.6, ks = 0.6, n = 6) translate([2.5, 0, 0]) sphere(1.3);\n";

    #[test]
    fn follows_every_option() {
        let (_, file) = scene("options", SHINING);
        let plain = done(&run(&["render", &file, "--cells", "40x20", "--format", "ans"]));
        let options: [&[&str]; 18] = [
            &["--eye", "9,9,9"],
            &["--target", "1,0,0"],
            &["--up", "1,0,0"],
            &["--field", "70x50"],
            &["--zoom", "2"],
            &["--shading", "1"],
            &["--shading", "2"],
            &["--samples", "3"],
            &["--glyphs", "cp437"],
            &["--glyphs", "shade"],
            &["--glyphs", "ascii"],
            &["--glyphs", "half"],
            &["--glyphs", "quadrant"],
            &["--glyphs", "braille"],
            &["--palette", "mono"],
            &["--palette", "gray"],
            &["--palette", "color"],
            &["--tone", "even"],
        ];
        for option in options {
            let picture =
                done(&run(&[&["render", &file, "--cells", "40x20", "--format", "ans"][..], option].concat()));
            assert!(picture != plain, "{option:?} changes nothing");
        }
        for option in
            [["--structure", "none"], ["--structure", "lattice"], ["--threads", "3"], ["--shading", "4"]]
        {
            let picture =
                done(
                    &run(&[&["render", &file, "--cells", "40x20", "--format", "ans"][..], &option].concat()),
                );
            assert!(picture == plain, "{option:?} changes the picture");
        }
    }

    #[test]
    fn leaves_shadows_out_when_asked() {
        let shadow = "light(at = [0, 0, 9]); sphere(1);\ntranslate([-9, -9, -3]) cube([18, 18, 1]);\n";
        let (_, file) = scene("shadows", shadow);
        let view = ["render", &file, "--eye", "9,-9,9", "--target", "0,0,-2", "--format", "levels"];
        let with = done(&run(&view));
        assert_ne!(done(&run(&[&view[..], &["--no-shadows"]].concat())), with);
    }

    #[test]
    fn takes_a_view_by_its_name() {
        let views =
            "camera(name = \"a\", eye = [0, -9, 3]);\ncamera(name = \"b\", eye = [9, 0, 3]);\ncube(2);\n";
        let (_, file) = scene("views", views);
        let view = |name| run(&["render", &file, "--view", name, "--format", "levels"]);
        assert_ne!(done(&view("a")), done(&view("b")));
        let message = fails(&view("c"), 2);
        assert!(message.contains('a') && message.contains('b'), "{message}");
    }

    #[test]
    fn counts_what_it_did() {
        let (_, file) = scene("stats", "difference() { cube(2, center = true); sphere(1.2); }\n");
        let arguments = ["render", &file, "--dots", "30x20", "--format", "levels", "--stats", "json"];
        let output = run(&arguments);
        assert!(output.status.success());
        let stats: serde_json::Value =
            serde_json::from_slice(&output.stderr).expect("JSON on standard error");
        let keys = "primary_rays primary_hits shadow_rays shadow_hits secondary_rays secondary_hits cells_visited \
                    primitive_tests truncated_rays build_ms trace_ms stage_ms threads engine structure";
        for key in keys.split_whitespace() {
            assert!(stats.get(key).is_some(), "{key} is missing in {stats}");
        }
        assert_eq!((&stats["engine"], &stats["structure"]), (&"fast".into(), &"boxes".into()));
        assert_eq!(stats["primary_rays"], 600);
        let hits = stats["primary_hits"].as_u64().unwrap();
        assert!(0 < hits && hits < 600, "{stats}");
        assert!(stats["primitive_tests"].as_u64().unwrap() > 0, "{stats}");
        for stage in ray13::stage::Stage::ALL {
            let found =
                stats["stage_ms"].as_object().unwrap().keys().any(|k| k.eq_ignore_ascii_case(stage.name()));
            assert!(found, "{} is missing in {stats}", stage.name());
        }
        // The picture itself is not disturbed.
        assert_eq!(output.stdout, done(&run(&arguments[..6])));
        let words = run(&[&arguments[..7], &["text"]].concat());
        assert!(words.status.success() && text(&words.stderr).contains("600"), "{}", text(&words.stderr));
    }
}

mod bad_input {
    use super::*;

    #[test]
    fn has_exit_code_2_and_a_place() {
        let cases = [
            ("word", "sphere(1);\nsphera(2);\n", "sphere"),
            ("argument", "sphere(1);\nsphere(radius = 2);\n", ":2:"),
            ("braces", "sphere(1);\nunion() { sphere(2);\n", ":2:"),
            ("singular", "sphere(1);\nscale([1, 0, 1]) sphere(2);\n", ":2:"),
            ("empty", "", "error"),
        ];
        for (name, contents, says) in cases {
            let (folder, file) = scene(&format!("bad_{name}"), contents);
            let out = folder.join("out.txt");
            let message = fails(&run(&["render", &file, "-o", out.to_str().unwrap()]), 2);
            assert!(message.contains(says), "{name}: {says} is not in\n{message}");
            assert!(!out.exists(), "{name}: a file was left behind");
            assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "{name}: something was left behind");
            fails(&run(&["check", &file]), 2);
            fails(&run(&[&file]), 2);
        }
    }

    #[test]
    fn is_also_a_file_that_is_not_there_or_no_text() {
        let (folder, _) = scene("no_file", BALL);
        fails(&run(&["check", folder.join("nothing.scene").to_str().unwrap()]), 2);
        fails(&run(&["check", folder.to_str().unwrap()]), 2);
        let message = fails(&run(&["check", "hanjang"]), 2);
        assert!(message.contains("hanyang"), "the embedded scenes are not named: {message}");
        let bytes = folder.join("bytes.scene");
        fs::write(&bytes, b"sphere(1);\xff\xfe").unwrap();
        fails(&run(&["check", bytes.to_str().unwrap()]), 2);
    }

    #[test]
    fn is_deep_nesting_without_a_crash() {
        let deep = format!("{}sphere(1);{}", "union() { ".repeat(100_000), "}".repeat(100_000));
        let (_, file) = scene("deep", &deep);
        fails(&run(&["check", &file]), 2);
    }

    #[test]
    fn can_be_skipped_where_openscad_is_larger_than_ray13() {
        let (_, file) = scene("skip", "sphere(1);\nhull() { cube(1); sphere(1); }\n");
        assert!(fails(&run(&["render", &file, "--format", "txt"]), 2).contains("hull"));
        let skipped = run(&["render", &file, "--format", "txt", "--skip-unsupported"]);
        assert!(skipped.status.success());
        assert!(!skipped.stdout.is_empty());
        assert!(text(&skipped.stderr).contains("hull"), "what was left out is not said");
    }
}

mod bad_arguments {
    use super::*;

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
}

// Each from an attack on the arguments: a message of no words, a picture that ended for want of memory, a direction
// that overflowed, a mesh taken for a scene, and a misspelt scene with no word of those that there are.
#[test]
fn arguments_out_of_range_are_explained() {
    let (_, file) = scene("arguments", BALL);
    let message = fails(&run(&["render", &file, "--eye", "a,b,c"]), 2);
    assert!(message.contains("as in 0,-9,3"), "{message}");
    let message = fails(&run(&["render", &file, "--cells", "4096x8192"]), 2);
    assert!(message.contains("8192 × 32768 traced dots"), "{message}");
    fails(&run(&["render", &file, "--eye", "1e308,0,0", "--target", "-1e308,0,0"]), 2);
    let mesh = folder("foreign").join("part.STL");
    fs::write(&mesh, "solid part\nfacet normal 0 0 1\n").unwrap();
    let message = fails(&run(&["check", mesh.to_str().unwrap()]), 2);
    assert!(message.contains("an STL mesh"), "{message}");
    let message = fails(&run(&["render", "hanyan"]), 2);
    assert!(message.contains("hanyang"), "{message}");
}

mod bad_output {
    use super::*;

    #[test]
    fn has_exit_code_1_and_leaves_nothing() {
        let (folder, file) = scene("unwritable", BALL);
        let nowhere = folder.join("missing/picture.png");
        fails(&run(&["render", &file, "--format", "png", "-o", nowhere.to_str().unwrap()]), 1);
        fails(&run(&["render", &file, "--format", "png", "-o", folder.to_str().unwrap()]), 1);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "something was left behind");
    }

    // From an attack on `-o`: a link was replaced by a file, and a private file became readable by all.
    #[cfg(unix)]
    #[test]
    fn goes_through_links_and_keeps_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let (folder, file) = scene("link", BALL);
        let (own, link) = (folder.join("own.levels"), folder.join("link.levels"));
        fs::write(&own, "before").unwrap();
        fs::set_permissions(&own, fs::Permissions::from_mode(0o600)).unwrap();
        symlink(&own, &link).unwrap();
        done(&run(&["render", &file, "--dots", "4x4", "-o", link.to_str().unwrap()]));
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&own).unwrap().permissions().mode() & 0o777, 0o600);
        assert_eq!(fs::read_to_string(&own).unwrap().lines().count(), 4);
        let long = folder.join("a".repeat(255));
        done(&run(&["render", &file, "--cells", "4x4", "-o", long.to_str().unwrap()]));
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 4, "something was left behind");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn is_a_full_disk() {
        let (_, file) = scene("full", BALL);
        for arguments in
            [&["render", &file, "--format", "ans"][..], &["scenes"], &["scenes", "die"], &[&file]]
        {
            let full = fs::File::options().write(true).open("/dev/full").unwrap();
            let output = ray13().args(arguments).stdout(full).output().unwrap();
            fails(&output, 1);
        }
        fails(&run(&["render", &file, "-o", "/dev/full"]), 1);
    }

    #[cfg(unix)]
    #[test]
    fn is_not_a_reader_that_has_seen_enough() {
        let (_, file) = scene("pipe", BALL);
        // Larger than the buffer of a pipe, so that writing meets the closed end.
        let mut child = ray13()
            .args(["render", &file, "--dots", "600x400", "--format", "levels"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let message = text(&output.stderr);
        assert!(!message.contains("panicked"), "{message}");
        assert_ne!(output.status.code(), Some(101));
        assert_ne!(output.status.code(), Some(2), "{message}");
    }
}

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

mod a_plan {
    use super::*;

    /// The plan of a scene: a stage or a term by its name → whether it is needed, and why.
    fn plan(file: &str, options: &[&str]) -> impl Fn(&str) -> (bool, String) {
        let json = done(&run(&[&["plan", file, "--json"], options].concat()));
        let plan: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
        let stages = plan["stages"].as_array().expect("stages").clone();
        let names: Vec<&str> = stages.iter().filter_map(|s| s["stage"].as_str()).collect();
        let expected: Vec<String> =
            ray13::stage::Stage::ALL.iter().map(|s| s.name().to_lowercase()).collect();
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
            let stats = run(&[
                &["render", name, "--stats", "json", "--format", "levels", "--cells", "40x20"],
                options,
            ]
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
            let (total, rows) = lines.split_last().unwrap();
            let starts: Vec<usize> = rows
                .iter()
                .map(|line| line.find("needed").or(line.find("left out")).or(line.find("plan ")).unwrap())
                .collect();
            assert!(starts.len() > 11 && starts.iter().all(|&s| s == starts[0]), "{table}");
            assert!(total.starts_with("total") && total.contains(" ms"), "{table}");
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
            let term =
                |name: &str| terms.as_array().unwrap().iter().find(|t| t["name"] == name).unwrap().clone();
            assert_eq!(term("shadow rays")["count"], stats["shadow_rays"]);
            assert_eq!(term("secondary rays")["count"], stats["secondary_rays"]);
            // Rough, but no guess: half to twice as many surfaces.
            let (expected, met) = (&stage("shade")["expected_count"], &stage("shade")["count"]);
            let ratio = expected.as_f64().unwrap() / met.as_f64().unwrap();
            assert!((0.5..2.0).contains(&ratio), "{expected} expected, {met} met");
            assert!(plan["ms"].as_f64().unwrap() > 0.0 && plan["expected_ms"].as_f64().unwrap() > 0.0);
        }
    }
}

mod an_engine {
    use super::*;

    fn used(options: &[&str]) -> (String, String) {
        let render = ["render", "hanyang", "--dots", "40x30", "--format", "levels", "--stats", "json"];
        let output = run(&[&render, options].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        let stats: serde_json::Value = serde_json::from_slice(&output.stderr).expect("JSON");
        let word = |key: &str| stats[key].as_str().unwrap().to_owned();
        (word("engine"), word("structure"))
    }

    #[test]
    fn is_the_fast_one_unless_another_structure_is_asked_for() {
        for (options, engine, structure) in [
            (&[][..], "fast", "boxes"),
            (&["--engine", "auto"], "fast", "boxes"),
            (&["--structure", "boxes"], "fast", "boxes"),
            (&["--structure", "none"], "exact", "none"),
            (&["--structure", "lattice"], "exact", "lattice"),
            (&["--structure", "tree"], "exact", "tree"),
            (&["--preset", "pcat"], "exact", "lattice"),
            (&["--preset", "pcat", "--structure", "auto"], "fast", "boxes"),
            (&["--preset", "pcat", "--engine", "fast"], "fast", "boxes"),
            (&["--engine", "exact"], "exact", "boxes"),
            (&["--engine", "exact", "--structure", "boxes"], "exact", "boxes"),
        ] {
            assert_eq!(used(options), (engine.to_owned(), structure.to_owned()), "{options:?}");
        }
    }

    #[test]
    fn shows_the_same_picture() {
        let picture = |engine: &str| done(&run(&["render", "glass", "--format", "pfm", "--engine", engine]));
        assert!(picture("fast") == picture("exact"));
    }

    #[test]
    fn that_can_not_be_had_says_what_to_do() {
        let message = fails(&run(&["render", "die", "--engine", "fast", "--structure", "lattice"]), 2);
        assert!(message.contains("lattice") && message.contains("leave out --engine"), "{message}");
    }
}

mod the_preset {
    use super::*;

    fn levels(options: &[&str]) -> Vec<u8> {
        done(&run(&[&["render", "hanyang", "--format", "levels", "--preset", "pcat"], options].concat()))
    }

    #[test]
    fn is_the_picture_of_the_paper() {
        let picture = text(&levels(&[]));
        let snapshot = include_str!("snapshots/pcat__front.snap");
        assert!(snapshot.contains(picture.trim_end()), "not figure 8");
        assert_eq!(picture.lines().map(str::len).collect::<Vec<_>>(), [164; 188]);
    }

    #[test]
    fn gives_way_to_what_is_said_besides() {
        let all = levels(&[]);
        for option in [
            &["--shading", "1"][..],
            &["--shadows"],
            &["--tone", "lightness"],
            &["--field", "60x40"],
            &["--zoom", "2"],
        ] {
            let picture = levels(option);
            assert!(picture != all && picture.len() == all.len(), "{option:?}");
        }
        assert_eq!(text(&levels(&["--dots", "30x20"])).lines().count(), 20);
        assert_eq!(text(&levels(&["--cells", "30x20"])).lines().count(), 80);
        assert_eq!(levels(&["--structure", "none"]), all);
        assert_eq!(levels(&["--no-shadows"]), all);
    }
}

#[test]
fn completions_come_for_every_shell() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = text(&done(&run(&["completions", shell])));
        assert!(script.contains("ray13") && script.contains("preset"), "{shell}");
    }
    fails(&run(&["completions", "tcsh"]), 2);
}

#[test]
fn the_manual_has_a_page_for_each_command() {
    let page = text(&done(&run(&["man"])));
    assert!(page.contains(".TH ray13 1") && page.contains("render"), "{page}");
    let page = text(&done(&run(&["man", "render"])));
    assert!(page.contains("ray13-render") && page.contains("preset"), "{page}");
    let message = fails(&run(&["man", "rendre"]), 2);
    assert!(message.contains("render"), "{message}");
}

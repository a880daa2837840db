//! A still: its size, formats, channels, options and figures.

use std::fs;

use super::{BALL, done, fails, ray13, run, scene, text};

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
    let levels = done(&run(&["render", &file, "--dots", "20x16", "--format", "pgm", "--levels"]));
    assert!(levels[13..].iter().all(|gray| thirteen.contains(gray)));
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
}

// From a first user: the picture that `-o x.png` made was posterised, of 160 × 100 dots.
#[test]
fn of_pixels_holds_the_lights_own_grays_unless_levels_are_asked_for() {
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
    let plain = still(&["--format", "pgm"]);
    assert!(grays(&plain) > 13);
    assert!(grays(&still(&["--format", "pgm", "--levels"])) <= 13);
    assert_ne!(still(&["--format", "pgm", "--tone", "even"]), plain);
    for format in ["png", "pgm", "ppm"] {
        let plain = still(&["--format", format]);
        assert_eq!(plain, still(&["--format", format, "--channel", "light"]));
        assert_ne!(plain, still(&["--format", format, "--levels"]));
    }
    // The picture of 1986 had levels.
    let preset = |more: &[&str]| still(&[&["--format", "pgm", "--preset", "pcat"][..], more].concat());
    assert_eq!(preset(&[]), preset(&["--levels"]));
    assert_ne!(preset(&[]), preset(&["--channel", "light"]));
}

#[test]
fn of_pixels_has_640_by_400_unless_a_size_is_given() {
    let (_, file) = scene("pixels", BALL);
    let header = |more: &[&str]| {
        let bytes = done(&run(&[&["render", &file][..], more].concat()));
        let lines = bytes.split(|&b| b == b'\n').take(2);
        lines.map(text).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(header(&["--format", "pgm"]), "P5 640 400");
    assert_eq!(header(&["--format", "ppm"]), "P6 640 400");
    assert_eq!(header(&["--format", "pfm"]), "Pf 640 400");
    assert_eq!(header(&["--format", "pgm", "--cells", "20x10"]), "P5 40 40");
    assert_eq!(header(&["--format", "pgm", "--cells", "20x10", "--glyphs", "shade"]), "P5 20 10");
    assert_eq!(header(&["--format", "pgm", "--preset", "pcat"]), "P5 164 188");
    let png = done(&run(&["render", &file, "--format", "png"]));
    assert_eq!(png[16..24], [0, 0, 2, 128, 0, 0, 1, 144]);
}

// From a first user: a blank screen, and no word of why.
#[test]
fn that_is_all_background_says_why() {
    let (_, file) = scene("nothing", BALL);
    let nothing = scene("vanished", "difference() { sphere(1); cube(9, center = true); }\n").1;
    let view = |eye: &'static str, target: &'static str| ["--eye", eye, "--target", target];
    let cases = [
        (&file, view("0,-5,0", "0,-9,0"), "the scene is behind the eye"),
        (&file, view("0,-5,0", "5,-5,0"), "the scene is beside the field"),
        (&file, view("1e300,0,0", "0,0,0"), "the eye is over 1e15 times the scene's size away"),
        (&file, view("0,9e5,0", "0,0,0"), "the scene is smaller than a dot"),
        (&nothing, view("0,-5,0", "0,0,0"), "nothing"),
    ];
    for (file, view, why) in cases {
        for start in [&["render"][..], &[]] {
            let output = run(&[start, &[file], &["--cells", "8x4"], &view].concat());
            let said = text(&output.stderr);
            if output.status.code() == Some(2) {
                // A scene that holds nothing may be refused before it is drawn.
                assert_eq!(file, &nothing, "{said}");
                continue;
            }
            assert_eq!(output.status.code(), Some(0), "{said}");
            assert!(said.contains("nothing in view") && said.contains(why), "{said}");
            assert!(text(&output.stdout).trim().is_empty());
        }
    }
    let stats = |form: &str, eye: &str| {
        let size = ["--cells", "8x4", "--stats", form, "--target", "0,0,0", "--eye", eye];
        text(&run(&[&["render", &file], &size[..]].concat()).stderr)
    };
    let json =
        |eye: &str| serde_json::from_str::<serde_json::Value>(&stats("json", eye)).expect("JSON alone");
    assert!(json("1e300,0,0")["nothing_in_view"].as_str().unwrap().contains("size away"));
    assert_eq!(json("1e300,0,0")["primary_hits"], 0);
    let seen = json("5,0,0");
    assert!(seen["nothing_in_view"].is_null() && seen.get("nothing_in_view").is_some(), "{seen}");
    assert!(stats("text", "1e300,0,0").contains("nothing_in_view"));
    assert!(!stats("text", "5,0,0").contains("nothing_in_view"));
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
    let not = run(&["render", &file, "--cells", "40x20", "--format", "txt", "--no-invert"]);
    assert_eq!(text(&not.stdout), still(&[]));
    assert!(text(&not.stderr).contains("--no-invert has no effect"), "{}", text(&not.stderr));
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
            done(&run(&[&["render", &file, "--cells", "40x20", "--format", "ans"][..], &option].concat()));
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
    let views = "camera(name = \"a\", eye = [0, -9, 3]);\ncamera(name = \"b\", eye = [9, 0, 3]);\ncube(2);\n";
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
    let stats: serde_json::Value = serde_json::from_slice(&output.stderr).expect("JSON on standard error");
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

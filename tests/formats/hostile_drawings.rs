//! Drawings that nobody means well with: an answer, or an error with the file's name and a line, soon.

use std::fs;
use std::time::{Duration, Instant};

use ray13::scene::{ReadOptions, read_file};

use crate::support::drawings::{block, dxf, entity, folder, svg};

/// What reading a scene gives that imports a file, and in which time.
fn told(at: &std::path::Path, name: &str, bytes: &[u8]) -> String {
    fs::write(at.join(name), bytes).unwrap();
    let scene = at.join("a.scene");
    fs::write(&scene, format!("import(\"{name}\");")).unwrap();
    let began = Instant::now();
    let told = match read_file(&scene, &ReadOptions::default()) {
        Ok(scene) => scene.notes.join("; "),
        Err(why) => why.to_string(),
    };
    // Two million corners take a second or two; tests run side by side, on whatever there is.
    assert!(began.elapsed() < Duration::from_secs(60), "{name}: {:?}", began.elapsed());
    told
}

/// Holds files against parts of what is to be said of them; of what is drawn nothing is.
fn hold(at: &str, files: &[(&str, Vec<u8>, &str)]) {
    let at = folder(at);
    for (name, bytes, says) in files {
        let told = told(&at, name, bytes);
        assert!(told.contains(says), "{name}: {told}\ninstead of: {says}");
        assert!(told.is_empty() == says.is_empty(), "{name}: {told}");
        let is_error = told.contains("can not be imported");
        assert!(!is_error || told.contains(&format!("`{name}`")), "{name}: {told}");
    }
}

#[test]
fn no_dxf_file_takes_long_or_more_than_it_has() {
    let triangle = "8 0, 70 1, 10 0, 20 0, 10 4, 20 0, 10 0, 20 2";
    let poly = |groups: &str| dxf("", &entity("LWPOLYLINE", groups)).into_bytes();
    let of = |name: &str, groups: &str| dxf("", &entity(name, groups)).into_bytes();
    let whole = poly(triangle);
    // Blocks of two blocks of two blocks, and so on.
    let twice = |n: u32| {
        let insert = entity("INSERT", &format!("8 0, 2 b{n}, 10 0, 20 0"));
        block(&format!("b{}", n + 1), &(insert.clone() + &insert))
    };
    let bomb = block("b0", &entity("LWPOLYLINE", triangle)) + &(0..60).map(twice).collect::<String>();
    let bomb = dxf(&bomb, &entity("INSERT", "8 0, 2 b60, 10 0, 20 0"));
    let ring = dxf(
        &(block("a", &entity("INSERT", "2 b, 10 0, 20 0"))
            + &block("b", &entity("INSERT", "2 a, 10 0, 20 0"))),
        &entity("INSERT", "2 a, 10 0, 20 0"),
    );
    // Each spoke crosses half of the others.
    let spokes: String = (0..4000)
        .map(|i| {
            let angle = f64::from(i) * 3.0_f64;
            format!(", 10 {}, 20 {}", angle.rem_euclid(1.7) * 9.0, angle.rem_euclid(2.3) * 9.0)
        })
        .collect();
    hold(
        "hostile-dxf",
        &[
            ("empty.dxf", vec![], "it is empty"),
            ("blank.dxf", b"\n".repeat(1 << 20), "it is empty"),
            ("zeros.dxf", vec![0; 1 << 16], "line 1: a group code is expected"),
            ("binary.dxf", b"AutoCAD Binary DXF\r\n\x1a\0\0".to_vec(), "a binary DXF file"),
            ("text.dxf", b"solid part\nfacet\n".to_vec(), "line 1: a group code is expected"),
            ("svg.dxf", b"<svg>\n</svg>\n".to_vec(), "line 1: a group code is expected"),
            ("cut-code.dxf", whole[..whole.len() - 6].to_vec(), ""),
            ("cut-entity.dxf", whole[..whole.len() - 24].to_vec(), "the file is cut off"),
            ("cut-value.dxf", b"0\nSECTION\n2".to_vec(), "line 3: the file is cut off: a value is missing"),
            ("huge-code.dxf", b"99999999999999999999\nx\n".to_vec(), "line 1: a group code is expected"),
            ("no-number.dxf", poly("70 1, 10 x, 20 0"), "line 16: a number is expected here"),
            ("nan.dxf", poly("70 1, 10 nan, 20 0"), "line 16: this is not a finite number"),
            ("inf.dxf", poly("70 1, 10 1e999, 20 0"), "line 16: this is not a finite number"),
            ("flags.dxf", poly("70 1.5, 10 1, 20 0"), "line 14: a whole number is expected here"),
            ("odd.dxf", poly("70 1, 10 1, 20 0, 10 5"), "lacks a coordinate"),
            ("none.dxf", poly("70 1"), "line 12: this LWPOLYLINE lacks a coordinate"),
            ("one.dxf", poly("70 1, 10 1, 20 1"), "there is no line"),
            ("line.dxf", of("LINE", "10 1, 20 1"), "this LINE lacks a coordinate"),
            ("flat.dxf", poly("70 1, 10 1, 20 1, 10 2, 20 2, 10 3, 20 3"), "empty"),
            (
                "far.dxf",
                poly("70 1, 10 1e308, 20 0, 10 -1e308, 20 1e308, 10 0, 20 -1e308"),
                "reaches farther than",
            ),
            ("far-circle.dxf", of("CIRCLE", "10 1e308, 20 0, 40 1.7e308"), "reaches farther"),
            ("radius.dxf", of("CIRCLE", "10 0, 20 0, 40 -5"), ""),
            ("arc.dxf", of("ARC", "10 0, 20 0, 40 5, 50 1e300, 51 -1e300"), "there is no line"),
            ("turns.dxf", of("ARC", "10 0, 20 0, 40 5, 50 0, 51 1e12"), "more than 2e6 sides"),
            ("ellipse.dxf", of("ELLIPSE", "10 0, 20 0, 11 0, 21 0, 40 1e300, 41 0, 42 6"), "empty"),
            ("unknown.dxf", of("SPLINE", "10 0, 20 0"), "does not read is left out: SPLINE"),
            ("missing.dxf", of("INSERT", "2 b, 10 0, 20 0"), "a block that is inserted is not there: b"),
            ("bomb.dxf", bomb.into_bytes(), "more than 2e6 sides"),
            ("ring.dxf", ring.into_bytes(), "a block that is inserted is not there: b"),
            ("insert.dxf", of("INSERT", "2 b, 10 0"), "this INSERT lacks a coordinate"),
            ("tangle.dxf", poly(&format!("70 1{spokes}")), "cross too often"),
        ],
    );
}

#[test]
fn no_svg_file_takes_long_or_more_than_it_has() {
    let page = |elements: &str| svg("", elements).into_bytes();
    let path = |data: &str| page(&format!("<path d='{data}'/>"));
    let whole = path("M0 0h9v9z");
    let scribble: String = (0..4000)
        .map(|i| {
            let angle = f64::from(i) * 3.0_f64;
            format!("L{} {}", angle.rem_euclid(1.7) * 9.0, angle.rem_euclid(2.3) * 9.0)
        })
        .collect();
    let entities = "<!DOCTYPE svg [<!ENTITY a \"1 1\"><!ENTITY b \"&a;&a;&a;\">]><svg><path d='M&b;'/></svg>";
    hold(
        "hostile-svg",
        &[
            ("empty.svg", vec![], "an element `svg` is expected"),
            ("blank.svg", b" \n".repeat(1 << 20), "an element `svg` is expected"),
            ("zeros.svg", vec![0; 1 << 16], "an element `svg` is expected"),
            ("no-text.svg", b"<svg>\xff</svg>".to_vec(), "line 1: UTF-8 text is expected"),
            ("dxf.svg", b"0\nSECTION\n".to_vec(), "an element `svg` is expected"),
            ("html.svg", b"<html><svg/></html>".to_vec(), "an element `svg` is expected"),
            ("cut.svg", whole[..whole.len() - 8].to_vec(), "the file is cut off"),
            ("cut-tag.svg", whole[..whole.len() - 14].to_vec(), "line 3: this is no XML"),
            ("unpaired.svg", page("<g></svg>"), "this is no XML"),
            ("deep.svg", page(&"<g>".repeat(100_000)), "line 3: elements are nested deeper than 256"),
            ("groups.svg", page(&"<g transform='scale(1e9)'>".repeat(200)), "this is no XML"),
            ("entities.svg", entities.into(), "this is no XML"),
            ("doctype.svg", "<!DOCTYPE svg>\n<svg><rect width='2' height='3'/></svg>".into(), ""),
            ("use.svg", page("<g id='a'><use href='#a'/></g>"), "does not read is left out: use (1)"),
            (
                "far.svg",
                page("<rect width='1' height='1' transform='scale(1e308) scale(1e308)'/>"),
                "line 3: this reaches",
            ),
            ("nan.svg", page("<rect width='nan' height='1'/>"), "a length that has a unit is 0"),
            (
                "no-map.svg",
                page("<g transform='turn(3)'/>"),
                "line 3: `transform` can not be read from `(3)` on",
            ),
            ("half-map.svg", page("<g transform='scale(3'/>"), "line 3: `transform` can not be read"),
            (
                "inf-map.svg",
                page("<g transform='scale(1e999)'/>"),
                "line 3: a number in `transform` is not finite",
            ),
            ("points.svg", page("<polygon points='1 2 x'/>"), "line 3: `points` has `x`"),
            ("flat.svg", page("<rect width='1' height='0'/>"), "empty"),
            (
                "view.svg",
                svg(
                    "viewBox='0 0 1e-300 1e-300' width='1e300' height='1e300'",
                    "<rect width='1' height='1'/>",
                )
                .into(),
                "reaches farther",
            ),
            ("no-view.svg", svg("viewBox='0 0 0 nan'", "<rect width='2' height='3'/>").into(), ""),
            ("command.svg", path("M0 0x9"), "line 3: `x` is no command"),
            ("number.svg", path("M0 0L1e9 z"), "line 3: a path has `z` where a number"),
            ("no-command.svg", path("0 0 9 9"), "line 3: a path has `0 0 9 9` where a command"),
            ("inf.svg", path("M0 0L1e999 0"), "line 3: a number in a path is not finite"),
            ("flag.svg", path("M0 0A1 1 0 2 0 3 3"), "line 3: a path has `2 0 3 3` where 0 or 1"),
            ("end.svg", path("M0 0A1 1 0 1 0 3"), "line 3: a path ends where a number"),
            ("arcs.svg", path("M0 0A1e-300 1e300 0 1 0 3 3z"), "line 3: a path reaches farther"),
            (
                "many.svg",
                path(&format!("M0 0{}", "q1 1 2 0".repeat(110_000))),
                "line 3: the drawing has more than 2e6",
            ),
            ("wide.svg", page("<line x2='1' stroke-width='1e30' stroke-linecap='round'/>"), ""),
            ("scribble.svg", path(&format!("M0 0{scribble}")), "line 3: a line crosses itself too often"),
            ("tangle.svg", path(&format!("M0 0{scribble}z")), "cross too often"),
        ],
    );
}

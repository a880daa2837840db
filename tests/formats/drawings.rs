//! Drawings beside OpenSCAD's own export of what it imports: the same corners, the same area.

use std::fs;
use std::path::Path;

use ray13::scene::{FacetMode, ReadOptions, read_file};

use crate::support::drawings::{
    area_of_outlines, block, dxf, entity, exported_outlines, farthest_from, folder, own_area, own_corners,
    svg,
};
use crate::support::openscad::{exported, in_parallel, is_missing};

/// Holds what is imported by calls against what OpenSCAD makes of them. `off` is how far it moves corners.
#[track_caller]
fn hold(folder: &Path, calls: &[&str], facets: FacetMode, off: f64) {
    if is_missing() {
        return;
    }
    let options = ReadOptions { facets, ..ReadOptions::default() };
    let numbered: Vec<(usize, &str)> = calls.iter().copied().enumerate().collect();
    in_parallel(&numbered, |(number, call)| {
        let program = folder.join(format!("{number}.scad"));
        fs::write(&program, call).unwrap();
        let svg = exported(&program, "svg").unwrap_or_else(|| panic!("OpenSCAD makes nothing of {call}"));
        let scene = read_file(&program, &options).unwrap_or_else(|why| panic!("{call}: {why}"));
        let (theirs, own) = (exported_outlines(&svg), own_corners(&scene));
        let size = own.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        // Six digits are written.
        let near = off + 1e-5 * size;
        let corners = theirs.concat();
        let [missing, more] = [farthest_from(&corners, &own), farthest_from(&own, &corners)];
        assert!(missing.0 <= near && more.0 <= near, "{call}: corners are off: {missing:?} {more:?}");
        let (area, expected) = (own_area(&scene), area_of_outlines(&theirs));
        let around: f64 = theirs
            .iter()
            .flat_map(|ring| (0..ring.len()).map(|i| (ring[i] - ring[(i + 1) % ring.len()]).length()))
            .sum();
        assert!((area - expected).abs() <= near * around, "{call}: an area of {area} for {expected}");
    });
}

/// OpenSCAD has the corners of a DXF file on a grid of this width, and a cell beside one that is taken counts
/// as that.
const CELL: f64 = 1.0 / 1024.0;

#[test]
fn dxf_is_what_openscad_makes_of_it() {
    let at = folder("dxf");
    let round = [
        entity("CIRCLE", "8 disc, 10 5, 20 6, 40 4"),
        entity("ARC", "8 arc, 10 25, 20 6, 40 4, 50 200, 51 30"),
        entity("ELLIPSE", "8 whole, 10 45, 20 6, 11 4, 21 3, 40 0.5, 41 0, 42 6.283185307179586"),
        entity("ELLIPSE", "8 part, 10 65, 20 6, 11 4, 21 -3, 40 0.5, 41 5, 42 3"),
    ];
    fs::write(at.join("round.dxf"), dxf("", &round.concat())).unwrap();
    // A gap less than a cell, one more than two, a T, a line that is open, outlines that cross.
    let lines = [
        "8 tri, 10 0, 20 0, 11 10, 21 0",
        "8 tri, 10 10.0006, 20 0.0004, 11 10, 21 8",
        "8 tri, 10 0, 20 0, 11 10, 21 8.0004",
        "8 tee, 10 20, 20 0, 11 30, 21 0",
        "8 tee, 10 30, 20 0, 11 30, 21 10",
        "8 tee, 10 30, 20 10, 11 20, 21 0",
        "8 tee, 10 30, 20 10, 11 40, 21 20",
        "8 tee, 10 40, 20 20, 11 45, 21 0",
        "8 gap, 10 50, 20 0, 11 60, 21 0",
        "8 gap, 10 60.01, 20 0.01, 11 60, 21 7",
        "8 gap, 10 60, 20 7, 11 50, 21 0",
    ];
    let lines: String = lines.iter().map(|line| entity("LINE", line)).collect();
    let square = |x: u32| {
        format!("8 two, 70 1, 10 {x}, 20 {x}, 10 {0}, 20 {x}, 10 {0}, 20 {0}, 10 {x}, 20 {0}", x + 9)
    };
    let polylines = [
        entity("LWPOLYLINE", "8 open, 70 0, 10 70, 20 0, 10 80, 20 0, 10 80, 20 5"),
        entity("LWPOLYLINE", &square(90)),
        entity("LWPOLYLINE", &square(94)),
        entity("LWPOLYLINE", "8 bulge, 70 1, 10 0, 20 30, 42 1, 10 9, 20 30, 10 0, 20 36"),
    ];
    fs::write(at.join("lines.dxf"), dxf("", &(lines + &polylines.concat())).replace('\n', "\r\n")).unwrap();
    let small = entity("LWPOLYLINE", "8 q, 70 1, 10 0, 20 0, 10 4, 20 0, 10 0, 20 2")
        + &entity("CIRCLE", "8 q, 10 8, 20 0, 40 2");
    let blocks = block("small", &small)
        + &block("twice", &entity("INSERT", "8 z, 2 small, 10 1, 20 2, 50 90"))
        + &block("itself", &(entity("INSERT", "8 z, 2 itself, 10 1, 20 2") + &small));
    let inserts = entity("INSERT", "8 one, 2 small, 10 20, 20 0, 41 2, 42 -1, 50 30")
        + &entity("INSERT", "8 two, 2 twice, 10 40, 20 10")
        + &entity("INSERT", "8 loop, 2 itself, 10 40, 20 30");
    fs::write(at.join("blocks.dxf"), dxf(&blocks, &inserts)).unwrap();
    let calls = &[
        "import(\"round.dxf\");",
        "import(\"round.dxf\", $fn = 7);",
        "import(\"round.dxf\", $fa = 3, $fs = 0.1);",
        "import(\"round.dxf\", layer = \"part\", $fn = 8, scale = 2);",
        "import(\"round.dxf\", layer = \"whole\", $fn = 8, origin = [5, 1], scale = 0.5);",
        "import(\"lines.dxf\");",
        "import(\"lines.dxf\", layer = \"tri\", origin = [-3, 1.5], scale = 3);",
        "import(\"lines.dxf\", layer = \"tee\", scale = -1);",
        "import(\"lines.dxf\", layer = \"two\");",
        "import(\"blocks.dxf\", $fn = 5);",
        "import(\"blocks.dxf\", layer = \"one\", scale = 2, origin = [10, 0]);",
        "import(\"blocks.dxf\", layer = \"two\", scale = 2);",
    ];
    hold(&at, calls, FacetMode::Smooth, 2.5 * CELL);
    // Then they are moved to 65,536ths.
    hold(&at, calls, FacetMode::OpenScad, 3e-5);
}

#[test]
fn svg_is_what_openscad_makes_of_it() {
    let at = folder("svg");
    let rect = "<rect x='1' y='2' width='4' height='3'/>";
    let shapes = "<rect x='1' y='2' width='10' height='4' rx='1'/><rect x='21' y='2' width='10' height='4' ry='9'/>\
                  <circle cx='40' cy='9' r='5'/><ellipse cx='60' cy='9' rx='5' ry='2'/>\
                  <polygon points='71,2 80 2,80,8 5'/><line x1='81' y1='2' x2='90' y2='4' stroke-width='2'/>\
                  <line x1='1' y1='22' x2='9' y2='22' style='fill:none;stroke-width:3;stroke: red;stroke-linecap:butt'/>\
                  <polyline points='21,22 30,22 30,28'/><polyline stroke-width='2' points='40,20 50,20 50,30 40,20'/>\
                  <rect x='4px' y='30' width='9' height='2'/>";
    let paths = "<path d='M1 2L10 2V8'/><path d='M21 2h9v9h-9zM23 4v3h3v-3z'/><path d='M41.5.5L50 2 43-4z'/>\
                 <path d='M61 2C65 10 69 10 72 2 s 3-3 4 0z'/><path d='M81 2Q85 10 89 2T96 3V20z'/>\
                 <path d='M1 22A 3 3 0 0 1 7 22z'/><path d='M21 22a 3 5 30 1 0 3 3z'/><path d='M41 22a9 5 20 0 1 9 3z'/>\
                 <path d='M60 20 L70 20 70 30 60 30zM80 20 90 20 90 25'/><path d='M1 40L10 40 10 45M20 40L30 40 30 49z'/>\
                 <path d='M41 41 l 9 0 0 9 z m 3 2 l5 0 0 5z' fill-rule='nonzero'/>";
    let moved = "<g transform='translate(10)'><g transform='scale(2) rotate(90)'>RECT</g></g>\
                 <rect x='31' y='2' width='4' height='3' transform='rotate(90 31 2) translate(5,0)'/>\
                 <rect x='1' y='22' width='4' height='3' transform='skewX(45)'/>\
                 <rect x='41' y='22' width='4' height='3' transform='skewY(-30),matrix(1 0 0 2 3 4)'/>\
                 <g transform='scale(1,-2)'><line x1='1' y1='0' x2='9' y2='0' stroke-width='1.5'/></g>\
                 <g transform='translate(1 2 3)' style='display:none'><rect x='60' y='2' width='4' height='3'/></g>\
                 <defs>RECT</defs><clipPath><rect x='70' y='2' width='4' height='3'/></clipPath><text x='1'>A</text>";
    let united = "<rect x='0' y='0' width='9' height='9'/><rect x='5' y='5' width='9' height='9'/>\
                  <path d='M2 2h2v2h-2z'/>";
    for (name, elements) in [("shapes", shapes), ("paths", paths), ("moved", moved), ("united", united)] {
        fs::write(at.join(format!("{name}.svg")), svg("", &elements.replace("RECT", rect))).unwrap();
    }
    let pages = [
        "width='100' height='50'",
        "width='100mm' height='50mm'",
        "width='100mm' height='50mm' viewBox='0 0 10 10'",
        "width='100mm' height='50mm' viewBox='1,1,10,10' preserveAspectRatio='none'",
        "width='100mm' height='50mm' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMin slice'",
        "width='1in' height='2cm' viewBox='0 0 10 20' preserveAspectRatio='xMinYMax'",
        "width='100%' height='100%' viewBox='0 0 10 10'",
        "width='20pc' height='30pt' viewBox='3 4 10 10'",
        "width='200px' height='30px' viewBox='0 0 10 10'",
        "viewBox='0 0 10 10'",
    ];
    let mut calls: Vec<String> =
        ["shapes", "paths", "moved", "united"].map(|name| format!("import(\"{name}.svg\", $fn = 7);")).into();
    for (number, page) in pages.iter().enumerate() {
        fs::write(at.join(format!("{number}.svg")), svg(page, rect)).unwrap();
        calls.push(format!("import(\"{number}.svg\");"));
        calls.push(format!("import(\"{number}.svg\", center = true, dpi = 96);"));
    }
    calls.push("import(\"9.svg\", dpi = 0, scale = 3, origin = [1, 1]);".to_owned());
    let calls: Vec<&str> = calls.iter().map(String::as_str).collect();
    // Strokes are moved to ten-thousandths, figures to 65,536ths.
    hold(&at, &calls, FacetMode::Smooth, 3e-4);
}

#[test]
fn of_an_svg_file_a_layer_or_an_element_can_be_asked_for() {
    let at = folder("parts");
    let squares = "<g id='a'><rect width='1' height='1'/><g><rect id='b' x='2' width='2' height='2'/></g></g>\n\
                   <g inkscape:groupmode='layer' inkscape:label='top'><rect x='5' width='3' height='3'/></g>";
    fs::write(at.join("parts.svg"), svg("", squares)).unwrap();
    for (which, area) in [
        ("", 14.0),
        (", id = \"a\"", 5.0),
        (", id = \"b\"", 4.0),
        (", layer = \"top\"", 9.0),
        (", id = \"c\"", 0.0),
    ] {
        let scene = at.join("parts.scene");
        // Something must be there.
        fs::write(&scene, format!("translate([0, 0, -9]) cube(1); import(\"parts.svg\"{which});")).unwrap();
        let scene = read_file(&scene, &ReadOptions::default()).unwrap();
        assert!((own_area(&scene) - area).abs() < 1e-12, "{which}: {}", own_area(&scene));
        let is_said = scene.notes.iter().any(|note| note.contains("nothing in it is of that"));
        assert_eq!(is_said, area == 0.0, "{which}: {:?}", scene.notes);
    }
}

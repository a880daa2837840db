//! Letters beside OpenSCAD's own export of them: the same corners in the same places.

use glam::DVec2;
use ray13::scene::{ReadOptions, Shape, Solid, read};

use crate::support::openscad::{exported_text, in_parallel, is_missing};

/// Texts, and by how much of their size a corner may be elsewhere: OpenSCAD writes six digits, and fits
/// letters of lines from top to bottom to dots.
const TEXTS: [(&str, f64); 14] = [
    ("text(\"Hg\", size = 10, $fn = 16);", 1e-5),
    ("text(\"AVATo Te\", size = 10, halign = \"center\", valign = \"center\", $fn = 32);", 1e-5),
    ("text(\"AVATo\", size = 10, spacing = 1.3, halign = \"right\", valign = \"top\", $fn = 8);", 1e-5),
    ("text(\"Grüße, Ähre\", size = 7, valign = \"bottom\", $fn = 40);", 1e-5),
    ("text(\"שלום\", size = 10, $fn = 16);", 1e-5),
    ("text(\"شمس\", size = 10, halign = \"center\", $fn = 16);", 1e-5),
    ("text(\"Tab\", direction = \"ttb\", $fn = 16);", 4e-4),
    ("text(\"Tab\", direction = \"ttb\", halign = \"center\", valign = \"center\", $fn = 16);", 4e-4),
    ("text(\"Tab\", direction = \"btt\", halign = \"right\", valign = \"bottom\", $fn = 16);", 4e-4),
    ("text(\"Bold fi\", font = \"Liberation Sans:style=Bold\", size = 42, spacing = 0.9);", 1e-5),
    ("text(\"Mono\", font = \"DejaVu Sans Mono:style=Bold Oblique\", $fn = 100);", 1e-5),
    ("text(\"office\", font = \"Times New Roman:style=Bold Italic\", valign = \"center\");", 1e-5),
    ("text(\"x²☺\", font = \"No Such Font\", valign = \"center\");", 1e-5),
    ("text(\"Tiny\", size = 1, $fs = 0.1);", 1e-5),
];

/// The corners of an SVG file as OpenSCAD writes it.
fn svg_corners(svg: &str) -> Vec<DVec2> {
    let words: Vec<&str> = svg.split_whitespace().collect();
    let corner = |pair: &[&str]| {
        let (x, y) = pair[1].split_once(',')?;
        ["M", "L"].contains(&pair[0]).then_some(DVec2::new(x.parse().ok()?, -y.parse::<f64>().ok()?))
    };
    words.windows(2).filter_map(corner).collect()
}

fn own_corners(solid: &Solid) -> Vec<DVec2> {
    let mut corners = Vec::new();
    solid.visit(&mut |primitive| {
        if let Shape::Mesh(mesh) = &primitive.shape {
            corners.extend(mesh.points.iter().map(|&p| primitive.map.transform_point3(p).truncate()));
        }
    });
    corners
}

#[test]
fn letters_have_the_corners_of_openscad() {
    if is_missing() {
        return;
    }
    in_parallel(&TEXTS, |&(text, share)| {
        let scene = match read("text", text.as_bytes(), &ReadOptions::default()) {
            Err(errors) if errors.to_string().contains("no font on this machine") => {
                return eprintln!("skipped: there is no font on this machine");
            }
            other => other.unwrap_or_else(|errors| panic!("{errors}")),
        };
        let own: Vec<DVec2> = scene.objects.iter().flat_map(|object| own_corners(&object.solid)).collect();
        let svg = exported_text(text, "svg").unwrap_or_else(|| panic!("no export of {text}"));
        let theirs = svg_corners(str::from_utf8(&svg).unwrap());
        let size = theirs.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        // Half a unit of the last of six digits, of coordinates up to ten sizes.
        let near = share * size;
        for &corner in &theirs {
            let nearest = own.iter().map(|&p| (p - corner).length()).fold(f64::INFINITY, f64::min);
            assert!(nearest <= near, "{text}: {corner} is {nearest} off");
        }
        let farthest =
            |of: &[DVec2]| of.iter().fold([DVec2::MAX, DVec2::MIN], |[l, h], &p| [l.min(p), h.max(p)]);
        let [[low, high], [own_low, own_high]] = [farthest(&theirs), farthest(&own)];
        assert!((low - own_low).length().max((high - own_high).length()) <= 2.0 * near, "{text}");
    });
}

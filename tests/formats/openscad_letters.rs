//! Letters beside OpenSCAD's own export of them: the same corners in the same places.

use glam::DVec2;
use ray13::scene::{ReadOptions, read};

use crate::support::drawings::{exported_outlines, farthest_from, own_corners};
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
        let own = own_corners(&scene);
        let svg = exported_text(text, "svg").unwrap_or_else(|| panic!("no export of {text}"));
        let theirs = exported_outlines(&svg).concat();
        let size = theirs.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        // Half a unit of the last of six digits, of coordinates up to ten sizes.
        let near = share * size;
        let (off, corner) = farthest_from(&theirs, &own);
        assert!(off <= near, "{text}: {corner} is {off} off");
        let farthest =
            |of: &[DVec2]| of.iter().fold([DVec2::MAX, DVec2::MIN], |[l, h], &p| [l.min(p), h.max(p)]);
        let [[low, high], [own_low, own_high]] = [farthest(&theirs), farthest(&own)];
        assert!((low - own_low).length().max((high - own_high).length()) <= 2.0 * near, "{text}");
    });
}

#[test]
fn fonts_are_looked_for_by_the_first_text_of_all_that_share_them() {
    let options = ReadOptions::default();
    let known = || format!("{:?}", options.fonts);
    let _ = read("text", b"cube(1);", &options);
    assert_eq!(known(), "KnownFonts(None)");
    let _ = read("text", b"text(\"a\");", &options);
    assert!(known().starts_with("KnownFonts(Some("), "{}", known());
    assert_eq!(format!("{:?}", options.clone().fonts), known());
    assert_eq!(format!("{:?}", ReadOptions::default().fonts), "KnownFonts(None)");
}

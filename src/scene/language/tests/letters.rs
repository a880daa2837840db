//! `text`. Where the machine has no font, only what is said then is tested.

use super::{errors, primitives, scene};
use crate::math::{Bounds, DVec2};
use crate::scene::{ReadOptions, Scene, Shape, read};

/// Whether there is a font; says so where not.
fn has_fonts() -> bool {
    let is_there = read("test", b"text(\"A\");", &ReadOptions::default()).is_ok();
    if !is_there {
        eprintln!("skipped: there is no font on this machine");
    }
    is_there
}

fn corners(scene: &Scene) -> Vec<DVec2> {
    let of_mesh = |shape: &Shape| match shape {
        Shape::Mesh(mesh) => mesh.points.iter().map(|p| p.truncate()).collect(),
        _ => Vec::new(),
    };
    primitives(scene).iter().flat_map(|primitive| of_mesh(&primitive.shape)).collect()
}

fn bounds(text: &str) -> Bounds {
    Bounds::around(corners(&scene(text)).into_iter().map(|p| p.extend(0.0)))
}

#[test]
fn a_capital_is_about_as_high_as_the_size_and_stands_on_the_line() {
    if !has_fonts() {
        return;
    }
    let box_of = bounds("text(\"E\", size = 30);");
    assert!(box_of.lo.y.abs() < 0.1 && (27.0..34.0).contains(&box_of.hi.y), "{box_of:?}");
    assert!(box_of.lo.x > 0.0 && box_of.hi.x < 30.0, "{box_of:?}");
    let twice = bounds("text(\"E\", size = 60);");
    assert!((twice.hi - box_of.hi * 2.0).length() < 1e-9, "{twice:?}");
}

#[test]
fn lines_are_put_where_they_are_aligned_to() {
    if !has_fonts() {
        return;
    }
    let of = |arguments: &str| bounds(&format!("text(\"Hg\", {arguments});"));
    let plain = of("$fn = 20");
    let (right, middle) = (of("halign = \"right\", $fn = 20"), of("halign = \"center\", $fn = 20"));
    let way = plain.hi.x - right.hi.x;
    assert!(right.hi.x <= 0.0 && right.lo.x < -10.0, "{right:?}");
    assert!((plain.hi.x - middle.hi.x - 0.5 * way).abs() < 1e-9, "{middle:?}");
    let [top, bottom, centred] =
        ["top", "bottom", "center"].map(|name| of(&format!("valign = \"{name}\", $fn = 20")));
    // OpenSCAD takes heights by 1000/1024.
    let off = 0.03 * (plain.hi.y - plain.lo.y);
    assert!(top.hi.y.abs() < off && bottom.lo.y.abs() < off, "{top:?} {bottom:?}");
    assert!((centred.lo.y + centred.hi.y).abs() < off, "{centred:?}");
    assert!(of("spacing = 2, $fn = 20").hi.x > plain.hi.x + 5.0);
    let down = of("direction = \"ttb\"");
    assert!(down.lo.y < -15.0 && down.hi.x - down.lo.x < plain.hi.x - plain.lo.x, "{down:?}");
}

#[test]
fn a_letter_has_its_holes_and_curves_their_sides() {
    if !has_fonts() {
        return;
    }
    let count = |sides: u32| corners(&scene(&format!("text(\"o\", $fn = {sides});"))).len();
    // Two sides for each curve at least, then one more for each eight of a circle.
    assert_eq!(count(8), count(15));
    assert!(count(16) > count(15) && count(80) > 3 * count(16));
    let ring = scene("text(\"o\", size = 20, halign = \"center\");");
    let distances = corners(&ring).into_iter().map(|p| (p - DVec2::new(0.0, 7.6)).length());
    assert!(distances.fold(f64::INFINITY, f64::min) > 2.0, "nothing of an o is at its middle");
}

#[test]
fn letters_are_figures_like_others() {
    if !has_fonts() {
        return;
    }
    for text in [
        "linear_extrude(2) text(\"ab\");",
        "difference() { cube(20); linear_extrude(2) text(\"ab\"); }",
        "linear_extrude(2, twist = 20) offset(r = 0.2) text(\"ab\");",
        "hull() linear_extrude(2) text(\"ab\");",
        "linear_extrude(1) text(\"שלום\");",
        "linear_extrude(1) text(\"x\", size = -4, spacing = -1);",
    ] {
        assert!(!scene(text).objects.is_empty(), "{text}");
    }
    for nothing in ["text(\"\");", "text();", "text(\"   \");", "text(\"A\", size = 0);"] {
        let text = format!("cube(1); linear_extrude(1) {nothing}");
        let read = read("test.csg", text.as_bytes(), &ReadOptions::default());
        assert_eq!(read.unwrap_or_else(|e| panic!("{nothing}: {e}")).objects.len(), 1, "{nothing}");
    }
}

#[test]
fn a_font_that_is_not_there_is_named_with_the_one_taken() {
    if !has_fonts() {
        return;
    }
    let notes = |text: &str| scene(text).notes.join("\n");
    let note = notes("text(\"A\", font = \"No Such Font:style=Bold\");");
    assert!(note.contains("no font `No Such Font`") && note.contains("is taken"), "{note}");
    let note = notes("text(\"\u{f8fe}\");");
    assert!(note.contains("a letter of `text`"), "{note}");
}

#[test]
fn what_is_wrong_with_a_text_is_said() {
    for (text, word) in [
        ("text(7);", "double quotes"),
        ("text(\"A\", halign = \"middle\");", "left, center, right"),
        ("text(\"A\", valign = \"middle\");", "baseline, bottom, center, top"),
        ("text(\"A\", direction = \"up\");", "ltr, rtl, ttb, btt"),
        ("text(\"A\", size = \"big\");", "a number"),
        ("text(\"A\", colour = 1);", "no argument"),
    ] {
        let errors = errors(text);
        assert!(errors.contains(word) && errors.starts_with("test:1:"), "{errors}");
    }
    if has_fonts() {
        let long = "o".repeat(300_000);
        for text in ["text(\"o\", $fn = 1e9);".to_owned(), format!("text(\"{long}\", $fn = 200);")] {
            let errors = errors(&text);
            assert!(errors.contains("corners"), "{errors}");
        }
        let huge = read("test.csg", b"cube(1); text(\"A\", size = 1e308);", &ReadOptions::default());
        assert_eq!(huge.map(|scene| scene.objects.len()), Ok(1));
    }
}

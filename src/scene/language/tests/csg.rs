//! Operators, objects and modifiers.

use super::{primitive, scene, structure};
use crate::math::DVec3;

#[test]
fn unions_are_opened_into_objects() {
    assert_eq!(structure("cube(1); sphere(1);"), "a, b");
    assert_eq!(
        structure("union() { cube(1); group() { sphere(1); render() cube(2); } } cube(3);"),
        "a, b, c, d"
    );
    assert_eq!(
        structure("translate([1, 0, 0]) { cube(1); color(\"red\") { cube(1); cube(2); } }"),
        "a, b, c"
    );
    assert_eq!(structure("difference() { union() { cube(1); cube(2); } }"), "a, b");
    assert_eq!(structure("{ cube(1); { cube(2); } }"), "a, b");
}

#[test]
fn an_object_is_not_opened() {
    let scene = scene("object(\"pair\") { cube(1); sphere(1); } object(\"one\") cube(1);");
    let names: Vec<_> = scene.objects.iter().map(|object| object.name.as_deref()).collect();
    assert_eq!(names, [Some("pair"), Some("one")]);
    assert_eq!(
        structure("object(\"pair\") { cube(1); union() { sphere(1); cube(1); } } cube(1);"),
        "(a + b + c), d"
    );
}

#[test]
fn an_object_inside_a_solid_loses_its_name() {
    let scene = scene("difference() {\n cube(1);\n object(\"hole\") sphere(1);\n}");
    assert_eq!(
        scene.notes,
        ["line 3: `object` is inside another solid: it is part of that, without a name of its own"]
    );
    assert_eq!(scene.objects[0].name, None);
}

#[test]
fn solids_are_flat() {
    assert_eq!(structure("difference() { cube(1); cube(2); cube(3); }"), "(a - b - c)");
    assert_eq!(structure("difference() { difference() { cube(1); cube(2); } cube(3); }"), "(a - b - c)");
    assert_eq!(structure("difference() { cube(1); union() { cube(2); cube(3); } }"), "(a - b - c)");
    assert_eq!(structure("difference() { cube(1); difference() { cube(2); cube(3); } }"), "(a - (b - c))");
    assert_eq!(structure("difference() { { cube(1); cube(2); } cube(3); }"), "((a + b) - c)");
    assert_eq!(structure("intersection() { cube(1); intersection() { cube(2); cube(3); } }"), "(a * b * c)");
    assert_eq!(
        structure("intersection() { cube(1); translate([1, 0, 0]) intersection() { cube(2); cube(3); } }"),
        "(a * b * c)"
    );
    assert_eq!(
        structure("intersection() { cube(1); translate([1, 0, 0]) { cube(2); cube(3); } }"),
        "(a * (b + c))"
    );
    assert_eq!(structure("intersection() { cube(1); } difference() { group() cube(1); }"), "a, b");
}

#[test]
fn nothing_is_nothing_as_in_openscad() {
    assert_eq!(structure("sphere(1); difference() { union(); cube(1); }"), "a");
    assert_eq!(structure("sphere(1); intersection() { group() {} cube(1); }"), "a");
    assert_eq!(structure("sphere(1); intersection() { cube(1); intersection(); }"), "a");
    assert_eq!(structure("difference() { cube(1); union(); }"), "a");
    assert_eq!(structure("union() { union(); cube(1); }"), "a");
}

#[test]
fn modifiers() {
    assert_eq!(structure("cube(1); *sphere(1); * translate([0, 0, 1]) nonsense();"), "a");
    // A child that is left out is not the first one.
    assert_eq!(structure("difference() { *cube(1); cube(2); sphere(1); }"), "(a - b)");
    assert_eq!(structure("difference() { %cube(1); cube(2); sphere(1); }"), "(a - b)");
    assert_eq!(structure("difference() { #cube(1); #sphere(1); }"), "(a - b)");
    assert_eq!(scene("cube(1);\n%sphere(1);").notes, ["line 2: `%` leaves `sphere` out"]);
    assert_eq!(structure("cube(1); union() { cube(2); ! difference() { cube(3); cube(4); } }"), "(a - b)");
    assert_eq!(structure("*union() { ! cube(1); } cube(2); cube(3);"), "a, b");
    assert_eq!(structure("*!cube(1); #!sphere(2); !cube(3);"), "a", "the first root counts");
}

#[test]
fn a_root_forgets_what_stands_above_it() {
    let text =
        "material(\"m\", kd = 0.5); translate([5, 0, 0]) color(\"red\") rotate(30, $fn = 6) ! cylinder();";
    let scene = scene(text);
    assert_eq!(scene.materials[0].color, DVec3::splat(0.9));
    assert_eq!(super::bounds(&primitive(text)).hi.x, 1.0);
    assert!(matches!(primitive(text).shape, crate::scene::Shape::Facets(_)), "$fn still reaches it");
}

//! Tests of the language as a whole: text in, scene or messages out.

mod bad_input;
mod csg;
mod documentation;
mod figures;
mod hostile;
mod language;
mod leaves;
mod letters;
mod nesting;
mod polyhedra;

use crate::math::{Bounds, DVec3};
use crate::scene::{Primitive, ReadOptions, Scene, Shape, Solid, read};

/// A scene that reads.
fn scene(text: &str) -> Scene {
    read("test", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The messages of a scene that does not.
fn errors(text: &str) -> String {
    match read("test", text.as_bytes(), &ReadOptions::default()) {
        Ok(scene) => panic!("no error, but {scene:?}"),
        Err(errors) => errors.to_string(),
    }
}

/// All primitives of a scene, in file order.
fn primitives(scene: &Scene) -> Vec<&Primitive> {
    let mut found = Vec::new();
    let mut open: Vec<&Solid> = scene.objects.iter().rev().map(|object| &object.solid).collect();
    while let Some(solid) = open.pop() {
        match solid {
            Solid::Primitive(primitive) => found.push(primitive),
            Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
                open.extend(solids.iter().rev());
            }
        }
    }
    found
}

/// The one primitive of a scene.
fn primitive(text: &str) -> Primitive {
    let scene = scene(text);
    let [one] = primitives(&scene)[..] else { panic!("not one primitive: {scene:?}") };
    one.clone()
}

/// The box around a primitive's own box.
fn bounds(primitive: &Primitive) -> Bounds {
    let own = match &primitive.shape {
        Shape::Facets(facets) => facets.bounds,
        Shape::Mesh(mesh) => Bounds::around(mesh.points.iter().copied()),
        _ => Bounds::new(DVec3::NEG_ONE, DVec3::ONE),
    };
    own.mapped(&primitive.map)
}

/// The structure of a text's solids in a few letters: primitives by their place in the file.
fn structure(text: &str) -> String {
    structured(&scene(text))
}

/// The structure of a scene's solids in a few letters.
fn structured(scene: &Scene) -> String {
    fn write(solid: &Solid, next: &mut usize) -> String {
        let mut join = |solids: &[Solid], sign: &str| {
            let parts: Vec<String> = solids.iter().map(|solid| write(solid, next)).collect();
            format!("({})", parts.join(sign))
        };
        match solid {
            Solid::Union(solids) => join(solids, " + "),
            Solid::Intersection(solids) => join(solids, " * "),
            Solid::Difference(solids) => join(solids, " - "),
            Solid::Primitive(_) => {
                *next += 1;
                format!("{}", char::from(b'a' + (*next - 1) as u8))
            }
        }
    }
    let mut next = 0;
    scene.objects.iter().map(|object| write(&object.solid, &mut next)).collect::<Vec<_>>().join(", ")
}

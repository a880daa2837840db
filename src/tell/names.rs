//! What objects and primitives are called.

use crate::glyph::Paint;
use crate::scene::{Scene, Shape};

/// The names of all that a ray can meet, by the numbers of the assembly: of both, those of the file.
pub struct Names {
    objects: Vec<String>,
    primitives: Vec<String>,
}

impl Names {
    /// Those of a scene; `numbers` has those in the file by those in the assembly.
    pub fn of(scene: &Scene, numbers: &[u32]) -> Self {
        let objects = numbers.iter().map(|&number| object_name(scene, number)).collect();
        let mut primitives = Vec::new();
        for object in &scene.objects {
            object.solid.visit(&mut |primitive| {
                primitives.push(format!("{} {}", shape_name(&primitive.shape), primitives.len() + 1));
            });
        }
        Self { objects, primitives }
    }

    pub fn object(&self, number: u32) -> &str {
        &self.objects[number as usize]
    }

    pub fn primitive(&self, number: u32) -> &str {
        &self.primitives[number as usize]
    }
}

/// What an object is called: its name in quotes, or its number, from 1 in the order of the file.
pub fn object_name(scene: &Scene, object: u32) -> String {
    match scene.objects.get(object as usize).and_then(|object| object.name.as_ref()) {
        // A line break or a quote in a name would look like what stands around it.
        Some(name) => format!("\"{}\"", name.escape_debug()),
        None => format!("object {}", object + 1),
    }
}

fn shape_name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Sphere => "sphere",
        Shape::Cube => "cube",
        Shape::Cone { bottom, top } if bottom == top => "cylinder",
        Shape::Cone { bottom: 0.0, .. } | Shape::Cone { top: 0.0, .. } => "cone",
        Shape::Cone { .. } => "truncated cone",
        Shape::Facets(_) => "polyhedron",
        Shape::Mesh(_) => "mesh",
        Shape::Bezier(_) => "Bézier patches",
        Shape::Sheet(_) => "open mesh",
        Shape::Face(_) => "polygon",
        Shape::Patch(_) => "patch",
        Shape::Tube { .. } => "tube",
    }
}

/// A colour in words; `part` is what the terminal has a colour of its own for.
pub fn paint_name(paint: Paint, part: &str) -> String {
    match paint {
        Paint::Terminal => format!("the terminal's {part}"),
        Paint::Black => "black".to_owned(),
        Paint::DarkGray => "dark gray".to_owned(),
        Paint::LightGray => "light gray".to_owned(),
        Paint::White => "white".to_owned(),
        Paint::Indexed(number) => format!("colour {number}"),
        Paint::Rgb([r, g, b]) => format!("#{r:02x}{g:02x}{b:02x}"),
    }
}

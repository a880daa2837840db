//! Materials: defined by name, applied to children, coloured over, and counted once each.
//!
//! The nearest `material` above a primitive gives its surface. The outermost `color` above it, if any,
//! replaces that surface's colour: OpenSCAD's rule for colours inside colours.

use std::collections::HashMap;

use super::arguments::{BoundArguments, numbers};
use super::lost::Lost;
use crate::math::DVec3;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::language::nearest::{nearest, quoted};
use crate::scene::{Diagnostic, Material, MaterialId};

/// What the words above a primitive say of its surface.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surface {
    /// An index into [`Surfaces::kinds`].
    kind: usize,
    /// Colour and alpha of the outermost `color`.
    tint: Option<(DVec3, f64)>,
}

/// Bytes that a material which is applied may take, in all tables.
pub const BYTES: u64 = 4 * size_of::<Material>() as u64;

/// All materials met so far.
#[derive(Debug)]
pub struct Surfaces {
    /// Every material defined or applied; the first is the default one.
    kinds: Vec<Material>,
    defined: HashMap<String, usize>,
    /// The scene's table: what primitives have, each once, in the order of first use.
    table: Vec<Material>,
    places: HashMap<(Option<String>, [u64; 9]), MaterialId>,
}

impl Default for Surfaces {
    fn default() -> Self {
        let kinds = vec![Material::default()];
        Self { kinds, defined: HashMap::new(), table: Vec::new(), places: HashMap::new() }
    }
}

impl Surfaces {
    /// The scene's table of materials.
    pub fn table(self) -> Vec<Material> {
        self.table
    }

    /// `material(name = …, …);`
    pub fn define(&mut self, arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<(), Reported> {
        let name = arguments.text("name", sink)?.ok_or_else(|| arguments.missing("name", sink))?;
        let material =
            changed(Material { name: Some(name.to_owned()), ..Material::default() }, arguments, sink)?;
        if self.defined.contains_key(name) {
            let message = format!("the material \"{}\" is defined twice", quoted(name));
            let error = Diagnostic::error(arguments.place_of("name"), message).label("the second time");
            return Err(sink.report(error.help(
                "give it another name; to apply the material, write what it is for in place of the `;`",
            )));
        }
        self.defined.insert(name.to_owned(), self.kinds.len());
        self.kinds.push(material);
        Ok(())
    }

    /// `material("name", …) child` and `material(kd = …) child`
    pub fn apply(
        &mut self,
        above: Surface,
        arguments: &BoundArguments<'_, '_>,
        sink: &mut Sink,
    ) -> Result<Surface, Lost> {
        let base = match arguments.text("name", sink)? {
            None => 0,
            Some(name) => match self.defined.get(name) {
                Some(&kind) => kind,
                None => return Err(sink.report(self.unknown(name, arguments)).into()),
            },
        };
        if arguments.other_than(&["name"]).is_none() {
            return Ok(Surface { kind: base, ..above });
        }
        let material = changed(Material { name: None, ..self.kinds[base].clone() }, arguments, sink)?;
        self.kinds.push(material);
        Ok(Surface { kind: self.kinds.len() - 1, ..above })
    }

    fn unknown(&self, name: &str, arguments: &BoundArguments<'_, '_>) -> Diagnostic {
        let message = format!("there is no material \"{}\"", quoted(name));
        let error = Diagnostic::error(arguments.place_of("name"), message);
        let names = self.kinds.iter().filter_map(|material| material.name.as_deref());
        match nearest(name, names) {
            Some(right) => error.help(format!("did you mean \"{}\"?", quoted(right))),
            None => error.help(format!("define it: material(name = \"{}\", kd = 0.8);", quoted(name))),
        }
    }

    /// The material of a primitive, in the scene's table.
    pub fn id(&mut self, surface: Surface) -> MaterialId {
        let mut material = self.kinds[surface.kind].clone();
        if let Some((color, alpha)) = surface.tint {
            material.name = None;
            material.color = color;
            if alpha < 1.0 {
                // As a picture behind a pane: alpha of its colour and of what it mirrors, and the rest of
                // what stands behind.
                material.color *= alpha;
                material.kr *= alpha;
                material.kt = 1.0 - alpha;
            }
        }
        let Material { color, kd, ks, n, kr, kt, index, .. } = material;
        let bits = [color.x, color.y, color.z, kd, ks, n, kr, kt, index].map(f64::to_bits);
        let next = MaterialId(self.table.len() as u32);
        *self.places.entry((material.name.clone(), bits)).or_insert_with(|| {
            self.table.push(material);
            next
        })
    }
}

/// The surface under a `color`.
pub fn tinted(above: Surface, arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<Surface, Lost> {
    // OpenSCAD writes a `color` that names no colour this way, and it has no effect there.
    const NO_COLOR: [f64; 3] = [-1.0; 3];
    let rgba = arguments.value("c").and_then(|value| numbers(&value.value));
    if rgba.is_some_and(|rgba| rgba.starts_with(&NO_COLOR)) {
        return Ok(above);
    }
    let (color, own_alpha) = arguments.color("c", sink)?.ok_or_else(|| arguments.missing("c", sink))?;
    let alpha = arguments.number("alpha", sink)?.or(own_alpha).unwrap_or(1.0);
    Ok(Surface { tint: above.tint.or(Some((color, alpha))), ..above })
}

/// `material` with what the arguments say in place of its own.
fn changed(
    material: Material,
    arguments: &BoundArguments<'_, '_>,
    sink: &mut Sink,
) -> Result<Material, Lost> {
    let mut number = |name: &str, own: f64| arguments.number(name, sink).map(|given| given.unwrap_or(own));
    let (kd, ks) = (number("kd", material.kd)?, number("ks", material.ks)?);
    let (n, kr) = (number("n", material.n)?, number("kr", material.kr)?);
    let (kt, index) = (number("kt", material.kt)?, number("index", material.index)?);
    let color = arguments.color("color", sink)?.map_or(material.color, |(color, _)| color);
    if kr + kt > 1.0 {
        let given = ["kt", "kr"].into_iter().find(|name| arguments.value(name).is_some()).unwrap_or("kt");
        let message =
            format!("`kr` and `kt` add up to {}: more light than arrives would be sent on", kr + kt);
        let error = Diagnostic::error(arguments.place_of(given), message);
        return Err(sink
            .report(error.help("what is mirrored and what is let through are 1 together at most"))
            .into());
    }
    Ok(Material { name: material.name, color, kd, ks, n, kr, kt, index })
}

//! `l` and `f`: what lights the scene, and how its surfaces answer.

use std::collections::HashMap;
use std::ops::Range;

use crate::math::DVec3;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::{Anchor, Diagnostic, Light, Material, MaterialId, Scene};

use super::entity::{Entity, begins_an_entity};
use super::ignored::Extra;
use super::tokens::NffToken;

/// The lights, some perhaps without an intensity of their own.
#[derive(Debug, Default)]
pub struct Lamps {
    lamps: Vec<(DVec3, Option<DVec3>)>,
}

impl Lamps {
    /// `l x y z [r g b]`, or ENFF's `l x y z intensity r g b`.
    pub fn read(&mut self, entity: &mut Entity) -> Result<(), Reported> {
        let at = entity.vector(|| "the light".to_owned())?;
        let colored = entity.tokens.peek().is_some_and(|token| token.begins_a_number());
        let color = if colored { Some(intensity(entity)?) } else { None };
        self.lamps.push((at, color));
        Ok(())
    }

    /// The same with those of what follows in the file.
    pub fn append(&mut self, mut next: Self) {
        self.lamps.append(&mut next.lamps);
    }

    /// Lights the scene. The format's own rule: each of L lights whose intensity is not given has √L / 2L,
    /// and so has the ambient light. A file without lights leaves both as they are.
    pub fn finish(self, scene: &mut Scene) {
        let count = self.lamps.len() as f64;
        let share = count.sqrt() / (2.0 * count);
        if !self.lamps.is_empty() {
            scene.world.ambient = DVec3::splat(share);
        }
        let light = |(at, color): (DVec3, Option<DVec3>)| {
            // A light's colour goes up to 1; what is brighter is intensity.
            let intensity = color.map_or(share, |color| color.max_element().max(1.0));
            let color = color.map_or(DVec3::ONE, |color| color / intensity);
            Light { anchor: Anchor::World(at), intensity, color }
        };
        scene.lights = self.lamps.into_iter().map(light).collect();
    }
}

/// The intensity of a light in each channel: three numbers, or one and a colour.
fn intensity(entity: &mut Entity) -> Result<DVec3, Reported> {
    let first = entity.color()?;
    if !entity.tokens.peek().is_some_and(|token| token.begins_a_number()) {
        return Ok(first);
    }
    let [blue] = entity.numbers(["blue"])?;
    entity.check(blue, blue.value >= 0.0, "a colour is not negative")?;
    let product = first.x * DVec3::new(first.y, first.z, blue.value);
    if product.is_finite() {
        Ok(product)
    } else {
        Err(entity.wrong(entity.keyword, "intensity and colour multiply to more than a 64-bit float holds"))
    }
}

/// Ignores what programs write behind the index, on its line: a share of ambient light, and the name of a
/// texture. Blanks part a name into words, so all of them are passed over.
fn ignore_rest(entity: &mut Entity, index: &NffToken) {
    let mut end = index.span().end;
    let (mut numbers, mut words) = (0, 0);
    while let Some(token) = entity.tokens.peek_on_line(end) {
        let is_number = token.number().is_some();
        if begins_an_entity(token.word.as_bytes()) || is_number && numbers + words > 0 {
            break;
        }
        entity.tokens.take();
        end = token.span().end;
        if is_number {
            numbers += 1;
            entity.ignored.add(Extra::AmbientShare, token.span());
        } else {
            words += 1;
            if words == 1 {
                entity.ignored.add(Extra::Texture, token.span());
            }
        }
    }
}

/// The materials, each stored once.
#[derive(Debug, Default)]
pub struct Fills {
    /// Of each; `None` is ray13's own, for what comes before the first `f`.
    numbers: Vec<Option<[f64; 8]>>,
    /// By their bits. Only asked by key, so that its order plays no part.
    known: HashMap<[u64; 8], MaterialId>,
    current: Option<MaterialId>,
    /// The first `f` that would send on more light than arrives.
    too_bright: Option<Range<usize>>,
}

impl Fills {
    /// `f red green blue Kd Ks Shine T index`, and perhaps what other programs add.
    pub fn read(&mut self, entity: &mut Entity) -> Result<(), Reported> {
        let numbers =
            entity.numbers(["red", "green", "blue", "Kd", "Ks", "Shine", "T", "the index of refraction"])?;
        for (place, &number) in numbers.iter().enumerate() {
            let (above_0, up_to_1) = (number.value >= 0.0, number.value <= 1.0);
            match place {
                5 | 7 => entity.check(number, above_0, "Shine and index are 0 or more")?,
                _ => entity.check(number, above_0 && up_to_1, "colour, Kd, Ks and T are in 0 to 1")?,
            }
        }
        let [.., t, index] = numbers;
        entity.check(index, index.value > 0.0 || t.value == 0.0, "where T is above 0 the index is too")?;
        let values = numbers.map(|number| number.value);
        let [.., ks, _, kt, _] = values;
        if ks + kt > 1.0 {
            self.too_bright.get_or_insert_with(|| entity.keyword.span());
        }
        self.current = Some(self.id(values));
        ignore_rest(entity, &index.token);
        Ok(())
    }

    fn id(&mut self, values: [f64; 8]) -> MaterialId {
        let next = MaterialId(self.numbers.len() as u32);
        let id = *self.known.entry(values.map(f64::to_bits)).or_insert(next);
        if id == next {
            self.numbers.push(Some(values));
        }
        id
    }

    /// The material of what comes next: the last that was read, else ray13's own.
    pub fn current(&mut self) -> MaterialId {
        *self.current.get_or_insert_with(|| {
            self.numbers.push(None);
            MaterialId(self.numbers.len() as u32 - 1)
        })
    }

    /// The same with those of what follows in the file, and which of them each of those now is. What came
    /// before the first `f` there has the material that was the last here.
    pub fn append(&mut self, next: Self) -> Vec<MaterialId> {
        let of = |fill: Option<[f64; 8]>| match fill {
            Some(values) => self.id(values),
            None => self.current(),
        };
        let ids: Vec<MaterialId> = next.numbers.into_iter().map(of).collect();
        self.current = next.current.map(|MaterialId(id)| ids[id as usize]).or(self.current);
        self.too_bright = self.too_bright.take().or(next.too_bright);
        ids
    }

    /// All of them, and a note of what was taken differently.
    pub fn finish(self, sink: &mut Sink) -> Vec<Material> {
        if let Some(place) = self.too_bright {
            sink.note(Diagnostic::note(place, "where Ks + T is above 1, only 1 - T is mirrored"));
        }
        self.numbers.into_iter().map(|fill| fill.map_or_else(Material::default, material)).collect()
    }
}

/// The format has one share, Kd, for all light that a surface scatters, from lamps and from everywhere. So
/// the colour of ambient and diffuse light is Kd times the file's, and what is left of `kd` says whether
/// there is any.
///
/// It has one share, Ks, for the highlight and for what is mirrored. Of the mirror it is no more than T
/// leaves: files give glass a strong highlight without meaning that light comes of nothing. An index of 0 is
/// that of a surface through which nothing is seen.
fn material([r, g, b, kd, ks, n, kt, index]: [f64; 8]) -> Material {
    let index = if index > 0.0 { index } else { 1.0 };
    let kr = if ks + kt > 1.0 { 1.0 - kt } else { ks };
    let color = kd * DVec3::new(r, g, b);
    let kd = if kd > 0.0 { 1.0 } else { 0.0 };
    Material { name: None, color, kd, ks, n, kr, kt, index }
}

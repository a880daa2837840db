//! Whether two machines mean the same picture, in one number to compare.

use std::collections::HashMap;
use std::fmt::{self, Display, Write};
use std::sync::Arc;

use crate::frame::Request;
use crate::plan::Options;
use crate::scene::{Object, Primitive, Scene, Shape, Solid};

/// A hash of all that the dots of a picture depend on, and of the version of the program. Of two different
/// pictures one pair in 2⁶⁴ has the same; it is no protection from someone who means to mislead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureDigest(u64);

impl PictureDigest {
    /// That of a picture of a scene. On how many threads, and in which characters it is shown, makes no
    /// difference: dots do not depend on that.
    pub fn of(scene: &Scene, request: &Request) -> Self {
        let mut text = Fnv::default();
        text.take(&env!("CARGO_PKG_VERSION"));
        let mut meshes = HashMap::new();
        for object in &scene.objects {
            text.take(&of_object(object, &mut meshes));
        }
        let Scene { materials, lights, world, .. } = scene;
        text.take(&(materials, lights, world));
        let Request { camera, dots, dot_aspect, options, wants, .. } = request;
        let options = Options { threads: 0, ..*options };
        text.take(&(camera, dots, dot_aspect, options, wants, request.palette.is_color()));
        Self(text.0)
    }

    /// By its 16 hexadecimal digits, as it is displayed.
    pub fn from_digits(digits: &str) -> Option<Self> {
        let is_one = digits.len() == 16 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        is_one.then(|| u64::from_str_radix(digits, 16).ok().map(Self)).flatten()
    }
}

impl Display for PictureDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// The hash of an object's expression. Meshes are hashed once, however often they are in the scene.
fn of_object(object: &Object, meshes: &mut HashMap<usize, u64>) -> u64 {
    let mut leaf = |primitive: &Primitive| {
        let mut text = Fnv::default();
        let Primitive { shape, map, .. } = primitive;
        if let Shape::Mesh(mesh) = shape {
            let hashed = || {
                let mut text = Fnv::default();
                text.take(mesh);
                text.0
            };
            text.take(&*meshes.entry(Arc::as_ptr(mesh).addr()).or_insert_with(hashed));
        } else {
            text.take(shape);
        }
        text.take(&(map, primitive.map_error_share, primitive.material));
        text.0
    };
    let mut join = |solid: &Solid, operands: std::vec::Drain<'_, u64>| {
        let mut text = Fnv::default();
        text.take(&match solid {
            Solid::Primitive(_) => "primitive",
            Solid::Union(_) => "union",
            Solid::Intersection(_) => "intersection",
            Solid::Difference(_) => "difference",
        });
        operands.for_each(|operand| text.take(&operand));
        text.0
    };
    object.solid.fold(&mut leaf, &mut join)
}

/// A hash of text that nobody keeps (Fowler, Noll and Vo: FNV-1a, 64 bits). Rust's own text for debugging has
/// all of a value, its floats to the last bit, and what is added to a type is in it without further ado.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn take(&mut self, value: &impl fmt::Debug) {
        // Behind each a byte that is in none, so that `1, 23` is not `12, 3`. It never fails.
        let _ = write!(self, "{value:?}\u{0}");
    }
}

impl Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::Size;
    use crate::scene::{ReadOptions, read};
    use crate::tone::Tone;

    fn digest(text: &str, change: impl FnOnce(&mut Request)) -> PictureDigest {
        let studio = Studio::new(read("test", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap();
        let mut request = Request {
            camera: studio.camera(0, 1.0),
            dots: Size::new(8, 8),
            dot_aspect: 1.0,
            options: Options::default(),
            wants: Wants::LIGHT,
            glyphs: GlyphMode::Blocks,
            palette: Palette::MONO,
            tone: Tone::Lightness,
        };
        change(&mut request);
        PictureDigest::of(studio.scene(), &request)
    }

    const SCENE: &str = "camera(eye = [0, -5, 0]); difference() { sphere(1); cube(1); }";

    #[test]
    fn it_is_that_of_the_dots() {
        let one = digest(SCENE, |_| ());
        assert_eq!(digest(&format!("{SCENE} // a remark"), |_| ()), one);
        assert_eq!(digest(SCENE, |request| request.options.threads = 7), one);
        assert_eq!(digest(SCENE, |request| request.glyphs = GlyphMode::Ascii), one);
        let others = [
            digest(&SCENE.replace("difference", "union"), |_| ()),
            digest(&SCENE.replace("sphere(1)", "sphere(1.0000000000000002)"), |_| ()),
            digest(&SCENE.replace("sphere(1);", "sphere(1); sphere(2);"), |_| ()),
            digest(&format!("world(ambient = 0.2); {SCENE}"), |_| ()),
            digest(SCENE, |request| request.camera.zoom = 2.0),
            digest(SCENE, |request| request.options.samples = 2),
            digest(SCENE, |request| request.dots = Size::new(8, 9)),
        ];
        for (k, other) in others.iter().enumerate() {
            assert!(!others[..k].contains(other) && *other != one, "{k}");
        }
    }

    #[test]
    fn its_digits_are_it() {
        let digest = PictureDigest(0x0123_4567_89ab_cdef);
        assert_eq!(PictureDigest::from_digits(&digest.to_string()), Some(digest));
        assert_eq!(PictureDigest::from_digits("+123456789abcdef"), None);
        assert_eq!(PictureDigest::from_digits("123"), None);
    }
}

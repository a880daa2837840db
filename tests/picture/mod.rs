//! Pictures of single solids, read back dot by dot: where each dot's ray met the solid, with which normal, how bright.

use ray13::frame::{Frame, Request, Studio};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::{DAffine3, DVec3, Size};
use ray13::plan::{Options, Shading};
use ray13::scene::{Camera, Material, MaterialId, Object, Primitive, Scene, Shape, Solid};
use ray13::tone::Tone;

/// A picture and the eye that saw it.
pub struct Seen {
    frame: Frame,
    camera: Camera,
}

/// A scene of one primitive.
pub fn shape(shape: Shape, map: DAffine3) -> Scene {
    let solid = Solid::Primitive(Primitive { shape, map, material: MaterialId(0) });
    Scene {
        objects: vec![Object { name: None, solid }],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}

/// A scene seen from a point towards the origin.
pub fn look(scene: Scene, eye: DVec3) -> Seen {
    look_at(scene, eye, Shading::Phong)
}

/// The same by one of the shading models.
pub fn look_at(scene: Scene, eye: DVec3, shading: Shading) -> Seen {
    see(scene, eye, Size::new(64, 64), shading)
}

/// A picture of a size, from in front.
pub fn draw(scene: Scene, width: u32, height: u32) -> Seen {
    see(scene, DVec3::new(0.0, -6.0, 0.0), Size::new(width, height), Shading::Phong)
}

fn see(scene: Scene, eye: DVec3, dots: Size, shading: Shading) -> Seen {
    let up = if eye.truncate() == ray13::math::DVec2::ZERO { DVec3::Y } else { DVec3::Z };
    let camera = Camera { name: None, eye, target: DVec3::ZERO, up, field: [40.0, 40.0], zoom: 1.0 };
    let request = Request {
        camera: camera.clone(),
        dots,
        dot_aspect: 1.0,
        options: Options { shading, ..Options::default() },
        glyphs: GlyphMode::Shade,
        palette: Palette::Dos,
        tone: Tone::Lightness,
    };
    Seen { frame: Studio::new(scene).draw(&request), camera }
}

impl Seen {
    /// Columns and rows of dots.
    pub fn size(&self) -> (u32, u32) {
        (self.frame.light.size().width, self.frame.light.size().height)
    }

    /// Point and normal of every dot that meets the solid.
    pub fn hits(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.lit_hits().map(|(point, normal, _)| (point, normal))
    }

    /// Point, normal and light of every dot that meets the solid.
    pub fn lit_hits(&self) -> impl Iterator<Item = (DVec3, DVec3, f64)> {
        let Size { width, height } = self.frame.light.size();
        let forward = (self.camera.target - self.camera.eye).normalize();
        let right = forward.cross(self.camera.up).normalize();
        let up = right.cross(forward);
        let tangent = |k: usize| libm::tan(self.camera.field[k].to_radians() / 2.0);
        let aspect = f64::from(width) / f64::from(height);
        let across = tangent(0).max(tangent(1) * aspect);
        let down = across / aspect;
        (0..height).flat_map(move |j| (0..width).map(move |i| (i, j))).filter_map(move |dot| {
            let x = (2.0 * (f64::from(dot.0) + 0.5) / f64::from(width) - 1.0) * across;
            let y = (1.0 - 2.0 * (f64::from(dot.1) + 0.5) / f64::from(height)) * down;
            let depth = self.frame.depth[dot];
            let point = self.camera.eye + (forward + x * right + y * up).normalize() * depth;
            depth.is_finite().then(|| (point, self.frame.normal[dot], self.frame.light[dot]))
        })
    }
}

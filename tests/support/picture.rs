//! Pictures of single solids, read back dot by dot: where each dot's ray met the solid, with which normal,
//! how bright.

use ray13::frame::{Frame, Studio};
use ray13::math::{DAffine3, DVec2, DVec3, Size};
use ray13::plan::Shading;
use ray13::scene::{Camera, FieldSpan, Material, MaterialId, Object, Primitive, Scene, Shape, Solid};

use crate::support::rays::directions;
use crate::support::request::request;

/// A picture and the eye that saw it.
pub struct Seen {
    frame: Frame,
    camera: Camera,
}

/// A scene of one primitive.
pub fn shape(shape: Shape, map: DAffine3) -> Scene {
    let solid = Solid::Primitive(Primitive::new(shape, map, MaterialId(0)));
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
    let up = if eye.truncate() == DVec2::ZERO { DVec3::Y } else { DVec3::Z };
    let camera = Camera {
        name: None,
        eye,
        target: DVec3::ZERO,
        up,
        field: [40.0, 40.0],
        span: FieldSpan::Edges,
        zoom: 1.0,
    };
    let mut request = request(camera.clone(), Size::new(64, 64));
    request.options.shading = shading;
    Seen { frame: Studio::new(scene).unwrap().draw(&request), camera }
}

impl Seen {
    /// Point and normal of every dot that meets the solid.
    pub fn hits(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.lit_hits().map(|(point, normal, _)| (point, normal))
    }

    /// Point, normal and light of every dot that meets the solid.
    pub fn lit_hits(&self) -> impl Iterator<Item = (DVec3, DVec3, f64)> {
        let directions = directions(&self.camera, self.frame.light.size());
        directions.into_iter().enumerate().filter_map(|(place, toward)| {
            let depth = self.frame.depth.as_ref().unwrap().values()[place];
            let point = self.camera.eye + toward * depth;
            depth.is_finite().then(|| {
                (point, self.frame.normal.as_ref().unwrap().values()[place], self.frame.light.values()[place])
            })
        })
    }
}

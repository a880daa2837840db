//! Scenes in the scene language, for single rays and for pictures of one dot.

use ray13::frame::Studio;
use ray13::integrate::{PathSegment, RayIntegrator};
use ray13::lattice::Structure;
use ray13::math::{DVec3, Ray, Size};
use ray13::plan::{Options, Plan};
use ray13::scene::{Camera, FieldSpan, ReadOptions, Scene, read};
use ray13::solid::Assembly;
use ray13::stage::{Counts, Meter, RayKind, Silent};
use ray13::trace::Exact;
use ray13::view::{Picture, PinholeCamera};

use super::glass::Bend;
use crate::support::request::request;

/// Glass that shows nothing but what comes through it.
const CLEAR: &str = "material(name = \"glass\", kd = 0, ks = 0, kt = 1, index = 1.5, color = [0, 0, 0]);
    material(name = \"dense\", kd = 0, ks = 0, kt = 1, index = 1.8, color = [0, 0, 0]);
    material(name = \"air\", kd = 0, ks = 0, kt = 1, index = 1, color = [0, 0, 0]);
    material(name = \"water\", kd = 0, ks = 0, kt = 1, index = 1.33, color = [0, 0, 0]);
    material(name = \"wall\", kd = 0, ks = 0, color = [0.5, 0.5, 0.5]);
    world(ambient = 1, background = 0);";

/// A scene of such glass.
pub fn clear(text: &str) -> String {
    format!("{CLEAR}{text}")
}

/// A scene from its text.
pub fn scene(text: &str) -> Scene {
    read("test", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// A camera whose middle looks along `d`.
pub fn camera(eye: DVec3, d: DVec3) -> Camera {
    let up = d.any_orthonormal_vector();
    Camera { name: None, eye, target: eye + d, up, field: [1.0, 1.0], span: FieldSpan::Edges, zoom: 1.0 }
}

/// What all rays are sent, and followed for as many generations as may be asked for.
pub fn all_rays() -> Options {
    Options { depth: 64, cutoff: 0.0, threads: 1, ..Options::default() }
}

/// The legs of one path, in the scene's coordinates.
pub fn legs(scene: &Scene, eye: DVec3, d: DVec3, preferred: RayKind) -> Vec<PathSegment> {
    let assembly = Assembly::new(scene).unwrap();
    let pinhole = PinholeCamera::new(&camera(eye, d), &Picture { dots: Size::new(1, 1), dot_aspect: 1.0 });
    let plan = Plan::new(scene, &assembly, &pinhole, &all_rays());
    let engine = Exact::new(&assembly, Structure::None);
    let integrator = RayIntegrator::<_, f64>::new(scene, &assembly, &plan, &engine);
    let (mut memory, mut meter) = (integrator.memory(), Meter::new(Silent));
    let ray = assembly.ray(&Ray::new(eye, d));
    let mut legs = integrator.path(&ray, preferred, &mut memory, &mut meter);
    for leg in &mut legs {
        leg.ray.o = assembly.scene_frame.outward(leg.ray.o);
    }
    legs
}

/// The places where the path bends: where the medium changes, and where the ray is reflected.
pub fn bends(legs: &[PathSegment]) -> Vec<Bend> {
    let changed = legs.windows(2).filter(|w| w[1].index != w[0].index || w[1].kind == RayKind::Mirror);
    changed.map(|w| Bend { at: w[1].ray.o, d: w[1].ray.d, index: w[1].index }).collect()
}

/// The light of the one dot that looks along `d`, and what was counted for it.
pub fn dot(text: &str, eye: DVec3, d: DVec3, options: &Options) -> (f64, Counts) {
    let mut request = request(camera(eye, d), Size::new(1, 1));
    request.options = *options;
    let frame = Studio::new(scene(text)).unwrap().draw(&request);
    (frame.light.values()[0], frame.counts)
}

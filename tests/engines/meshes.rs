//! Meshes: what packets find in single precision is what each ray finds by itself, to the bit, and shadows,
//! mirrors and glass with it.

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::{PrecisionChoice, StructureChoice};
use ray13::scene::{Anchor, Light, Material};

use crate::support::agreement::difference;
use crate::support::nasty_meshes::nasty;
use crate::support::request::request;
use crate::support::same::{exact, fast};

#[test]
fn packets_find_of_nasty_meshes_what_single_rays_find() {
    let (mut faults, mut shadows) = (Vec::new(), 0);
    for (number, nasty) in nasty().iter().enumerate() {
        let mut scene = nasty.scene();
        scene.materials[0] = match number % 4 {
            0 => Material { kr: 0.4, ..Material::default() },
            2 => Material { kt: 0.5, index: 1.3, ..Material::default() },
            _ => Material::default(),
        };
        let cameras = nasty.cameras();
        let (out, middle) = (cameras[0].eye, cameras[0].target);
        // Two lamps outside, and one inside.
        let lamps = [out + (out - middle).cross(DVec3::Z), middle - (out - middle) * 0.6, middle];
        scene.lights =
            lamps.map(|at| Light { anchor: Anchor::World(at), intensity: 0.5, color: DVec3::ONE }).to_vec();
        let studio = Studio::new(scene).unwrap();
        for (view, camera) in cameras.into_iter().enumerate() {
            let mut request = request(camera, Size::new(nasty.dots, nasty.dots));
            request.options.depth = 2;
            let frame = fast(&studio, &request);
            shadows += frame.counts.shadow_hits;
            if let Some(fault) = difference(&frame, &exact(&studio, &request, StructureChoice::None)) {
                faults.push(format!("{}, view {view}: {fault}", nasty.name));
            }
            // In single precision it is the same face everywhere.
            let mut single = request.clone();
            single.options.precision = PrecisionChoice::Single;
            let own = fast(&studio, &single);
            if own.object != frame.object {
                faults.push(format!("{}, view {view}, in single precision", nasty.name));
            }
        }
    }
    assert!(faults.is_empty(), "{} of them:\n{}", faults.len(), faults.join("\n"));
    assert!(shadows > 1000, "{shadows}");
}

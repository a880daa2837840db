//! Meshes: what packets find in single precision is what each ray finds by itself, to the bit, and shadows,
//! mirrors and glass with it.

use std::sync::Arc;

use ray13::frame::Studio;
use ray13::math::{DAffine3, DMat3, DVec3, Size};
use ray13::plan::{PrecisionChoice, StructureChoice};
use ray13::scene::{Anchor, Light, Material, MaterialId, Object, Primitive, Scene, Shape, Solid};

use crate::support::agreement::difference;
use crate::support::nasty_meshes::{Extent, Nasty, nasty};
use crate::support::request::request;
use crate::support::same::{exact, fast};
use ray13::tone::Tone;

#[test]
fn packets_find_of_nasty_meshes_what_single_rays_find() {
    let mut found = Found::default();
    for (number, nasty) in nasty().iter().enumerate() {
        look(&nasty.scene(), nasty, number, nasty.dots, &mut found);
    }
    found.assert_alike();
}

#[test]
fn packets_find_of_open_meshes_what_single_rays_find() {
    let mut found = Found::default();
    for (number, nasty) in nasty().iter().enumerate() {
        look(&nasty.open_scene(), nasty, number, nasty.dots, &mut found);
    }
    found.assert_alike();
}

/// Many triangles that are one surface are seen as the same triangles are that are objects each.
#[test]
fn an_open_mesh_is_the_triangles_that_it_has() {
    for nasty in nasty().iter().take(2) {
        let scene = nasty.open_scene();
        let Solid::Primitive(Primitive { shape: Shape::Sheet(mesh), .. }) = &scene.objects[0].solid else {
            panic!("{} is one surface", nasty.name)
        };
        let face = |triangle: &[u32; 3]| {
            let shape = Shape::Face(triangle.iter().map(|&corner| mesh.points[corner as usize]).collect());
            let solid = Solid::Primitive(Primitive::new(shape, DAffine3::IDENTITY, MaterialId(0)));
            Object { name: None, solid }
        };
        let apart = Scene { objects: mesh.triangles.iter().map(face).collect(), ..scene.clone() };
        let [one, many] = [scene, apart].map(|scene| Studio::new(scene).unwrap());
        let request = request(nasty.cameras().swap_remove(0), Size::new(96, 96));
        let [one, many] = [one, many].map(|studio| fast(&studio, &request).levels(Tone::default()));
        assert_eq!(one, many, "{}", nasty.name);
    }
}

/// Meshes as operands: cut by a ball and by themselves, cut from a box that ends flush with them, and common
/// to themselves and a box.
#[test]
fn packets_find_of_cut_meshes_what_single_rays_find() {
    let mut found = Found::default();
    for (number, nasty) in nasty().iter().enumerate() {
        let Extent { middle, size } = nasty.extent();
        let put = |shape: Shape, at: DVec3, size: f64| {
            let map = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(size)), at);
            Solid::Primitive(Primitive::new(shape, map, MaterialId(0)))
        };
        let mesh = |by: DVec3| put(Shape::Mesh(Arc::new(nasty.mesh.clone())), by, 1.0);
        let (off, own) = (DVec3::new(0.2, 0.1, 0.15) * size, DVec3::ZERO);
        let solid = match number % 3 {
            0 => {
                let ball = put(Shape::Sphere, middle + DVec3::new(0.3, -0.2, 0.3) * size, 0.4 * size);
                Solid::Difference(vec![mesh(own), ball, mesh(off)])
            }
            // Half of these are small beside what cuts them, which reaches out of the world then.
            1 if number % 2 == 0 => {
                let cube = put(Shape::Cube, nasty.mesh.points[0], 0.08 * size);
                Solid::Difference(vec![cube, mesh(own)])
            }
            1 => {
                let cube = put(Shape::Cube, middle + DVec3::Z * 0.25 * size, 0.5 * size);
                Solid::Difference(vec![cube, mesh(own)])
            }
            _ => {
                let cube = put(Shape::Cube, middle, 0.45 * size);
                Solid::Intersection(vec![Solid::Union(vec![mesh(own), mesh(off)]), cube])
            }
        };
        let scene = Scene { objects: vec![Object { name: None, solid }], ..nasty.scene() };
        look(&scene, nasty, number, nasty.dots.min(11), &mut found);
    }
    found.assert_alike();
}

/// What the pictures showed.
#[derive(Debug, Default)]
struct Found {
    faults: Vec<String>,
    shadows: u64,
}

impl Found {
    #[track_caller]
    fn assert_alike(&self) {
        assert!(self.faults.is_empty(), "{} of them:\n{}", self.faults.len(), self.faults.join("\n"));
        assert!(self.shadows > 1000, "{}", self.shadows);
    }
}

/// Draws a scene about a mesh by both engines, in all its views, and notes where they differ.
fn look(scene: &Scene, nasty: &Nasty, number: usize, dots: u32, found: &mut Found) {
    let mut scene = scene.clone();
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
        let mut request = request(camera, Size::new(dots, dots));
        request.options.depth = 2;
        let frame = fast(&studio, &request);
        found.shadows += frame.counts.shadow_hits;
        if let Some(fault) = difference(&frame, &exact(&studio, &request, StructureChoice::None)) {
            found.faults.push(format!("{}, view {view}: {fault}", nasty.name));
        }
        // In single precision it is the same face everywhere.
        let mut single = request.clone();
        single.options.precision = PrecisionChoice::Single;
        let own = fast(&studio, &single);
        if own.object != frame.object {
            found.faults.push(format!("{}, view {view}, in single precision", nasty.name));
        }
    }
}

//! A lattice only saves work: with it and without it, every dot sees the same surface.

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::scenery::embedded_scenes;
use ray13::frame::{Space, Studio};
use ray13::math::{Bounds, DVec3, Size};
use ray13::plan::{EngineChoice, StructureChoice};
use ray13::scene::{Camera, FieldSpan, Scene, Solid};

const DOTS: Size = Size::new(40, 30);

/// A box around a solid, whose faces are planes of the lattice wherever the solid stands along the axes.
fn bounds(solid: &Solid) -> Bounds {
    match solid {
        Solid::Primitive(primitive) => primitive.shape.bounds().mapped(&primitive.map),
        Solid::Union(parts) => parts.iter().map(bounds).fold(Bounds::EMPTY, |all, b| all.join(&b)),
        Solid::Intersection(parts) => {
            parts.iter().map(bounds).reduce(|all, b| all.meet(&b)).unwrap_or(Bounds::EMPTY)
        }
        Solid::Difference(parts) => parts.first().map_or(Bounds::EMPTY, bounds),
    }
}

fn camera(eye: DVec3, target: DVec3) -> Camera {
    let along_z = (target - eye).normalize().z.abs() > 0.99;
    let up = if along_z { DVec3::Y } else { DVec3::Z };
    Camera { name: None, eye, target, up, field: [60.0, 45.0], span: FieldSpan::Edges, zoom: 1.0 }
}

/// Three views from outside the world, two from inside, and those that a walk from cell to cell finds
/// hardest: along an axis within a plane of the lattice, and from a point on a plane, an edge and a corner of
/// a cell.
fn cameras(scene: &Scene) -> Vec<(&'static str, Camera)> {
    let boxes: Vec<Bounds> = scene.objects.iter().map(|object| bounds(&object.solid)).collect();
    let world = boxes.iter().fold(Bounds::EMPTY, |all, b| all.join(b));
    let first = boxes[0];
    let (center, half) = (world.center(), world.half());
    let outside = |x: f64, y: f64, z: f64| camera(center + DVec3::new(x, y, z) * half.length(), center);
    let inside = |x: f64, y: f64, z: f64, to: DVec3| {
        let eye = center + DVec3::new(x, y, z) * half;
        camera(eye, eye + to)
    };
    let in_plane = |axis: DVec3, target: DVec3| camera(target + axis * half.length() * 2.0, target);
    let mid = first.center();
    vec![
        ("outside, in front", outside(0.3, -2.0, 0.8)),
        ("outside, behind", outside(-1.7, 1.9, 1.1)),
        ("outside, below", outside(0.2, 0.5, -2.5)),
        ("inside, a corner", inside(-0.9, -0.9, 0.8, DVec3::new(1.0, 0.8, -0.5))),
        ("inside, between", inside(0.55, -0.35, 0.45, DVec3::new(-0.4, 1.0, -0.2))),
        ("along -x in a top plane", in_plane(DVec3::X, mid.with_z(first.hi.z))),
        ("along y in a side plane", in_plane(DVec3::NEG_Y, mid.with_x(first.lo.x))),
        ("along -z in a front plane", in_plane(DVec3::Z, mid.with_y(first.lo.y))),
        ("along -x in an edge", in_plane(DVec3::X, mid.with_y(first.lo.y).with_z(first.hi.z))),
        ("on a plane", camera(mid.with_z(first.hi.z), mid.with_z(first.hi.z) + DVec3::new(1.0, 0.3, 0.0))),
        ("on a face of the world", camera(center.with_y(world.lo.y), center)),
        ("on a corner of the world", camera(world.hi, center)),
        ("on an edge of a cell", camera(first.lo.with_z(mid.z), first.hi.with_z(mid.z))),
    ]
}

#[test]
fn the_lattice_changes_no_dot() {
    for (name, scene) in embedded_scenes() {
        let own = scene.views.clone().into_iter().map(|camera| ("own view", camera));
        let all: Vec<(&str, Camera)> = cameras(&scene).into_iter().chain(own).collect();
        let studio = Studio::new(scene).unwrap();
        let mut walked = 0;
        for (view, camera) in all {
            let draw = |structure| {
                let mut request = request(camera.clone(), DOTS);
                request.options.structure = structure;
                // Ray by ray, through boxes too.
                request.options.engine = EngineChoice::Exact;
                studio.draw(&request)
            };
            let without = draw(StructureChoice::None);
            assert_eq!(without.space, Space::Whole, "{name}: the choice is not followed");
            let structures = [
                (StructureChoice::Lattice, "lattice"),
                (StructureChoice::Tree, "tree"),
                (StructureChoice::Boxes, "boxes"),
            ];
            for (choice, what) in structures {
                let with = draw(choice);
                assert_eq!(with.space.name(), what, "{name}: the choice is not followed");
                assert_same_picture(&format!("{name}, {view}, {what}"), &with, &without);
                walked += with.counts.cells_visited;
            }
        }
        assert!(walked > 0, "{name}: no cell was visited");
    }
}

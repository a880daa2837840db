//! Drawings to be imported, and the outlines of figures, our own and those that OpenSCAD exports.

use std::fs;
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};
use ray13::scene::{Scene, Shape, Solid};

/// An empty folder for the drawings of a test.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("drawings").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// An entity of a DXF file, of groups as `"8 layer, 10 0, 20 1.5"`.
pub fn entity(name: &str, groups: &str) -> String {
    let group = |group: &str| {
        let (code, value) = group.trim().split_once(' ').unwrap();
        format!("{code}\n{value}\n")
    };
    let groups: String = groups.split(',').filter(|it| !it.trim().is_empty()).map(group).collect();
    format!("0\n{name}\n{groups}")
}

/// A block of a DXF file.
pub fn block(name: &str, entities: &str) -> String {
    format!("{}{entities}{}", entity("BLOCK", &format!("8 0, 2 {name}, 10 1, 20 1")), entity("ENDBLK", ""))
}

/// A DXF file.
pub fn dxf(blocks: &str, entities: &str) -> String {
    let section = |name: &str, what: &str| format!("0\nSECTION\n2\n{name}\n{what}0\nENDSEC\n");
    format!("{}{}0\nEOF\n", section("BLOCKS", blocks), section("ENTITIES", entities))
}

/// An SVG file of a page with these attributes.
pub fn svg(page: &str, elements: &str) -> String {
    let names = "xmlns=\"http://www.w3.org/2000/svg\" \
                 xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"";
    format!("<?xml version=\"1.0\"?>\n<svg {names} {page}>\n{elements}\n</svg>\n")
}

/// The outlines of an SVG file as OpenSCAD writes it.
pub fn exported_outlines(svg: &[u8]) -> Vec<Vec<DVec2>> {
    let mut outlines: Vec<Vec<DVec2>> = Vec::new();
    let words: Vec<&str> = str::from_utf8(svg).unwrap().split_whitespace().collect();
    for pair in words.windows(2) {
        let Some((x, y)) = pair[1].split_once(',') else { continue };
        let (Ok(x), Ok(y)) = (x.parse::<f64>(), y.parse::<f64>()) else { continue };
        match pair[0] {
            "M" => outlines.push(vec![DVec2::new(x, -y)]),
            "L" => outlines.last_mut().unwrap().push(DVec2::new(x, -y)),
            _ => {}
        }
    }
    outlines
}

/// What is inside of outlines, holes counted as less.
pub fn area_of_outlines(outlines: &[Vec<DVec2>]) -> f64 {
    let twice = |ring: &Vec<DVec2>| -> f64 {
        (0..ring.len()).map(|i| ring[i].perp_dot(ring[(i + 1) % ring.len()])).sum()
    };
    // Of what y points down in, the signs are turned round.
    outlines.iter().map(twice).sum::<f64>().abs() * 0.5
}

fn meshes(scene: &Scene, mut each: impl FnMut(&dyn Fn(DVec3) -> DVec3, &ray13::scene::Mesh)) {
    let mut visit = |solid: &Solid| {
        solid.visit(&mut |primitive| {
            if let Shape::Mesh(mesh) = &primitive.shape {
                each(&|p| primitive.map.transform_point3(p), mesh);
            }
        });
    };
    scene.objects.iter().for_each(|object| visit(&object.solid));
}

/// The corners of the figures of a scene.
pub fn own_corners(scene: &Scene) -> Vec<DVec2> {
    let mut corners = Vec::new();
    meshes(scene, |place, mesh| corners.extend(mesh.points.iter().map(|&p| place(p).truncate())));
    corners
}

/// The area of a drawing, which is shown as a plate about the plane z = 0: that of its upper face.
pub fn own_area(scene: &Scene) -> f64 {
    let mut sum = 0.0;
    meshes(scene, |place, mesh| {
        for triangle in &mesh.triangles {
            let corners = triangle.map(|i| place(mesh.points[i as usize]));
            if corners.iter().all(|corner| corner.z > 0.0) {
                let [a, b, c] = corners.map(DVec3::truncate);
                sum += 0.5 * (b - a).perp_dot(c - a).abs();
            }
        }
    });
    sum
}

/// The corner that lies farthest from all others, and how far.
pub fn farthest_from(corners: &[DVec2], others: &[DVec2]) -> (f64, DVec2) {
    let nearest = |&p: &DVec2| (others.iter().map(|&q| (p - q).length()).fold(f64::INFINITY, f64::min), p);
    corners.iter().map(nearest).fold((0.0, DVec2::ZERO), |a, b| if b.0 > a.0 { b } else { a })
}

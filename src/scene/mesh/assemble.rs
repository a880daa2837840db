//! From polygons to objects: a closed part is one solid, an open one a surface of all its triangles, and one
//! for each other polygon.

use std::ops::Range;
use std::sync::Arc;

use crate::math::{Bounds, DAffine3};
use crate::scene::memory::{ASSEMBLED, ASSEMBLED_FACES, ASSEMBLED_TRIANGLE};
use crate::scene::model::is_within_reach;
use crate::scene::outline::{drop_repeated, has_area};
use crate::scene::triangulation::{EarClipper, cancel_pairs, triangulate};
use crate::scene::{MaterialId, Mesh, Object, Primitive, Scene, Shape, Solid, UpAxis};

use super::facts::{MeshFacts, place};
use super::fault::{MeshError, MeshFault};
use super::polygons::{FaceRun, PolygonMesh};
use super::topology::Topology;
use super::weld::Welder;

/// Bytes that reading takes for a point: its place as it is read and as it is welded, its number, and up to
/// four slots in which numbers are looked up.
const READ_POINT: u64 = 24 + 24 + 4 + 16;

/// Bytes that reading takes for a corner of a face: its number, the triangle it makes as it is cut and as it
/// is kept, and three edges of that.
const READ_CORNER: u64 = 4 + 24 + 12;

/// Bytes that a mesh takes at most while it is read and shown, if all of it is shown as surfaces, which is
/// the more expensive way.
pub fn bytes(mesh: &PolygonMesh) -> u64 {
    bytes_of(mesh.points.len() as u64, mesh.corners.len() as u64, mesh.faces() as u64)
}

/// The same of a mesh that is still to be made, and has so many points, corners of faces, and faces.
pub fn bytes_of(points: u64, corners: u64, faces: u64) -> u64 {
    // Each polygon that is an object has one corner more than a triangle, at least.
    let objects = corners.saturating_sub(3 * faces).min(faces);
    READ_POINT * points
        + READ_CORNER * corners
        + (size_of::<Object>() as u64 + ASSEMBLED + ASSEMBLED_FACES) * objects
        + ASSEMBLED_TRIANGLE * corners.saturating_sub(2 * faces)
}

/// The polygons of a part, and the triangles they are cut into.
pub struct MeshPart {
    pub name: Option<String>,
    runs: Vec<Range<u32>>,
    /// The material of each run.
    materials: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
    pub topology: Topology,
    /// Whether each of its triangles was there twice, so that nothing lies between them.
    pub is_doubled: bool,
}

impl MeshPart {
    /// The material of all of it, where that is one.
    fn material(&self) -> Option<u32> {
        let &first = self.materials.first()?;
        self.materials.iter().all(|&material| material == first).then_some(first)
    }

    fn is_solid(&self) -> bool {
        self.topology.is_closed() && !self.is_doubled && self.material().is_some()
    }
}

/// Makes sure that there is something to see, and welds equal corners.
pub fn prepare(mesh: &mut PolygonMesh) -> Result<(), MeshError> {
    if mesh.faces() == 0 {
        return Err(MeshFault::Empty.of_all());
    }
    let named = mesh.corners.iter().map(|&corner| mesh.points[corner as usize]);
    if !is_within_reach(&Bounds::around(named)) {
        return Err(MeshFault::TooFar.of_all());
    }
    weld(mesh);
    Ok(())
}

/// Makes a scene of polygons.
pub fn assemble(mut mesh: PolygonMesh, up: UpAxis) -> Result<Scene, MeshError> {
    prepare(&mut mesh)?;
    let mut parts = parts(&mesh);
    let mut scene = Scene { notes: mesh.notes.clone(), ..Scene::default() };
    let mut flat = 0;
    for part in &mut parts {
        let facts = MeshFacts::of(&part.triangles, &mesh.points, &part.topology);
        let is_solid = part.is_solid();
        let objects = scene.objects.len();
        let triangles = triangle_mesh(&mesh, part, up);
        if is_solid {
            let shape = triangles.clone().map(Shape::Mesh);
            scene.objects.extend(shape.map(|shape| object(part, shape, part.material().unwrap_or(0))));
        } else {
            flat += surfaces(&mesh, part, up, triangles.as_ref(), &mut scene.objects);
        }
        if scene.objects.len() > objects {
            scene.meshes.push(MeshFacts {
                format: mesh.format,
                unit: mesh.unit,
                up,
                name: part.name.clone(),
                is_solid,
                mesh: triangles,
                ..facts
            });
        }
    }
    if scene.objects.is_empty() {
        return Err(MeshFault::Flat.of_all());
    }
    if flat > 0 {
        scene.notes.push(format!("faces without an area are left out ({flat} times)"));
    }
    scene.notes.extend(shown_as_surfaces(&scene.meshes));
    scene.materials = mesh.materials;
    Ok(scene)
}

/// The parts of a mesh whose corners are welded: its groups, or all of it where only that is a solid.
pub fn parts(mesh: &PolygonMesh) -> Vec<MeshPart> {
    let mut clipper = EarClipper::default();
    let mut parts: Vec<MeshPart> = groups(mesh)
        .into_iter()
        .filter_map(|(name, runs)| {
            Some(part(mesh, name, &runs, &mut clipper)).filter(|part| !part.triangles.is_empty())
        })
        .collect();
    // Groups may be of the faces of one solid, such as those of a side.
    if parts.len() > 1 && parts.iter().any(|part| !part.is_solid()) {
        let whole = part(mesh, None, &runs(mesh), &mut clipper);
        if whole.is_solid() {
            parts = vec![whole];
        }
    }
    parts
}

/// The note on parts that are no solids.
fn shown_as_surfaces(meshes: &[MeshFacts]) -> Option<String> {
    let mut surfaces = meshes.iter().filter(|facts| !facts.is_solid);
    let first = surfaces.next()?;
    let others = surfaces.count();
    let part = match &first.name {
        Some(name) => format!("the part `{name}`"),
        None => "the mesh".to_owned(),
    };
    let why = match first.open_edge {
        Some([from, to]) => {
            format!("is not closed: nothing meets its edge from {} to {}", place(from), place(to))
        }
        None => "is no solid, since its faces have several materials or lie on each other".to_owned(),
    };
    let more = match others {
        0 => String::new(),
        1 => "; and so is one part more".to_owned(),
        others => format!("; and so are {others} parts more"),
    };
    Some(format!("{part} {why}; it is shown as a surface{more}"))
}

/// Makes equal points one, numbered in the order in which the file has them.
fn weld(mesh: &mut PolygonMesh) {
    if mesh.is_welded {
        return;
    }
    let mut welder = Welder::new();
    let numbers: Vec<u32> =
        std::mem::take(&mut mesh.points).into_iter().map(|point| welder.number(point)).collect();
    for corner in &mut mesh.corners {
        *corner = numbers[*corner as usize];
    }
    mesh.take_points(welder);
}

/// All runs that have polygons, with the polygons that they have.
fn runs(mesh: &PolygonMesh) -> Vec<(FaceRun, Range<u32>)> {
    let ends = mesh.runs.iter().skip(1).map(|run| run.first).chain([mesh.faces() as u32]);
    mesh.runs
        .iter()
        .zip(ends)
        .map(|(&run, end)| (run, run.first..end))
        .filter(|(_, faces)| !faces.is_empty())
        .collect()
}

type GroupOfRuns = (Option<String>, Vec<(FaceRun, Range<u32>)>);

/// The groups with their runs, in the order in which the file names them.
fn groups(mesh: &PolygonMesh) -> Vec<GroupOfRuns> {
    let mut groups: Vec<GroupOfRuns> = mesh.groups.iter().map(|name| (name.clone(), Vec::new())).collect();
    for (run, faces) in runs(mesh) {
        groups[run.group as usize].1.push((run, faces));
    }
    groups
}

/// The part that runs make up.
fn part(
    mesh: &PolygonMesh,
    name: Option<String>,
    runs: &[(FaceRun, Range<u32>)],
    clipper: &mut EarClipper,
) -> MeshPart {
    let mut triangles = cut(mesh, runs, clipper);
    cancel_pairs(&mut triangles);
    let is_doubled = triangles.is_empty();
    if is_doubled {
        triangles = cut(mesh, runs, clipper);
    }
    let triangles: Vec<[u32; 3]> = triangles.into_iter().map(|(triangle, ())| triangle).collect();
    let topology = Topology::of(&triangles, mesh.points.len());
    let materials = runs.iter().map(|(run, _)| run.material).collect();
    let runs = runs.iter().map(|(_, faces)| faces.clone()).collect();
    MeshPart { name, runs, materials, triangles, topology, is_doubled }
}

/// Cuts the polygons of runs into triangles.
fn cut(mesh: &PolygonMesh, runs: &[(FaceRun, Range<u32>)], clipper: &mut EarClipper) -> Vec<([u32; 3], ())> {
    let mut triangles = Vec::new();
    let mut polygon = Vec::new();
    for face in runs.iter().flat_map(|(_, faces)| faces.clone()) {
        polygon.clear();
        polygon.extend_from_slice(mesh.face(face as usize));
        drop_repeated(&mut polygon, |&corner| mesh.points[corner as usize]);
        if polygon.len() >= 3 {
            triangulate(&mesh.points, &polygon, clipper, |triangle| triangles.push((triangle, ())));
        }
    }
    triangles
}

/// The triangles of a part by themselves, which are taken out of it; none where they have no area.
pub fn triangle_mesh(mesh: &PolygonMesh, part: &mut MeshPart, up: UpAxis) -> Option<Arc<Mesh>> {
    let place = |corner: u32| up.turned(mesh.points[corner as usize]);
    let mut triangles = std::mem::take(&mut part.triangles);
    if !triangles.iter().any(|triangle| has_area(triangle.iter().map(|&corner| place(corner)))) {
        return None;
    }
    triangles.shrink_to_fit();
    Some(Arc::new(by_themselves(mesh, triangles, up)))
}

/// Triangles of a mesh with those of its points that they use, which keep their order.
fn by_themselves(mesh: &PolygonMesh, mut triangles: Vec<[u32; 3]>, up: UpAxis) -> Mesh {
    // By corner: first whether it is used, then its number among those that are.
    let mut numbers = vec![0_u32; mesh.points.len()];
    triangles.iter().flatten().for_each(|&corner| numbers[corner as usize] = 1);
    let mut points = Vec::with_capacity(numbers.iter().map(|&used| used as usize).sum());
    for (number, &point) in numbers.iter_mut().zip(&mesh.points) {
        if *number == 1 {
            *number = points.len() as u32;
            points.push(up.turned(point));
        }
    }
    triangles.iter_mut().flatten().for_each(|corner| *corner = numbers[*corner as usize]);
    Mesh { points, triangles }
}

/// The surfaces of a part that is no solid: of each of its runs one for all triangles, and one for each other
/// polygon. Gives how many were left out, for they have no area. `known` are the triangles of the part.
fn surfaces(
    mesh: &PolygonMesh,
    part: &MeshPart,
    up: UpAxis,
    known: Option<&Arc<Mesh>>,
    objects: &mut Vec<Object>,
) -> usize {
    let mut flat = 0;
    let mut polygon = Vec::new();
    for (faces, &material) in part.runs.iter().zip(&part.materials) {
        let mut triangles = Vec::new();
        for face in faces.clone() {
            let place = |&corner: &u32| up.turned(mesh.points[corner as usize]);
            polygon.clear();
            polygon.extend_from_slice(mesh.face(face as usize));
            drop_repeated(&mut polygon, place);
            match polygon[..] {
                _ if polygon.len() < 3 || !has_area(polygon.iter().map(place)) => flat += 1,
                [a, b, c] => triangles.push([a, b, c]),
                _ => objects.push(object(part, Shape::Face(polygon.iter().map(place).collect()), material)),
            }
        }
        if !triangles.is_empty() {
            triangles.shrink_to_fit();
            let own = by_themselves(mesh, triangles, up);
            // Mostly it is all that there is of the part.
            let sheet = known.filter(|known| ***known == own).map_or_else(|| Arc::new(own), Arc::clone);
            objects.push(object(part, Shape::Sheet(sheet), material));
        }
    }
    flat
}

fn object(part: &MeshPart, shape: Shape, material: u32) -> Object {
    let primitive = Primitive::new(shape, DAffine3::IDENTITY, MaterialId(material));
    Object { name: part.name.clone(), solid: Solid::Primitive(primitive) }
}

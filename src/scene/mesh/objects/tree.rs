//! Objects that name each other, as 3MF and AMF have them: meshes, and objects made of others that are turned
//! and moved; and the polygons that what is built of them has.

use std::collections::HashMap;

use super::super::assemble::bytes_of;
use super::super::fault::{MeshError, MeshFault};
use super::super::polygons::PolygonMesh;
use crate::math::{DAffine3, DVec3};
use crate::scene::{MAX_FILE_BYTES, Material};

/// So deep may objects be made of objects: assemblies of machines have ten levels.
const DEEPEST: usize = 64;

/// So many faces may be built of a file: what one of the largest size has in OFF, the shortest format of
/// meshes, whose faces take eight bytes.
const MOST_FACES: u64 = MAX_FILE_BYTES / 8;

/// So many times may objects be placed. Each costs a little, if it has no faces at all.
const MOST_INSTANCES: u64 = 1_000_000;

/// An object's key: the number of the file within an archive, and its name there.
pub type ObjectKey = (u32, String);

/// Bytes that an object takes each time that it is placed, beside its points and triangles: a part with a
/// name, and what is made of that.
const PLACED: u64 = 600;

/// The longest name that is kept, in bytes: it is there once for each place of an object.
const LONGEST: usize = 100;

/// A name, cut off where it is longer than anybody reads.
pub fn shortened(name: &str) -> String {
    let end = (0..=LONGEST.min(name.len())).rev().find(|&at| name.is_char_boundary(at)).unwrap_or(0);
    name[..end].to_owned()
}

/// All objects of a file, and what is built of them.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    pub objects: HashMap<ObjectKey, ModelObject>,
    /// What is built, in order.
    pub items: Vec<Instance>,
    /// The materials; the first is that of faces without one.
    pub materials: Vec<Material>,
}

/// An object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelObject {
    pub name: Option<String>,
    pub points: Vec<DVec3>,
    /// Indices into `points`, which are within.
    pub triangles: Vec<[u32; 3]>,
    /// To what the triangles belong, in their order.
    pub runs: Vec<TriangleRun>,
    /// What it is made of besides.
    pub components: Vec<Instance>,
}

/// Triangles that follow each other and belong together: up to the next run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleRun {
    /// The first triangle.
    pub first: usize,
    /// What part of the object they are, from 0.
    pub part: usize,
    /// An index into [`ObjectTree::materials`].
    pub material: u32,
}

/// An object in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    pub object: ObjectKey,
    /// From the object's coordinates to those of what it is a part of.
    pub map: DAffine3,
}

/// Points, triangles and placed objects of something, all told.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    points: u64,
    triangles: u64,
    instances: u64,
}

impl ModelObject {
    /// What follows belongs to this part and is of this material.
    pub fn begin_run(&mut self, part: usize, material: u32) {
        let run = TriangleRun { first: self.triangles.len(), part, material };
        match self.runs.last_mut() {
            Some(last) if (last.part, last.material) == (part, material) => {}
            Some(last) if last.first == run.first => *last = run,
            _ => self.runs.push(run),
        }
    }
}

impl ObjectTree {
    /// The polygons of all that is built, of which there may be as many as `room` bytes allow for: an object
    /// of two others, each of two others, soon has more than there is memory for.
    pub fn polygons(self, format: &'static str, room: u64) -> Result<PolygonMesh, MeshError> {
        let mut known = HashMap::new();
        let mut all = Sum::default();
        for item in &self.items {
            all = all.and(self.sum(&item.object, DEEPEST, &mut known)?);
        }
        if all.triangles > MOST_FACES || all.instances > MOST_INSTANCES {
            return Err(MeshFault::TooMany.of_all());
        }
        let needed = bytes_of(all.points, 3 * all.triangles, all.triangles) + PLACED * all.instances;
        if needed > room {
            return Err(MeshFault::NoRoom(needed).of_all());
        }
        let mut mesh = PolygonMesh { groups: Vec::new(), runs: Vec::new(), ..PolygonMesh::of(format) };
        for item in &self.items {
            self.build(item, DAffine3::IDENTITY, None, &mut mesh)?;
        }
        if mesh.runs.is_empty() {
            mesh = PolygonMesh::of(format);
        }
        mesh.materials = self.materials;
        Ok(mesh)
    }

    /// What an object comes to, with all that it is made of.
    fn sum(
        &self,
        key: &ObjectKey,
        depth: usize,
        known: &mut HashMap<ObjectKey, Sum>,
    ) -> Result<Sum, MeshError> {
        if let Some(&sum) = known.get(key) {
            return Ok(sum);
        }
        let Some(object) = self.objects.get(key) else {
            return Err(MeshFault::NoObject(key.1.clone()).of_all());
        };
        let Some(depth) = depth.checked_sub(1) else {
            let what =
                format!("objects are made of each other, or of others more than {DEEPEST} levels deep");
            return Err(MeshFault::Unsupported(what).of_all());
        };
        let (points, triangles) = (object.points.len() as u64, object.triangles.len() as u64);
        let mut sum = Sum { points, triangles, instances: 1 };
        for component in &object.components {
            sum = sum.and(self.sum(&component.object, depth, known)?);
        }
        known.insert(key.clone(), sum);
        Ok(sum)
    }

    fn build(
        &self,
        instance: &Instance,
        above: DAffine3,
        name: Option<&String>,
        mesh: &mut PolygonMesh,
    ) -> Result<(), MeshError> {
        let Some(object) = self.objects.get(&instance.object) else { return Ok(()) };
        let map = above * instance.map;
        let name = object.name.as_ref().or(name);
        let first = u32::try_from(mesh.points.len()).map_err(|_| MeshFault::TooMany.of_all())?;
        for &point in &object.points {
            let place = map.transform_point3(point);
            if !place.is_finite() {
                return Err(MeshFault::TooFar.of_all());
            }
            mesh.add_point(place);
        }
        // What a map mirrors is turned inside out by it.
        let is_mirrored = map.matrix3.determinant() < 0.0;
        let ends = object.runs.iter().skip(1).map(|run| run.first).chain([object.triangles.len()]);
        let mut group = None;
        for (run, end) in object.runs.iter().zip(ends) {
            let index = match group {
                Some((part, index)) if part == run.part => index,
                _ => {
                    mesh.groups.push(name.cloned());
                    mesh.groups.len() as u32 - 1
                }
            };
            group = Some((run.part, index));
            mesh.begin_run(index, run.material);
            for &[a, b, c] in &object.triangles[run.first..end] {
                let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
                mesh.add_face(corners.map(|corner| first + corner)).map_err(MeshFault::of_all)?;
            }
        }
        object.components.iter().try_for_each(|component| self.build(component, map, name, mesh))
    }
}

impl Sum {
    fn and(self, other: Self) -> Self {
        Self {
            points: self.points.saturating_add(other.points),
            triangles: self.triangles.saturating_add(other.triangles),
            instances: self.instances.saturating_add(other.instances),
        }
    }
}

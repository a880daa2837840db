//! What every mesh format gives: corners, and polygons that name them, in groups.

use crate::math::DVec3;
use crate::scene::Material;

use super::fault::MeshFault;
use super::weld::Welder;

/// Polygons that share corners.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    /// What people call the format, as in `binary STL`.
    pub format: &'static str,
    /// The unit that the file names, of those that do.
    pub unit: Option<&'static str>,
    /// The corners; finite.
    pub points: Vec<DVec3>,
    /// Whether no two of them are equal.
    pub is_welded: bool,
    /// Indices into `points`, polygon after polygon.
    pub corners: Vec<u32>,
    /// Where each polygon's corners end in `corners`.
    pub ends: Vec<u32>,
    /// To what the polygons belong, in their order. The first begins with polygon 0.
    pub runs: Vec<FaceRun>,
    /// The groups' names.
    pub groups: Vec<Option<String>>,
    /// The materials; at least one.
    pub materials: Vec<Material>,
    /// What was read otherwise than it is written.
    pub notes: Vec<String>,
}

/// Polygons that follow each other and belong together: up to the next run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceRun {
    /// The first polygon.
    pub first: u32,
    /// An index into [`PolygonMesh::groups`].
    pub group: u32,
    /// An index into [`PolygonMesh::materials`].
    pub material: u32,
}

impl Default for PolygonMesh {
    /// One group without a name, of the material of files without materials.
    fn default() -> Self {
        Self {
            format: "",
            unit: None,
            points: Vec::new(),
            is_welded: false,
            corners: Vec::new(),
            ends: Vec::new(),
            runs: vec![FaceRun { first: 0, group: 0, material: 0 }],
            groups: vec![None],
            materials: vec![Material::default()],
            notes: Vec::new(),
        }
    }
}

impl PolygonMesh {
    /// A mesh without polygons so far, of a file of this format.
    pub fn of(format: &'static str) -> Self {
        Self { format, ..Self::default() }
    }

    /// Takes a corner, whose coordinates are finite.
    pub fn add_point(&mut self, point: DVec3) {
        // Adding 0 makes −0 and 0 the same.
        self.points.push(point + DVec3::ZERO);
    }

    /// Takes all corners, which differ.
    pub fn take_points(&mut self, welder: Welder) {
        self.points = welder.into_points();
        self.is_welded = true;
    }

    /// Takes a polygon.
    ///
    /// # Errors
    /// [`MeshFault::TooMany`] where its corners can no longer be numbered.
    pub fn add_face(&mut self, corners: impl IntoIterator<Item = u32>) -> Result<(), MeshFault> {
        self.corners.extend(corners);
        self.ends.push(u32::try_from(self.corners.len()).map_err(|_| MeshFault::TooMany)?);
        Ok(())
    }

    /// The number of polygons.
    pub fn faces(&self) -> usize {
        self.ends.len()
    }

    /// The corners of a polygon.
    pub fn face(&self, face: usize) -> &[u32] {
        let start = face.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.corners[start as usize..self.ends[face] as usize]
    }

    /// What follows belongs to this group and is of this material.
    pub fn begin_run(&mut self, group: u32, material: u32) {
        let run = FaceRun { first: self.ends.len() as u32, group, material };
        match self.runs.last_mut() {
            Some(last) if last.first == run.first => *last = run,
            _ => self.runs.push(run),
        }
    }

    /// The index of a group of this name, a new one where there is none yet.
    pub fn begin_group(&mut self, name: &[u8]) -> u32 {
        self.groups.push(Some(String::from_utf8_lossy(name).into_owned()));
        self.groups.len() as u32 - 1
    }
}

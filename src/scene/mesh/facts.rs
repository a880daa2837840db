//! What a mesh is, for the person who checks it.

use std::fmt;
use std::sync::Arc;

use crate::math::{Bounds, DVec3};
use crate::scene::{Mesh, UpAxis};

use super::topology::Topology;

/// What a part of a mesh file is. Places and lengths are those of the file, before it is turned.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFacts {
    /// The format, as in `binary STL`.
    pub format: &'static str,
    /// The unit of its places and lengths, of formats that name one.
    pub unit: Option<&'static str>,
    /// The axis that is up.
    pub up: UpAxis,
    /// The part's name.
    pub name: Option<String>,
    /// Triangles, once faces of more corners are cut.
    pub triangles: usize,
    /// Corners, equal ones counted once.
    pub corners: usize,
    /// Edges that an odd number of triangles share; none of a closed mesh.
    pub open_edges: usize,
    /// The ends of one of them.
    pub open_edge: Option<[DVec3; 2]>,
    /// Whether it is shown as a solid: it is closed, encloses something, and has one material.
    pub is_solid: bool,
    /// Parts that have no corner in common.
    pub shells: usize,
    /// What it encloses, negative where its faces look inwards; none where they look both ways, or where it
    /// is open.
    pub volume: Option<f64>,
    /// The sum of its triangles.
    pub area: f64,
    /// How far it reaches along each axis.
    pub size: DVec3,
    /// Its triangles, as they are turned in the scene; none where they have no area.
    pub mesh: Option<Arc<Mesh>>,
}

impl MeshFacts {
    /// Those of triangles. Format, axis and name are the caller's.
    pub(super) fn of(triangles: &[[u32; 3]], points: &[DVec3], topology: &Topology) -> Self {
        let used = triangles.iter().flatten().map(|&corner| points[corner as usize]);
        let bounds = Bounds::around(used);
        let center = bounds.center();
        let (mut volume, mut area) = (0.0, 0.0);
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| points[corner as usize] - center);
            volume += a.dot(b.cross(c)) / 6.0;
            area += (b - a).cross(c - a).length() / 2.0;
        }
        let has_volume = topology.is_closed() && topology.is_oriented && f64::is_finite(volume);
        Self {
            format: "",
            unit: None,
            up: UpAxis::Z,
            name: None,
            triangles: triangles.len(),
            corners: topology.corners,
            open_edges: topology.open_edges,
            open_edge: topology.open_edge.map(|edge| edge.map(|corner| points[corner as usize])),
            is_solid: topology.is_closed(),
            shells: topology.shells,
            volume: has_volume.then_some(volume),
            area,
            size: 2.0 * bounds.half(),
            mesh: None,
        }
    }

    /// Whether every edge is shared by an even number of triangles.
    pub const fn is_closed(&self) -> bool {
        self.open_edges == 0
    }
}

impl MeshFacts {
    /// A point of the scene in the file's own coordinates, to six digits.
    pub fn place(&self, point: DVec3) -> String {
        let [x, y, z] = self.up.turned_back(point).to_array().map(figure);
        format!("[{x}, {y}, {z}]")
    }
}

/// A point, as a file has it.
pub(super) fn place(point: DVec3) -> String {
    let [x, y, z] = point.to_array().map(number);
    format!("[{x}, {y}, {z}]")
}

/// A number in full; with an exponent where that is shorter.
fn number(number: f64) -> String {
    let (plain, scientific) = (format!("{number}"), format!("{number:e}"));
    // `0.0001` is easier to read than `1e-4`.
    if plain.len() <= scientific.len() + 6 { plain } else { scientific }
}

/// A number to six digits: sums of many are good to no more.
fn figure(sum: f64) -> String {
    number(format!("{sum:.5e}").parse().unwrap_or(sum))
}

impl fmt::Display for MeshFacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        let up = match self.up {
            UpAxis::Y => "y",
            UpAxis::Z => "z",
        };
        write!(f, "{}, {up} up", self.format)?;
        if let Some(unit) = self.unit {
            write!(f, ", in {unit}")?;
        }
        if let Some(name) = &self.name {
            write!(f, ", `{name}`")?;
        }
        write!(f, ": {} triangle{}, {} corners", self.triangles, plural(self.triangles), self.corners)?;
        match self.open_edge {
            Some([from, to]) => {
                let edges = plural(self.open_edges);
                write!(
                    f,
                    ", open at {} edge{edges} as from {} to {}",
                    self.open_edges,
                    place(from),
                    place(to)
                )?;
            }
            None if self.is_solid => write!(f, ", closed")?,
            None => write!(f, ", closed but shown as a surface")?,
        }
        write!(f, ", {} shell{}", self.shells, plural(self.shells))?;
        match self.volume {
            Some(volume) if volume < 0.0 => {
                write!(f, ", volume {} (its faces look inwards)", figure(-volume))?;
            }
            Some(volume) => write!(f, ", volume {}", figure(volume))?,
            None if self.is_closed() => write!(f, ", no volume told (its faces look both ways)")?,
            None => {}
        }
        let [x, y, z] = self.size.to_array().map(figure);
        write!(f, ", area {}, size {x} x {y} x {z}", figure(self.area))
    }
}

//! `polyhedron`: points and faces to a closed surface of triangles.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::arguments::BoundArguments;
use super::lists::{index, items, length, no_point, points};
use super::lost::Lost;
use crate::math::DVec3;
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::{Spanned, TextSpan, Value, short};
use crate::scene::triangulation::{EarClipper, EdgeSet, cancel_pairs, triangulate};
use crate::scene::{Diagnostic, Mesh, Shape};

/// The side of a cell of OpenSCAD's grid (`GRID_FINE`), in the scene's unit: 2⁻²⁰. Points in one cell are one
/// point there.
const GRID: f64 = 1.0 / (1 << 20) as f64;

/// Bytes that reading a `polyhedron` call takes at most beside its values, by the number of those.
pub fn bytes(arguments: &BoundArguments<'_, '_>) -> u64 {
    // A point, its places in the lists and in the map of points; a corner's share of triangles, and of the
    // sets of them and of their edges.
    const OF_POINT: u64 = 120;
    const OF_CORNER: u64 = 120;
    let items = |name: &str| match arguments.value(name).map(|value| &value.value) {
        Some(Value::List(items)) => items.as_slice(),
        _ => &[],
    };
    let faces = items("faces").iter().chain(items("triangles"));
    OF_POINT * items("points").len() as u64 + OF_CORNER * faces.map(length).sum::<u64>()
}

/// The mesh of a `polyhedron` call.
pub fn polyhedron(
    arguments: &BoundArguments<'_, '_>,
    clipper: &mut EarClipper,
    sink: &mut Sink,
) -> Result<Shape, Lost> {
    let Some(points) = arguments.value("points") else { return Err(arguments.missing("points", sink)) };
    let faces = match (arguments.value("faces"), arguments.value("triangles")) {
        (Some(faces), None) | (None, Some(faces)) => faces,
        (None, None) => return Err(arguments.missing("faces", sink)),
        (Some(_), Some(triangles)) => {
            let error = Diagnostic::error(triangles.span, "`faces` and `triangles` exclude each other");
            return Err(sink.report(error.help("`triangles` is the old name of `faces`")).into());
        }
    };
    let call = Call { arguments, points, faces };
    let exact = call.surface(Merging::Equal, clipper, sink)?;
    let Some(open) = &exact.open else { return Ok(exact.shape()) };
    // Points that a program computed twice differ in their last digits; to OpenSCAD they are one. Only those
    // on open edges are merged here: what is closed may be thinner than the grid, and stays.
    if let Ok(welded) = call.surface(Merging::Near(&exact.open_corners()), clipper, &mut Sink::new(true))
        && welded.open.is_none()
    {
        let message = "points on open edges of `polyhedron`, in neighbouring cells of OpenSCAD's grid of 2^-20, count as one: \
             else it were not closed";
        sink.note(Diagnostic::note(points.span, message));
        return Ok(welded.shape());
    }
    let error = Diagnostic::error(open.face, "the polyhedron is not closed")
        .label(format!("nothing meets its edge from {} to {}", open.from, open.to))
        .help("every edge must belong to two faces: add the face that is missing");
    Err(arguments.refuse(error, Lost::Missing, sink))
}

/// The arguments of a `polyhedron`.
struct Call<'c, 'a> {
    arguments: &'c BoundArguments<'c, 'a>,
    points: &'c Spanned<'a>,
    faces: &'c Spanned<'a>,
}

/// Which points count as one.
#[derive(Clone, Copy, Debug)]
enum Merging<'c> {
    /// Equal ones.
    Equal,
    /// Of these those in one cell, or in neighbouring cells, of OpenSCAD's grid; of all others equal ones.
    Near(&'c HashSet<Bits>),
}

/// The bits of a point's coordinates, by which equal points are known.
type Bits = [u64; 3];

fn bits(point: DVec3) -> Bits {
    point.to_array().map(f64::to_bits)
}

/// The triangles of a polyhedron, and an edge that is open, if there is one.
struct Surface {
    points: Vec<DVec3>,
    triangles: Vec<([u32; 3], TextSpan)>,
    open: Option<OpenEdge>,
}

struct OpenEdge {
    from: String,
    to: String,
    /// The face that has it.
    face: TextSpan,
}

impl Surface {
    /// The corners of edges that are open.
    fn open_corners(&self) -> HashSet<Bits> {
        EdgeSet::of(&self.triangles).ends().map(|corner| bits(self.points[corner as usize])).collect()
    }

    fn shape(self) -> Shape {
        let mut triangles: Vec<_> = self.triangles.into_iter().map(|(triangle, _)| triangle).collect();
        triangles.shrink_to_fit();
        let mut points = self.points;
        points.shrink_to_fit();
        Shape::Mesh(Arc::new(Mesh { points, triangles }))
    }
}

impl Call<'_, '_> {
    fn surface(
        &self,
        merging: Merging<'_>,
        clipper: &mut EarClipper,
        sink: &mut Sink,
    ) -> Result<Surface, Lost> {
        let corners = self.corners(merging, sink)?;
        let mut triangles = Vec::new();
        let mut lost = Lost::Empty;
        for face in self.faces(self.faces, sink)? {
            let Some(polygon) = self.polygon(&corners, face, sink)? else {
                lost = Lost::Missing;
                continue;
            };
            triangulate(&corners.points, &polygon, clipper, |triangle| {
                triangles.push((triangle, face.span));
            });
        }
        cancel_pairs(&mut triangles);
        if triangles.is_empty() {
            let error = Diagnostic::error(self.faces.span, "the faces of the polyhedron enclose nothing");
            return Err(self.arguments.refuse(error, lost, sink));
        }
        let open = open_edge(&triangles).map(|(edge, face)| {
            let [from, to] = edge.map(|index| {
                let [x, y, z] = corners.points[index as usize].to_array().map(short);
                format!("[{x}, {y}, {z}]")
            });
            OpenEdge { from, to, face }
        });
        Ok(Surface { points: corners.points, triangles, open })
    }

    fn corners(&self, merging: Merging<'_>, sink: &mut Sink) -> Result<Corners, Lost> {
        let mut corners = Corners::default();
        for point in points(self.arguments, self.points, sink)? {
            corners.add(point, merging);
        }
        Ok(corners)
    }

    /// The corners of a face, without neighbours that are the same point. Fewer than three: no area. None
    /// where the face is left out.
    fn polygon(
        &self,
        corners: &Corners,
        face: &Spanned<'_>,
        sink: &mut Sink,
    ) -> Result<Option<Vec<u32>>, Lost> {
        let indices = self.faces(face, sink)?;
        let refuse = |error: Diagnostic, sink: &mut Sink| {
            if !sink.leaves_out() {
                return Err(sink.report(error).into());
            }
            let message = format!("a face of `polyhedron` is left out: {}", error.message);
            sink.note(Diagnostic::note(error.span, message).label(error.label));
            Ok(None)
        };
        if indices.len() < 3 {
            let message = format!("a face has {} corners", indices.len());
            return refuse(Diagnostic::error(face.span, message).help("a face needs three or more"), sink);
        }
        let mut polygon: Vec<u32> = Vec::with_capacity(indices.len());
        for item in indices {
            let place = index(&item.value).and_then(|index| corners.merged.get(index).copied());
            let Some(place) = place else {
                return refuse(no_point("a face", item, corners.merged.len()), sink);
            };
            if polygon.last() != Some(&place) {
                polygon.push(place);
            }
        }
        while polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
        Ok(Some(polygon))
    }

    /// All faces, or the corners of one.
    fn faces<'l, 'a>(&self, list: &'l Spanned<'a>, sink: &mut Sink) -> Result<&'l [Spanned<'a>], Lost> {
        items(self.arguments, list, "faces", "a list of faces, each a list of indices", sink)
    }
}

/// The points of a polyhedron, those that count as one merged.
#[derive(Default)]
struct Corners {
    points: Vec<DVec3>,
    /// For each point of the text its place in `points`.
    merged: Vec<u32>,
    /// The place in `points` by coordinates.
    places: HashMap<Bits, u32>,
    /// The place in `points` by the cell of the grid.
    cells: HashMap<[i64; 3], u32>,
}

/// So many cells from 0 a cell's number is no longer exact in 64 bits: 8.8e12. The grid is far finer there
/// than the numbers are.
const FARTHEST: f64 = 9e18;

impl Corners {
    fn add(&mut self, point: DVec3, merging: Merging<'_>) {
        let next = self.points.len() as u32;
        let is_welded = |open: &HashSet<Bits>| {
            open.contains(&bits(point)) && (point / GRID).abs().max_element() < FARTHEST
        };
        let place = match merging {
            Merging::Near(open) if is_welded(open) => {
                let cell = self.cell(point);
                *self.cells.entry(cell).or_insert(next)
            }
            _ => *self.places.entry(bits(point)).or_insert(next),
        };
        if place == next {
            self.points.push(point);
        }
        self.merged.push(place);
    }

    /// The cell of OpenSCAD's grid in which a point is: the nearest in which one is already, of its own and
    /// the neighbouring ones, as in `Grid3d::align`.
    fn cell(&self, point: DVec3) -> [i64; 3] {
        let own = (point / GRID).round().to_array().map(|x| x as i64);
        let around = |i: i64| [i % 3, i / 3 % 3, i / 9].map(|step| step - 1);
        let cells = (0..27).map(around).map(|step| {
            let cell = [0, 1, 2].map(|axis| own[axis].saturating_add(step[axis]));
            (step.map(i64::abs).iter().sum::<i64>(), cell)
        });
        let known = cells.filter(|(_, cell)| self.cells.contains_key(cell));
        known.min_by_key(|&(distance, _)| distance).map_or(own, |(_, cell)| cell)
    }
}

/// The first edge, in file order, that an odd number of triangles share; and the face that has it.
fn open_edge(triangles: &[([u32; 3], TextSpan)]) -> Option<([u32; 2], TextSpan)> {
    let edges = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let odd = EdgeSet::of(triangles);
    if odd.is_empty() {
        return None;
    }
    let open = |&edge: &[u32; 2]| odd.has(edge);
    triangles.iter().find_map(|&(triangle, place)| Some((edges(triangle).into_iter().find(open)?, place)))
}

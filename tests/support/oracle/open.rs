//! Surfaces that bound no solid: polygons as frusta of triangles counted by parity, triangles, the wall of a
//! tube as the quadric between its caps.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::Shape;

use super::number::{Number, unit};
use super::patch::Patch;
use super::side::{Row, Side, along, sides};
use super::triangle::Triangle;

/// A surface in the world.
#[derive(Debug)]
pub enum Open<N> {
    /// The first side is the wall, the others cut it off.
    Tube(Vec<Side<N>>),
    Bezier(Vec<Patch<N>>),
    /// Triangles, each by itself.
    Sheet(Vec<Triangle<N>>),
    /// A flat polygon, with the normals of its corners where it is a triangle that has them.
    Polygon {
        frusta: Vec<Triangle<N>>,
        normals: Option<[DVec3; 3]>,
    },
}

impl<N: Number> Open<N> {
    pub fn new(shape: &Shape, map: &DAffine3) -> Self {
        let polygon =
            |corners: &[DVec3], normals| Self::Polygon { frusta: Triangle::frusta(corners, map), normals };
        match shape {
            Shape::Face(corners) => polygon(corners, None),
            Shape::Sheet(mesh) => Self::Sheet(Triangle::of(mesh, map)),
            Shape::Patch(corners) => {
                assert_eq!(corners.len(), 3, "more corners than three have no plain rule");
                let turn = map.matrix3.inverse().transpose();
                let normals = [0, 1, 2].map(|i| (turn * corners[i].normal).normalize());
                let places: Vec<DVec3> = corners.iter().map(|corner| corner.place).collect();
                polygon(&places, Some(normals))
            }
            Shape::Bezier(patches) => Self::Bezier(Patch::of(patches, map)),
            tube => Self::Tube(sides(tube, map)),
        }
    }

    /// Where the ray first meets it; the normal of the surface there; and the normal that it shows, turned to
    /// the side that the ray comes from.
    pub fn first(&self, o: &Row<N>, d: &Row<N>, toward: DVec3) -> Option<(N, DVec3, DVec3)> {
        match self {
            Self::Tube(sides) => {
                let (wall, caps) = sides.split_first()?;
                let crossings = wall.crossings(o, d).into_iter().filter(|t| t.sign() > 0);
                let on_wall = crossings.map(|t| (t.clone(), along(o, d, &t)));
                let between = on_wall.filter(|(_, p)| caps.iter().all(|cap| cap.at(p).sign() <= 0));
                let (t, p) = between.reduce(|a, b| if b.0 < a.0 { b } else { a })?;
                let normal = against(unit(&wall.gradient(&p)), toward);
                Some((t, normal, normal))
            }
            Self::Bezier(patches) => {
                let all = patches.iter().flat_map(|patch| patch.crossings(o, d));
                let ahead = all.filter(|on| on.t.sign() > 0);
                let first = ahead.reduce(|a, b| if b.t < a.t { b } else { a })?;
                let normal = against(first.normal, toward);
                Some((first.t, normal, normal))
            }
            Self::Sheet(triangles) => {
                let crossings = triangles.iter().filter_map(|one| Some((one.crossing(o, d)?, one)));
                let ahead = crossings.filter(|(t, _)| t.sign() > 0);
                let (t, nearest) = ahead.reduce(|a, b| if b.0 < a.0 { b } else { a })?;
                let normal = against(nearest.unit_normal(), toward);
                Some((t, normal, normal))
            }
            Self::Polygon { frusta, normals } => {
                let inside = frusta.iter().filter(|triangle| triangle.crossing(o, d).is_some()).count();
                if inside % 2 == 0 {
                    return None;
                }
                // The largest triangle knows the plane best.
                let largest = frusta.iter().reduce(|a, b| if b.size() > a.size() { b } else { a })?;
                let t = largest.plane_crossing(o, d)?;
                let plane = against(largest.unit_normal(), toward);
                let normal = normals.map_or(plane, |normals| {
                    let shares = largest.shares(&along(o, d, &t));
                    let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + normals[i] * shares[i]).normalize();
                    let mean = if mean.dot(plane) < 0.0 { -mean } else { mean };
                    let away = mean.dot(toward) / toward.length_squared();
                    if away > 0.0 { (mean - away * toward).normalize() } else { mean }
                });
                (t.sign() > 0).then_some((t, plane, normal))
            }
        }
    }
}

fn against(normal: DVec3, toward: DVec3) -> DVec3 {
    if normal.dot(toward) > 0.0 { -normal } else { normal }
}

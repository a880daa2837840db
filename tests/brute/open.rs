//! Surfaces that bound no solid: polygons as fans of triangles counted by parity, the wall of a tube as the quadric
//! between its caps.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::Shape;

use super::side::{Side, Triangle, along, direction, point, sides};

/// A surface in the world.
#[derive(Debug)]
pub enum Open {
    /// The first side is the wall, the others cut it off.
    Tube(Vec<Side>),
    /// A flat polygon, with the normals of its corners where it is a triangle that has them.
    Polygon { fan: Vec<Triangle>, normals: Option<[DVec3; 3]> },
}

impl Open {
    pub fn new(shape: &Shape, map: &DAffine3) -> Self {
        let polygon = |corners: Vec<DVec3>, normals| {
            let corners: Vec<DVec3> = corners.iter().map(|&p| map.transform_point3(p)).collect();
            Self::Polygon { fan: Triangle::fan(&corners), normals }
        };
        match shape {
            Shape::Face(corners) => polygon(corners.to_vec(), None),
            Shape::Patch(corners) => {
                assert_eq!(corners.len(), 3, "more corners than three have no plain rule");
                let turn = map.matrix3.inverse().transpose();
                let normals = [0, 1, 2].map(|i| (turn * corners[i].normal).normalize());
                polygon(corners.iter().map(|corner| corner.place).collect(), Some(normals))
            }
            tube => Self::Tube(sides(tube, map)),
        }
    }

    /// Where the ray first meets it, and the normal there, turned to the side that the ray comes from.
    pub fn first(&self, origin: DVec3, toward: DVec3) -> Option<(f64, DVec3)> {
        let (o, d) = (point(origin), direction(toward));
        match self {
            Self::Tube(sides) => {
                let (wall, caps) = sides.split_first()?;
                let crossings = wall.crossings(&o, &d).into_iter().filter(|t| t.value() > 0.0);
                let on_wall = crossings.map(|t| (t.value(), along(&o, &d, t)));
                let between = on_wall.filter(|(_, p)| caps.iter().all(|cap| cap.at(p).value() <= 0.0));
                let (t, p) = between.min_by(|a, b| a.0.total_cmp(&b.0))?;
                Some((t, against(wall.gradient(&p).normalize(), toward)))
            }
            Self::Polygon { fan, normals } => {
                let inside = fan.iter().filter(|triangle| triangle.crossing(&o, &d).is_some()).count();
                if inside % 2 == 0 {
                    return None;
                }
                // The largest triangle knows the plane best.
                let area = |triangle: &&Triangle| triangle.normal().length();
                let largest = fan.iter().max_by(|a, b| area(a).total_cmp(&area(b)))?;
                let t = largest.plane_crossing(&o, &d)?.value();
                let plane = against(largest.normal().normalize(), toward);
                let normal = normals.map_or(plane, |normals| {
                    let shares = largest.shares(origin + toward * t);
                    let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + normals[i] * shares[i]).normalize();
                    let mean = if mean.dot(plane) < 0.0 { -mean } else { mean };
                    let away = mean.dot(toward) / toward.length_squared();
                    if away > 0.0 { (mean - away * toward).normalize() } else { mean }
                });
                (t > 0.0).then_some((t, normal))
            }
        }
    }
}

fn against(normal: DVec3, toward: DVec3) -> DVec3 {
    if normal.dot(toward) > 0.0 { -normal } else { normal }
}

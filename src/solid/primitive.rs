//! One primitive, put into the world and specialised: only what its map requires is computed per ray.

use std::ops::RangeInclusive;

use crate::math::{Bounds, DAffine3, DMat3, DVec3, Number, Placement, Ray, Rays, Vector};
use crate::scene::{MaterialId, Shape};

use super::ball::Ball;
use super::bezier::BezierSurface;
use super::classification::Classification;
use super::face::Face;
use super::facets::ConvexPolyhedron;
use super::hull::convex;
use super::mesh::TriangleMesh;
use super::patch::Patch;
use super::quadric::Quadric;
use super::slabs::{AxisBox, SkewBox};
use super::span::{End, ROUNDING, Span, Spans};
use super::tube::Tube;

/// A primitive in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldPrimitive {
    /// Its form.
    pub form: WorldShape,
    /// Its surface.
    pub material: MaterialId,
}

/// The forms, each with its own intersection. Those of more numbers than a sphere's are boxed, so that a
/// scene of a million spheres does not pay for them.
#[derive(Clone, Debug, PartialEq)]
pub enum WorldShape {
    /// A sphere.
    Ball(Ball),
    /// A box along the axes.
    AxisBox(Box<AxisBox>),
    /// A box in any position.
    SkewBox(Box<SkewBox>),
    /// An ellipsoid or truncated cone in any position.
    Quadric(Box<Quadric>),
    /// A convex solid of flat faces.
    Facets(Box<ConvexPolyhedron>),
    /// A closed surface of triangles.
    Mesh(Box<TriangleMesh>),
    /// Bézier patches: a closed surface, or a surface that bounds nothing.
    Bezier(Box<BezierSurface>),
    /// Triangles that need not close around anything: a surface.
    Sheet(Box<TriangleMesh>),
    /// A polygon: a surface.
    Face(Box<Face>),
    /// A polygon with a normal at each corner: a surface.
    Patch(Box<Patch>),
    /// The side of a truncated cone: a surface.
    Tube(Box<Tube>),
}

/// Radii whose inverse maps are far from the limits of f64.
const PLAIN: RangeInclusive<f64> = 1e-90..=1e90;

impl WorldShape {
    /// A unit sphere that the map keeps round, which may be off by `error`: it needs no inverse. `None` for
    /// another shape, or a map that wants a closer look.
    pub fn ball(shape: &Shape, map: &DAffine3, error: DVec3) -> Option<Self> {
        if !matches!(shape, Shape::Sphere) || !map.translation.is_finite() {
            return None;
        }
        let radius = similarity(&map.matrix3).filter(|radius| PLAIN.contains(radius))?;
        Some(Self::Ball(Ball::new(map.translation, radius, error)))
    }

    /// The form of a unit shape at `place`, which may be off by `error`.
    pub fn new(shape: &Shape, place: Placement, error: DVec3) -> Self {
        match shape {
            Shape::Sphere => match similarity(&place.linear) {
                Some(radius) => Self::Ball(Ball::new(place.center, radius, error)),
                None => Self::Quadric(Box::new(Quadric::ellipsoid(&place, error))),
            },
            Shape::Cone { bottom, top } => {
                Self::Quadric(Box::new(Quadric::cone(&place, *bottom, *top, error)))
            }
            Shape::Cube => match axis_half(&place.linear) {
                Some(half) => Self::AxisBox(Box::new(AxisBox::new(place.center, half, error))),
                None => Self::SkewBox(Box::new(SkewBox::new(place, error))),
            },
            Shape::Facets(unit) => Self::Facets(Box::new(ConvexPolyhedron::new(unit, &place, error))),
            Shape::Mesh(unit) => match convex(unit, &place, error) {
                Some(facets) => Self::Facets(Box::new(facets)),
                None => Self::Mesh(Box::new(TriangleMesh::new(unit, &place, error))),
            },
            Shape::Bezier(unit) => Self::Bezier(Box::new(BezierSurface::new(unit, &place, error))),
            Shape::Sheet(unit) => Self::Sheet(Box::new(TriangleMesh::new(unit, &place, error))),
            Shape::Face(corners) => Self::Face(Box::new(Face::new(corners.iter().copied(), &place, error))),
            Shape::Patch(corners) => Self::Patch(Box::new(Patch::new(corners, &place, error))),
            Shape::Tube { bottom, top } => Self::Tube(Box::new(Tube::new(&place, *bottom, *top, error))),
        }
    }

    /// The ray's span in a convex solid; a mesh has crossings instead, and a surface no inside.
    #[inline]
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        self.spans(&Rays::from(ray))?.one()
    }

    /// The spans of one ray, or of several, in a convex solid; `None` for what is not one.
    #[inline(always)]
    pub fn spans<N: Number>(&self, rays: &Rays<N>) -> Option<Spans<N>> {
        match self {
            Self::Ball(ball) => Some(ball.spans(rays)),
            Self::AxisBox(slabs) => Some(slabs.spans(rays)),
            Self::SkewBox(slabs) => Some(slabs.spans(rays)),
            Self::Quadric(quadric) => Some(quadric.spans(rays)),
            Self::Facets(facets) => Some(facets.spans(rays)),
            Self::Mesh(_)
            | Self::Bezier(_)
            | Self::Sheet(_)
            | Self::Face(_)
            | Self::Patch(_)
            | Self::Tube(_) => None,
        }
    }

    /// How far a point of it may be off its place, by its map and by our own rounding.
    #[inline]
    pub fn place_error(&self) -> f64 {
        match self {
            Self::Ball(ball) => ball.place_error(),
            Self::AxisBox(slabs) => slabs.place_error(),
            Self::SkewBox(slabs) => slabs.place_error(),
            Self::Quadric(quadric) => quadric.place_error(),
            Self::Facets(facets) => facets.place_error(),
            Self::Mesh(mesh) | Self::Sheet(mesh) => mesh.place_error(),
            Self::Bezier(patches) => patches.place_error(),
            Self::Face(face) => face.place_error(),
            Self::Patch(patch) => patch.face.place_error(),
            Self::Tube(tube) => tube.place_error(),
        }
    }

    /// How far two parallel planes around a convex solid are apart at least, or less than that. Of what is
    /// not one nothing is said: infinite.
    pub fn thickness(&self) -> f64 {
        match self {
            Self::Ball(ball) => 2.0 * ball.radius,
            Self::AxisBox(slabs) => 2.0 * slabs.bounds().half().min_element(),
            Self::SkewBox(slabs) => slabs.thickness(),
            Self::Quadric(quadric) => quadric.thickness(),
            Self::Facets(facets) => facets.thickness(),
            Self::Mesh(_)
            | Self::Bezier(_)
            | Self::Sheet(_)
            | Self::Face(_)
            | Self::Patch(_)
            | Self::Tube(_) => f64::INFINITY,
        }
    }

    /// The share of its crossings' errors that our own rounding may have made; the rest its map lost when it
    /// was composed. What is made of corners knows no such share.
    #[inline]
    pub(super) fn rounding_share(&self) -> f64 {
        match self {
            Self::Ball(ball) => ball.rounding_share(),
            Self::AxisBox(slabs) => slabs.rounding_share(),
            Self::SkewBox(slabs) => slabs.rounding_share(),
            Self::Quadric(quadric) => quadric.rounding_share(),
            Self::Facets(facets) => facets.rounding_share(),
            Self::Mesh(_)
            | Self::Bezier(_)
            | Self::Sheet(_)
            | Self::Face(_)
            | Self::Patch(_)
            | Self::Tube(_) => 1.0,
        }
    }

    /// All crossings of the line with the surface of a solid, in no order; each one toggles between outside
    /// and inside.
    #[inline]
    pub fn crossings(&self, ray: &Ray, mut found: impl FnMut(End)) {
        match self {
            Self::Mesh(mesh) => mesh.crossings(ray, found),
            Self::Bezier(patches) => patches.crossings(ray, found),
            // One by one, so that a new shape is asked for here: what is not convex has more than one span.
            Self::Ball(_) | Self::AxisBox(_) | Self::SkewBox(_) | Self::Quadric(_) | Self::Facets(_) => {
                if let Some(span) = self.span(ray) {
                    found(span.enter);
                    found(span.leave);
                }
            }
            Self::Sheet(_) | Self::Face(_) | Self::Patch(_) | Self::Tube(_) => {}
        }
    }

    /// Whether it is a solid that a ray meets in one span at most.
    #[inline]
    pub fn is_convex(&self) -> bool {
        match self {
            Self::Ball(_) | Self::AxisBox(_) | Self::SkewBox(_) | Self::Quadric(_) | Self::Facets(_) => true,
            Self::Mesh(_)
            | Self::Bezier(_)
            | Self::Sheet(_)
            | Self::Face(_)
            | Self::Patch(_)
            | Self::Tube(_) => false,
        }
    }

    /// Whether it is a surface, which bounds no solid.
    #[inline]
    pub fn is_surface(&self) -> bool {
        match self {
            Self::Bezier(patches) => !patches.is_closed(),
            _ => matches!(self, Self::Sheet(_) | Self::Face(_) | Self::Patch(_) | Self::Tube(_)),
        }
    }

    /// The normal that light is answered with at a point of a surface: [`WorldShape::normal`] everywhere but
    /// on a patch, where it is interpolated and may stand on the other side of the patch's own plane.
    pub fn shading_normal(&self, p: DVec3, surface: u32) -> DVec3 {
        match self {
            Self::Patch(patch) => patch.normal(p),
            _ => self.normal(p, surface),
        }
    }

    /// The normal of the surface itself at a point of it, of length 1 within rounding; outward except for
    /// triangles and Bézier patches, which may turn either way. A face and a patch turn to the left around
    /// theirs; a tube's points away from its axis.
    #[inline]
    pub fn normal(&self, p: DVec3, surface: u32) -> DVec3 {
        match self {
            Self::Ball(ball) => ball.normals(Vector::from(p)).into(),
            Self::Quadric(quadric) => quadric.normals(Vector::from(p), surface).into(),
            Self::Tube(tube) => tube.normals(Vector::from(p)).into(),
            Self::AxisBox(_) => AxisBox::normal(surface),
            Self::SkewBox(slabs) => slabs.normal(surface),
            Self::Facets(facets) => facets.normal(surface),
            Self::Mesh(mesh) | Self::Sheet(mesh) => mesh.normal(surface),
            Self::Bezier(patches) => patches.normal(p, surface),
            Self::Face(face) => face.normal(),
            Self::Patch(patch) => patch.face.normal(),
        }
    }

    /// The box around it. Faces of a box along the axes are exact; all other bounds are moved outward by what
    /// rounding may have taken.
    pub fn bounds(&self) -> Bounds {
        let exact = match self {
            Self::AxisBox(slabs) => return slabs.bounds(),
            Self::Ball(ball) => ball.bounds(),
            Self::SkewBox(slabs) => slabs.bounds(),
            Self::Quadric(quadric) => quadric.bounds(),
            Self::Facets(facets) => facets.bounds(),
            Self::Mesh(mesh) | Self::Sheet(mesh) => mesh.bounds(),
            Self::Bezier(patches) => patches.bounds(),
            Self::Face(face) => face.bounds(),
            Self::Patch(patch) => patch.face.bounds(),
            Self::Tube(tube) => tube.bounds(),
        };
        exact.padded(DVec3::splat(ROUNDING * exact.farthest().max_element()))
    }

    /// How far it reaches along `v`: the greatest `p · v` of its points, or of its box where that is dearer.
    pub fn support(&self, v: DVec3) -> f64 {
        match self {
            Self::Ball(ball) => ball.support(v),
            Self::Quadric(quadric) => quadric.support(v),
            Self::SkewBox(slabs) => slabs.support(v),
            Self::Mesh(mesh) | Self::Sheet(mesh) => mesh.support(v),
            Self::Bezier(patches) => patches.support(v),
            Self::Face(face) => face.support(v),
            Self::Patch(patch) => patch.face.support(v),
            Self::Tube(tube) => tube.support(v),
            Self::Facets(facets) => facets.support(v),
            Self::AxisBox(_) => {
                self.bounds().corners().into_iter().map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }

    /// How a box lies to it.
    pub fn classify(&self, b: &Bounds) -> Classification {
        match self {
            Self::Ball(ball) => ball.classify(b),
            Self::AxisBox(slabs) => {
                let own = slabs.bounds();
                Classification::of(own.meet(b).is_empty(), || {
                    own.lo.cmplt(b.lo).all() && b.hi.cmplt(own.hi).all()
                })
            }
            Self::SkewBox(slabs) => slabs.classify(b),
            Self::Quadric(quadric) => quadric.classify(b),
            Self::Facets(facets) => facets.classify(b),
            Self::Mesh(mesh) | Self::Sheet(mesh) => Classification::of(mesh.misses(b), || false),
            Self::Bezier(patches) => Classification::of(patches.misses(b), || false),
            Self::Face(face) => Classification::of(face.misses(b), || false),
            Self::Patch(patch) => Classification::of(patch.face.misses(b), || false),
            Self::Tube(tube) => Classification::of(tube.misses(b), || false),
        }
    }
}

/// The factor of a map that keeps all angles, within the rounding of the map's own numbers; else `None`.
fn similarity(linear: &DMat3) -> Option<f64> {
    let columns = [linear.x_axis, linear.y_axis, linear.z_axis];
    let longest = columns.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
    let even = columns.map(|c| c / longest);
    let radius = even[0].length();
    // A column of three rounded numbers: its length and its products are off by 4 roundings at most.
    let tolerance = 4.0 * f64::EPSILON;
    let same_length = even.iter().all(|c| (c.length() - radius).abs() <= tolerance * radius);
    let right_angles = [(0, 1), (1, 2), (2, 0)]
        .iter()
        .all(|&(i, j)| even[i].dot(even[j]).abs() <= tolerance * radius * radius);
    (same_length && right_angles).then_some(radius * longest)
}

/// Half the edges of the cube's image where that is a box along the axes; else `None`.
fn axis_half(linear: &DMat3) -> Option<DVec3> {
    let columns = [linear.x_axis, linear.y_axis, linear.z_axis];
    let along_an_axis = |c: &DVec3| c.to_array().iter().filter(|&&x| x != 0.0).count() == 1;
    columns.iter().all(along_an_axis).then(|| columns[0].abs() + columns[1].abs() + columns[2].abs())
}

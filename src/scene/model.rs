//! The scene: what a reader gives and every later stage takes. Lengths are the scene's own unit, angles
//! degrees, colours and intensities linear light.

use std::sync::Arc;
use std::vec::Drain;

use crate::math::{Bounds, DAffine3, DVec3};

use super::{BezierPatches, Mesh, MeshFacts};

/// Scenes reach no farther than this from the origin along any axis. It is a thousandth of the largest
/// number: so far may an eye that sees all of a scene stand off, and the lights that go with it.
pub const REACH: f64 = 1e305;

/// Whether a box lies within [`REACH`].
pub(super) fn is_within_reach(b: &Bounds) -> bool {
    let reach = DVec3::splat(REACH);
    Bounds::new(-reach, reach).contains(b.lo) && Bounds::new(-reach, reach).contains(b.hi)
}

/// Everything that can be seen, what lights it and from where it is seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The objects of the lattice, in file order. Top-level unions and groups are already opened.
    pub objects: Vec<Object>,
    /// Materials, indexed by [`MaterialId`].
    pub materials: Vec<Material>,
    /// Lights in file order. Empty: the default lights ([`Light::defaults`]) are used.
    pub lights: Vec<Light>,
    /// Named views in file order. Empty: the scene is framed from its bounds.
    pub views: Vec<Camera>,
    /// Ambient light, background and depth constant.
    pub world: World,
    /// What the parts of a mesh file are, or of those that a scene imports, each once.
    pub meshes: Vec<MeshFacts>,
    /// What the reader left out or took differently, one sentence each, for the person who looks.
    pub notes: Vec<String>,
}

impl Scene {
    /// Whether another scene has the same solids in the same order, whatever they are called, made of and lit
    /// by: a ray from anywhere meets the same in both.
    pub fn has_solids_of(&self, other: &Self) -> bool {
        let mut both = self.objects.iter().zip(&other.objects);
        self.objects.len() == other.objects.len() && both.all(|(a, b)| a.solid.is_shaped_as(&b.solid))
    }
}

/// One object of the lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The name given by `object("…")`.
    pub name: Option<String>,
    /// What it is made of.
    pub solid: Solid,
}

/// A CSG expression. Its primitives are numbered in file order, which decides which of two coincident
/// surfaces shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// One primitive.
    Primitive(Primitive),
    /// In any of these. Empty: nothing.
    Union(Vec<Solid>),
    /// In all of these. Empty: nothing.
    Intersection(Vec<Solid>),
    /// In the first and in none of the others. Empty: nothing.
    Difference(Vec<Solid>),
}

impl Solid {
    /// Calls `f` with each primitive, in file order.
    pub fn visit<'a>(&'a self, f: &mut impl FnMut(&'a Primitive)) {
        self.fold(f, &mut |_, _| ());
    }

    /// Calls `f` with each primitive, in file order, to be changed.
    pub(super) fn each_mut<'a>(&'a mut self, f: &mut impl FnMut(&'a mut Primitive)) {
        let mut open = vec![self];
        while let Some(solid) = open.pop() {
            match solid {
                Self::Primitive(primitive) => f(primitive),
                Self::Union(c) | Self::Intersection(c) | Self::Difference(c) => {
                    open.extend(c.iter_mut().rev());
                }
            }
        }
    }

    /// The operands of an operator; none of a primitive.
    fn operands(&self) -> &[Self] {
        match self {
            Self::Primitive(_) => &[],
            Self::Union(c) | Self::Intersection(c) | Self::Difference(c) => c,
        }
    }

    /// What `leaf` makes of the primitives, in file order, put together by `join` at each operator, from the
    /// innermost outwards. Does not recurse: solids may be nested deeper than a thread's stack allows for.
    pub fn fold<'a, T>(
        &'a self,
        leaf: &mut impl FnMut(&'a Primitive) -> T,
        join: &mut impl FnMut(&'a Self, Drain<'_, T>) -> T,
    ) -> T {
        if let Self::Primitive(primitive) = self {
            return leaf(primitive);
        }
        // By operator that is open: the operands to come, and where the values of the others begin.
        let mut open = vec![(self, self.operands().iter(), 0)];
        let mut values = Vec::new();
        loop {
            let Some((solid, rest, start)) = open.last_mut() else { return join(self, values.drain(..)) };
            match rest.next() {
                Some(Self::Primitive(primitive)) => values.push(leaf(primitive)),
                Some(inner) => open.push((inner, inner.operands().iter(), values.len())),
                None => {
                    let value = join(solid, values.drain(*start..));
                    open.pop();
                    if open.is_empty() {
                        return value;
                    }
                    values.push(value);
                }
            }
        }
    }

    /// Whether it is the same but for materials.
    fn is_shaped_as(&self, other: &Self) -> bool {
        let mut open = vec![(self, other)];
        while let Some(both) = open.pop() {
            match both {
                (Self::Primitive(a), Self::Primitive(b))
                    if (&a.shape, &a.map, &a.map_error_share) == (&b.shape, &b.map, &b.map_error_share) => {}
                (Self::Union(a), Self::Union(b))
                | (Self::Intersection(a), Self::Intersection(b))
                | (Self::Difference(a), Self::Difference(b))
                    if a.len() == b.len() =>
                {
                    open.extend(a.iter().zip(b));
                }
                _ => return false,
            }
        }
        true
    }
}

/// A shape, put into the world by an invertible map.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// The unit shape.
    pub shape: Shape,
    /// From the shape's own coordinates to the world's. Finite and invertible.
    pub map: DAffine3,
    /// How far a point of the shape may lie from where exact arithmetic would put it, along each axis, as a
    /// share of how far the primitive reaches from the origin along that axis: what was rounded when the map
    /// was written down and composed. Surfaces nearer to each other than that are one place.
    pub map_error_share: [f32; 3],
    /// Its surface.
    pub material: MaterialId,
}

impl Primitive {
    /// A primitive whose map was composed of two, as `place * size` is, and has the [`Primitive::map_error`]
    /// of that.
    pub fn new(shape: Shape, map: DAffine3, material: MaterialId) -> Self {
        // Both numbers of a product, the product and three sums, of three products and an entry: 6 half-ulps,
        // rounded up to 8.
        const COMPOSED: f32 = 4.0 * f64::EPSILON as f32;
        Self { shape, map, map_error_share: [COMPOSED; 3], material }
    }

    /// The primitive with a [`Primitive::map_error`] of this much.
    #[must_use]
    pub fn with_map_error(mut self, by: DVec3) -> Self {
        let reach = self.shape.bounds().mapped(&self.map).farthest();
        // Half an ulp of an f32 is of no account to a bound, nor is what is beyond all of them: a bound stays
        // a number.
        let share = |axis: usize| (by[axis] / reach[axis]).min(f64::from(f32::MAX)) as f32;
        self.map_error_share = [0, 1, 2].map(|axis| if reach[axis] > 0.0 { share(axis) } else { 0.0 });
        self
    }

    /// How far a point of the shape may lie from where exact arithmetic would put it, along each axis, in the
    /// scene's unit.
    pub fn map_error(&self) -> DVec3 {
        DVec3::from_array(self.map_error_share.map(f64::from))
            * self.shape.bounds().mapped(&self.map).farthest()
    }
}

/// A unit solid, or a surface. Solids are closed sets: their surface belongs to them. Surfaces
/// ([`Shape::is_surface`]) bound nothing; each is an object alone, never an operand of CSG.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// `x² + y² + z² ≤ 1`.
    Sphere,
    /// `x² + y² ≤ r(z)²`, `|z| ≤ 1`, with `r` linear from `bottom` at z = −1 to `top` at z = 1.
    /// Both are in `0..=1` and the larger is exactly 1. Both 1 is a cylinder; one 0 comes to a point; else
    /// it is a truncated cone.
    Cone {
        /// Radius at z = −1.
        bottom: f64,
        /// Radius at z = 1.
        top: f64,
    },
    /// `|x|, |y|, |z| ≤ 1`.
    Cube,
    /// A convex solid of flat faces.
    Facets(Arc<Facets>),
    /// A closed solid of triangles, not necessarily convex: the points around which an odd number of
    /// surfaces lie.
    Mesh(Arc<Mesh>),
    /// Bézier patches: a solid where they close ([`BezierPatches::is_closed`]), not necessarily convex; else
    /// a surface.
    Bezier(Arc<BezierPatches>),
    /// A surface: a polygon, which may be concave and, by what rounding its corners takes, not quite flat.
    /// Three corners or more, no two neighbours the same, with an area. Points around which its outline turns
    /// an even number of times are outside.
    Face(Arc<[DVec3]>),
    /// A surface: triangles that need not close around anything.
    Sheet(Arc<Mesh>),
    /// A surface: a polygon whose normal is interpolated between those of its corners.
    Patch(Arc<[Corner]>),
    /// A surface: the side of a [`Shape::Cone`], without its caps.
    Tube {
        /// Radius at z = −1.
        bottom: f64,
        /// Radius at z = 1.
        top: f64,
    },
}

impl Shape {
    /// Whether it is a surface, seen and lit from both sides, and not a solid.
    pub fn is_surface(&self) -> bool {
        match self {
            Self::Bezier(patches) => !patches.is_closed(),
            _ => matches!(self, Self::Face(_) | Self::Sheet(_) | Self::Patch(_) | Self::Tube { .. }),
        }
    }

    /// A box around the shape, in its own coordinates.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Sphere | Self::Cone { .. } | Self::Cube | Self::Tube { .. } => {
                Bounds::new(DVec3::NEG_ONE, DVec3::ONE)
            }
            Self::Facets(facets) => facets.bounds,
            Self::Mesh(mesh) | Self::Sheet(mesh) => Bounds::around(mesh.points.iter().copied()),
            Self::Bezier(patches) => Bounds::around(patches.points().iter().copied()),
            Self::Face(corners) => Bounds::around(corners.iter().copied()),
            Self::Patch(corners) => Bounds::around(corners.iter().map(|corner| corner.place)),
        }
    }
}

/// A corner of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is.
    pub place: DVec3,
    /// The normal of the surface there, of any length; 0 where it is not known.
    pub normal: DVec3,
}

/// A bounded convex solid as an intersection of half-spaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Facets {
    /// At least four; their intersection is bounded and has an interior.
    pub faces: Vec<HalfSpace>,
    /// The box of the solid, in its own coordinates.
    pub bounds: Bounds,
}

/// The points `p` with `normal · p ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Outward; its length is 1 within rounding.
    pub normal: DVec3,
    /// Distance of the plane from the origin, along `normal`.
    pub offset: f64,
}

/// An index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(pub u32);

/// How a surface answers light: `docs/scene-language.md` has the equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name given by `material(name = …)`.
    pub name: Option<String>,
    /// C: the colour of diffuse and ambient light, each channel in `0..=1`.
    pub color: DVec3,
    /// Diffuse share, in `0..=1`.
    pub kd: f64,
    /// Highlight share, in `0..=1`.
    pub ks: f64,
    /// Highlight exponent, 0 or more.
    pub n: f64,
    /// Mirror share, in `0..=1`.
    pub kr: f64,
    /// Share of light let through, in `0..=1`.
    pub kt: f64,
    /// Index of refraction, above 0.
    pub index: f64,
}

impl Default for Material {
    /// A light gray, slightly shining, opaque surface.
    fn default() -> Self {
        Self { name: None, color: DVec3::splat(0.9), kd: 0.8, ks: 0.2, n: 24.0, kr: 0.0, kt: 0.0, index: 1.0 }
    }
}

/// A point of light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it stands.
    pub anchor: Anchor,
    /// Ip: its strength, 0 or more.
    pub intensity: f64,
    /// Its colour, each channel in `0..=1`.
    pub color: DVec3,
}

/// What a place is fixed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// A point of the world.
    World(DVec3),
    /// A point that moves with the eye: (right, up, back) in units of the distance from the eye to its
    /// target.
    Eye(DVec3),
}

impl Light {
    /// The lights of a scene that names none: a key light over the viewer's left shoulder and a weak fill
    /// light on the right, both moving with the eye.
    pub fn defaults() -> [Self; 2] {
        [
            Self { anchor: Anchor::Eye(DVec3::new(-0.6, 0.8, 0.2)), intensity: 0.85, color: DVec3::ONE },
            Self { anchor: Anchor::Eye(DVec3::new(0.9, 0.1, 0.3)), intensity: 0.2, color: DVec3::ONE },
        ]
    }
}

/// A view of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The name given by `camera(name = …)`.
    pub name: Option<String>,
    /// The viewpoint.
    pub eye: DVec3,
    /// A point the eye looks at; not the eye itself.
    pub target: DVec3,
    /// Upwards in the picture; not along the line of sight.
    pub up: DVec3,
    /// Full angles across and down, in degrees, each inside `0 < angle < 180`.
    pub field: [f64; 2],
    /// Between what the angles of `field` are measured.
    pub span: FieldSpan,
    /// Divides the tangents of both half angles; above 0.
    pub zoom: f64,
}

/// Between what a camera's angles are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FieldSpan {
    /// The edges of the picture.
    #[default]
    Edges,
    /// The centres of the first and the last row, or column, of dots: a picture of more dots then sees less
    /// beyond them.
    Centers,
}

/// What belongs to no object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct World {
    /// Ia: light that comes from everywhere, each channel 0 or more.
    pub ambient: DVec3,
    /// What a ray sees that meets nothing, each channel 0 or more.
    pub background: DVec3,
    /// The constant of the depth term of eq. (2): the lights' part is divided by `R + k`. Absent: no
    /// division.
    pub k: Option<f64>,
}

impl Default for World {
    fn default() -> Self {
        Self { ambient: DVec3::splat(0.1), background: DVec3::ZERO, k: None }
    }
}

/// Why a camera sees nothing meaningful.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CameraError {
    /// The eye is at its target.
    #[error("eye and target are the same point: there is no direction to look in")]
    NoSight,
    /// The sight line runs along `up`.
    #[error("the line of sight runs along `up`: turn `up` another way")]
    UpAlongSight,
    /// The way from the eye to the target is longer along an axis than the largest number.
    #[error("eye and target are farther apart than a 64-bit float holds: bring them nearer to each other")]
    TooFar,
    /// An angle, the zoom or a coordinate is out of its range.
    #[error("field, zoom or a coordinate of the camera is out of its range")]
    OutOfRange,
}

impl Camera {
    /// Whether the camera can look.
    pub fn check(&self) -> Result<(), CameraError> {
        let finite = self.eye.is_finite() && self.target.is_finite() && self.up.is_finite();
        let angles = self.field.iter().all(|&a| a > 0.0 && a < 180.0);
        if !(finite && angles && self.zoom > 0.0 && self.zoom.is_finite()) {
            return Err(CameraError::OutOfRange);
        }
        let sight = self.target - self.eye;
        if !sight.is_finite() {
            return Err(CameraError::TooFar);
        }
        let (long, high) = (sight.abs().max_element(), self.up.abs().max_element());
        if long == 0.0 {
            return Err(CameraError::NoSight);
        }
        let across = if high == 0.0 { 0.0 } else { (sight / long).cross(self.up / high).length() };
        // Three products of numbers up to 1, each rounded: below this the cross product is rounding only.
        if across <= 8.0 * f64::EPSILON { Err(CameraError::UpAlongSight) } else { Ok(()) }
    }
}

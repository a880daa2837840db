//! The words for primitives: a unit shape, and the map that gives it its place and size.

use super::arguments::{BoundArguments, refuse};
use super::chain::Numbers;
use super::context::Context;
use super::facets::Polygons;
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::carried;
use super::{Builder, facets, patches, polyhedron};
use crate::math::{DAffine3, DMat3, DVec3, Placement};
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::Call;
use crate::scene::language::vocabulary::{SolidWord, Word};
use crate::scene::memory::{ASSEMBLED, ASSEMBLED_FACES, ASSEMBLED_PIECE, ASSEMBLED_TRIANGLE};
use crate::scene::model::is_within_reach;
use crate::scene::{Diagnostic, FacetMode, Object, Primitive, REACH, Shape, Solid};

impl Builder {
    /// The primitive of a call.
    pub(super) fn primitive(
        &mut self,
        kind: SolidWord,
        word: &'static Word,
        call: &Call<'_>,
        context: &Context,
    ) -> Result<Solid, Lost> {
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
        let origin = Origin::of(word, call);
        let fragments = arguments.fragments(context.fragments);
        let (shape, local) = match self.facet_mode {
            FacetMode::Smooth => self.shape(kind, &arguments, facets::sides(fragments), call)?,
            FacetMode::OpenScad => match self.shape(kind, &arguments, None, call)? {
                (shape @ (Shape::Sphere | Shape::Cone { .. }), local) => {
                    (Shape::Mesh(self.facets_of(&shape, &local, fragments, origin)?), local)
                }
                other => other,
            },
        };
        if let Shape::Bezier(surface) = &shape
            && let Some(open) = surface.open_side()
            && self.is_operand()
        {
            let error = patches::not_closed(&arguments, open);
            return Err(arguments.refuse(error, Lost::Missing, &mut self.sink));
        }
        let primitive = self.put(shape, local, DVec3::ZERO, context, origin)?;
        self.note_digits(&primitive, &local, context);
        Ok(Solid::Primitive(primitive))
    }

    /// The unit shape of a call, and its map. Round ones are exact where no number of `sides` is given.
    pub(super) fn shape(
        &mut self,
        kind: SolidWord,
        arguments: &BoundArguments<'_, '_>,
        sides: Option<u32>,
        call: &Call<'_>,
    ) -> Result<(Shape, DAffine3), Lost> {
        let sink = &mut self.sink;
        let mut round = RoundShapes { sides, polygons: &mut self.polygons };
        match kind {
            SolidWord::Cube => cube(arguments, sink),
            SolidWord::Sphere => sphere(arguments, &mut round, sink),
            SolidWord::Cylinder => cylinder(arguments, &mut round, sink),
            SolidWord::Cone => cone(arguments, &mut round, sink),
            SolidWord::Surface => Ok((self.surface(arguments)?, DAffine3::IDENTITY)),
            SolidWord::Patch => Ok((patches::patch(arguments, sink)?, DAffine3::IDENTITY)),
            SolidWord::Patches => {
                let bytes = patches::bytes(arguments);
                if !self.memory.has_room_for(bytes) {
                    return Err(self.no_room(bytes, Origin::of(arguments.word(), call)));
                }
                Ok((patches::patches(arguments, sink)?, DAffine3::IDENTITY))
            }
            SolidWord::Polyhedron => {
                let bytes = polyhedron::bytes(arguments);
                if !self.memory.has_room_for(bytes) {
                    return Err(self.no_room(bytes, Origin::of(arguments.word(), call)));
                }
                Ok((polyhedron::polyhedron(arguments, &mut self.clipper, sink)?, DAffine3::IDENTITY))
            }
        }
    }

    /// A shape as a primitive of the scene: `local` puts it into the coordinates of its word, in which its
    /// points may be off by `off` already.
    pub(super) fn put(
        &mut self,
        shape: Shape,
        local: DAffine3,
        off: DVec3,
        context: &Context,
        origin: Origin,
    ) -> Result<Primitive, Lost> {
        let refuse = |error, sink: &mut Sink| refuse(origin.word, error, Lost::Empty, sink);
        let sink = &mut self.sink;
        let maps = match context.maps.then(local, Numbers::Written, origin.name) {
            Ok(maps) => maps,
            Err(error) => return Err(refuse(error, sink)),
        };
        let map = *maps.product();
        let bounds = shape.bounds().mapped(&map);
        if !is_within_reach(&bounds) {
            let message = format!("it reaches farther than {REACH:e} from the origin");
            let error = Diagnostic::error(origin.name, message);
            return Err(refuse(error.label("too large, or too far away"), sink));
        }
        if Placement::new(&map).is_none() {
            let error = Diagnostic::error(origin.name, "it is smaller than a 64-bit float holds");
            return Err(refuse(error.label("too small, or too flat"), sink));
        }
        let material = self.surfaces.id(context.surface);
        let error = maps.error(&shape.bounds()) + carried(&context.maps.product().matrix3, off);
        let own = match &shape {
            Shape::Mesh(mesh) => {
                let bytes = size_of_val(mesh.points.as_slice()) + size_of_val(mesh.triangles.as_slice());
                bytes as u64 + ASSEMBLED_FACES + ASSEMBLED_TRIANGLE * mesh.triangles.len() as u64
            }
            Shape::Bezier(patches) => {
                let bytes = size_of_val(patches.points()) + size_of_val(patches.patches());
                let pieces = (patches.patches().len() as u64) << (2 * patches.cuts());
                bytes as u64 + ASSEMBLED_FACES + ASSEMBLED_PIECE * pieces
            }
            Shape::Facets(_) => ASSEMBLED_FACES,
            _ => 0,
        };
        let bytes = own + size_of::<Object>() as u64 + ASSEMBLED;
        if !self.memory.has_room_for(bytes) {
            return Err(self.no_room(bytes, origin));
        }
        self.memory.take(bytes);
        Ok(Primitive::new(shape, map, material).with_map_error(error))
    }

    /// The error of what there is no memory for: it is the last that is read.
    pub(super) fn no_room(&mut self, bytes: u64, origin: Origin) -> Lost {
        self.is_out_of_memory = true;
        self.memory.refuse(bytes, origin.end, &mut self.sink).into()
    }
}

/// Round shapes, or what `$fn` makes of them.
struct RoundShapes<'b> {
    sides: Option<u32>,
    polygons: &'b mut Polygons,
}

impl RoundShapes<'_> {
    fn sphere(&mut self) -> Shape {
        match self.sides {
            Some(sides) => self.polygons.sphere(sides),
            None => Shape::Sphere,
        }
    }

    fn cone(&mut self, bottom: f64, top: f64) -> Shape {
        match self.sides {
            Some(sides) => self.polygons.cone(sides, bottom, top),
            None => Shape::Cone { bottom, top },
        }
    }
}

/// The map of the shape with centre `at` and half-sizes `semi`.
pub fn placed(at: DVec3, semi: DVec3) -> DAffine3 {
    DAffine3 { matrix3: DMat3::from_diagonal(semi), translation: at }
}

/// The paper's parameters, where they are used: centre and half-sizes.
fn centre_and_half_sizes(
    arguments: &BoundArguments<'_, '_>,
    sink: &mut Sink,
) -> Result<Option<(DVec3, DVec3)>, Lost> {
    let (at, semi) = (arguments.triple("at", 0.0, sink)?, arguments.triple("semi", 0.0, sink)?);
    match (semi, arguments.other_than(&["at", "semi"])) {
        (Some(semi), None) => Ok(Some((at.unwrap_or_default(), semi))),
        (Some(_), Some((name, place))) => {
            let error = Diagnostic::error(place, format!("`{name}` and `semi` exclude each other"));
            Err(sink.report(error.help(format!("`semi` has all sizes: leave `{name}` out"))).into())
        }
        (None, _) if at.is_some() => {
            let error = Diagnostic::error(arguments.place_of("at"), "`at` stands without `semi`");
            Err(sink.report(error.help("give the half-sizes, semi = [a, b, c]; or use `translate`")).into())
        }
        (None, _) => Ok(None),
    }
}

fn cube(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<(Shape, DAffine3), Lost> {
    if let Some((at, semi)) = centre_and_half_sizes(arguments, sink)? {
        return Ok((Shape::Cube, placed(at, semi)));
    }
    let half = arguments.triple("size", 0.0, sink)?.unwrap_or(DVec3::ONE) * 0.5;
    // Half a size is exact, and so are the corners: half − half and half + half.
    let middle = if arguments.flag("center", sink)? { DVec3::ZERO } else { half };
    Ok((Shape::Cube, placed(middle, half)))
}

fn sphere(
    arguments: &BoundArguments<'_, '_>,
    round: &mut RoundShapes<'_>,
    sink: &mut Sink,
) -> Result<(Shape, DAffine3), Lost> {
    let shape = round.sphere();
    if let Some((at, semi)) = centre_and_half_sizes(arguments, sink)? {
        return Ok((shape, placed(at, semi)));
    }
    let radius = radius(arguments, "d", "r", sink)?.unwrap_or(1.0);
    Ok((shape, placed(DVec3::ZERO, DVec3::splat(radius))))
}

/// The radius, given as that or as a diameter; both together contradict each other.
pub fn radius(
    arguments: &BoundArguments<'_, '_>,
    diameter: &str,
    radius: &str,
    sink: &mut Sink,
) -> Result<Option<f64>, Lost> {
    if let (Some(_), Some(place)) = (arguments.value(radius), arguments.value(diameter)) {
        let error = Diagnostic::error(place.span, format!("`{radius}` and `{diameter}` exclude each other"));
        return Err(sink.report(error.help("give the radius or the diameter")).into());
    }
    match arguments.number(diameter, sink)? {
        Some(diameter) => Ok(Some(diameter * 0.5)),
        None => arguments.number(radius, sink),
    }
}

fn cylinder(
    arguments: &BoundArguments<'_, '_>,
    round: &mut RoundShapes<'_>,
    sink: &mut Sink,
) -> Result<(Shape, DAffine3), Lost> {
    if let Some((at, semi)) = centre_and_half_sizes(arguments, sink)? {
        return Ok((round.cone(1.0, 1.0), placed(at, semi)));
    }
    // As in OpenSCAD: `r` sets both radii, `r1` and `r2` each its own after that, and 1 is the default.
    let both = radius(arguments, "d", "r", sink)?.unwrap_or(1.0);
    let bottom = radius(arguments, "d1", "r1", sink)?.unwrap_or(both);
    let top = radius(arguments, "d2", "r2", sink)?.unwrap_or(both);
    let largest = bottom.max(top);
    if largest == 0.0 {
        let place = arguments.place_of(if arguments.value("r1").is_some() { "r1" } else { "d1" });
        let error = Diagnostic::error(place, "both ends of the cylinder are 0");
        return Err(arguments.refuse(error.help("one end may be a point, not both"), Lost::Empty, sink));
    }
    upright(arguments, round.cone(bottom / largest, top / largest), largest, sink)
}

/// A shape of height 2 put onto the plane z = 0, or with its middle into it.
fn upright(
    arguments: &BoundArguments<'_, '_>,
    shape: Shape,
    radius: f64,
    sink: &mut Sink,
) -> Result<(Shape, DAffine3), Lost> {
    let half = arguments.number("h", sink)?.unwrap_or(1.0) * 0.5;
    let middle = if arguments.flag("center", sink)? { 0.0 } else { half };
    Ok((shape, placed(DVec3::new(0.0, 0.0, middle), DVec3::new(radius, radius, half))))
}

fn cone(
    arguments: &BoundArguments<'_, '_>,
    round: &mut RoundShapes<'_>,
    sink: &mut Sink,
) -> Result<(Shape, DAffine3), Lost> {
    let shape = round.cone(1.0, 0.0);
    if let Some((apex, semi)) = centre_and_half_sizes(arguments, sink)? {
        // The paper's cone fills −c ≤ Z ≤ 0 below its apex, half of the box that its half-sizes span.
        let half = semi.with_z(semi.z * 0.5);
        return Ok((shape, placed(apex.with_z(apex.z - half.z), half)));
    }
    let radius = radius(arguments, "d", "r", sink)?.unwrap_or(1.0);
    upright(arguments, shape, radius, sink)
}

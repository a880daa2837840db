//! What belongs to no object: views, lights, the world.

use super::Builder;
use super::arguments::Arguments;
use super::maps::unit;
use crate::math::DVec3;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::language::nearest::quoted;
use crate::scene::language::syntax::{Call, Spanned, Value};
use crate::scene::{Anchor, Camera, Diagnostic, FieldSpan, Light, World};

impl Builder<'_> {
    pub(super) fn camera(&mut self, arguments: &Arguments<'_, '_>) -> Result<(), Reported> {
        let sink = &mut *self.sink;
        let name = arguments.text("name", sink)?;
        let eye = arguments.triple("eye", 0.0, sink)?.ok_or_else(|| arguments.missing("eye", sink))?;
        let target = arguments.triple("target", 0.0, sink)?.unwrap_or_default();
        let sight = sight_line(eye, target, arguments, sink)?;
        let up = match arguments.triple("up", 0.0, sink)? {
            Some(up) if along(sight, up) => {
                let error = Diagnostic::error(arguments.place_of("up"), "`up` lies along the line of sight");
                return Err(sink.report(error.help("give a direction that is upwards in the picture")));
            }
            Some(up) => up,
            None if along(sight, DVec3::Z) => DVec3::Y,
            None => DVec3::Z,
        };
        let field = arguments.field("field", sink)?.unwrap_or([40.0, 25.0]);
        let zoom = arguments.number("zoom", sink)?.unwrap_or(1.0);
        if let Some(name) = name
            && !self.view_names.insert(name.to_owned())
        {
            let message = format!("there are two views named \"{}\"", quoted(name));
            let error = Diagnostic::error(arguments.place_of("name"), message).label("the second one");
            return Err(sink.report(error.help("give it another name")));
        }
        self.scene.views.push(Camera {
            name: name.map(str::to_owned),
            eye,
            target,
            up,
            field,
            span: FieldSpan::Edges,
            zoom,
        });
        Ok(())
    }

    pub(super) fn light(&mut self, arguments: &Arguments<'_, '_>) -> Result<(), Reported> {
        let sink = &mut *self.sink;
        let at = arguments.triple("at", 0.0, sink)?.ok_or_else(|| arguments.missing("at", sink))?;
        let intensity = arguments.number("intensity", sink)?.unwrap_or(1.0);
        let color = arguments.color("color", sink)?.map_or(DVec3::ONE, |(color, _)| color);
        self.scene.lights.push(Light { anchor: Anchor::World(at), intensity, color });
        Ok(())
    }

    pub(super) fn world(&mut self, call: &Call<'_>, arguments: &Arguments<'_, '_>) -> Result<(), Reported> {
        let sink = &mut *self.sink;
        if std::mem::replace(&mut self.has_world, true) {
            let error = Diagnostic::error(call.name.span, "there are two worlds").label("the second one");
            return Err(sink.report(error.help("put all its arguments into one")));
        }
        let World { ambient, background, .. } = World::default();
        self.scene.world = World {
            ambient: arguments.triple("ambient", 0.0, sink)?.unwrap_or(ambient),
            background: arguments.triple("background", 0.0, sink)?.unwrap_or(background),
            k: arguments.number("k", sink)?,
        };
        Ok(())
    }
}

/// The direction from the eye to the target.
fn sight_line(
    eye: DVec3,
    target: DVec3,
    arguments: &Arguments<'_, '_>,
    sink: &mut Sink,
) -> Result<DVec3, Reported> {
    // Halves, so that the difference of two large numbers stays finite. The smallest subnormals have no
    // halves, but an eye so near its target that only they tell the two apart sees nothing either.
    if let Some(sight) = unit(target * 0.5 - eye * 0.5) {
        return Ok(sight);
    }
    let error = Diagnostic::error(arguments.place_of("eye"), "`eye` and `target` are the same point");
    let error = match arguments.value("target") {
        None => error.help("`target` is [0, 0, 0] where it is not given"),
        Some(Spanned { value: Value::List(_), .. }) => error.help("move one of them"),
        Some(_) => error,
    };
    Err(sink.report(error))
}

/// Whether a unit vector and another vector lie along one line, as far as rounding lets one tell: each
/// component of the cross product of two unit vectors is wrong by up to 4 units of 2⁻⁵³ (their own rounding
/// and that of two products), so that a shorter product has no direction to take `right` from.
fn along(sight: DVec3, other: DVec3) -> bool {
    unit(other).is_none_or(|other| sight.cross(other).abs().max_element() <= 2.0 * f64::EPSILON)
}

//! What belongs to no object: views, lights, the world.

use super::Builder;
use super::arguments::BoundArguments;
use crate::math::DVec3;
use crate::scene::diagnostic::Reported;
use crate::scene::language::nearest::quoted;
use crate::scene::language::syntax::Call;
use crate::scene::{Anchor, Camera, CameraError, Diagnostic, FieldSpan, Light, World};

impl Builder {
    pub(super) fn camera(&mut self, arguments: &BoundArguments<'_, '_>) -> Result<(), Reported> {
        let sink = &mut self.sink;
        let name = arguments.text("name", sink)?;
        let eye = arguments.triple("eye", 0.0, sink)?.ok_or_else(|| arguments.missing("eye", sink))?;
        let target = arguments.triple("target", 0.0, sink)?.unwrap_or_default();
        let up = arguments.triple("up", 0.0, sink)?;
        let mut camera = Camera {
            name: name.map(str::to_owned),
            eye,
            target,
            up: up.unwrap_or(DVec3::Z),
            field: arguments.field("field", sink)?.unwrap_or([40.0, 25.0]),
            span: FieldSpan::Edges,
            zoom: arguments.number("zoom", sink)?.unwrap_or(1.0),
        };
        let mut checked = camera.check();
        if up.is_none() && checked == Err(CameraError::UpAlongSight) {
            camera.up = DVec3::Y;
            checked = camera.check();
        }
        checked.map_err(|error| sink.report(blind(error, arguments)))?;
        if let Some(name) = name
            && !self.view_names.insert(name.to_owned())
        {
            let message = format!("there are two views named \"{}\"", quoted(name));
            let error = Diagnostic::error(arguments.place_of("name"), message).label("the second one");
            return Err(sink.report(error.help("give it another name")));
        }
        // Its name is kept twice: to be found, and to be told from the others.
        let bytes = size_of::<Camera>() + 2 * (size_of::<String>() + name.map_or(0, str::len));
        self.memory.take(bytes as u64);
        self.scene.views.push(camera);
        Ok(())
    }

    pub(super) fn light(&mut self, arguments: &BoundArguments<'_, '_>) -> Result<(), Reported> {
        let sink = &mut self.sink;
        let at = arguments.triple("at", 0.0, sink)?.ok_or_else(|| arguments.missing("at", sink))?;
        let intensity = arguments.number("intensity", sink)?.unwrap_or(1.0);
        let color = arguments.color("color", sink)?.map_or(DVec3::ONE, |(color, _)| color);
        self.memory.take(size_of::<Light>() as u64);
        self.scene.lights.push(Light { anchor: Anchor::World(at), intensity, color });
        Ok(())
    }

    pub(super) fn world(
        &mut self,
        call: &Call<'_>,
        arguments: &BoundArguments<'_, '_>,
    ) -> Result<(), Reported> {
        let sink = &mut self.sink;
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

/// What is wrong with a camera, at the argument that can mend it.
fn blind(error: CameraError, arguments: &BoundArguments<'_, '_>) -> Diagnostic {
    match error {
        CameraError::NoSight => {
            let error = Diagnostic::error(arguments.place_of("eye"), "`eye` and `target` are the same point");
            match arguments.value("target") {
                None => error.help("`target` is [0, 0, 0] where it is not given"),
                Some(_) => error.help("move one of them"),
            }
        }
        CameraError::UpAlongSight => {
            let error = Diagnostic::error(arguments.place_of("up"), "`up` lies along the line of sight");
            error.help("give a direction that is upwards in the picture")
        }
        // All else is in its range by what the arguments take.
        CameraError::TooFar | CameraError::OutOfRange => {
            let message = "`eye` and `target` are farther apart than a 64-bit float holds";
            Diagnostic::error(arguments.place_of("eye"), message).help("bring them nearer to each other")
        }
    }
}

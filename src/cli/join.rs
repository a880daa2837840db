//! Parts of a still, and the still that they become.

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;

use clap::{Parser, ValueEnum};

use crate::cluster::{Joining, PartError, PictureDigest, PicturePart};
use crate::frame::{Frame, Request, Wants};
use crate::glyph;
use crate::scene::Scene;
use crate::view::TileShare;

use super::arguments::{Arguments, Command, JoinArguments, RenderArguments};
use super::error::{CliError, visible};
use super::formats::StillFormat;
use super::still::{self, Values};
use super::write::{Destination, SceneFiles};

/// The bytes of the part that a frame holds.
pub fn part(
    arguments: &RenderArguments,
    scene: &Scene,
    request: &Request,
    frame: &Frame,
    share: TileShare,
) -> Result<Vec<u8>, CliError> {
    let picture = PictureDigest::of(scene, request);
    let mut bytes = Vec::new();
    let written = PicturePart::of(frame, picture, share, shown(arguments)).write(&mut bytes);
    written.map_err(|e| CliError::Output(format!("the part could not be encoded: {e}")))?;
    Ok(bytes)
}

/// Joins parts and writes the still.
pub fn run(arguments: &JoinArguments) -> Result<(), CliError> {
    let to = Destination::new(arguments.output.as_deref());
    if let Destination::File(path) = &to {
        let parts = SceneFiles::new(arguments.parts.iter().map(PathBuf::as_path));
        parts.check(path).map_err(|_| {
            CliError::Input(format!("{} is one of the parts, and would be lost", path.display()))
        })?;
    }
    let mut joining: Option<Joining> = None;
    for path in &arguments.parts {
        let name = visible(&path.to_string_lossy());
        let part = File::open(path).map_err(PartError::Io).and_then(PicturePart::read);
        let part = part.map_err(|e| CliError::Input(format!("{name}: {e}")))?;
        match &mut joining {
            None => joining = Some(Joining::new(&name, part)),
            Some(joining) => joining.add(&name, part).map_err(|e| CliError::Input(e.to_string()))?,
        }
    }
    let Some(joining) = joining else { return Err(CliError::Input("there are no parts".into())) };
    let render = meant(&joining.about().shown)?;
    let frame = joining.finish().map_err(|e| CliError::Input(e.to_string()))?;
    to.write(&encoded(&render, &to, frame)?)
}

/// The still that parts were drawn for.
fn encoded(render: &RenderArguments, to: &Destination, mut frame: Frame) -> Result<Vec<u8>, CliError> {
    let shown = still::still_of(render, StillFormat::Png);
    if let Destination::File(path) = to
        && let Some(ending) = path.extension()
        && let Ok(other) = StillFormat::from_str(&ending.to_string_lossy(), true)
        && other != shown.format
        // Files of both end alike.
        && (other, shown.format) != (StillFormat::Ans, StillFormat::AnsDos)
    {
        let drawn_for = name(&shown.format);
        return Err(CliError::Input(format!(
            "{}: the parts were drawn for {drawn_for}: for another format draw them with --format",
            path.display()
        )));
    }
    let picture = &render.picture;
    let look = still::look(picture, shown.format, None);
    let tone = picture.tone();
    if still::wants(shown) == Wants::CELLS {
        let color = frame.color.as_deref();
        let cells = glyph::compose_dots(&frame.light, color, look.glyphs, look.palette, tone);
        frame.cells = Some(Arc::new(cells));
    }
    still::encoded(&frame, look.palette, tone, shown.format, Values::new(shown, picture))
}

/// How the picture is to be shown, as options: all that its dots do not depend on.
fn shown(render: &RenderArguments) -> Vec<String> {
    let RenderArguments { picture, format, channel, levels, .. } = render;
    let valued = [
        ("format", format.as_ref().map(name)),
        ("channel", channel.as_ref().map(name)),
        ("preset", picture.preset.as_ref().map(name)),
        ("glyphs", picture.glyphs.as_ref().map(name)),
        ("palette", picture.palette.as_ref().map(name)),
        ("tone", picture.tone.as_ref().map(name)),
    ];
    let valued = valued.into_iter().filter_map(|(option, value)| Some(format!("--{option}={}", value?)));
    let switches = [("levels", *levels), ("invert", picture.invert), ("no-invert", picture.no_invert)];
    let switches = switches.into_iter().filter(|(_, is_given)| *is_given);
    valued.chain(switches.map(|(option, _)| format!("--{option}"))).collect()
}

/// What [`shown`] has made options of, and nothing else.
fn meant(options: &[String]) -> Result<RenderArguments, CliError> {
    let words = ["ray13", "render", "-"].into_iter().chain(options.iter().map(String::as_str));
    match Arguments::try_parse_from(words).map(|arguments| arguments.command) {
        Ok(Some(Command::Render(render))) if shown(&render) == options => Ok(render),
        _ => Err(CliError::Input("the parts say nothing that ray13 knows of how they are shown".into())),
    }
}

/// A value as it is written on the command line.
fn name(value: &impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

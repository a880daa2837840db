//! Stills.

use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use clap::ValueEnum;

use crate::frame::{Frame, Request, Wants};
use crate::glyph::Palette;
use crate::math::Grid;
use crate::output::{self, Capabilities, Pixels};
use crate::plan::PrecisionChoice;
use crate::tone::Tone;

use super::arguments::{Channel, Format, PictureArguments, RenderArguments};
use super::error::CliError;
use super::picture::Look;
use super::{input, print, stats, terminal};

/// Draws one still and writes it.
pub fn run(arguments: &RenderArguments) -> Result<(), CliError> {
    let format = arguments.format.map_or_else(|| format_of(arguments.output.as_deref()), Ok)?;
    check(format, arguments.channel)?;
    let reading = Instant::now();
    let scene = input::read(&arguments.scene.file, arguments.scene.skip_unsupported, arguments.scene.memory)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let read = reading.elapsed();
    let wants = wants(format, arguments.channel);
    // What goes into a file is not for the terminal that the command runs in.
    let terminal = if arguments.output.is_some() { None } else { terminal::of_output() };
    let look = look(&arguments.picture, format, terminal);
    let mut request = arguments.picture.request(&studio, look, wants)?;
    // Raw values are for whoever computes with them.
    if format == Format::Pfm && request.options.precision == PrecisionChoice::Auto {
        request.options.precision = PrecisionChoice::Double;
    }
    let mut frame = studio.draw(&request);
    frame.times[crate::stage::Stage::Objects] = read;
    if let Some(over) = &frame.over_budget {
        return Err(CliError::Input(format!("{over}: use --structure tree")));
    }
    let writing = Instant::now();
    let bytes = encoded(&frame, &request, format, arguments.channel)?;
    frame.times[crate::stage::Stage::Display] = writing.elapsed();
    match &arguments.output {
        Some(path) => write_file(path, &bytes)?,
        None => print(&bytes)?,
    }
    if let Some(form) = arguments.stats {
        stats::say(&frame, &studio.built(), form);
    }
    Ok(())
}

/// One still on standard output, which is no terminal, or one without a cursor: characters only.
pub fn still(
    file: &str,
    skip_unsupported: bool,
    memory: Option<u64>,
    picture: &PictureArguments,
) -> Result<(), CliError> {
    let scene = input::read(file, skip_unsupported, memory)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let look = look(picture, Format::Txt, terminal::of_output());
    let request = picture.request(&studio, look, Wants::CELLS)?;
    let frame = studio.draw(&request);
    print(&encoded(&frame, &request, Format::Txt, None)?)
}

/// Refuses a channel that the format does not hold.
fn check(format: Format, channel: Option<Channel>) -> Result<(), CliError> {
    let message = match (format, channel) {
        (_, None) | (Format::Pfm, _) | (Format::Png | Format::Pgm | Format::Ppm, Some(Channel::Light)) => {
            return Ok(());
        }
        (_, Some(Channel::Light)) => "--channel light needs --format png, pgm, ppm or pfm",
        (_, Some(_)) => "this --channel needs --format pfm: the other formats hold the picture itself",
    };
    Err(CliError::Input(message.into()))
}

/// What the format shows of a picture.
fn wants(format: Format, channel: Option<Channel>) -> Wants {
    match (format, channel) {
        (Format::Txt | Format::Ans, _) => Wants::CELLS,
        (_, Some(Channel::Depth)) => Wants { depth: true, ..Wants::LIGHT },
        (_, Some(Channel::Normal)) => Wants { normal: true, ..Wants::LIGHT },
        (_, Some(Channel::Object)) => Wants { object: true, ..Wants::LIGHT },
        (_, Some(Channel::Light) | None) => Wants::LIGHT,
    }
}

/// Text has no colours to lose: its shades are ink.
fn look(picture: &PictureArguments, format: Format, terminal: Option<Capabilities>) -> Look {
    let look = picture.look(terminal);
    if format == Format::Txt { Look { palette: Palette::Mono, ..look } } else { look }
}

/// The format that a file's ending names. A file without one holds text; an ending that names no format is an error,
/// since text in a `.jpg` would be found out late.
fn format_of(path: Option<&Path>) -> Result<Format, CliError> {
    let Some(path) = path else {
        return Ok(if io::stdout().is_terminal() { Format::Ans } else { Format::Txt });
    };
    let Some(ending) = path.extension() else { return Ok(Format::Txt) };
    Format::from_str(&ending.to_string_lossy(), true).map_err(|_| {
        let known: Vec<String> = Format::value_variants()
            .iter()
            .filter_map(|format| Some(format.to_possible_value()?.get_name().to_owned()))
            .collect();
        CliError::Input(format!(
            "{}: its ending is that of no format ({}): --format says which is meant",
            path.display(),
            known.join(", ")
        ))
    })
}

/// The whole still in memory, so that an error leaves nothing half-written.
fn encoded(
    frame: &Frame,
    request: &Request,
    format: Format,
    channel: Option<Channel>,
) -> Result<Vec<u8>, CliError> {
    let mut out = Vec::new();
    let done = match format {
        Format::Txt => wanted(frame.cells.as_ref()).and_then(|cells| output::text(cells, &mut out)),
        Format::Ans => wanted(frame.cells.as_ref()).and_then(|cells| output::ansi(cells, &mut out)),
        Format::Levels => output::levels(&frame.levels(request.tone), &mut out),
        Format::Png => {
            let drawn = output::png(&pixels(frame, request, channel), &mut out);
            drawn.map_err(|e| io::Error::other(e.to_string()))
        }
        Format::Pgm => output::pgm(&grays(frame, request, channel), &mut out),
        Format::Ppm => output::ppm(&pixels(frame, request, channel), &mut out),
        Format::Pfm => match channel.unwrap_or(Channel::Light) {
            Channel::Light => match &frame.color {
                Some(color) => output::pfm_vectors(color, &mut out),
                None => output::pfm_gray(&frame.light, &mut out),
            },
            Channel::Depth => {
                wanted(frame.depth.as_ref()).and_then(|depth| output::pfm_gray(depth, &mut out))
            }
            Channel::Normal => {
                wanted(frame.normal.as_ref()).and_then(|normal| output::pfm_vectors(normal, &mut out))
            }
            Channel::Object => wanted(frame.object.as_ref())
                .and_then(|object| output::pfm_gray(&object.map(|&n| f64::from(n)), &mut out)),
        },
    };
    done.map_err(|e| CliError::Output(format!("the picture could not be encoded: {e}")))?;
    Ok(out)
}

/// A grid that the request asked for.
fn wanted<T>(grid: Option<&Arc<Grid<T>>>) -> io::Result<&Grid<T>> {
    grid.map(Arc::as_ref).ok_or_else(|| io::Error::other("it lacks what it was drawn for"))
}

/// Colours where they are wanted, as the tone shows them or as they are; else grays.
fn pixels(frame: &Frame, request: &Request, channel: Option<Channel>) -> Pixels {
    let tone = if channel.is_some() { Tone::Lightness } else { request.tone };
    match &frame.color {
        Some(color) => Pixels::of_colors(color, tone),
        None => Pixels::Gray(grays(frame, request, channel)),
    }
}

/// The levels' grays, or the light itself where it is asked for.
fn grays(frame: &Frame, request: &Request, channel: Option<Channel>) -> Grid<u8> {
    match channel {
        Some(_) => output::grays_of_light(&frame.light),
        None => output::grays_of_levels(&frame.levels(request.tone)),
    }
}

/// Writes beside the place and moves there at the end, so that the file is whole or as it was. A link is written
/// through, and a file that was there keeps its permissions. What is no plain file, a pipe or a device, is written
/// straight.
fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let failed = |e: io::Error| CliError::Output(format!("{} could not be written: {e}", path.display()));
    let open = || fs::File::options().write(true).open(path);
    let (place, permissions) = match fs::metadata(path) {
        Ok(found) if found.is_dir() => return Err(failed(io::ErrorKind::IsADirectory.into())),
        Ok(found) if !found.is_file() => {
            let written = open().and_then(|mut out| out.write_all(bytes).and_then(|()| out.flush()));
            return written.map_err(failed);
        }
        Ok(found) => {
            // A move asks the folder for permission only; the file must allow it too.
            open().map_err(failed)?;
            (fs::canonicalize(path).map_err(failed)?, Some(found.permissions()))
        }
        Err(_) => (path.to_owned(), None),
    };
    // Not made from the file's own name, which may be as long as names can be.
    let part = place.with_file_name(format!("ray13-{}.part", std::process::id()));
    let written = fs::write(&part, bytes)
        .and_then(|()| permissions.map_or(Ok(()), |own| fs::set_permissions(&part, own)))
        .and_then(|()| fs::rename(&part, &place));
    written.map_err(|e| {
        let _ = fs::remove_file(&part);
        failed(e)
    })
}

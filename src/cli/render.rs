//! Stills.

use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::time::Instant;

use clap::ValueEnum;

use crate::app::Painter;
use crate::frame::{Frame, Request, Wants};
use crate::glyph::{Ground, Palette};
use crate::math::Grid;
use crate::output::{self, Capabilities, Pixels};
use crate::plan::PrecisionChoice;
use crate::scene::{FilesRead, Scene};
use crate::tone::Tone;

use super::arguments::{
    PictureArguments, RawChannel, ReadingArguments, RenderArguments, SceneArguments, StillFormat,
};
use super::effects::{self, Still};
use super::error::{CliError, tell, visible};
use super::input::Onlooker;
use super::openscad::OpenScadRun;
use super::picture::{Look, PIXELS, Unsized};
use super::reload::WatchedScene;
use super::write::{Destination, print};
use super::{input, stats, terminal};

/// Draws one still and writes it.
pub fn run(arguments: &RenderArguments) -> Result<(), CliError> {
    let to = Destination::new(arguments.output.as_deref());
    to.check(&arguments.scene.file)?;
    let format = arguments.format.map_or_else(|| format_of(&to), Ok)?;
    let still = Still { format, channel: arguments.channel, levels: arguments.levels };
    let notes = effects::check(&arguments.picture, effects::Presentation::Still(still))?;
    input::say(&notes);
    let SceneArguments { file, reading } = &arguments.scene;
    if !arguments.watch {
        let begin = Instant::now();
        let files = FilesRead::default();
        let scene = input::read_noting(file, reading, &files)?;
        to.check_files(&files.all())?;
        input::say(&scene.notes);
        return draw(arguments, still, scene, begin, &to);
    }
    let onlooker = Onlooker { openscad: OpenScadRun::minding_signals(), ..Onlooker::default() };
    let Some(mut watched) = WatchedScene::new(file, reading, onlooker) else {
        return Err(CliError::Input(format!("{}: only a file is watched", visible(file))));
    };
    let has_place = terminal::of_output().is_some_and(|terminal| terminal.cursor);
    let to = if has_place && arguments.output.is_none() { Destination::Place } else { to };
    loop {
        let begin = Instant::now();
        let read = watched.read();
        let drawn = read.and_then(|scene| {
            to.check_files(watched.files())?;
            let notes = scene.notes.clone();
            draw(arguments, still, scene, begin, &to)?;
            input::say(&notes);
            Ok(())
        });
        match drawn {
            // A mistake stands below the last picture until it is mended.
            Err(error @ (CliError::Input(_) | CliError::Scene(_))) => error.report(),
            other => other?,
        }
        if !watched.wait() {
            return Ok(());
        }
    }
}

/// Draws a scene that was read since `begin`, and writes the still.
fn draw(
    arguments: &RenderArguments,
    still: Still,
    scene: Scene,
    begin: Instant,
    to: &Destination,
) -> Result<(), CliError> {
    let format = still.format;
    let studio = input::studio(scene)?;
    let reading = begin;
    let read = reading.elapsed();
    // What goes into a file is not for the terminal that the command runs in.
    let terminal = if arguments.output.is_some() { None } else { terminal::of_output() };
    let look = look(&arguments.picture, format, terminal);
    let size = if format.is_pixels() { Unsized::Pixels } else { Unsized::Screen };
    let mut request = arguments.picture.request(&studio, look, wants(still), size)?;
    // Raw values are for whoever computes with them.
    if format == StillFormat::Pfm && request.options.precision == PrecisionChoice::Auto {
        request.options.precision = PrecisionChoice::Double;
    }
    let mut frame = studio.draw(&request);
    frame.times[crate::stage::Stage::Objects] = read;
    refuse_over_budget(&frame)?;
    let writing = Instant::now();
    let values = Values::new(still, &arguments.picture);
    let bytes = encoded(&frame, &request, format, values)?;
    frame.times[crate::stage::Stage::Display] = writing.elapsed();
    to.write(&bytes)?;
    match arguments.stats {
        Some(form) => stats::say(&frame, &studio.built(), form),
        None => say_nothing(&frame),
    }
    Ok(())
}

/// A still on standard output, and again as the scene's files change.
pub fn watched_still(
    file: &str,
    reading: &ReadingArguments,
    picture: &PictureArguments,
) -> Result<(), CliError> {
    run(&RenderArguments {
        scene: SceneArguments { file: file.to_owned(), reading: reading.clone() },
        picture: picture.clone(),
        format: None,
        channel: None,
        levels: false,
        output: None,
        watch: true,
        stats: None,
    })
}

/// One still on standard output, which is no terminal, or one without a cursor: characters only.
pub fn still(file: &str, reading: &ReadingArguments, picture: &PictureArguments) -> Result<(), CliError> {
    let still = Still { format: StillFormat::Txt, channel: None, levels: false };
    let notes = effects::check(picture, effects::Presentation::Still(still))?;
    input::say(&notes);
    let scene = input::read(file, reading)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let look = look(picture, StillFormat::Txt, terminal::of_output());
    let request = picture.request(&studio, look, Wants::CELLS, Unsized::Screen)?;
    let frame = studio.draw(&request);
    print(&encoded(&frame, &request, StillFormat::Txt, Values::Toned)?)?;
    say_nothing(&frame);
    Ok(())
}

/// The picture that the viewer shows, drawn as a format needs it: characters as they stand there, pixels in
/// the number that they have where nobody says another.
pub fn of_view(painter: &dyn Painter, shown: &Request, format: StillFormat) -> Result<Vec<u8>, CliError> {
    let still = Still { format, channel: None, levels: false };
    let mut request = Request { wants: wants(still), ..shown.clone() };
    if format.is_pixels() {
        (request.dots, request.dot_aspect) = (PIXELS, 1.0);
    }
    if format == StillFormat::Txt {
        request.palette = Palette::Mono(Ground::Dark).for_glyphs(request.glyphs, Ground::Dark);
    }
    if format == StillFormat::Pfm && request.options.precision == PrecisionChoice::Auto {
        request.options.precision = PrecisionChoice::Double;
    }
    let raw = Values::Raw(RawChannel::Light);
    let values = if format == StillFormat::Pfm { raw } else { Values::Toned };
    encoded(&painter.draw(&request), &request, format, values)
}

/// Refuses a picture whose space is cut otherwise than was asked for.
pub fn refuse_over_budget(frame: &Frame) -> Result<(), CliError> {
    match &frame.over_budget {
        Some(over) => Err(CliError::Input(format!("{over}: use --structure tree"))),
        None => Ok(()),
    }
}

/// Says why a picture is all background.
pub fn say_nothing(frame: &Frame) {
    if let Some(why) = frame.nothing {
        tell(&why.to_string());
    }
}

/// What is shown of light in pixels and raw values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Values {
    /// As the tone shows it.
    Toned,
    /// The grays of the levels.
    Levels,
    /// A channel as it is.
    Raw(RawChannel),
}

impl Values {
    /// What is asked for. The picture of 1986 had levels; a colour has none.
    fn new(still: Still, picture: &PictureArguments) -> Self {
        match still.channel {
            Some(channel) => Self::Raw(channel),
            None if still.format == StillFormat::Pfm => Self::Raw(RawChannel::Light),
            None if still.levels || picture.preset.is_some() => Self::Levels,
            None => Self::Toned,
        }
    }
}

/// What the format shows of a picture.
fn wants(still: Still) -> Wants {
    match (still.format, still.channel) {
        (StillFormat::Txt | StillFormat::Ans, _) => Wants::CELLS,
        (_, Some(RawChannel::Depth)) => Wants { depth: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Normal)) => Wants { normal: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Object)) => Wants { object: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Light) | None) => Wants::LIGHT,
    }
}

/// Text has no colours to lose: its shades are ink.
fn look(picture: &PictureArguments, format: StillFormat, terminal: Option<Capabilities>) -> Look {
    let look = picture.look(terminal);
    if format == StillFormat::Txt { Look { palette: Palette::Mono(picture.ground()), ..look } } else { look }
}

/// The format that a file's ending names. A file without one holds text; an ending that names no format is an
/// error, since text in a `.jpg` would be found out late.
fn format_of(to: &Destination) -> Result<StillFormat, CliError> {
    let Destination::File(path) = to else {
        return Ok(if io::stdout().is_terminal() { StillFormat::Ans } else { StillFormat::Txt });
    };
    let Some(ending) = path.extension() else { return Ok(StillFormat::Txt) };
    StillFormat::from_str(&ending.to_string_lossy(), true).map_err(|_| {
        let known: Vec<String> = StillFormat::value_variants()
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
    format: StillFormat,
    values: Values,
) -> Result<Vec<u8>, CliError> {
    let mut out = Vec::new();
    let done = match format {
        StillFormat::Txt => wanted(frame.cells.as_ref()).and_then(|cells| output::text(cells, &mut out)),
        StillFormat::Ans => wanted(frame.cells.as_ref()).and_then(|cells| output::ansi(cells, &mut out)),
        StillFormat::Levels => output::levels(&frame.levels(request.tone), &mut out),
        StillFormat::Png => {
            let drawn = output::png(&pixels(frame, request, values), &mut out);
            drawn.map_err(|e| io::Error::other(e.to_string()))
        }
        StillFormat::Pgm => output::pgm(&grays(frame, request, values), &mut out),
        StillFormat::Ppm => output::ppm(&pixels(frame, request, values), &mut out),
        StillFormat::Pfm => match values {
            Values::Toned | Values::Levels | Values::Raw(RawChannel::Light) => match &frame.color {
                Some(color) => output::pfm_vectors(color, &mut out),
                None => output::pfm_gray(&frame.light, &mut out),
            },
            Values::Raw(RawChannel::Depth) => {
                wanted(frame.depth.as_ref()).and_then(|depth| output::pfm_gray(depth, &mut out))
            }
            Values::Raw(RawChannel::Normal) => {
                wanted(frame.normal.as_ref()).and_then(|normal| output::pfm_vectors(normal, &mut out))
            }
            Values::Raw(RawChannel::Object) => wanted(frame.object.as_ref())
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

/// Colours where they are wanted; else grays.
fn pixels(frame: &Frame, request: &Request, values: Values) -> Pixels {
    match &frame.color {
        Some(color) => Pixels::of_colors(color, tone(request, values)),
        None => Pixels::Gray(grays(frame, request, values)),
    }
}

fn grays(frame: &Frame, request: &Request, values: Values) -> Grid<u8> {
    match values {
        Values::Levels => output::grays_of_levels(&frame.levels(request.tone)),
        Values::Toned | Values::Raw(_) => output::grays_of_light(&frame.light, tone(request, values)),
    }
}

/// Raw light has no tone.
fn tone(request: &Request, values: Values) -> Tone {
    if matches!(values, Values::Raw(_)) { Tone::Lightness } else { request.tone }
}

//! Stills.

use std::io::{self, IsTerminal};
use std::time::Instant;

use clap::ValueEnum;

use crate::frame::Wants;
use crate::scene::{FilesRead, Scene};

use super::arguments::{
    PictureArguments, ReadingArguments, RenderArguments, SceneArguments, TurntableArguments,
};
use super::effects::{self, Still};
use super::error::{CliError, visible};
use super::formats::StillFormat;
use super::input::Onlooker;
use super::openscad::OpenScadRun;
use super::picture::Unsized;
use super::reload::WatchedScene;
use super::still::{
    Values, check_dos, encoded, look, refuse_over_budget, say_nothing, settle_precision, still_of,
    unsized_picture, wants,
};
use super::write::{Destination, print};
use super::{input, join, stats, terminal, turntable};

/// Draws one still and writes it.
pub fn run(arguments: &RenderArguments) -> Result<(), CliError> {
    let to = Destination::new(arguments.output.as_deref());
    to.check(&arguments.scene.file)?;
    // The parts of a turntable are pictures.
    let share = arguments.part.filter(|_| arguments.turn.turntable.is_none());
    let still = match (arguments.format, share) {
        (None, None) => still_of(arguments, format_of(&to)?),
        // The ending of a part's name is that of no format.
        _ => still_of(arguments, StillFormat::Png),
    };
    let notes = effects::check(&arguments.picture, effects::Presentation::Still(still))?;
    input::say(&notes);
    check_dos(&arguments.picture, still.format)?;
    let SceneArguments { file, reading } = &arguments.scene;
    if let Some(views) = arguments.turn.turntable {
        return turntable::run(arguments, views, still, &to);
    }
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
    let size = unsized_picture(format);
    let mut request = arguments.picture.request(&studio, look, wants(still), size)?;
    settle_precision(&mut request, format);
    let mut frame = match arguments.part {
        None => studio.draw(&request),
        Some(share) => studio.draw_share(&request, share),
    };
    frame.times[crate::stage::Stage::Objects] = read;
    refuse_over_budget(&frame)?;
    let writing = Instant::now();
    let bytes = match arguments.part {
        None => {
            encoded(&frame, request.palette, request.tone, format, Values::new(still, &arguments.picture))?
        }
        Some(share) => join::part(arguments, studio.scene(), &request, &frame, share)?,
    };
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
        part: None,
        turn: TurntableArguments::default(),
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
    print(&encoded(&frame, request.palette, request.tone, StillFormat::Txt, Values::Toned)?)?;
    say_nothing(&frame);
    Ok(())
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

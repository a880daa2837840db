//! Views round a scene: one recording or picture that moves, or a file for each.
//!
//! What moves is made in memory and written whole at the end. Files are whole each, and stay where Ctrl-C
//! ends the program; the names of all are looked at before the first is drawn.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::frame::{Frame, Request, Studio};
use crate::glyph::Cell;
use crate::math::Grid;
use crate::output::{self, Cast};
use crate::scene::{Camera, FilesRead};
use crate::view::Turntable;

use super::arguments::{PictureArguments, RenderArguments};
use super::effects::Still;
use super::error::{CliError, tell};
use super::formats::StillFormat;
use super::input;
use super::interrupts::Interrupts;
use super::numbered::NumberedName;
use super::progress_line::ProgressLine;
use super::still::{
    Values, encoded, look, refuse_over_budget, say_nothing, settle_precision, unsized_picture, wants,
};
use super::terminal::capabilities;
use super::write::{Destination, SceneFiles};

/// Views a second where none are asked for: smooth enough for a part that turns, and few for a page.
const FPS: f64 = 12.0;

/// Draws so many views round a scene, and writes them.
pub fn run(arguments: &RenderArguments, views: u32, still: Still, to: &Destination) -> Result<(), CliError> {
    let form = Form::of(arguments, still.format, to)?;
    let file = &arguments.scene.file;
    let files = FilesRead::default();
    let scene = input::read_noting(file, &arguments.scene.reading, &files)?;
    to.check_files(&files.all())?;
    if let Form::Files(name) = &form {
        let read = files.all();
        let read = SceneFiles::new(read.iter().map(std::path::PathBuf::as_path));
        (0..views).try_for_each(|view| read.check(&name.path(view)))?;
    }
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let turn = Turn::new(&arguments.picture, still, &studio, views)?;
    let mut progress = Progress::begin();
    let fps = arguments.turn.fps.unwrap_or(FPS);
    match form {
        Form::Files(name) => {
            let (first, step) = arguments.part.map_or((1, 1), |share| (share.number(), share.of()));
            let mine: Vec<u32> = (first - 1..views).step_by(step as usize).collect();
            for (done, &view) in (0..).zip(&mine) {
                progress.say(done, mine.len() as u32);
                let frame = turn.draw(view)?;
                let values = Values::new(still, &arguments.picture);
                let Request { palette, tone, .. } = turn.request;
                let bytes = encoded(&frame, palette, tone, still.format, values)?;
                write(&Destination::File(name.path(view)), &bytes)?;
            }
            Ok(())
        }
        Form::Cast => {
            let mut cast = Cast::new(turn.request.cells());
            for view in 0..views {
                progress.say(view, views);
                cast.show(turn.cells(view)?.as_ref(), f64::from(view) / fps);
            }
            drop(progress);
            write(to, cast.finish(f64::from(views) / fps).as_bytes())
        }
        Form::Svg => {
            let mut screens = Vec::new();
            for view in 0..views {
                progress.say(view, views);
                screens.push(Arc::unwrap_or_clone(turn.cells(view)?));
            }
            drop(progress);
            let mut svg = Vec::new();
            output::animated_svg(&screens, turn.request.palette.ground(), fps, &mut svg)
                .map_err(|e| CliError::Output(format!("the picture could not be encoded: {e}")))?;
            write(to, &svg)
        }
    }
}

/// Writes where a signal does not end it halfway.
fn write(to: &Destination, bytes: &[u8]) -> Result<(), CliError> {
    // A pipe may be read slowly, or not at all: there a signal is what ends it.
    let Destination::File(_) = to else { return to.write(bytes) };
    let interrupts = Interrupts::begin();
    let written = to.write(bytes);
    interrupts.end();
    written
}

/// What takes no longer needs no word.
const PATIENCE: Duration = Duration::from_secs(1);

/// How many views are done.
struct Progress {
    line: ProgressLine,
    begin: Instant,
}

impl Progress {
    fn begin() -> Self {
        Self { line: ProgressLine::new(capabilities().cursor), begin: Instant::now() }
    }

    /// Says that so many are done of all.
    fn say(&mut self, done: u32, of: u32) {
        let spent = self.begin.elapsed();
        if spent >= PATIENCE && done > 0 {
            let left = spent.div_f64(f64::from(done)).mul_f64(f64::from(of.saturating_sub(done)));
            self.line.show(&format!("{done} of {of} views, {} s left", left.as_secs() + 1));
        }
    }
}

/// What the views become.
enum Form {
    /// One recording.
    Cast,
    /// One picture that moves.
    Svg,
    /// A file for each view.
    Files(NumberedName),
}

impl Form {
    fn of(arguments: &RenderArguments, format: StillFormat, to: &Destination) -> Result<Self, CliError> {
        let numbered = match to {
            Destination::File(path) => NumberedName::of(path)?,
            Destination::Standard | Destination::Place => None,
        };
        let form = match (format, numbered) {
            (StillFormat::Cast, None) => Self::Cast,
            (StillFormat::Svg, None) => Self::Svg,
            (StillFormat::Cast, Some(_)) => {
                return Err(CliError::Input(
                    "a cast holds all views: leave the number out of its name".into(),
                ));
            }
            (_, Some(name)) => Self::Files(name),
            (_, None) => {
                return Err(CliError::Input(
                    "each view of --turntable is a file of its own in this format: -o turn-%03d.png tells them \
                     apart by a number; --format cast and svg hold all views in one"
                        .into(),
                ));
            }
        };
        match form {
            Self::Files(_) if arguments.turn.fps.is_some() => {
                tell("--fps has no effect here: pictures in files of their own have no time");
            }
            Self::Cast | Self::Svg if arguments.part.is_some() => {
                return Err(CliError::Input(
                    "the parts of a turntable are whole views: --part goes with files that a number tells apart, \
                     as in -o turn-%03d.png"
                        .into(),
                ));
            }
            _ => {}
        }
        Ok(form)
    }
}

/// A scene on its turntable.
struct Turn<'a> {
    studio: &'a Studio,
    turntable: Turntable,
    /// The first view.
    request: Request,
    views: u32,
}

impl<'a> Turn<'a> {
    fn new(
        picture: &PictureArguments,
        still: Still,
        studio: &'a Studio,
        views: u32,
    ) -> Result<Self, CliError> {
        let size = unsized_picture(still.format);
        let mut request = picture.request(studio, look(picture, still.format, None), wants(still), size)?;
        settle_precision(&mut request, still.format);
        let camera = &picture.camera;
        let up = request.camera.up;
        let turntable = camera.target.map_or_else(|| studio.turntable(up), |point| Turntable::new(point, up));
        if studio.scene().views.is_empty() && camera.eye.is_none() && camera.target.is_none() {
            // What is framed for the first view may not have room for a long part across it.
            let aspect = f64::from(request.dots.width) / f64::from(request.dots.height) * request.dot_aspect;
            let Camera { eye, target, .. } = studio.framed_turning(&turntable, aspect);
            request.camera = Camera { eye, target, ..request.camera };
        }
        Ok(Self { studio, turntable, request, views })
    }

    fn draw(&self, view: u32) -> Result<Frame, CliError> {
        let share = f64::from(view) / f64::from(self.views);
        let camera = self.turntable.camera(&self.request.camera, share);
        camera.check().map_err(|e| CliError::Input(format!("view {view} of the turntable: {e}")))?;
        let frame = self.studio.draw(&Request { camera, ..self.request.clone() });
        refuse_over_budget(&frame)?;
        if view == 0 {
            say_nothing(&frame);
        }
        Ok(frame)
    }

    fn cells(&self, view: u32) -> Result<Arc<Grid<Cell>>, CliError> {
        self.draw(view)?.cells.ok_or_else(|| CliError::Output("the picture has no characters".into()))
    }
}

//! The command line: arguments in, one call each.

mod arguments;
mod bench;
mod changes;
mod describe;
mod desk;
mod diagnostics;
mod diff;
mod effects;
mod error;
mod follow;
mod formats;
mod input;
mod interrupts;
mod join;
mod levels;
mod manual;
mod marked;
mod memory;
mod names;
mod numbered;
mod opened;
mod openscad;
mod parse;
mod picture;
mod plan;
mod progress_line;
mod reload;
mod render;
mod settings_file;
mod snapshot;
mod stats;
mod still;
mod terminal;
mod trade;
mod trade_line;
mod trade_png;
mod trade_report;
mod turntable;
mod up;
mod values;
mod waiting;
mod write;

use std::io::{self, IsTerminal};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use crate::app::{self, Opening, Painter, Settings};
use crate::frame::Studio;
use crate::scene::{MeshFacts, Scene, embedded};
use crate::solid::SelfCrossings;
use crate::stage::Progress;

use arguments::{Arguments, Command, ReadingArguments, SceneArguments, ViewerArguments};
use desk::{DeskFiles, FilesSeen, ViewedScene};
use error::{CliError, tell, visible};
use write::print;

/// The scene that the program shows when it is given none.
const FIRST_SCENE: &str = "hanyang";

/// Runs the command line: exit code 0 for done, 1 where writing or the terminal failed or pictures that are
/// compared differ, 2 for bad input or arguments. Errors go to standard error.
pub fn run() -> ExitCode {
    match parse::parse().and_then(|arguments| arguments.map_or(Ok(()), command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            error.report();
            error.exit_code()
        }
    }
}

fn command(arguments: Arguments) -> Result<(), CliError> {
    match arguments.command {
        None => view(&arguments.viewer),
        Some(Command::Render(render)) => render::run(&render),
        Some(Command::Join(join)) => join::run(&join),
        Some(Command::Bench(bench)) => bench::run(&bench),
        Some(Command::Trade(trade)) => trade::run(&trade),
        Some(Command::Plan(plan)) => plan::run(&plan),
        Some(Command::Describe(describe)) => describe::run(&describe),
        Some(Command::Follow(follow)) => follow::run(&follow),
        Some(Command::Diff(diff)) => diff::run(&diff).map_err(CliError::apart_from_differences),
        Some(Command::Snapshot(snapshot)) => {
            snapshot::run(&snapshot).map_err(CliError::apart_from_differences)
        }
        Some(Command::Check(check)) => check_scene(&check.scene),
        Some(Command::Scenes { name }) => scenes(name.as_deref()),
        Some(Command::Completions { shell }) => manual::completions(shell),
        Some(Command::Man { command }) => manual::page(command.as_deref()),
    }
}

/// The viewer; one still where standard output is no terminal.
fn view(arguments: &ViewerArguments) -> Result<(), CliError> {
    let file = arguments.file.as_deref().unwrap_or(FIRST_SCENE);
    let picture = &arguments.picture;
    if arguments.watch {
        return render::watched_still(file, &arguments.reading, picture);
    }
    let still = || {
        if arguments.fps.is_some() {
            tell("--fps has no effect: a still does not move");
        }
        if arguments.bytes_per_second.is_some() {
            tell("--bytes-per-second has no effect: a still is sent once");
        }
        render::still(file, &arguments.reading, picture)
    };
    let Some(terminal) = terminal::of_output() else { return still() };
    if !terminal.cursor {
        // Behind the still, which fills the screen: what stands before it scrolls away.
        still()?;
        tell(&terminal::why_a_still());
        return Ok(());
    }
    let no_effects = effects::check(picture, effects::Presentation::Viewer)?;
    let palette = picture.palette(Some(terminal));
    let opening = Opening { title: input::title(file), palette, terminal };
    let viewed = if file == "-" && io::stdin().is_terminal() {
        // The scene is typed where the keys come from: first the one, then the other.
        let scene = input::read(file, &of_viewer(arguments))?;
        let (studio, settings) = load(arguments, scene, &opening, &Progress::default())?;
        let studio = Arc::new(studio);
        app::run_shared(&studio, settings)?;
        Some(studio as Arc<dyn Painter>)
    } else {
        open(arguments, file, &opening)?
    };
    if let Some(studio) = viewed {
        input::say(&no_effects);
        input::say(&studio.scene().notes);
    }
    Ok(())
}

/// The viewer shows what it can, and says on the screen what it left out.
fn of_viewer(arguments: &ViewerArguments) -> ReadingArguments {
    ReadingArguments { skip_unsupported: true, ..arguments.reading.clone() }
}

/// The viewer on a scene that is still to be read, and read again as its files change.
fn open(
    arguments: &ViewerArguments,
    file: &str,
    opening: &Opening,
) -> Result<Option<Arc<dyn Painter>>, CliError> {
    let seen = FilesSeen::default();
    let viewed = ViewedScene::new(file, &of_viewer(arguments), seen.clone());
    let reloading = viewed.reloading();
    let (own, known) = (arguments.clone(), opening.clone());
    let read = move |progress: &Progress| {
        // What is wrong with the first scene is told when the screen is given back.
        let scene = viewed.read(Some(progress), false)?;
        load(&own, scene, &known, progress)
    };
    let files = DeskFiles { reading: of_viewer(arguments), seen };
    app::open(opening, read, reloading, Arc::new(files))
}

/// What the viewer shows of a scene, and with what it starts.
fn load(
    arguments: &ViewerArguments,
    scene: Scene,
    opening: &Opening,
    progress: &Progress,
) -> Result<(Studio, Settings), CliError> {
    let studio = input::watched_studio(scene, progress.clone())?;
    let picture = &arguments.picture;
    let view = picture.camera.view_index(studio.scene())?;
    let settings = Settings {
        title: opening.title.clone(),
        view: view.unwrap_or(0),
        camera: picture.moves_camera().then(|| picture.camera(&studio, 1.6)).transpose()?,
        options: picture.options()?,
        frame_time: frame_time(arguments.fps.unwrap_or(FPS)),
        bytes_per_second: arguments.bytes_per_second,
        adaptive_at_rest: picture.says_nothing_of_rays(),
        glyphs: picture.look(Some(opening.terminal)).glyphs,
        palette: opening.palette,
        ground: picture.ground(),
        questions: picture.questions(),
        tone: picture.tone(),
        terminal: opening.terminal,
        slow: picture.preset.is_some(),
        folder: arguments.file.as_deref().map(desk::folder).unwrap_or_default(),
        formats: desk::formats(),
    };
    Ok((studio, settings))
}

/// Pictures a second while the eye moves, where nothing is asked for: as many as the viewer sends through
/// mosh and tmux, and enough to look like motion.
const FPS: f64 = 20.0;

/// The time of a picture where there are so many in a second; none where there are 0.
fn frame_time(fps: f64) -> Option<Duration> {
    (fps > 0.0).then(|| Duration::try_from_secs_f64(1.0 / fps).unwrap_or(Duration::MAX))
}

/// So many parts of a mesh file are described one by one.
const MOST_MESHES: usize = 100;

/// Reads and validates only.
fn check_scene(arguments: &SceneArguments) -> Result<(), CliError> {
    let scene = input::read(&arguments.file, &arguments.reading)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let (scene, count) =
        (studio.scene(), |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" }));
    let mut primitives = 0;
    for object in &scene.objects {
        object.solid.visit(&mut |_| primitives += 1);
    }
    let line = format!(
        "{}: {}, {}, {}, {}, {}\n",
        visible(&arguments.file),
        count(scene.objects.len(), "object"),
        count(primitives, "primitive"),
        count(scene.materials.len(), "material"),
        count(scene.lights.len(), "light"),
        count(scene.views.len(), "view"),
    );
    let mut lines = line;
    for facts in scene.meshes.iter().take(MOST_MESHES) {
        lines += &visible(&format!("{facts}{}", crossings(facts)));
        lines.push('\n');
    }
    if let Some(more) = scene.meshes.len().checked_sub(MOST_MESHES).filter(|&more| more > 0) {
        lines += &format!("and {} more\n", count(more, "part"));
    }
    print(lines.as_bytes())
}

/// Where a mesh crosses itself, in words; none where it does not.
fn crossings(facts: &MeshFacts) -> String {
    let Some(mesh) = &facts.mesh else { return String::new() };
    let SelfCrossings { pairs, first, is_complete } = SelfCrossings::of(mesh);
    let at = first.map(|point| format!(" as at {}", facts.place(point))).unwrap_or_default();
    match (pairs, is_complete) {
        (0, true) => String::new(),
        (0, false) => ", too many triangles near each other to look for crossings of all".to_owned(),
        (1, true) => format!(", crosses itself: 1 pair of triangles{at}"),
        (pairs, true) => format!(", crosses itself: {pairs} pairs of triangles{at}"),
        (pairs, false) => format!(", crosses itself: {pairs} pairs of triangles or more{at}"),
    }
}

/// Lists the embedded scenes, or prints one.
fn scenes(name: Option<&str>) -> Result<(), CliError> {
    let Some(name) = name else {
        let widest = embedded().iter().map(|s| s.name.len()).max().unwrap_or(0);
        let lines: String = embedded().iter().map(|s| format!("{:widest$}  {}\n", s.name, s.title)).collect();
        return print(lines.as_bytes());
    };
    let found = embedded().iter().find(|s| s.name == name);
    let scene = found.ok_or_else(|| {
        let names: Vec<&str> = embedded().iter().map(|s| s.name).collect();
        CliError::Input(format!("there is no embedded scene `{name}`; there are {}", names.join(", ")))
    })?;
    print(scene.text.as_bytes())
}

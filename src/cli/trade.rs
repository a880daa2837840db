//! Time against accuracy: measured, and an answer to act on.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use signal_hook::consts::SIGINT;
use signal_hook::flag;

use crate::frame::Wants;
use crate::scene::FilesRead;
use crate::trade::{EyeDistance, NothingMeasured, Sweep, SweepLimits, SweepStep, TradePlot, Wish, svg};

use super::arguments::{PlotFormat, TradeArguments};
use super::error::{CliError, INTERRUPTED, tell};
use super::picture::Unsized;
use super::progress_line::ProgressLine;
use super::trade_line::CommandLine;
use super::trade_report::{Report, ms, percent};
use super::write::{Destination, print};
use super::{effects, input, trade_png};

/// What is to be told apart where nothing else is asked for, as a share of dots with a wrong level: what 16
/// rays a dot leave wrong on the scenes inside.
const APART: f64 = 0.01;

/// Columns of the progress bar.
const BAR: usize = 24;

/// Measures a scene and prints the front, or the one command line that is asked for.
pub fn run(arguments: &TradeArguments) -> Result<(), CliError> {
    let to = Destination::new(arguments.output.as_deref());
    to.check(&arguments.scene.file)?;
    let format = plot_format(arguments)?;
    input::say(&effects::check(&arguments.picture, effects::Presentation::Cells)?);
    let files = FilesRead::default();
    let scene = input::read_noting(&arguments.scene.file, &arguments.scene.reading, &files)?;
    to.check_files(&files.all())?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    // A size in dots is that of a picture without characters.
    let wants = if arguments.picture.dots.is_some() { Wants::LIGHT } else { Wants::CELLS };
    let request = arguments.picture.request(&studio, arguments.picture.look(None), wants, Unsized::Screen)?;
    let line = CommandLine::new(arguments, &request)?;
    let limits = SweepLimits {
        time: arguments.seconds,
        also: arguments.with.iter().map(|words| line.setting(words)).collect::<Result<_, _>>()?,
        apart: arguments.wrong.map_or(APART, |wrong| wrong.min(APART)),
        rays: arguments.rays,
        eye: EyeDistance::default(),
    };

    let interrupt = interrupt();
    let (mut progress, begin) = (ProgressLine::new(true), Instant::now());
    let mut show = |step| progress.show(&bar(step, begin, arguments.seconds));
    let sweep = Sweep::new(&studio, &request, &limits, &interrupt, &mut show);
    drop(progress);
    let sweep = sweep.map_err(|nothing| match nothing {
        NothingMeasured::Interrupted => CliError::Interrupted(nothing.to_string()),
        NothingMeasured::OutOfTime => CliError::Input(format!(
            "{nothing}: more --seconds, or --seconds 0, which measures these options alone"
        )),
    })?;
    if sweep.interrupted {
        tell("interrupted: this is what there is");
    }

    let wish = Wish { within: arguments.within, error: arguments.wrong };
    if wish != Wish::default() {
        return answer(&sweep, &wish, &line);
    }
    if let Some(format) = format {
        let plot = TradePlot::new(&sweep);
        return to.write(&match format {
            PlotFormat::Svg => svg(&plot).into_bytes(),
            PlotFormat::Png => trade_png::drawn(&plot)?,
        });
    }
    let report = Report { sweep: &sweep, line: &line, limits: &limits };
    // In a file nothing is wrapped.
    let is_terminal = io::stdout().is_terminal();
    let columns = crossterm::terminal::size().ok().filter(|_| is_terminal).map(|(columns, _)| columns);
    print(if arguments.json { report.json() } else { report.text(columns) }.as_bytes())
}

/// Prints one command line, and says what it is worth.
fn answer(sweep: &Sweep, wish: &Wish, line: &CommandLine) -> Result<(), CliError> {
    let known = sweep.reference.error().wrong;
    let Some(place) = wish.recommended(&sweep.all, known) else {
        return Err(CliError::Input(nothing_meets(sweep, line)));
    };
    let one = &sweep.all[place];
    if wish.error.is_some_and(|error| error < known) {
        tell(&format!("the reference itself is known to {}: more time tells less apart", percent(known)));
    }
    tell(&format!("{} a picture, {} of the levels wrong", ms(one.cost()), percent(one.wrong())));
    print(format!("{}\n", line.render(&one.setting)).as_bytes())
}

/// Why there is no answer: what comes nearest.
fn nothing_meets(sweep: &Sweep, line: &CommandLine) -> String {
    let told = |place: usize| {
        let one = &sweep.all[place];
        let options = match line.options(&one.setting) {
            none if none.is_empty() => "without options".to_owned(),
            some => format!("with `{some}`"),
        };
        format!("{} and {} of the levels wrong, {options}", ms(one.cost()), percent(one.wrong()))
    };
    let front = sweep.front();
    let ends = front.first().zip(front.last());
    let ends = ends.map_or(String::new(), |(&fastest, &best)| {
        format!(": the fastest has {}; the most accurate {}", told(fastest), told(best))
    });
    format!("no setting that was measured keeps to that{ends}")
}

/// The form of a plot that is asked for, by `--format` or by the ending of a file.
fn plot_format(arguments: &TradeArguments) -> Result<Option<PlotFormat>, CliError> {
    let named = |path: &Path| {
        let ending = path.extension()?.to_string_lossy().into_owned();
        PlotFormat::from_str(&ending, true).ok()
    };
    match (arguments.format, arguments.output.as_deref()) {
        (Some(format), _) => Ok(Some(format)),
        (None, None) => Ok(None),
        (None, Some(path)) => named(path).map(Some).ok_or_else(|| {
            let path = path.display();
            CliError::Input(format!("{path}: a plot is svg or png: --format says which is meant"))
        }),
    }
}

/// Is set by Ctrl-C; a second one ends the program at once.
fn interrupt() -> Arc<AtomicBool> {
    let interrupt = Arc::new(AtomicBool::new(false));
    // Where the system allows no handler, Ctrl-C ends the program as ever.
    let _ = flag::register_conditional_shutdown(SIGINT, INTERRUPTED.into(), Arc::clone(&interrupt))
        .and_then(|_| flag::register(SIGINT, Arc::clone(&interrupt)));
    interrupt
}

/// How far a sweep of so much time is, that began then.
fn bar(step: SweepStep, begin: Instant, time: Duration) -> String {
    let share = begin.elapsed().as_secs_f64() / time.as_secs_f64().max(f64::MIN_POSITIVE);
    let done = (share.min(1.0) * BAR as f64) as usize;
    let what = match step {
        SweepStep::Reference => "the reference".to_owned(),
        SweepStep::Settings(number) => format!("{number} settings"),
        SweepStep::Round(round) => format!("timing, round {round}"),
    };
    format!("{}{} {what}", "█".repeat(done), "░".repeat(BAR - done))
}

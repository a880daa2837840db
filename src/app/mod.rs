//! The full-screen viewer: keys in, pictures out, the terminal as it was afterwards.
//!
//! The thread that calls [`run`] or [`open`] owns the model and the screen, and waits for things that happen.
//! Others wait for the terminal and for signals, and say what came; one reads the scene ([`open`]), and then
//! one traces the picture that was asked for last; and beside each of these two one says how far it is, every
//! 250 ms while it works. One more waits for changes of the scene's files, and reads it again. Else they wake
//! by the clock only while something is waited for, the rest of a key or the terminal's answer: at rest the
//! program does nothing and sends nothing.

mod actions;
mod around;
#[cfg(test)]
mod attributes;
mod buffer;
mod caption;
mod charset;
mod choices;
mod chord;
mod colors;
mod desk;
mod done;
mod errands;
mod error;
mod events;
mod fence;
mod files;
mod follow_order;
mod following;
mod help;
mod identity;
mod input;
mod keys;
mod lattice_views;
mod layout;
mod loading;
mod mistake;
mod model;
mod motion;
mod office;
mod openings;
mod pace;
mod pacing;
mod painter;
mod refinement;
mod reload_thread;
mod reloading;
mod scan;
mod scanning;
mod screen;
mod settings;
mod shown;
#[cfg(unix)]
mod signals;
mod status;
mod suspend;
mod terminal;
mod theme;
mod tracer;
mod trade_panel;
mod travel;
mod viewer;
mod watch;
mod window;

use std::env;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};

use ratatui::crossterm::style::force_color_output;

use crate::output::Capabilities;
use crate::stage::Progress;

pub use desk::{SaveFailure, SaveFormat, SaveOrder};
pub use error::AppError;
use events::{Event, Inbox};
pub use files::{Files, NoFiles, OpenedScene};
pub(crate) use help::key_list;
use identity::Identity;
pub use loading::Opening;
use loading::{Loading, Waited};
use model::Model;
use office::Office;
use pacing::Pacing;
pub use painter::Painter;
use refinement::Refinement;
pub use reloading::{NextScene, Reloading};
pub use settings::{Questions, Settings};
use terminal::Terminal;
use tracer::Tracer;
use viewer::{Drawing, SessionEnd, Viewer};

/// Shows the scene until the person quits. Standard output has to be a terminal; keys come from standard
/// input, or from the controlling terminal where standard input is something else.
///
/// The terminal is given back on every way out: before this returns, before the message of a panic, and
/// before the process ends by SIGHUP, SIGINT, SIGQUIT or SIGTERM, which is how it ends when it gets one of
/// these.
///
/// A program runs one viewer in its life: a thread keeps reading the terminal afterwards, and another keeps
/// these signals and SIGTSTP. They then end and stop the program as they do by default, even where it has
/// handlers of its own from before; those that it sets afterwards by `sigaction` count.
///
/// # Errors
/// See [`AppError`].
pub fn run(painter: impl Painter + 'static, settings: Settings) -> Result<(), AppError> {
    run_shared(&Arc::new(painter), settings)
}

/// The same with a painter that is asked for something afterwards.
///
/// # Errors
/// See [`AppError`].
pub fn run_shared<P: Painter + 'static>(painter: &Arc<P>, settings: Settings) -> Result<(), AppError> {
    let (sender, events) = mpsc::channel();
    let session = Session::start(settings.terminal, sender, events)?;
    let painter: Arc<dyn Painter> = painter.clone();
    session.show(painter, settings, Reloading::never(), Arc::new(NoFiles)).map(drop)
}

/// The same with a scene that is still to be read, on another thread, while the screen shows how far that is;
/// a short time passes before it shows anything. What `reloading` gives afterwards is shown in its place.
/// Gives the last painter back; nothing where the person quits before the first is there.
///
/// # Errors
/// What reading gives, with the terminal given back; and see [`AppError`].
pub fn open<P: Painter + 'static, E: From<AppError> + Send + 'static>(
    opening: &Opening,
    load: impl FnOnce(&Progress) -> Result<(P, Settings), E> + Send + 'static,
    reloading: Reloading,
    files: Arc<dyn Files>,
) -> Result<Option<Arc<dyn Painter>>, E> {
    let (sender, events) = mpsc::channel();
    let mut loading = Loading::start(load, sender.clone()).map_err(AppError::from)?;
    let (session, loaded) = if let Some(loaded) = loading.done_at_once() {
        let (painter, settings) = loaded?;
        (Session::start(settings.terminal, sender, events)?, Ok((painter, settings)))
    } else {
        let mut session = Session::start(opening.terminal, sender, events)?;
        match loading.wait(opening, &mut session.terminal, &mut session.inbox) {
            Ok(Waited::Loaded(loaded)) => (session, *loaded),
            Ok(Waited::Ended(end)) => {
                (reloading.end)();
                session.end(Ok(end))?;
                return Ok(None);
            }
            Err(error) => {
                (reloading.end)();
                session.end(Err(error))?;
                return Ok(None);
            }
        }
    };
    match loaded {
        Ok((painter, settings)) => {
            let shown = session.show(Arc::new(painter), settings, reloading, files)?;
            Ok(Some(shown))
        }
        Err(error) => {
            session.end(Ok(SessionEnd::Quit))?;
            Err(error)
        }
    }
}

/// The terminal while it is ours, and what happens there.
struct Session {
    terminal: Terminal,
    inbox: Inbox,
    sender: Sender<Event>,
}

impl Session {
    /// Takes the terminal and listens to it.
    fn start(
        capabilities: Capabilities,
        sender: Sender<Event>,
        events: Receiver<Event>,
    ) -> Result<Self, AppError> {
        // The caller has decided about colours, NO_COLOR included; crossterm shall not decide again.
        force_color_output(true);
        let terminal = Terminal::take(capabilities)?;
        #[cfg(unix)]
        signals::listen(sender.clone(), terminal.hold())?;
        events::listen_to_terminal(sender.clone(), terminal.hold().fence())?;
        Ok(Self { terminal, inbox: Inbox::new(events), sender })
    }

    /// Shows the painter's pictures, and those of the ones that follow it, until the end; gives the last.
    fn show(
        mut self,
        painter: Arc<dyn Painter>,
        mut settings: Settings,
        reloading: Reloading,
        files: Arc<dyn Files>,
    ) -> Result<Arc<dyn Painter>, AppError> {
        let tracer = Tracer::start(painter.clone(), self.sender.clone())?;
        let (terminal, inbox) = (&mut self.terminal, &mut self.inbox);
        let pacing = look_ahead(terminal, inbox, &mut settings)?;
        let refinement = Refinement::new(settings.frame_time, settings.adaptive_at_rest);
        let model = Model::new(&*painter, settings, terminal::window());
        let office = Office::new(files, self.sender.clone(), painter, reloading)?;
        let mut viewer = Viewer::new(office, model, Drawing { tracer, refinement }, terminal, inbox, pacing);
        let end = viewer.run();
        let painter = viewer.painter();
        drop(viewer);
        self.end(end)?;
        Ok(painter)
    }

    /// Gives the terminal back.
    fn end(self, end: Result<SessionEnd, AppError>) -> Result<(), AppError> {
        drop(self.terminal);
        match end? {
            SessionEnd::Quit => Ok(()),
            SessionEnd::Signal(signal) => {
                #[cfg(unix)]
                signals::end_by(signal);
                #[cfg(not(unix))]
                std::process::exit(128 + signal);
            }
        }
    }
}

/// Asks who draws the screen, how far away that is, and which colours it has.
fn look_ahead(terminal: &mut Terminal, inbox: &mut Inbox, settings: &mut Settings) -> io::Result<Pacing> {
    let name = env::var("TERM").unwrap_or_default();
    let mut pacing = Pacing::default();
    let mut answers = Vec::new();
    if cfg!(unix) && identity::may_be_asked(&name) {
        let questions = [&settings.questions.text(settings.palette), identity::QUESTION].concat();
        let replies = terminal.ask(&questions, inbox)?;
        pacing.asked(replies.took, replies.unanswered);
        answers = replies.answers;
    }
    settings.take_in(&answers);
    pacing.set_ceiling(settings.bytes_per_second);
    pacing.set_relayed(Identity::of(&answers, &name) == Identity::Relay);
    Ok(pacing)
}

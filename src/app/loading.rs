//! The screen while the scene is read and put together on another thread.

use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::widgets::Widget;

use super::actions::Action;
use super::around::{self, Labels};
use super::events::{Event, Gone, Inbox};
use super::keys;
use super::layout::{self, Around, Layout, Panelling};
use super::suspend::suspend;
use super::terminal::{self, Terminal};
use super::theme::Theme;
use super::viewer::SessionEnd;
use super::watch::Watch;
use super::{AppError, Settings, caption, charset};
use crate::glyph::Palette;
use crate::output::Capabilities;
use crate::stage::{Progress, WorkStep};
use crate::widget::FlowChart;

/// A scene that is there sooner is shown without a word: a screen that stands for less than a tenth of a
/// second is a flash to the eye, and nobody can read it.
const UNSEEN: Duration = Duration::from_millis(100);

/// What is known before the scene is there.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    /// The name of the scene, as the frame shows it (in capitals).
    pub title: String,
    /// Colours of the panels.
    pub palette: Palette,
    /// What the terminal can be told and what it can draw.
    pub terminal: Capabilities,
}

/// A thread that makes a painter.
pub struct Loading<P, E> {
    loaded: Receiver<Result<(P, Settings), E>>,
    progress: Progress,
    watch: Watch,
}

/// What came of waiting.
pub enum Waited<P, E> {
    /// The painter, or why there is none.
    Loaded(Box<Result<(P, Settings), E>>),
    /// The person did not wait.
    Ended(SessionEnd),
}

impl<P: Send + 'static, E: Send + 'static> Loading<P, E> {
    /// Starts the thread. It sends [`Event::Loaded`] when it is done, or that it has panicked.
    pub fn start(
        load: impl FnOnce(&Progress) -> Result<(P, Settings), E> + Send + 'static,
        events: Sender<Event>,
    ) -> io::Result<Self> {
        let progress = Progress::default();
        let watch = Watch::start(progress.clone(), events.clone())?;
        let (sender, loaded) = mpsc::channel();
        let work = {
            let (progress, watch) = (progress.clone(), watch.clone());
            move || {
                // What a panic leaves half done is not looked at: the program ends.
                let result = panic::catch_unwind(AssertUnwindSafe(|| load(&progress)));
                watch.close();
                let event = match result {
                    // Who no longer waits for it has ended.
                    Ok(result) => sender.send(result).map_or(Event::Panicked, |()| Event::Loaded),
                    Err(_) => Event::Panicked,
                };
                let _ = events.send(event);
            }
        };
        thread::Builder::new().name("loader".to_owned()).spawn(work)?;
        Ok(Self { loaded, progress, watch })
    }

    /// What is loaded before anybody would see that it is not.
    pub fn done_at_once(&mut self) -> Option<Result<(P, Settings), E>> {
        self.loaded.recv_timeout(UNSEEN).ok()
    }

    /// Shows how far it is until it is done.
    pub fn wait(
        &mut self,
        opening: &Opening,
        terminal: &mut Terminal,
        inbox: &mut Inbox,
    ) -> Result<Waited<P, E>, AppError> {
        self.watch.begin();
        let mut step = self.progress.now();
        loop {
            let layout = Layout::new(terminal::window().cells, Panelling::WherePossible);
            let mut buffer = Buffer::empty(layout.screen);
            draw(opening, &layout, step, &mut buffer);
            terminal.queue(buffer);
            terminal.send()?;
            match inbox.next(None).map_err(|Gone| AppError::HungUp)? {
                Some(Event::Loaded) => {
                    let loaded = self.loaded.try_recv().map_err(|_| AppError::LoadingPanicked)?;
                    return Ok(Waited::Loaded(Box::new(loaded)));
                }
                Some(Event::Working(now)) => step = now,
                Some(Event::Key(key)) => match keys::action(key) {
                    Some(Action::Quit) => return Ok(Waited::Ended(SessionEnd::Quit)),
                    Some(Action::Suspend) => suspend(terminal)?,
                    _ => {}
                },
                Some(Event::Stopped) => suspend(terminal)?,
                Some(Event::Continued) => terminal.retake()?,
                Some(Event::Terminated(signal)) => return Ok(Waited::Ended(SessionEnd::Signal(signal))),
                Some(Event::HungUp) => return Err(AppError::HungUp),
                Some(Event::Failed(error)) => return Err(error.into()),
                Some(Event::Panicked) => return Err(AppError::LoadingPanicked),
                Some(
                    Event::Resized
                    | Event::Answer(_)
                    | Event::Mouse(_)
                    | Event::Done(_)
                    | Event::Reached(_)
                    | Event::Changed(_)
                    | Event::Drawn(_)
                    | Event::GivenUp,
                )
                | None => {}
            }
        }
    }
}

/// The screen without a picture: the frame, the chart with the stage at work, and how far that is.
fn draw(opening: &Opening, layout: &Layout, step: WorkStep, buffer: &mut Buffer) {
    let theme = Theme::of(opening.palette);
    buffer.set_style(buffer.area, theme.text);
    let labels = Labels { title: &opening.title, ..Labels::default() };
    around::draw(&layout.around, &labels, &theme, buffer);
    if let Around::Panels(panels) = &layout.around {
        let chart = FlowChart::idle().working(Some(step)).styles(theme.text, theme.dim);
        chart.render(layout::inside(panels.chart), buffer);
    }
    buffer.set_style(layout.picture, theme.picture);
    caption::draw(&around::words(step), theme.picture, layout.picture, buffer);
    charset::fit(buffer, layout.screen, opening.terminal);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Task;
    use ratatui::buffer::Cell;
    use ratatui::layout::Size;

    fn seen(width: u16, height: u16, terminal: Capabilities) -> String {
        let layout = Layout::new(Size::new(width, height), Panelling::WherePossible);
        let mut buffer = Buffer::empty(layout.screen);
        let opening = Opening { title: "gears.csg".to_owned(), terminal, ..Opening::default() };
        draw(&opening, &layout, WorkStep { task: Task::Reading, percent: Some(37) }, &mut buffer);
        let rows = buffer.content.chunks(buffer.area.width.into());
        rows.map(|row| row.iter().map(Cell::symbol).collect::<String>() + "\n").collect()
    }

    #[test]
    fn the_stage_at_work_and_how_far_it_is() {
        insta::assert_snapshot!(seen(80, 24, Capabilities::default()));
    }

    #[test]
    fn on_a_small_screen_the_words_alone() {
        insta::assert_snapshot!(seen(20, 5, Capabilities::default()));
        let plain = Capabilities { utf8: false, ..Capabilities::default() };
        assert!(seen(80, 24, plain).is_ascii() && seen(1, 1, plain).is_ascii());
    }

    #[test]
    fn what_is_there_at_once_is_not_waited_for() {
        let (sender, _events) = mpsc::channel();
        let load = |_: &Progress| Ok::<_, ()>((7, Settings::default()));
        let loaded = Loading::start(load, sender).unwrap().done_at_once();
        assert_eq!(loaded.map(|loaded| loaded.map(|(painter, _)| painter)), Some(Ok(7)));
    }

    #[test]
    fn a_panic_is_an_event() {
        let (sender, events) = mpsc::channel();
        let load = |_: &Progress| -> Result<((), Settings), ()> { panic!("the loader fell") };
        let mut loading = Loading::start(load, sender).unwrap();
        assert!(loading.done_at_once().is_none());
        assert!(matches!(events.recv().unwrap(), Event::Panicked));
    }
}

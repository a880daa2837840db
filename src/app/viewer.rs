//! The loop of the viewer: wait for something to happen, change the model, show it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;

use super::events::{Event, Gone, Inbox};
use super::identity::Identity;
use super::model::{Effect, Model, Subject};
use super::pacing::Pacing;
use super::refinement::{Detail, Refinement};
use super::reloading::Reloaded;
use super::screen;
use super::shown::Shown;
use super::suspend::suspend;
use super::terminal::{self, Terminal};
use super::tracer::Tracer;
use super::{AppError, Painter, keys};
use crate::frame::{Frame, Request};
use crate::stage::WorkStep;

/// Model, picture and terminal together.
pub struct Viewer<'a> {
    painter: Arc<dyn Painter>,
    model: Model,
    drawing: Drawing,
    terminal: &'a mut Terminal,
    inbox: &'a mut Inbox,
    pacing: Pacing,
    shown: Option<Shown>,
    /// How far the next picture is, where it takes long.
    working: Option<WorkStep>,
    /// What is told beside the picture that is shown.
    subject: Subject,
    /// What is to be told beside the picture that is being traced; absent while none is.
    next_subject: Option<Subject>,
    /// When something is to be done that waits: for the terminal, or for the eye to rest.
    wakes: Option<Instant>,
}

/// Who draws the pictures, and how finely.
pub struct Drawing {
    pub tracer: Tracer,
    pub refinement: Refinement,
}

/// How the viewer ends when nothing fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SessionEnd {
    /// By a key.
    Quit,
    /// By a signal.
    Signal(i32),
}

impl<'a> Viewer<'a> {
    /// A viewer that has shown nothing yet.
    pub fn new(
        painter: Arc<dyn Painter>,
        model: Model,
        drawing: Drawing,
        terminal: &'a mut Terminal,
        inbox: &'a mut Inbox,
        pacing: Pacing,
    ) -> Self {
        let subject = model.subject();
        Self {
            painter,
            model,
            drawing,
            terminal,
            inbox,
            pacing,
            shown: None,
            working: None,
            subject,
            next_subject: None,
            wakes: None,
        }
    }

    /// Shows the scene until the end. Everything that has already happened is taken in before the screen is
    /// drawn once, so keys never wait behind pictures.
    pub fn run(&mut self) -> Result<SessionEnd, AppError> {
        self.show(None)?;
        loop {
            // By the clock it wakes only while something waits.
            // The threads that listen keep their ends of the channel for as long as there is a terminal.
            let mut next = self.inbox.next(self.wakes).map_err(|Gone| AppError::HungUp)?;
            let mut finished = None;
            while let Some(event) = next {
                match event {
                    Event::Drawn(frame) => {
                        finished = Some(frame);
                        self.working = None;
                    }
                    Event::GivenUp => {
                        self.drawing.refinement.given_up(Instant::now());
                        (self.next_subject, self.working) = (None, None);
                    }
                    Event::Working(step) => self.working = Some(step),
                    event => {
                        if let Some(end) = self.take_in(event)? {
                            return Ok(end);
                        }
                    }
                }
                next = self.inbox.try_next();
            }
            if self.drawing.refinement.is_outdated(self.model.request().as_ref()) {
                self.drawing.tracer.give_up();
            }
            self.show(finished)?;
        }
    }

    /// Whose pictures are shown.
    pub fn painter(&self) -> Arc<dyn Painter> {
        Arc::clone(&self.painter)
    }

    fn take_in(&mut self, event: Event) -> Result<Option<SessionEnd>, AppError> {
        match event {
            Event::Key(key) => match self.model.update(&*self.painter, keys::action(key)) {
                Effect::None => {}
                Effect::Redraw => self.terminal.forget(),
                Effect::Suspend => suspend(self.terminal)?,
                Effect::Quit => return Ok(Some(SessionEnd::Quit)),
            },
            Event::Reached(_) => self.pacing.answered(Instant::now()),
            // An answer that came too late for its question.
            Event::Answer(answer) => {
                if let Some(identity) = Identity::told(answer) {
                    self.pacing.set_relayed(identity == Identity::Relay);
                }
            }
            Event::Resized => self.model.resize(&*self.painter, terminal::window()),
            Event::Changed(Reloaded(Ok(painter))) => {
                self.model.reload(&*painter);
                self.drawing.tracer.change(Arc::clone(&painter));
                self.drawing.refinement.start_anew();
                self.painter = painter;
            }
            Event::Changed(Reloaded(Err(mistake))) => self.model.mistake = Some(mistake),
            Event::Stopped => suspend(self.terminal)?,
            Event::Continued => {
                self.terminal.retake()?;
                self.pacing.forget();
                self.model.resize(&*self.painter, terminal::window());
            }
            Event::Terminated(signal) => return Ok(Some(SessionEnd::Signal(signal))),
            Event::HungUp => return Err(AppError::HungUp),
            Event::Failed(error) => return Err(error.into()),
            Event::Panicked => return Err(AppError::Panicked),
            Event::Drawn(_) | Event::GivenUp | Event::Working(_) | Event::Loaded => {}
        }
        Ok(None)
    }

    /// Sends a finished picture, with what is told beside it, in one write; and, where the terminal has shown
    /// enough of what was sent before, begins the next picture and sends what else has changed.
    fn show(&mut self, finished: Option<Box<Frame>>) -> Result<(), AppError> {
        let now = Instant::now();
        if let Some(frame) = finished {
            // It was begun in time, so it is sent whatever else is on its way.
            self.put(*frame);
            self.send(now)?;
        }
        let open = self.pacing.is_open(now);
        if open {
            self.begin_picture(now);
            self.terminal.queue(self.screen(self.shown.as_ref()));
            if self.send(now)? {
                self.pacing.begin(now);
            }
        }
        let next = self.next_picture().map(|(request, _)| self.drawing.refinement.due(&request));
        let due = next.flatten();
        let is_to_send =
            !open && (next == Some(None) || !self.terminal.shows(&self.screen(self.shown.as_ref())));
        self.wakes = if is_to_send { self.pacing.opens() } else { due.max(due.and(self.pacing.opens())) };
        Ok(())
    }

    /// The picture that is to be begun, and how finely; absent while one is being traced, and where all has
    /// been.
    fn next_picture(&self) -> Option<(Request, Detail)> {
        let request = self.model.request()?;
        let detail = self.drawing.refinement.next(&request)?;
        Some((request, detail))
    }

    fn begin_picture(&mut self, now: Instant) {
        let rests = |request: &Request| self.drawing.refinement.due(request).is_none_or(|due| due <= now);
        if let Some((request, detail)) = self.next_picture().filter(|(request, _)| rests(request)) {
            let order = self.drawing.refinement.begin(&request, detail, now);
            self.drawing.tracer.ask(order);
            self.next_subject = Some(self.model.subject());
            self.pacing.begin(now);
        } else if self.next_subject.is_none() {
            self.subject = self.model.subject();
        }
    }

    /// Puts a picture on the screen: first with the figures of the one before, then, in the same write, its
    /// own.
    fn put(&mut self, frame: Frame) {
        let begun = Instant::now();
        self.subject = self.next_subject.take().unwrap_or_else(|| self.model.subject());
        let before = self.shown.as_ref().map_or((0, Duration::ZERO), |shown| (shown.bytes, shown.display));
        let rays = self.drawing.refinement.finished(&frame);
        let mut shown = Shown { frame, rays, bytes: before.0, display: before.1 };
        shown.bytes = self.terminal.queue(self.screen(Some(&shown)));
        shown.display = begun.elapsed();
        self.terminal.queue(self.screen(Some(&shown)));
        self.shown = Some(shown);
    }

    /// Sends what is queued; gives whether anything was.
    fn send(&mut self, now: Instant) -> Result<bool, AppError> {
        let sent = self.terminal.send()?;
        if sent {
            self.pacing.sent(now);
        }
        Ok(sent)
    }

    fn screen(&self, shown: Option<&Shown>) -> Buffer {
        let mut buffer = Buffer::empty(self.model.layout.screen);
        screen::draw(&self.model.with(self.subject.clone()), shown, self.working, &mut buffer);
        buffer
    }
}

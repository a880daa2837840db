//! The loop of the viewer: wait for something to happen, change the model, show it.

use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;

use super::events::{Event, Gone, Inbox};
use super::input::Answer;
use super::model::{Effect, Model};
use super::screen::{self, Shown};
use super::terminal::{self, Terminal};
use super::tracer::Tracer;
use super::{AppError, Painter, keys, loading};
use crate::frame::Frame;
use crate::stage::Step;

/// Model, picture and terminal together.
pub struct Viewer<'a> {
    pub painter: &'a dyn Painter,
    pub model: Model,
    pub shown: Option<Shown>,
    /// How far the next picture is, where it takes long.
    pub working: Option<Step>,
    pub tracer: Tracer,
    pub terminal: &'a mut Terminal,
    pub inbox: &'a mut Inbox,
}

/// How the viewer ends when nothing fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By a key.
    Quit,
    /// By a signal.
    Signal(i32),
}

impl Viewer<'_> {
    /// Shows the scene until the end. Everything that has already happened is taken in before the screen is
    /// drawn once, so keys never wait behind pictures.
    pub fn run(&mut self) -> Result<End, AppError> {
        self.show(None)?;
        loop {
            // The threads that listen keep their ends of the channel for as long as there is a terminal.
            let mut next = self.inbox.next(None).map_err(|Gone| AppError::HungUp)?;
            let mut finished = None;
            while let Some(event) = next {
                match event {
                    Event::Drawn(frame) => {
                        finished = Some(frame);
                        self.working = None;
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
            self.show(finished)?;
        }
    }

    fn take_in(&mut self, event: Event) -> Result<Option<End>, AppError> {
        match event {
            Event::Key(key) => match self.model.update(self.painter, keys::action(key)) {
                Effect::None => {}
                Effect::Suspend => loading::suspend(self.terminal, self.inbox)?,
                Effect::Quit => return Ok(Some(End::Quit)),
            },
            Event::Answer(Answer::Status) => self.terminal.answered(),
            Event::Resized => self.model.resize(self.painter, terminal::window()),
            Event::Stopped => loading::suspend(self.terminal, self.inbox)?,
            Event::Continued => {
                self.terminal.retake()?;
                self.model.resize(self.painter, terminal::window());
            }
            Event::Terminated(signal) => return Ok(Some(End::Signal(signal))),
            Event::HungUp => return Err(AppError::HungUp),
            Event::Failed(error) => return Err(error.into()),
            Event::Panicked => return Err(AppError::Panicked),
            // An answer that came too late for its question.
            Event::Answer(_) | Event::Drawn(_) | Event::Working(_) | Event::Loaded => {}
        }
        Ok(None)
    }

    /// Asks for the picture of the model, and draws the screen, with a new picture if there is one.
    fn show(&mut self, finished: Option<Box<Frame>>) -> Result<(), AppError> {
        if let Some(request) = self.model.request() {
            self.tracer.ask(request);
        }
        if let Some(frame) = finished {
            let begun = Instant::now();
            // The picture first, with the figures of the one before; then, in the same write, its own.
            let before =
                self.shown.as_ref().map_or((0, Duration::ZERO), |shown| (shown.bytes, shown.display));
            let mut shown = Shown { frame: *frame, bytes: before.0, display: before.1 };
            shown.bytes = self.terminal.queue(self.screen(Some(&shown)))?;
            shown.display = begun.elapsed();
            self.shown = Some(shown);
        }
        self.terminal.queue(self.screen(self.shown.as_ref()))?;
        self.terminal.send()?;
        Ok(())
    }

    fn screen(&self, shown: Option<&Shown>) -> Buffer {
        let mut buffer = Buffer::empty(self.model.layout.screen);
        screen::draw(&self.model, shown, self.working, &mut buffer);
        buffer
    }
}

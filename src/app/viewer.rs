//! The loop of the viewer: wait for something to happen, change the model, show it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;

use super::actions::Action;
use super::desk::{Desk, SaveFailure};
use super::done::Done;
use super::events::{Event, Gone, Inbox};
use super::identity::Identity;
use super::input::Mouse;
use super::model::{Effect, Model, Subject};
use super::office::Office;
use super::pace::Pace;
use super::pacing::Pacing;
use super::refinement::{Detail, Refinement};
use super::reloading::Reloaded;
use super::scan::Scan;
use super::screen;
use super::shown::Shown;
use super::suspend::suspend;
use super::terminal::{self, Terminal};
use super::tracer::Tracer;
use super::trade_panel::TradePanel;
use super::{AppError, Painter};
use crate::frame::{Frame, Request};
use crate::stage::WorkStep;

/// Model, picture and terminal together.
pub struct Viewer<'a> {
    pub(super) office: Office,
    pub(super) model: Model,
    pub(super) drawing: Drawing,
    terminal: &'a mut Terminal,
    inbox: &'a mut Inbox,
    pacing: Pacing,
    pub(super) shown: Option<Shown>,
    /// How far the next picture is, where it takes long.
    working: Option<WorkStep>,
    /// What is told beside the picture that is shown.
    subject: Subject,
    /// What is to be told beside the picture that is being traced; absent while none is.
    next_subject: Option<Subject>,
    /// The picture that is being drawn dot by dot, where Turbo is off.
    pub(super) scan: Option<Scan>,
    /// The pace that it is drawn at.
    pub(super) pace: Pace,
    /// When it is to be shown again.
    pub(super) scan_due: Option<Instant>,
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
        office: Office,
        model: Model,
        drawing: Drawing,
        terminal: &'a mut Terminal,
        inbox: &'a mut Inbox,
        pacing: Pacing,
    ) -> Self {
        let (subject, pace) = (model.subject(), model.pace);
        Self {
            office,
            model,
            drawing,
            terminal,
            inbox,
            pacing,
            shown: None,
            working: None,
            subject,
            next_subject: None,
            scan: None,
            pace,
            scan_due: None,
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
            let trades = self.model.trade.as_ref().and_then(|_| self.model.request());
            self.office.measure_only(trades.as_ref());
            self.drawing.refinement.set_adaptive_at_rest(self.model.settings.adaptive_at_rest);
            if let Some(order) = self.model.follow_order() {
                self.office.follow(order)?;
            }
            self.show(finished)?;
        }
    }

    /// Whose pictures are shown.
    pub fn painter(&self) -> Arc<dyn Painter> {
        Arc::clone(self.office.painter())
    }

    fn take_in(&mut self, event: Event) -> Result<Option<SessionEnd>, AppError> {
        match event {
            Event::Key(key) => {
                let effect = self.model.key(&*self.painter(), key);
                return self.follow_effect(effect);
            }
            Event::Mouse(used) => {
                let effect = match used {
                    Mouse::Click(at) => self.model.click(&*self.painter(), at),
                    Mouse::WheelUp => self.model.wheel(&*self.painter(), Action::ZoomIn),
                    Mouse::WheelDown => self.model.wheel(&*self.painter(), Action::ZoomOut),
                };
                return self.follow_effect(effect);
            }
            Event::Done(done) => self.take_done(done)?,
            Event::Reached(_) => self.pacing.answered(Instant::now()),
            // An answer that came too late for its question.
            Event::Answer(answer) => {
                if let Some(identity) = Identity::told(answer) {
                    self.pacing.set_relayed(identity == Identity::Relay);
                }
            }
            Event::Resized => self.model.resize(&*self.painter(), terminal::window()),
            Event::Changed(Reloaded { of, scene: Ok(painter) }) => {
                if self.office.change(of, &painter) {
                    self.model.reload(&*painter);
                    self.draw_anew();
                }
            }
            Event::Changed(Reloaded { of, scene: Err(mistake) }) => {
                if self.office.is_shown(of) {
                    self.model.mistake = Some(mistake);
                }
            }
            Event::Stopped => suspend(self.terminal)?,
            Event::Continued => {
                self.terminal.retake()?;
                self.pacing.forget();
                self.model.resize(&*self.painter(), terminal::window());
            }
            Event::Terminated(signal) => return Ok(Some(SessionEnd::Signal(signal))),
            Event::HungUp => return Err(AppError::HungUp),
            Event::Failed(error) => return Err(error.into()),
            Event::Panicked => return Err(AppError::Panicked),
            Event::Drawn(_) | Event::GivenUp | Event::Working(_) | Event::Loaded => {}
        }
        Ok(None)
    }

    /// Does what a key asks of the world around the model.
    fn follow_effect(&mut self, effect: Effect) -> Result<Option<SessionEnd>, AppError> {
        match effect {
            Effect::None => {}
            Effect::Redraw => self.terminal.forget(),
            Effect::Suspend => suspend(self.terminal)?,
            Effect::Open(name) => self.office.open(name)?,
            Effect::Measure => {
                if let Some(request) = self.model.request() {
                    let takes = self.shown.as_ref().map_or(Duration::ZERO, |shown| shown.frame.total);
                    self.office.measure(self.drawing.refinement.finest(&request), takes)?;
                }
            }
            Effect::Save(order) => {
                if let Some(request) = self.model.request() {
                    self.office.save(self.drawing.refinement.finest(&request), order)?;
                }
            }
            Effect::Append(path, line) => self.office.append(path, line)?,
            Effect::Quit => return Ok(Some(SessionEnd::Quit)),
        }
        Ok(None)
    }

    /// Takes in what came of an errand. A dialog that was left does not want it any more.
    fn take_done(&mut self, done: Done) -> Result<(), AppError> {
        match (done, &mut self.model.desk) {
            (Done::Opened(number, Ok(scene)), Some(Desk::Open(_))) if self.office.is_awaited(number) => {
                let (title, folder) = (scene.title.clone(), scene.folder.clone());
                self.office.show(scene)?;
                self.model.open(&*self.painter(), title, folder);
                self.draw_anew();
            }
            (Done::Opened(_, Ok(scene)), _) => (scene.reloading.end)(),
            (Done::Opened(number, Err(error)), Some(desk @ Desk::Open(_))) => {
                if self.office.is_awaited(number) {
                    desk.fail(error);
                }
            }
            (Done::Saved(Err(failure)), Some(Desk::Save(dialog))) => dialog.failed(failure),
            (Done::Appended(Err(error)), Some(desk @ Desk::Line(_))) => desk.fail(error),
            (Done::Saved(Ok(told)) | Done::Appended(Ok(told)), desk) => {
                if matches!(desk, Some(Desk::Save(_) | Desk::Line(_))) {
                    *desk = None;
                }
                self.model.told = Some(told);
            }
            (Done::Saved(Err(SaveFailure::Because(error))) | Done::Appended(Err(error)), _) => {
                self.model.told = Some(error);
            }
            // Nobody waits for it any more.
            (Done::Opened(_, Err(_)) | Done::Saved(Err(SaveFailure::Exists)), _) => {}
            (Done::Measuring(step), _) => {
                if let Some(trade @ TradePanel::Measuring(_)) = &mut self.model.trade {
                    *trade = TradePanel::Measuring(Some(step));
                }
            }
            (Done::Measured(figures), _) => {
                let is_wanted = self.office.measured()?;
                if let (Some(trade @ TradePanel::Measuring(_)), true) = (&mut self.model.trade, is_wanted) {
                    *trade = figures.map_or(TradePanel::Nothing, |figures| TradePanel::Measured(*figures));
                }
            }
            (Done::Scanned(followed), _) => {
                let is_shown = self.office.followed();
                if let Some(scan) = self.scan.as_mut().filter(|_| is_shown) {
                    scan.tell(&followed);
                }
            }
            (Done::Followed(followed), _) => {
                if self.office.followed() {
                    self.model.tell(*followed);
                }
            }
        }
        Ok(())
    }

    /// Has the pictures that follow drawn by the painter that there is now.
    fn draw_anew(&mut self) {
        self.drawing.tracer.change(self.painter());
        self.drawing.refinement.start_anew();
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
        self.change_pace(now);
        let open = self.pacing.is_open(now);
        if open {
            self.begin_picture(now);
            self.go_on_scanning(now)?;
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
        if let Some(scan_due) = self.scan_due {
            let scan_due = scan_due.max(self.pacing.opens().unwrap_or(scan_due));
            self.wakes = Some(self.wakes.map_or(scan_due, |wakes| wakes.min(scan_due)));
        }
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
        let round_trip = self.pacing.round_trip();
        let frame = self.scanned(frame, begun);
        let in_hand = self.scan.as_ref().and_then(|scan| scan.in_hand(begun));
        let mut shown = Shown { frame, rays, in_hand, bytes: before.0, display: before.1, round_trip };
        shown.bytes = self.terminal.queue(self.screen(Some(&shown)));
        shown.display = begun.elapsed();
        self.terminal.queue(self.screen(Some(&shown)));
        self.shown = Some(shown);
    }

    /// Sends what is queued; gives whether anything was.
    fn send(&mut self, now: Instant) -> Result<bool, AppError> {
        let bytes = self.terminal.send()?;
        if bytes > 0 {
            self.pacing.sent(now, bytes);
        }
        Ok(bytes > 0)
    }

    fn screen(&self, shown: Option<&Shown>) -> Buffer {
        let mut buffer = Buffer::empty(self.model.layout.screen);
        screen::draw(&self.model.with(self.subject.clone()), shown, self.working, &mut buffer);
        buffer
    }
}

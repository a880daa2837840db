//! Who opens, saves and follows for the viewer, and the scene that came of it.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::time::Duration;

use super::Painter;
use super::desk::{SaveFailure, SaveOrder};
use super::done::Done;
use super::errands;
use super::events::Event;
use super::files::{Files, OpenedScene};
use super::follow_order::{FollowOrder, FollowedDot};
use super::reload_thread;
use super::reloading::Reloading;
use super::trade_panel::TradeFigures;
use crate::frame::Request;
use crate::trade::{EyeDistance, SweepLimits};

/// The time in which the trade is measured at least: nobody waits longer for a plot of a small scene.
const LEAST: Duration = Duration::from_secs(6);

/// The time is that of so many pictures at least: a sweep draws none that takes more than a twentieth of it,
/// and the picture that is shown is to be among them.
const PICTURES: u32 = 40;

/// How far the trade is measured of a picture that takes so long.
fn limits(picture: Duration) -> SweepLimits {
    // What 16 rays a dot leave wrong on the scenes inside is told apart, as by the command.
    SweepLimits {
        time: LEAST.max(picture.saturating_mul(PICTURES)),
        also: Vec::new(),
        apart: 0.01,
        rays: None,
        eye: EyeDistance::default(),
    }
}

/// The scene that is shown, and what goes on beside its pictures.
pub struct Office {
    files: Arc<dyn Files>,
    events: Sender<Event>,
    painter: Arc<dyn Painter>,
    /// Ends the waiting for changes of the scene's files.
    end_reloading: Box<dyn Fn() + Send>,
    /// The number of the scene that is shown, of all that were asked for.
    scene: u64,
    /// The number of the one that was asked for last.
    asked: u64,
    /// Of whose picture a ray is being followed, where one is.
    follows: Option<Arc<dyn Painter>>,
    /// The picture of which the trade is being measured, and what ends that.
    measuring: Option<(Request, Arc<AtomicBool>)>,
    /// The picture that is measured next, and how long it takes.
    next_measured: Option<(Request, Duration)>,
}

impl Office {
    /// With the first scene.
    pub fn new(
        files: Arc<dyn Files>,
        events: Sender<Event>,
        painter: Arc<dyn Painter>,
        reloading: Reloading,
    ) -> io::Result<Self> {
        reload_thread::start(0, reloading.next, events.clone())?;
        let end_reloading = reloading.end;
        Ok(Self {
            files,
            events,
            painter,
            end_reloading,
            scene: 0,
            asked: 0,
            follows: None,
            measuring: None,
            next_measured: None,
        })
    }

    /// Whose pictures are shown.
    pub fn painter(&self) -> &Arc<dyn Painter> {
        &self.painter
    }

    /// Takes a scene that has been read anew; gives whether it is the one that is shown.
    pub fn change(&mut self, of: u64, painter: &Arc<dyn Painter>) -> bool {
        let is_shown = self.is_shown(of);
        if is_shown {
            self.painter = Arc::clone(painter);
        }
        is_shown
    }

    /// Whether the scene of this number is the one that is shown.
    pub const fn is_shown(&self, number: u64) -> bool {
        self.scene == number
    }

    /// Begins to read another scene.
    pub fn open(&mut self, name: String) -> io::Result<()> {
        self.asked += 1;
        let (files, number) = (Arc::clone(&self.files), self.asked);
        errands::begin(self.events.clone(), move || Done::Opened(number, files.open(&name)))
    }

    /// Whether this is the scene that was asked for last.
    pub const fn is_awaited(&self, number: u64) -> bool {
        self.asked == number && self.scene != number
    }

    /// Shows the scene that was asked for last, and no longer waits for changes of the one before.
    pub fn show(&mut self, scene: OpenedScene) -> io::Result<()> {
        (self.end_reloading)();
        self.scene = self.asked;
        self.painter = scene.painter;
        self.end_reloading = scene.reloading.end;
        reload_thread::start(self.scene, scene.reloading.next, self.events.clone())
    }

    /// Begins to save a picture.
    pub fn save(&self, request: Request, order: SaveOrder) -> io::Result<()> {
        let (files, painter) = (Arc::clone(&self.files), Arc::clone(&self.painter));
        errands::begin(self.events.clone(), move || {
            let saved: Result<(), SaveFailure> = files.save(&*painter, &request, &order);
            Done::Saved(saved.map(|()| format!("saved as {}", order.path.display())))
        })
    }

    /// Begins to add a line to a file.
    pub fn append(&self, path: PathBuf, line: String) -> io::Result<()> {
        errands::begin(self.events.clone(), move || Done::Appended(errands::append(&path, &line)))
    }

    /// Begins to follow a ray, where none is being followed: then the last that is wanted will be next.
    pub fn follow(&mut self, order: FollowOrder) -> io::Result<()> {
        self.follow_for(order, Done::Followed)
    }

    /// The same of a dot that is being drawn.
    pub fn scan(&mut self, order: FollowOrder) -> io::Result<()> {
        self.follow_for(order, Done::Scanned)
    }

    fn follow_for(
        &mut self,
        order: FollowOrder,
        told: impl FnOnce(Box<FollowedDot>) -> Done + Send + 'static,
    ) -> io::Result<()> {
        if self.follows.is_some() {
            return Ok(());
        }
        let painter = Arc::clone(&self.painter);
        self.follows = Some(Arc::clone(&painter));
        errands::begin(self.events.clone(), move || told(Box::new(order.follow(&*painter))))
    }

    /// Begins to measure the trade of a picture that takes so long; where another's is being measured, as
    /// soon as that has been given up.
    pub fn measure(&mut self, request: Request, takes: Duration) -> io::Result<()> {
        if let Some((_, interrupt)) = &self.measuring {
            interrupt.store(true, Ordering::Relaxed);
            self.next_measured = Some((request, takes));
            return Ok(());
        }
        let interrupt = Arc::new(AtomicBool::new(false));
        self.measuring = Some((request.clone(), Arc::clone(&interrupt)));
        let (painter, events) = (Arc::clone(&self.painter), self.events.clone());
        errands::begin(self.events.clone(), move || {
            // Who no longer waits for it has ended, and interrupts it.
            let mut watch = |step| drop(events.send(Event::Done(Done::Measuring(step))));
            let sweep = painter.trade(&request, &limits(takes), &interrupt, &mut watch);
            Done::Measured(sweep.map(|sweep| Box::new(TradeFigures::new(&sweep))))
        })
    }

    /// Gives up measuring what is not the picture that is wanted: its view or its size is another, or none
    /// is.
    pub fn measure_only(&self, wanted: Option<&Request>) {
        let Some((request, interrupt)) = &self.measuring else { return };
        let is_wanted =
            wanted.is_some_and(|wanted| wanted.camera == request.camera && wanted.dots == request.dots);
        if !is_wanted {
            interrupt.store(true, Ordering::Relaxed);
        }
    }

    /// The trade was measured; gives whether it is the one that was asked for last. If not, that is begun.
    pub fn measured(&mut self) -> io::Result<bool> {
        self.measuring = None;
        match self.next_measured.take() {
            Some((request, takes)) => self.measure(request, takes).map(|()| false),
            None => Ok(true),
        }
    }

    /// A ray was followed; gives whether it is one of the scene that is shown.
    pub fn followed(&mut self) -> bool {
        self.follows.take().is_some_and(|painter| Arc::ptr_eq(&painter, &self.painter))
    }
}

impl Drop for Office {
    fn drop(&mut self) {
        self.measure_only(None);
        (self.end_reloading)();
    }
}

//! Settings, chosen and measured, within a limit of time.
//!
//! First each knob alone is turned from where the request has it; then, between each two neighbours on the
//! front, what lies between them: knobs of both together, and numbers in the middle. The settings are timed
//! in turn, round after round, so that whatever drifts, the clock of the processor or other programs, meets
//! all alike.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use thiserror::Error;

use crate::frame::{Frame, Request, Studio, Wants};
use crate::lattice::OverBudget;
use crate::math::Size;
use crate::plan::EngineChoice;
use crate::stage::GiveUp;
use crate::view::TILE;

use super::eye_filter::EyeDistance;
use super::front::front;
use super::measurement::{ComparedPictures, Measurement};
use super::reference::{Reference, ReferenceGoal};
use super::setting::Setting;

/// The reference has this part of the time at most.
const FOR_REFERENCE: f64 = 0.4;

/// New settings are looked for during this part of the time; the rest is for timing them again.
const FOR_SEARCH: f64 = 0.8;

/// No setting whose picture is expected to take more than this part of the whole time is drawn.
const FOR_ONE: f64 = 0.05;

/// A setting that is measured is drawn so often at first: to be compared, from a view that is turned a
/// little, without what is meant, and to be timed.
const PICTURES_OF_ONE: f64 = 4.0;

/// A setting is first drawn this much narrower and lower, to see what it may take.
const SMALLER: u32 = 8;

/// So many settings are measured at most: each is to have several pictures, and a person is to read them.
const MOST_SETTINGS: usize = 48;

/// So many pictures of each are timed, then those of more than their share of the time are passed over.
const LEAST_PICTURES: usize = 3;

/// More say nothing new.
const MOST_PICTURES: usize = 99;

/// How far a sweep goes.
#[derive(Clone, Debug)]
pub struct SweepLimits {
    /// The time for all of it. Without any, only the request's own setting is measured, and those of `also`,
    /// however long that takes.
    pub time: Duration,
    /// Settings that are measured in any case.
    pub also: Vec<Setting>,
    /// The difference between two settings that is to be told, as a share of dots with a wrong level, above
    /// 0 to 1.
    pub apart: f64,
    /// Rays a dot of the reference, where that is not to depend on the time.
    pub rays: Option<u32>,
    /// From how far the screen is seen.
    pub eye: EyeDistance,
}

/// Where a sweep is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SweepStep {
    /// The reference is traced.
    Reference,
    /// Settings are measured for the first time: so many until now.
    Settings(usize),
    /// They are timed again: the round.
    Round(usize),
}

/// A setting that was not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassedOver {
    /// It.
    pub setting: Setting,
    /// Why not.
    pub why: WhyPassedOver,
}

/// Why a setting is not measured.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum WhyPassedOver {
    /// Its picture is expected to take too much of the time.
    #[error("a picture would take about {:.1} s", .0.as_secs_f64())]
    Slow(Duration),
    /// Its pictures took longer than expected, or the time was over.
    #[error("its pictures were given up after {:.1} s", .0.as_secs_f64())]
    GivenUp(Duration),
    /// Its lattice would be too large.
    #[error("{0}")]
    OverBudget(OverBudget),
}

/// Why a sweep has nothing to tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NothingMeasured {
    /// It was interrupted before anything was measured.
    #[error("interrupted before anything was measured")]
    Interrupted,
    /// The time was over before.
    #[error("the time was over before there was a reference and a picture to compare with it")]
    OutOfTime,
}

/// What was measured.
#[derive(Debug)]
pub struct Sweep {
    /// What everything was compared with.
    pub reference: Reference,
    /// All settings, the request's own first. Each has been timed once at least.
    pub all: Vec<Measurement>,
    /// Settings that were not measured.
    pub passed_over: Vec<PassedOver>,
    /// Whether it was interrupted.
    pub interrupted: bool,
}

impl Sweep {
    /// Measures the trade of time for accuracy of a picture. `watch` learns of each step. An interrupt, and
    /// the end of the time, give up what is being drawn, and it ends with what there is. Where `rays` says
    /// how many the reference has, and where there is no time at all, the reference and what is measured in
    /// any case take as long as they take.
    ///
    /// # Errors
    /// Where that ends before there is a reference and the request's own picture.
    pub fn new(
        studio: &Studio,
        base: &Request,
        limits: &SweepLimits,
        interrupt: &AtomicBool,
        watch: &mut dyn FnMut(SweepStep),
    ) -> Result<Self, NothingMeasured> {
        let run = Run { studio, base, limits, interrupt, begin: Instant::now() };
        let own = Setting::of(base);
        let is_over = || run.is_interrupted() || (run.is_limited() && run.is_over(1.0));
        let over = GiveUp::when(&is_over);
        let nothing = || {
            if run.is_interrupted() { NothingMeasured::Interrupted } else { NothingMeasured::OutOfTime }
        };
        // First of all, so that there is something to tell while the reference takes its time.
        let pictures = ComparedPictures::draw(studio, base, own, &over).ok_or_else(nothing)?;
        let first = studio.draw_anew_unless(base, &over).ok_or_else(nothing)?;
        watch(SweepStep::Reference);
        let goal = ReferenceGoal {
            apart: limits.apart,
            rays: limits.rays,
            until: run.begin + limits.time.mul_f64(FOR_REFERENCE),
        };
        let reference = Reference::new(studio, base, &goal, limits.eye, &over).ok_or_else(nothing)?;
        let measured = Measurement::new(studio, &reference, &pictures, None, &GiveUp::never());
        let mut measured = measured.ok_or_else(nothing)?;
        drop(pictures);
        measured.times.push(first.total);
        let mut sweep = Self { reference, all: vec![measured], passed_over: Vec::new(), interrupted: false };
        watch(SweepStep::Settings(1));
        for setting in limits.also.iter().filter(|setting| **setting != own) {
            run.warm(setting);
            sweep.measure(&run, *setting, &over);
        }
        if limits.time > Duration::ZERO {
            sweep.take(&run, own.alone(base), watch);
            sweep.refine(&run, watch);
        }
        sweep.repeat(&run, watch);
        sweep.interrupted = run.is_interrupted();
        Ok(sweep)
    }

    /// The settings that no other beats, by their places and from the fastest.
    pub fn front(&self) -> Vec<usize> {
        front(&self.all, self.reference.error().wrong)
    }

    /// Measures those settings that are new, as long as there is time.
    fn take(&mut self, run: &Run, settings: Vec<Setting>, watch: &mut dyn FnMut(SweepStep)) -> usize {
        let before = self.all.len();
        for setting in settings {
            if run.is_over(FOR_SEARCH) || self.all.len() >= MOST_SETTINGS {
                break;
            }
            let is_known = self.all.iter().any(|one| one.setting == setting)
                || self.passed_over.iter().any(|one| one.setting == setting);
            if is_known {
                continue;
            }
            if let Err(why) = run.check(&setting) {
                self.passed_over.extend(why.map(|why| PassedOver { setting, why }));
                continue;
            }
            let (begin, most) = (Instant::now(), run.limits.time.mul_f64(FOR_ONE * PICTURES_OF_ONE));
            let is_slow = || run.is_over(1.0) || begin.elapsed() > most;
            self.measure(run, setting, &GiveUp::when(&is_slow));
            watch(SweepStep::Settings(self.all.len()));
        }
        self.all.len() - before
    }

    /// Looks between the neighbours on the front until nothing new is found. What is on it is known by
    /// several pictures of each.
    fn refine(&mut self, run: &Run, watch: &mut dyn FnMut(SweepStep)) {
        loop {
            for pictures in 2..=LEAST_PICTURES {
                self.round(run, FOR_SEARCH, |one| one.times.all().len() < pictures);
            }
            let front = self.front();
            let pairs = front.windows(2).map(|pair| [pair[0], pair[1]].map(|place| self.all[place].setting));
            let between: Vec<Setting> = pairs.flat_map(|[one, next]| one.between(&next)).collect();
            if self.take(run, between, watch) == 0 {
                return;
            }
        }
    }

    /// Measures a setting; where that is given up, says so, but for an interrupt.
    fn measure(&mut self, run: &Run, setting: Setting, give_up: &GiveUp) {
        let begin = Instant::now();
        let pictures = ComparedPictures::draw(run.studio, run.base, setting, give_up);
        let measured = pictures.and_then(|pictures| {
            let own = self.all.first();
            let mut one = Measurement::new(run.studio, &self.reference, &pictures, own, give_up)?;
            one.time(run.studio, run.base, give_up).then_some(one)
        });
        match measured {
            Some(one) => self.all.push(one),
            None if run.is_interrupted() => {}
            None => {
                let why = WhyPassedOver::GivenUp(begin.elapsed());
                self.passed_over.push(PassedOver { setting, why });
            }
        }
    }

    /// Times all settings in turn until the time is over: each thrice at least, if it allows, then those that
    /// have had no more of it than their share.
    fn repeat(&mut self, run: &Run, watch: &mut dyn FnMut(SweepStep)) {
        // Of one setting alone there is a spread all the same.
        if run.limits.time.is_zero() {
            for _ in 1..LEAST_PICTURES {
                self.round(run, f64::INFINITY, |_| true);
            }
            return;
        }
        for number in 1..MOST_PICTURES {
            watch(SweepStep::Round(number));
            let spent = self.all.iter().map(|one| one.times.sum()).sum::<Duration>();
            let share = spent / self.all.len().max(1) as u32;
            self.round(run, 1.0, |one| one.times.all().len() < LEAST_PICTURES || one.times.sum() <= share);
            if run.is_over(1.0) {
                return;
            }
        }
    }

    /// Times each of the settings that `is_due` once more, until so much of the time is over.
    fn round(&mut self, run: &Run, part: f64, is_due: impl Fn(&Measurement) -> bool) {
        let mut threads = None;
        for one in self.all.iter_mut().filter(|one| is_due(one)) {
            if run.is_over(part) {
                return;
            }
            if threads.replace(one.setting.options.threads) != Some(one.setting.options.threads) {
                run.warm(&one.setting);
            }
            // One more time of many is not missed.
            let is_over = || run.is_interrupted() || (part.is_finite() && run.is_over(1.0));
            one.time(run.studio, run.base, &GiveUp::when(&is_over));
        }
    }
}

/// What stays the same during a sweep.
struct Run<'a> {
    studio: &'a Studio,
    base: &'a Request,
    limits: &'a SweepLimits,
    interrupt: &'a AtomicBool,
    begin: Instant,
}

impl Run<'_> {
    fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    /// Whether this part of the time is over, or it was interrupted.
    fn is_over(&self, part: f64) -> bool {
        self.is_interrupted() || self.begin.elapsed().as_secs_f64() >= self.limits.time.as_secs_f64() * part
    }

    /// Whether the time is a limit for what is measured in any case.
    fn is_limited(&self) -> bool {
        self.limits.time > Duration::ZERO && self.limits.rays.is_none()
    }

    /// Whether a setting can be measured: what it needs is built, and a smaller picture drawn to see what the
    /// whole will take. No reason is given where it is too late to find out.
    fn check(&self, setting: &Setting) -> Result<(), Option<WhyPassedOver>> {
        if let Some(over) = self.warm(setting).over_budget {
            return Err(Some(WhyPassedOver::OverBudget(over)));
        }
        let mut request = setting.request(self.base);
        let all = request.dots.area();
        // The fast engine takes about as long for a part of a tile as for all of it.
        let fast = request.options.traced_by() == EngineChoice::Fast;
        let smaller = |dots: u32| {
            let few = dots.div_ceil(SMALLER);
            if fast { few.next_multiple_of(TILE).min(dots) } else { few }
        };
        request.dots = Size::new(smaller(request.dots.width), smaller(request.dots.height));
        request.wants = Wants::LIGHT;
        let (begin, most) = (Instant::now(), self.limits.time.mul_f64(FOR_ONE));
        let is_slow = || self.is_over(1.0) || begin.elapsed() > most;
        let parts = all as f64 / request.dots.area() as f64;
        match self.studio.draw_anew_unless(&request, &GiveUp::when(&is_slow)) {
            Some(small) if small.total.mul_f64(parts) <= most => Ok(()),
            Some(small) => Err(Some(WhyPassedOver::Slow(small.total.mul_f64(parts)))),
            None if self.is_over(1.0) => Err(None),
            // It would have taken longer.
            None => Err(Some(WhyPassedOver::Slow(begin.elapsed().mul_f64(parts)))),
        }
    }

    /// Draws a dot, so that threads and structure are there.
    fn warm(&self, setting: &Setting) -> Frame {
        let request = setting.request(self.base);
        let wants = Wants::LIGHT;
        self.studio.draw_anew(&Request { dots: Size::new(1, 1), wants, ..request })
    }
}

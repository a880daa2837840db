//! What a picture ought to be: many rays a dot by the exact engine, with an error that is known.

use std::time::{Duration, Instant};

use crate::frame::{Frame, Request, Studio, Wants};
use crate::math::Grid;
use crate::plan::{CUTOFF, EngineChoice, Options, PrecisionChoice, StructureChoice};
use crate::scene::Camera;
use crate::stage::GiveUp;
use crate::tone::Level;
use crate::view::{Picture, PinholeCamera};

use super::eye_filter::EyeDistance;
use super::layers::{Accuracy, GeometryError, LightError};
use super::levels::LevelDifference;
use super::many_rays::{CHECKED_RAYS, ManyRays, MeanLight};
use super::measures::{angle, resized, rms, shown, steps_apart, ulps};
use super::seen_screen::SeenScreen;

/// The reference's own error is to be this part of what is to be told apart.
const FINER: f64 = 0.1;

/// No dot gets more rays: of an edge that halves it, a thousandth of the contrast is then off at most, a
/// hundredth of a level.
const MOST_RAYS: u32 = 1024;

/// Generations of mirror and Snell rays: as many as the command line allows.
const GENERATIONS: u32 = 64;

/// The cut-off, as a part of the default one, which is half of what makes a level at least. As the weights
/// of a dot's rays never sum to more than 1, it bounds how many there are as well.
const CUTOFF_PART: f64 = 0.1;

/// Rays a dot that the reference's own shimmer is taken from: an edge is then in its place to a sixteenth of
/// a dot, and what flickers is that.
const SHIMMER_RAYS: u32 = 16;

/// So long the rays for the shimmer may take when all else is given up: less than a person waits for.
const AFTER_ALL: Duration = Duration::from_millis(200);

/// How far the view turns for the shimmer, in dots across and down.
const TURN: f64 = 0.1;

/// How far a reference is refined.
#[derive(Clone, Copy, Debug)]
pub struct ReferenceGoal {
    /// The difference between two pictures that is to be told, as a share of dots with a wrong level, above
    /// 0.
    pub apart: f64,
    /// So many rays a dot, rounded up to a power of two of 2 or more, however long that takes; else as many
    /// as `apart` requires.
    pub rays: Option<u32>,
    /// No rays are added that are expected to take longer than that, and those that do all the same by half
    /// as long again are given up; the first 2 a dot are drawn all the same.
    pub until: Instant,
}

/// How far the light of a reference is from the truth at most, as its two halves tell: were they independent,
/// their mean would be off by half of what they differ. The points of the sampling sequence are spread so
/// that each half fills the gaps of the other, and the mean of both is nearer to the truth than that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceError {
    /// The share of dots whose level is wrong, above 0 to 1.
    ///
    /// Where the halves lie d levels apart, their mean is off by d / 2 in the mean, and its level is then
    /// wrong with a probability of d / 2, up to 1. Where d is below 1, the halves have two levels with a
    /// probability of d; so that each dot whose halves have two counts as a half of one, and from d = 1 on as
    /// d / 2, and from d = 2 on as one. Since it is chance which dots lie at a border between levels, two
    /// standard deviations of the sum are added: twice the root of the sum of squares.
    pub wrong: f64,
    /// The root of the mean square, in twelfths of white's CIE L*.
    pub rms: f64,
}

impl ReferenceError {
    fn of(halves: [&MeanLight; 2], base: &Request) -> Self {
        let [a, b] = halves.map(|half| half.light.map(|light| shown(base.tone, *light)));
        let [mut sum, mut squares] = [0.0; 2];
        for (a, b) in a.values().iter().zip(b.values()) {
            if Level::nearest(*a) != Level::nearest(*b) {
                let apart = (Level::position(*a) - Level::position(*b)).abs();
                let probability = (apart / 2.0).clamp(LEAST_WRONG, 1.0);
                sum += probability;
                squares += probability * probability;
            }
        }
        // Where no dot differs, one of twice as many might have.
        let at_most = sum + 2.0 * squares.max(LEAST_WRONG * LEAST_WRONG).sqrt();
        Self {
            wrong: (at_most / a.size().area().max(1) as f64).min(1.0),
            rms: rms(a.values(), b.values(), steps_apart) / 2.0,
        }
    }
}

/// How probably the level of a dot is wrong at least whose halves have two levels.
const LEAST_WRONG: f64 = 0.5;

/// What a picture ought to be.
#[derive(Debug)]
pub struct Reference {
    base: Request,
    /// What rays through the middles of dots meet, by the exact engine.
    geometry: Frame,
    /// The light of dots that the tone shows, 0 to 1.
    light: Grid<f64>,
    levels: Grid<Level>,
    screen: Option<SeenScreen>,
    rays: u32,
    exact_rays: u32,
    error: ReferenceError,
    reached: bool,
}

impl Reference {
    /// Traces what the picture of `base` ought to be: with its shading model and its shadows, mirror and
    /// Snell rays followed ten times as far as by default, and rays a dot until `goal` is reached. Where it
    /// is given up, it has the rays that it had until then; `None` before there are 2 a dot.
    pub fn new(
        studio: &Studio,
        base: &Request,
        goal: &ReferenceGoal,
        eye: EyeDistance,
        give_up: &GiveUp,
    ) -> Option<Self> {
        let exact = Request { options: exact(&base.options), wants: Wants::LIGHT, ..base.clone() };
        let geometry = Request { wants: Wants { cells: false, ..Wants::ALL }, ..exact.clone() };
        let geometry = studio.draw_anew_unless(&geometry, give_up)?;
        let begin = Instant::now();
        let mut rays = ManyRays::new(studio, exact.clone());
        let [mut first, mut second] = [rays.mean(0..1, give_up)?, rays.mean(1..2, give_up)?];
        let mut number = 2;
        let mut early = first.with(&second);
        let late = goal.until + goal.until.saturating_duration_since(begin) / 2;
        let too_late = || give_up.is_due() || (goal.rays.is_none() && Instant::now() > late);
        let (error, reached) = loop {
            let error = ReferenceError::of([&first, &second], base);
            let reached = error.wrong <= FINER * goal.apart;
            let enough = if let Some(asked) = goal.rays {
                number >= asked
            } else {
                // As many again, and those of the turned view, take as long for each as those until now.
                let shimmer = (2 * number).min(SHIMMER_RAYS);
                let expected = begin.elapsed().mul_f64(f64::from(number + shimmer) / f64::from(number));
                reached || number >= MOST_RAYS || Instant::now() + expected > goal.until
            };
            if enough {
                break (error, reached);
            }
            let half = first.with(&second);
            let Some(more) = rays.mean(number..2 * number, &GiveUp::when(&too_late)) else {
                break (error, reached);
            };
            (first, second) = (half, more);
            number *= 2;
            if number <= SHIMMER_RAYS {
                early = first.with(&second);
            }
        };
        let exact_rays = if rays.agrees() { number.min(CHECKED_RAYS) } else { number };
        let mean = first.with(&second);
        let light = mean.light.map(|light| shown(base.tone, *light));
        let mut moved = rays.of(Request { camera: turned(base), ..exact });
        let begin = Instant::now();
        let patience = || give_up.is_due() && begin.elapsed() > AFTER_ALL;
        let turned = moved.mean(0..number.min(SHIMMER_RAYS), &GiveUp::when(&patience));
        let turned = turned.as_ref().map(|turned| [&early, turned]);
        let screen = SeenScreen::new(base, eye, &mean, turned);
        let levels = light.map(|light| Level::nearest(*light));
        let base = base.clone();
        Some(Self { base, geometry, light, levels, screen, rays: number, exact_rays, error, reached })
    }

    /// The request whose picture it is.
    pub const fn base(&self) -> &Request {
        &self.base
    }

    /// Rays a dot, a power of two.
    pub const fn rays(&self) -> u32 {
        self.rays
    }

    /// Rays a dot that the exact engine traced. Where the fast one in double precision found the same bits in
    /// all of the first four, it traced the rest.
    pub const fn exact_rays(&self) -> u32 {
        self.exact_rays
    }

    /// How far it may be from the truth itself.
    pub const fn error(&self) -> ReferenceError {
        self.error
    }

    /// Whether that is a tenth of what is to be told apart, or less.
    pub const fn reached(&self) -> bool {
        self.reached
    }

    /// How much of its own characters flickers, in twelfths of white's CIE L*; absent of a picture without
    /// characters, and where that was given up.
    pub fn shimmer(&self) -> Option<f64> {
        self.screen.as_ref().and_then(SeenScreen::shimmer)
    }

    /// What an eye sees of its own characters that is not the light that they stand for, in the same unit.
    pub fn shown(&self) -> Option<f64> {
        self.screen.as_ref().map(SeenScreen::shown)
    }

    /// The light of each dot that the tone shows, 0 to 1.
    pub const fn light(&self) -> &Grid<f64> {
        &self.light
    }

    /// The level of each dot.
    pub const fn levels(&self) -> &Grid<Level> {
        &self.levels
    }

    /// The request of another setting with its view turned by a tenth of a dot across and down.
    pub fn turned(&self, request: &Request) -> Request {
        turned_of(&self.base, request)
    }

    /// How far the picture of a request is from it. `moved` is the picture of the turned request.
    pub fn accuracy(&self, request: &Request, frame: &Frame, moved: Option<&Frame>) -> Accuracy {
        let own = resized(&frame.light, self.light.size()).map(|light| shown(self.base.tone, *light));
        let cells = |frame: &Frame| frame.cells.clone();
        Accuracy {
            geometry: self.geometry_error(frame),
            light: self.light_error(&own),
            characters: self
                .screen
                .as_ref()
                .zip(frame.cells.as_deref())
                .map(|(screen, own)| screen.error(own, moved.and_then(cells).as_deref(), request.palette)),
        }
    }

    fn geometry_error(&self, frame: &Frame) -> Option<GeometryError> {
        if frame.light.size() != self.light.size() {
            return None;
        }
        let (own, other) = (frame, &self.geometry);
        let objects = [own.object.as_ref()?.values(), other.object.as_ref()?.values()];
        let depths = [own.depth.as_ref()?.values(), other.depth.as_ref()?.values()];
        let normals = [own.normal.as_ref()?.values(), other.normal.as_ref()?.values()];
        let mut error = GeometryError { dots: objects[0].len(), others: 0, depth_ulps: 0, normal: 0.0 };
        for dot in 0..error.dots {
            if objects[0][dot] == objects[1][dot] {
                error.depth_ulps = error.depth_ulps.max(ulps(depths[0][dot], depths[1][dot]));
                error.normal = error.normal.max(angle(normals[0][dot], normals[1][dot]));
            } else {
                error.others += 1;
            }
        }
        Some(error)
    }

    fn light_error(&self, own: &Grid<f64>) -> LightError {
        let pairs = own.values().iter().zip(self.light.values());
        let levels = own.map(|light| Level::nearest(*light));
        LightError {
            rms: rms(own.values(), self.light.values(), steps_apart),
            largest: pairs.map(|(own, other)| steps_apart(*own, *other)).fold(0.0, f64::max),
            levels: LevelDifference::of(levels.values(), self.levels.values()),
        }
    }
}

/// A request of the view of `base`, with that turned by a tenth of a dot of `base` across and down.
pub(super) fn turned_of(base: &Request, request: &Request) -> Request {
    Request { camera: turned(base), ..request.clone() }
}

/// The same picture, with nothing spared that does not change on purpose what is shown.
fn exact(options: &Options) -> Options {
    Options {
        depth: if options.depth == 0 { 0 } else { GENERATIONS },
        cutoff: options.cutoff.min(CUTOFF_PART * CUTOFF),
        structure: StructureChoice::Auto,
        engine: EngineChoice::Exact,
        precision: PrecisionChoice::Double,
        samples: 1,
        adaptive: None,
        ..*options
    }
}

/// The camera of a request, turned about its eye until the target is a tenth of a dot farther left and
/// farther up in the picture than it was.
fn turned(request: &Request) -> Camera {
    let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
    let pinhole = PinholeCamera::new(&request.camera, &picture);
    let [across, down] = pinhole.tangents;
    let dot = |tangent: f64, dots: u32| 2.0 * tangent / f64::from(dots) * pinhole.focus;
    let step = pinhole.right * dot(across, request.dots.width) - pinhole.up * dot(down, request.dots.height);
    Camera { target: request.camera.target + TURN * step, ..request.camera.clone() }
}

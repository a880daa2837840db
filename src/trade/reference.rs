//! What a picture ought to be: many rays a dot by the exact engine, with an error that is known.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::frame::{Frame, Request, Studio, Wants};
use crate::math::Grid;
use crate::plan::{CUTOFF, EngineChoice, Options, PrecisionChoice, StructureChoice};
use crate::scene::Camera;
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
    /// No rays are added that are expected to take longer than that; the first 2 a dot are drawn all the
    /// same.
    pub until: Instant,
}

/// How far the light of a reference is from the truth at most, as its two halves tell: were they independent,
/// their mean would be off by half of what they differ. The points of the sampling sequence are spread so
/// that each half fills the gaps of the other, and the mean of both is nearer to the truth than that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceError {
    /// The share of dots whose level is wrong, above 0 to 1: half of those that differ from half to half, and
    /// of these, since it is chance which dots lie at a border between levels, two standard deviations more
    /// than there are, which is twice the root of their number.
    pub wrong: f64,
    /// The root of the mean square, in twelfths of white's CIE L*.
    pub rms: f64,
}

impl ReferenceError {
    fn of(halves: [&MeanLight; 2], base: &Request) -> Self {
        let [a, b] = halves.map(|half| half.light.map(|light| shown(base.tone, *light)));
        let differ = |(a, b): &(&f64, &f64)| Level::nearest(**a) != Level::nearest(**b);
        // Where no dot differs, one of twice as many might have.
        let different = a.values().iter().zip(b.values()).filter(differ).count() as f64;
        let at_most = different + 2.0 * different.max(1.0).sqrt();
        Self {
            wrong: (at_most / 2.0 / a.size().area().max(1) as f64).min(1.0),
            rms: rms(a.values(), b.values(), steps_apart) / 2.0,
        }
    }
}

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
    /// Snell rays followed ten times as far as by default, and rays a dot until `goal` is reached. An
    /// interrupt leaves it with the rays that it has, 2 a dot at least.
    pub fn new(
        studio: &Studio,
        base: &Request,
        goal: &ReferenceGoal,
        eye: EyeDistance,
        interrupt: &AtomicBool,
    ) -> Self {
        let exact = Request { options: exact(&base.options), wants: Wants::LIGHT, ..base.clone() };
        let geometry = Request { wants: Wants { cells: false, ..Wants::ALL }, ..exact.clone() };
        let geometry = studio.draw_anew(&geometry);
        let begin = Instant::now();
        let mut rays = ManyRays::new(studio, exact.clone());
        let [mut first, mut second] = [rays.mean(0..1), rays.mean(1..2)];
        let mut number = 2;
        let mut early = first.with(&second);
        let (error, reached) = loop {
            let error = ReferenceError::of([&first, &second], base);
            let reached = error.wrong <= FINER * goal.apart;
            let enough = match goal.rays {
                Some(asked) => number >= asked,
                // As many again take as long as all until now.
                None => reached || number >= MOST_RAYS || Instant::now() + begin.elapsed() > goal.until,
            };
            if enough || interrupt.load(Ordering::Relaxed) {
                break (error, reached);
            }
            first = first.with(&second);
            second = rays.mean(number..2 * number);
            number *= 2;
            if number <= SHIMMER_RAYS {
                early = first.with(&second);
            }
        };
        let exact_rays = if rays.agrees() { number.min(CHECKED_RAYS) } else { number };
        let mean = first.with(&second);
        let light = mean.light.map(|light| shown(base.tone, *light));
        let mut moved = rays.of(Request { camera: turned(base), ..exact });
        let screen = SeenScreen::new(base, eye, &mean, [&early, &moved.mean(0..number.min(SHIMMER_RAYS))]);
        let levels = light.map(|light| Level::nearest(*light));
        Self { base: base.clone(), geometry, light, levels, screen, rays: number, exact_rays, error, reached }
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
    /// characters.
    pub fn shimmer(&self) -> Option<f64> {
        self.screen.as_ref().map(SeenScreen::shimmer)
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
        Request { camera: turned(&self.base), ..request.clone() }
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

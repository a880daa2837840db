//! With how many rays a picture is drawn: few enough while the eye moves that it keeps up, then more and
//! more, until it is what was asked for. No thread and no clock: times are given.

use std::fmt::{self, Display, Formatter};
use std::time::{Duration, Instant};

use crate::frame::{Frame, Request};
use crate::plan::{ERROR, Options};
use crate::stage::GiveUp;

use super::Painter;

/// The largest dots are so many times as wide and as high as those of the whole picture: of characters of
/// 2 × 4 dots, those of four by two. With larger ones nobody finds the way.
const COARSEST: u32 = 8;

/// A picture that nobody wants any more is given up when it has taken so many times the time of a picture;
/// before, it is finished, for else a held key would show nothing.
const PATIENCE: u32 = 2;

/// After this time without a move the eye is taken to rest: a key that is held repeats at least 10.9 times a
/// second, which is what a PC's keyboard does by itself. Sooner, every other picture of a flight would be one
/// that nobody looks at.
const REST: Duration = Duration::from_millis(100);

/// How finely a picture is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// A ray for each square of so many dots across and down, which have the light of its middle.
    Coarse(u32),
    /// A ray for each dot.
    #[default]
    OneRay,
    /// As many as were asked for.
    Full,
}

/// What the tracing thread is to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// The picture, of all its dots.
    pub request: Request,
    /// How many times as wide and as high its dots are drawn.
    pub factor: u32,
    /// How long it is drawn on when nobody wants it any more.
    pub patience: Duration,
}

/// The rays of a picture, in words.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RaysTold {
    detail: Detail,
    samples: u32,
    is_adaptive: bool,
}

/// What has been drawn, what is being drawn, and what that teaches.
#[derive(Debug, Default)]
pub struct Refinement {
    /// The time of a picture while the eye moves; absent where it takes what it takes.
    frame_time: Option<Duration>,
    /// Whether a picture of one ray a dot becomes an anti-aliased one when nothing moves.
    adaptive_at_rest: bool,
    /// What is shown: the model's request, and how finely that was drawn.
    shown: Option<(Request, Detail)>,
    in_hand: Option<InHand>,
    /// When the first picture was begun of what is wanted.
    moved: Option<Instant>,
    /// Seconds of a ray from the eye, with all that follows from it, by the last picture of which each was
    /// traced.
    cost: Option<f64>,
}

#[derive(Debug)]
struct InHand {
    request: Request,
    detail: Detail,
    begun: Instant,
    /// Whether it is of a scene that has been read anew since.
    is_stale: bool,
}

impl Order {
    /// Has it drawn; `None` where it is given up.
    pub fn draw(&self, painter: &dyn Painter, give_up: &GiveUp) -> Option<Frame> {
        let Self { request, factor, .. } = self;
        if *factor == 1 {
            return painter.draw_unless(request, give_up);
        }
        let coarse = painter.draw_unless(&request.coarser(*factor), give_up)?;
        Some(coarse.enlarged(request, *factor))
    }
}

impl Display for RaysTold {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.detail {
            Detail::Coarse(factor) => write!(f, "1 for {} dots", factor * factor),
            Detail::Full if self.is_adaptive => f.write_str("adaptive"),
            Detail::Full => write!(f, "{} a dot", self.samples * self.samples),
            Detail::OneRay => f.write_str("1 a dot"),
        }
    }
}

impl Refinement {
    /// Nothing has been drawn yet.
    pub fn new(frame_time: Option<Duration>, adaptive_at_rest: bool) -> Self {
        Self { frame_time, adaptive_at_rest, ..Self::default() }
    }

    /// What is to be drawn next of what is wanted; nothing while a picture is in hand, and where what is
    /// shown is all that was asked for.
    pub fn next(&self, wanted: &Request) -> Option<Detail> {
        if self.in_hand.is_some() {
            return None;
        }
        match self.shown.as_ref().filter(|_| self.refines(wanted)) {
            None => Some(self.first(wanted)),
            Some((_, Detail::Coarse(_))) => Some(Detail::OneRay),
            Some((_, Detail::OneRay)) if !self.ends_with_one_ray(wanted) => Some(Detail::Full),
            Some(_) => None,
        }
    }

    /// Whether a picture of one ray a dot becomes an anti-aliased one when nothing moves, from now on.
    pub fn set_adaptive_at_rest(&mut self, adaptive: bool) {
        self.adaptive_at_rest = adaptive;
    }

    /// The picture that is shown, as it was wanted.
    pub fn shown(&self) -> Option<&Request> {
        self.shown.as_ref().map(|(request, _)| request)
    }

    /// The picture that is there when nothing moves, of what is wanted.
    pub fn finest(&self, wanted: &Request) -> Request {
        Request { options: self.full(wanted), ..wanted.clone() }
    }

    /// When it is to be begun; absent where that is at once.
    pub fn due(&self, wanted: &Request) -> Option<Instant> {
        self.moved.filter(|_| self.refines(wanted)).map(|moved| moved + REST)
    }

    /// Notes that this is being drawn, and says how.
    pub fn begin(&mut self, wanted: &Request, detail: Detail, now: Instant) -> Order {
        let refines = self.refines(wanted);
        if !refines {
            self.moved = Some(now);
        }
        let factor = if let Detail::Coarse(factor) = detail { factor } else { 1 };
        let options = if detail == Detail::Full { self.full(wanted) } else { one_ray(wanted) };
        // What is only refined is there already.
        let patience = if refines {
            Duration::ZERO
        } else {
            self.frame_time.map_or(Duration::MAX, |time| time.saturating_mul(PATIENCE))
        };
        self.in_hand = Some(InHand { request: wanted.clone(), detail, begun: now, is_stale: false });
        Order { request: Request { options, ..wanted.clone() }, factor, patience }
    }

    /// Notes that the scene was read anew: what has been drawn, and what is being drawn, is of another.
    pub fn start_anew(&mut self) {
        (self.shown, self.cost) = (None, None);
        if let Some(in_hand) = &mut self.in_hand {
            in_hand.is_stale = true;
        }
    }

    /// Whether what is being drawn is not what is wanted.
    pub fn is_outdated(&self, wanted: Option<&Request>) -> bool {
        self.in_hand.as_ref().is_some_and(|in_hand| in_hand.is_stale || Some(&in_hand.request) != wanted)
    }

    /// Notes that it is drawn; gives its rays.
    pub fn finished(&mut self, frame: &Frame) -> Option<RaysTold> {
        let InHand { request, detail, is_stale, .. } = self.in_hand.take()?;
        let full = self.full(&request);
        let is_adaptive = detail == Detail::Full && full.adaptive.is_some();
        let rays = rays(&request, detail, full.samples);
        // Where some were taken over from the picture before, it tells nothing of their time.
        if !is_adaptive && !is_stale && frame.counts.primary_rays >= rays {
            self.cost = Some(frame.total.as_secs_f64() / rays.max(1) as f64);
        }
        self.shown = Some((request, detail)).filter(|_| !is_stale);
        Some(RaysTold { detail, samples: full.samples, is_adaptive })
    }

    /// Notes that it was given up.
    pub fn given_up(&mut self, now: Instant) {
        let Some(InHand { request, detail, begun, is_stale }) = self.in_hand.take() else { return };
        if !is_stale && !self.refines(&request) && detail != Detail::Full {
            // It would have taken longer.
            let least = now.saturating_duration_since(begun).as_secs_f64();
            let least = least / rays(&request, detail, 1).max(1) as f64;
            self.cost = Some(self.cost.map_or(least, |cost| cost.max(least)));
        }
    }

    /// Whether a picture of what is wanted is shown already.
    fn refines(&self, wanted: &Request) -> bool {
        self.shown.as_ref().is_some_and(|(shown, _)| shown == wanted)
    }

    /// The finest that is drawn within the time of a picture.
    fn first(&self, wanted: &Request) -> Detail {
        let full = self.full(wanted);
        let Some(time) = self.frame_time else {
            // What was asked for by name is drawn at once.
            return if full == wanted.options && !self.ends_with_one_ray(wanted) {
                Detail::Full
            } else {
                Detail::OneRay
            };
        };
        let Some(cost) = self.cost else { return Detail::OneRay };
        let fits = |detail| cost * rays(wanted, detail, full.samples) as f64 <= time.as_secs_f64();
        if full.samples > 1 && fits(Detail::Full) {
            Detail::Full
        } else if fits(Detail::OneRay) {
            Detail::OneRay
        } else {
            let factor = (2..COARSEST).find(|&factor| fits(Detail::Coarse(factor)));
            Detail::Coarse(factor.unwrap_or(COARSEST))
        }
    }

    /// What a picture of these options ends with.
    fn full(&self, wanted: &Request) -> Options {
        let options = wanted.options;
        let adaptive = (self.adaptive_at_rest && options.samples == 1).then_some(ERROR);
        Options { adaptive: options.adaptive.or(adaptive), ..options }
    }

    fn ends_with_one_ray(&self, wanted: &Request) -> bool {
        let full = self.full(wanted);
        full.samples == 1 && full.adaptive.is_none()
    }
}

/// One ray for each dot, whatever else is asked for.
fn one_ray(wanted: &Request) -> Options {
    Options { samples: 1, adaptive: None, ..wanted.options }
}

/// The rays from the eye of a picture, where each dot has as many.
fn rays(request: &Request, detail: Detail, samples: u32) -> u64 {
    match detail {
        Detail::Coarse(factor) => request.coarser(factor).dots.area() as u64,
        Detail::OneRay => request.dots.area() as u64,
        Detail::Full => request.dots.area() as u64 * u64::from(samples) * u64::from(samples),
    }
}

#[cfg(test)]
#[path = "refinement_tests.rs"]
mod tests;

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
mod tests {
    use super::*;
    use crate::frame::{Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::{Grid, Size};
    use crate::scene::Scene;
    use crate::stage::Counts;
    use crate::tone::Tone;

    const MS: Duration = Duration::from_millis(1);

    /// A request told apart by its zoom.
    fn request(zoom: f64) -> Request {
        let camera = Studio::new(Scene::default()).unwrap().camera(0, 1.0);
        Request {
            camera: crate::scene::Camera { zoom, ..camera },
            dots: Size::new(160, 96),
            dot_aspect: 1.0,
            options: Options::default(),
            wants: Wants::CELLS,
            glyphs: GlyphMode::Blocks,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        }
    }

    fn blank(dots: Size) -> Frame {
        Frame::blank(dots, Grid::from_values(Size::new(0, 0), Vec::new()))
    }

    /// Draws the next picture, which takes so long for each dot that it would be as long for all of them.
    fn draw(refinement: &mut Refinement, wanted: &Request, all: Duration) -> Option<(Order, String)> {
        let detail = refinement.next(wanted)?;
        let order = refinement.begin(wanted, detail, Instant::now());
        assert_eq!(refinement.next(wanted), None);
        let drawn = order.request.coarser(order.factor).dots.area() as u64;
        let samples = u64::from(order.request.options.samples).pow(2);
        let blank = blank(wanted.dots);
        let frame = Frame {
            counts: Counts { primary_rays: drawn * samples, ..Counts::default() },
            total: all.mul_f64((drawn * samples) as f64 / wanted.dots.area() as f64),
            ..blank
        };
        let told = refinement.finished(&frame).unwrap();
        Some((order, told.to_string()))
    }

    fn all(refinement: &mut Refinement, wanted: &Request, time: Duration) -> Vec<String> {
        std::iter::from_fn(|| draw(refinement, wanted, time)).map(|(_, told)| told).collect()
    }

    #[test]
    fn at_rest_a_picture_gets_better_until_it_is_what_was_asked_for() {
        let mut refinement = Refinement::new(Some(50 * MS), true);
        assert_eq!(all(&mut refinement, &request(1.0), MS), ["1 a dot", "adaptive"]);
        // While it fits, the eye sees every dot; then larger ones, as many as fit.
        assert_eq!(all(&mut refinement, &request(2.0), 60 * MS), ["1 a dot", "adaptive"]);
        assert_eq!(all(&mut refinement, &request(3.0), 60 * MS), ["1 for 4 dots", "1 a dot", "adaptive"]);
        assert_eq!(all(&mut refinement, &request(4.0), 600 * MS), ["1 for 4 dots", "1 a dot", "adaptive"]);
        assert_eq!(all(&mut refinement, &request(5.0), 600 * MS), ["1 for 16 dots", "1 a dot", "adaptive"]);
        assert_eq!(all(&mut refinement, &request(6.0), 600_000 * MS)[0], "1 for 16 dots");
        assert_eq!(all(&mut refinement, &request(7.0), 600_000 * MS)[0], "1 for 64 dots");
        // Then there is nothing more to do.
        assert_eq!(refinement.next(&request(7.0)), None);
    }

    #[test]
    fn a_key_that_is_held_has_pictures_that_fit() {
        let mut refinement = Refinement::new(Some(50 * MS), true);
        let mut told = Vec::new();
        for zoom in 1..5 {
            // The next key is there before the picture is refined.
            told.push(draw(&mut refinement, &request(f64::from(zoom)), 300 * MS).unwrap().1);
        }
        assert_eq!(told, ["1 a dot", "1 for 9 dots", "1 for 9 dots", "1 for 9 dots"]);
        // Where it is quick again, that is seen at once.
        draw(&mut refinement, &request(5.0), 20 * MS);
        assert_eq!(draw(&mut refinement, &request(6.0), 20 * MS).unwrap().1, "1 a dot");
    }

    #[test]
    fn what_was_asked_for_is_what_there_is_at_rest() {
        let with = |samples, adaptive| {
            let options = Options { samples, adaptive, ..Options::default() };
            Request { options, ..request(1.0) }
        };
        // `--aa off`.
        let mut off = Refinement::new(Some(50 * MS), false);
        assert_eq!(all(&mut off, &request(1.0), 100 * MS), ["1 a dot"]);
        assert_eq!(all(&mut off, &request(2.0), 100 * MS), ["1 for 4 dots", "1 a dot"]);
        // `--samples 3`, which is drawn at once where there is the time.
        for (time, told) in [(2 * MS, vec!["9 a dot"]), (20 * MS, vec!["1 a dot", "9 a dot"])] {
            let mut fixed = Refinement::new(Some(50 * MS), false);
            assert_eq!(all(&mut fixed, &with(3, None), time), ["1 a dot", "9 a dot"]);
            let moved = Request { camera: request(2.0).camera, ..with(3, None) };
            assert_eq!(all(&mut fixed, &moved, time), told);
        }
        // `--aa adaptive --error 0.5`.
        let mut adaptive = Refinement::new(Some(50 * MS), false);
        let wanted = with(1, Some(0.5));
        assert_eq!(draw(&mut adaptive, &wanted, MS).unwrap().1, "1 a dot");
        assert_eq!(draw(&mut adaptive, &wanted, MS).unwrap().0.request, wanted);
        // Without a limit it is drawn at once; `--fps 0`.
        for wanted in [with(3, None), with(1, Some(0.5))] {
            let mut at_once = Refinement::new(None, false);
            assert_eq!(draw(&mut at_once, &wanted, 900 * MS).unwrap().0.request, wanted);
            assert_eq!(at_once.next(&wanted), None);
        }
        assert_eq!(all(&mut Refinement::new(None, true), &request(1.0), 900 * MS), ["1 a dot", "adaptive"]);
    }

    #[test]
    fn refinement_ends_at_once_and_motion_after_its_time() {
        let begin = Instant::now();
        let mut refinement = Refinement::new(Some(50 * MS), true);
        let [here, there] = [request(1.0), request(2.0)];
        draw(&mut refinement, &here, MS);
        assert_eq!(refinement.due(&there), None);
        refinement.begin(&there, Detail::OneRay, begin);
        refinement.finished(&blank(here.dots));
        assert_eq!((refinement.due(&there), refinement.due(&here)), (Some(begin + REST), None));
        refinement.begin(&here, Detail::OneRay, begin);
        refinement.finished(&blank(here.dots));
        let order = refinement.begin(&here, Detail::Full, begin + REST);
        // What refines it does not begin the time anew.
        assert_eq!(refinement.due(&here), Some(begin + REST));
        assert_eq!(order.patience, Duration::ZERO);
        assert!(refinement.is_outdated(Some(&there)) && !refinement.is_outdated(Some(&here)));
        refinement.given_up(begin + REST + MS);
        // That teaches nothing of the time; what is shown is what it was.
        assert_eq!(refinement.next(&there), Some(Detail::OneRay));
        assert_eq!(refinement.next(&here), Some(Detail::Full));
        let order = refinement.begin(&there, Detail::OneRay, begin);
        assert_eq!(order.patience, 100 * MS);
        refinement.given_up(begin + 100 * MS);
        assert_eq!(refinement.next(&there), Some(Detail::Coarse(2)));
        assert_eq!(Refinement::new(None, true).begin(&here, Detail::OneRay, begin).patience, Duration::MAX);
    }

    #[test]
    fn what_was_taken_over_teaches_nothing() {
        let mut refinement = Refinement::new(Some(50 * MS), false);
        let blank = blank(Size::new(160, 96));
        refinement.begin(&request(1.0), Detail::OneRay, Instant::now());
        refinement.finished(&Frame { total: 900 * MS, ..blank });
        assert_eq!(refinement.next(&request(2.0)), Some(Detail::OneRay));
    }
}

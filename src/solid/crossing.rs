//! Stage 8, CSG: the first place along a ray where an expression changes.
//!
//! The crossings of all primitives are sorted along the ray. Those whose error intervals overlap that of the
//! first of them form a cluster and count as one place: they toggle together, and only the expression's value
//! before and behind the cluster matters. So a solid minus itself is nothing, and a hole flush with a face is
//! open, whatever the order of the operands. A cluster ends where a crossing's interval no longer meets that
//! of the cluster's **first** crossing: overlap is not transitive, and chains would weld a whole stack of
//! sheets.
//!
//! A ray that skims a face crosses it somewhere within an interval as long as the world, and has only faces
//! of the same slope for company: what it crosses steeply on the way keeps its own place ([`SAME_SLOPE`]).

use std::ops::{Div, Mul};

use crate::math::{Number, Ray, Rays};
use crate::stage::{Meter, Probe, RayEvent, Stage};

use super::primitive::{WorldPrimitive, WorldShape};
use super::prune::ExprView;
use super::span::{Departure, End, Ends, Spans};
use super::state::State;

/// A place where a ray goes into or out of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the ray, above 0.
    pub t: f64,
    /// The exact distance lies within `t ± error`.
    pub error: f64,
    /// The primitive whose surface it is.
    pub primitive: u32,
    /// The face of that primitive.
    pub surface: u32,
    /// Whether the ray goes into the solid.
    pub entering: bool,
}

impl Crossing {
    /// Whether it lies before a light, however it may be off.
    #[inline]
    pub fn is_before(&self, distance: f64) -> bool {
        self.t + self.error < distance
    }
}

/// One crossing of one primitive.
#[derive(Clone, Copy, Debug)]
struct Event {
    end: End,
    /// The leaf of the expression.
    leaf: u32,
}

/// Memory that is used again for every ray.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    events: Vec<Event>,
    state: State,
}

/// The part of a ray that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TRange {
    /// Crossings before this are passed over.
    pub from: f64,
    /// Crossings behind this are not looked for.
    pub to: f64,
}

impl TRange {
    /// The whole ray.
    pub const ALL: Self = Self { from: 0.0, to: f64::INFINITY };
}

/// Whether a crossing of `form` lies at the start of a ray. For a ray that leaves a surface it counts how far
/// either may be off its place: where they are one place they have one slope, so that `error` is to
/// `place_error` as the start's to its own. The eye is where it is: for a ray from there only rounding
/// counts, not how far the map of the primitive may be off.
#[inline]
pub fn at_start(end: &End, form: &WorldShape, departure: Option<Departure>) -> bool {
    end.t <= start_of(end.error, PlaceError::of(form), departure.map(|d| d.place_error))
}

/// How far a primitive may be off its place, in the world's unit, and which share of that our own rounding
/// may have made.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaceError<N> {
    pub bound: N,
    pub rounding_share: N,
}

impl PlaceError<f64> {
    /// That of a primitive.
    #[inline(always)]
    pub fn of(form: &WorldShape) -> Self {
        Self { bound: form.place_error(), rounding_share: form.rounding_share() }
    }
}

/// Up to which distance a crossing with this error lies at the start of its ray, given how far its primitive
/// is off, and rounding's share of that.
#[inline(always)]
pub(super) fn start_of<N, M>(error: N, own: PlaceError<M>, departure_error: Option<N>) -> N
where
    N: Number + Div<M, Output = N> + Mul<M, Output = N>,
{
    match departure_error {
        Some(theirs) => error * (theirs / own.bound + 1.0),
        None => error * 2.0 * own.rounding_share,
    }
}

/// The surfaces that rays start on, as seen from one primitive.
#[derive(Clone, Copy, Debug)]
pub struct RayStarts<N: Number> {
    /// Which rays start on a surface of this primitive.
    pub here: N::Mask,
    /// Which of these go to its inside.
    pub inward: N::Mask,
    /// [`Departure::place_error`] of each; `None` for rays from the eye.
    pub place_error: Option<N>,
}

impl<N: Number> RayStarts<N> {
    /// Whether crossings lie at the starts of their rays, or before.
    #[inline(always)]
    pub(super) fn before(&self, end: &Ends<N>, form: &WorldShape) -> N::Mask {
        end.t.is_at_most(self.reach(end, form))
    }

    /// Whether it is uncertain in single precision which of these they do.
    #[inline(always)]
    pub fn near(&self, end: &Ends<N>, form: &WorldShape) -> N::Mask {
        end.t.magnitude().is_at_most(self.reach(end, form))
    }

    #[inline(always)]
    fn reach(&self, end: &Ends<N>, form: &WorldShape) -> N {
        start_of(
            end.error,
            PlaceError {
                bound: form.place_error() * N::EPSILON_RATIO,
                rounding_share: form.rounding_share(),
            },
            self.place_error,
        )
    }
}

/// The first crossings of one convex primitive.
#[derive(Clone, Copy, Debug)]
pub struct FirstCrossings<N: Number> {
    /// Where.
    pub end: Ends<N>,
    /// Whether the ray goes into the solid there.
    pub entering: N::Mask,
    /// Which rays have one: of the others the numbers mean nothing.
    pub any: N::Mask,
}

/// The first crossings of one convex primitive, given the spans of rays in it.
#[inline(always)]
pub fn firsts_of_spans<N: Number>(
    spans: Spans<N>,
    form: &WorldShape,
    starts: &RayStarts<N>,
) -> FirstCrossings<N> {
    // A convex solid is not met again by a ray that leaves it.
    let any = spans.any & !(starts.here & !starts.inward);
    let leaving = starts.here | starts.before(&spans.enter, form);
    let end = Ends::choose(leaving, spans.leave, spans.enter);
    // The start on this primitive is at 0 by construction.
    let behind =
        (starts.here & end.t.is_at_most(end.t.same(0.0))) | (!starts.here & starts.before(&end, form));
    FirstCrossings { end, entering: !leaving, any: any & !behind }
}

/// The first crossing of one convex primitive.
#[inline]
pub fn first_of_span(
    ray: &Ray,
    primitive: &WorldPrimitive,
    index: u32,
    departure: Option<Departure>,
    meter: &mut Meter<impl Probe>,
) -> Option<Crossing> {
    meter.counts.primitive_tests += 1;
    let here = departure.filter(|d| d.primitive == index);
    let is_left = here.is_some_and(|d| !d.inward);
    let spans = if is_left { None } else { primitive.form.spans(&Rays::from(ray)) };
    let spans = spans.filter(|spans| spans.any);
    meter.record(|| {
        let span = spans.map(|spans| [if here.is_some() { 0.0 } else { spans.enter.t }, spans.leave.t]);
        RayEvent::Tested { primitive: index, span }
    });
    let spans = spans?;
    let starts = RayStarts {
        here: here.is_some(),
        inward: here.is_some(),
        place_error: departure.map(|d| d.place_error),
    };
    let first = firsts_of_spans(spans, &primitive.form, &starts);
    let End { t, error, surface } = first.end.one();
    first.any.then_some(Crossing { t, error, primitive: index, surface, entering: first.entering })
}

/// The first crossing of an expression within `reach`.
pub fn first_of_expression<'e>(
    ray: &Ray,
    expression: impl Into<ExprView<'e>>,
    primitives: &[WorldPrimitive],
    departure: Option<Departure>,
    reach: TRange,
    scratch: &mut Scratch,
    meter: &mut Meter<impl Probe>,
) -> Option<Crossing> {
    let (expression, Scratch { events, state }) = (expression.into(), scratch);
    meter.at(Stage::Solid);
    meter.counts.primitive_tests += expression.leaves.len() as u64;
    gather(ray, expression, primitives, departure, reach, events, meter);
    if events.is_empty() {
        return None;
    }
    meter.at(Stage::Csg);
    meter.counts.csg_evaluations += 1;
    meter.record(|| RayEvent::Evaluated { leaves: expression.leaves.len(), crossings: events.len() });
    events.sort_unstable_by(|a, b| a.end.t.total_cmp(&b.end.t).then(a.leaf.cmp(&b.leaf)));
    state.start(expression);
    let mut value = state.value(expression);
    let form = |event: &Event| &primitives[expression.leaves[event.leaf as usize].primitive as usize].form;
    let mut rest = &mut events[..];
    while let Some(first) = rest.first().copied() {
        let length = gather_cluster(rest, |event| form(event).place_error());
        let (cluster, behind) = rest.split_at_mut(length);
        rest = behind;
        if first.end.t > reach.to {
            return None;
        }
        for event in &*cluster {
            state.toggle(expression, event.leaf);
        }
        let before = std::mem::replace(&mut value, state.value(expression));
        let passed =
            at_start(&first.end, form(&first), departure) || cluster.iter().all(|e| e.end.t < reach.from);
        if value != before && !passed {
            // The first in the file among those that made the change shows.
            let deciding = cluster.iter().filter(|e| state.decides(expression, e.leaf));
            let shown = deciding.min_by_key(|e| e.leaf).copied().unwrap_or(first);
            return Some(Crossing {
                t: shown.end.t,
                error: shown.end.error,
                primitive: expression.leaves[shown.leaf as usize].primitive,
                surface: shown.end.surface,
                entering: value,
            });
        }
        state.settle();
    }
    None
}

/// How much the sines of the angles at which a ray meets two surfaces in one place may differ, as a factor.
///
/// Where surfaces coincide they have one slope, but for what their maps lost, which counts where a ray all
/// but skims them. What is crossed steeply on a way that skims a face has a sine farther from the face's than
/// this, unless the face's crossing is known within 256 times `place_error`, too little to be seen.
const SAME_SLOPE: f64 = 256.0;

/// Whether the sines of the angles at which rays meet two surfaces are as near as those of one place are.
#[inline(always)]
pub(super) fn have_one_slope<N: Number>(a: N, b: N) -> N::Mask {
    a.larger(b).is_at_most(a.smaller(b) * SAME_SLOPE)
}

/// Brings those of the sorted events that are one place with the first of them to the front, and counts them;
/// the others keep their order.
fn gather_cluster(events: &mut [Event], place_error: impl Fn(&Event) -> f64) -> usize {
    let first = events[0].end;
    let limit = first.t + first.error;
    // An error is `place_error` over the sine of the angle between ray and surface.
    let sine = |event: &Event| place_error(event) / event.end.error;
    let mut length = 1;
    for i in 1..events.len() {
        let end = events[i].end;
        if end.t - end.error > limit {
            break;
        }
        let (a, b) = (sine(&events[0]), sine(&events[i]));
        // A start that is 0 by construction has neither error nor slope, and is one place with all that reach
        // it.
        if a.max(b) <= SAME_SLOPE * a.min(b) || first.error == 0.0 || end.error == 0.0 {
            events[length..=i].rotate_right(1);
            length += 1;
        }
    }
    length
}

/// The event of a ray that crosses a primitive at these distances, in any order.
fn tested(primitive: u32, crossings: impl Iterator<Item = f64>) -> RayEvent {
    let span = crossings.fold(None, |span, t| {
        let [first, last] = span.unwrap_or([t; 2]);
        Some([t.min(first), t.max(last)])
    });
    RayEvent::Tested { primitive, span }
}

/// Collects the crossings of every primitive of the expression that can matter within `reach`.
fn gather(
    ray: &Ray,
    expression: ExprView,
    primitives: &[WorldPrimitive],
    departure: Option<Departure>,
    reach: TRange,
    events: &mut Vec<Event>,
    meter: &mut Meter<impl Probe>,
) {
    events.clear();
    for (leaf, place) in expression.leaves.iter().enumerate() {
        let leaf = leaf as u32;
        let form = &primitives[place.primitive as usize].form;
        let here = departure.filter(|d| d.primitive == place.primitive);
        let zero = End { t: 0.0, error: 0.0, surface: 0 };
        if !form.is_convex() {
            let start = here.map(|d| d.surface);
            let before = events.len();
            form.crossings(ray, |end| {
                let end = if Some(end.surface) == start { zero } else { end };
                events.push(Event { end, leaf });
            });
            meter.record(|| tested(place.primitive, events[before..].iter().map(|event| event.end.t)));
            continue;
        }
        let outward = here.is_some_and(|d| !d.inward);
        let mut span = if outward { None } else { form.span(ray) };
        if let (Some(span), true) = (&mut span, here.is_some()) {
            span.enter = zero;
        }
        meter.record(|| tested(place.primitive, span.iter().flat_map(|span| [span.enter.t, span.leave.t])));
        let Some(span) = span else { continue };
        // Far outside the reach only the state inside it matters: none for a span that ends before it or
        // starts behind it.
        let ends_before = span.leave.t + span.leave.error < reach.from;
        let starts_behind = span.enter.t - span.enter.error > reach.to;
        if !ends_before && !starts_behind && span.enter.t < span.leave.t {
            events.push(Event { end: span.enter, leaf });
            events.push(Event { end: span.leave, leaf });
        }
    }
}

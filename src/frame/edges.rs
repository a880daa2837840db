//! What a dot's light is expected to be where edges run through it, by what its rays and those of the dots
//! around it have met.
//!
//! Rays of one history make a class: on its side of an edge light is smooth, and only how much of the dot
//! lies there is in doubt. The mean of all lines between the points of one class and all others says that
//! ([`EdgeModel`]), better than the share of the dot's own rays does: 4 rays with those of the dots around
//! err as 11 alone. Where no line parts them, or too many classes meet, the plain mean is left.

use crate::integrate::History;
use crate::math::Grid;
use crate::shade::Channel;
use crate::view::{EdgeModel, Extent, FITTED, Share, edge_error, missed_edge_error};

use super::accuracy::{Accuracy, LightRange};

/// The most classes that are told apart in a dot and its neighbours: with more, each has too few points.
const CLASSES: usize = 4;

/// So many rays of each dot around count, their first: with more, curved edges are taken for straight ones
/// over three dots.
pub(super) const BESIDE: usize = 4;

/// What one ray saw.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenByRay<C> {
    pub light: C,
    pub history: History,
}

/// A dot whose level one ray does not decide, and what its rays saw: those of its first samples, in order.
#[derive(Clone, Debug)]
pub(super) struct OpenDot<C> {
    pub column: u32,
    pub row: u32,
    pub rays: Vec<SeenByRay<C>>,
    /// What its rays may have seen, as far as those of the dots around tell.
    pub around: LightRange,
    /// Whether it is to be decided: else its first few rays are for a dot beside it.
    pub is_own: bool,
}

/// What is known of a picture: a ray for each dot, and all of those that got more.
pub(super) struct Knowledge<'a, C, F> {
    pub model: &'a EdgeModel,
    /// What the ray through the middle of a dot saw.
    pub first: &'a F,
    /// Past 0 the number of an open dot, from 1.
    pub numbers: &'a Grid<u32>,
    pub open: &'a [OpenDot<C>],
}

/// What a dot's light is expected to be, and how far off that may be, by part.
pub(super) struct Expected<C> {
    pub light: C,
    pub deviation: [f64; 3],
    pub possible: LightRange,
}

/// The rays of one history in a dot and around it.
#[derive(Clone, Copy)]
struct Class<C> {
    history: History,
    /// The light of those in the dot, and how many.
    own: (C, u32),
    /// Of those around it.
    around: (C, u32),
    extent: Extent,
}

/// The classes of a dot.
struct Classes<C> {
    all: [Class<C>; CLASSES],
    count: usize,
}

impl<C: Channel> Class<C> {
    const NONE: Self =
        Self { history: History::MISS, own: (C::DARK, 0), around: (C::DARK, 0), extent: Extent::NONE };

    /// The mean light of its rays: of those in the dot, if there are any.
    fn light(&self) -> C {
        let (sum, rays) = if self.own.1 > 0 { self.own } else { self.around };
        sum * (1.0 / f64::from(rays))
    }
}

impl<C: Channel> Classes<C> {
    /// The class of a history, made if there is none and room for another.
    #[inline]
    fn of(&mut self, history: History, may_be_new: bool) -> Option<&mut Class<C>> {
        let found = self.all[..self.count].iter().position(|class| class.history == history);
        let number = match found {
            Some(number) => number,
            None if may_be_new && self.count < CLASSES => {
                self.count += 1;
                self.all[self.count - 1].history = history;
                self.count - 1
            }
            None => return None,
        };
        Some(&mut self.all[number])
    }

    /// How much of the dot each class has. `None` where no straight edges part them; one of them may be what
    /// the others leave, as between two edges.
    fn shares(&self, model: &EdgeModel) -> Option<[Share; CLASSES]> {
        let classes = &self.all[..self.count];
        let mut shares = [Share { mean: 0.0, deviation: 0.0 }; CLASSES];
        if let [one, other] = classes {
            shares[0] = model.share(&one.extent, &other.extent)?;
            shares[1] = Share { mean: 1.0 - shares[0].mean, ..shares[0] };
            return Some(shares);
        }
        let mut left = None;
        for (number, class) in classes.iter().enumerate() {
            let mut outside = Extent::NONE;
            for (_, other) in classes.iter().enumerate().filter(|(other, _)| *other != number) {
                outside.add_all(&other.extent);
            }
            match model.share(&class.extent, &outside) {
                Some(share) => shares[number] = share,
                None if left.is_none() => left = Some(number),
                None => return None,
            }
        }
        let sum: f64 = shares.iter().map(|share| share.mean).sum();
        if let Some(number) = left.filter(|_| sum <= 1.0) {
            let squares: f64 = shares.iter().map(|share| share.deviation * share.deviation).sum();
            shares[number] = Share { mean: 1.0 - sum, deviation: squares.sqrt() };
        } else {
            for share in &mut shares {
                share.mean /= sum;
            }
        }
        Some(shares)
    }
}

impl<C: Channel> OpenDot<C> {
    /// The plain mean of its rays, and how far off that may be.
    fn by_mean(&self, accuracy: Accuracy) -> Expected<C> {
        let rays = self.rays.len() as u32;
        let sum = self.rays.iter().fold(C::DARK, |sum, ray| sum + ray.light);
        let mut own = LightRange::of(accuracy.parts(self.rays[0].light));
        self.rays.iter().for_each(|ray| own.add(accuracy.parts(ray.light)));
        let (seen, missed) = (edge_error(rays), missed_edge_error(rays));
        let deviation =
            std::array::from_fn(|part| (own.width(part) * seen).max(self.around.width(part) * missed));
        let mut possible = self.around;
        possible.add(own.least);
        possible.add(own.most);
        Expected { light: sum * (1.0 / f64::from(rays)), deviation, possible }
    }
}

impl<C: Channel, F: Fn(u32, u32) -> SeenByRay<C>> Knowledge<'_, C, F> {
    /// What the light of an open dot is expected to be.
    pub fn expected(&self, dot: &OpenDot<C>, accuracy: Accuracy) -> Expected<C> {
        let plain = dot.by_mean(accuracy);
        let size = self.numbers.size();
        let inside = (1..size.width.saturating_sub(1)).contains(&dot.column)
            && (1..size.height.saturating_sub(1)).contains(&dot.row);
        if dot.rays.len() > FITTED || !inside {
            return plain;
        }
        let mut classes = Classes { all: [Class::<C>::NONE; CLASSES], count: 0 };
        for (sample, ray) in dot.rays.iter().enumerate() {
            let Some(class) = classes.of(ray.history, true) else { return plain };
            class.own = (class.own.0 + ray.light, class.own.1 + 1);
            self.model.add(&mut class.extent, 4, sample);
        }
        let beside = (0..9).filter(|&place| place != 4).map(|place| {
            let (i, j) = (dot.column + place as u32 % 3 - 1, dot.row + place as u32 / 3 - 1);
            (place, i, j)
        });
        for (place, i, j) in beside.clone() {
            let ray = (self.first)(i, j);
            let Some(class) = classes.of(ray.history, true) else { return plain };
            class.around = (class.around.0 + ray.light, class.around.1 + 1);
            self.model.add(&mut class.extent, place, 0);
        }
        if classes.count < 2 {
            return plain;
        }
        let by_middles = classes.all.map(|class| class.extent);
        for (place, i, j) in beside {
            let Some(number) = self.numbers[(i, j)].checked_sub(1) else { continue };
            let rays = &self.open[number as usize].rays;
            for (sample, ray) in rays.iter().enumerate().take(BESIDE).skip(1) {
                if let Some(class) = classes.of(ray.history, false) {
                    self.model.add(&mut class.extent, place, sample);
                }
            }
        }
        let shares = classes.shares(self.model).or_else(|| {
            for (class, extent) in classes.all.iter_mut().zip(by_middles) {
                class.extent = extent;
            }
            classes.shares(self.model)
        });
        let Some(shares) = shares else { return plain };
        let fitted = || classes.all[..classes.count].iter().zip(shares);
        let light = fitted().fold(C::DARK, |sum, (class, share)| sum + class.light() * share.mean);
        let mean = accuracy.parts(light);
        let mut deviation = [0.0; 3];
        let mut possible = plain.possible;
        for (class, share) in fitted() {
            let parts = accuracy.parts(class.light());
            possible.add(parts);
            for part in 0..3 {
                deviation[part] += share.deviation * (parts[part] - mean[part]).abs();
            }
        }
        Expected { light, deviation, possible }
    }
}

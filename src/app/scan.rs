//! A picture that is drawn dot by dot, row by row. No clock: times are given.

use std::time::{Duration, Instant};

use super::follow_order::{FollowOrder, FollowedDot};
use super::pace;
use super::shown::DotInHand;
use crate::frame::{Frame, Request};
use crate::stage::Stage;

/// So often it is shown how far it is: as often as pictures of a flight.
const STEP: Duration = Duration::from_millis(50);

/// A picture that is being drawn dot by dot.
#[derive(Clone, Debug)]
pub struct Scan {
    request: Request,
    whole: Frame,
    /// The seconds that all of it takes at one megahertz.
    seconds: f64,
    megahertz: f64,
    /// The part of it that was there, 0 to 1, at this time.
    share: f64,
    since: Instant,
    /// The stages of a ray that was in hand.
    stages: Vec<(Stage, f64)>,
}

impl Scan {
    /// Begins with the first dot of a picture that is known already.
    pub fn new(request: Request, whole: Frame, megahertz: f64, now: Instant) -> Self {
        // Nobody had several rays a dot: the time is that of one for each, as they are on average.
        let rays = whole.counts.primary_rays.max(1) as f64;
        let seconds = pace::seconds(&whole) * request.dots.area() as f64 / rays;
        Self { request, whole, seconds, megahertz, share: 0.0, since: now, stages: Vec::new() }
    }

    /// At the pace of another, where no ray of this one was counted, because it shows what was met before.
    #[must_use]
    pub fn after(mut self, before: Option<&Self>) -> Self {
        if let (0.0, Some(before)) = (self.seconds, before) {
            self.seconds = before.seconds;
        }
        self
    }

    /// The whole picture.
    pub fn whole(self) -> Frame {
        self.whole
    }

    /// Whether it is the picture of a request.
    pub fn is_of(&self, request: &Request) -> bool {
        self.request == *request
    }

    /// Goes on with the same picture, drawn more finely.
    #[must_use]
    pub fn with(self, whole: Frame) -> Self {
        Self { whole, ..self }
    }

    /// Goes on at another pace.
    pub fn set_megahertz(&mut self, megahertz: f64, now: Instant) {
        (self.share, self.since) = (self.share_at(now), now);
        self.megahertz = megahertz;
    }

    /// The part that is there, 0 to 1. A picture of which no ray was counted is there at once.
    pub fn share_at(&self, now: Instant) -> f64 {
        if self.seconds == 0.0 {
            return 1.0;
        }
        let since = now.saturating_duration_since(self.since).as_secs_f64();
        (self.share + since * self.megahertz / self.seconds).min(1.0)
    }

    /// What is told of the dot in hand; absent where all is there.
    pub fn in_hand(&self, now: Instant) -> Option<DotInHand> {
        let share = self.share_at(now);
        (share < 1.0).then(|| DotInHand { stage: self.stage(now), share })
    }

    /// What is there.
    pub fn frame(&self, now: Instant) -> Frame {
        self.whole.scanned(&self.request, self.place(now) as usize)
    }

    /// When it is to be shown again; absent where all is there.
    pub fn due(&self, now: Instant) -> Option<Instant> {
        (self.share_at(now) < 1.0).then(|| now + STEP)
    }

    /// The ray of the dot in hand, which is to be followed for its stages; absent where all is there.
    pub fn order(&self, now: Instant) -> Option<FollowOrder> {
        let width = u64::from(self.request.dots.width);
        let dot = self.place(now) as u64;
        let dot = [dot % width.max(1), dot / width.max(1)].map(|place| place as u32);
        (self.share_at(now) < 1.0).then(|| FollowOrder { request: self.request.clone(), dot })
    }

    /// Takes the stages of a ray.
    pub fn tell(&mut self, followed: &FollowedDot) {
        if let Some(ray) = &followed.ray {
            self.stages = pace::stages(&ray.0.events);
        }
    }

    /// The stage that the dot in hand is in.
    fn stage(&self, now: Instant) -> Option<Stage> {
        let part = self.place(now).fract();
        pace::stage_at(&self.stages, part).filter(|_| self.share_at(now) < 1.0)
    }

    /// The dots that are there, and a part of the next.
    fn place(&self, now: Instant) -> f64 {
        self.share_at(now) * self.request.dots.area() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Studio, pcat};
    use crate::scene::{ReadOptions, read};

    #[test]
    fn dots_come_at_the_pace_and_the_last_is_the_whole_picture() {
        let text = b"camera(eye = [0, -9, 0]); light(at = [3, -9, 5]); sphere(1);";
        let studio = Studio::new(read("a.scene", text, &ReadOptions::default()).unwrap()).unwrap();
        let request = pcat::request(studio.camera(0, 1.0));
        let whole = studio.draw(&request);
        let begin = Instant::now();
        let mut scan = Scan::new(request.clone(), whole.clone(), 8.0, begin);
        let all = Duration::from_secs_f64(pace::seconds(&whole) / 8.0);
        assert_eq!(scan.share_at(begin), 0.0);
        assert!((scan.share_at(begin + all / 2) - 0.5).abs() < 1e-6);
        // At another pace it goes on from where it is.
        scan.set_megahertz(16.0, begin + all / 2);
        assert!((scan.share_at(begin + all * 3 / 4) - 1.0).abs() < 1e-6);
        // Half, and a tenth of the time at twice the pace: seven tenths of the 188 rows.
        let later = begin + all * 3 / 5;
        let order = scan.order(later).unwrap();
        assert_eq!(order.dot[1], 131);
        scan.tell(&order.follow(&studio));
        assert!(scan.stage(later).is_some());
        let end = begin + all;
        assert_eq!((scan.due(end), scan.order(end), scan.stage(end)), (None, None, None));
        assert_eq!(scan.frame(end).cells, whole.cells);
        assert_ne!(scan.frame(begin + all / 2).cells, whole.cells);
        assert!(scan.is_of(&request) && scan.clone().with(whole).share_at(end) >= 1.0);
        assert!(!scan.is_of(&Request { dot_aspect: 1.0, ..request }));
    }
}

//! When the next picture may be begun: when the terminal has shown enough of those before.
//!
//! A terminal's own queue is no measure. sshd and TCP take in a minute of pictures on a thin link, and what
//! is shown is as old as what they hold. So a status request goes behind each picture, and the answer says
//! that it is shown. No clock is in here: times are given.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// The time between two pictures through mosh, tmux or screen, which answer for themselves: 20 a second. mosh
/// sends at most 50 and on most links 20 or fewer; more would only be thrown away there.
const RELAYED: Duration = Duration::from_millis(50);

/// The time between two pictures where no answer ever comes: 10 a second, half of the above. At 2 KB a
/// picture, that fills no serial line of today (230 kbit/s), and it still looks like motion.
const UNANSWERED: Duration = Duration::from_millis(100);

/// After this time a terminal that has never answered is taken for one that does not.
const FIRST_PATIENCE: Duration = Duration::from_secs(1);

/// After this time an answer is taken for lost where others have come: longer than the largest first picture
/// (40 KB on 200 × 60 cells) takes at 80 kbit/s, and much longer than TCP needs to send a packet once more.
pub const PATIENCE: Duration = Duration::from_secs(5);

/// What is on its way to the terminal, and how fast it may follow.
#[derive(Debug, Default)]
pub struct Pacing {
    /// Whether something before the terminal answers for it.
    relayed: bool,
    /// When each update was sent that has not been answered, the oldest first.
    unanswered: VecDeque<Instant>,
    /// Answers that may still come to updates that are no longer waited for.
    late: usize,
    /// Whether an answer has come, or none after a long time.
    answers: Option<bool>,
    /// When the last update was begun.
    begun: Option<Instant>,
    /// The shortest time from an update to its answer so far: what the way takes without a load.
    shortest: Option<Duration>,
    /// The last one.
    latest: Option<Duration>,
    /// Bytes a second that may be sent, where there is a limit.
    ceiling: Option<f64>,
    /// When the limit lets the next update pass.
    paid: Option<Instant>,
}

impl Pacing {
    /// Says whether something before the terminal answers for it.
    pub fn set_relayed(&mut self, relayed: bool) {
        self.relayed = relayed;
    }

    /// Limits what is sent to so many bytes a second, above 0, on average: an update may be larger, and the
    /// next one waits for it.
    pub fn set_ceiling(&mut self, bytes_per_second: Option<f64>) {
        self.ceiling = bytes_per_second;
    }

    /// How long the last update took to the terminal and its answer back.
    pub fn round_trip(&self) -> Option<Duration> {
        self.latest.or(self.shortest)
    }

    /// Whether an update may be begun.
    pub fn is_open(&mut self, now: Instant) -> bool {
        self.give_up(now);
        self.opens().is_none_or(|opens| opens <= now)
    }

    /// When an update may be begun if no answer comes before; absent where it may at once.
    pub fn opens(&self) -> Option<Instant> {
        let full = self.unanswered.len() >= self.limit();
        let answered = self.unanswered.front().filter(|_| full).map(|&oldest| oldest + self.patience());
        let interval = match self.answers {
            Some(false) => UNANSWERED,
            _ if self.relayed => RELAYED,
            _ => Duration::ZERO,
        };
        answered.max(self.begun.map(|begun| begun + interval)).max(self.paid)
    }

    /// Notes that an update is begun.
    pub fn begin(&mut self, now: Instant) {
        self.begun = Some(now);
    }

    /// Notes how long the answer to a question of a few bytes took, absent where it has not come yet; and how
    /// many answers to what was sent so far are still to come.
    pub fn asked(&mut self, took: Option<Duration>, late: usize) {
        self.late += late;
        if let Some(took) = took {
            self.answers = Some(true);
            self.shortest = Some(took);
        }
    }

    /// Notes that an update of so many bytes was sent, with a status request behind it.
    pub fn sent(&mut self, now: Instant, bytes: usize) {
        if let Some(ceiling) = self.ceiling {
            // Longer than a day is never waited: the clock has an end.
            let takes = Duration::from_secs_f64((bytes as f64 / ceiling).min(86_400.0));
            self.paid = Some(self.paid.map_or(now, |paid| paid.max(now)) + takes);
        }
        if self.answers != Some(false) {
            self.unanswered.push_back(now);
        }
    }

    /// Notes that a status request was answered.
    pub fn answered(&mut self, now: Instant) {
        self.answers = Some(true);
        let sent = self.unanswered.pop_front();
        if self.late > 0 {
            // Perhaps the answer to one that is no longer waited for: it tells nothing of the time.
            self.late -= 1;
        } else if let Some(sent) = sent {
            let took = now.saturating_duration_since(sent);
            self.latest = Some(took);
            self.shortest = Some(self.shortest.map_or(took, |shortest| shortest.min(took)));
        }
    }

    /// Waits no longer for what was sent: the terminal was in other hands.
    pub fn forget(&mut self) {
        self.unanswered.clear();
        self.late = 0;
    }

    /// How many updates may be on their way: a second one only where the way takes longer than the bytes.
    /// Where the bytes take longer, it would only wait behind the first, and be older when it is shown.
    fn limit(&self) -> usize {
        match (self.shortest, self.latest) {
            (Some(shortest), Some(latest)) if shortest > latest / 2 => 2,
            _ => 1,
        }
    }

    fn patience(&self) -> Duration {
        match self.answers {
            Some(true) => PATIENCE,
            _ => FIRST_PATIENCE,
        }
    }

    fn give_up(&mut self, now: Instant) {
        let patience = self.patience();
        if self.unanswered.front().is_some_and(|&oldest| oldest + patience <= now) {
            self.late += self.unanswered.len();
            self.unanswered.clear();
            self.answers.get_or_insert(false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of a picture.
    const PICTURE: usize = 2_500;

    /// A link that takes `way` to and fro and `each` for the bytes of a picture; how many are shown in ten
    /// seconds if there is always a new one, and how old the oldest is when it is shown.
    fn run(mut pacing: Pacing, way: u64, each: u64, answers: bool) -> (usize, u64) {
        let begin = Instant::now();
        let at = |ms: u64| begin + Duration::from_millis(ms);
        let (mut shown, mut oldest, mut free) = (0, 0, 0);
        let mut on_their_way: VecDeque<u64> = VecDeque::new();
        for ms in 0..10_000 {
            while on_their_way.pop_front_if(|arrives| *arrives <= ms).is_some() {
                pacing.answered(at(ms));
            }
            if pacing.is_open(at(ms)) {
                pacing.begin(at(ms));
                free = free.max(ms) + each;
                oldest = oldest.max(free + way / 2 - ms);
                shown += usize::from(free + way / 2 < 10_000);
                pacing.sent(at(ms), PICTURE);
                if answers {
                    on_their_way.push_back(free + way);
                }
            }
        }
        (shown, oldest)
    }

    /// A pacing that knows what the way takes without a load, as after the first question.
    fn asked(way: u64) -> Pacing {
        let mut pacing = Pacing::default();
        pacing.asked(Some(Duration::from_millis(way)), 0);
        pacing
    }

    #[test]
    fn a_thin_link_gets_fewer_pictures_and_never_old_ones() {
        // 80 kbit/s at 2.5 KB a picture.
        let (shown, oldest) = run(asked(20), 20, 250, true);
        assert!((36..=40).contains(&shown) && oldest <= 270, "{shown} {oldest}");
    }

    #[test]
    fn a_long_way_has_two_pictures_on_it() {
        let (shown, oldest) = run(asked(300), 300, 2, true);
        assert!((60..=67).contains(&shown) && oldest <= 160, "{shown} {oldest}");
    }

    #[test]
    fn a_ceiling_of_bytes_is_kept() {
        let mut pacing = asked(1);
        pacing.set_ceiling(Some(10_000.0));
        assert_eq!(run(pacing, 1, 1, true).0, 40);
        let mut first = asked(1);
        first.set_ceiling(Some(1_000.0));
        let now = Instant::now();
        first.sent(now, 5_000);
        first.answered(now);
        assert_eq!(first.opens(), Some(now + Duration::from_secs(5)));
    }

    #[test]
    fn a_near_terminal_is_never_waited_for_long() {
        assert!(run(asked(1), 1, 1, true).0 >= 3_000);
    }

    #[test]
    fn through_a_relay_pictures_are_capped_though_it_answers_at_once() {
        let mut pacing = asked(1);
        pacing.set_relayed(true);
        assert_eq!(run(pacing, 1, 0, true).0, 200);
    }

    #[test]
    fn a_terminal_that_never_answers_gets_ten_pictures_a_second() {
        let (shown, _) = run(Pacing::default(), 10, 0, false);
        assert_eq!(shown, 1 + 90, "one, a second of waiting, then ten a second");
    }

    #[test]
    fn a_lost_answer_stops_nothing_for_ever_and_tells_nothing_of_the_time() {
        let begin = Instant::now();
        let at = |ms: u64| begin + Duration::from_millis(ms);
        let mut pacing = asked(300);
        pacing.sent(begin, PICTURE);
        pacing.answered(at(310));
        pacing.sent(begin, PICTURE);
        pacing.sent(begin, PICTURE);
        assert!(!pacing.is_open(at(4_999)));
        assert_eq!(pacing.opens(), Some(at(5_000)));
        assert!(pacing.is_open(at(5_000)));
        pacing.sent(at(5_000), PICTURE);
        pacing.answered(at(5_001));
        assert_eq!(pacing.latest, Some(Duration::from_millis(310)));
    }

    #[test]
    fn one_that_begins_to_answer_is_believed() {
        let begin = Instant::now();
        let at = |ms: u64| begin + Duration::from_millis(ms);
        let mut pacing = Pacing::default();
        pacing.sent(begin, PICTURE);
        assert!(pacing.is_open(at(1_000)));
        pacing.begin(at(1_000));
        assert!(!pacing.is_open(at(1_050)) && pacing.is_open(at(1_100)));
        pacing.answered(at(1_200));
        pacing.begin(at(1_200));
        assert!(pacing.is_open(at(1_200)), "no cap");
    }

    #[test]
    fn nothing_on_its_way_is_not_waited_for() {
        let mut pacing = asked(300);
        assert_eq!(pacing.opens(), None);
        pacing.sent(Instant::now(), PICTURE);
        pacing.forget();
        assert_eq!(pacing.opens(), None);
    }
}

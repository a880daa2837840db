//! How long a picture takes.

use std::time::{Duration, Instant};

use crate::frame::{Frame, Request, Studio};

/// How long a measurement goes on: until both are reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Pictures, 1 or more; of 0 one is drawn all the same.
    pub pictures: usize,
    /// The time of all of them.
    pub time: Duration,
}

impl Default for Effort {
    /// Enough pictures for a median, and long enough for a clock.
    fn default() -> Self {
        Self { pictures: 5, time: Duration::from_millis(600) }
    }
}

/// How long each picture of several took.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Ascending.
    times: Vec<Duration>,
}

impl Times {
    /// Takes in the time of one more picture.
    pub fn push(&mut self, time: Duration) {
        let place = self.times.partition_point(|other| *other <= time);
        self.times.insert(place, time);
    }

    /// Takes in the times of more pictures.
    pub fn extend(&mut self, times: impl IntoIterator<Item = Duration>) {
        times.into_iter().for_each(|time| self.push(time));
    }

    /// The time of each picture, ascending.
    pub fn all(&self) -> &[Duration] {
        &self.times
    }

    /// All of them together.
    pub fn sum(&self) -> Duration {
        self.times.iter().sum()
    }

    /// The shortest, 0 of none: what the picture takes on a machine that does nothing else.
    pub fn least(&self) -> Duration {
        self.times.first().copied().unwrap_or_default()
    }

    /// The one in the middle, 0 of none; of an even number the later of the two.
    pub fn median(&self) -> Duration {
        self.times.get(self.times.len() / 2).copied().unwrap_or_default()
    }

    /// The spread: between which two times the middle half of the pictures lies. Of fewer than four, all.
    pub fn middle_half(&self) -> [Duration; 2] {
        let quarter = self.times.len() / 4;
        let last = self.times.len().saturating_sub(1 + quarter);
        [quarter, last].map(|place| self.times.get(place).copied().unwrap_or_default())
    }

    /// Half the width of the middle half: what is told behind ±.
    pub fn spread(&self) -> Duration {
        let [low, high] = self.middle_half();
        high.saturating_sub(low) / 2
    }
}

/// The times of one picture, drawn again and again.
#[derive(Clone, Debug)]
pub struct Timing {
    /// One at least.
    times: Times,
    /// The last of the pictures.
    pub frame: Frame,
}

impl Timing {
    /// Draws a picture with all its rays as often as the effort wants. What is built once, the structure that
    /// cuts space and the pool of threads, is built before.
    pub fn new(studio: &Studio, request: &Request, effort: Effort) -> Self {
        let mut frame = studio.draw(request);
        let mut times = Times::default();
        let start = Instant::now();
        while times.all().len() < effort.pictures.max(1) || start.elapsed() < effort.time {
            // The studio draws the next into its memory.
            drop(frame);
            frame = studio.draw_anew(request);
            times.push(frame.total);
        }
        Self { times, frame }
    }

    /// The time of each picture, ascending; one at least.
    pub fn times(&self) -> &[Duration] {
        self.times.all()
    }

    /// The shortest: what the picture takes on a machine that does nothing else.
    pub fn least(&self) -> Duration {
        self.times.least()
    }

    /// The one in the middle; of an even number the later of the two.
    pub fn median(&self) -> Duration {
        self.times.median()
    }

    /// Rays of all kinds in a second, by the median.
    pub fn rays_per_second(&self) -> f64 {
        self.frame.counts.rays() as f64 / self.median().as_secs_f64()
    }
}

/// The most memory that the process has held, in bytes, where the system tells: Linux does, by `VmHWM` of
/// proc(5).
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Wants;
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::Size;
    use crate::plan::Options;
    use crate::scene::{self, ReadOptions};
    use crate::tone::Tone;

    #[test]
    fn times_are_told_by_their_middle() {
        let mut times = Times::default();
        assert_eq!((times.median(), times.middle_half()), (Duration::ZERO, [Duration::ZERO; 2]));
        for ms in [9, 1, 5, 100, 4, 6, 7, 8] {
            times.push(Duration::from_millis(ms));
        }
        assert_eq!([times.least(), times.median(), times.sum()], [1, 7, 140].map(Duration::from_millis));
        assert_eq!(times.middle_half(), [5, 8].map(Duration::from_millis));
        assert_eq!(times.spread(), Duration::from_micros(1_500));
    }

    #[test]
    fn a_picture_is_drawn_as_often_as_wanted() {
        let scene = scene::read("ball", b"sphere(1);", &ReadOptions::default()).unwrap();
        let studio = Studio::new(scene).unwrap();
        let request = Request {
            camera: studio.camera(0, 1.0),
            dots: Size::new(8, 8),
            dot_aspect: 1.0,
            options: Options::default(),
            wants: Wants::LIGHT,
            glyphs: GlyphMode::Blocks,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        };
        for (pictures, drawn) in [(0, 1), (1, 1), (4, 4)] {
            let timing = Timing::new(&studio, &request, Effort { pictures, time: Duration::ZERO });
            assert_eq!(timing.times().len(), drawn);
            assert!(timing.least() > Duration::ZERO && timing.least() <= timing.median());
            // Every picture is traced, though it is the same.
            assert_eq!(timing.frame.counts.primary_rays, 64);
        }
    }
}

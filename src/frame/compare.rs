//! How far two pictures of the same dots are apart: what changed, and whether anyone would see it.

use std::fmt;

use thiserror::Error;

use crate::math::{DVec3, Grid, Size};
use crate::tone::{Level, Tone, lightness};

use super::Frame;

/// A twelfth of white's CIE L*, 100: from a level to the next in the mean, though the 13 levels are not
/// evenly spaced.
const TWELFTH: f64 = 100.0 / 12.0;

/// How far a picture is from a reference. What one of the two does not hold is not compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Dots compared: all of a picture.
    pub dots: usize,
    /// Dots of which any number differs in any bit, be it light, colour, depth, normal or object.
    pub changed: usize,
    /// The first of them in scan order: column and row.
    pub first: Option<[u32; 2]>,
    /// Dots that show another object, or nothing where the reference shows one, or the other way round.
    pub objects: Option<usize>,
    /// The largest difference of two depths, as a share of the reference's, 0 or more, among the dots where,
    /// as far as that is known, both see the same object. Infinite where only one sees anything, where one is
    /// not a number, and where the reference's is 0 and the other is not.
    pub depth: Option<f64>,
    /// The largest difference of two lights, 0 to 12, in twelfths of white's CIE L*: a level in the mean.
    /// Light is clamped to 0 to 1 before, as a screen does.
    pub light: f64,
    /// The root of the mean of the squares of these differences.
    pub light_rms: f64,
    /// Dots that the 13 gray levels show differently ([`Tone::Lightness`]).
    pub levels: usize,
    /// Cells with another character, ink or paper.
    pub cells: Option<usize>,
}

/// Two pictures of which one has other dots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "a picture of {} × {} dots cannot be compared with one of {} × {}",
    picture.width, picture.height, reference.width, reference.height
)]
pub struct OtherDots {
    /// The dots of the one.
    pub picture: Size,
    /// The dots of the other.
    pub reference: Size,
}

impl Frame {
    /// How far this picture is from `reference`.
    ///
    /// # Errors
    /// The two have not the same number of dots across and down.
    pub fn compare(&self, reference: &Self) -> Result<Comparison, OtherDots> {
        let size = reference.light.size();
        if self.light.size() != size {
            return Err(OtherDots { picture: self.light.size(), reference: size });
        }
        let objects = both(self.object.as_deref(), reference.object.as_deref());
        let depths = both(self.depth.as_deref(), reference.depth.as_deref());
        let shows_another = |dot: usize| objects.is_some_and(|(own, other)| own[dot] != other[dot]);
        let dots = 0..size.area();
        let (mut light, mut squares) = (0.0_f64, 0.0);
        let (mut levels, mut changed, mut first) = (0, 0, None);
        for dot in dots.clone() {
            let [own, other] = [self, reference].map(|frame| frame.light.values()[dot]);
            let apart = (shown_lightness(own) - shown_lightness(other)).abs() / TWELFTH;
            light = light.max(apart);
            squares += apart * apart;
            levels += usize::from(level(own) != level(other));
            if self.differs(reference, dot) {
                changed += 1;
                first = first.or(Some([dot as u32 % size.width, dot as u32 / size.width]));
            }
        }
        let depth = depths.map(|(own, other)| {
            let pairs = dots.clone().filter(|&dot| !shows_another(dot)).map(|dot| (own[dot], other[dot]));
            pairs.map(|(own, other)| share(own, other)).fold(0.0, f64::max)
        });
        let cells = match (&self.cells, &reference.cells) {
            (Some(own), Some(other)) if own.size() == other.size() => {
                Some(own.values().iter().zip(other.values()).filter(|(own, other)| own != other).count())
            }
            // Other cells over the same dots: all of them differ.
            (Some(own), Some(_)) => Some(own.size().area()),
            _ => None,
        };
        Ok(Comparison {
            dots: size.area(),
            changed,
            first,
            objects: objects.map(|_| dots.filter(|&dot| shows_another(dot)).count()),
            depth,
            light,
            light_rms: (squares / size.area().max(1) as f64).sqrt(),
            levels,
            cells,
        })
    }

    /// Whether any number of a dot differs in any bit.
    fn differs(&self, other: &Self, dot: usize) -> bool {
        let vectors = |own: Option<&Grid<DVec3>>, other: Option<&Grid<DVec3>>| {
            both(own, other).is_some_and(|(own, other)| {
                own[dot].to_array().map(f64::to_bits) != other[dot].to_array().map(f64::to_bits)
            })
        };
        let numbers = |own: Option<&Grid<f64>>, other: Option<&Grid<f64>>| {
            both(own, other).is_some_and(|(own, other)| own[dot].to_bits() != other[dot].to_bits())
        };
        numbers(Some(&self.light), Some(&other.light))
            || numbers(self.depth.as_deref(), other.depth.as_deref())
            || vectors(self.color.as_deref(), other.color.as_deref())
            || vectors(self.normal.as_deref(), other.normal.as_deref())
            || both(self.object.as_deref(), other.object.as_deref())
                .is_some_and(|(own, other)| own[dot] != other[dot])
    }
}

impl Comparison {
    /// Whether all that both hold is the same to the bit.
    pub const fn is_same(&self) -> bool {
        self.changed == 0 && matches!(self.cells, None | Some(0))
    }
}

/// One line: what differs, and how far.
impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_same() {
            return write!(f, "the same {} dots", self.dots);
        }
        write!(f, "{} of {} dots differ", self.changed, self.dots)?;
        if let Some([column, row]) = self.first {
            write!(f, ", the first in column {column} of row {row}")?;
        }
        if let Some(objects) = self.objects {
            write!(f, "; {objects} show another object")?;
        }
        if let Some(depth) = self.depth {
            write!(f, "; depths by up to {depth:.1e} of theirs")?;
        }
        write!(
            f,
            "; light by up to {:.2} twelfths of L*, {:.3} in the mean (RMS)",
            self.light, self.light_rms
        )?;
        write!(f, "; {} in another level", self.levels)?;
        if let Some(cells) = self.cells {
            write!(f, "; {cells} cells")?;
        }
        Ok(())
    }
}

/// The values of two grids, where both are there.
fn both<'a, T>(own: Option<&'a Grid<T>>, other: Option<&'a Grid<T>>) -> Option<(&'a [T], &'a [T])> {
    Some((own?.values(), other?.values()))
}

/// NaN, which no stage gives, is shown as no light.
fn shown_lightness(light: f64) -> f64 {
    lightness(if light.is_nan() { 0.0 } else { light.clamp(0.0, 1.0) })
}

fn level(light: f64) -> Level {
    Tone::Lightness.level(light)
}

/// The difference as a share of the other; 0 for equals, also at 0 and where both are infinite or no numbers.
fn share(own: f64, other: f64) -> f64 {
    if own == other || (own.is_nan() && other.is_nan()) {
        return 0.0;
    }
    let share = (own - other).abs() / other.abs();
    if share.is_nan() { f64::INFINITY } else { share }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::frame::{Request, Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::plan::Options;
    use crate::scene::{self, ReadOptions};

    fn frame(dots: Size) -> Frame {
        let scene = scene::read("ball", b"sphere(1);", &ReadOptions::default()).unwrap();
        let studio = Studio::new(scene).unwrap();
        studio.draw(&Request {
            camera: studio.camera(0, 1.0),
            dots,
            dot_aspect: 1.0,
            options: Options::default(),
            wants: Wants::ALL,
            glyphs: GlyphMode::Blocks,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        })
    }

    const DOTS: Size = Size::new(16, 16);

    #[test]
    fn a_picture_is_no_way_from_itself() {
        let frame = frame(DOTS);
        let comparison = frame.compare(&frame).unwrap();
        assert!(comparison.is_same());
        assert_eq!((comparison.light, comparison.light_rms, comparison.levels), (0.0, 0.0, 0));
        assert_eq!((comparison.objects, comparison.depth, comparison.cells), (Some(0), Some(0.0), Some(0)));
        assert_eq!(comparison.to_string(), "the same 256 dots");
    }

    #[test]
    fn what_differs_is_counted_and_measured() {
        let reference = frame(DOTS);
        let mut other = reference.clone();
        let middle = 8 * 16 + 8;
        // A level lighter, twice as far away and another object; and one dot off by one bit.
        let lights = Arc::make_mut(&mut other.light).values_mut();
        let own = Level::nearest(lights[middle]);
        lights[middle] = Level::new(own.get() - 1).unwrap().light();
        lights[0] = f64::from_bits(lights[0].to_bits() ^ 1);
        Arc::make_mut(other.object.as_mut().unwrap()).values_mut()[middle] = 7;
        Arc::make_mut(other.depth.as_mut().unwrap()).values_mut()[middle + 1] *= 1.5;
        let comparison = other.compare(&reference).unwrap();
        assert!(!comparison.is_same());
        assert_eq!((comparison.changed, comparison.first), (3, Some([0, 0])));
        assert_eq!((comparison.objects, comparison.levels, comparison.cells), (Some(1), 1, Some(0)));
        assert!((comparison.depth.unwrap() - 0.5).abs() < 1e-12, "{comparison}");
        assert!((0.5..1.5).contains(&comparison.light), "{comparison}");
        assert!((comparison.light_rms - comparison.light / 16.0).abs() < 1e-12, "{comparison}");
    }

    #[test]
    fn depths_that_are_no_numbers_are_far_off() {
        for (own, other, expected) in [
            (f64::NAN, 5.0, f64::INFINITY),
            (5.0, f64::NAN, f64::INFINITY),
            (5.0, f64::INFINITY, f64::INFINITY),
            (f64::INFINITY, 5.0, f64::INFINITY),
            (f64::INFINITY, f64::INFINITY, 0.0),
            (f64::NAN, f64::NAN, 0.0),
            (0.0, 0.0, 0.0),
            (6.0, 5.0, 0.2),
        ] {
            assert!(
                share(own, other) == expected || (share(own, other) - expected).abs() < 1e-12,
                "{own} {other}"
            );
        }
    }

    #[test]
    fn what_one_lacks_is_not_compared() {
        let reference = frame(DOTS);
        let bare = Frame { cells: None, depth: None, normal: None, object: None, ..reference.clone() };
        let comparison = bare.compare(&reference).unwrap();
        assert!(comparison.is_same());
        assert_eq!((comparison.objects, comparison.depth, comparison.cells), (None, None, None));
        let error = frame(Size::new(8, 16)).compare(&reference).unwrap_err();
        assert_eq!(error.to_string(), "a picture of 8 × 16 dots cannot be compared with one of 16 × 16");
    }
}

//! The data of a `path`: commands and numbers, as lines from place to place.

use super::curves::{Arc, bezier};
use super::scan::TextScan;
use crate::math::DVec2;

/// A line that a pen draws without being lifted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stroke {
    pub places: Vec<DVec2>,
    /// Whether a command closes it.
    pub is_closed: bool,
}

/// Draws what commands say.
struct Pen {
    strokes: Vec<Stroke>,
    at: DVec2,
    /// The last control point of the curve that was drawn last, and its degree.
    pulled: Option<(DVec2, u32)>,
    /// How many corners more there may be.
    room: usize,
}

/// Why data is not drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoPath {
    /// What is wrong with it.
    Wrong(String),
    /// It has more corners than there may be.
    TooMany,
}

/// The strokes of path data, of `room` corners at most.
pub fn strokes(data: &str, room: usize) -> Result<Vec<Stroke>, NoPath> {
    let mut pen = Pen { strokes: Vec::new(), at: DVec2::ZERO, pulled: None, room };
    let mut scan = TextScan::of(data);
    let mut command = None;
    while !scan.is_empty() {
        let next = scan.letter(|letter| letter.is_ascii_alphabetic());
        let Some(letter) = next.or(command) else {
            return Err(expected("a command", &scan));
        };
        pen.draw(letter, &mut scan)?;
        // Places without a command go on with lines after a move, and with the same otherwise.
        command = match letter {
            'M' => Some('L'),
            'm' => Some('l'),
            'z' | 'Z' => None,
            _ => Some(letter),
        };
    }
    pen.strokes.retain(|stroke| !stroke.places.is_empty());
    Ok(pen.strokes)
}

impl Pen {
    fn draw(&mut self, command: char, scan: &mut TextScan<'_>) -> Result<(), NoPath> {
        let from = self.at;
        let base = if command.is_ascii_lowercase() { from } else { DVec2::ZERO };
        let mut pulled = None;
        match command.to_ascii_uppercase() {
            'Z' => self.close(),
            'M' => {
                self.at = base + pair(scan)?;
                self.strokes.push(Stroke::default());
                self.corner(self.at)?;
            }
            'L' => self.line(base + pair(scan)?)?,
            'H' => self.line(DVec2::new(base.x + number(scan)?, from.y))?,
            'V' => self.line(DVec2::new(from.x, base.y + number(scan)?))?,
            letter @ ('C' | 'S') => {
                let first = if letter == 'C' { base + pair(scan)? } else { self.mirrored(3) };
                let second = base + pair(scan)?;
                self.curve(&[from, first, second, base + pair(scan)?])?;
                pulled = Some((second, 3));
            }
            letter @ ('Q' | 'T') => {
                let by = if letter == 'Q' { base + pair(scan)? } else { self.mirrored(2) };
                self.curve(&[from, by, base + pair(scan)?])?;
                pulled = Some((by, 2));
            }
            'A' => {
                let (radii, turn) = (pair(scan)?.abs(), number(scan)?);
                let (is_large, is_forward) = (flag(scan)?, flag(scan)?);
                let to = base + pair(scan)?;
                let arc = Arc { from, to, radii, turn, is_large, is_forward };
                if radii.min_element() > 0.0 && from != to {
                    arc.corners().into_iter().skip(1).try_for_each(|place| self.line(place))?;
                } else {
                    self.line(to)?;
                }
            }
            _ => return Err(NoPath::Wrong(format!("`{command}` is no command of a path"))),
        }
        self.pulled = pulled;
        Ok(())
    }

    /// The control point of a curve that goes on smoothly from one of the same degree.
    fn mirrored(&self, degree: u32) -> DVec2 {
        match self.pulled {
            Some((pulled, of)) if of == degree => 2.0 * self.at - pulled,
            _ => self.at,
        }
    }

    fn curve(&mut self, points: &[DVec2]) -> Result<(), NoPath> {
        bezier(points).try_for_each(|place| self.line(place))
    }

    fn line(&mut self, to: DVec2) -> Result<(), NoPath> {
        if self.strokes.last().is_none_or(|stroke| stroke.is_closed) {
            // What goes on after the end of a closed line begins where that did.
            self.strokes.push(Stroke::default());
            self.corner(self.at)?;
        }
        self.at = to;
        self.corner(to)
    }

    fn corner(&mut self, place: DVec2) -> Result<(), NoPath> {
        if !place.is_finite() {
            return Err(NoPath::Wrong("a path reaches farther than a 64-bit float does".to_owned()));
        }
        self.room = self.room.checked_sub(1).ok_or(NoPath::TooMany)?;
        if let Some(stroke) = self.strokes.last_mut() {
            stroke.places.push(place);
        }
        Ok(())
    }

    fn close(&mut self) {
        if let Some(stroke) = self.strokes.last_mut() {
            stroke.is_closed = true;
            self.at = stroke.places.first().copied().unwrap_or(self.at);
        }
    }
}

fn number(scan: &mut TextScan<'_>) -> Result<f64, NoPath> {
    match scan.number() {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(NoPath::Wrong("a number in a path is not finite".to_owned())),
        None => Err(expected("a number", scan)),
    }
}

fn pair(scan: &mut TextScan<'_>) -> Result<DVec2, NoPath> {
    Ok(DVec2::new(number(scan)?, number(scan)?))
}

fn flag(scan: &mut TextScan<'_>) -> Result<bool, NoPath> {
    scan.flag().ok_or_else(|| expected("0 or 1", scan))
}

fn expected(what: &str, scan: &TextScan<'_>) -> NoPath {
    NoPath::Wrong(if scan.is_empty() {
        format!("a path ends where {what} should be")
    } else {
        format!("a path has `{}` where {what} should be", scan.shown())
    })
}

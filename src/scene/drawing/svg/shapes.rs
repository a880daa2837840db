//! The elements of an SVG file that are drawn, as outlines in coordinates of their own.

use std::borrow::Cow;

use super::curves::{Arc, ellipse};
use super::path_data::{NoPath, strokes};
use super::scan::TextScan;
use crate::math::DVec2;
use crate::scene::profile::{LineEnd, stroked};
use crate::scene::xml::{XmlElement, XmlError};

/// Of a stroke whose ends are farther apart, OpenSCAD takes the line itself, and not what is inside.
const OPEN: f64 = 0.1;

/// A thinner line counts as one of width 1.
const THINNEST: f64 = 0.01;

/// Why an element is not drawn.
#[derive(Debug)]
pub enum NoShape {
    Xml(XmlError),
    Path(NoPath),
    /// Its line crosses itself too often.
    Tangled,
}

impl From<XmlError> for NoShape {
    fn from(error: XmlError) -> Self {
        Self::Xml(error)
    }
}

impl From<NoPath> for NoShape {
    fn from(why: NoPath) -> Self {
        Self::Path(why)
    }
}

/// An element that may be drawn.
pub struct SvgShape<'e, 'a> {
    element: &'e XmlElement<'a>,
    /// How many corners it may have.
    room: usize,
    /// Lengths that count as 0, since they have units.
    pub with_units: Vec<String>,
}

impl<'e, 'a> SvgShape<'e, 'a> {
    pub fn new(element: &'e XmlElement<'a>, room: usize) -> Self {
        Self { element, room, with_units: Vec::new() }
    }

    /// Its outlines; what an odd number of them lie around is inside. None of an element that is not drawn.
    pub fn outlines(&mut self) -> Result<Option<Vec<Vec<DVec2>>>, NoShape> {
        Ok(Some(match self.element.name() {
            "rect" => vec![self.rectangle()?],
            "circle" => {
                let radius = self.length("r")?;
                vec![ellipse(self.place("cx", "cy")?, DVec2::splat(radius))]
            }
            "ellipse" => {
                let radii = self.place("rx", "ry")?;
                vec![ellipse(self.place("cx", "cy")?, radii)]
            }
            "line" => {
                let ends = vec![self.place("x1", "y1")?, self.place("x2", "y2")?];
                self.stroked(&ends)?
            }
            "polyline" => {
                let points = self.points()?;
                self.stroked(&points)?
            }
            "polygon" => vec![self.points()?],
            "path" => self.path()?,
            _ => return Ok(None),
        }))
    }

    fn text(&self, name: &str) -> Result<Cow<'e, str>, XmlError> {
        Ok(self.element.attribute(name)?.unwrap_or_default())
    }

    /// A length in the file's own units; 0 where it is not given, or is none.
    fn length(&mut self, name: &str) -> Result<f64, XmlError> {
        let text = self.text(name)?;
        let mut scan = TextScan::of(&text);
        let number = scan.number().filter(|number| number.is_finite());
        if !scan.is_empty() || (number.is_none() && !text.is_empty()) {
            self.with_units.push(text.chars().take(20).collect());
            return Ok(0.0);
        }
        Ok(number.unwrap_or(0.0))
    }

    fn place(&mut self, x: &str, y: &str) -> Result<DVec2, XmlError> {
        Ok(DVec2::new(self.length(x)?, self.length(y)?))
    }

    fn points(&self) -> Result<Vec<DVec2>, NoShape> {
        let text = self.text("points")?;
        let mut scan = TextScan::of(&text);
        let mut points = Vec::new();
        let wrong = |scan: &TextScan<'_>| {
            NoPath::Wrong(format!("`points` has `{}` where a number should be", scan.shown()))
        };
        while !scan.is_empty() {
            let x = scan.number().filter(|x| x.is_finite()).ok_or_else(|| wrong(&scan))?;
            // As the standard has it, a number that is left over is none.
            if scan.is_empty() {
                break;
            }
            let y = scan.number().filter(|y| y.is_finite()).ok_or_else(|| wrong(&scan))?;
            if points.len() == self.room {
                return Err(NoPath::TooMany.into());
            }
            points.push(DVec2::new(x, y));
        }
        Ok(points)
    }

    fn rectangle(&mut self) -> Result<Vec<DVec2>, XmlError> {
        let (low, size) = (self.place("x", "y")?, self.place("width", "height")?);
        let radii = self.place("rx", "ry")?;
        // One stands for both.
        let radii = match radii.to_array() {
            [x, 0.0] => DVec2::splat(x),
            [0.0, y] => DVec2::splat(y),
            _ => radii,
        };
        let radii = radii.min(size * 0.5);
        let high = low + size;
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        if radii.min_element() <= 0.0 {
            return Ok(corners.to_vec());
        }
        let inward = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let rounded = (0..4).flat_map(|i| {
            let step = DVec2::from(inward[i]) * radii;
            let ends = [corners[i] + DVec2::new(step.x, 0.0), corners[i] + DVec2::new(0.0, step.y)];
            let [from, to] = if i % 2 == 0 { [ends[1], ends[0]] } else { ends };
            Arc { from, to, radii, turn: 0.0, is_large: false, is_forward: true }.corners()
        });
        Ok(rounded.collect())
    }

    fn path(&self) -> Result<Vec<Vec<DVec2>>, NoShape> {
        let strokes = strokes(&self.text("d")?, self.room)?;
        let any_closed = strokes.iter().any(|stroke| stroke.is_closed);
        let last = strokes.len();
        let mut outlines = Vec::new();
        for (number, stroke) in strokes.into_iter().enumerate() {
            let [first, .., end] = stroke.places[..] else { continue };
            // As OpenSCAD has it, one that is closed keeps the last from being a line.
            let is_line = !stroke.is_closed && (!any_closed || number + 1 < last);
            if is_line && (end - first).length() > OPEN {
                outlines.extend(self.stroked(&stroke.places)?);
            } else {
                outlines.push(stroke.places);
            }
        }
        Ok(outlines)
    }

    /// The outlines of a line as wide as it is drawn.
    fn stroked(&self, line: &[DVec2]) -> Result<Vec<Vec<DVec2>>, NoShape> {
        let width = self.style("stroke-width")?;
        let mut scan = TextScan::of(&width);
        let width = scan.number().filter(|&width| width >= THINNEST && width.is_finite() && scan.is_empty());
        let end = match &*self.style("stroke-linecap")? {
            "butt" => LineEnd::Flat,
            "round" => LineEnd::Round,
            _ => LineEnd::Square,
        };
        stroked(line, width.unwrap_or(1.0), end).map_err(|_| NoShape::Tangled)
    }

    /// A property, as an attribute or in `style`.
    fn style(&self, name: &str) -> Result<Cow<'e, str>, XmlError> {
        let own = self.text(name)?;
        if !own.is_empty() {
            return Ok(own);
        }
        let style = self.text("style")?;
        // As OpenSCAD has it, blanks count.
        let mut pairs = style.split(';').filter_map(|pair| pair.split_once(':'));
        let value = pairs.find(|(own, _)| *own == name).map(|(_, value)| value.to_owned());
        Ok(Cow::Owned(value.unwrap_or_default()))
    }
}

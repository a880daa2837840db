//! SVG, as far as OpenSCAD reads it: shapes, in groups that move them. What fills them, and what hides them,
//! is of no account.

mod curves;
mod page;
mod path_data;
mod scan;
mod shapes;
mod transform;

use std::collections::BTreeMap;

use self::page::{Page, PageText};
use self::path_data::NoPath;
use self::shapes::{NoShape, SvgShape};
use self::transform::transform;
use super::{DrawingContent, DrawingFault, DrawingRequest};
use crate::math::{DAffine2, DVec2};
use crate::scene::profile::MOST_CORNERS;
use crate::scene::xml::{XmlElement, XmlError, XmlEvent, XmlText};

/// An element that is open.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// From its coordinates to those of the page.
    map: DAffine2,
    /// Whether it is, or is part of, what is wanted of the file.
    is_wanted: bool,
    /// Whether what it holds is not drawn.
    is_hidden: bool,
}

/// Reads a file.
pub fn read(bytes: &[u8], request: &DrawingRequest) -> Result<DrawingContent, DrawingFault> {
    let reader = Reader {
        bytes,
        request,
        page: Page::default(),
        shapes: Vec::new(),
        count: 0,
        any_wanted: false,
        left_out: BTreeMap::new(),
        with_units: Vec::new(),
    };
    reader.read()
}

struct Reader<'r> {
    bytes: &'r [u8],
    request: &'r DrawingRequest,
    page: Page,
    /// By shape: its outlines, in coordinates of the page.
    shapes: Vec<Vec<Vec<DVec2>>>,
    /// How many corners they have.
    count: usize,
    any_wanted: bool,
    /// What is not read, and how often.
    left_out: BTreeMap<String, usize>,
    /// The first few lengths that have a unit.
    with_units: Vec<String>,
}

impl Reader<'_> {
    fn read(mut self) -> Result<DrawingContent, DrawingFault> {
        let is_all = self.request.layer.is_empty() && self.request.id.is_empty();
        let mut levels = vec![Level { map: DAffine2::IDENTITY, is_wanted: is_all, is_hidden: false }];
        let text = XmlText::rooted(self.bytes, "svg").map_err(|error| self.told(error))?;
        let mut text = text.passing_doctype();
        loop {
            match text.next().map_err(|error| self.told(error))? {
                XmlEvent::Open(element) => {
                    let above = levels[levels.len() - 1];
                    levels.push(self.open(&element, above)?);
                }
                XmlEvent::Close(_) => {
                    levels.pop();
                }
                XmlEvent::Text(_) => {}
                XmlEvent::End => return self.drawing(is_all),
            }
        }
    }

    /// Takes an element within another.
    fn open(&mut self, element: &XmlElement<'_>, above: Level) -> Result<Level, DrawingFault> {
        let mut level = above;
        let name = element.name();
        if !above.is_wanted {
            level.is_wanted = self.is_asked_for(element).map_err(|error| self.told(error))?;
            self.any_wanted |= level.is_wanted;
        }
        // What is only referred to; OpenSCAD 2021.01 does not follow.
        level.is_hidden |= name == "defs";
        if level.is_hidden {
            return Ok(level);
        }
        match name {
            "svg" => {
                let text = |name| {
                    let value = element.attribute(name).map_err(|error| self.told(error));
                    value.map(Option::unwrap_or_default)
                };
                let [width, height, view_box, aspect_ratio] =
                    [text("width")?, text("height")?, text("viewBox")?, text("preserveAspectRatio")?];
                let (width, height, view_box, aspect_ratio) = (&*width, &*height, &*view_box, &*aspect_ratio);
                self.page = Page::of(PageText { width, height, view_box, aspect_ratio }, self.request.dpi);
            }
            "g" => level.map = above.map * self.transform(element)?,
            "use" | "text" | "image" => *self.left_out.entry(name.to_owned()).or_default() += 1,
            _ if level.is_wanted => self.draw(element, above.map)?,
            _ => {}
        }
        Ok(level)
    }

    /// Whether an element is the one that is asked for.
    fn is_asked_for(&self, element: &XmlElement<'_>) -> Result<bool, XmlError> {
        let has = |name: &str, value: &str| -> Result<bool, XmlError> {
            Ok(element.attribute(name)?.is_some_and(|own| own == value))
        };
        let DrawingRequest { id, layer, .. } = self.request;
        // A layer is a group to which Inkscape has given a name.
        Ok((!id.is_empty() && has("id", id)?)
            || (!layer.is_empty() && has("groupmode", "layer")? && has("label", layer)?))
    }

    fn transform(&self, element: &XmlElement<'_>) -> Result<DAffine2, DrawingFault> {
        let text = element.attribute("transform").map_err(|error| self.told(error))?;
        let Some(text) = text else { return Ok(DAffine2::IDENTITY) };
        transform(&text).map_err(|why| self.at(element, why))
    }

    fn draw(&mut self, element: &XmlElement<'_>, above: DAffine2) -> Result<(), DrawingFault> {
        let too_many = || format!("the drawing has more than {MOST_CORNERS:e} corners");
        let room = (MOST_CORNERS as usize).saturating_sub(self.count);
        let mut shape = SvgShape::new(element, room);
        let outlines = shape.outlines().map_err(|why| match why {
            NoShape::Xml(error) => self.told(error),
            NoShape::Path(NoPath::Wrong(why)) => self.at(element, why),
            NoShape::Path(NoPath::TooMany) => self.at(element, too_many()),
            NoShape::Tangled => self.at(element, "a line crosses itself too often to be sorted out"),
        })?;
        self.with_units.extend(shape.with_units);
        self.with_units.truncate(3);
        let Some(mut outlines) = outlines else { return Ok(()) };
        let map = above * self.transform(element)?;
        self.count += outlines.iter().map(Vec::len).sum::<usize>();
        if self.count > MOST_CORNERS as usize {
            return Err(self.at(element, too_many()));
        }
        for place in outlines.iter_mut().flatten() {
            *place = map.transform_point2(*place);
            if !place.is_finite() {
                return Err(self.at(element, "this reaches farther than a 64-bit float does"));
            }
        }
        self.shapes.push(outlines);
        Ok(())
    }

    fn drawing(self, is_all: bool) -> Result<DrawingContent, DrawingFault> {
        let mut notes = Vec::new();
        if !is_all && !self.any_wanted {
            notes.push("nothing in it is of that `layer` or `id`".to_owned());
        }
        if !self.left_out.is_empty() {
            let list: Vec<String> =
                self.left_out.iter().map(|(name, count)| format!("{name} ({count})")).collect();
            notes.push(format!("what OpenSCAD does not read is left out: {}", list.join(", ")));
        }
        if let Some(first) = self.with_units.first() {
            notes.push(format!("a length that has a unit is 0, as in OpenSCAD: `{first}`"));
        }
        let places = || self.shapes.iter().flatten().flatten();
        let [low, high] = places()
            .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)]);
        let centre = (self.request.is_centred && low.x <= high.x).then(|| low * 0.5 + high * 0.5);
        let page = self.page;
        let mut shapes = self.shapes;
        for place in shapes.iter_mut().flatten().flatten() {
            *place = page.place(*place, centre);
            if !place.is_finite() {
                return Err(DrawingFault::whole("it reaches farther than a 64-bit float does"));
            }
        }
        Ok(DrawingContent { shapes, notes })
    }

    fn at(&self, element: &XmlElement<'_>, why: impl Into<String>) -> DrawingFault {
        DrawingFault::at(line(self.bytes, element.place.start), why)
    }

    fn told(&self, error: XmlError) -> DrawingFault {
        match error.place {
            Some(place) => DrawingFault::at(line(self.bytes, place.start), error.fault.to_string()),
            None => DrawingFault::whole(error.fault.to_string()),
        }
    }
}

/// The line of a place, from 1. A place begins with the blanks before it.
fn line(bytes: &[u8], place: usize) -> usize {
    let (before, rest) = bytes.split_at(place.min(bytes.len()));
    let blanks = rest.iter().take_while(|byte| byte.is_ascii_whitespace());
    1 + before.iter().chain(blanks).filter(|&&byte| byte == b'\n').count()
}

//! The page of an SVG file: where its units come to lie, in millimetres.

use super::scan::TextScan;
use crate::math::DVec2;

const MM_OF_INCH: f64 = 25.4;

/// How a file's own units become millimetres: as OpenSCAD has it, from the last `svg` element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    scale: DVec2,
    /// The first corner of the view box.
    corner: DVec2,
    /// How far the view box is moved within the page.
    shift: DVec2,
    height: f64,
}

impl Default for Page {
    fn default() -> Self {
        Self { scale: DVec2::ONE, corner: DVec2::ZERO, shift: DVec2::ZERO, height: 0.0 }
    }
}

/// The attributes of an `svg` element; what is not given is empty.
#[derive(Clone, Copy, Debug)]
pub struct PageText<'a> {
    pub width: &'a str,
    pub height: &'a str,
    pub view_box: &'a str,
    pub aspect_ratio: &'a str,
}

impl Page {
    /// Reads a page. A number without a unit is one of dots, of which `dpi` are an inch long.
    pub fn of(text: PageText<'_>, dpi: f64) -> Self {
        let view = view_box(text.view_box);
        let size = DVec2::new(
            millimetres(text.width, view.map(|[_, size]| size.x), dpi),
            millimetres(text.height, view.map(|[_, size]| size.y), dpi),
        );
        let Some([corner, own]) = view else { return Self { height: size.y, ..Self::default() } };
        let (mut scale, mut shift) = (size / own, DVec2::ZERO);
        if let Some((align, is_slice)) = alignment(text.aspect_ratio) {
            let one = if is_slice { scale.max_element() } else { scale.min_element() };
            scale = DVec2::splat(one);
            shift = align * (size - scale * own);
        }
        Self { scale, corner, shift, height: size.y }
    }

    /// The place of a place of the file, where its y goes up. `centre` is the middle of all that is drawn,
    /// where that comes to the origin.
    pub fn place(&self, p: DVec2, centre: Option<DVec2>) -> DVec2 {
        let at = match centre {
            Some(centre) => DVec2::new(-centre.x, centre.y) * self.scale,
            None => DVec2::new(self.shift.x, self.height - self.shift.y),
        };
        // Of the view box y is taken away twice, as in OpenSCAD.
        DVec2::new(p.x - self.corner.x, -p.y - self.corner.y) * self.scale + at
    }
}

/// A length in millimetres; `view` is as long as the view box. What is no length is as if it were not given.
fn millimetres(text: &str, view: Option<f64>, dpi: f64) -> f64 {
    let mut scan = TextScan::of(text);
    let number = scan.number();
    let unit = if scan.shown() == "%" { "%" } else { scan.word() };
    let is_whole = scan.is_empty() || unit == "%";
    let Some(number) = number.filter(|number| number.is_finite() && is_whole) else {
        return view.map_or(0.0, |view| MM_OF_INCH * view / dpi);
    };
    match unit {
        "" => MM_OF_INCH * number / dpi,
        "px" => MM_OF_INCH * number / 96.0,
        "pt" => MM_OF_INCH * number / 72.0,
        "pc" => MM_OF_INCH * number / 6.0,
        "in" => MM_OF_INCH * number,
        "cm" => 10.0 * number,
        "mm" => number,
        // A share of a page, or of letters, that nobody knows: a unit is a millimetre.
        "%" | "em" | "ex" => view.unwrap_or(0.0),
        _ => view.map_or(0.0, |view| MM_OF_INCH * view / dpi),
    }
}

/// The first corner and the size of a view box; none where it has no size.
fn view_box(text: &str) -> Option<[DVec2; 2]> {
    let mut scan = TextScan::of(text);
    let mut number = || scan.number().filter(|number| number.is_finite());
    let (corner, size) = (DVec2::new(number()?, number()?), DVec2::new(number()?, number()?));
    (scan.is_empty() && size.min_element() > 0.0).then_some([corner, size])
}

/// Where a view box lies that does not fill its page, as shares of what is left, and whether it covers the
/// page; none where it is stretched.
fn alignment(text: &str) -> Option<(DVec2, bool)> {
    let mut words = text.split_ascii_whitespace().filter(|&word| word != "defer");
    let share = |word: &str| match word {
        "Min" => Some(0.0),
        "Mid" => Some(0.5),
        "Max" => Some(1.0),
        _ => None,
    };
    let align = words.next().unwrap_or("");
    if align == "none" {
        return None;
    }
    let shares = align.strip_prefix('x').and_then(|it| it.split_once('Y'));
    let shares = shares.and_then(|(x, y)| Some(DVec2::new(share(x)?, share(y)?)));
    match (shares, words.next()) {
        (Some(shares), word) => Some((shares, word == Some("slice"))),
        (None, _) => Some((DVec2::splat(0.5), false)),
    }
}

//! A line of text to outlines: shaped by `harfrust`, drawn by `skrifa`, in the numbers of OpenSCAD's
//! renderer.

use std::str::FromStr;
use std::sync::Arc;

use harfrust::{Buffer, Direction, Font, FontFuncs, Language, Script, ShapeOptions, ShaperFont};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, HintingInstance, HintingOptions};
use skrifa::raw::TableProvider;
use skrifa::raw::tables::head::{Flags, Head};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use super::curve_pen::CurvePen;
use super::library::{ChosenFont, FontLibrary};
use super::scale::{EM, OF_WAYS, UNIT};
use super::vertical::EvenColumns;
use crate::math::DVec2;

/// Where a text is along x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AlignedAcross {
    /// It begins at 0.
    #[default]
    Left,
    /// Its middle is at 0.
    Center,
    /// It ends at 0.
    Right,
}

/// Where a text is along y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AlignedUp {
    /// Its letters stand on 0.
    #[default]
    Baseline,
    /// The lowest point of its letters is at 0.
    Bottom,
    /// The middle between lowest and highest point is at 0.
    Center,
    /// The highest point is at 0.
    Top,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct TextLine<'t> {
    /// The letters.
    pub text: &'t str,
    /// The name of the font, as fontconfig reads it.
    pub font: &'t str,
    /// About the height of a capital letter.
    pub size: f64,
    /// By what the way from letter to letter is multiplied.
    pub spacing: f64,
    /// `ltr`, `rtl`, `ttb` or `btt`; empty leaves it to the script.
    pub direction: &'t str,
    /// The language, such as `en`.
    pub language: &'t str,
    /// The script, such as `Latn`; empty leaves it to the letters.
    pub script: &'t str,
    /// Where it is along x.
    pub across: AlignedAcross,
    /// Where it is along y.
    pub up: AlignedUp,
    /// How many sides a curve of a letter is cut into.
    pub sides: u32,
}

/// What was written.
#[derive(Clone, Debug)]
pub struct WrittenText {
    /// The outlines of all letters; a point is inside where they go round it more often one way than the
    /// other.
    pub outlines: Vec<Vec<DVec2>>,
    /// The font it is written in.
    pub font: ChosenFont,
    /// Whether a letter is none of the font, and drawn as a box.
    pub any_unknown: bool,
}

/// Why a text was not written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotWritten {
    /// The machine has no font.
    NoFont,
    /// The file of the font can not be read, or is none.
    Unreadable,
    /// It has more corners than it may.
    TooMany,
}

/// Writes a line, of fewer corners than that.
pub fn written(
    line: &TextLine<'_>,
    most_corners: usize,
    library: &mut FontLibrary,
) -> Result<WrittenText, NotWritten> {
    let chosen = library.choose(line.font).ok_or(NotWritten::NoFont)?;
    // A letter has a corner at least, or is a blank.
    if line.text.len() > most_corners {
        return Err(NotWritten::TooMany);
    }
    let bytes = library.bytes(&chosen).ok_or(NotWritten::Unreadable)?;
    let font = FontRef::from_index(&bytes, chosen.index).map_err(|_| NotWritten::Unreadable)?;
    let columns = EvenColumns::of(&font);
    let glyphs = shaped(line, &bytes, chosen.index, columns).ok_or(NotWritten::Unreadable)?;
    let collection = font.outline_glyphs();
    // As FreeType does unasked, letters are fitted to the dots of that size: half a dot is 0.0003 of the
    // size.
    let size = size_of(&font);
    let hinting = HintingInstance::new(&collection, size, LocationRef::default(), HintingOptions::default());
    let mut drawn = Vec::with_capacity(glyphs.list.len());
    let mut room = most_corners;
    for glyph in &glyphs.list {
        let mut pen = CurvePen::new(line.sides, room);
        if let Some(outline) = collection.get(GlyphId::new(glyph.id)) {
            let is_drawn = hinting
                .as_ref()
                .is_ok_and(|hinting| outline.draw(DrawSettings::hinted(hinting, false), &mut pen).is_ok());
            if !is_drawn {
                pen = CurvePen::new(line.sides, room);
                let settings = DrawSettings::unhinted(size, LocationRef::default());
                outline.draw(settings, &mut pen).map_err(|_| NotWritten::Unreadable)?;
            }
        }
        room = pen.room();
        if room == 0 {
            return Err(NotWritten::TooMany);
        }
        drawn.push(pen);
    }
    let (mut at, mut outlines) = (start(line, &glyphs, &drawn), Vec::new());
    for (glyph, pen) in glyphs.list.iter().zip(drawn) {
        let place = |p: DVec2| (p + at + glyph.offset) * UNIT * line.size;
        outlines.extend(pen.outlines.into_iter().map(|ring| ring.into_iter().map(place).collect()));
        at += glyph.advance * line.spacing;
    }
    let any_unknown = glyphs.list.iter().any(|glyph| glyph.id == 0);
    Ok(WrittenText { outlines, font: chosen, any_unknown })
}

/// The size that letters are drawn at. A TrueType font may ask for whole dots to its em, and FreeType then
/// takes the nearest for its outlines, fitted or not, but not for the ways between letters.
fn size_of(font: &FontRef<'_>) -> Size {
    let dots = EM as f32 / 64.0;
    let asks = |head: Head<'_>| head.flags().contains(Flags::FORCE_INTEGER_PPEM);
    let is_whole = font.glyf().is_ok() && font.head().is_ok_and(asks);
    Size::new(if is_whole { dots.round() } else { dots })
}

/// The letters of a line as signs of a font, in FreeType's units.
struct Glyphs {
    list: Vec<Glyph>,
    is_vertical: bool,
}

struct Glyph {
    id: u32,
    /// From where it would stand to where it is drawn.
    offset: DVec2,
    /// From where it stands to where the next does.
    advance: DVec2,
}

fn shaped(
    line: &TextLine<'_>,
    bytes: &Arc<Vec<u8>>,
    index: u32,
    columns: Option<EvenColumns>,
) -> Option<Glyphs> {
    let shared: Arc<dyn AsRef<[u8]> + Send + Sync> = Arc::<Vec<u8>>::clone(bytes);
    let font = Font::new(shared, index)?;
    let columns = columns.as_ref().map(|columns| columns as &dyn FontFuncs);
    let shaper = ShaperFont::new(&font).with_scale(EM).with_font_funcs(columns);
    let mut buffer = Buffer::new();
    buffer.push_str(line.text);
    buffer.set_script(Script::from_str(line.script).ok().filter(|_| !line.script.is_empty()));
    buffer.set_language(Language::new(line.language));
    buffer.set_direction(match line.direction {
        "ltr" => Direction::LeftToRight,
        "rtl" => Direction::RightToLeft,
        "ttb" => Direction::TopToBottom,
        "btt" => Direction::BottomToTop,
        _ => Direction::Invalid,
    });
    buffer.guess_segment_properties();
    let is_vertical = matches!(buffer.direction(), Direction::TopToBottom | Direction::BottomToTop);
    harfrust::shape(&shaper, &mut buffer, ShapeOptions::new()).ok()?;
    let vector = |x: i32, y: i32| DVec2::new(f64::from(x), f64::from(y));
    let list = buffer.glyph_infos().iter().zip(buffer.glyph_positions()).map(|(info, position)| Glyph {
        id: info.glyph_id,
        offset: vector(position.x_offset, position.y_offset) * OF_WAYS,
        advance: vector(position.x_advance, position.y_advance) * OF_WAYS,
    });
    Some(Glyphs { list: list.collect(), is_vertical })
}

/// Where the first letter stands, in FreeType's units, by OpenSCAD's rules.
fn start(line: &TextLine<'_>, glyphs: &Glyphs, drawn: &[CurvePen]) -> DVec2 {
    let (mut width, mut ascent, mut descent) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (glyph, pen) in glyphs.list.iter().zip(drawn) {
        let [low, high] = pen.box_of_dots().map(|corner| corner * OF_WAYS);
        if glyphs.is_vertical {
            width = width.max(high.x - low.x);
            ascent += glyph.advance.y * line.spacing;
        } else {
            width += glyph.advance.x * line.spacing;
            (ascent, descent) = (ascent.max(high.y), descent.max(-low.y));
        }
    }
    let x = match line.across {
        AlignedAcross::Left => 0.0,
        AlignedAcross::Center => -0.5 * width,
        AlignedAcross::Right => -width,
    };
    let y = match line.up {
        AlignedUp::Baseline => 0.0,
        AlignedUp::Bottom => descent,
        AlignedUp::Center => 0.5 * (descent - ascent),
        AlignedUp::Top => -ascent,
    };
    DVec2::new(x, y)
}

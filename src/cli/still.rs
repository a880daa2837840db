//! The bytes of a still: which values its format shows, and those values as the format has them.

use std::io::{self, Write};
use std::sync::Arc;

use crate::app::Painter;
use crate::frame::{Frame, Request, Wants};
use crate::glyph::{GlyphMode, Ground, Palette};
use crate::math::{Grid, Size};
use crate::output::{self, Capabilities, Pixels};
use crate::plan::PrecisionChoice;
use crate::tone::Tone;

use super::arguments::{PictureArguments, RenderArguments};
use super::effects::Still;
use super::error::{CliError, tell};
use super::formats::{RawChannel, StillFormat};
use super::names::Glyphs;
use super::picture::{Look, PIXELS, Unsized};

/// The picture that the viewer shows, drawn as a format needs it: characters as they stand there, pixels in
/// the number that they have where nobody says another.
pub fn of_view(painter: &dyn Painter, shown: &Request, format: StillFormat) -> Result<Vec<u8>, CliError> {
    let still = Still { format, channel: None, levels: false };
    let mut request = Request { wants: wants(still), ..shown.clone() };
    if format.is_pixels() {
        (request.dots, request.dot_aspect) = (PIXELS, 1.0);
    }
    if format == StillFormat::Txt {
        request.palette = Palette::Mono(Ground::Dark).for_glyphs(request.glyphs, Ground::Dark);
    }
    if format == StillFormat::AnsDos {
        as_dos(&mut request);
    }
    settle_precision(&mut request, format);
    let raw = Values::Raw(RawChannel::Light);
    let values = if format == StillFormat::Pfm { raw } else { Values::Toned };
    encoded(&painter.draw(&request), request.palette, request.tone, format, values)
}

/// The same cells in a PC's own characters and colours, whatever the terminal has.
fn as_dos(request: &mut Request) {
    let (cells, shown, dos) =
        (request.cells(), request.glyphs.dots_per_cell(), GlyphMode::Cp437.dots_per_cell());
    let shape = |size: Size| f64::from(size.width) / f64::from(size.height);
    // A cell keeps its shape, with other dots in it.
    request.dot_aspect *= shape(shown) / shape(dos);
    request.dots = Size::new(cells.width * dos.width, cells.height * dos.height);
    (request.glyphs, request.palette) = (GlyphMode::Cp437, Palette::DOS);
}

/// Takes all digits where nobody asks for fewer and values are raw: these are for whoever computes with them.
pub fn settle_precision(request: &mut Request, format: StillFormat) {
    if format == StillFormat::Pfm && request.options.precision == PrecisionChoice::Auto {
        request.options.precision = PrecisionChoice::Double;
    }
}

/// What is shown of light in pixels and raw values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// As the tone shows it.
    Toned,
    /// The grays of the levels.
    Levels,
    /// A channel as it is.
    Raw(RawChannel),
}

impl Values {
    /// What is asked for. The picture of 1986 had levels; a colour has none.
    pub fn new(still: Still, picture: &PictureArguments) -> Self {
        match still.channel {
            Some(channel) => Self::Raw(channel),
            None if still.format == StillFormat::Pfm => Self::Raw(RawChannel::Light),
            None if still.levels || picture.preset.is_some() => Self::Levels,
            None => Self::Toned,
        }
    }
}

/// What is asked for; in this format, where none is.
pub fn still_of(arguments: &RenderArguments, format: StillFormat) -> Still {
    let RenderArguments { channel, levels, .. } = *arguments;
    Still { format: arguments.format.unwrap_or(format), channel, levels }
}

/// What the format shows of a picture.
pub fn wants(still: Still) -> Wants {
    match (still.format, still.channel) {
        (format, _) if format.has_characters() => Wants::CELLS,
        (_, Some(RawChannel::Depth)) => Wants { depth: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Normal)) => Wants { normal: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Object)) => Wants { object: true, ..Wants::LIGHT },
        (_, Some(RawChannel::Light) | None) => Wants::LIGHT,
    }
}

/// Text has no colours to lose: its shades are ink. A page is for no terminal, and has a PC's four grays.
pub fn look(picture: &PictureArguments, format: StillFormat, terminal: Option<Capabilities>) -> Look {
    match format {
        StillFormat::Txt => Look { palette: Palette::Mono(picture.ground()), ..picture.look(terminal) },
        StillFormat::Svg | StillFormat::Html => {
            let look = picture.look(Some(Capabilities::default()));
            if matches!(look.palette, Palette::Dos(_)) {
                Look { palette: Palette::DOS, ..look }
            } else {
                look
            }
        }
        StillFormat::AnsDos => dos_look(picture),
        // Whoever plays it has a terminal of today, and colours of their own for the attributes.
        StillFormat::Cast => picture.look(Some(Capabilities::default())),
        _ => picture.look(terminal),
    }
}

/// A PC's characters and attributes, unless other ones that it has are asked for.
fn dos_look(picture: &PictureArguments) -> Look {
    let look = picture.look(Some(Capabilities::default()));
    let is_open = matches!(picture.glyphs, None | Some(Glyphs::Auto));
    let glyphs = if is_open { GlyphMode::Cp437 } else { look.glyphs };
    let palette = if matches!(look.palette, Palette::Dos(_)) { Palette::DOS } else { look.palette };
    Look { glyphs, palette: palette.for_glyphs(glyphs, picture.ground()) }
}

/// The size of a picture for which none is given.
pub fn unsized_picture(format: StillFormat) -> Unsized {
    match format {
        _ if format.is_pixels() => Unsized::Pixels,
        StillFormat::AnsDos => Unsized::Dos,
        _ => Unsized::Screen,
    }
}

/// Refuses what a PC's screen has not.
pub fn check_dos(picture: &PictureArguments, format: StillFormat) -> Result<(), CliError> {
    if format != StillFormat::AnsDos {
        return Ok(());
    }
    let Look { glyphs, palette } = dos_look(picture);
    let what = match (glyphs, palette) {
        (GlyphMode::Blocks | GlyphMode::Quadrant | GlyphMode::Braille, _) => {
            "characters: --glyphs cp437, half, shade or ascii"
        }
        (_, Palette::Gray(_) | Palette::Color(_)) => "colours: --palette dos, dos16 or mono",
        _ => return Ok(()),
    };
    Err(CliError::Input(format!("ans-dos is for a PC's screen, which has other {what}")))
}

/// The whole still in memory, so that an error leaves nothing half-written.
pub fn encoded(
    frame: &Frame,
    palette: Palette,
    tone: Tone,
    format: StillFormat,
    values: Values,
) -> Result<Vec<u8>, CliError> {
    let mut out = Vec::new();
    let done = match format {
        StillFormat::Txt => wanted(frame.cells.as_ref()).and_then(|cells| output::text(cells, &mut out)),
        StillFormat::Ans => wanted(frame.cells.as_ref()).and_then(|cells| output::ansi(cells, &mut out)),
        StillFormat::AnsDos => {
            wanted(frame.cells.as_ref()).and_then(|cells| output::dos_ansi(cells, &mut out))
        }
        StillFormat::Cast => wanted(frame.cells.as_ref()).and_then(|cells| {
            let mut cast = output::Cast::new(cells.size());
            cast.show(cells, 0.0);
            out.write_all(cast.finish(1.0).as_bytes())
        }),
        StillFormat::Svg => {
            wanted(frame.cells.as_ref()).and_then(|cells| output::svg(cells, palette.ground(), &mut out))
        }
        StillFormat::Html => {
            wanted(frame.cells.as_ref()).and_then(|cells| output::html(cells, palette.ground(), &mut out))
        }
        StillFormat::Levels => output::levels(&frame.levels(tone), &mut out),
        StillFormat::Png => {
            let drawn = output::png(&pixels(frame, tone, values), &mut out);
            drawn.map_err(|e| io::Error::other(e.to_string()))
        }
        StillFormat::Pgm => output::pgm(&grays(frame, tone, values), &mut out),
        StillFormat::Ppm => output::ppm(&pixels(frame, tone, values), &mut out),
        StillFormat::Pfm => match values {
            Values::Toned | Values::Levels | Values::Raw(RawChannel::Light) => match &frame.color {
                Some(color) => output::pfm_vectors(color, &mut out),
                None => output::pfm_gray(&frame.light, &mut out),
            },
            Values::Raw(RawChannel::Depth) => {
                wanted(frame.depth.as_ref()).and_then(|depth| output::pfm_gray(depth, &mut out))
            }
            Values::Raw(RawChannel::Normal) => {
                wanted(frame.normal.as_ref()).and_then(|normal| output::pfm_vectors(normal, &mut out))
            }
            Values::Raw(RawChannel::Object) => wanted(frame.object.as_ref())
                .and_then(|object| output::pfm_gray(&object.map(|&n| f64::from(n)), &mut out)),
        },
    };
    done.map_err(|e| CliError::Output(format!("the picture could not be encoded: {e}")))?;
    Ok(out)
}

/// Refuses a picture whose space is cut otherwise than was asked for.
pub fn refuse_over_budget(frame: &Frame) -> Result<(), CliError> {
    match &frame.over_budget {
        Some(over) => Err(CliError::Input(format!("{over}: use --structure tree"))),
        None => Ok(()),
    }
}

/// Says why a picture is all background.
pub fn say_nothing(frame: &Frame) {
    if let Some(why) = frame.nothing {
        tell(&why.to_string());
    }
}

/// A grid that the request asked for.
fn wanted<T>(grid: Option<&Arc<Grid<T>>>) -> io::Result<&Grid<T>> {
    grid.map(Arc::as_ref).ok_or_else(|| io::Error::other("it lacks what it was drawn for"))
}

/// Colours where they are wanted; else grays.
fn pixels(frame: &Frame, tone: Tone, values: Values) -> Pixels {
    match &frame.color {
        Some(color) => Pixels::of_colors(color, shown_by(tone, values)),
        None => Pixels::Gray(grays(frame, tone, values)),
    }
}

fn grays(frame: &Frame, tone: Tone, values: Values) -> Grid<u8> {
    match values {
        Values::Levels => output::grays_of_levels(&frame.levels(tone)),
        Values::Toned | Values::Raw(_) => output::grays_of_light(&frame.light, shown_by(tone, values)),
    }
}

/// Raw light has no tone.
fn shown_by(tone: Tone, values: Values) -> Tone {
    if matches!(values, Values::Raw(_)) { Tone::Lightness } else { tone }
}

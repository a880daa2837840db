//! Options that have no effect. What contradicts another option is refused; what is merely useless is said,
//! and the picture is drawn all the same: one table has both.

use crate::glyph::{GlyphMode, Palette};
use crate::plan::{EngineChoice, Shading};

use super::arguments::PictureArguments;
use super::error::CliError;
use super::formats::{RawChannel, StillFormat};
use super::names::{AntiAliasing, PaletteName, PrecisionName};

/// What shows a picture.
#[derive(Clone, Copy, Debug)]
pub enum Presentation {
    /// The viewer, which fills its terminal.
    Viewer,
    /// Characters that are counted or planned, and not written.
    Cells,
    /// Levels that are compared, and shown where they differ with that marked.
    Marked,
    /// A file or standard output.
    Still(Still),
}

/// How a still is written.
#[derive(Clone, Copy, Debug)]
pub struct Still {
    pub format: StillFormat,
    pub channel: Option<RawChannel>,
    /// Whether the grays of the levels are asked for.
    pub levels: bool,
}

/// What a row of the table is asked about.
struct Given<'a> {
    picture: &'a PictureArguments,
    shown: Presentation,
}

/// What becomes of an option without effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Refused,
    Said,
}

use Verdict::{Refused, Said};

/// One way in which options have no effect.
struct Row {
    option: &'static str,
    verdict: Verdict,
    /// Whether the option is given, and something that leaves it without effect is, too.
    holds: fn(&Given) -> bool,
    /// Why it has none, and what has.
    why: &'static str,
}

const fn row(option: &'static str, verdict: Verdict, holds: fn(&Given) -> bool, why: &'static str) -> Row {
    Row { option, verdict, holds, why }
}

/// The viewer's lines come when it has ended, too late to change anything: what it does not follow is
/// refused.
const ROWS: [Row; 34] = [
    row("cells", Refused, |g| g.is_viewer() && g.picture.cells.is_some(), FILLS),
    row("dots", Refused, |g| g.is_viewer() && g.picture.dots.is_some(), FILLS),
    row(
        "channel light",
        Refused,
        |g| g.channel() == Some(RawChannel::Light) && !g.is_pixels(),
        "--format png, pgm, ppm and pfm have it",
    ),
    row(
        "channel",
        Refused,
        |g| g.raw() && g.format() != Some(StillFormat::Pfm),
        "all but light are in --format pfm only",
    ),
    row("levels", Refused, |g| g.levels() && g.channel().is_some(), "--channel asks for raw values"),
    row("levels", Refused, |g| g.levels() && g.format() == Some(StillFormat::Pfm), "pfm holds raw values"),
    row(
        "levels",
        Refused,
        |g| g.levels() && g.is_color(),
        "the levels are grays, --palette color has colours",
    ),
    row("levels", Said, |g| g.levels() && !g.is_pixels(), "these characters show the levels"),
    row(
        "precision single",
        Refused,
        |g| g.single() && g.is_exact(),
        "the exact engine, which other structures than boxes ask for too, has double precision",
    ),
    row(
        "palette",
        Said,
        |g| g.format() == Some(StillFormat::Txt) && g.palette(&[PaletteName::Mono]),
        "txt has no colours, --format ans has",
    ),
    row(
        "palette",
        Said,
        |g| matches!(g.format(), Some(StillFormat::Levels | StillFormat::Pgm)) && g.palette(&[]),
        "this format has grays only",
    ),
    row(
        "palette",
        Said,
        |g| {
            matches!(g.format(), Some(StillFormat::Png | StillFormat::Ppm))
                && g.palette(&[PaletteName::Color])
        },
        "pixels have the light's own grays; --levels has those of the levels, --palette color colours",
    ),
    row(
        "palette",
        Said,
        |g| {
            g.format() == Some(StillFormat::Pfm)
                && g.palette(if g.raw() { &[] } else { &[PaletteName::Color] })
        },
        "raw values have no palette; of light --palette color has three channels",
    ),
    row(
        "palette",
        Said,
        |g| g.shows_colours() && g.is_ink() && g.palette(&[PaletteName::Mono, PaletteName::Color]),
        "braille and ascii are ink alone; --palette color has its colours",
    ),
    row(
        "palette",
        Said,
        |g| g.is_marked() && g.palette(&[PaletteName::Mono, PaletteName::Color]),
        "what differs is shown in the terminal's own ink",
    ),
    row(
        "no-invert",
        Said,
        |g| g.is_marked() && g.picture.no_invert,
        "no terminal is asked for its background",
    ),
    row(
        "invert",
        Said,
        |g| g.picture.invert && g.still().is_some() && !g.is_in_own_ink(),
        "it is for pictures in the terminal's own ink: txt, --palette mono, braille and ascii",
    ),
    row(
        "no-invert",
        Said,
        |g| g.picture.no_invert && g.still().is_some(),
        "stills ask no terminal for its background",
    ),
    row(
        "glyphs",
        Said,
        |g| g.picture.glyphs.is_some() && !g.has_characters() && !g.is_sized_by_cells(),
        "this format has no characters",
    ),
    row(
        "tone",
        Said,
        |g| g.picture.tone.is_some() && (g.format() == Some(StillFormat::Pfm) || g.channel().is_some()),
        "raw values have no tone",
    ),
    row("samples", Said, |g| g.raw() && g.picture.samples.is_some_and(|n| n > 1), OF_THE_MIDDLE),
    row("aa", Said, |g| g.raw() && g.picture.aa.is_some_and(|aa| aa != AntiAliasing::Off), OF_THE_MIDDLE),
    row("error", Said, |g| g.raw() && g.picture.error.is_some(), OF_THE_MIDDLE),
    row(
        "samples",
        Said,
        |g| {
            let way = g.picture.anti_aliasing();
            !g.raw() && g.picture.samples.is_some_and(|n| n > 1) && way != AntiAliasing::Fixed
        },
        "only --aa fixed takes as many rays for each dot",
    ),
    row(
        "error",
        Said,
        |g| !g.raw() && g.picture.error.is_some() && g.picture.anti_aliasing() != AntiAliasing::Adaptive,
        "only --aa adaptive asks for it",
    ),
    row("shading", Said, |g| g.raw() && g.picture.shading.is_some(), OF_NO_LIGHT),
    row("no-shadows", Said, |g| g.raw() && g.picture.no_shadows, OF_NO_LIGHT),
    row("shadows", Said, |g| g.raw() && g.picture.shadows, OF_NO_LIGHT),
    row("depth", Said, |g| g.raw() && g.picture.depth.is_some(), OF_NO_LIGHT),
    row("cutoff", Said, |g| g.raw() && g.picture.cutoff.is_some(), OF_NO_LIGHT),
    row("depth", Said, |g| !g.raw() && g.picture.depth.is_some() && !g.sends_on(), NOT_SENT),
    row("cutoff", Said, |g| !g.raw() && g.picture.cutoff.is_some() && !g.sends_on(), NOT_SENT),
    row(
        "cutoff",
        Said,
        |g| !g.raw() && g.picture.cutoff.is_some() && g.picture.depth == Some(0),
        "--depth 0 follows no ray",
    ),
    row(
        "view",
        Said,
        |g| g.picture.camera.view.is_some() && g.picture.camera.replaces_view(),
        "all that a view says is given by --eye, --target, --up, --field and --zoom",
    ),
];

const FILLS: &str = "the viewer fills its terminal; `ray13 render` draws a still of this size";
const OF_THE_MIDDLE: &str = "depth, normal and object are those of the middle of a dot";
const OF_NO_LIGHT: &str = "depth, normal and object are found without light";
const NOT_SENT: &str = "mirror and Snell rays come with --shading 4";

/// Refuses options that contradict each other; gives a line for each that is without effect.
pub fn check(picture: &PictureArguments, shown: Presentation) -> Result<Vec<String>, CliError> {
    let given = Given { picture, shown };
    let mut lines = Vec::new();
    for Row { option, verdict, why, .. } in ROWS.iter().filter(|row| (row.holds)(&given)) {
        let line = format!("--{option} has no effect here: {why}");
        match verdict {
            Refused => return Err(CliError::Input(line)),
            Said => lines.push(line),
        }
    }
    Ok(lines)
}

impl Given<'_> {
    fn is_marked(&self) -> bool {
        matches!(self.shown, Presentation::Marked)
    }

    fn is_viewer(&self) -> bool {
        matches!(self.shown, Presentation::Viewer)
    }

    fn still(&self) -> Option<Still> {
        match self.shown {
            Presentation::Still(still) => Some(still),
            Presentation::Viewer | Presentation::Cells | Presentation::Marked => None,
        }
    }

    fn format(&self) -> Option<StillFormat> {
        self.still().map(|still| still.format)
    }

    fn channel(&self) -> Option<RawChannel> {
        self.still().and_then(|still| still.channel)
    }

    /// Whether a channel other than light is asked for.
    fn raw(&self) -> bool {
        self.channel().is_some_and(|channel| channel != RawChannel::Light)
    }

    fn levels(&self) -> bool {
        self.still().is_some_and(|still| still.levels)
    }

    fn is_pixels(&self) -> bool {
        self.format().is_some_and(StillFormat::is_pixels)
    }

    fn has_characters(&self) -> bool {
        self.format().is_none_or(StillFormat::has_characters)
    }

    /// Whether characters have colours.
    fn shows_colours(&self) -> bool {
        self.has_characters() && self.format() != Some(StillFormat::Txt)
    }

    /// Whether a picture without characters has as many dots as they would have.
    fn is_sized_by_cells(&self) -> bool {
        let sized = self.picture.dots.is_some() || self.picture.preset.is_some();
        self.picture.cells.is_some() || (!sized && !self.is_pixels())
    }

    /// Whether a still has no colours but the terminal's own.
    fn is_in_own_ink(&self) -> bool {
        match self.format() {
            Some(StillFormat::Txt) => true,
            Some(format) if format.has_characters() => {
                matches!(self.picture.look(None).palette, Palette::Mono(_))
            }
            _ => false,
        }
    }

    fn is_ink(&self) -> bool {
        matches!(self.picture.look(None).glyphs, GlyphMode::Braille | GlyphMode::Ascii)
    }

    /// Whether a palette is given that is none of these.
    fn palette(&self, but: &[PaletteName]) -> bool {
        self.picture.palette.is_some_and(|palette| !but.contains(&palette))
    }

    fn is_color(&self) -> bool {
        self.picture.palette == Some(PaletteName::Color)
    }

    fn single(&self) -> bool {
        self.picture.precision == PrecisionName::Single
    }

    /// Whether the exact engine traces: asked for, or with a structure that the fast one does not go through.
    fn is_exact(&self) -> bool {
        self.picture.options().is_ok_and(|options| options.traced_by() == EngineChoice::Exact)
    }

    fn sends_on(&self) -> bool {
        self.picture.options().is_ok_and(|options| options.shading == Shading::Whitted)
    }
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;
    use crate::cli::arguments::Arguments;

    fn checked(arguments: &[&str], shown: Presentation) -> Result<Vec<String>, String> {
        let arguments = [&["ray13", "die"], arguments].concat();
        let parsed = Arguments::try_parse_from(arguments).expect("arguments");
        check(&parsed.viewer.picture, shown).map_err(|e| e.to_string())
    }

    /// A line on standard error would be seen when the viewer has ended.
    #[test]
    fn the_viewer_refuses_sizes() {
        for size in ["--cells", "--dots"] {
            let refused = checked(&[size, "80x25"], Presentation::Viewer).expect_err("no effect");
            assert!(refused.contains(size) && refused.contains("fills its terminal"), "{refused}");
            assert_eq!(checked(&[size, "80x25"], Presentation::Cells), Ok(Vec::new()));
        }
        assert_eq!(checked(&["--samples", "2", "--zoom", "3"], Presentation::Viewer), Ok(Vec::new()));
    }

    #[test]
    fn what_mirrors_do_is_said_to_be_of_no_effect_without_them() {
        let lines = checked(&["--shading", "3", "--depth", "2", "--cutoff", "0"], Presentation::Cells);
        let lines = lines.expect("nothing is refused");
        assert!(lines.len() == 2 && lines.iter().all(|line| line.contains("--shading 4")), "{lines:?}");
        assert_eq!(checked(&["--depth", "2"], Presentation::Cells), Ok(Vec::new()));
        assert_eq!(
            checked(&["--preset", "pcat", "--depth", "2"], Presentation::Cells).map(|lines| lines.len()),
            Ok(1)
        );
    }

    #[test]
    fn every_row_names_an_option() {
        let program = Arguments::command();
        let render = program.find_subcommand("render").expect("the command");
        for row in &ROWS {
            let name = row.option.split(' ').next();
            assert!(render.get_arguments().any(|argument| argument.get_long() == name), "{}", row.option);
        }
    }
}

//! The command line that draws a setting's picture.

use clap::{Parser, ValueEnum};

use crate::frame::Request;
use crate::math::DVec3;
use crate::scene::{FacetMode, UpAxis};
use crate::trade::Setting;

use super::arguments::{Arguments, OpenScadArguments, PictureArguments, TradeArguments};
use super::error::CliError;
use super::up::Up;

/// The command line of a trade, but for its knobs.
pub struct CommandLine {
    /// As it was given.
    picture: PictureArguments,
    file: String,
    /// All options that are no knobs, each behind a blank.
    rest: String,
    /// Where the knobs stand without options.
    bare: Setting,
    own: Setting,
}

/// What OpenSCAD is told of a program.
fn told(openscad: &OpenScadArguments) -> String {
    let defines = openscad.define.iter().map(|define| format!(" -D {}", quoted(define)));
    let parameters =
        openscad.parameters.iter().map(|file| format!(" -p {}", quoted(&file.to_string_lossy())));
    let set = openscad.set.iter().map(|set| format!(" -P {}", quoted(set)));
    defines.chain(parameters).chain(set).collect()
}

impl CommandLine {
    /// Of these arguments, which have led to this request.
    pub fn new(arguments: &TradeArguments, request: &Request) -> Result<Self, CliError> {
        let picture = &arguments.picture;
        let bare = without_knobs(picture)?;
        let bare = Setting { options: bare.options()?, glyphs: bare.look(None).glyphs };
        let skip = if arguments.scene.reading.skip_unsupported { " --skip-unsupported" } else { "" };
        let root = arguments.scene.reading.root.as_ref();
        let root = root.map(|folder| format!(" --root {}", quoted(&folder.to_string_lossy())));
        let facets = match arguments.scene.reading.facets {
            FacetMode::Smooth => String::new(),
            facets @ FacetMode::OpenScad => format!(" --facets {}", facets.name()),
        };
        let digits = arguments.scene.reading.digits;
        let digits = digits.map(|digits| format!(" --digits {}", digits.name())).unwrap_or_default();
        let turned = match arguments.scene.reading.up {
            None => "",
            Some(UpAxis::Y) => " --up y",
            Some(UpAxis::Z) => " --up z",
        };
        Ok(Self {
            picture: picture.clone(),
            file: quoted(&arguments.scene.file),
            rest: format!(
                "{skip}{}{facets}{digits}{turned}{}{}",
                root.unwrap_or_default(),
                told(&arguments.scene.reading.openscad),
                rest(picture, request)
            ),
            bare,
            own: Setting::of(request),
        })
    }

    /// The options that make a setting, and nothing where it is what the program does by itself.
    pub fn options(&self, setting: &Setting) -> String {
        setting.arguments(&self.bare)
    }

    /// The setting that such options make.
    pub fn setting(&self, options: &str) -> Result<Setting, CliError> {
        let words = ["ray13"].into_iter().chain(options.split_whitespace());
        let refused = |e: clap::Error| CliError::Arguments(format!("in --with: {e}").trim_end().to_owned());
        let given = Arguments::try_parse_from(words).map_err(refused)?;
        let viewer = &given.viewer;
        let is_knobs = given.command.is_none() && viewer.file.is_none() && viewer.fps.is_none();
        let given = given.viewer.picture;
        if !is_knobs || has_more_than_knobs(&given) {
            let what = "in --with: only options that trade speed for accuracy, as \"--samples 3 --depth 2\"";
            return Err(CliError::Arguments(what.to_owned()));
        }
        let turned = PictureArguments { preset: self.picture.preset, ..given };
        Ok(Setting { options: turned.options()?, glyphs: turned.look(None).glyphs })
    }

    /// Whether a setting is the one that was asked for.
    pub fn is_own(&self, setting: &Setting) -> bool {
        *setting == self.own
    }

    /// The command that draws a setting's picture.
    pub fn render(&self, setting: &Setting) -> String {
        let options = self.options(setting);
        let blank = if options.is_empty() { "" } else { " " };
        format!("{}{blank}{options}", self.render_with())
    }

    /// The same, up to the setting's options.
    pub fn render_with(&self) -> String {
        format!("ray13 render {}{}", self.file, self.rest)
    }

    /// The command that measures a setting again: the same accuracy, against the same reference of as many
    /// rays.
    pub fn measure(&self, setting: &Setting, rays: u32) -> String {
        let own = self.measure_own(rays);
        if self.is_own(setting) { own } else { format!("{own} --with {}", in_quotes(&self.options(setting))) }
    }

    /// The same for the one that was asked for: with `--with` and options behind it, for any.
    pub fn measure_own(&self, rays: u32) -> String {
        let own = self.options(&self.own);
        let blank = if own.is_empty() { "" } else { " " };
        format!("ray13 trade {}{}{blank}{own} --seconds 0 --rays {rays}", self.file, self.rest)
    }
}

/// Whether anything is given that no setting has: what the picture shows, and how large it is.
fn has_more_than_knobs(given: &PictureArguments) -> bool {
    let camera = &given.camera;
    let moved = [camera.eye, camera.target].iter().any(Option::is_some) || camera.up.is_some();
    moved
        || camera.view.is_some()
        || camera.field.is_some()
        || camera.zoom.is_some()
        || given.cells.is_some()
        || given.dots.is_some()
        || given.palette.is_some()
        || given.tone.is_some()
        || given.preset.is_some()
        || given.invert
        || given.no_invert
}

/// The arguments as if no knob were turned.
fn without_knobs(picture: &PictureArguments) -> Result<PictureArguments, CliError> {
    let none = Arguments::try_parse_from(["ray13"]).map_err(|e| CliError::Arguments(e.to_string()))?;
    Ok(PictureArguments {
        preset: picture.preset,
        cells: picture.cells,
        dots: picture.dots,
        camera: picture.camera.clone(),
        palette: picture.palette,
        invert: picture.invert,
        no_invert: picture.no_invert,
        tone: picture.tone,
        ..none.viewer.picture
    })
}

/// The options that are no knobs, each behind a blank. The size is always there: without one it is the
/// terminal's.
fn rest(picture: &PictureArguments, request: &Request) -> String {
    let mut options = String::new();
    let mut put = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            options.push_str(&format!(" --{name} {value}"));
        }
    };
    let point = |p: DVec3| format!("{},{},{}", p.x, p.y, p.z);
    put("preset", name(picture.preset));
    let per_cell = request.glyphs.dots_per_cell();
    if let Some(dots) = picture.dots {
        put("dots", Some(format!("{}x{}", dots.width, dots.height)));
    } else if picture.preset.is_none() || picture.cells.is_some() {
        let [across, down] = [request.dots.width / per_cell.width, request.dots.height / per_cell.height];
        put("cells", Some(format!("{across}x{down}")));
    }
    let camera = &picture.camera;
    put("view", camera.view.as_deref().map(quoted));
    put("eye", camera.eye.map(point));
    put("target", camera.target.map(point));
    put("up", camera.up.and_then(Up::direction).map(point));
    put("field", camera.field.map(|[across, down]| format!("{across}x{down}")));
    put("zoom", camera.zoom.map(|zoom| zoom.to_string()));
    put("palette", name(picture.palette));
    put("tone", name(picture.tone));
    for (given, option) in [(picture.invert, " --invert"), (picture.no_invert, " --no-invert")] {
        if given {
            options.push_str(option);
        }
    }
    options
}

/// The name of a value on the command line.
fn name<T: ValueEnum>(value: Option<T>) -> Option<String> {
    Some(value?.to_possible_value()?.get_name().to_owned())
}

/// A word as a shell takes it back: in quotes where it has anything that means something there.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./+:,@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) { word.to_owned() } else { in_quotes(word) }
}

/// A word in quotes that a shell takes away.
fn in_quotes(word: &str) -> String {
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::arguments::Command;
    use crate::cli::input;
    use crate::cli::picture::Unsized;
    use crate::frame::Wants;

    fn line(arguments: &[&str]) -> CommandLine {
        let arguments = Arguments::try_parse_from([&["ray13", "trade"], arguments].concat()).unwrap();
        let Some(Command::Trade(trade)) = arguments.command else { panic!("no trade") };
        let studio = input::studio(input::read("die", &trade.scene.reading).unwrap()).unwrap();
        let look = trade.picture.look(None);
        let request = trade.picture.request(&studio, look, Wants::CELLS, Unsized::Screen).unwrap();
        CommandLine::new(&trade, &request).unwrap()
    }

    #[test]
    fn a_command_line_says_all_that_was_given() {
        let given = [
            "it's",
            "--cells",
            "20x10",
            "--view",
            "low",
            "--eye",
            "-1,2.5,3",
            "--zoom",
            "2",
            "--palette",
            "gray",
            "--samples",
            "3",
            "--no-shadows",
            "--glyphs",
            "half",
        ];
        let line = line(&given);
        assert!(line.is_own(&line.own));
        let render = line.render(&line.own);
        let rest = r"'it'\''s' --cells 20x10 --view low --eye -1,2.5,3 --zoom 2 --palette gray";
        let own = "--samples 3 --no-shadows --glyphs half";
        assert_eq!(render, format!("ray13 render {rest} {own}"));
        let again = format!("ray13 trade {rest} {own} --seconds 0 --rays 64");
        assert_eq!(line.measure(&line.own, 64), again);
        assert_eq!(
            line.measure(&line.setting("--depth 2").unwrap(), 64),
            format!("{again} --with '--depth 2'")
        );
        // Where it is what the program does by itself, there are no options to give.
        assert_eq!(line.measure(&line.bare, 64), format!("{again} --with ''"));
        assert_eq!(line.setting(own).unwrap(), line.own);
        assert_eq!(line.setting("").unwrap(), line.bare);
        assert!(line.setting("--sample 3").is_err() && line.setting("--depth -1").is_err());
        assert_eq!(line.options(&line.bare), "");
    }

    #[test]
    fn a_preset_is_named_and_not_written_out() {
        let line = line(&["die", "--preset", "pcat", "--shadows"]);
        assert_eq!(line.render(&line.own), "ray13 render die --preset pcat --shadows");
    }
}

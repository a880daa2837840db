//! The person's own settings: a TOML file of what would else be typed each time the viewer is opened.
//!
//! Each setting is a word of the command line under the same name, and nothing else: it is put before what
//! was typed, which has the last word. Only the viewer has settings. A still is the same whoever draws it.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser};
use toml::de::{DeTable, DeValue};

use super::arguments::Arguments;
use super::diagnostics;
use super::error::CliError;
use crate::scene::{Diagnostic, Diagnostics, MAX_ERRORS, nearest};

/// Options that are asked for once.
const NO_SETTINGS: [&str; 3] = ["help", "version", "watch"];

/// Larger files are some other file; it is read before anything is shown.
const MOST_BYTES: u64 = 1 << 20;

/// A setting as a word of the command line.
struct Setting {
    word: String,
    /// Where it stands in the file.
    span: Range<usize>,
}

/// What the words that were typed and the person's settings mean together; `None` where there are no
/// settings.
pub fn with_settings(typed: &[OsString], colour: bool) -> Result<Option<Arguments>, CliError> {
    let Some(place) = place() else { return Ok(None) };
    let name = place.display().to_string();
    let text = match fs::metadata(&place) {
        Ok(found) if found.len() > MOST_BYTES => {
            return Err(CliError::Input(format!("{name} is larger than settings can be (1 MiB)")));
        }
        Ok(_) => fs::read_to_string(&place),
        Err(error) => Err(error),
    };
    match text {
        Ok(text) => merged(typed, &name, &text)
            .map(Some)
            .map_err(|diagnostics| CliError::Scene(diagnostics::render(&diagnostics, colour))),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(CliError::Input(format!("the settings in {name} could not be read: {error}"))),
    }
}

/// Where the settings are, as XDG has it: an absolute path in `XDG_CONFIG_HOME`, else `.config` at home.
fn place() -> Option<PathBuf> {
    let named = env::var_os("XDG_CONFIG_HOME").map(PathBuf::from).filter(|folder| folder.is_absolute());
    let folder = named.or_else(|| env::home_dir().map(|home| home.join(".config")))?;
    Some(folder.join("ray13").join("config.toml"))
}

/// The words that were typed, which mean something alone, with the settings of a text before them. A setting
/// that goes with what was typed no more than the same option twice gives way to it.
fn merged(typed: &[OsString], name: &str, text: &str) -> Result<Arguments, Diagnostics> {
    let failed =
        |list| Diagnostics { source_name: name.to_owned(), source: Arc::from(text), list, stopped: false };
    let settings = settings(text).map_err(failed)?;
    let mut faults = Vec::new();
    let mut kept: Vec<OsString> = vec!["ray13".into()];
    let mut all = kept.clone();
    for Setting { word, span } in settings {
        let with = |words: &[OsString]| {
            let words = words.iter().cloned().chain([OsString::from(&word)]).collect::<Vec<_>>();
            Arguments::try_parse_from(&words).map(|_| words)
        };
        if let Err(error) = with(&["ray13".into()]) {
            faults.push(refused(&error, span));
            continue;
        }
        all = match with(&all) {
            Ok(all) => all,
            Err(error) => {
                faults.push(refused(&error, span));
                continue;
            }
        };
        let kept_with = with(&kept).unwrap_or_else(|_| kept.clone());
        if Arguments::try_parse_from(kept_with.iter().chain(typed.iter().skip(1))).is_ok() {
            kept = kept_with;
        }
    }
    if faults.is_empty() {
        let words = kept.iter().chain(typed.iter().skip(1));
        // Each was tried with those before it.
        return Arguments::try_parse_from(words).map_err(|error| failed(vec![refused(&error, 0..0)]));
    }
    faults.truncate(MAX_ERRORS);
    Err(failed(faults))
}

/// The settings in a text, in their order.
fn settings(text: &str) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    let table = DeTable::parse(text).map_err(|error| {
        vec![Diagnostic::error(seen(text, error.span().unwrap_or_default()), error.message().to_owned())]
    })?;
    let known = names();
    let (mut settings, mut faults) = (Vec::new(), Vec::new());
    for (key, value) in table.get_ref() {
        let name = key.get_ref().as_ref();
        if !known.iter().any(|known| known == name) {
            let fault = Diagnostic::error(key.span(), format!("there is no setting `{name}`"));
            faults.push(match nearest(name, known.iter().map(String::as_str)) {
                Some(nearest) => fault.help(format!("is `{nearest}` meant?")),
                None => fault.help("each long option of the viewer is one: ray13 --help".to_owned()),
            });
            continue;
        }
        let word = match value.get_ref() {
            DeValue::Boolean(false) => continue,
            DeValue::Boolean(true) => Some(format!("--{name}")),
            value => told(value).map(|value| format!("--{name}={value}")),
        };
        match word {
            Some(word) => settings.push(Setting { word, span: value.span() }),
            None => faults.push(Diagnostic::error(
                value.span(),
                "a setting is a text, a number, some numbers in brackets, true or false",
            )),
        }
    }
    settings.sort_by_key(|setting| setting.span.start);
    faults.sort_by_key(|fault| fault.span.start);
    if faults.is_empty() { Ok(settings) } else { Err(faults) }
}

/// A place that can be shown: where something is missing, what stands before it.
fn seen(text: &str, span: Range<usize>) -> Range<usize> {
    let before = text.get(..span.start).and_then(|before| before.trim_end().char_indices().next_back());
    match before {
        Some((at, last)) if span.is_empty() => at..at + last.len_utf8(),
        _ => span,
    }
}

/// The value as it is typed.
fn told(value: &DeValue<'_>) -> Option<String> {
    match value {
        DeValue::String(text) => Some(text.to_string()),
        DeValue::Integer(number) if number.radix() == 10 => Some(number.as_str().to_owned()),
        DeValue::Float(number) => Some(number.as_str().to_owned()),
        DeValue::Array(all) => {
            let numbers: Option<Vec<String>> = all
                .iter()
                .map(|value| match value.get_ref() {
                    number @ (DeValue::Integer(_) | DeValue::Float(_)) => told(number),
                    _ => None,
                })
                .collect();
            numbers.map(|numbers| numbers.join(","))
        }
        _ => None,
    }
}

/// The long options of the viewer.
fn names() -> Vec<String> {
    let command = Arguments::command();
    let names = command.get_arguments().filter_map(|argument| argument.get_long().map(str::to_owned));
    names.filter(|name| !NO_SETTINGS.contains(&name.as_str())).collect()
}

/// What clap has against a setting, at its place.
fn refused(error: &clap::Error, span: Range<usize>) -> Diagnostic {
    let text = error.render().to_string();
    let first = text.lines().next().unwrap_or_default();
    let message = first.strip_prefix("error: ").unwrap_or(first).to_owned();
    let diagnostic = Diagnostic::error(span, message);
    match error.get(ContextKind::ValidValue) {
        Some(ContextValue::Strings(values)) if !values.is_empty() => {
            diagnostic.help(format!("there are {}", values.join(", ")))
        }
        _ => diagnostic,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn merge(typed: &[&str], text: &str) -> Result<Arguments, String> {
        let typed: Vec<OsString> = ["ray13"].iter().chain(typed).map(Into::into).collect();
        merged(&typed, "config.toml", text).map_err(|diagnostics| diagnostics.to_string())
    }

    fn error(text: &str) -> String {
        merge(&[], text).expect_err("bad settings")
    }

    #[test]
    fn each_option_of_the_viewer_is_a_setting() {
        let text = "glyphs = \"half\"\nfps = 12.5\nshading = 2\ninvert = true\nshadows = false\neye = [0, -9, 3.5]\n";
        let Arguments { viewer, .. } = merge(&["die"], text).expect("good settings");
        assert_eq!(viewer.file.as_deref(), Some("die"));
        assert_eq!((viewer.fps, viewer.picture.shading), (Some(12.5), Some(2)));
        assert!(viewer.picture.invert && !viewer.picture.shadows);
        let eye = viewer.picture.camera.eye.expect("an eye");
        assert_eq!(eye.to_array(), [0.0, -9.0, 3.5]);
        assert!(merge(&[], "# nothing\n").is_ok());
    }

    #[test]
    fn what_is_typed_has_the_last_word() {
        let text = "fps = 12\ninvert = true\nshading = 2";
        let Arguments { viewer, .. } = merge(&["--fps", "30", "--no-invert"], text).expect("good settings");
        assert_eq!((viewer.fps, viewer.picture.shading), (Some(30.0), Some(2)));
        assert!(viewer.picture.no_invert && !viewer.picture.invert);
    }

    #[test]
    fn a_bad_setting_is_an_error_with_its_place() {
        assert!(
            error("fps = 10\nglyps = \"half\"")
                .starts_with("config.toml:2:1: error: there is no setting `glyps`")
        );
        assert!(error("glyps = \"half\"").contains("is `glyphs` meant?"));
        let value = error("\nglyphs = \"tiles\"");
        assert!(
            value.starts_with("config.toml:2:10: error: invalid value 'tiles'") && value.contains("blocks"),
            "{value}"
        );
        assert!(error("fps = -1").starts_with("config.toml:1:7: error: "));
        assert!(error("fps = 2020-01-01").contains("a setting is a text, a number"));
        assert!(error("[a]\nb = 1").starts_with("config.toml:1:2: error: "));
        assert!(error("fps = ").starts_with("config.toml:1:"));
        assert!(error("watch = true").contains("there is no setting `watch`"));
        assert!(error("invert = true\nno-invert = true").starts_with("config.toml:2:13: error: "));
    }
}

//! Names of files that a number tells apart, as in `turn-%03d.png`.

use std::path::{Path, PathBuf};

use super::error::{CliError, visible};

/// A name with a place for a number.
#[derive(Debug, PartialEq, Eq)]
pub struct NumberedName {
    folder: PathBuf,
    before: String,
    /// So many digits at least.
    digits: usize,
    after: String,
}

/// Names of files are no longer than 255 bytes on most systems.
const MOST_DIGITS: usize = 200;

impl NumberedName {
    /// The name where it has a place for a number: `%d`, or `%03d` for three digits; `%%` is a percent sign.
    pub fn of(path: &Path) -> Result<Option<Self>, CliError> {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return Ok(None) };
        if !name.contains('%') {
            return Ok(None);
        }
        let wrong = |why: &str| {
            Err(CliError::Input(format!("{}: {why}, as in turn-%03d.png", visible(&path.to_string_lossy()))))
        };
        let mut parts = vec![String::new()];
        let mut digits = 0;
        let mut rest = name;
        while let Some((text, after)) = rest.split_once('%') {
            if let Some(last) = parts.last_mut() {
                last.push_str(text);
            }
            let number = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
            let (width, behind) = after.split_at(number);
            if let (true, Some(behind)) = (width.is_empty(), behind.strip_prefix('%')) {
                parts.last_mut().into_iter().for_each(|last| last.push('%'));
                rest = behind;
                continue;
            }
            let Some(behind) = behind.strip_prefix('d') else {
                return wrong("behind a % comes d for the number of the view, or %");
            };
            digits = width.parse().unwrap_or(if width.is_empty() { 0 } else { usize::MAX });
            if digits > MOST_DIGITS {
                return wrong("that many digits no name can have");
            }
            parts.push(String::new());
            rest = behind;
        }
        parts.last_mut().into_iter().for_each(|last| last.push_str(rest));
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        match <[String; 2]>::try_from(parts) {
            Ok([before, after]) => Ok(Some(Self { folder, before, digits, after })),
            Err(parts) if parts.len() > 2 => wrong("one number tells the views apart"),
            Err(_) => Ok(None),
        }
    }

    /// The file of a number.
    pub fn path(&self, number: u32) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(pattern: &str) -> Result<Option<String>, String> {
        let name = NumberedName::of(Path::new(pattern)).map_err(|error| error.to_string())?;
        Ok(name.map(|name| name.path(7).to_string_lossy().into_owned()))
    }

    #[test]
    fn a_pattern_has_a_place_for_one_number() {
        for (pattern, expected) in [
            ("a%d.png", Some("a7.png")),
            ("b/%d/turn-%03d.png", Some("b/%d/turn-007.png")),
            ("100%%-%2d.txt", Some("100%-07.txt")),
            ("turn.png", None),
            ("100%%.png", None),
        ] {
            assert_eq!(first(pattern), Ok(expected.map(str::to_owned)), "{pattern}");
        }
        for pattern in ["a%d-%d", "a%s.png", "a%", "a%03", "a%99999999999999999999999d", "a%300d"] {
            let error = first(pattern).expect_err("no pattern");
            assert!(error.contains(pattern) && error.contains("turn-%03d.png"), "{error}");
        }
    }
}

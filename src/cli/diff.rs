//! Two pictures, compared.

use crate::scene::FilesRead;
use crate::trade::LevelDifference;

use super::arguments::DiffArguments;
use super::error::{CliError, visible};
use super::levels::{self, Source};
use super::write::print;
use super::{effects, input, marked};

/// Says what changed from one picture to the other: nothing and exit code 0, or the picture with its changed
/// cells marked and exit code 1.
pub fn run(arguments: &DiffArguments) -> Result<(), CliError> {
    let comparison = &arguments.comparison;
    input::say(&effects::check(&comparison.picture, effects::Presentation::Marked)?);
    let (before, after) = (&*arguments.before, &*arguments.after);
    let sources = [levels::read(before)?, levels::read(after)?];
    let like = sources.iter().find_map(|source| match source {
        Source::Levels(levels) => Some(levels.size()),
        Source::Bytes(_) | Source::Name => None,
    });
    // No picture is written.
    let read = FilesRead::default();
    let drawn = |source: Source, file: &str| {
        let studio = match source {
            Source::Levels(levels) => return Ok(levels),
            Source::Bytes(bytes) => comparison.studio(file, Some(&bytes), &read)?,
            Source::Name => comparison.studio(file, None, &read)?,
        };
        comparison.levels(&studio, None, like)
    };
    let [before_source, after_source] = sources;
    let (reference, own) = (drawn(before_source, before)?, drawn(after_source, after)?);
    let Some(difference) = LevelDifference::between(&own, &reference) else {
        let (own, reference) = (levels::dots(&own), levels::dots(&reference));
        return Err(CliError::Input(format!(
            "{} has {reference} dots and {} has {own}: pictures are compared dot by dot; --dots or --cells gives a \
             scene's",
            visible(before),
            visible(after)
        )));
    };
    let summary = marked::summary(&difference, comparison.tolerance);
    if difference.beyond(comparison.tolerance) == 0 {
        return print(format!("{summary}\n").as_bytes());
    }
    print(&marked::picture(&own, &reference, comparison.marking())?)?;
    Err(CliError::Different(summary))
}

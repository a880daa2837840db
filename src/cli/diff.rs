//! Two pictures, compared.

use crate::math::Grid;
use crate::tone::Level;
use crate::trade::LevelDifference;

use super::arguments::DiffArguments;
use super::error::{CliError, visible};
use super::levels;
use super::write::print;
use super::{effects, input, marked};

/// Says what changed from one picture to the other: nothing and exit code 0, or the picture with its changed
/// cells marked and exit code 1.
pub fn run(arguments: &DiffArguments) -> Result<(), CliError> {
    let comparison = &arguments.comparison;
    input::say(&effects::check(&comparison.picture, effects::Presentation::Cells)?);
    let (before, after) = (&*arguments.before, &*arguments.after);
    let kept = [levels::read(before)?, levels::read(after)?];
    let like = kept.iter().flatten().next().map(Grid::size);
    let [before_kept, after_kept] = kept;
    let drawn = |kept: Option<Grid<Level>>, file: &str| match kept {
        Some(levels) => Ok(levels),
        None => comparison.levels(&comparison.studio(file)?, None, like),
    };
    let (reference, own) = (drawn(before_kept, before)?, drawn(after_kept, after)?);
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
    print(&marked::picture(&own, &reference, comparison.tolerance)?)?;
    Err(CliError::Different(summary))
}

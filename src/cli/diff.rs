//! Two pictures, compared.

use crate::math::{Grid, Size};
use crate::tone::Level;
use crate::trade::LevelDifference;

use super::arguments::DiffArguments;
use super::error::{CliError, visible};
use super::levels::{self, Drawing};
use super::write::print;
use super::{effects, input, marked};

/// Says what changed from one picture to the other: nothing and exit code 0, or the picture with its changed
/// cells marked and exit code 1.
pub fn run(arguments: &DiffArguments) -> Result<(), CliError> {
    input::say(&effects::check(&arguments.picture, effects::Presentation::Cells)?);
    let drawing = Drawing {
        skip_unsupported: arguments.skip_unsupported,
        memory: arguments.memory,
        picture: &arguments.picture,
    };
    let (before, after) = (&*arguments.before, &*arguments.after);
    let kept = [levels::read(before)?, levels::read(after)?];
    let like = kept.iter().flatten().next().map(Grid::size);
    let [before_kept, after_kept] = kept;
    let drawn = |kept: Option<Grid<Level>>, file: &str| match kept {
        Some(levels) => Ok(levels),
        None => drawing.levels(&drawing.studio(file)?, None, like),
    };
    let (reference, own) = (drawn(before_kept, before)?, drawn(after_kept, after)?);
    let Some(difference) = LevelDifference::between(&own, &reference) else {
        let dots = |size: Size| format!("{} × {}", size.width, size.height);
        let (own, reference) = (dots(own.size()), dots(reference.size()));
        return Err(CliError::Input(format!(
            "{} has {reference} dots and {} has {own}: pictures are compared dot by dot; --dots or --cells gives a \
             scene's",
            visible(before),
            visible(after)
        )));
    };
    let summary = marked::summary(&difference, arguments.tolerance);
    if difference.beyond(arguments.tolerance) == 0 {
        return print(format!("{summary}\n").as_bytes());
    }
    print(&marked::picture(&own, &reference, arguments.tolerance)?)?;
    Err(CliError::Different(summary))
}

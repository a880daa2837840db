//! Pictures that are kept beside their scenes, and compared with what the scenes show now: a test for whoever
//! makes parts.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::math::Grid;
use crate::output;
use crate::tone::Level;
use crate::trade::LevelDifference;

use super::arguments::SnapshotArguments;
use super::error::{CliError, visible};
use super::levels::{self, Drawing};
use super::write::{Destination, print};
use super::{effects, input, marked};

/// What became of one view.
enum Outcome {
    /// As it was kept.
    Same,
    /// Written for the first time, or again since it had changed.
    Written,
    /// Kept, and different: the line that says how.
    Different(String),
    /// Not kept yet.
    Missing,
}

/// Compares each view of each scene with its picture beside the file; with `--update` keeps what has changed.
/// Exit code 1 where any differs or is missing.
pub fn run(arguments: &SnapshotArguments) -> Result<(), CliError> {
    if arguments.picture.camera.replaces_anything() {
        return Err(CliError::Input(
            "snapshots show the views of their scenes: --view picks one, and only the scene moves it"
                .to_owned(),
        ));
    }
    input::say(&effects::check(&arguments.picture, effects::Presentation::Cells)?);
    let drawing = Drawing {
        skip_unsupported: arguments.skip_unsupported,
        memory: arguments.memory,
        picture: &arguments.picture,
    };
    let (mut all, mut failed) = (0, 0);
    for file in &arguments.files {
        let studio = drawing.studio(file)?;
        let views = match arguments.picture.camera.view.clone() {
            Some(view) => vec![Some(view)],
            None => named_views(studio.scene().views.iter().map(|view| view.name.as_deref())),
        };
        for (path, view) in places(Path::new(file), views)? {
            let kept = if path.exists() { levels::read(&path.to_string_lossy())? } else { None };
            let shown = drawing.levels(&studio, view.as_deref(), kept.as_ref().map(Grid::size))?;
            let outcome = compare(arguments, &path, &shown, kept.as_ref())?;
            let name = visible(&path.to_string_lossy());
            let line = match &outcome {
                Outcome::Same => format!("{name}: same\n"),
                Outcome::Written => format!("{name}: written\n"),
                Outcome::Different(how) => format!("{name}: {how}\n"),
                Outcome::Missing => format!("{name}: not kept yet, --update keeps it\n"),
            };
            print(line.as_bytes())?;
            all += 1;
            failed += usize::from(matches!(outcome, Outcome::Different(_) | Outcome::Missing));
        }
    }
    if failed == 0 {
        return Ok(());
    }
    Err(CliError::Different(format!(
        "{failed} of {all} pictures not as kept: where that is right, --update keeps what the scenes show now"
    )))
}

/// Compares one picture, prints what changed and writes what is to be kept.
fn compare(
    arguments: &SnapshotArguments,
    path: &Path,
    shown: &Grid<Level>,
    kept: Option<&Grid<Level>>,
) -> Result<Outcome, CliError> {
    let write = || -> Result<Outcome, CliError> {
        let mut text = Vec::new();
        let encoded = output::levels(shown, &mut text);
        encoded.map_err(|e| CliError::Output(format!("the picture could not be encoded: {e}")))?;
        Destination::File(path.to_owned()).write(&text)?;
        Ok(Outcome::Written)
    };
    let Some(kept) = kept else {
        return if arguments.update { write() } else { Ok(Outcome::Missing) };
    };
    let Some(difference) = LevelDifference::between(shown, kept) else {
        if arguments.update {
            return write();
        }
        let [own, other] =
            [shown, kept].map(|grid| format!("{} × {}", grid.size().width, grid.size().height));
        return Ok(Outcome::Different(format!("it has {other} dots, and {own} are asked for")));
    };
    if difference.beyond(arguments.tolerance) == 0 {
        return Ok(Outcome::Same);
    }
    if arguments.update {
        return write();
    }
    print(&marked::picture(shown, kept, arguments.tolerance)?)?;
    Ok(Outcome::Different(marked::summary(&difference, arguments.tolerance)))
}

/// The views that are kept: all that have a name, else the scene's own.
fn named_views<'a>(names: impl Iterator<Item = Option<&'a str>>) -> Vec<Option<String>> {
    let named: Vec<_> = names.flatten().map(|name| Some(name.to_owned())).collect();
    if named.is_empty() { vec![None] } else { named }
}

/// Where each view is kept: `part.levels`, or `part.front.levels` for a view `front`, beside the scene. Of a
/// view's name letters, digits, `-` and `_` stay.
fn places(scene: &Path, views: Vec<Option<String>>) -> Result<BTreeMap<PathBuf, Option<String>>, CliError> {
    let stem = scene.file_stem().filter(|_| scene != Path::new("-")).ok_or_else(|| {
        CliError::Input("snapshots are kept beside a scene's file: give it by its name".to_owned())
    })?;
    let mut places = BTreeMap::new();
    for view in views {
        let mut name = stem.to_os_string();
        if let Some(view) = &view {
            let keep = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '-' };
            name.push(".");
            name.push(view.chars().map(keep).collect::<String>());
        }
        name.push(".levels");
        let path = scene.with_file_name(name);
        if let Some(Some(other)) = places.insert(path.clone(), view.clone()) {
            let view = view.unwrap_or_default();
            return Err(CliError::Input(format!(
                "the views `{}` and `{}` would both be kept as {}: rename one",
                visible(&other),
                visible(&view),
                visible(&path.to_string_lossy())
            )));
        }
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_view_has_a_file_beside_the_scene() {
        let views = named_views([Some("front"), None, Some("from above/left")].into_iter());
        let places = places(Path::new("parts/a.csg"), views).unwrap();
        let paths: Vec<String> = places.keys().map(|path| path.to_string_lossy().into_owned()).collect();
        assert_eq!(paths, ["parts/a.from-above-left.levels", "parts/a.front.levels"]);
    }

    #[test]
    fn a_scene_without_views_has_one_picture() {
        let places = places(Path::new("a.csg"), named_views([None].into_iter())).unwrap();
        assert_eq!(places.into_iter().collect::<Vec<_>>(), [(PathBuf::from("a.levels"), None)]);
    }

    #[test]
    fn views_that_would_share_a_file_are_refused() {
        let views = named_views([Some("a b"), Some("a-b")].into_iter());
        assert!(places(Path::new("a.csg"), views).is_err());
        assert!(places(Path::new("-"), vec![None]).is_err());
    }
}

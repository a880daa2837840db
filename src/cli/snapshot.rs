//! Pictures that are kept beside their scenes, and compared with what the scenes show now: a test for whoever
//! makes parts.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::frame::Studio;
use crate::math::Grid;
use crate::output;
use crate::scene::FilesRead;
use crate::tone::Level;
use crate::trade::LevelDifference;

use super::arguments::{ComparisonArguments, SnapshotArguments};
use super::error::{CliError, visible};
use super::levels::{self, Source};
use super::write::{Destination, SceneFiles, print};
use super::{effects, input, marked};

/// What became of one view.
enum Outcome {
    /// As it was kept.
    Same,
    /// Written for the first time, or again since it had changed.
    Written,
    /// Kept, and different.
    Different {
        /// A line that says how.
        how: String,
        /// The picture with what changed marked.
        picture: Vec<u8>,
    },
    /// Not kept yet.
    Missing,
}

/// Compares each view of each scene with its picture beside the file; with `--update` keeps what has changed.
/// Exit code 1 where any differs or is missing, 2 where any can not be compared: the others are, all the
/// same.
pub fn run(arguments: &SnapshotArguments) -> Result<(), CliError> {
    let comparison = &arguments.comparison;
    if comparison.picture.camera.replaces_anything() {
        return Err(CliError::Input(
            "snapshots show the views of their scenes: --view picks one, and only the scene moves it"
                .to_owned(),
        ));
    }
    input::say(&effects::check(&comparison.picture, effects::Presentation::Marked)?);
    let mut tally = Tally::default();
    let mut scenes = Vec::new();
    let read = FilesRead::default();
    for file in &arguments.files {
        match opened(comparison, file, &read) {
            Ok((studio, views)) => scenes.push((file, studio, views)),
            Err(error) => tally.fail(&error),
        }
    }
    let mut pictures = Pictures::default();
    let mut places = Vec::new();
    for (file, studio, views) in scenes {
        places.push((studio, pictures.places(file, views)?));
    }
    // No picture takes the place of a scene, by whatever link.
    let named = arguments.files.iter().map(Path::new);
    let read = read.all();
    let sources = SceneFiles::new(named.chain(read.iter().map(PathBuf::as_path)));
    for place in places.iter().flat_map(|(_, places)| places) {
        sources.check(&place.path)?;
    }
    for (studio, places) in &places {
        for place in places {
            match compared(arguments, studio, place) {
                Ok(outcome) => tally.count(place, &outcome)?,
                Err(error) => tally.fail(&error),
            }
        }
    }
    tally.verdict()
}

/// A scene that snapshots are kept of, and the views that are.
fn opened(
    comparison: &ComparisonArguments,
    file: &str,
    read: &FilesRead,
) -> Result<(Studio, Vec<Option<String>>), CliError> {
    if !Path::new(file).is_file() {
        return Err(CliError::Input(format!(
            "{}: snapshots are kept beside a scene's file, and there is no file of that name",
            visible(file)
        )));
    }
    let studio = comparison.studio(file, None, read)?;
    let views = match comparison.picture.camera.view.clone() {
        Some(view) => vec![Some(view)],
        None => named_views(studio.scene().views.iter().map(|view| view.name.as_deref())),
    };
    Ok((studio, views))
}

/// Compares one view of a scene with what is kept of it.
fn compared(arguments: &SnapshotArguments, studio: &Studio, place: &Place) -> Result<Outcome, CliError> {
    let Place { path, view } = place;
    let kept = kept(path, arguments.update)?;
    let shown = arguments.comparison.levels(studio, view.as_deref(), kept.as_ref().map(Grid::size))?;
    compare(arguments, path, &shown, kept.as_ref())
}

/// How many pictures there are of which kind.
#[derive(Debug, Default)]
struct Tally {
    /// Compared.
    all: usize,
    /// Of those, different or not kept yet.
    changed: usize,
    /// Scenes and pictures that could not be compared.
    broken: usize,
}

impl Tally {
    /// Says what became of a view.
    fn count(&mut self, place: &Place, outcome: &Outcome) -> Result<(), CliError> {
        let line = match outcome {
            Outcome::Same => "same",
            Outcome::Written => "written",
            Outcome::Different { how, .. } => how,
            Outcome::Missing => "not kept yet, --update keeps it",
        };
        print(format!("{}: {line}\n", visible(&place.path.to_string_lossy())).as_bytes())?;
        if let Outcome::Different { picture, .. } = outcome {
            print(picture)?;
        }
        self.all += 1;
        self.changed += usize::from(matches!(outcome, Outcome::Different { .. } | Outcome::Missing));
        Ok(())
    }

    /// Says why something could not be compared.
    fn fail(&mut self, error: &CliError) {
        error.report();
        self.broken += 1;
    }

    /// What all come to.
    fn verdict(&self) -> Result<(), CliError> {
        let Self { all, changed, broken } = self;
        let changed = (*changed > 0).then(|| {
            format!("{changed} of {all} pictures not as kept: where that is right, --update keeps what the scenes show now")
        });
        match (broken, changed) {
            (0, None) => Ok(()),
            (0, Some(changed)) => Err(CliError::Different(changed)),
            (broken, changed) => {
                let changed = changed.map_or_else(String::new, |changed| format!("; {changed}"));
                Err(CliError::Input(format!(
                    "{broken} of the scenes and pictures could not be compared{changed}"
                )))
            }
        }
    }
}

/// The picture that is kept in a file; `None` where there is none. One that is broken, as a merge leaves it,
/// counts as none where it is to be written again.
fn kept(path: &Path, update: bool) -> Result<Option<Grid<Level>>, CliError> {
    let name = path.to_string_lossy();
    let found = path.try_exists().map_err(|e| CliError::Input(format!("{}: {e}", visible(&name))))?;
    if !found {
        return Ok(None);
    }
    match levels::read(&name) {
        Ok(Source::Levels(levels)) => Ok(Some(levels)),
        Ok(Source::Bytes(_) | Source::Name) => Ok(None),
        Err(_) if update => Ok(None),
        Err(error) => Err(error),
    }
}

/// Compares one picture, and writes what is to be kept.
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
        let [own, other] = [shown, kept].map(levels::dots);
        let how = format!("it has {other} dots, and {own} are asked for");
        return Ok(Outcome::Different { how, picture: Vec::new() });
    };
    if difference.beyond(arguments.comparison.tolerance) == 0 {
        return Ok(Outcome::Same);
    }
    if arguments.update {
        return write();
    }
    Ok(Outcome::Different {
        how: marked::summary(&difference, arguments.comparison.tolerance),
        picture: marked::picture(shown, kept, arguments.comparison.marking())?,
    })
}

/// The views that are kept: all that have a name, else the scene's own.
fn named_views<'a>(names: impl Iterator<Item = Option<&'a str>>) -> Vec<Option<String>> {
    let named: Vec<_> = names.flatten().map(|name| Some(name.to_owned())).collect();
    if named.is_empty() { vec![None] } else { named }
}

/// Where one view is kept.
#[derive(Debug, PartialEq)]
struct Place {
    path: PathBuf,
    /// Its name; `None` for the view of a scene that names none.
    view: Option<String>,
}

/// All pictures of a run, by their files: of which scene and view each is.
#[derive(Default)]
struct Pictures(BTreeMap<PathBuf, String>);

impl Pictures {
    /// Where each view of a scene is kept: `part.levels`, or `part.front.levels` for a view `front`, beside
    /// the scene. Of a view's name letters, digits, `-` and `_` stay. Fails where two would be kept in one
    /// file.
    fn places(&mut self, scene: &str, views: Vec<Option<String>>) -> Result<Vec<Place>, CliError> {
        let file = Path::new(scene);
        let stem = file.file_stem().unwrap_or(file.as_os_str());
        let place = |view: Option<String>| {
            let mut name = stem.to_os_string();
            if let Some(view) = &view {
                let keep = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '-' };
                name.push(".");
                name.push(view.chars().map(keep).collect::<String>());
            }
            name.push(".levels");
            let path = file.with_file_name(name);
            let view_of = |view: &String| format!("the view `{view}` of {scene}");
            let own = view.as_ref().map_or_else(|| scene.to_owned(), view_of);
            match self.0.insert(path.clone(), own.clone()) {
                None => Ok(Place { path, view }),
                Some(other) => Err(CliError::Input(visible(&format!(
                    "{other} and {own} would both be kept as {}: rename one",
                    path.display()
                )))),
            }
        };
        views.into_iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(scene: &str, names: &[Option<&str>]) -> Result<Vec<String>, CliError> {
        let places = Pictures::default().places(scene, named_views(names.iter().copied()))?;
        Ok(places.into_iter().map(|place| place.path.to_string_lossy().into_owned()).collect())
    }

    #[test]
    fn each_named_view_has_a_file_beside_the_scene() {
        let paths = places("parts/a.csg", &[Some("front"), None, Some("from above/left")]).unwrap();
        assert_eq!(paths, ["parts/a.front.levels", "parts/a.from-above-left.levels"]);
        assert_eq!(places("a.csg", &[None]).unwrap(), ["a.levels"]);
    }

    #[test]
    fn pictures_that_would_share_a_file_are_refused() {
        assert!(places("a.csg", &[Some("a b"), Some("a-b")]).is_err());
        let mut pictures = Pictures::default();
        pictures.places("a.csg", vec![None]).unwrap();
        assert!(pictures.places("a.nff", vec![None]).is_err());
        pictures.places("c.scene", vec![Some("front".to_owned())]).unwrap();
        assert!(pictures.places("c.front.csg", vec![None]).is_err());
    }
}

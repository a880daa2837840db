//! What the viewer opens and saves while it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use clap::ValueEnum;

use crate::app::{Files, OpenedScene, Painter, Reloading, SaveFailure, SaveFormat, SaveOrder};
use crate::frame::Request;
use crate::scene::Scene;
use crate::stage::Progress;

use super::arguments::ReadingArguments;
use super::error::CliError;
use super::formats::StillFormat;
use super::input::{self, Onlooker};
use super::openscad::OpenScadRun;
use super::reload::WatchedScene;
use super::still;
use super::write::Destination;

/// The forms that a picture can be saved in: all that `render` writes.
pub fn formats() -> Vec<SaveFormat> {
    let values = StillFormat::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    let told = |value: clap::builder::PossibleValue| SaveFormat {
        name: value.get_name().to_owned(),
        holds: value.get_help().map(ToString::to_string).unwrap_or_default(),
    };
    values.map(told).collect()
}

/// The folder in which a scene was found; empty for that in which the program runs.
pub fn folder(file: &str) -> PathBuf {
    Path::new(file).parent().map(Path::to_owned).unwrap_or_default()
}

/// The files that scenes were read from while the viewer runs: none of them is written.
#[derive(Clone, Debug, Default)]
pub struct FilesSeen(Arc<Mutex<Vec<PathBuf>>>);

impl FilesSeen {
    fn note(&self, files: &[PathBuf]) {
        let mut seen = lock(&self.0);
        for file in files {
            if !seen.contains(file) {
                seen.push(file.clone());
            }
        }
    }

    fn all(&self) -> Vec<PathBuf> {
        lock(&self.0).clone()
    }
}

/// What one thread does after the other.
fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    // A thread that panics ends the program.
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A scene as the viewer has it: read now, and again as its files change.
pub struct ViewedScene {
    file: String,
    reading: ReadingArguments,
    onlooker: Onlooker,
    seen: FilesSeen,
    watched: Arc<Mutex<Option<WatchedScene>>>,
}

impl ViewedScene {
    /// The scene of a file, or one that is inside the program.
    pub fn new(file: &str, reading: &ReadingArguments, seen: FilesSeen) -> Self {
        let openscad = OpenScadRun::default();
        let onlooker = Onlooker { openscad, has_screen: true, ..Onlooker::default() };
        let watched = WatchedScene::new(file, reading, onlooker.clone());
        let watched = Arc::new(Mutex::new(watched));
        Self { file: file.to_owned(), reading: reading.clone(), onlooker, seen, watched }
    }

    /// Reads it for the first time; `progress` says how far that is. Where there is no screen yet, what is
    /// wrong is told as on standard error.
    pub fn read(&self, progress: Option<&Progress>, has_screen: bool) -> Result<Scene, CliError> {
        let onlooker = Onlooker { progress: progress.cloned(), has_screen, ..self.onlooker.clone() };
        match &mut *lock(&self.watched) {
            Some(watched) => {
                let scene = watched.read_for(&onlooker);
                self.seen.note(watched.files());
                scene
            }
            None => input::read_watched(&self.file, &self.reading, &onlooker),
        }
    }

    /// What comes after it.
    pub fn reloading(&self) -> Reloading {
        let end = lock(&self.watched).as_ref().map(WatchedScene::end);
        let (openscad, seen) = (self.onlooker.openscad.clone(), self.seen.clone());
        let watched = Arc::clone(&self.watched);
        let next = move || {
            let mut watched = lock(&watched);
            let watched = watched.as_mut()?;
            if !watched.wait() {
                return None;
            }
            let studio = watched.read().and_then(input::studio);
            seen.note(watched.files());
            Some(studio.map(|studio| Arc::new(studio) as Arc<dyn Painter>).map_err(|error| error.to_string()))
        };
        let end = move || {
            openscad.end();
            if let Some(end) = &end {
                end.end();
            }
        };
        Reloading { next: Box::new(next), end: Box::new(end) }
    }
}

/// Opens and saves for the viewer.
pub struct DeskFiles {
    /// How scenes are read.
    pub reading: ReadingArguments,
    /// What they were read from so far.
    pub seen: FilesSeen,
}

impl Files for DeskFiles {
    fn open(&self, name: &str) -> Result<OpenedScene, String> {
        if name == "-" {
            return Err("keys come from standard input: no scene does".to_owned());
        }
        let viewed = ViewedScene::new(name, &self.reading, self.seen.clone());
        let studio = viewed.read(None, true).and_then(input::studio).map_err(|error| error.to_string())?;
        Ok(OpenedScene {
            painter: Arc::new(studio),
            title: input::title(name),
            folder: folder(name),
            reloading: viewed.reloading(),
        })
    }

    fn save(&self, painter: &dyn Painter, request: &Request, order: &SaveOrder) -> Result<(), SaveFailure> {
        let because = |error: CliError| SaveFailure::Because(error.to_string());
        let format = StillFormat::from_str(&order.format, true).map_err(SaveFailure::Because)?;
        let to = Destination::File(order.path.clone());
        to.check_files(&self.seen.all()).map_err(because)?;
        // What is no plain file, a pipe or a device, loses nothing.
        let is_there =
            fs::symlink_metadata(&order.path).is_ok_and(|found| found.is_file() || found.is_symlink());
        if is_there && !order.replaces {
            return Err(SaveFailure::Exists);
        }
        let bytes = still::of_view(painter, request, format).map_err(because)?;
        to.write(&bytes).map_err(because)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::arguments::OpenScadArguments;
    use crate::frame::{Wants, pcat};
    use crate::glyph::{FourGrays, GlyphMode, Palette};

    fn files() -> DeskFiles {
        let openscad = OpenScadArguments::default();
        let reading = ReadingArguments {
            skip_unsupported: true,
            memory: None,
            root: None,
            up: None,
            facets: crate::scene::FacetMode::default(),
            digits: None,
            openscad,
        };
        DeskFiles { reading, seen: FilesSeen::default() }
    }

    #[test]
    fn scenes_are_opened_and_what_is_wrong_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let [good, bad] = ["good.scene", "bad.scene"].map(|name| folder.path().join(name));
        fs::write(&good, "cube(1);").unwrap();
        fs::write(&bad, "cubo(1);").unwrap();
        let files = files();
        for (name, title) in [(good.to_str().unwrap(), "good.scene"), ("die", "die.scene")] {
            let opened = files.open(name).unwrap();
            assert_eq!((opened.title.as_str(), opened.painter.scene().objects.is_empty()), (title, false));
            (opened.reloading.end)();
        }
        assert!(files.open(bad.to_str().unwrap()).unwrap_err().contains("cubo"));
        for name in ["-", "no such scene"] {
            assert!(files.open(name).is_err(), "{name}");
        }
    }

    #[test]
    fn every_format_is_saved_and_nothing_is_lost_silently() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("a.scene");
        fs::write(&scene, "camera(eye = [0, -9, 0]); light(at = [0, -9, 9]); sphere(1);").unwrap();
        let files = files();
        let opened = files.open(scene.to_str().unwrap()).unwrap();
        (opened.reloading.end)();
        let dots = crate::math::Size::new(16, 16);
        let camera = opened.painter.camera(0, 1.0);
        // As on a terminal of today, whose characters and colours not every format has.
        let palette = Palette::Dos(FourGrays::Indexed);
        let pcat = pcat::request(camera);
        let request = Request {
            dots,
            dot_aspect: 1.0,
            wants: Wants::CELLS,
            glyphs: GlyphMode::Blocks,
            palette,
            ..pcat
        };
        let save = |path: &Path, format: &SaveFormat, replaces| {
            let order = SaveOrder { path: path.to_owned(), format: format.name.clone(), replaces };
            files.save(&*opened.painter, &request, &order)
        };
        for format in formats() {
            let path = folder.path().join("picture").with_extension(&format.name);
            assert_eq!(save(&path, &format, false), Ok(()));
            let bytes = fs::read(&path).unwrap();
            assert!(!bytes.is_empty());
            assert_eq!(save(&path, &format, false), Err(SaveFailure::Exists));
            assert_eq!(save(&path, &format, true), Ok(()));
            assert_eq!(fs::read(&path).unwrap(), bytes);
        }
        let Err(SaveFailure::Because(why)) = save(&scene, &formats()[0], true) else { panic!("lost") };
        assert!(why.contains("would be lost"), "{why}");
    }
}

//! The fonts of the machine, looked for when the first text is written.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use fontdb::{Database, FaceInfo, Source, Stretch, Style};
use skrifa::string::StringId;
use skrifa::{FontRef, MetadataProvider};

use super::likeness::stand_ins;
use super::request::{FontRequest, key};

/// A font file larger than this is not read: 64 MiB; the largest that are known have 40.
const MAX_BYTES: u64 = 64 << 20;

/// The fonts that there are on the machine, looked for once, by the first text of all that share this.
#[derive(Clone, Default)]
pub struct KnownFonts(Arc<OnceLock<Vec<FaceInfo>>>);

impl std::fmt::Debug for KnownFonts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("KnownFonts").field(&self.0.get().map(Vec::len)).finish()
    }
}

/// What is known already makes no difference to what is read.
impl PartialEq for KnownFonts {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for KnownFonts {}

/// The fonts that texts of a scene are written in.
#[derive(Default)]
pub struct FontLibrary {
    known: KnownFonts,
    /// By the name that was asked for.
    chosen: HashMap<String, Option<ChosenFont>>,
    /// The files that were read.
    files: HashMap<PathBuf, Option<Arc<Vec<u8>>>>,
}

impl std::fmt::Debug for FontLibrary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FontLibrary").field("read", &self.files.keys()).finish_non_exhaustive()
    }
}

/// A font that was chosen for a name.
#[derive(Clone, Debug)]
pub struct ChosenFont {
    file: PathBuf,
    /// The number of the face in the file.
    pub index: u32,
    /// The family asked for, and the one taken, where that is another.
    pub replaced: Option<[String; 2]>,
    /// The style asked for, and the family, which has none of that name.
    pub without_style: Option<[String; 2]>,
}

impl FontLibrary {
    /// Of fonts that may have been looked for before.
    pub fn new(known: KnownFonts) -> Self {
        Self { known, ..Self::default() }
    }

    /// The font nearest to a name; none where there is no font at all.
    pub fn choose(&mut self, name: &str) -> Option<ChosenFont> {
        if let Some(chosen) = self.chosen.get(name) {
            return chosen.clone();
        }
        let chosen = self.nearest(&FontRequest::of(name));
        self.chosen.insert(name.to_owned(), chosen.clone());
        chosen
    }

    /// The bytes of its file; none where that is too large, or gone.
    pub fn bytes(&mut self, font: &ChosenFont) -> Option<Arc<Vec<u8>>> {
        self.files.entry(font.file.clone()).or_insert_with(|| read(&font.file).map(Arc::new)).clone()
    }

    fn nearest(&self, request: &FontRequest) -> Option<ChosenFont> {
        let faces = self.known.0.get_or_init(installed);
        let wanted = request.families.first().map_or("", String::as_str);
        let asked = request.families.iter().map(String::as_str);
        let names = asked.chain(request.families.iter().flat_map(|family| stand_ins(family)));
        let mut names = names.chain(stand_ins(""));
        let is_of = |face: &&FaceInfo, name: &str| face.families.iter().any(|(own, _)| key(own) == name);
        let found = names.find_map(|name| {
            let name = key(name);
            let family: Vec<&FaceInfo> = faces.iter().filter(|face| is_of(face, &name)).collect();
            best(&family, request)
        });
        // Of fonts that nobody knows, one of letters, not of signs.
        let others = || {
            let upright: Vec<&FaceInfo> = faces.iter().filter(|face| has_letters(face)).collect();
            best(&upright, request)
        };
        let (face, has_style) = found.or_else(others)?;
        let Source::File(file) = &face.source else { return None };
        let family = face.families.first().map_or(String::new(), |(name, _)| name.clone());
        let is_asked = is_of(&face, &key(wanted));
        Some(ChosenFont {
            file: file.clone(),
            index: face.index,
            replaced: (!is_asked).then(|| [wanted.to_owned(), family.clone()]),
            without_style: (!has_style).then(|| [request.style.clone(), family]),
        })
    }
}

/// The faces of the machine that are files, in the order of their names.
fn installed() -> Vec<FaceInfo> {
    let mut database = Database::new();
    database.load_system_fonts();
    // Where OpenSCAD looks, too.
    for folder in std::env::var_os("OPENSCAD_FONT_PATH").iter().flat_map(std::env::split_paths) {
        database.load_fonts_dir(folder);
    }
    let path = |face: &FaceInfo| match &face.source {
        Source::File(path) => Some(path.clone()),
        _ => None,
    };
    let mut faces: Vec<FaceInfo> =
        database.faces().filter(|face| matches!(face.source, Source::File(_))).cloned().collect();
    faces.sort_by_cached_key(|face| (path(face), face.index));
    faces.dedup_by(|a, b| path(a) == path(b) && a.index == b.index);
    faces
}

/// Of the faces of a family the one that is most as asked for, and whether its style is the one asked for. As
/// fontconfig has it, a style counts by its name only: where no face has that, the plain one is taken.
fn best<'f>(family: &[&'f FaceInfo], request: &FontRequest) -> Option<(&'f FaceInfo, bool)> {
    let style = key(&request.style);
    let named = |face: &FaceInfo| !style.is_empty() && styles(face).contains(&style);
    let off = |face: &FaceInfo| {
        let slant = u16::from((face.style != Style::Normal) != request.is_slanted);
        (slant, face.weight.0.abs_diff(request.weight), width(face.stretch).abs_diff(request.width))
    };
    let face = family.iter().copied().min_by_key(|face| (!named(face), off(face)))?;
    // What a family calls its plain face differs from one to the next.
    let is_plain = ["", "regular", "normal", "book", "roman"].contains(&style.as_str());
    Some((face, is_plain || named(face)))
}

fn width(stretch: Stretch) -> u16 {
    match stretch {
        Stretch::UltraCondensed => 1,
        Stretch::ExtraCondensed => 2,
        Stretch::Condensed => 3,
        Stretch::SemiCondensed => 4,
        Stretch::Normal => 5,
        Stretch::SemiExpanded => 6,
        Stretch::Expanded => 7,
        Stretch::ExtraExpanded => 8,
        Stretch::UltraExpanded => 9,
    }
}

/// The names of a face's style.
fn styles(face: &FaceInfo) -> Vec<String> {
    let names = |font: &FontRef<'_>| {
        [StringId::TYPOGRAPHIC_SUBFAMILY_NAME, StringId::SUBFAMILY_NAME]
            .into_iter()
            .flat_map(|id| font.localized_strings(id))
            .map(|name| key(&name.to_string()))
            .collect()
    };
    with_font(face, names).unwrap_or_default()
}

fn has_letters(face: &FaceInfo) -> bool {
    with_font(face, |font| font.charmap().map('a').is_some()).unwrap_or(false)
}

fn with_font<T>(face: &FaceInfo, f: impl Fn(&FontRef<'_>) -> T) -> Option<T> {
    let Source::File(path) = &face.source else { return None };
    let bytes = read(path)?;
    FontRef::from_index(&bytes, face.index).ok().map(|font| f(&font))
}

fn read(path: &Path) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(MAX_BYTES + 1).read_to_end(&mut bytes).ok()?;
    (bytes.len() as u64 <= MAX_BYTES).then_some(bytes)
}

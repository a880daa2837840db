//! The materials of an OBJ file, which are in a file beside it.

use std::collections::{HashMap, HashSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path};

use crate::math::DVec3;
use crate::scene::{Material, ReadOptions};

use super::super::words::MeshLines;

/// The largest file of materials that is read: a hundred thousand of them.
const MAX_BYTES: u64 = 16 << 20;

/// The materials, and which is current.
#[derive(Clone, Debug)]
pub struct MaterialLibrary {
    /// The first is that of faces without one.
    pub materials: Vec<Material>,
    /// The index of the one that faces get.
    pub current: u32,
    /// What is not as the file says.
    pub notes: Vec<String>,
    known: HashMap<Vec<u8>, u32>,
    /// Names that were said to be unknown.
    missed: HashSet<Vec<u8>>,
}

impl Default for MaterialLibrary {
    fn default() -> Self {
        Self {
            materials: vec![Material::default()],
            current: 0,
            notes: Vec::new(),
            known: HashMap::new(),
            missed: HashSet::new(),
        }
    }
}

/// So many notes are made of materials.
const MAX_NOTES: usize = 5;

impl MaterialLibrary {
    /// Makes a material the current one.
    pub fn choose(&mut self, name: &[u8]) {
        self.current = self.known.get(name).copied().unwrap_or(0);
        if self.current == 0 && self.missed.insert(name.to_vec()) {
            let name = String::from_utf8_lossy(name);
            self.note(format!("there is no material `{name}`: what is of it has the usual one"));
        }
    }

    /// Reads the materials of a file in the folder that the options name, and in no other.
    pub fn load(&mut self, name: &[u8], options: &ReadOptions) {
        let shown = String::from_utf8_lossy(name).into_owned();
        let path = Path::new(&shown);
        let mut parts = path.components().filter(|part| *part != Component::CurDir);
        let inside = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
        let bytes = match &options.folder {
            _ if !inside => Err("only a file beside the mesh is read".to_owned()),
            None => Err("it is not known where the mesh lies".to_owned()),
            Some(folder) => {
                let file = folder.join(path);
                if let Some(files) = &options.files {
                    files.add(&file);
                }
                read(&file).map_err(|error| error.to_string())
            }
        };
        match bytes {
            Ok(bytes) => self.add(&bytes, &shown),
            Err(why) => self.note(format!("the materials in `{shown}` are left out: {why}")),
        }
    }

    fn note(&mut self, note: String) {
        if self.notes.len() < MAX_NOTES {
            self.notes.push(note);
        }
    }

    /// Takes the names and diffuse colours of a file of materials.
    fn add(&mut self, bytes: &[u8], file: &str) {
        let mut open = None;
        for mut words in MeshLines::new(bytes) {
            let Some(word) = words.next() else { continue };
            if word.is("newmtl") {
                let name = words.rest_of_line();
                let shown = String::from_utf8_lossy(name).into_owned();
                self.materials.push(Material { name: Some(shown), ..Material::default() });
                self.known.insert(name.to_vec(), self.materials.len() as u32 - 1);
                open = self.materials.len().checked_sub(1);
            } else if word.bytes == b"Kd" {
                let numbers: Vec<f64> = words.map_while(|word| word.number("a colour").ok()).collect();
                match (open, numbers.as_slice()) {
                    (Some(material), &[r, g, b]) => {
                        // A colour of more than all light is white.
                        self.materials[material].color = DVec3::new(r, g, b).clamp(DVec3::ZERO, DVec3::ONE);
                    }
                    // One number stands for all three.
                    (Some(material), &[gray]) => {
                        self.materials[material].color = DVec3::splat(gray.clamp(0.0, 1.0));
                    }
                    _ => self.note(format!("a colour `Kd` in `{file}` is left out: it is not three numbers")),
                }
            }
        }
    }
}

/// The bytes of a file; not of a pipe or a device, which need not end.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is no plain file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(io::Error::other(format!("it is larger than {} MiB", MAX_BYTES >> 20)));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::FilesRead;

    #[test]
    fn colours_are_those_of_the_file() {
        let mut library = MaterialLibrary::default();
        library
            .add(b"# two\nnewmtl red one\nKd 0.5 0 7\nNs 3\nnewmtl gray\r\nKd .25\nKd a b c\n", "part.mtl");
        library.choose(b"red one");
        assert_eq!(library.materials[library.current as usize].color, DVec3::new(0.5, 0.0, 1.0));
        library.choose(b"gray");
        assert_eq!(library.materials[library.current as usize].color, DVec3::splat(0.25));
        assert_eq!(library.notes.len(), 1, "{:?}", library.notes);
        library.choose(b"none");
        library.choose(b"none");
        assert_eq!((library.current, library.notes.len()), (0, 2), "{:?}", library.notes);
    }

    #[test]
    fn only_what_lies_beside_is_read() {
        let mut library = MaterialLibrary::default();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let files = FilesRead::default();
        let options = ReadOptions {
            folder: Some(folder.clone()),
            files: Some(files.clone()),
            ..ReadOptions::default()
        };
        for name in ["../README.md", "/etc/hostname", "scene/mod.rs", "", "scene", "no such file"] {
            library.notes.clear();
            library.load(name.as_bytes(), &options);
            assert_eq!(library.notes.len(), 1, "{name}");
        }
        assert_eq!(library.materials.len(), 1);
        library.notes.clear();
        for _ in 0..2 {
            library.load(b"./lib.rs", &options);
        }
        assert!(files.all().contains(&folder.join("lib.rs")));
        assert_eq!(library.notes, Vec::<String>::new());
    }
}

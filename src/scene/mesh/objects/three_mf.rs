//! 3MF: a ZIP archive of XML, in which objects are meshes or made of others, and what is to be built is a
//! list of objects in their places. `docs/meshes.md` says what is read.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::super::fault::{MeshError, MeshFault};
use super::super::index::CornerNumbers;
use super::super::polygons::PolygonMesh;
use super::tree::{Instance, ModelObject, ObjectTree, shortened};
use super::zip::ZipArchive;
use crate::math::{DAffine3, DVec3};
use crate::scene::screen_colors::by_digits;
use crate::scene::xml::{XmlElement, XmlEvent, XmlText, number};
use crate::scene::{MAX_FILE_BYTES, Material};

/// The model where nothing says which file it is.
const USUAL: &str = "3D/3dmodel.model";

/// So many files of an archive are read: of a plate of many things each may be one.
const MOST_FILES: usize = 1000;

/// Extensions whose elements are other shapes, which are not there without them.
const SHAPES: [&str; 5] = ["beamlattice", "slicestack", "booleanshape", "displacementmesh", "levelset"];

/// Whether an archive is of this format.
pub fn is_three_mf(archive: &ZipArchive<'_>) -> bool {
    archive.names().any(|name| name.to_ascii_lowercase().ends_with(b".model"))
}

/// Reads a file, for which there are `room` bytes.
pub fn read(bytes: &[u8], room: u64) -> Result<PolygonMesh, MeshError> {
    let archive = ZipArchive::new(bytes)?;
    let mut left = room.min(MAX_FILE_BYTES);
    let mut model = Model::default();
    let root = root(&archive, &mut left)?;
    model.file(&root);
    let mut next = 0;
    while let Some(path) = model.paths.get(next).cloned() {
        let file = archive.read(path.as_bytes(), left)?;
        left -= file.len() as u64;
        let mut reader = ModelReader::new(&mut model, next as u32);
        reader.read(&file).map_err(|error| error.within(&path, &file))?;
        next += 1;
    }
    let mut mesh = model.tree.polygons("3MF", room)?;
    mesh.unit = Some(model.unit.unwrap_or("millimeter"));
    mesh.notes = model.notes;
    Ok(mesh)
}

/// The name of the file that the archive's relationships say is the model.
fn root(archive: &ZipArchive<'_>, left: &mut u64) -> Result<String, MeshError> {
    let file = match archive.read(b"_rels/.rels", *left) {
        Err(MeshError { fault: MeshFault::NoEntry(_), .. }) => return Ok(USUAL.to_owned()),
        file => file?,
    };
    *left -= file.len() as u64;
    let within = |error| MeshError::from(error).within("_rels/.rels", &file);
    let mut text = XmlText::new(&file).map_err(within)?;
    loop {
        match text.next().map_err(within)? {
            XmlEvent::Open(element) if element.name() == "Relationship" => {
                let is_model =
                    element.attribute("Type").map_err(within)?.is_some_and(|it| it.ends_with("3dmodel"));
                let target = element.attribute("Target").map_err(within)?;
                if let (true, Some(target)) = (is_model, target) {
                    return Ok(target.into_owned());
                }
            }
            XmlEvent::End => return Ok(USUAL.to_owned()),
            _ => {}
        }
    }
}

/// What is read of all files of a model.
#[derive(Debug)]
struct Model {
    tree: ObjectTree,
    unit: Option<&'static str>,
    notes: Vec<String>,
    /// The files that are named, the one whose list is built first; and the place of each by its name.
    paths: Vec<String>,
    known: HashMap<String, u32>,
}

impl Default for Model {
    fn default() -> Self {
        let tree = ObjectTree { materials: vec![Material::default()], ..ObjectTree::default() };
        Self { tree, unit: None, notes: Vec::new(), paths: Vec::new(), known: HashMap::new() }
    }
}

impl Model {
    /// The number of a file, which is to be read.
    fn file(&mut self, path: &str) -> u32 {
        let path = path.trim_start_matches('/');
        if let Some(&known) = self.known.get(path) {
            return known;
        }
        // What is named beyond them is not there.
        if self.paths.len() >= MOST_FILES {
            return u32::MAX;
        }
        self.paths.push(path.to_owned());
        self.known.insert(path.to_owned(), self.paths.len() as u32 - 1);
        self.paths.len() as u32 - 1
    }
}

/// Reads one file of a model.
struct ModelReader<'m> {
    model: &'m mut Model,
    /// The number of the file. Of the first the list is built.
    file: u32,
    /// By group of materials: the indices of its materials.
    groups: HashMap<i64, Vec<u32>>,
    group: i64,
    /// The object that is open, and its number.
    object: Option<(String, ModelObject)>,
    /// The group of materials, and the material, of its faces that say nothing else.
    usual: (Option<i64>, u32),
    /// The objects that are no part of the model.
    left_out: HashSet<String>,
}

impl<'m> ModelReader<'m> {
    fn new(model: &'m mut Model, file: u32) -> Self {
        Self {
            model,
            file,
            groups: HashMap::new(),
            group: 0,
            object: None,
            usual: (None, 0),
            left_out: HashSet::new(),
        }
    }

    fn read(&mut self, file: &[u8]) -> Result<(), MeshError> {
        let mut text = XmlText::rooted(file, "model")?;
        loop {
            match text.next()? {
                XmlEvent::Open(element) => self.open(&element)?,
                XmlEvent::Close(end) if end.name() == "object" => self.close(),
                XmlEvent::Close(_) | XmlEvent::Text(_) => {}
                XmlEvent::End => return Ok(()),
            }
        }
    }

    fn open(&mut self, element: &XmlElement<'_>) -> Result<(), MeshError> {
        match element.name() {
            "model" if self.file == 0 => {
                self.model.unit = element.attribute("unit")?.as_deref().and_then(unit);
            }
            "basematerials" | "colorgroup" => {
                self.group = element.index("id")?;
                self.groups.insert(self.group, Vec::new());
            }
            "base" => {
                self.material(
                    element,
                    "displaycolor",
                    element.attribute("name")?.map(|name| shortened(&name)),
                )?;
            }
            "color" => self.material(element, "color", None)?,
            "object" => self.object(element)?,
            "vertex" => {
                let point = DVec3::new(element.number("x")?, element.number("y")?, element.number("z")?);
                if let Some((_, object)) = &mut self.object {
                    object.points.push(point);
                }
            }
            "triangle" => self.triangle(element)?,
            "component" => {
                let instance = self.instance(element)?;
                if let Some((_, object)) = &mut self.object {
                    object.components.push(instance);
                }
            }
            "item" if self.file == 0 => {
                let instance = self.instance(element)?;
                let is_own = instance.object.0 == self.file;
                if !(is_own && self.left_out.contains(&instance.object.1)) {
                    self.model.tree.items.push(instance);
                }
            }
            name => {
                if SHAPES.contains(&name) {
                    let note = format!("`{name}`, an extension of 3MF, is left out");
                    if !self.model.notes.contains(&note) {
                        self.model.notes.push(note);
                    }
                }
            }
        }
        Ok(())
    }

    fn material(
        &mut self,
        element: &XmlElement<'_>,
        attribute: &str,
        name: Option<String>,
    ) -> Result<(), MeshError> {
        // Of another extension's elements of this name nothing is known.
        let Some(written) = element.attribute(attribute)? else { return Ok(()) };
        let color = color(&written).ok_or_else(|| {
            MeshFault::Unexpected(format!("a colour as #RRGGBB in `{attribute}`")).at(element.place.clone())
        })?;
        let materials = &mut self.model.tree.materials;
        materials.push(Material { name, color, ..Material::default() });
        let index = materials.len() as u32 - 1;
        if let Some(group) = self.groups.get_mut(&self.group) {
            group.push(index);
        }
        Ok(())
    }

    /// The material that a group and a place in it name, where both are known.
    fn named(&self, group: Option<i64>, place: Option<i64>) -> Option<u32> {
        let group = self.groups.get(&group?)?;
        group.get(usize::try_from(place?).ok()?).copied()
    }

    fn object(&mut self, element: &XmlElement<'_>) -> Result<(), MeshError> {
        let id = name_of(element, "id")?;
        if element.attribute("type")?.is_some_and(|kind| kind == "support" || kind == "other") {
            self.left_out.insert(id.clone());
        }
        let name = element.attribute("name")?.map(|name| shortened(&name));
        self.object = Some((id, ModelObject { name, ..ModelObject::default() }));
        let group = optional(element, "pid")?;
        self.usual = (group, self.named(group, optional(element, "pindex")?).unwrap_or(0));
        Ok(())
    }

    fn triangle(&mut self, element: &XmlElement<'_>) -> Result<(), MeshError> {
        let group = optional(element, "pid")?.or(self.usual.0);
        let material = self.named(group, optional(element, "p1")?).unwrap_or(self.usual.1);
        let Some((_, object)) = &mut self.object else { return Ok(()) };
        let known = CornerNumbers::from_zero(object.points.len());
        let corner = |name: &str| {
            let index = element.index(name)?;
            known.corner(index).map_err(|fault| fault.at(element.place.clone()))
        };
        let triangle = [corner("v1")?, corner("v2")?, corner("v3")?];
        object.begin_run(0, material);
        object.triangles.push(triangle);
        Ok(())
    }

    fn instance(&mut self, element: &XmlElement<'_>) -> Result<Instance, MeshError> {
        let file = match element.attribute("path")? {
            Some(path) => self.model.file(&path),
            None => self.file,
        };
        let map = match element.attribute("transform")? {
            Some(written) => map(&written).map_err(|fault| fault.at(element.place.clone()))?,
            None => DAffine3::IDENTITY,
        };
        Ok(Instance { object: (file, name_of(element, "objectid")?), map })
    }

    fn close(&mut self) {
        if let Some((id, object)) = self.object.take() {
            self.model.tree.objects.insert((self.file, id), object);
        }
    }
}

/// The whole number that an attribute is, where it is there.
fn optional(element: &XmlElement<'_>, attribute: &str) -> Result<Option<i64>, MeshError> {
    Ok(element.attribute(attribute)?.map(|_| element.index(attribute)).transpose()?)
}

/// The name by which an object is known.
fn name_of(element: &XmlElement<'_>, attribute: &str) -> Result<String, MeshError> {
    let missing = || MeshFault::Unexpected(format!("an attribute `{attribute}`")).at(element.place.clone());
    element.attribute(attribute)?.map(Cow::into_owned).ok_or_else(missing)
}

/// The unit that a model names.
fn unit(name: &str) -> Option<&'static str> {
    ["micron", "millimeter", "centimeter", "inch", "foot", "meter"].into_iter().find(|unit| *unit == name)
}

/// A map as twelve numbers, of which three are a column.
fn map(written: &str) -> Result<DAffine3, MeshFault> {
    let numbers: Vec<f64> =
        written.split_ascii_whitespace().map(|word| number(word, "transform")).collect::<Result<_, _>>()?;
    let columns: [f64; 12] =
        numbers.try_into().map_err(|_| MeshFault::Unexpected("twelve numbers in `transform`".to_owned()))?;
    let map = DAffine3::from_cols_array(&columns);
    let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
    let largest = x.abs().max(y.abs()).max(z.abs()).max_element();
    // Scaled, so that no product of numbers that are small or large counts as none.
    let flattens = (map.matrix3 * largest.recip()).determinant() == 0.0 || largest == 0.0;
    if flattens {
        Err(MeshFault::Unsupported("a `transform` that flattens what it moves".to_owned()))
    } else {
        Ok(map)
    }
}

/// A colour as `#RRGGBB` or `#RRGGBBAA`, as linear light; how much is seen through it is not read.
fn color(written: &str) -> Option<DVec3> {
    by_digits(written.trim().strip_prefix('#')?).map(|(color, _)| color)
}

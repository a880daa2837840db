//! AMF, the Additive Manufacturing File Format: XML, alone or in a ZIP archive, in which objects are volumes
//! of triangles and constellations of other objects. `docs/meshes.md` says what is read.

use std::collections::{HashMap, HashSet};

use super::super::fault::{MeshError, MeshFault};
use super::super::index::CornerNumbers;
use super::super::polygons::PolygonMesh;
use super::tree::{Instance, ModelObject, ObjectTree};
use super::zip::{ZipArchive, is_zip};
use crate::math::{DAffine3, DMat3, DVec3};
use crate::scene::degrees;
use crate::scene::xml::{XmlElement, XmlEvent, XmlText, index, number, outermost};
use crate::scene::{MAX_FILE_BYTES, Material};

/// Whether the bytes are a text of this format.
pub fn is_amf(bytes: &[u8]) -> bool {
    outermost(bytes).is_some_and(|name| name == "amf")
}

/// The name of the model in an archive; none of an archive that holds none.
pub fn entry<'a>(archive: &ZipArchive<'a>) -> Option<&'a [u8]> {
    archive.names().find(|name| name.to_ascii_lowercase().ends_with(b".amf"))
}

/// Reads a file, for which there are `room` bytes.
pub fn read(bytes: &[u8], room: u64) -> Result<PolygonMesh, MeshError> {
    if !is_zip(bytes) {
        return read_text(bytes, room);
    }
    let archive = ZipArchive::new(bytes)?;
    let name = entry(&archive).ok_or_else(|| MeshFault::NoEntry("*.amf".to_owned()).of_all())?;
    let text = archive.read(name, room.min(MAX_FILE_BYTES))?;
    let left = room.saturating_sub(text.len() as u64);
    read_text(&text, left).map_err(|error| error.within(&String::from_utf8_lossy(name), &text))
}

fn read_text(bytes: &[u8], room: u64) -> Result<PolygonMesh, MeshError> {
    let mut reader = AmfReader::default();
    reader.tree.materials.push(Material::default());
    let mut text = XmlText::rooted(bytes, "amf")?;
    loop {
        match text.next()? {
            XmlEvent::Open(element) => reader.open(&element)?,
            XmlEvent::Text(word) => reader.words.push_str(&word),
            XmlEvent::Close(end) => reader.close(end.name()).map_err(|fault| fault.at(text.place.clone()))?,
            XmlEvent::End => break,
        }
    }
    let unit = reader.unit.unwrap_or("millimeter");
    let mut mesh = reader.finished().polygons("AMF", room)?;
    mesh.unit = Some(unit);
    Ok(mesh)
}

/// What is open, and what has been read.
#[derive(Default)]
struct AmfReader {
    tree: ObjectTree,
    unit: Option<&'static str>,
    /// The elements that are open, the innermost last.
    path: Vec<&'static str>,
    /// The text of the innermost.
    words: String,
    /// By number: the index of a material.
    materials: HashMap<String, u32>,
    /// The object or constellation that is open, and its number.
    object: Option<(String, ModelObject)>,
    /// The numbers of objects, in the order of the file, and whether it is a constellation.
    order: Vec<(String, bool)>,
    /// The material of the volume that is open, and its number among those of the object.
    material: u32,
    part: usize,
    /// Numbers that are being read.
    point: DVec3,
    corners: [u32; 3],
    color: DVec3,
    /// The object, the way and the turns of an instance.
    placed: (String, DVec3, DVec3),
}

impl AmfReader {
    fn open(&mut self, element: &XmlElement<'_>) -> Result<(), MeshError> {
        self.words.clear();
        let id = |name: &str| Ok::<_, MeshError>(element.attribute(name)?.unwrap_or_default().into_owned());
        match element.name() {
            "amf" => self.unit = element.attribute("unit")?.as_deref().and_then(unit),
            "object" | "constellation" => {
                let id = id("id")?;
                self.order.push((id.clone(), element.name() == "constellation"));
                self.object = Some((id, ModelObject::default()));
                (self.part, self.material) = (0, 0);
            }
            "volume" => {
                self.part += 1;
                let named = id("materialid")?;
                self.material = self.materials.get(&named).copied().unwrap_or(0);
                // Materials may come behind the objects that are of them.
                if self.material == 0 && !named.is_empty() {
                    self.material = self.new_material(named);
                }
            }
            "material" => {
                let id = id("id")?;
                self.material = match self.materials.get(&id) {
                    Some(&known) => known,
                    None => self.new_material(id),
                };
            }
            "vertex" => self.point = DVec3::ZERO,
            "color" => self.color = DVec3::ZERO,
            "triangle" => self.corners = [u32::MAX; 3],
            "instance" => self.placed = (id("objectid")?, DVec3::ZERO, DVec3::ZERO),
            _ => {}
        }
        self.path.push(known(element.name()));
        Ok(())
    }

    fn new_material(&mut self, id: String) -> u32 {
        self.tree.materials.push(Material::default());
        let index = self.tree.materials.len() as u32 - 1;
        self.materials.insert(id, index);
        index
    }

    fn close(&mut self, name: &str) -> Result<(), MeshFault> {
        self.path.pop();
        let parent = self.path.last().copied().unwrap_or_default();
        match (parent, name) {
            ("coordinates", "x" | "y" | "z") => self.point[axis(name)] = number(&self.words, name)?,
            ("mesh" | "vertices", "vertex") => {
                if let Some((_, object)) = &mut self.object {
                    object.points.push(self.point);
                }
            }
            ("triangle", "v1" | "v2" | "v3") => {
                let count = self.object.as_ref().map_or(0, |(_, object)| object.points.len());
                let corner = CornerNumbers::from_zero(count).corner(index(&self.words, name)?)?;
                self.corners[usize::from(name.as_bytes()[1] - b'1')] = corner;
            }
            ("volume", "triangle") => {
                if self.corners.contains(&u32::MAX) {
                    return Err(MeshFault::Unexpected("`v1`, `v2` and `v3` of a triangle".to_owned()));
                }
                if let Some((_, object)) = &mut self.object {
                    object.begin_run(self.part, self.material);
                    object.triangles.push(self.corners);
                }
            }
            ("color", "r" | "g" | "b") => {
                let channel = ["r", "g", "b"].iter().position(|own| *own == name).unwrap_or(0);
                self.color[channel] = number(&self.words, name)?.clamp(0.0, 1.0);
            }
            ("material" | "volume", "color") => {
                if parent == "volume" || self.material == 0 {
                    self.tree.materials.push(Material::default());
                    self.material = self.tree.materials.len() as u32 - 1;
                }
                self.tree.materials[self.material as usize].color = self.color;
            }
            ("instance", "deltax" | "deltay" | "deltaz") => {
                self.placed.1[axis(&name[5..])] = number(&self.words, name)?;
            }
            ("instance", "rx" | "ry" | "rz") => self.placed.2[axis(&name[1..])] = number(&self.words, name)?,
            ("constellation", "instance") => {
                let (object, way, turns) = std::mem::take(&mut self.placed);
                if let Some((_, constellation)) = &mut self.object {
                    let map = DAffine3 { matrix3: turned(turns), translation: way };
                    constellation.components.push(Instance { object: (0, object), map });
                }
            }
            (_, "object" | "constellation") => {
                if let Some((id, object)) = self.object.take() {
                    self.tree.objects.insert((0, id), object);
                }
            }
            _ => {}
        }
        self.words.clear();
        Ok(())
    }

    /// All objects, and what is built of them: constellations that are no part of another; without any, each
    /// object where it is.
    fn finished(mut self) -> ObjectTree {
        let components = self.tree.objects.values().flat_map(|object| &object.components);
        let parts: HashSet<&String> = components.map(|it| &it.object.1).collect();
        let mut built: Vec<&String> =
            self.order.iter().filter(|(id, whole)| *whole && !parts.contains(id)).map(|(id, _)| id).collect();
        // Where constellations are all parts of each other, building them tells that.
        if built.is_empty() {
            built = self.order.iter().map(|(id, _)| id).collect();
        }
        let item = |id: &String| Instance { object: (0, id.clone()), map: DAffine3::IDENTITY };
        self.tree.items = built.into_iter().map(item).collect();
        self.tree
    }
}

fn axis(name: &str) -> usize {
    match name {
        "x" => 0,
        "y" => 1,
        _ => 2,
    }
}

/// Turns about x, then y, then z, by degrees.
fn turned(degrees: DVec3) -> DMat3 {
    let [(sx, cx), (sy, cy), (sz, cz)] =
        degrees.to_array().map(|angle| (degrees::sin(angle), degrees::cos(angle)));
    let x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
    let y = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let z = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
    z * y * x
}

/// The elements within which others mean something.
const HOLDERS: [&str; 10] = [
    "coordinates",
    "mesh",
    "vertices",
    "triangle",
    "volume",
    "color",
    "material",
    "instance",
    "constellation",
    "vertex",
];

fn known(name: &str) -> &'static str {
    HOLDERS.into_iter().find(|holder| *holder == name).unwrap_or_default()
}

/// The unit that a file names.
fn unit(name: &str) -> Option<&'static str> {
    ["micron", "millimeter", "inch", "feet", "meter"].into_iter().find(|unit| name.eq_ignore_ascii_case(unit))
}

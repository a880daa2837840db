//! One solid, written in every format of meshes.

use std::io::Write;

/// Corners and faces that name them, each turning to the left seen from outside.
#[derive(Clone, Debug)]
pub struct MeshText {
    pub points: Vec<[f32; 3]>,
    pub faces: Vec<Vec<u32>>,
}

impl MeshText {
    /// A box of three sizes.
    pub fn brick() -> Self {
        let points = (0..8).map(|i: usize| [[0.0, 2.0][i & 1], [0.0, 1.5][i >> 1 & 1], [0.0, 3.0][i >> 2]]);
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Self { points: points.collect(), faces: faces.map(Vec::from).to_vec() }
    }

    pub fn tetrahedron() -> Self {
        let points = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.25], [0.5, 1.75, 0.0], [0.5, 0.5, 1.5]];
        Self { points, faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(Vec::from).to_vec() }
    }

    /// The faces cut into triangles, which their first corners are common to.
    fn triangles(&self) -> Vec<[[f32; 3]; 3]> {
        self.fans().map(|corners| corners.map(|corner| self.points[corner as usize])).collect()
    }

    fn fans(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.faces.iter().flat_map(|face| (1..face.len() - 1).map(|i| [face[0], face[i], face[i + 1]]))
    }

    /// Binary STL with this header, which has up to 80 bytes.
    pub fn stl_binary(&self, header: &[u8]) -> Vec<u8> {
        let triangles = self.triangles();
        let mut bytes = header.to_vec();
        bytes.resize(80, 0);
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    pub fn stl_text(&self) -> String {
        let mut text = "solid a part\n".to_owned();
        for triangle in self.triangles() {
            text += "facet normal 0 0 0\n  outer loop\n";
            for [x, y, z] in triangle {
                text += &format!("    vertex {x} {y} {z:e}\n");
            }
            text += "  endloop\nendfacet\n";
        }
        text + "endsolid a part\n"
    }

    pub fn off(&self) -> String {
        let mut text =
            format!("OFF\n# corners, faces, edges\n{} {} 0\n", self.points.len(), self.faces.len());
        for [x, y, z] in &self.points {
            text += &format!("{x} {y} {z}\n");
        }
        for face in &self.faces {
            text += &format!("{} {}\n", face.len(), words(face.iter()));
        }
        text
    }

    fn ply_header(&self, format: &str, coordinate: &str, count: &str) -> String {
        format!(
            "ply\nformat {format} 1.0\ncomment of no account\nelement vertex {}\nproperty {coordinate} x\nproperty {coordinate} y\n\
             property {coordinate} z\nproperty uchar red\nelement face {}\nproperty list {count} int vertex_indices\nend_header\n",
            self.points.len(),
            self.faces.len()
        )
    }

    pub fn ply_ascii(&self) -> String {
        let mut text = self.ply_header("ascii", "float", "uchar");
        for [x, y, z] in &self.points {
            text += &format!("{x} {y} {z} 255\n");
        }
        for face in &self.faces {
            text += &format!("{} {}\n", face.len(), words(face.iter()));
        }
        text
    }

    pub fn ply_little(&self) -> Vec<u8> {
        let mut bytes = self.ply_header("binary_little_endian", "float", "uchar").into_bytes();
        for point in &self.points {
            bytes.extend(point.iter().flat_map(|number| number.to_le_bytes()));
            bytes.push(255);
        }
        for face in &self.faces {
            bytes.push(face.len() as u8);
            bytes.extend(face.iter().flat_map(|&corner| corner.to_le_bytes()));
        }
        bytes
    }

    pub fn ply_big(&self) -> Vec<u8> {
        let mut bytes = self.ply_header("binary_big_endian", "double", "ushort").into_bytes();
        for point in &self.points {
            bytes.extend(point.iter().flat_map(|&number| f64::from(number).to_be_bytes()));
            bytes.push(255);
        }
        for face in &self.faces {
            bytes.extend((face.len() as u16).to_be_bytes());
            bytes.extend(face.iter().flat_map(|&corner| corner.to_be_bytes()));
        }
        bytes
    }

    /// OBJ, whose first face names corners from the last backwards.
    pub fn obj(&self) -> String {
        let mut text = "# a part\no part\n".to_owned();
        for [x, y, z] in &self.points {
            text += &format!("v {x} {y} {z}\n");
        }
        text += "vn 0 0 1\n";
        let count = i64::try_from(self.points.len()).unwrap();
        for (number, face) in self.faces.iter().enumerate() {
            let corner = |&corner: &u32| match number {
                0 => format!("{}", i64::from(corner) - count),
                _ => format!("{}//1", corner + 1),
            };
            text += &format!("f {}\n", words(face.iter().map(corner)));
        }
        text
    }

    /// The model of a 3MF file.
    pub fn model(&self) -> String {
        let vertex = |[x, y, z]: &[f32; 3]| format!("<vertex x=\"{x}\" y=\"{y}\" z=\"{z:e}\"/>");
        let triangle = |[a, b, c]: [u32; 3]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>\n");
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
             xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n<object id=\"7\" \
             type=\"model\"><mesh><vertices>\n{}\n</vertices><triangles>\n{}</triangles></mesh></object></resources>\n\
             <build><item objectid=\"7\"/></build></model>\n",
            self.points.iter().map(vertex).collect::<String>(),
            self.fans().map(triangle).collect::<String>()
        )
    }

    pub fn three_mf(&self) -> Vec<u8> {
        three_mf(&self.model())
    }

    pub fn amf(&self) -> String {
        let vertex = |[x, y, z]: &[f32; 3]| {
            format!("<vertex><coordinates><x>{x}</x><y>{y}</y><z> {z:e} </z></coordinates></vertex>\n")
        };
        let triangle =
            |[a, b, c]: [u32; 3]| format!("<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>\n");
        format!(
            "<?xml version=\"1.0\"?>\n<!-- a part -->\n<amf unit=\"inch\">\n<object id=\"0\"><mesh>\n<vertices>\n{}\
             </vertices>\n<volume>\n{}</volume></mesh></object></amf>\n",
            self.points.iter().map(vertex).collect::<String>(),
            self.fans().map(triangle).collect::<String>()
        )
    }

    /// OpenSCAD's `polyhedron`.
    pub fn polyhedron(&self) -> String {
        format!("polyhedron(points = {:?}, faces = {:?});", self.points, self.faces)
    }

    /// All formats, by the name that a file would have.
    pub fn files(&self) -> Vec<(&'static str, Vec<u8>)> {
        vec![
            ("binary.stl", self.stl_binary(b"made by a test")),
            ("solid.stl", self.stl_binary(b"solid but binary")),
            ("text.stl", self.stl_text().into_bytes()),
            ("part.off", self.off().into_bytes()),
            ("ascii.ply", self.ply_ascii().into_bytes()),
            ("little.ply", self.ply_little()),
            ("big.ply", self.ply_big()),
            ("part.obj", self.obj().into_bytes()),
            ("part.3mf", self.three_mf()),
            ("part.amf", self.amf().into_bytes()),
            ("zipped.amf", zip(&[("part.amf", self.amf().as_bytes())])),
            ("part.stl.gz", gzip(&self.stl_binary(b"packed"))),
        ]
    }
}

fn words(list: impl Iterator<Item = impl ToString>) -> String {
    list.map(|item| item.to_string()).collect::<Vec<_>>().join(" ")
}

/// What says which file of a 3MF archive is the model.
const RELATIONSHIPS: &str = "<?xml version=\"1.0\"?><Relationships \
     xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"rel0\" \
     Target=\"/3D/model.model\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

/// A 3MF file of this model.
pub fn three_mf(model: &str) -> Vec<u8> {
    zip(&[("_rels/.rels", RELATIONSHIPS.as_bytes()), ("3D/model.model", model.as_bytes())])
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A ZIP archive, whose first entry is stored and whose others are deflated.
pub fn zip(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (number, (name, file)) in entries.iter().enumerate() {
        let mut check = flate2::Crc::new();
        check.update(file);
        let mut encoder = flate2::write::DeflateEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(file).unwrap();
        let packed = if number == 0 { file.to_vec() } else { encoder.finish().unwrap() };
        let mut about = [20_u16, 0, if number == 0 { 0 } else { 8 }, 0, 0].map(u16::to_le_bytes).concat();
        about.extend([check.sum(), packed.len() as u32, file.len() as u32].map(u32::to_le_bytes).concat());
        about.extend([name.len() as u16, 0].map(u16::to_le_bytes).concat());
        directory.extend([&b"PK\x01\x02\x14\0"[..], &about, &[0; 10]].concat());
        directory.extend((bytes.len() as u32).to_le_bytes());
        directory.extend(name.as_bytes());
        bytes.extend([&b"PK\x03\x04"[..], &about, name.as_bytes(), &packed].concat());
    }
    let (at, count) = (bytes.len() as u32, entries.len() as u16);
    bytes.extend(&directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend([count, count].map(u16::to_le_bytes).concat());
    bytes.extend([directory.len() as u32, at].map(u32::to_le_bytes).concat());
    bytes.extend([0; 2]);
    bytes
}

//! Solids under a grid of heights, from pictures and tables: OpenSCAD's `surface`.

mod picture;
mod table;

use super::Mesh;
use super::triangulation::cancel_pairs;
use crate::math::DVec3;

/// Heights above a grid of places one unit apart: rows along y, each along x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heightmap {
    columns: usize,
    heights: Vec<f64>,
    /// The height of the plane that the solid stands on.
    base: f64,
}

/// A file of heights as it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeightFile {
    /// The heights.
    pub map: Heightmap,
    /// The line, from 1, at which reading ended because of something that is no number.
    pub ended_at: Option<usize>,
}

/// Why a file has no heights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoHeights {
    /// There is not that much memory.
    TooLarge,
    /// It is no picture that can be read, by what its reader says.
    Unreadable(String),
}

/// Bytes that a height takes, in the map and as corners and triangles of the solid while that is made.
pub const OF_HEIGHT: u64 = 200;

impl Heightmap {
    /// Reads a PNG picture, of which `is_inverted` is OpenSCAD's `invert`, or a table of numbers; of at most
    /// so many heights.
    pub fn read(bytes: &[u8], is_inverted: bool, most: usize) -> Result<HeightFile, NoHeights> {
        if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            let map = picture::heights(bytes, is_inverted, most)?;
            return Ok(HeightFile { map, ended_at: None });
        }
        table::heights(bytes, most)
    }

    /// Of heights in rows of so many. Those that were read and not made up say where the plane is below them.
    fn new(columns: usize, heights: Vec<f64>, read: impl Iterator<Item = f64>) -> Self {
        let base = read.fold(0.0, |base: f64, height| base.min(height - 1.0));
        Self { columns, heights, base }
    }

    /// How many rows there are.
    fn rows(&self) -> usize {
        self.heights.len() / self.columns.max(1)
    }

    /// The solid between the heights and a plane, which is 1 below the least of them, but not above 0; none
    /// where it has no area. Its first place is at the origin, or its middle is.
    pub fn mesh(&self, is_centred: bool) -> Option<Mesh> {
        let (rows, columns) = (self.rows(), self.columns);
        if rows < 2 || columns < 2 {
            return None;
        }
        let base = self.base;
        let middle = DVec3::new((columns - 1) as f64, (rows - 1) as f64, 0.0) * 0.5;
        let start = if is_centred { -middle } else { DVec3::ZERO };
        let place = |row: usize, column: usize, height: f64| {
            // Adding 0 makes −0 and 0 the same point.
            start + DVec3::new(column as f64, row as f64, height) + DVec3::ZERO
        };
        let at = |row: usize, column: usize| self.heights[row * columns + column];
        let mut points: Vec<DVec3> = (0..rows * columns)
            .map(|index| place(index / columns, index % columns, self.heights[index]))
            .collect();
        let mut triangles = Vec::new();
        for row in 1..rows {
            for column in 1..columns {
                let corner = |r: usize, c: usize| (r * columns + c) as u32;
                let around = [
                    corner(row - 1, column - 1),
                    corner(row - 1, column),
                    corner(row, column),
                    corner(row, column - 1),
                ];
                // In OpenSCAD's order, so that the sum is the same.
                let sum =
                    at(row - 1, column - 1) + at(row - 1, column) + at(row, column - 1) + at(row, column);
                let top = points.len() as u32;
                points.push(place(row, column, 0.25 * sum) - DVec3::new(0.5, 0.5, 0.0));
                triangles.extend((0..4).map(|i| [around[i], around[(i + 1) % 4], top]));
            }
        }
        let rim = rim(rows, columns);
        // By place on the rim: its point in the base, which is that above where it is as low.
        let below: Vec<u32> = rim
            .iter()
            .map(|&above| {
                let point = points[above as usize];
                if point.z == base {
                    return above;
                }
                points.push(point.with_z(base));
                points.len() as u32 - 1
            })
            .collect();
        let centre = points.len() as u32;
        points.push((start + middle).with_z(base));
        for i in 0..rim.len() {
            let next = (i + 1) % rim.len();
            triangles.push([below[i], below[next], rim[next]]);
            triangles.push([below[i], rim[next], rim[i]]);
            triangles.push([below[next], below[i], centre]);
        }
        let is_face = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let mut faces: Vec<_> = triangles.into_iter().filter(is_face).map(|face| (face, ())).collect();
        cancel_pairs(&mut faces);
        Some(Mesh { points, triangles: faces.into_iter().map(|(face, ())| face).collect() })
    }
}

/// The places around a grid, counter-clockwise seen from above.
fn rim(rows: usize, columns: usize) -> Vec<u32> {
    let corner = |row: usize, column: usize| (row * columns + column) as u32;
    let front = (0..columns - 1).map(|column| corner(0, column));
    let right = (0..rows - 1).map(|row| corner(row, columns - 1));
    let back = (1..columns).rev().map(|column| corner(rows - 1, column));
    let left = (1..rows).rev().map(|row| corner(row, 0));
    front.chain(right).chain(back).chain(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Bounds;
    use crate::scene::triangulation::EdgeSet;

    fn mesh(bytes: &[u8], is_centred: bool) -> Mesh {
        let file = Heightmap::read(bytes, false, 1000).expect("heights");
        file.map.mesh(is_centred).expect("a solid")
    }

    fn assert_closed(mesh: &Mesh) {
        let faces: Vec<_> = mesh.triangles.iter().map(|&triangle| (triangle, ())).collect();
        assert!(EdgeSet::of(&faces).is_empty(), "{mesh:?}");
    }

    /// Six times the volume.
    fn volume(mesh: &Mesh) -> f64 {
        let signed = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| mesh.points[i as usize]);
            a.dot(b.cross(c))
        };
        mesh.triangles.iter().map(signed).sum()
    }

    #[test]
    fn a_table_is_a_closed_solid_on_a_plane_below_it() {
        let found = mesh(b"# heights\n1 2 3\n\n4 5 6\n  0\t0 1\r\n", false);
        assert_closed(&found);
        let bounds = Bounds::around(found.points.iter().copied());
        assert_eq!(bounds, Bounds::new(DVec3::new(0.0, 0.0, -1.0), DVec3::new(2.0, 2.0, 6.0)));
        // Under each cell the mean of its heights.
        let expected =
            (1.0 + 2.0 + 5.0 + 4.0 + 2.0 + 3.0 + 6.0 + 5.0 + 4.0 + 5.0 + 5.0 + 6.0 + 1.0) / 4.0 + 4.0;
        assert!((volume(&found) / 6.0 - expected).abs() < 1e-12, "{} {expected}", volume(&found) / 6.0);
        let above = mesh(b"5 6\n7 8", true);
        assert_closed(&above);
        assert_eq!((above.points[0], volume(&above)), (DVec3::new(-0.5, -0.5, 5.0), 6.0 * 6.5));
    }

    #[test]
    fn what_is_missing_is_0_and_what_is_no_number_ends_it() {
        let file = Heightmap::read(b"1 2 3\n4 5\n", false, 1000).expect("heights");
        assert_eq!(file.map.heights, [1.0, 2.0, 3.0, 4.0, 5.0, 0.0]);
        assert_closed(&file.map.mesh(false).expect("a solid, whose rim meets its base"));
        for (text, line) in [("5 6\n7 x\n1 2", 2), ("5 6\n7 nan", 2), ("\n5 6\n7 1e999", 3)] {
            let file = Heightmap::read(text.as_bytes(), false, 1000).expect("heights");
            assert_eq!((file.map.heights.as_slice(), file.ended_at), (&[5.0, 6.0, 7.0, 0.0][..], Some(line)));
        }
        for text in ["", "1 2 3", "1\n2\n3", "# 1 2", "\u{ff}\0"] {
            assert_eq!(Heightmap::read(text.as_bytes(), false, 1000).expect("none").map.mesh(false), None);
        }
        // A long line makes all others as long.
        let ragged = format!("{}\n{}", "1 ".repeat(600), "1\n".repeat(600));
        assert_eq!(Heightmap::read(ragged.as_bytes(), false, 1000), Err(NoHeights::TooLarge));
    }

    #[test]
    fn a_picture_is_up_to_100_high_and_its_last_row_is_in_front() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header().unwrap().write_image_data(&[255, 0, 51, 102]).unwrap();
        let map = Heightmap::read(&bytes, false, 4).unwrap().map;
        for (found, expected) in map.heights.iter().zip([20.0, 40.0, 100.0, 0.0]) {
            assert!((found - expected).abs() < 1e-12, "{map:?}");
        }
        // OpenSCAD's `invert` takes grays, which go up to 255, from 1.
        let inverted = Heightmap::read(&bytes, true, 4).unwrap().map;
        assert!((inverted.heights[3] - 100.0 / 255.0).abs() < 1e-12, "{inverted:?}");
        assert_eq!(Heightmap::read(&bytes, false, 3), Err(NoHeights::TooLarge));
        for end in 8..bytes.len() {
            let cut = Heightmap::read(&bytes[..end], false, 4);
            assert!(matches!(cut, Ok(_) | Err(NoHeights::Unreadable(_))), "{end}: {cut:?}");
        }
    }
}

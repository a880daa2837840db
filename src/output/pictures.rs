//! Pictures of dots: levels as characters, levels as a PNG, and raw values as a portable float map.

use std::io::{self, Write};

use crate::math::{DVec3, Grid};
use crate::tone::Level;

/// One character per dot, `0` to `9`, `A`, `B`, `C`; one line per row of dots.
pub fn levels(levels: &Grid<Level>, out: &mut impl Write) -> io::Result<()> {
    let mut line = String::new();
    for row in levels.rows() {
        line.clear();
        line.extend(row.iter().map(|level| level.digit()));
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// An 8-bit gray PNG, one pixel per dot at its level's gray, marked as sRGB.
///
/// # Errors
/// The writer's own; [`io::ErrorKind::Other`] for a picture without dots, which PNG can not hold.
pub fn png(levels: &Grid<Level>, out: &mut impl Write) -> io::Result<()> {
    let size = levels.size();
    let mut encoder = png::Encoder::new(out, size.width, size.height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let bytes: [u8; 13] = std::array::from_fn(|k| Level::new(k as u8).unwrap_or_default().srgb());
    let pixels: Vec<u8> = levels.values().iter().map(|level| bytes[usize::from(level.get())]).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    Ok(writer.finish()?)
}

/// A portable float map of one channel (`Pf`): light, depth, object numbers. Values become f32; infinite ones, such
/// as the depth where nothing is hit, are kept.
pub fn pfm_gray(values: &Grid<f64>, out: &mut impl Write) -> io::Result<()> {
    pfm("Pf", values, |&value| [value], out)
}

/// A portable float map of three channels (`PF`), x, y and z: normals.
pub fn pfm_vectors(values: &Grid<DVec3>, out: &mut impl Write) -> io::Result<()> {
    pfm("PF", values, DVec3::to_array, out)
}

/// The format has its rows from the bottom up; a negative scale says that the bytes are little-endian.
fn pfm<T, const CHANNELS: usize>(
    kind: &str,
    values: &Grid<T>,
    channels: impl Fn(&T) -> [f64; CHANNELS],
    out: &mut impl Write,
) -> io::Result<()> {
    let size = values.size();
    write!(out, "{kind}\n{} {}\n-1.0\n", size.width, size.height)?;
    let rows: Vec<&[T]> = values.rows().collect();
    let mut bytes = Vec::new();
    for row in rows.into_iter().rev() {
        bytes.clear();
        for value in row.iter().flat_map(&channels) {
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
        out.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Size;

    fn all_levels() -> Grid<Level> {
        Grid::from_values(Size::new(13, 1), Level::all().collect())
    }

    #[test]
    fn levels_are_one_character_each() {
        let mut out = Vec::new();
        levels(&all_levels(), &mut out).expect("a vector takes every byte");
        assert_eq!(out, b"0123456789ABC\n");
    }

    #[test]
    fn a_png_holds_each_level_s_gray() {
        let mut out = Vec::new();
        png(&all_levels(), &mut out).expect("a vector takes every byte");
        let mut reader = png::Decoder::new(io::Cursor::new(out)).read_info().expect("a PNG");
        assert!(reader.info().srgb.is_some());
        let mut pixels = vec![0; 13];
        let info = reader.next_frame(&mut pixels).expect("a picture");
        assert_eq!((info.width, info.height, info.bit_depth), (13, 1, png::BitDepth::Eight));
        assert_eq!(pixels, Level::all().map(Level::srgb).collect::<Vec<u8>>());
    }

    #[test]
    fn a_png_of_no_dots_is_an_error() {
        assert!(png(&Grid::from_values(Size::new(0, 3), vec![]), &mut Vec::new()).is_err());
    }

    #[test]
    fn a_float_map_starts_at_the_bottom() {
        let depth = Grid::from_values(Size::new(2, 2), vec![1.0, f64::INFINITY, 0.25, -3.0]);
        let mut out = Vec::new();
        pfm_gray(&depth, &mut out).expect("a vector takes every byte");
        let (header, data) = out.split_at(out.len() - 16);
        assert_eq!(header, b"Pf\n2 2\n-1.0\n");
        let values: Vec<f32> = data.chunks(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        assert_eq!(values, [0.25, -3.0, 1.0, f32::INFINITY]);
    }

    #[test]
    fn a_vector_map_has_three_channels() {
        let mut out = Vec::new();
        pfm_vectors(&Grid::filled(Size::new(1, 1), DVec3::new(0.0, -1.0, 0.5)), &mut out)
            .expect("a vector takes every byte");
        assert!(out.starts_with(b"PF\n1 1\n-1.0\n"));
        assert_eq!(out[out.len() - 4..], 0.5_f32.to_le_bytes());
    }
}

//! Pictures of dots: pixels as PNG and as portable maps, raw values as a portable float map.

use std::io::{self, Write};

use crate::math::{DVec3, Grid, Size};
use crate::tone::{Level, Tone, srgb_of_light};

/// One pixel per dot, in sRGB bytes.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// One gray each.
    Gray(Grid<u8>),
    /// Red, green and blue each.
    Color(Grid<[u8; 3]>),
}

impl Pixels {
    /// Three linear primaries each, as the tone shows them.
    pub fn of_colors(colors: &Grid<DVec3>, tone: Tone) -> Self {
        Self::Color(colors.map(|&color| tone.shown_color(color).to_array().map(srgb_of_light)))
    }

    fn size(&self) -> Size {
        match self {
            Self::Gray(pixels) => pixels.size(),
            Self::Color(pixels) => pixels.size(),
        }
    }
}

/// Each level's gray, an sRGB byte.
pub fn grays_of_levels(levels: &Grid<Level>) -> Grid<u8> {
    let bytes: [u8; 13] = std::array::from_fn(|k| Level::new(k as u8).unwrap_or_default().srgb());
    levels.map(|level| bytes[usize::from(level.get())])
}

/// The light as the tone shows it, clamped to 0 to 1, as an sRGB byte: the light itself by
/// [`Tone::Lightness`].
pub fn grays_of_light(light: &Grid<f64>, tone: Tone) -> Grid<u8> {
    light.map(|&light| srgb_of_light(tone.shown(light)))
}

/// An 8-bit PNG, gray or of three channels as the pixels are, marked as sRGB.
///
/// # Errors
/// The writer's own; [`io::ErrorKind::Other`] for a picture without dots, which PNG can not hold.
pub fn png(pixels: &Pixels, out: &mut impl Write) -> io::Result<()> {
    let size = pixels.size();
    let mut encoder = png::Encoder::new(out, size.width, size.height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let bytes = match pixels {
        Pixels::Gray(pixels) => {
            encoder.set_color(png::ColorType::Grayscale);
            pixels.values()
        }
        Pixels::Color(pixels) => {
            encoder.set_color(png::ColorType::Rgb);
            pixels.values().as_flattened()
        }
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    Ok(writer.finish()?)
}

/// A binary portable gray map (`P5`) of 8 bits.
pub fn pgm(pixels: &Grid<u8>, out: &mut impl Write) -> io::Result<()> {
    write!(out, "P5\n{} {}\n255\n", pixels.size().width, pixels.size().height)?;
    out.write_all(pixels.values())
}

/// A binary portable pixel map (`P6`) of 8 bits a channel; grays have three equal ones.
pub fn ppm(pixels: &Pixels, out: &mut impl Write) -> io::Result<()> {
    write!(out, "P6\n{} {}\n255\n", pixels.size().width, pixels.size().height)?;
    match pixels {
        Pixels::Gray(pixels) => out.write_all(pixels.map(|&gray| [gray; 3]).values().as_flattened()),
        Pixels::Color(pixels) => out.write_all(pixels.values().as_flattened()),
    }
}

/// A portable float map of one channel (`Pf`): light, depth, object numbers. Values become f32; infinite
/// ones, such as the depth where nothing is hit, are kept, and no finite one becomes infinite.
pub fn pfm_gray(values: &Grid<f64>, out: &mut impl Write) -> io::Result<()> {
    pfm("Pf", values, |&value| [value], out)
}

/// A portable float map of three channels (`PF`): the x, y and z of normals, the primaries of light.
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
            let largest = f64::from(f32::MAX);
            let value = if value.is_finite() { value.clamp(-largest, largest) } else { value };
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
        out.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_levels() -> Grid<Level> {
        Grid::from_values(Size::new(13, 1), Level::all().collect())
    }

    #[test]
    fn a_png_holds_each_level_s_gray() {
        let mut out = Vec::new();
        png(&Pixels::Gray(grays_of_levels(&all_levels())), &mut out).expect("a vector takes every byte");
        let mut reader = png::Decoder::new(io::Cursor::new(out)).read_info().expect("a PNG");
        assert!(reader.info().srgb.is_some());
        let mut pixels = vec![0; 13];
        let info = reader.next_frame(&mut pixels).expect("a picture");
        assert_eq!((info.width, info.height, info.bit_depth), (13, 1, png::BitDepth::Eight));
        assert_eq!(pixels, Level::all().map(Level::srgb).collect::<Vec<u8>>());
    }

    #[test]
    fn a_png_of_no_dots_is_an_error() {
        let none = Pixels::Gray(Grid::from_values(Size::new(0, 3), vec![]));
        assert!(png(&none, &mut Vec::new()).is_err());
    }

    /// Linear light of which the sRGB bytes are known, and beyond the range.
    fn colors() -> Grid<DVec3> {
        Grid::from_values(Size::new(2, 1), vec![DVec3::new(1.5, 0.0, -1.0), DVec3::new(0.0, 0.214_041, 1.0)])
    }

    const BYTES: [u8; 6] = [255, 0, 0, 0, 127, 255];

    #[test]
    fn a_png_of_colors_has_three_channels() {
        let mut out = Vec::new();
        png(&Pixels::of_colors(&colors(), Tone::Lightness), &mut out).expect("a vector takes every byte");
        let mut reader = png::Decoder::new(io::Cursor::new(out)).read_info().expect("a PNG");
        let mut pixels = vec![0; 6];
        let info = reader.next_frame(&mut pixels).expect("a picture");
        assert_eq!((info.width, info.height, info.color_type), (2, 1, png::ColorType::Rgb));
        assert_eq!(pixels, BYTES);
    }

    #[test]
    fn portable_maps_are_a_header_and_bytes() {
        let light = Grid::from_values(Size::new(1, 3), vec![0.0, 0.214_041, 9.0]);
        let gray = grays_of_light(&light, Tone::Lightness);
        let mut out = Vec::new();
        pgm(&gray, &mut out).expect("a vector takes every byte");
        assert_eq!(out, b"P5\n1 3\n255\n\x00\x7f\xff");
        out.clear();
        ppm(&Pixels::Gray(gray), &mut out).expect("a vector takes every byte");
        assert_eq!(out, b"P6\n1 3\n255\n\0\0\0\x7f\x7f\x7f\xff\xff\xff");
        out.clear();
        ppm(&Pixels::of_colors(&colors(), Tone::Lightness), &mut out).expect("a vector takes every byte");
        assert_eq!(out, [&b"P6\n2 1\n255\n"[..], &BYTES].concat());
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

    #[test]
    fn only_what_is_infinite_is_written_so() {
        let values = [1e300, -1e300, f64::INFINITY, 1e-300];
        let mut out = Vec::new();
        pfm_gray(&Grid::from_values(Size::new(4, 1), values.to_vec()), &mut out)
            .expect("a vector takes every byte");
        let floats: Vec<f32> = out["Pf\n4 1\n-1.0\n".len()..]
            .chunks(4)
            .map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
            .collect();
        assert_eq!(floats, [f32::MAX, f32::MIN, f32::INFINITY, 0.0]);
    }
}

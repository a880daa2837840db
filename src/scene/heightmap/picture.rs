//! Heights as the grays of a PNG picture.

use std::io::Cursor;

use png::{Decoder, Limits, Transformations};

use super::{Heightmap, NoHeights};

/// Reads a picture: its grays are heights from 0 to 100, its last row is the first.
pub fn heights(bytes: &[u8], is_inverted: bool, most: usize) -> Result<Heightmap, NoHeights> {
    let unreadable = |error: png::DecodingError| NoHeights::Unreadable(error.to_string());
    // Four channels of a byte, and rows while they are unpacked.
    let limits = Limits { bytes: most.saturating_mul(8).max(1 << 20) };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let info = reader.info();
    let (columns, rows) = (info.width as usize, info.height as usize);
    let size = reader.output_buffer_size().filter(|_| columns.saturating_mul(rows) <= most);
    let mut grays = vec![0; size.ok_or(NoHeights::TooLarge)?];
    let frame = reader.next_frame(&mut grays).map_err(unreadable)?;
    let channels = frame.color_type.samples();
    let height = |dot: &[u8]| {
        // The first channels are red, green and blue, or gray for all three.
        let [r, g, b] = if channels < 3 { [dot[0]; 3] } else { [dot[0], dot[1], dot[2]] }.map(f64::from);
        let gray = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        100.0 / 255.0 * if is_inverted { 1.0 - gray } else { gray }
    };
    let lines = grays.chunks_exact(frame.line_size).take(rows).rev();
    let heights: Vec<f64> =
        lines.flat_map(|line| line.chunks_exact(channels).take(columns).map(height)).collect();
    let read = heights.clone();
    Ok(Heightmap::new(columns, heights, read.into_iter()))
}

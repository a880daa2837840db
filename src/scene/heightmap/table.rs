//! Heights as a table of numbers: a row to a line, as Octave writes matrices.

use super::{HeightFile, Heightmap, NoHeights};

/// Reads a table. Lines that are empty or begin with `#` are none of it.
pub fn heights(bytes: &[u8], most: usize) -> Result<HeightFile, NoHeights> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let (mut columns, mut ended_at) = (0, None);
    for (number, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let line = line.trim_ascii();
        if line.is_empty() || line[0] == b'#' {
            continue;
        }
        let mut row = Vec::new();
        for word in line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
            let height = str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
            let Some(height) = height.filter(|height| height.is_finite()) else {
                ended_at = Some(number + 1);
                break;
            };
            row.push(height);
        }
        // As in OpenSCAD, what stands before the mistake counts.
        if row.is_empty() && ended_at.is_some() {
            break;
        }
        columns = columns.max(row.len());
        rows.push(row);
        if rows.len().saturating_mul(columns) > most {
            return Err(NoHeights::TooLarge);
        }
        if ended_at.is_some() {
            break;
        }
    }
    let mut heights = Vec::with_capacity(rows.len() * columns);
    for row in &rows {
        heights.extend(row);
        heights.resize(heights.len() + columns - row.len(), 0.0);
    }
    let map = Heightmap::new(columns, heights, rows.iter().flatten().copied());
    Ok(HeightFile { map, ended_at })
}

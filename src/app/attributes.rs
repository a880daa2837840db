//! A screen as text, for snapshots: its characters, then the attributes of each row.

use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};

/// The characters, row by row.
pub fn text(buffer: &Buffer) -> String {
    let rows = buffer.content.chunks(buffer.area.width.into());
    rows.map(|row| row.iter().map(Cell::symbol).collect::<String>() + "\n").collect()
}

/// The characters, and behind them, for each row, the attribute bytes of a PC's text screen in hexadecimal,
/// paper before ink, each with how many cells have it. Rows that are alike are told once.
pub fn text_and_attributes(buffer: &Buffer) -> String {
    let rows: Vec<String> = buffer.content.chunks(buffer.area.width.into()).map(attributes_of_row).collect();
    let mut all = text(buffer);
    let mut first = 0;
    for run in rows.chunk_by(|a, b| a == b) {
        let last = first + run.len() - 1;
        let name = if first == last { first.to_string() } else { format!("{first}-{last}") };
        // A string takes every character.
        let _ = writeln!(all, "{name}: {}", run[0]);
        first = last + 1;
    }
    all
}

fn attributes_of_row(row: &[Cell]) -> String {
    let attributes: Vec<String> = row.iter().map(attribute).collect();
    let runs = attributes.chunk_by(|a, b| a == b);
    runs.map(|run| format!("{}*{}", run[0], run.len())).collect::<Vec<_>>().join(" ")
}

/// Paper and ink of a cell, with `b`, `d` and `r` where it is bold, dim and reversed.
fn attribute(cell: &Cell) -> String {
    let mut attribute: String = [cell.bg, cell.fg].into_iter().map(digit).collect();
    for (modifier, letter) in [(Modifier::BOLD, 'b'), (Modifier::DIM, 'd'), (Modifier::REVERSED, 'r')] {
        if cell.modifier.contains(modifier) {
            attribute.push(letter);
        }
    }
    attribute
}

/// A colour by the number that the BIOS has for it, where blue is 1; `-` is the terminal's own.
fn digit(color: Color) -> char {
    match color {
        Color::Black => '0',
        Color::Blue => '1',
        Color::Green => '2',
        Color::Cyan => '3',
        Color::Red => '4',
        Color::Magenta => '5',
        Color::Gray => '7',
        Color::DarkGray => '8',
        Color::LightBlue => '9',
        Color::LightGreen => 'A',
        Color::LightCyan => 'B',
        Color::LightRed => 'C',
        Color::LightMagenta => 'D',
        Color::LightYellow => 'E',
        Color::White => 'F',
        Color::Reset => '-',
        Color::Yellow | Color::Indexed(_) | Color::Rgb(..) => '?',
    }
}

//! Cells as DOS had them, for viewers and editors of ANSI art: bytes of code page 437, the sequences of
//! ANSI.SYS, and behind them a SAUCE record that says what they are
//! (<https://www.acid.org/info/sauce/sauce.htm>).

use std::io::{self, Write};

use crate::glyph::{Cell, Paint};
use crate::math::Grid;

/// Where a text ends for DOS. What stands behind is shown by no `type`.
const END_OF_TEXT: u8 = 0x1A;

/// The attribute of a screen that was cleared: light gray on black.
const CLEAR: Attribute = Attribute { ink: 7, paper: 0 };

/// The cells as a file of ANSI art. Each row ends where only black is left of it, with CR and LF; a row that
/// goes on to the last column has none, since viewers, as DOS did, go to the next line there by themselves.
///
/// The record has no title, author, group and date: those are the artist's, and the same picture is the same
/// bytes. The terminal's own ink and paper are DOS's, 7 and 0. Papers 8 to 15 are sent as those of blinking
/// cells, which the record's flag for iCE colours tells to be bright.
///
/// # Errors
/// The writer's own; [`io::ErrorKind::InvalidData`] for a character or colour that DOS has not, and more than
/// 65 535 rows or columns.
pub fn dos_ansi(cells: &Grid<Cell>, out: &mut impl Write) -> io::Result<()> {
    let mut text = Vec::new();
    let mut shown = CLEAR;
    let mut is_bright = false;
    for row in cells.rows() {
        let row: Vec<(u8, Attribute)> = row.iter().map(dos_cell).collect::<io::Result<_>>()?;
        let is_black = |(byte, attribute): &&(u8, Attribute)| *byte == b' ' && attribute.paper == 0;
        let shown_cells = row.len() - row.iter().rev().take_while(is_black).count();
        for &(byte, attribute) in &row[..shown_cells] {
            is_bright |= attribute.paper > 7;
            // The ink of a blank is not seen.
            let ink = if byte == b' ' { shown.ink } else { attribute.ink };
            shown = shown.turn(Attribute { ink, ..attribute }, &mut text);
            text.push(byte);
        }
        if shown_cells < row.len() {
            // A screen that scrolls is filled with the paper at hand.
            shown = shown.turn(Attribute { paper: 0, ..shown }, &mut text);
            text.extend(b"\r\n");
        }
    }
    shown.turn(CLEAR, &mut text);
    let side = |n: u32| u16::try_from(n).map_err(|_| no_dos("so many rows or columns"));
    let record = sauce(text.len(), [side(cells.size().width)?, side(cells.size().height)?], is_bright);
    out.write_all(&text)?;
    out.write_all(&[END_OF_TEXT])?;
    out.write_all(&record)
}

/// Ink and paper by number, 0 to 15.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Attribute {
    ink: u8,
    paper: u8,
}

impl Attribute {
    /// Writes what makes another attribute of this one, and gives that.
    fn turn(self, to: Self, text: &mut Vec<u8>) -> Self {
        if self == to {
            return to;
        }
        let mut parameters = Vec::new();
        let mut from = self;
        // Bright ink and blinking end by nothing but the end of everything.
        if (from.ink > 7 && to.ink <= 7) || (from.paper > 7 && to.paper <= 7) {
            parameters.push(0);
            from = CLEAR;
        }
        if to.ink > 7 && from.ink <= 7 {
            parameters.push(1);
        }
        if to.paper > 7 && from.paper <= 7 {
            parameters.push(5);
        }
        if to.ink % 8 != from.ink % 8 {
            parameters.push(30 + to.ink % 8);
        }
        if to.paper % 8 != from.paper % 8 {
            parameters.push(40 + to.paper % 8);
        }
        let parameters: Vec<String> = parameters.iter().map(u8::to_string).collect();
        text.extend(format!("\x1b[{}m", parameters.join(";")).bytes());
        to
    }
}

fn dos_cell(cell: &Cell) -> io::Result<(u8, Attribute)> {
    let attribute = Attribute { ink: number(cell.ink, CLEAR.ink)?, paper: number(cell.paper, CLEAR.paper)? };
    let byte = match cell.glyph {
        '░' => 0xB0,
        '▒' => 0xB1,
        '▓' => 0xB2,
        '█' => 0xDB,
        '▄' => 0xDC,
        '▌' => 0xDD,
        '▐' => 0xDE,
        '▀' => 0xDF,
        ' '..='~' => cell.glyph as u8,
        _ => return Err(no_dos("such a character")),
    };
    Ok((byte, attribute))
}

fn number(paint: Paint, own: u8) -> io::Result<u8> {
    match paint {
        Paint::Terminal => Ok(own),
        Paint::Black => Ok(0),
        Paint::LightGray => Ok(7),
        Paint::DarkGray => Ok(8),
        Paint::White => Ok(15),
        Paint::Indexed(_) | Paint::Rgb(_) => Err(no_dos("such a colour")),
    }
}

fn no_dos(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("a DOS screen does not have {what}"))
}

/// The record behind a text of so many bytes.
fn sauce(length: usize, [columns, rows]: [u16; 2], is_bright: bool) -> Vec<u8> {
    let mut record = b"SAUCE00".to_vec();
    // Title, author and group, and a date.
    record.extend([b' '; 35 + 20 + 20 + 8]);
    // Larger files than the field can tell have 0 there.
    record.extend(u32::try_from(length).unwrap_or(0).to_le_bytes());
    // Characters, and of these ANSi.
    record.extend([1, 1]);
    for number in [columns, rows, 0, 0] {
        record.extend(number.to_le_bytes());
    }
    // No comments.
    record.push(0);
    // Letters 8 dots wide, which are square, as a cell of twice its width is 16 high.
    let (eight_dots, square) = (0b01 << 1, 0b10 << 3);
    record.push(u8::from(is_bright) | eight_dots | square);
    record.extend(b"IBM VGA");
    record.resize(128, 0);
    record
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Paint::{Black, DarkGray, LightGray, Terminal, White};
    use crate::math::Size;

    fn written(width: u32, cells: &[(char, Paint, Paint)]) -> io::Result<Vec<u8>> {
        let cells: Vec<Cell> = cells.iter().map(|&(glyph, ink, paper)| Cell { glyph, ink, paper }).collect();
        let mut out = Vec::new();
        dos_ansi(&Grid::from_values(Size::new(width, cells.len() as u32 / width), cells), &mut out)?;
        Ok(out)
    }

    fn text(width: u32, cells: &[(char, Paint, Paint)]) -> Vec<u8> {
        let bytes = written(width, cells).expect("what DOS has");
        bytes[..bytes.len() - 129].to_vec()
    }

    #[test]
    fn attributes_are_those_of_ansi_sys() {
        let cells = [
            ('░', White, Black),
            ('▀', LightGray, Black),
            ('▌', Black, LightGray),
            ('x', Terminal, Terminal),
        ];
        assert_eq!(text(4, &cells), b"\x1b[1m\xB0\x1b[0m\xDF\x1b[30;47m\xDD\x1b[37;40mx");
        // A bright paper is a blinking cell's.
        assert_eq!(
            text(2, &[('▄', Black, White), ('▄', DarkGray, Black)]),
            b"\x1b[5;30;47m\xDC\x1b[0;1;30m\xDC\x1b[0m"
        );
    }

    #[test]
    fn a_row_ends_where_it_is_black_or_by_itself() {
        let (gray, black) = ((' ', White, LightGray), (' ', White, Black));
        assert_eq!(
            text(2, &[gray, black, black, black, gray, gray]),
            b"\x1b[47m \x1b[40m\r\n\r\n\x1b[47m  \x1b[40m"
        );
    }

    #[test]
    fn what_dos_has_not_is_an_error() {
        for cell in [('▘', White, Black), ('é', White, Black), ('x', Paint::Indexed(16), Black)] {
            assert!(written(1, &[cell]).is_err(), "{cell:?}");
        }
    }

    #[test]
    fn the_record_says_what_the_text_is() {
        let bytes = written(1, &[('x', White, DarkGray), ('x', White, Black)]).expect("what DOS has");
        let (text, record) = bytes.split_at(bytes.len() - 128);
        let (end, text) = text.split_last().expect("an end");
        assert_eq!((*end, &record[..7]), (0x1A, &b"SAUCE00"[..]));
        assert!(record[7..90].iter().all(|&byte| byte == b' '));
        assert_eq!(record[90..94], (text.len() as u32).to_le_bytes());
        assert_eq!(record[94..104], [1, 1, 1, 0, 2, 0, 0, 0, 0, 0]);
        // No comments; iCE colours, 8 dots, square.
        assert_eq!(record[104..106], [0, 0b1_0011]);
        assert_eq!(&record[106..113], b"IBM VGA");
        assert!(record[113..].iter().all(|&byte| byte == 0));
    }
}

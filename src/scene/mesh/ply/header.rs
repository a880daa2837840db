//! The header of a PLY file: which elements there are, and of what they consist.

use super::super::fault::{MeshError, MeshFault};
use super::super::words::{MeshWord, MeshWords};

/// How the values behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// As words of text.
    Ascii,
    /// The lowest byte first.
    LittleEndian,
    /// The highest byte first.
    BigEndian,
}

/// A type of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &MeshWord<'_>) -> Result<Self, MeshError> {
        Ok(match word.bytes {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => {
                return Err(
                    MeshFault::Unexpected("a type such as `float` or `int`".to_owned()).at(word.span())
                );
            }
        })
    }

    /// Bytes of a number in a binary file.
    pub const fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    const fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// A value, or list of values, of each of an element's items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Property<'a> {
    /// What it is called.
    pub name: &'a [u8],
    /// The type of a list's length, which is a whole number; none of a single value.
    pub length: Option<Scalar>,
    /// The type of the values.
    pub value: Scalar,
}

/// What there is a number of, such as corners.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element<'a> {
    /// What it is called.
    pub name: &'a [u8],
    /// How many the file says there are.
    pub count: u64,
    /// Of what each consists, in order.
    pub properties: Vec<Property<'a>>,
}

/// A header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header<'a> {
    /// How what follows is written.
    pub encoding: Encoding,
    /// What follows, in order.
    pub elements: Vec<Element<'a>>,
    /// Bytes of the header itself.
    pub length: usize,
}

/// Whether the bytes begin as a file of PLY does.
pub fn is_ply(bytes: &[u8]) -> bool {
    bytes
        .strip_prefix(b"ply")
        .is_some_and(|rest| rest.first().is_some_and(|&byte| byte == b'\n' || byte == b'\r'))
}

/// Reads the header.
pub fn read(bytes: &[u8]) -> Result<Header<'_>, MeshError> {
    let mut encoding = None;
    let mut elements: Vec<Element<'_>> = Vec::new();
    let mut at = 0;
    while let Some(length) = bytes[at..].iter().position(|&byte| byte == b'\n') {
        let mut words = MeshWords::new(bytes, at..at + length);
        at += length + 1;
        let Some(word) = words.next() else { continue };
        match word.bytes {
            b"ply" | b"comment" | b"obj_info" => {}
            b"format" => encoding = Some(format(&mut words)?),
            b"element" => {
                let name = words.expect("the name of an element")?.bytes;
                let count = words.expect("the number of elements")?.count("the number of elements")?;
                elements.push(Element { name, count, properties: Vec::new() });
            }
            b"property" => {
                let property = property(&mut words)?;
                let element = elements.last_mut();
                let fault = || MeshFault::Unexpected("`element`".to_owned()).at(word.span());
                element.ok_or_else(fault)?.properties.push(property);
            }
            b"end_header" => {
                let fault =
                    || MeshFault::Unexpected("`format` in the lines before".to_owned()).at(word.span());
                return Ok(Header { encoding: encoding.ok_or_else(fault)?, elements, length: at });
            }
            _ => return Err(MeshFault::Unexpected("a line of a PLY header".to_owned()).at(word.span())),
        }
    }
    let end = MeshWords::new(bytes, 0..bytes.len()).end();
    Err(MeshFault::CutOff("`end_header`".to_owned()).at(end))
}

fn format(words: &mut MeshWords<'_>) -> Result<Encoding, MeshError> {
    let wanted = "`ascii`, `binary_little_endian` or `binary_big_endian`";
    let word = words.expect(wanted)?;
    match word.bytes {
        b"ascii" => Ok(Encoding::Ascii),
        b"binary_little_endian" => Ok(Encoding::LittleEndian),
        b"binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(MeshFault::Unexpected(wanted.to_owned()).at(word.span())),
    }
}

fn property<'a>(words: &mut MeshWords<'a>) -> Result<Property<'a>, MeshError> {
    let mut word = words.expect("a type")?;
    let length = if word.is("list") {
        let of_length = words.expect("the type of a list's length")?;
        let scalar = Scalar::of(&of_length)?;
        if !scalar.is_whole() {
            return Err(MeshFault::Unexpected("a type of whole numbers".to_owned()).at(of_length.span()));
        }
        word = words.expect("the type of a list's values")?;
        Some(scalar)
    } else {
        None
    };
    let value = Scalar::of(&word)?;
    Ok(Property { name: words.expect("the name of a property")?.bytes, length, value })
}

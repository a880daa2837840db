//! The values behind the header of a PLY file, in text or binary.

use super::super::fault::{MeshError, MeshFault, MeshPlace};
use super::super::words::MeshWords;
use super::header::{Encoding, Header, Scalar};

/// A value and its bytes in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlyValue {
    /// The number; whole ones of up to 32 bits are exact.
    pub number: f64,
    start: usize,
    length: usize,
}

/// The values, one after the other.
#[derive(Clone, Debug)]
pub struct PlyValues<'a> {
    bytes: &'a [u8],
    encoding: Encoding,
    /// The words of a text.
    words: MeshWords<'a>,
    /// The next byte of a binary file.
    at: usize,
    /// What is being read, as in `vertex 3`.
    element: &'a [u8],
    item: u64,
}

impl<'a> PlyValues<'a> {
    /// Those behind a header.
    pub fn new(bytes: &'a [u8], header: &Header<'_>) -> Self {
        let words = MeshWords::new(bytes, header.length..bytes.len());
        Self { bytes, encoding: header.encoding, words, at: header.length, element: b"", item: 0 }
    }

    /// Says what comes next: an item of an element, counted from 0.
    pub fn begin(&mut self, element: &'a [u8], item: u64) {
        self.element = element;
        self.item = item;
    }

    /// The next value.
    ///
    /// # Errors
    /// [`MeshFault::CutOff`] where there is none, [`MeshFault::NoNumber`] where it is another word.
    pub fn take(&mut self, scalar: Scalar, what: &str) -> Result<PlyValue, MeshError> {
        if self.encoding == Encoding::Ascii {
            let word = self.words.expect(what)?;
            let number = std::str::from_utf8(word.bytes).ok().and_then(|text| text.parse().ok());
            let number = number.ok_or_else(|| MeshFault::NoNumber(what.to_owned()).at(word.span()))?;
            return Ok(PlyValue { number, start: word.start, length: word.bytes.len() });
        }
        let (start, length) = (self.at, scalar.bytes());
        let Some(value) = self.bytes.get(start..start + length) else {
            return Err(MeshFault::CutOff(what.to_owned()).at_byte(self.bytes.len(), self.part()));
        };
        self.at += length;
        Ok(PlyValue { number: number(value, scalar, self.encoding), start, length })
    }

    /// What is left when all has been read, in words: none where nothing is.
    pub fn rest(&self) -> Option<String> {
        let (count, what) = match self.encoding {
            Encoding::Ascii => (self.words.clone().count(), "words"),
            _ => (self.bytes.len().saturating_sub(self.at), "bytes"),
        };
        (count > 0).then(|| format!("{count} {what}"))
    }

    /// The length of a list, which is a whole number and not negative.
    pub fn length(&mut self, scalar: Scalar) -> Result<u64, MeshError> {
        let what = "the length of a list";
        let value = self.take(scalar, what)?;
        if value.number >= 0.0 && value.number.fract() == 0.0 && value.number <= f64::from(u32::MAX) {
            Ok(value.number as u64)
        } else {
            Err(self.fault(value, MeshFault::Unexpected(what.to_owned())))
        }
    }

    /// The error of a value.
    pub fn fault(&self, value: PlyValue, fault: MeshFault) -> MeshError {
        match self.encoding {
            Encoding::Ascii => fault.at(value.start..value.start + value.length),
            _ => MeshError { place: MeshPlace::Byte { offset: value.start, part: self.part() }, fault },
        }
    }

    /// The error of all that was read since [`PlyValues::begin`].
    pub fn fault_of_item(&self, fault: MeshFault) -> MeshError {
        match self.encoding {
            Encoding::Ascii => fault.at(self.words.before()),
            _ => MeshError { place: MeshPlace::Byte { offset: self.at, part: self.part() }, fault },
        }
    }

    fn part(&self) -> String {
        format!("{} {}", String::from_utf8_lossy(self.element), self.item)
    }
}

fn number(bytes: &[u8], scalar: Scalar, encoding: Encoding) -> f64 {
    let mut little = [0; 8];
    for (to, from) in little.iter_mut().zip(bytes) {
        *to = *from;
    }
    if encoding == Encoding::BigEndian {
        little[..bytes.len()].reverse();
    }
    let [a, b, c, d, ..] = little;
    match scalar {
        Scalar::I8 => f64::from(a.cast_signed()),
        Scalar::U8 => f64::from(a),
        Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
        Scalar::U16 => f64::from(u16::from_le_bytes([a, b])),
        Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Scalar::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Scalar::F64 => f64::from_le_bytes(little),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_either_end_first() {
        let both = |bytes: &[u8], scalar| {
            let mut reversed = bytes.to_vec();
            reversed.reverse();
            let little = number(bytes, scalar, Encoding::LittleEndian);
            assert_eq!(little, number(&reversed, scalar, Encoding::BigEndian));
            little
        };
        assert_eq!(both(&[0xfe], Scalar::I8), -2.0);
        assert_eq!(both(&[0xfe], Scalar::U8), 254.0);
        assert_eq!(both(&(-3_i16).to_le_bytes(), Scalar::I16), -3.0);
        assert_eq!(both(&60_000_u16.to_le_bytes(), Scalar::U16), 60_000.0);
        assert_eq!(both(&(-3_i32).to_le_bytes(), Scalar::I32), -3.0);
        assert_eq!(both(&u32::MAX.to_le_bytes(), Scalar::U32), f64::from(u32::MAX));
        assert_eq!(both(&1.5_f32.to_le_bytes(), Scalar::F32), 1.5);
        assert_eq!(both(&0.1_f64.to_le_bytes(), Scalar::F64), 0.1);
    }
}

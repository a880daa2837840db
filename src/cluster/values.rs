//! Values of dots as bytes: the least byte first, whatever machine writes them.

use std::io::{self, Read, Write};

use crate::math::DVec3;

/// A value of a dot.
pub(super) trait DotValue: Copy {
    /// Its bytes.
    type Bytes: AsRef<[u8]> + AsMut<[u8]> + Default;

    /// To bytes.
    fn to_bytes(self) -> Self::Bytes;

    /// From bytes.
    fn from_bytes(bytes: &Self::Bytes) -> Self;
}

impl DotValue for f64 {
    type Bytes = [u8; 8];

    fn to_bytes(self) -> Self::Bytes {
        self.to_le_bytes()
    }

    fn from_bytes(bytes: &Self::Bytes) -> Self {
        Self::from_le_bytes(*bytes)
    }
}

impl DotValue for u32 {
    type Bytes = [u8; 4];

    fn to_bytes(self) -> Self::Bytes {
        self.to_le_bytes()
    }

    fn from_bytes(bytes: &Self::Bytes) -> Self {
        Self::from_le_bytes(*bytes)
    }
}

impl DotValue for DVec3 {
    type Bytes = [u8; 24];

    fn to_bytes(self) -> Self::Bytes {
        let mut bytes = [0; 24];
        for (bytes, axis) in bytes.chunks_exact_mut(8).zip(self.to_array()) {
            bytes.copy_from_slice(&axis.to_le_bytes());
        }
        bytes
    }

    fn from_bytes(bytes: &Self::Bytes) -> Self {
        let (axes, _) = bytes.as_chunks::<8>();
        Self::from_slice(&[0, 1, 2].map(|axis| f64::from_le_bytes(axes[axis])))
    }
}

/// Writes some values.
pub(super) fn write<T: DotValue>(values: &[T], out: &mut impl Write) -> io::Result<()> {
    values.iter().try_for_each(|value| out.write_all(value.to_bytes().as_ref()))
}

/// Reads as many values, or fails. Memory is taken as they come.
pub(super) fn read<T: DotValue>(count: usize, from: &mut impl Read) -> io::Result<Vec<T>> {
    let one = |_| {
        let mut bytes = T::Bytes::default();
        from.read_exact(bytes.as_mut()).map(|()| T::from_bytes(&bytes))
    };
    (0..count).map(one).collect()
}

//! ZIP archives, as far as files of models are ones: entries by name, stored or deflated, of an archive that
//! is in memory. The directory at the end has the last word; sizes in it are not trusted with memory.

use flate2::Crc;
use flate2::read::DeflateDecoder;

use super::super::fault::{MeshError, MeshFault};
use crate::scene::bounded::read_at_most;

/// The directory of an archive.
#[derive(Clone, Debug)]
pub struct ZipArchive<'a> {
    bytes: &'a [u8],
    entries: Vec<ZipEntry<'a>>,
}

/// A file in an archive.
#[derive(Clone, Debug)]
struct ZipEntry<'a> {
    name: &'a [u8],
    method: u16,
    is_encrypted: bool,
    check: u32,
    packed: u64,
    /// Where its own header is.
    offset: u64,
}

/// So many entries are looked at; a model has a few, and a picture of each plate.
const MOST_ENTRIES: usize = 10_000;

/// Whether the bytes begin as an archive does.
pub fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

impl<'a> ZipArchive<'a> {
    /// Reads the directory.
    pub fn new(bytes: &'a [u8]) -> Result<Self, MeshError> {
        let cut_off = || MeshFault::CutOff("the directory of the ZIP archive".to_owned()).of_all();
        let mut at = directory(bytes).ok_or_else(cut_off)?;
        let mut entries = Vec::new();
        // Behind the last entry is what ends the directory: a count would only say so again.
        while entries.len() < MOST_ENTRIES && bytes.get(at..at + 4) == Some(b"PK\x01\x02") {
            let (entry, next) = ZipEntry::read(bytes, at).ok_or_else(cut_off)?;
            entries.push(entry);
            at = next;
        }
        if entries.is_empty() { Err(cut_off()) } else { Ok(Self { bytes, entries }) }
    }

    /// The names of all entries.
    pub fn names(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        self.entries.iter().map(|entry| entry.name)
    }

    /// The bytes of an entry, of which there may be `room`: a few of them may stand for a thousand times as
    /// many. Names are the same in capitals or not, and with a slash before them.
    pub fn read(&self, name: &[u8], room: u64) -> Result<Vec<u8>, MeshError> {
        let shown = || String::from_utf8_lossy(name).into_owned();
        let wanted = name.strip_prefix(b"/").unwrap_or(name);
        let entry = self.entries.iter().find(|entry| entry.name.eq_ignore_ascii_case(wanted));
        let entry = entry.ok_or_else(|| MeshFault::NoEntry(shown()).of_all())?;
        if entry.is_encrypted {
            return Err(MeshFault::Unsupported(format!("`{}` in the archive is encrypted", shown())).of_all());
        }
        let cut_off = || MeshFault::CutOff(format!("`{}` in the ZIP archive", shown())).of_all();
        let packed = entry.packed(self.bytes).ok_or_else(cut_off)?;
        let mut bytes = Vec::new();
        let read = match entry.method {
            0 => read_at_most(packed, room.saturating_add(1), &mut bytes),
            8 => read_at_most(DeflateDecoder::new(packed), room.saturating_add(1), &mut bytes),
            method => {
                let what = format!("`{}` in the archive is compressed by method {method}", shown());
                return Err(MeshFault::Unsupported(what).of_all());
            }
        };
        if bytes.len() as u64 > room {
            return Err(MeshFault::TooLarge { what: shown(), room }.of_all());
        }
        let mut check = Crc::new();
        check.update(&bytes);
        if read.is_err() || check.sum() != entry.check {
            return Err(MeshFault::Damaged(shown()).of_all());
        }
        Ok(bytes)
    }
}

impl<'a> ZipEntry<'a> {
    /// The entry of the directory here, and where the next is.
    fn read(bytes: &'a [u8], at: usize) -> Option<(Self, usize)> {
        let head = bytes.get(at..at + 46)?;
        let [name, extra, comment] = [28, 30, 32].map(|field| u16_at(head, field) as usize);
        let name_at = at + 46;
        let extra_at = name_at + name;
        let mut sizes =
            [u64::from(u32_at(head, 24)), u64::from(u32_at(head, 20)), u64::from(u32_at(head, 42))];
        large_sizes(&mut sizes, bytes.get(extra_at..extra_at + extra)?);
        let [_, packed, offset] = sizes;
        let entry = Self {
            name: bytes.get(name_at..extra_at)?,
            method: u16_at(head, 10),
            is_encrypted: u16_at(head, 8) & 1 != 0,
            check: u32_at(head, 16),
            packed,
            offset,
        };
        Some((entry, extra_at + extra + comment))
    }

    /// The compressed bytes.
    fn packed(&self, bytes: &'a [u8]) -> Option<&'a [u8]> {
        let at = usize::try_from(self.offset).ok()?;
        let head = bytes.get(at..at.checked_add(30)?)?;
        let from = at + 30 + u16_at(head, 26) as usize + u16_at(head, 28) as usize;
        let to = from.checked_add(usize::try_from(self.packed).ok()?)?;
        if head.starts_with(b"PK\x03\x04") { bytes.get(from..to) } else { None }
    }
}

/// Puts sizes of 64 bits, which stand in an extra field in this order, in place of those that are all ones.
fn large_sizes(sizes: &mut [u64; 3], mut extra: &[u8]) {
    while let (Some(head), Some(length)) = (extra.get(..4), extra.get(2..4)) {
        let length = u16_at(length, 0) as usize;
        let mut field = extra.get(4..4 + length).unwrap_or_default();
        if u16_at(head, 0) == 1 {
            for size in sizes.iter_mut().filter(|size| **size == u64::from(u32::MAX)) {
                let Some((large, rest)) = field.split_first_chunk::<8>() else { return };
                *size = u64::from_le_bytes(*large);
                field = rest;
            }
            return;
        }
        extra = extra.get(4 + length..).unwrap_or_default();
    }
}

/// Where the directory begins: what ends the archive says so, before a comment of up to 64 KiB.
fn directory(bytes: &[u8]) -> Option<usize> {
    let first = bytes.len().saturating_sub(22 + usize::from(u16::MAX));
    let end =
        (first..=bytes.len().checked_sub(22)?).rev().find(|&at| bytes[at..].starts_with(b"PK\x05\x06"))?;
    let at = u32_at(&bytes[end..], 16);
    if at < u32::MAX {
        return Some(at as usize);
    }
    // Of large archives, and of programs that write all of them so.
    let locator = bytes.get(end.checked_sub(20)?..end).filter(|head| head.starts_with(b"PK\x06\x07"))?;
    let record = usize::try_from(u64_at(locator, 8)).ok()?;
    let record = bytes.get(record..record.checked_add(56)?).filter(|head| head.starts_with(b"PK\x06\x06"))?;
    usize::try_from(u64_at(record, 48)).ok().filter(|&at| at < bytes.len())
}

/// Whole numbers at a byte of what is long enough for them.
fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from(u32_at(bytes, at)) | u64::from(u32_at(bytes, at + 4)) << 32
}

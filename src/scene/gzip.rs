//! Files that are compressed by gzip: any other file within.

use std::io;
use std::path::Path;

use flate2::bufread::MultiGzDecoder;

use super::Diagnostic;
use super::bounded::read_at_most;
use super::memory::too_little;
use super::options::MAX_FILE_BYTES;

/// Whether the bytes begin as those of gzip do.
pub fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x1f\x8b\x08")
}

/// The name of the file within, as `gunzip` would call it.
pub fn inner_name(name: &str) -> &str {
    let ending = Path::new(name).extension().filter(|ending| ending.eq_ignore_ascii_case("gz"));
    ending.map_or(name, |_| &name[..name.len() - ".gz".len()])
}

/// The file within. A few bytes may stand for a thousand times as many: it is read as far as a file may be
/// long, and as there are `memory` bytes.
pub fn unpacked(bytes: &[u8], memory: Option<u64>) -> Result<Vec<u8>, Diagnostic> {
    let room = memory.map_or(u64::MAX, |memory| memory.saturating_sub(bytes.len() as u64));
    let mut inner = Vec::new();
    let read = read_at_most(MultiGzDecoder::new(bytes), room.min(MAX_FILE_BYTES) + 1, &mut inner);
    match read {
        _ if inner.len() as u64 > MAX_FILE_BYTES => Err(Diagnostic::error(
            0..0,
            format!("what is compressed in it is larger than {} MiB", MAX_FILE_BYTES >> 20),
        )),
        _ if inner.len() as u64 > room => {
            let limit = memory.unwrap_or(u64::MAX);
            Err(too_little(limit, limit.saturating_add(inner.len() as u64)))
        }
        Ok(()) => Ok(inner),
        Err(error) => Err(damaged(&error, inner.len())),
    }
}

fn damaged(error: &io::Error, whole: usize) -> Diagnostic {
    let what = match error.kind() {
        io::ErrorKind::UnexpectedEof => "is cut off".to_owned(),
        _ => format!("is damaged ({error})"),
    };
    Diagnostic::error(0..0, format!("the gzip file {what}, behind {whole} bytes of what is in it"))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn the_file_within_is_as_it_was() {
        let text = b"sphere(1);".repeat(1000);
        let file = packed(&text);
        assert!(is_gzip(&file));
        assert_eq!(unpacked(&file, None), Ok(text.clone()));
        // Two files behind each other are one.
        assert_eq!(unpacked(&[&file[..], &file].concat(), None), Ok(text.repeat(2)));
        let told = |file: &[u8], memory| unpacked(file, memory).unwrap_err().message;
        assert!(told(&file[..file.len() - 9], None).contains("is cut off"));
        let mut wrong = file.clone();
        let check = wrong.len() - 8;
        wrong[check] ^= 1;
        assert!(told(&wrong, None).contains("is damaged"));
        assert!(told(&file, Some(5000)).contains("more than the 4.9 KiB of memory"));
    }

    #[test]
    fn names_lose_their_ending() {
        assert_eq!(
            ["a.csg.gz", "a.GZ", "a.stl", "gz", "a"].map(inner_name),
            ["a.csg", "a", "a.stl", "gz", "a"]
        );
    }
}

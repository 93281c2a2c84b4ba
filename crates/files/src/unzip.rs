//! The files of a ZIP archive, unpacked within limits: workbooks of spreadsheets are archives.
//!
//! The directory at the end of the archive names the files and says where they begin (APPNOTE 6.3,
//! sections 4.3.7, 4.3.12 and 4.3.16). What it says of sizes may be wrong, so unpacking itself ends
//! at the limit.

use miniz_oxide::inflate::decompress_to_vec_with_limit;

/// The most bytes that the files of an archive unpack to.
pub(crate) const MOST_UNPACKED: usize = 32 << 20;
/// The most files of an archive.
const MOST_FILES: usize = 10_000;
/// Bytes of the end record, and the most that may follow it as a comment.
const END_RECORD: usize = 22;
const MOST_COMMENT: usize = 0xffff;

/// Why an archive can't be unpacked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ZipFault {
    /// It is no archive, or a damaged one.
    Damaged,
    /// It is encrypted, or packed in another way than spreadsheets do.
    Unknown,
    /// It unpacks to more than [`MOST_UNPACKED`].
    TooLarge,
}

/// The files of an archive for which `is_wanted` holds, by name.
///
/// # Errors
/// No archive, a damaged one, or one that unpacks to too much.
pub(crate) fn unzipped(
    bytes: &[u8],
    is_wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<u8>)>, ZipFault> {
    let end = end_record(bytes).ok_or(ZipFault::Damaged)?;
    let count = word(bytes, end + 10).ok_or(ZipFault::Damaged)?;
    let mut at = long(bytes, end + 16).ok_or(ZipFault::Damaged)?;
    let mut files = Vec::new();
    let mut left = MOST_UNPACKED;
    for _ in 0..count.min(MOST_FILES) {
        let entry = Entry::at(bytes, at).ok_or(ZipFault::Damaged)?;
        at = entry.next;
        if !is_wanted(&entry.name) {
            continue;
        }
        let unpacked = entry.unpacked(bytes, left)?;
        left -= unpacked.len();
        files.push((entry.name, unpacked));
    }
    Ok(files)
}

/// An entry of the directory.
struct Entry {
    name: String,
    flags: usize,
    method: usize,
    packed: usize,
    begins: usize,
    next: usize,
}

impl Entry {
    fn at(bytes: &[u8], at: usize) -> Option<Self> {
        (bytes.get(at..at + 4)? == b"PK\x01\x02").then_some(())?;
        let [name, extra, comment] = [28, 30, 32].map(|field| word(bytes, at + field));
        let name_end = at + 46 + name?;
        Some(Self {
            name: String::from_utf8_lossy(bytes.get(at + 46..name_end)?).into_owned(),
            flags: word(bytes, at + 8)?,
            method: word(bytes, at + 10)?,
            packed: long(bytes, at + 20)?,
            begins: long(bytes, at + 42)?,
            next: name_end + extra? + comment?,
        })
    }

    /// Its bytes, at most so many.
    fn unpacked(&self, bytes: &[u8], most: usize) -> Result<Vec<u8>, ZipFault> {
        let is_encrypted = self.flags & 1 != 0;
        if is_encrypted {
            return Err(ZipFault::Unknown);
        }
        let packed = self.packed_bytes(bytes).ok_or(ZipFault::Damaged)?;
        match self.method {
            0 if packed.len() > most => Err(ZipFault::TooLarge),
            0 => Ok(packed.to_vec()),
            8 => decompress_to_vec_with_limit(packed, most).map_err(|error| {
                let is_full = error.status == miniz_oxide::inflate::TINFLStatus::HasMoreOutput;
                if is_full { ZipFault::TooLarge } else { ZipFault::Damaged }
            }),
            _ => Err(ZipFault::Unknown),
        }
    }

    fn packed_bytes<'a>(&self, bytes: &'a [u8]) -> Option<&'a [u8]> {
        (bytes.get(self.begins..self.begins + 4)? == b"PK\x03\x04").then_some(())?;
        let [name, extra] = [26, 28].map(|field| word(bytes, self.begins + field));
        let inside = self.begins + 30 + name? + extra?;
        bytes.get(inside..inside.checked_add(self.packed)?)
    }
}

/// Where the end record begins: the last place that looks like one.
fn end_record(bytes: &[u8]) -> Option<usize> {
    let last = bytes.len().checked_sub(END_RECORD)?;
    let first = last.saturating_sub(MOST_COMMENT);
    (first..=last).rev().find(|&at| bytes[at..].starts_with(b"PK\x05\x06"))
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let pair = bytes.get(at..at.checked_add(2)?)?;
    Some(u16::from_le_bytes(pair.try_into().ok()?).into())
}

fn long(bytes: &[u8], at: usize) -> Option<usize> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    usize::try_from(u32::from_le_bytes(four.try_into().ok()?)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::zipped;
    use crate::output::OutputFile;

    #[test]
    fn what_is_stored_comes_back() {
        let file = |name: &str, bytes: &[u8]| OutputFile { name: name.into(), bytes: bytes.into() };
        let bytes = zipped(&[file("a.xml", b"<a/>"), file("b", b"two")]).unwrap();
        let read = unzipped(&bytes, |name| name.ends_with(".xml")).unwrap();
        assert_eq!(read, [("a.xml".to_owned(), b"<a/>".to_vec())]);
        for damaged in [&bytes[..bytes.len() - 1], &bytes[4..], b"", b"PK"] {
            assert_eq!(unzipped(damaged, |_| true), Err(ZipFault::Damaged));
        }
        let mut encrypted = bytes.clone();
        let directory = encrypted.windows(4).position(|four| four == b"PK\x01\x02").unwrap();
        encrypted[directory + 8] |= 1;
        assert_eq!(unzipped(&encrypted, |_| true), Err(ZipFault::Unknown));
    }

    /// A file that states a size of 0 and unpacks to 40 MB is refused without being unpacked.
    #[test]
    fn a_bomb_is_refused() {
        let packed = miniz_oxide::deflate::compress_to_vec(&vec![0; 40 << 20], 6);
        let file = OutputFile { name: "a".into(), bytes: packed };
        let mut bytes = zipped(&[file]).unwrap();
        let directory = bytes.windows(4).position(|four| four == b"PK\x01\x02").unwrap();
        bytes[directory + 10] = 8;
        bytes[directory + 24..directory + 28].fill(0);
        assert_eq!(unzipped(&bytes, |_| true), Err(ZipFault::TooLarge));
    }
}

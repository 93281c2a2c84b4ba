//! Several files as one ZIP archive, for browsers, which download one file at a time.
//!
//! Files are stored as they are: patterns are small, and PDF is packed already. The format then
//! needs three kinds of records: a header before each file, a directory at the end that repeats the
//! headers, and an end record with the offset of the directory (APPNOTE 6.3, sections 4.3.7, 4.3.12
//! and 4.3.16). All times are constant, so that equal files give equal bytes.

use crate::output::OutputFile;

/// Names are UTF-8 (general purpose flag 11).
const UTF_8: u16 = 1 << 11;
/// Ten times the version of the format that a reader of stored files needs: 2.0.
const VERSION: u16 = 20;
/// The date of every file: 1 January 1980, the earliest date of the format.
const FIRST_DAY: u16 = 0x21;

/// Returns the ZIP archive of the files; `None` above the limits of the format of 1989: 65,535
/// files, 4 GiB in all.
pub fn zipped(files: &[OutputFile]) -> Option<Vec<u8>> {
    let mut archive = Vec::new();
    let mut directory = Vec::new();
    for OutputFile { name, bytes } in files {
        let begins = u32::try_from(archive.len()).ok()?;
        let mut entry = Vec::new();
        for word in [VERSION, UTF_8, 0, 0, FIRST_DAY] {
            entry.extend(word.to_le_bytes());
        }
        let size = u32::try_from(bytes.len()).ok()?;
        for word in [crc32fast::hash(bytes), size, size] {
            entry.extend(word.to_le_bytes());
        }
        entry.extend(u16::try_from(name.len()).ok()?.to_le_bytes());
        // No further fields.
        entry.extend([0; 2]);
        archive.extend(*b"PK\x03\x04");
        archive.extend(&entry);
        archive.extend(name.bytes());
        archive.extend(bytes);
        directory.extend(*b"PK\x01\x02");
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&entry);
        // No comment, the first disk, no attributes.
        directory.extend([0; 10]);
        directory.extend(begins.to_le_bytes());
        directory.extend(name.bytes());
    }
    let begins = u32::try_from(archive.len()).ok()?;
    let size = u32::try_from(directory.len()).ok()?;
    let count = u16::try_from(files.len()).ok()?;
    archive.extend(directory);
    archive.extend(*b"PK\x05\x06\0\0\0\0");
    for _ in 0..2 {
        archive.extend(count.to_le_bytes());
    }
    archive.extend(size.to_le_bytes());
    archive.extend(begins.to_le_bytes());
    archive.extend([0; 2]);
    Some(archive)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(bytes: &[u8], at: usize) -> usize {
        u16::from_le_bytes([bytes[at], bytes[at + 1]]).into()
    }

    fn long(bytes: &[u8], at: usize) -> usize {
        word(bytes, at) + (word(bytes, at + 2) << 16)
    }

    /// The files of an archive, read as other programs do: the end record, the directory, each
    /// file. (Python's `zipfile` reads the archives of the browser's test in .ci.)
    fn unzipped(bytes: &[u8]) -> Vec<OutputFile> {
        let end = bytes.len() - 22;
        assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
        let mut at = long(bytes, end + 16);
        assert_eq!(at + long(bytes, end + 12), end);
        let mut files = Vec::new();
        for _ in 0..word(bytes, end + 10) {
            assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
            let (name, size, begins) =
                (word(bytes, at + 28), long(bytes, at + 24), long(bytes, at + 42));
            // The header before the file says the same as the directory.
            assert_eq!(&bytes[begins..begins + 4], b"PK\x03\x04");
            assert_eq!(&bytes[begins + 4..begins + 30], &bytes[at + 6..at + 32]);
            let inside = begins + 30 + name;
            let held = &bytes[inside..inside + size];
            assert_eq!(crc32fast::hash(held) as usize, long(bytes, at + 16));
            let name_of = String::from_utf8(bytes[at + 46..at + 46 + name].to_vec()).unwrap();
            files.push(OutputFile { name: name_of, bytes: held.to_vec() });
            at += 46 + name;
        }
        assert_eq!(at, end);
        files
    }

    #[test]
    fn an_archive_gives_its_files_back() {
        let file = |name: &str, bytes: &[u8]| OutputFile { name: name.into(), bytes: bytes.into() };
        let files = [file("a.svg", b"<svg/>"), file("größe c.dxf", &[0, 255, 7]), file("e", b"")];
        let bytes = zipped(&files).unwrap();
        assert_eq!(Some(&bytes), zipped(&files).as_ref());
        assert_eq!(unzipped(&bytes), files);
        assert!(unzipped(&zipped(&[]).unwrap()).is_empty());
        assert_eq!(zipped(&vec![file("a", b""); 65_536]), None);
    }
}

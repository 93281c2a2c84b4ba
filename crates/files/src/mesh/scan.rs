//! Shared by the readers of text and of bytes: lines with their numbers, numbers, and a cursor over
//! bytes that knows its offset.

use crate::names::shown;
use crate::reading::InputError;

/// The lines of a file, from 1, without their ends: `\n`, `\r\n` or, as old files have it, `\r`.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    // In a file with line feeds, a carriage return counts as a blank.
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    bytes.split(move |&byte| byte == end).enumerate().map(|(n, line)| (n + 1, line))
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word of the file in quotation marks, for a message.
pub(crate) fn quoted(word: &[u8]) -> String {
    shown(&String::from_utf8_lossy(word))
}

/// A number in text.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Three coordinates from some words.
pub(crate) fn coordinates<'a>(
    mut words: impl Iterator<Item = &'a [u8]>,
    where_from: impl Fn() -> String,
) -> Result<[f64; 3], InputError> {
    let mut found = [0.0; 3];
    for (axis, coordinate) in ["x", "y", "z"].into_iter().zip(&mut found) {
        let Some(word) = words.next() else {
            let message = format!("the point has no {axis}");
            return Err(InputError::at(where_from(), message, "A point has three coordinates."));
        };
        let Some(value) = number(word) else {
            let message = format!("{} is no number", quoted(word));
            let hint = "Coordinates are decimal numbers with a point, such as 12.5.";
            return Err(InputError::at(where_from(), message, hint));
        };
        *coordinate = value;
    }
    Ok(found)
}

/// The error for bytes that end too soon.
pub(super) fn cut_off(place: &str, what: &str) -> InputError {
    InputError::at(
        place,
        format!("the file ends within {what}"),
        "The file is incomplete: copy or export it again.",
    )
}

/// Bytes that are read one value after the other.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// The offset of the next byte from the beginning of the file.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// The number of bytes left.
    pub(super) fn left(&self) -> usize {
        self.rest().len()
    }

    /// The bytes that are left.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at.min(self.bytes.len())..]
    }

    /// The next `count` bytes; `None` if fewer are left.
    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let end = self.at.checked_add(count)?;
        let taken = self.bytes.get(self.at..end)?;
        self.at = end;
        Some(taken)
    }

    /// The next bytes as an array.
    pub(super) fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }
}

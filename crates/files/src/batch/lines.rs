//! Lines of a stream, of which none is longer than a limit.

use std::io::{self, BufRead, Read as _};

/// Reads lines, and counts them.
#[derive(Debug)]
pub(super) struct Lines<R> {
    from: R,
    /// The number of the line that was read last, from 1; 0 before the first.
    pub(super) number: u64,
    most_bytes: usize,
}

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// It was read.
    Read,
    /// It is longer than the limit and was left out.
    TooLong,
    /// The stream has ended.
    End,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(from: R, most_bytes: usize) -> Self {
        Self { from, number: 0, most_bytes }
    }

    /// Reads a line in place of what `line` held, without the line feed and the carriage return
    /// before it.
    pub(super) fn read(&mut self, line: &mut Vec<u8>) -> io::Result<Line> {
        line.clear();
        let most = self.most_bytes as u64 + 1;
        if self.from.by_ref().take(most).read_until(b'\n', line)? == 0 {
            return Ok(Line::End);
        }
        self.number += 1;
        if line.last() == Some(&b'\n') {
            line.pop();
            if line.last() == Some(&b'\r') {
                line.pop();
            }
        } else if line.len() > self.most_bytes {
            line.clear();
            self.skip_line()?;
            return Ok(Line::TooLong);
        }
        Ok(Line::Read)
    }

    fn skip_line(&mut self) -> io::Result<()> {
        loop {
            let bytes = self.from.fill_buf()?;
            let end = bytes.iter().position(|&b| b == b'\n');
            let (used, is_done) = (end.map_or(bytes.len(), |end| end + 1), bytes.is_empty());
            self.from.consume(used);
            if is_done || end.is_some() {
                return Ok(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn lines_are_counted_and_long_ones_left_out() {
        let mut lines = Lines::new(&b"ab\r\n\nabcde\nabcd\nx"[..], 4);
        let mut line = Vec::new();
        let mut read = Vec::new();
        loop {
            let kind = lines.read(&mut line).unwrap();
            if kind == Line::End {
                break;
            }
            read.push((lines.number, kind, String::from_utf8(line.clone()).unwrap()));
        }
        let of = |n, text: &str| (n, Line::Read, text.to_owned());
        let long = (3, Line::TooLong, String::new());
        assert_eq!(read, [of(1, "ab"), of(2, ""), long, of(4, "abcd"), of(5, "x")]);
    }
}
